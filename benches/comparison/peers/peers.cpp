// GSL's and Boost's quadrature, for a partner that evaluates the integrand.
//
//     c++ -O2 peers.cpp -lgsl -lgslcblas -o peers && peers gsl|boost
//
// Reads lines "TOLERANCE LIMIT N X1 .. XN" and writes messages: 'v' and an argument, to which the partner answers with
// the value; at the end 'r', value and claimed error, and a byte that is 1 if the method says that it is done. Numbers
// are 8 bytes as they lie in memory.

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

static double evaluate(double x, void*) {
    double value;
    std::fputc('v', stdout);
    std::fwrite(&x, sizeof x, 1, stdout);
    std::fflush(stdout);
    if (std::fread(&value, sizeof value, 1, stdin) != 1) std::exit(1);
    return value;
}

struct Said {
    double value, claim;
    bool done;
};

static Said gsl(std::vector<double> points, double tolerance, std::size_t limit) {
    const std::size_t panels = limit / 42;
    gsl_integration_workspace* workspace = gsl_integration_workspace_alloc(panels);
    gsl_function f{evaluate, nullptr};
    Said said{};
    const int status =
        points.size() == 2
            ? gsl_integration_qags(&f, points[0], points[1], 0, tolerance, panels, workspace, &said.value, &said.claim)
            : gsl_integration_qagp(&f, points.data(), points.size(), 0, tolerance, panels, workspace, &said.value,
                                   &said.claim);
    said.done = status == GSL_SUCCESS;
    gsl_integration_workspace_free(workspace);
    return said;
}

// At most 2^10 panels, 43 000 evaluations: without singular points Boost bisects everywhere, and its default of 2^15 takes a
// minute for one integral.
static Said boost_kronrod(const std::vector<double>& points, double tolerance) {
    Said said{0, 0, true};
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        double claim = 0;
        const auto f = [](double x) { return evaluate(x, nullptr); };
        said.value += boost::math::quadrature::gauss_kronrod<double, 21>::integrate(f, points[k], points[k + 1], 10,
                                                                                    tolerance, &claim);
        said.claim += claim;
    }
    said.done = said.claim <= tolerance * std::abs(said.value);
    return said;
}

int main(int, char** arguments) {
    gsl_set_error_handler_off();
    const bool is_gsl = std::strcmp(arguments[1], "gsl") == 0;
    char line[1 << 16];
    while (std::fgets(line, sizeof line, stdin)) {
        std::istringstream words(line);
        double tolerance;
        std::size_t limit, count;
        words >> tolerance >> limit >> count;
        std::vector<double> points(count);
        for (double& x : points) words >> x;
        Said said;
        try {
            said = is_gsl ? gsl(points, tolerance, limit) : boost_kronrod(points, tolerance);
        } catch (const std::exception&) {
            said = {std::numeric_limits<double>::quiet_NaN(), 0, false};
        }
        std::fputc('r', stdout);
        std::fwrite(&said.value, sizeof said.value, 1, stdout);
        std::fwrite(&said.claim, sizeof said.claim, 1, stdout);
        std::fputc(said.done, stdout);
        std::fflush(stdout);
    }
}
