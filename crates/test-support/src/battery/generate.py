#!/usr/bin/env python3
"""The battery of the adaptive quadrature: integrals with their exact values, to 32 digits. Writes cases.txt.

    crates/test-support/src/battery/generate.py > crates/test-support/src/battery/cases.txt

Every parameter and end is a float of 24 bits, so that f32 and f64 integrate the same function over the same interval.
Values are closed forms at 60 digits where there is one; the rest is mpmath's quadrature at 50 digits by two methods
in two variables, which have to agree to 1e-34.

A line: family, parameters, ends, break points in between (those of the family's definition), high and low part of the
value (the nearest f64, and the nearest f64 to what is left).
"""

import random
import struct

from mpmath import mp, mpf

mp.dps = 60


def single(x):
    """The nearest f32, exactly."""
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def agreed(f, points):
    """The integral by tanh-sinh quadrature, which does not mind the singularity at 0, and in the variable
    u = -ln |t|, where there is none, by Gauss-Legendre quadrature."""
    mp.dps = 50
    first = mp.quad(f, points, method="tanh-sinh", maxdegree=12)
    second = mpf(0)
    for sign, end in [(-1, -points[0]), (1, points[-1])]:
        g = lambda u: f(sign * mp.exp(-u)) * mp.exp(-u)
        low = -mp.log(end)
        second += mp.quad(g, [low + (40 - low) * k / 160 for k in range(161)], method="gauss-legendre")
    assert abs(first - second) <= mpf(10) ** -34 * first, (first, second)
    mp.dps = 60
    return first


cases = []


def case(family, parameters, ends, breaks, value):
    high = float(value)
    low = float(value - mpf(high))
    text = lambda xs: ",".join(repr(float(x)) for x in xs) or "-"
    assert all(x == single(x) for x in list(parameters) + list(ends) + list(breaks)), (family, parameters)
    cases.append(f"{family} {text(parameters)} {text(ends)} {text(breaks)} {high!r} {low!r}")


ZERO, ONE = mpf(0), mpf(1)
QUARTER_PI, THIRD, PI = single(mp.pi / 4), single(mpf(1) / 3), single(mp.pi)

# Piessens, de Doncker-Kapenga, Ueberhuber, Kahaner: QUADPACK (1983), section 4.1, with parameters of 24 bits.
for tenth in list(range(-9, 1)) + list(range(2, 27, 2)):  # 1: x^a ln(1/x)
    a = single(mpf(tenth) / 10)
    case("quadpack-1", [a], [ZERO, ONE], [], 1 / (1 + a) ** 2)
for a in range(21):  # 2: 4^-a / ((x - pi/4)^2 + 16^-a)
    d = mpf(4) ** -a
    value = mp.atan((1 - QUARTER_PI) / d) + mp.atan(QUARTER_PI / d)
    case("quadpack-2", [d, QUARTER_PI], [ZERO, ONE], [QUARTER_PI], value)
for a in range(11):  # 3: cos(2^a sin x)
    s = mpf(2) ** a
    f = lambda x: mp.cos(s * mp.sin(x))
    # pi J0(2^a) is the integral up to pi; what is beyond the float, or missing, is short and smooth.
    value = mp.pi * mp.besselj(0, s) + mp.quad(f, [mp.pi, PI])
    case("quadpack-3", [s], [ZERO, PI], [], value)
for name, c in [("quadpack-4", THIRD), ("quadpack-5", QUARTER_PI)]:  # |x - c|^a
    for tenth in range(-8, 22):
        a = single(mpf(tenth) / 10)
        case(name, [a, c], [ZERO, ONE], [c], ((1 - c) ** (a + 1) + c ** (a + 1)) / (a + 1))
for a in range(1, 21):  # 6: (1 - x^2)^(-1/2) / (x + 1 + 2^-a), in y = x + 1 so that both ends are met in floats
    d = mpf(2) ** -a
    case("quadpack-6", [d], [ZERO, mpf(2)], [], mp.pi / mp.sqrt((1 + d) ** 2 - 1))

