// Mean information of occupancy maps, in one header to read and to start from. C++17, no dependencies.
//
//   I(p) = 1 - H(p),  H(p) = -p log2 p - (1-p) log2 (1-p)          Eqs. 1, 3: one cell, in bits
//   mean information = sum of I / number of cells with p != 1/2    Eqs. 2, 4: a map
//   p(rho) = exp(-((rho - z) / sigma)^2 / 2) up to z + sigma sqrt(ln 4), 1/2 beyond      Eq. 5: a range reading z
//
// The equations are those of Blanco, "Derivation of an Expression for the Mean Information Maximum Value". Functions are
// templates over float and double. All of them compute in pairs of doubles, with about 100 bits, and round once: results
// are the nearest floats unless the exact result is within 2^-34 ulp of half-way between two. Compile with
// -ffp-contract=off, and never with -ffast-math, which breaks the pairs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace mean_information {

// The answer would take too long.
struct TooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// ------------------------------------------------------------------------------------------------ pairs of doubles

// The number high + low, where high is the double nearest to it.
struct Pair {
    double high = 0, low = 0;
    Pair(double x = 0) : high(x) {}
    Pair(double h, double l) : high(h), low(l) {}
};

// a + b, for |a| >= |b|, and for any: exact.
inline Pair quick_sum(double a, double b) {
    double s = a + b;
    return {s, b - (s - a)};
}
inline Pair exact_sum(double a, double b) {
    double s = a + b, c = s - a;
    return {s, (a - (s - c)) + (b - c)};
}
// a b: exact unless it underflows.
inline Pair exact_product(double a, double b) {
    double p = a * b;
    return {p, std::fma(a, b, -p)};
}

