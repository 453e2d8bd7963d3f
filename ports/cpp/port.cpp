// Serves the port protocol on standard input and output with the functions of mean_information.hpp:
//     c++ -std=c++17 -O2 -ffp-contract=off port.cpp -o port
#include "mean_information.hpp"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <string>

// A value of one line of JSON: text and numbers as they stand, a list, or an object. Escapes do not occur.
struct Json {
    std::string text;
    std::vector<Json> items;
    std::map<std::string, Json> members;

    static Json parse(const char*& at) {
        Json value;
        skip(at, " ");
        if (*at == '{' || *at == '[') {
            char close = *at == '{' ? '}' : ']';
            for (++at; skip(at, " ,"), *at != close;) {
                if (*at == 0) throw std::runtime_error("the line ends too early");
                if (close == '}') {
                    std::string key = parse(at).text;
                    skip(at, " :");
                    value.members[key] = parse(at);
                } else {
                    value.items.push_back(parse(at));
                }
            }
            ++at;
        } else if (*at == '"') {
            while (*++at != '"') {
                if (*at == 0) throw std::runtime_error("the line ends too early");
                value.text += *at;
            }
            ++at;
        } else {
            while (*at != 0 && !std::strchr(" ,:]}", *at)) value.text += *at++;
        }
        return value;
    }

private:
    static void skip(const char*& at, const char* which) {
        while (*at != 0 && std::strchr(which, *at)) ++at;
    }
};

using namespace mean_information;

template <class T>
T number(const Json& json) {
    return static_cast<T>(std::strtod(json.text.c_str(), nullptr)); // reads 0x1.8p-2, inf, nan
}
template <class T>
std::vector<T> list(const Json& json) {
    std::vector<T> found;
    for (const Json& item : json.items) found.push_back(number<T>(item));
    return found;
}
template <class T>
std::vector<std::vector<T>> rows(const Json& json) {
    std::vector<std::vector<T>> found;
    for (const Json& item : json.items) found.push_back(list<T>(item));
    return found;
}

std::string hex(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "\"%a\"", x);
    return text;
}

using Arguments = std::map<std::string, Json>;
using Operation = std::function<std::string(const Arguments&)>;

template <class T>
std::map<std::string, Operation> operations() {
    auto real = [](auto function, auto... names) {
        return [=](const Arguments& a) { return hex(function(number<T>(a.at(names))...)); };
    };
    auto cells = [](auto function) { return [=](const Arguments& a) { return hex(function(list<T>(a.at("cells")))); }; };
    return {
        {"cell.entropy", real(entropy<T>, "p")},
        {"cell.information", real(information<T>, "p")},
        {"cell.entropy_from_log_odds", real(entropy_from_log_odds<T>, "l")},
        {"cell.information_from_log_odds", real(information_from_log_odds<T>, "l")},
        {"cell.occupancy_from_log_odds", real(occupancy_from_log_odds<T>, "l")},
        {"sensor.occupancy", real(sensor_occupancy<T>, "rho", "range", "sigma")},
        {"map.entropy", cells(map_entropy<T>)},
        {"map.information", cells(map_information<T>)},
        {"map.mean_information", cells(map_mean_information<T>)},
        {"map.observed", [](const Arguments& a) { return std::to_string(map_observed(list<T>(a.at("cells")))); }},
        {"fuse.log_odds", cells(fuse_log_odds<T>)},
        {"expected.mean_information",
         [](const Arguments& a) {
             return hex(expected_mean_information(list<T>(a.at("weights")), rows<T>(a.at("particles"))));
         }},
        {"grid.polar.mean_information", real(grid_polar<T>, "range", "sigma", "resolution")},
        {"grid.cartesian.mean_information",
         real(grid_cartesian<T>, "range", "sigma", "resolution", "offset_x", "offset_y")},
        {"limit.radial", real(limit_radial<T>, "range", "sigma")},
        {"limit.area", real(limit_area<T>, "range", "sigma")},
    };
}

int main() {
    const std::map<std::string, std::map<std::string, Operation>> formats = {{"f32", operations<float>()},
                                                                           {"f64", operations<double>()}};
    for (std::string line; std::getline(std::cin, line);) {
        const char* at = line.c_str();
        Json request = Json::parse(at);
        std::string command = request.members["cmd"].text;
        if (command == "stop") break;
        if (command == "start") {
            std::string names;
            for (const auto& entry : formats.at("f64")) names += (names.empty() ? "\"" : ",\"") + entry.first + "\"";
            // 100 bits do not decide every rounding: see mean_information.hpp.
            std::cout << R"({"protocol":1,"name":"mean_information.hpp","language":"C++","version":"1",)"
                      << R"("formats":["f64","f32"],"ops":[)" << names << R"(],"claims":{"cell.*":0.5000000001,)"
                      << R"("sensor.occupancy":0.5000000001,"fuse.log_odds":0.5000000001}})" << std::endl;
            continue;
        }
        std::cout << R"({"seq":)" << request.members["seq"].text << ',';
        try {
            const Operation& run = formats.at(request.members["format"].text).at(request.members["op"].text);
            std::string result = run(request.members["args"].members);
            std::cout << R"("result":)" << result;
        } catch (const std::domain_error&) {
            std::cout << R"("error":"domain")";
        } catch (const std::out_of_range&) {
            std::cout << R"("error":"unknown-operation")";
        } catch (const TooLarge& reason) {
            std::cout << R"("skipped":")" << reason.what() << '"';
        }
        std::cout << '}' << std::endl;
    }
}