# Lyness and Kaganove (1976), as widely used since: parameters at random from these ranges.
generator = random.Random(1976)
uniform = lambda low, high: single(generator.uniform(low, high))
for _ in range(8):
    c, a = uniform(0, 1), uniform(-0.5, 0)
    case("lyness-power", [a, c], [ZERO, ONE], [c], ((1 - c) ** (a + 1) + c ** (a + 1)) / (a + 1))
    c, a = uniform(0, 1), uniform(0, 1)
    case("lyness-step", [a, c], [ZERO, ONE], [c], (mp.exp(a) - mp.exp(a * c)) / a)
    c, a = uniform(0, 1), uniform(0, 4)
    case("lyness-cusp", [a, c], [ZERO, ONE], [c], (2 - mp.exp(-a * c) - mp.exp(-a * (1 - c))) / a)
    c, d = uniform(0, 1), single(10 ** generator.uniform(-6, -3))
    case("lyness-peak", [d, c], [ZERO, ONE], [c], mp.atan((1 - c) / d) + mp.atan(c / d))
    cs, d = sorted(uniform(1, 2) for _ in range(4)), single(10 ** generator.uniform(-5, -3))
    value = mp.fsum(mp.atan((2 - c) / d) - mp.atan((1 - c) / d) for c in cs)
    case("lyness-four-peaks", [d] + cs, [ONE, mpf(2)], cs, value)
    c = uniform(0, 1)
    b = single(10 ** generator.uniform(1.8, 2) / max(c, 1 - c) ** 2)
    case("lyness-oscillation", [b, c], [ZERO, ONE], [], mp.sin(b * (1 - c) ** 2) - mp.sin(b * c**2))

# Genz (1984), the six families in one dimension.
generator = random.Random(1984)
for _ in range(8):
    c, w = uniform(5, 50), uniform(0, 1)
    case("genz-oscillatory", [c, w], [ZERO, ONE], [], (mp.sin(c + w) - mp.sin(w)) / c)
    c, w = uniform(1.5, 100), uniform(0, 1)
    case("genz-product-peak", [c, w], [ZERO, ONE], [w], c * (mp.atan(c * (1 - w)) + mp.atan(c * w)))
    c = uniform(1.5, 100)
    case("genz-corner-peak", [c], [ZERO, ONE], [], 1 / (1 + c))
    c, w = uniform(1.5, 100), uniform(0, 1)
    case("genz-gaussian", [c, w], [ZERO, ONE], [w], mp.sqrt(mp.pi) / (2 * c) * (mp.erf(c * (1 - w)) + mp.erf(c * w)))
    c, w = uniform(1.5, 100), uniform(0, 1)
    case("genz-continuous", [c, w], [ZERO, ONE], [w], (2 - mp.exp(-c * w) - mp.exp(-c * (1 - w))) / c)
    c, w = uniform(1.5, 20), uniform(0, 1)
    case("genz-discontinuous", [c, w], [ZERO, ONE], [w], mp.expm1(c * w) / c)

# Peaks: a narrow Gaussian on a slope, and long and short intervals about one.
for d, c in [(0.03, 0.7), (1e-3, 0.3), (1e-6, 0.55)]:
    d, c = single(d), single(c)
    value = mp.sqrt(mp.pi) / 2 * d * (mp.erf((1 - c) / d) + mp.erf(c / d)) + mpf(1) / 8
    around = [x for x in (single(c - 8 * d), c, single(c + 8 * d)) if 0 < x < 1]
    case("gaussian-on-slope", [d, c], [ZERO, ONE], around, value)
for exponent in (-120, -60, -13, 13, 60, 120):
    scale = mpf(2) ** exponent
    case("runge-scaled", [scale], [-3 * scale, 5 * scale], [], scale * (mp.atan(3) + mp.atan(5)))

# The room: the deficit H2(e^(-t^2/2)) of one reading in t = (rho - z) / sigma, and the information in rho.
EDGE = mp.sqrt(mp.log(4))


def deficit(t):
    p = mp.exp(-t * t / 2)
    q = -mp.expm1(-t * t / 2)
    if q == 0 or p == 0:
        return ZERO
    return -(p * mp.log(p) + q * mp.log(q)) / mp.log(2)


for alpha in (0.01, 0.5, 2, 5, 10):
    alpha, edge = single(alpha), single(EDGE)
    points = sorted({x for x in (-alpha, -5, -2, -1, 0, 1, edge) if -alpha <= x})
    case("room-t", [], [-alpha, edge], [ZERO], agreed(deficit, [mpf(x) for x in points]))
for z, sigma in [(2, 0.2), (1000, 0.001)]:
    z, sigma = single(z), single(sigma)
    # Up to z + sigma: within what is observed, at a float; break points where the deficit lives.
    end = single(z + sigma)
    breaks = sorted({single(x) for x in (z - 8 * sigma, z - 2 * sigma, z)})
    alpha, beta = z / sigma, (end - z) / sigma
    points = [-x for x in (60, 20, 10, 5, 2, 1) if x < alpha] + [ZERO, beta]
    if alpha < 60:
        points = [-alpha] + points
    case("room-rho", [z, sigma], [ZERO, end], breaks, end - sigma * agreed(deficit, [mpf(x) for x in points]))

print("\n".join(cases))