inline Pair operator-(Pair a) { return {-a.high, -a.low}; }
inline Pair operator+(Pair a, Pair b) {
    Pair s = exact_sum(a.high, b.high), t = exact_sum(a.low, b.low);
    s = quick_sum(s.high, s.low + t.high);
    return quick_sum(s.high, s.low + t.low);
}
inline Pair operator-(Pair a, Pair b) { return a + -b; }
inline Pair operator*(Pair a, Pair b) {
    Pair p = exact_product(a.high, b.high);
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
inline Pair operator/(Pair a, Pair b) {
    double q = a.high / b.high;
    Pair rest = a - b * q;
    double r = rest.high / b.high;
    rest = rest - b * r;
    return quick_sum(q, r) + rest.high / b.high;
}
inline bool operator<(Pair a, Pair b) { return a.high < b.high || (a.high == b.high && a.low < b.low); }
inline Pair abs(Pair a) { return a.high < 0 ? -a : a; }
inline Pair ldexp(Pair a, int e) { return {std::ldexp(a.high, e), std::ldexp(a.low, e)}; }
inline Pair sqrt(Pair a) {
    if (a.high <= 0) return 0;
    double s = std::sqrt(a.high);
    return quick_sum(s, (a - exact_product(s, s)).high / (2 * s));
}

const Pair LN2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
const Pair PI = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// The float of type T nearest to x 2^e. A double between the two roundings must not hide which side of a tie x is on:
// it is rounded to an odd significand.
template <class T>
T nearest(Pair x, int e = 0) {
    double high = x.high;
    std::uint64_t bits;
    std::memcpy(&bits, &high, sizeof bits);
    double result = std::ldexp(high, e);
    bool is_rounded_again = std::is_same<T, float>::value || std::fabs(result) < std::numeric_limits<double>::min();
    if (is_rounded_again && x.low != 0 && bits % 2 == 0) {
        high = std::nextafter(high, x.low > 0 ? HUGE_VAL : -HUGE_VAL);
        result = std::ldexp(high, e);
    }
    return static_cast<T>(result);
}

// e^x = value 2^exponent, with value about 1.
struct Power {
    Pair value;
    int exponent;
};
inline Power exp(Pair x) {
    double k = std::nearbyint(x.high / LN2.high);
    Pair r = ldexp(x - LN2 * k, -8), term = r, sum = r; // of e^r - 1
    for (int n = 2; n < 14; ++n) {
        term = term * r / n;
        sum = sum + term;
    }
    for (int n = 0; n < 8; ++n) sum = sum * 2 + sum * sum; // (1 + sum)^2 - 1
    return {Pair(1) + sum, static_cast<int>(k)};
}

// ln x for x > 0: one Newton step from the double.
inline Pair log(Pair x) {
    int e;
    if (std::frexp(x.high, &e) < 0.70710678) --e;
    Pair m = ldexp(x, -e);
    double y = std::log(m.high);
    Power inverse = exp(-y);
    Pair rest = m * ldexp(inverse.value, inverse.exponent) - 1;
    return LN2 * e + (Pair(y) + (rest - rest * rest / 2));
}

// A sum of doubles without any error, as a list of doubles that do not overlap (Shewchuk).
class ExactSum {
    std::vector<double> parts;

public:
    void add(double x) {
        std::size_t kept = 0;
        for (double part : parts) {
            Pair s = exact_sum(x, part);
            if (s.low != 0) parts[kept++] = s.low;
            x = s.high;
        }
        parts.resize(kept);
        if (x != 0) parts.push_back(x);
    }
    void add(Pair x) {
        add(x.low);
        add(x.high);
    }
    void add_product(double a, Pair b) {
        add(exact_product(a, b.high));
        add(exact_product(a, b.low));
    }
    Pair value() const {
        Pair sum = 0;
        for (double part : parts) sum = sum + part; // from the least
        return sum;
    }
};

// ------------------------------------------------------------------------------------------------ one cell

// sum over k >= 1 of d^(2k-2) / (2k (2k-1)) / ln 2, so that I = d^2 times it, for d = 2p - 1 up to 1/4 or so.
inline Pair information_over_square(Pair d) {
    Pair square = d * d, power = 1, sum = 0;
    for (int k = 1; k < 40 && power.high > 1e-34; ++k) {
        sum = sum + power / (2 * k * (2 * k - 1));
        power = power * square;
    }
    return sum / LN2;
}

// -(1-m) ln(1-m) for m in [0, 1/2], with all digits: m - sum of m^k / (k (k-1)) where it is small.
inline Pair major_term(Pair m) {
    if (m.high > 0.0625) return (m - 1) * log(Pair(1) - m);
    Pair power = m, sum = m;
    for (int k = 2; k < 40 && power.high > 1e-34 * m.high; ++k) {
        power = power * m;
        sum = sum - power / (k * (k - 1));
    }
    return sum;
}

struct Cell {
    Pair entropy, information; // in bits
};

// Of a cell whose smaller probability is m = min(p, 1-p), where |2p - 1| = d. Each alone may have lost digits.
inline Cell cell(Pair m, Pair d) {
    if (d.high < 0.25) {
        Pair information = d * d * information_over_square(d);
        return {Pair(1) - information, information};
    }
    if (m.high == 0) return {0, 1};
    Pair entropy = (major_term(m) - m * log(m)) / LN2;
    return {entropy, Pair(1) - entropy};
}

inline void check_occupancy(double p) {
    if (!(0 <= p && p <= 1)) throw std::domain_error("an occupancy must be 0 to 1");
}

inline Cell cell(double p) {
    check_occupancy(p);
    double m = p > 0.5 ? 1 - p : p; // exact
    return cell(m, Pair(1) - 2 * m);
}

// Eq. 1, in bits.
template <class T>
T entropy(T p) {
    check_occupancy(p);
    if (p > 0 && p < 0x1p-200) { // the products of pairs would underflow
        Pair scaled = std::ldexp(static_cast<double>(p), 800);
        return nearest<T>(scaled * (Pair(1) - log(scaled) + LN2 * 800) / LN2, -800);
    }
    return nearest<T>(cell(p).entropy);
}

// Eq. 3, in bits.
template <class T>
T information(T p) {
    return nearest<T>(cell(p).information);
}

inline void check_log_odds(double l) {
    if (std::isnan(l)) throw std::domain_error("log-odds must not be NaN");
}

// 2p - 1 = tanh(l/2), by the series of sinh and cosh for l up to 1/2.
inline Pair twice_deviation(double l) {
    Pair x = l / 2, square = x * x, term = x, odd = x, even = 1;
    for (int k = 2; k < 26; ++k) {
        term = (k % 2 ? term * square : term) / k;
        if (k % 2) odd = odd + term;
    }
    term = 1;
    for (int k = 1; k < 13; ++k) {
        term = term * square / (2 * k * (2 * k - 1));
        even = even + term;
    }
    return odd / even;
}

// H in bits from l up to 64: ln(1 + e^-|l|) + |l| / (1 + e^|l|) nats.
inline Pair pair_entropy_from_log_odds(double l) {
    Power power = exp(-std::fabs(l));
    Pair odds = ldexp(power.value, power.exponent);
    return (log(odds + 1) + odds * std::fabs(l) / (odds + 1)) / LN2;
}

// Eq. 1 from l = ln(p / (1-p)).
template <class T>
T entropy_from_log_odds(T l) {
    check_log_odds(l);
    double size = std::fabs(static_cast<double>(l));
    if (size > 1500) return 0;
    if (size > 40) { // e^-l (1 + l), without what is 2^-57 of it: - e^-2l (l + 1/2)
        Power odds = exp(-size);
        Pair rest = ldexp(odds.value, odds.exponent) * (Pair(size) + 0.5);
        return nearest<T>(odds.value * (Pair(size) + 1 - rest) / LN2, odds.exponent);
    }
    if (size < 0.5) {
        Pair d = twice_deviation(size);
        return nearest<T>(Pair(1) - d * d * information_over_square(d));
    }
    return nearest<T>(pair_entropy_from_log_odds(size));
}

// Eq. 3 from l = ln(p / (1-p)).
template <class T>
T information_from_log_odds(T l) {
    check_log_odds(l);
    double size = std::fabs(static_cast<double>(l));
    if (size > 40) return nearest<T>(size > 200 ? Pair(1, -0x1p-200) : Pair(1) - pair_entropy_from_log_odds(size));
    if (size < 0x1p-60) { // l^2 / (8 ln 2), scaled
        Pair scaled = std::ldexp(size, 540);
        return nearest<T>(scaled * scaled / LN2, -1083);
    }
    if (size < 0.5) {
        Pair d = twice_deviation(size);
        return nearest<T>(d * d * information_over_square(d));
    }
    return nearest<T>(Pair(1) - pair_entropy_from_log_odds(size));
}

// p = 1 / (1 + e^-l).
template <class T>
T occupancy_from_log_odds(T l) {
    check_log_odds(l);
    double size = std::fabs(static_cast<double>(l));
    if (size > 1500) return l > 0 ? 1 : 0;
    Power power = exp(-size);
    Pair odds = ldexp(power.value, power.exponent);
    return l > 0 ? nearest<T>(Pair(1) / (odds + 1)) : nearest<T>(power.value / (odds + 1), power.exponent);
}

// ------------------------------------------------------------------------------------------------ a map

// Eq. 2, in bits: an unknown cell counts 1.
template <class T>
T map_entropy(const std::vector<T>& cells) {
    ExactSum sum;
    for (T p : cells) sum.add(cell(p).entropy);
    return nearest<T>(sum.value());
}

// The sum of Eq. 3 over the cells, in bits.
template <class T>
T map_information(const std::vector<T>& cells) {
    ExactSum sum;
    for (T p : cells) sum.add(cell(p).information);
    return nearest<T>(sum.value());
}

// The number of cells with p != 1/2.
template <class T>
std::uint64_t map_observed(const std::vector<T>& cells) {
    std::uint64_t observed = 0;
    for (T p : cells) {
        check_occupancy(p);
        observed += p != T(0.5);
    }
    return observed;
}

// Eq. 4: information per observed cell; 0 if nothing was observed.
template <class T>
T map_mean_information(const std::vector<T>& cells) {
    ExactSum sum;
    for (T p : cells) sum.add(cell(p).information);
    std::uint64_t observed = map_observed(cells);
    return observed ? nearest<T>(sum.value() / static_cast<double>(observed)) : T(0);
}

// ------------------------------------------------------------------------------------------------ a sensor

inline void check_positive(double x) {
    if (!(x > 0 && x < HUGE_VAL)) throw std::domain_error("range, sigma and resolution must be positive and finite");
}

// Eq. 5 for t = (rho - z) / sigma. It falls to 1/2 at t = sqrt(ln 4): there the observed ends.
template <class T>
T model(Pair t) {
    if (std::fabs(t.high) > 100) return t.high > 0 ? T(0.5) : T(0);
    if (std::fabs(t.high) < 0x1p-300) return 1;
    Power p = exp(t * t / -2);
    T result = nearest<T>(p.value, p.exponent);
    return t.high > 0 ? std::max(result, T(0.5)) : result;
}

// Eq. 5.
template <class T>
T sensor_occupancy(T rho, T range, T sigma) {
    check_positive(range);
    check_positive(sigma);
    if (std::isnan(rho)) throw std::domain_error("rho must not be NaN");
    if (std::isinf(rho)) return rho > 0 ? T(0.5) : T(0);
    // The powers of two apart, so that nothing overflows. The largest are halved: they are no subnormals.
    int shift = std::max(std::fabs(double(rho)), double(range)) > 0x1p1000 ? -1 : 0;
    Pair difference = exact_sum(std::ldexp(double(rho), shift), -std::ldexp(double(range), shift));
    int of_difference, of_sigma;
    std::frexp(difference.high, &of_difference);
    double divisor = std::frexp(double(sigma), &of_sigma);
    Pair t = ldexp(difference, -of_difference) / divisor;
    int e = of_difference - of_sigma - shift;
    return model<T>(ldexp(t, std::max(-2000, std::min(e, 100))));
}

// ------------------------------------------------------------------------------------------------ fusion

// Independent observations of one place: log-odds add, so that odds multiply.
template <class T>
T fuse_log_odds(const std::vector<T>& cells) {
    bool is_free = false, is_occupied = false;
    for (T p : cells) {
        check_occupancy(p);
        is_free |= p == 0;
        is_occupied |= p == 1;
    }
    if (is_free && is_occupied) throw std::domain_error("certainly free and certainly occupied: 0/0");
    if (is_free || is_occupied) return is_occupied ? 1 : 0;
    Pair odds = 1; // times 2^exponent
    long exponent = 0;
    for (T p : cells) {
        int e;
        double m = std::frexp(static_cast<double>(p), &e);
        odds = odds * m / (p < 0x1p-200 ? Pair(1) : exact_sum(1, -static_cast<double>(p)));
        exponent += e;
        std::frexp(odds.high, &e);
        odds = ldexp(odds, -e);
        exponent += e;
    }
    int e = static_cast<int>(std::max(-4000L, std::min(exponent, 4000L)));
    if (e > 400) return 1;
    return e < -400 ? nearest<T>(odds, e) : nearest<T>(odds / (ldexp(odds, e) + 1), e);
}

// Eq. 4 of the expected map, the mean of the particles' occupancies by weight. The sums are exact: a cell that no
// particle has seen stays 1/2, whatever the weights.
template <class T>
T expected_mean_information(const std::vector<T>& weights, const std::vector<std::vector<T>>& particles) {
    if (weights.size() != particles.size()) throw std::domain_error("one weight for each particle");
    double largest = 0;
    for (T w : weights) {
        if (!(w >= 0 && w < HUGE_VAL)) throw std::domain_error("weights must be 0 or more and finite");
        largest = std::max(largest, static_cast<double>(w));
    }
    if (largest == 0) throw std::domain_error("weights must not all be 0");
    for (const auto& cells : particles) {
        if (cells.size() != particles[0].size()) throw std::domain_error("particles must be of one length");
        for (T p : cells) check_occupancy(p);
    }
    int e;
    std::frexp(largest, &e);
    ExactSum total;
    for (T w : weights) total.add(std::ldexp(static_cast<double>(w), 900 - e));

    ExactSum sum;
    double observed = 0;
    for (std::size_t place = 0; place < particles[0].size(); ++place) {
        ExactSum occupied, free, deviation;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            double w = std::ldexp(static_cast<double>(weights[i]), 900 - e), p = particles[i][place];
            occupied.add_product(w, p);
            free.add_product(w, exact_sum(1, -p));
            deviation.add_product(w, exact_sum(p, -0.5));
        }
        Pair d = abs(deviation.value());
        if (d.high == 0) continue;
        Pair m = std::min(occupied.value(), free.value());
        sum.add(cell(m / total.value(), d * 2 / total.value()).information);
        ++observed;
    }
    return observed > 0 ? nearest<T>(sum.value() / observed) : T(0);
}

