#!/usr/bin/env python3
"""The reported integrals: those that users told other libraries they had wrong, and their kin. Writes reported.txt.

    crates/test-support/src/battery/reported.py > crates/test-support/src/battery/reported.txt

It needs mpmath and python-flint. Each value is the closed form in both, to 34 digits alike (mpmath in floats of 60
digits, python-flint in proved enclosures); where there is none, mpmath's quadrature and python-flint's enclosure of the
integral. Parameters and ends are floats of 24 bits, lines as those of `generate.py`.

Where they come from: SciPy's issues 5735, 9826, 10305, 11571, 14347, 15990, 17443; QuadGK.jl's 26, 37, 86; julia's 9682;
Integrals.jl's 85, 269, 315; quadpy's 174, 236, 255, 372; sympy's 24271; the lists of GSL (`f11`, `f454`) and of Boost (the
product of two logarithms). Infinite ends are cut where floats are 0, or brought to 0 by a substitution. Kinks and jumps
have no break points: nobody names them.
"""

import random
import struct

from flint import acb, arb, ctx
from mpmath import mp, mpf

mp.dps = 60
ctx.dps = 60


class Flint:
    """The functions that closed forms are made of, of python-flint."""

    pi = arb.pi()
    exp, log, sqrt, erf, gamma, log1p, expm1 = arb.exp, arb.log, arb.sqrt, arb.erf, arb.gamma, arb.log1p, arb.expm1
    sin = arb.sin

    @staticmethod
    def number(x):
        sign, significand, exponent, _ = mpf(x)._mpf_
        return arb((-1) ** sign * int(significand)) * arb(2) ** exponent


class Mpmath:
    """The same of mpmath."""

    pi = +mp.pi
    exp, log, sqrt, erf, gamma, log1p, expm1 = mp.exp, mp.log, mp.sqrt, mp.erf, mp.gamma, mp.log1p, mp.expm1
    sin = mp.sin
    number = staticmethod(mpf)


def single(x):
    """The nearest f32, exactly."""
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def agreed(first, second):
    """mpmath's value, if python-flint's enclosure says the same to 34 digits."""
    middle = mpf(second.mid().str(50, radius=False))
    assert second.rad() <= abs(second.mid()) * arb(10) ** -34 or abs(second) < arb(10) ** -50, second
    assert abs(first - middle) <= mpf(10) ** -34 * abs(first) or first == 0 and abs(middle) < mpf(10) ** -50
    return first


def case(family, parameters, ends, breaks, closed_form):
    """Prints a case whose integral is `closed_form(library, *parameters, *ends)`."""
    numbers = list(parameters) + list(ends)
    assert all(x == single(x) for x in numbers + list(breaks)), (family, numbers)
    value = agreed(*(closed_form(m, *map(m.number, numbers)) for m in (Mpmath, Flint)))
    line(family, parameters, ends, breaks, value)


def line(family, parameters, ends, breaks, value):
    high = float(value)
    text = lambda xs: ",".join(repr(float(x)) for x in xs) or "-"
    print(family, text(parameters), text(ends), text(breaks), repr(high), repr(float(value - mpf(high))))


def gaussian(m, width, at, height, a, b):
    """`height e^(-((x - at) / width)^2 / 2)`; of two tails on one side the difference, by erfc where both are small."""
    scale = m.sqrt(m.number(2)) * width
    return height * width * m.sqrt(m.pi / 2) * (m.erf((b - at) / scale) - m.erf((a - at) / scale))


def peak(width, at, height, a, b):
    numbers = [single(x) for x in (width, at, height, a, b)]
    width, at, _, a, b = numbers
    breaks = sorted({x for x in (single(at - 8 * width), at, single(at + 8 * width)) if a < x < b})
    case("gaussian", numbers[:3], numbers[3:], breaks, gaussian)


