"""Exact results as decimals: from Arb's balls outwards, held against mpmath's value of the definition.

Precision follows the argument: near p = 1/2 information cancels to the square of 2 p - 1.
"""

from fractions import Fraction

import mpmath
from flint import arb, ctx, fmpq

import exact
from exact import fraction_of, rounded
from text import DIGITS, decimal


def ball(x):
    """A fraction, to the working precision."""
    return arb(fmpq(x.numerator, x.denominator))


def bounds(x):
    """Two fractions with the ball between them."""
    return fraction_of(x.lower()), fraction_of(x.upper())


def number(x):
    """A fraction, in mpmath."""
    return mpmath.mpf(x.numerator) / x.denominator


def within(lo, hi, value, slack):
    """Asserts that mpmath's value agrees with an enclosure, but for a relative slack."""
    man, e = value.man_exp
    value = man * Fraction(2) ** e
    slack *= max(abs(lo), abs(hi), abs(value))
    assert lo - slack <= value <= hi + slack and hi - lo <= slack, (float(lo), float(hi), float(value))


def want(lo, hi, digits=DIGITS):
    return {"lo": decimal(lo, digits, False), "hi": decimal(hi, digits, True)}


def want_nearest(lo, hi, format):
    """40 digits, or as many as decide the rounding and 20 more."""
    def decides(digits):
        ends = want(lo, hi, digits)
        return rounded(Fraction(ends["lo"]), format) == rounded(Fraction(ends["hi"]), format)

    digits = DIGITS
    while not decides(digits):
        digits += 20
        assert digits < 4000, "the enclosure is too wide to decide the rounding"
    return want(lo, hi, digits if digits == DIGITS else digits + 20)


def want_exact(value):
    """A dyadic fraction, all of its digits."""
    digits = DIGITS
    while decimal(value, digits, False) != decimal(value, digits, True):
        digits += 20
    return want(value, value, digits)


def precision(p):
    """Bits that leave some 280 of entropy and information: they cancel near 1/2 and, by the definition, near 0 and 1."""
    def lost(x):
        return max(x.denominator.bit_length() - x.numerator.bit_length(), 0) if x else 0

    return 320 + 2 * max(lost(abs(2 * p - 1)), lost(p), lost(1 - p))


def cell(kind, p):
    """The entropy or the information of an occupancy, a fraction: a ball."""
    if p in (0, 1, Fraction(1, 2)):
        return arb(int((p == Fraction(1, 2)) == (kind == "entropy")))
    with ctx.workprec(precision(p)):
        return exact.ENCLOSE[kind](ball(p))


def define_cell(kind, p):
    """The same in mpmath, from the definition."""
    with mpmath.workprec(precision(p)):
        return exact.DEFINE[kind](number(p))


def total(kind, cells):
    """The sum over fractions, in both tools; equal cells at once. Bounds as fractions."""
    counts = {}
    for p in cells:
        counts[p] = counts.get(p, 0) + 1
    with ctx.workprec(2600), mpmath.workprec(2600):
        balls = sum((cell(kind, p) * n for p, n in counts.items()), arb(0))
        value = sum((define_cell(kind, p) * n for p, n in counts.items()), mpmath.mpf(0))
        lo, hi = bounds(balls)
        within(lo, hi, value, Fraction(1, 2**200))
    return max(lo, Fraction(0)), hi