// ------------------------------------------------------------------------------------------------ grids

// The circular room seen by the sensor in its middle, in units of about the larger of range and sigma.
template <class T>
class Room {
    T range, sigma, resolution;
    double z, s, h;
    int unit = 0; // an exponent of two
    ExactSum sum;
    double observed = 0;

public:
    Room(T range, T sigma, T resolution) : range(range), sigma(sigma), resolution(resolution) {
        for (T x : {range, sigma, resolution}) check_positive(x);
        std::frexp(double(std::max(range, sigma)), &unit);
        z = std::ldexp(double(range), -unit);
        s = std::ldexp(double(sigma), -unit);
        h = std::min(std::ldexp(double(resolution), -unit), 0x1p1000);
    }

    // Of what is observed, in cells, and a little more.
    double reach() const { return (z + 1.1775 * s) / h; }

    // Counts a cell at a distance in cells. Whether it is observed is decided on floats, by its occupancy at its distance.
    void add(Pair distance) {
        Pair rho = distance * h;
        double about = (rho.high - z) / s;
        if (about > 2) return;
        if (about < -40) {
            sum.add(1);
            ++observed;
            return;
        }
        if (sensor_occupancy<T>(nearest<T>(rho, unit), range, sigma) == T(0.5)) return;
        ++observed;
        Pair t = (rho - z) / s, exponent = t * t / 2;
        if (rho.high == z && rho.low == 0) exponent = 0;
        Power power = exp(-exponent);
        Pair p = ldexp(power.value, power.exponent), d = p * 2 - 1;
        if (p.high >= 1) {
            sum.add(1);
            return;
        }
        sum.add(cell(std::min(p, Pair(1) - p), abs(d)).information);
    }