normal = lambda sigma: 1 / (sigma * mp.sqrt(2 * mp.pi))
peak(3.81, 116, normal(3.81), 0, 1000)  # SciPy 17443
peak(3810, 116000, normal(3810), 0, 1e6)  # sympy 24271
peak(0.19, 0.64449662, normal(0.19), -1000, 0.5)  # SciPy 11571
peak(mp.sqrt(0.5), 0, 1, -1000, 38)  # SciPy 10305
peak(0.0005, 0, normal(0.0005), 0.00105, 1)  # SciPy 15990
peak(0.65, 1, normal(0.65), 0.35, 30)  # julia 9682
peak(1, 800, 1, -2000, 3000)  # SciPy 5735, without its factor

generator = random.Random(17443)
for _ in range(16):
    peak(10 ** generator.uniform(-6, -1), generator.random(), 1, 0, 1)

ZERO, ONE = mpf(0), mpf(1)


def laplace(m, width, at, height, a, b):
    """`height e^(-|x - at| / width)`, with `at` between the ends."""
    return -height * width * (m.expm1((a - at) / width) + m.expm1((at - b) / width))


def lognormal(m, shape, scale, height, a, b):
    """`height e^(-(ln(x / scale) / shape)^2 / 2)` from 0, in `u = ln(x / scale)`."""
    two = m.sqrt(m.number(2))
    mass = m.erf((m.log(b / scale) - shape * shape) / (shape * two)) + 1
    return height * scale * m.exp(shape * shape / 2) * shape * m.sqrt(m.pi / 2) * mass


# QuadGK.jl 37, the density of Laplace over ±1e8, and one that is narrower. Beside 40 widths it is 4e-18 of its height.
for width, at, height, a, b in [(1, 0, 0.5, -1e8, 1e8), (0.037, 0.3, 13.5, -5, 70)]:
    numbers = [single(x) for x in (width, at, height, a, b)]
    breaks = [single(at - 40 * width), single(at), single(at + 40 * width)]
    case("peak-laplace", numbers[:3], numbers[3:], breaks, laplace)
# SciPy 14347: x times the density of a lognormal, whose integral is the expected value.
numbers = [single(x) for x in (0.194, 0.066, 1 / (0.194 * mp.sqrt(2 * mp.pi)))]
breaks = [single(0.066 * mp.exp(0.194 * u)) for u in (-8, 0, 8)]
case("peak-lognormal", numbers, [ZERO, mpf(201)], breaks, lognormal)

places = [0.499, 0.4999] + [generator.random() for _ in range(14)] + [0.001, 0.9985]  # QuadGK.jl 26
for c in map(single, places):
    case("kink", [c], [ZERO, ONE], [], lambda m, c, a, b: m.expm1(c) + m.expm1(1 - c))
    low, high = single(generator.uniform(-2, 2)), single(generator.uniform(-2, 2))
    case("jump", [c, low, high], [ZERO, ONE], [], lambda m, c, low, high, a, b: low * c + high * (1 - c))
# Integrals.jl 269: a jump between exponentials, just behind the lower end.
bent = lambda m, c, rate, a, b: m.exp(c) - m.exp(a) + (m.exp(rate * b) - m.exp(rate * c)) / rate
case("exponential-jump", [ONE, mpf(2)], [single(0.997), mpf(2)], [], bent)
# quadpy 255: a sawtooth that stays at π.
case("ramp", [single(mp.pi)], [ZERO, mpf(4)], [], lambda m, c, a, b: c * c / 2 + c * (b - c))


def cut(m, end, d, a, b):
    """`x / √(end + d - x)` up to `end`, and 0 beyond."""
    whole = end + d
    return 4 * (whole * m.sqrt(whole) - d * m.sqrt(d)) / 3 - 2 * end * m.sqrt(d)


case("cut-root", [single(1e-6), single(1e-8)], [ZERO, single(2e-6)], [], cut)  # Integrals.jl 315
case("identity", [], [-ONE, ONE], [], lambda m, a, b: (b * b - a * a) / 2)  # quadpy 372
case("identity", [], [-ONE, mpf(3)], [], lambda m, a, b: (b * b - a * a) / 2)

