"""The functions of a cell to any precision, by two tools, and the floats they are asked for.

`ENCLOSE` has each function in Arb's ball arithmetic (python-flint): rigorous. `DEFINE` has it in mpmath, from the
definition. Both work with PRECISION bits, which leave hundreds even where all digits of 1 - H cancel: the smallest I,
at the smallest log-odds, is 2^-2150.
"""

from fractions import Fraction

import mpmath
from flint import arb, ctx

PRECISION = 2800
ctx.prec = PRECISION
mpmath.mp.prec = PRECISION


def ln2():
    return arb.const_log2()


def entropy(p):
    if p == 0 or p == 1:
        return arb(0)
    return -(p * p.log() + (1 - p) * (-p).log1p()) / ln2()


def minor(l):
    x = (-abs(l)).exp()
    return x / (1 + x)


def entropy_from_log_odds(l):
    return ((-abs(l)).exp().log1p() + abs(l) * minor(l)) / ln2()


def occupancy(l):
    return minor(l) if l < 0 else 1 - minor(l)


ENCLOSE = {
    "entropy": entropy,
    "information": lambda p: 1 - entropy(p),
    "entropy_from_log_odds": entropy_from_log_odds,
    "information_from_log_odds": lambda l: 1 - entropy_from_log_odds(l),
    "occupancy_from_log_odds": occupancy,
}


def define_entropy(p, rest):
    """Eq. 1, from p and 1 - p."""
    return -sum((q * mpmath.log(q) / mpmath.log(2) for q in (p, rest) if q), mpmath.mpf(0))


def define_occupancy(l):
    return 1 / (1 + mpmath.exp(-l))


def define_entropy_from_log_odds(l):
    return define_entropy(define_occupancy(l), define_occupancy(-l))


DEFINE = {
    "entropy": lambda p: define_entropy(p, 1 - p),
    "information": lambda p: 1 - define_entropy(p, 1 - p),
    "entropy_from_log_odds": define_entropy_from_log_odds,
    "information_from_log_odds": lambda l: 1 - define_entropy_from_log_odds(l),
    "occupancy_from_log_odds": define_occupancy,
}

FORMATS = {"f64": (53, -1074), "f32": (24, -149)}


def fraction_of(x):
    """An exact arb as a fraction."""
    m, e = map(int, x.man_exp())
    return m * Fraction(2) ** e


def enclosure(function, x):
    """Two fractions with the exact value between them, from Arb."""
    # All functions are monotone in |l|, and from |l| = 4096 on within 2^-5900 of their limits: 0 or 1.
    ball = ENCLOSE[function](arb(max(-4096.0, min(x, 4096.0))))
    lo, hi = fraction_of(ball.lower()), fraction_of(ball.upper())
    if abs(x) >= 4096:
        lo, hi = (lo if hi > Fraction(1, 2) else 0), (1 if hi > Fraction(1, 2) else hi)
    return max(lo, Fraction(0)), min(hi, Fraction(1))


def exponent_of_ulp(value, format):
    """The exponent of the spacing of the floats about a fraction in (0, 1]."""
    precision, lowest = FORMATS[format]
    n, d = value.numerator, value.denominator
    top = n.bit_length() - d.bit_length()
    if n << max(-top, 0) < d << max(top, 0):
        top -= 1
    return max(top - precision + 1, lowest)


def rounded(value, format):
    """The float of the format nearest to a fraction, ties to even."""
    if value == 0:
        return 0.0
    e = exponent_of_ulp(value, format)
    return float(round(value * Fraction(2) ** -e) * Fraction(2) ** e)


def rounds_twice(value, format):
    """Whether rounding to f64 first, and then to f32, gives another float than rounding once."""
    return format == "f32" and rounded(Fraction(rounded(value, "f64")), format) != rounded(value, format)


def hardness(value, format):
    """How many bits after the rounding bit are all 0 or all 1: -log2 of the distance to the nearest half ulp."""
    halves = value * Fraction(2) ** (1 - exponent_of_ulp(value, format))
    distance = abs(halves - round(halves))
    return float("inf") if distance == 0 else float(-mpmath.log(mpmath.mpf(distance.numerator) / distance.denominator, 2))