    T mean_information() const { return observed > 0 ? nearest<T>(sum.value() / observed) : T(0); }
};

constexpr double MAX_CELLS = 1 << 24;

// One beam through the room, in cells of one width, sampled at their centres (k + 1/2) h.
template <class T>
T grid_polar(T range, T sigma, T resolution) {
    Room<T> room(range, sigma, resolution);
    if (!(room.reach() < MAX_CELLS)) throw TooLarge("the beam has more than 2^24 cells");
    for (double k = 0; k < room.reach() + 1; ++k) room.add(k + 0.5);
    return room.mean_information();
}

// The room about a robot at the origin, sampled at ((i + offset_x) h, (j + offset_y) h).
template <class T>
T grid_cartesian(T range, T sigma, T resolution, T offset_x, T offset_y) {
    if (!std::isfinite(offset_x) || !std::isfinite(offset_y)) throw std::domain_error("offsets must be finite");
    Room<T> room(range, sigma, resolution);
    if (!(4 * room.reach() * room.reach() < MAX_CELLS)) throw TooLarge("the room has more than 2^24 cells");
    double x = std::fmod(double(offset_x), 1), y = std::fmod(double(offset_y), 1); // whole cells do not matter
    double end = std::floor(room.reach()) + 2;
    for (double j = -end; j <= end; ++j) {
        for (double i = -end; i <= end; ++i) {
            if (std::hypot(i + x, j + y) > room.reach() + 1e-6) continue;
            Pair a = exact_sum(i, x), b = exact_sum(j, y);
            // Of one coordinate 0 the other is the distance: a square may underflow.
            room.add(a.high == 0 ? abs(b) : b.high == 0 ? abs(a) : sqrt(a * a + b * b));
        }
    }
    return room.mean_information();
}