# quadpy 174: a cubic that ends at 1.2e12.
cubic = lambda m, c3, c2, c1, c0, a, b: (((c3 / 4 * b + c2 / 3) * b + c1 / 2) * b + c0) * b
case("cubic", [single(x) for x in (1.2, -1.2, 14, 1.23)], [ZERO, mpf(10000)], [], cubic)

# SciPy 9826: whole waves between the points of a coarse grid, cos(n x)^2 up to π.
for n in (4, 8):
    wave = lambda m, n, a, b: (b - a) / 2 + (m.sin(2 * n * b) - m.sin(2 * n * a)) / (4 * n)
    case("cosine-squared", [mpf(n)], [ZERO, single(mp.pi)], [], wave)

# QuadGK.jl 86: x^-1.1 from 1 to ∞ is t^-0.9 from 0 to 1 with x = 1/t; at another end, where floats are not as fine; and
# x^-1.1 itself, cut.
for end in (0, 1):
    a, ends = single(-0.9), [mpf(end), mpf(end) + 1]
    case("end-power", [a, mpf(end)], ends, [], lambda m, a, end, lower, upper: 1 / (a + 1))
power = lambda m, a, at, lower, upper: (upper ** (a + 1) - lower ** (a + 1)) / (a + 1)
case("lyness-power", [single(-1.1), ZERO], [ONE, mpf(2) ** 20], [], power)

# Powers at ends, at 0 and away from it.
for a, end in [(-0.75, 0), (-0.5, 0), (0.5, 0), (1.5, 0), (-0.5, 1), (-0.25, 1), (0.5, 1), (1.5, 1), (0.25, -1000)]:
    ends = [mpf(end), mpf(end) + 1]
    case("end-power", [mpf(a), mpf(end)], ends, [], lambda m, a, end, lower, upper: 1 / (a + 1))

# A float of 24 bits and the next.
for lower, upper in [(1, 1 + mpf(2) ** -23), (-3 - mpf(2) ** -22, -3), (0, mpf(2) ** -149)]:
    case("identity", [], [mpf(lower), mpf(upper)], [], lambda m, a, b: (b * b - a * a) / 2)

# GSL's f11: ln(1/x)^(a - 1), whose integral is Γ(a); f454: x^3 ln |(x^2 - 1)(x^2 - 2)| up to 3.
for a in (0.5, 1.5, 2.5):
    case("gsl-11", [mpf(a)], [ZERO, ONE], [], lambda m, a, lower, upper: m.gamma(a))
logarithms = lambda m, a, b: 61 * m.log(m.number(2)) + 77 * m.log(m.number(7)) / 4 - 27
case("gsl-454", [], [ZERO, mpf(3)], [ONE, single(mp.sqrt(2))], logarithms)
case("boost-logarithms", [], [ZERO, ONE], [], lambda m, a, b: 2 - m.pi * m.pi / 6)

# Integrals.jl 85: a Gaussian times an occupation; no closed form.
for eta in map(single, (-20, -5, 1.5)):
    exact = mp.quad(lambda x: mp.exp(-x * x / 2) / (1 + mp.exp(x - eta)), [-100, -20, -10, -5, 0, 5, 10, 20, 100])
    f = lambda x, _: (-x * x / 2).exp() / (1 + (x - acb(Flint.number(eta))).exp())
    enclosed = sum((acb.integral(f, a, b).real for a, b in [(-100, -20), (-20, 0), (0, 20), (20, 100)]), arb(0))
    line("occupied", [eta], [mpf(-100), mpf(100)], [ZERO], agreed(exact, enclosed))

# quadpy 236: e^(-1 / (1 - w^2)) for |w| below 0.999, and e^-1 beside; no closed form.
c = single(0.999)
exact = mp.quad(lambda w: mp.exp(-1 / (1 - w * w)), mp.linspace(-c, c, 9)) + 2 * (1 - c) * mp.exp(-1)
bump = lambda w, _: (-1 / (1 - w * w)).exp()
edge = Flint.number(c)
enclosed = acb.integral(bump, -edge, edge).real + 2 * (1 - edge) * arb(-1).exp()
line("bump-jump", [c], [-ONE, ONE], [], agreed(exact, enclosed))