// ------------------------------------------------------------------------------------------------ limits
//
// With alpha = z / sigma, b = sqrt(ln 4), h(t) = H(e^(-t^2 / 2)), K = int h dt and M = int t h dt from -alpha to b,
//
//     radial = 1 - K / (alpha + b),    area = 1 - 2 (alpha K + M) / (alpha + b)^2.
//
// h is smooth but for t^2 ln t at 0, where the integrals are cut, and below 1e-40 from 14 on.

struct Moments {
    Pair k = 0, m = 0;
};

// The integrals of h and t h from 0 to `end`, in pieces of at most 2, by the tanh-sinh rule, which does not mind
// singularities at the ends of a piece: t = 1 / (1 + e^(pi sinh u)) of its width, u = n / 10.
inline Moments moments(Pair end) {
    Moments sum;
    for (double start = 0; Pair(start) < end; start += 2) {
        Pair stop = std::min(end, Pair(start + 2)), width = stop - start;
        for (int n = -36; n <= 36; ++n) {
            Power u = exp(Pair(n) / 10);
            Pair grow = ldexp(u.value, u.exponent), shrink = Pair(1) / grow;
            Power power = exp(PI * (grow - shrink) / 2);
            Pair e = ldexp(power.value, power.exponent);
            Pair weight = width * PI * (grow + shrink) / 20 * e / ((e + 1) * (e + 1));
            Pair t = stop - width / (e + 1), exponent = t * t / 2;
            power = exp(-exponent);
            Pair p = ldexp(power.value, power.exponent), free = Pair(1) - p;
            Pair nats = p * exponent - (free.high > 0 ? free * log(free) : Pair(0));
            sum.k = sum.k + weight * nats / LN2;
            sum.m = sum.m + weight * t * nats / LN2;
        }
    }
    return sum;
}

struct Integrals {
    Pair alpha, b, k, m;
};

inline Integrals integrals(double range, double sigma) {
    check_positive(range);
    check_positive(sigma);
    int of_range, of_sigma;
    double z = std::frexp(range, &of_range), s = std::frexp(sigma, &of_sigma);
    // From 2^400 on the limits are 1 in any format.
    Pair alpha = ldexp(Pair(z) / s, std::min(of_range - of_sigma, 400)), b = sqrt(LN2 * 2);
    static const Moments beyond = moments(b), all = moments(14);
    Moments before = alpha.high < 14 ? moments(alpha) : all;
    return {alpha, b, beyond.k + before.k, beyond.m - before.m};
}

// Eq. 7: what the mean information of polar grids tends to as their cells shrink.
template <class T>
T limit_radial(T range, T sigma) {
    Integrals of = integrals(range, sigma);
    return nearest<T>(Pair(1) - of.k / (of.alpha + of.b));
}

// The same for Cartesian grids, whose cells have equal areas rho drho dtheta.
template <class T>
T limit_area(T range, T sigma) {
    Integrals of = integrals(range, sigma);
    Pair edge = of.alpha + of.b;
    return nearest<T>(Pair(1) - (of.alpha * of.k + of.m) * 2 / edge / edge);
}

} // namespace mean_information
