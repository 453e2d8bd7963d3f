#!/usr/bin/env python3
"""Writes vectors/v1/limit.*.json: the limits of the mean information for rooms of every size, with rigorous enclosures.

Needs python-flint, mpmath and numpy. The library has no part in it. The enclosures are Arb's, from the expansions of
proofs/limit_exact.py; mpmath's tanh-sinh quadrature of the definition, Eq. 6, must agree with each to 45 decimals.
"""

import math
import sys
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
from flint import arb, ctx

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "proofs"))
from limit_exact import at  # noqa: E402
from limit_tables import HIGHEST, panels  # noqa: E402
import limit_traps  # noqa: E402
import traps  # noqa: E402
from exact import fraction_of  # noqa: E402
from operations import write  # noqa: E402
from text import DIGITS, KINDS, decimal, hex_float, neighbours  # noqa: E402
from trap_notes import NOTES  # noqa: E402

OPS = ("limit.radial", "limit.area")
SOURCE = "vectors/generate/limit.py: enclosures by Arb (python-flint); mpmath's quadrature agrees."
FLAGS = {
    "Room": "As sensors have it: centimetres to 100 metres, noise from a millimetre to a metre; those of the report.",
    "Border": "range / sigma where the tables of this crate change, or one float below.",
    "Extremum": "range / sigma next to where the limit is largest or smallest.",
    "Random": "From a seeded generator, all quotients from 2^-40 to 2^70.",
    "Extreme": "Ends of the format: subnormal or largest numbers, quotients that overflow or underflow.",
    "Domain": "Not positive, or not finite: the answer is the error `domain`.",
    "SmallAlpha": "range / sigma below 1/8: the series for large ones converge slowly, and differences cancel.",
    "LargeAlpha": "range / sigma above 9: the integral before z is the constant kappa to all digits of f64.",
    "NarrowPeak": "range / sigma above 500: a quadrature that is not told of z misses the peak and claims to be right.",
    "DoubleDigits": "f64, range / sigma from 1/8 to 500: a quadrature to 1e-10, or one across the kink of H at z, has too few digits here.",
}
COUNTS = {"f64": 200, "f32": 60}


def defined(a):
    """Both limits from their definition, in mpmath."""
    a = mpmath.mpf(a.numerator) / a.denominator
    b = mpmath.sqrt(2 * mpmath.log(2))

    def entropy(t):
        s = t * t / 2
        rest = -mpmath.expm1(-s)
        return (s * mpmath.exp(-s) - (rest * mpmath.log(rest) if rest else 0)) / mpmath.log(2)

    # H < 1e-80 beyond 20.
    cuts = [-t for t in (20, 14, 10, 7, 5, 3, 1) if t < a]
    cuts = ([] if a > 20 else [-a]) + cuts + [mpmath.mpf(0), b]
    k, m = (mpmath.quad(f, cuts) for f in (entropy, lambda t: t * entropy(t)))
    return 1 - k / (a + b), 1 - 2 * (a * k + m) / (a + b) ** 2


def wants(z, s):
    """Both enclosures, 40 digits, outwards."""
    a = Fraction(z) / Fraction(s)
    found = []
    for ball, value in zip(at(arb(a.numerator) / a.denominator), defined(a)):
        lo, hi = fraction_of(ball.lower()), min(fraction_of(ball.upper()), Fraction(1))
        value = Fraction(int(mpmath.nint(mpmath.ldexp(value, 200))), 2**200)
        assert hi - lo < Fraction(1, 2**200) and abs(value - lo) < Fraction(1, 10**45), (z, s)
        found.append({"lo": decimal(lo, DIGITS, False), "hi": decimal(hi, DIGITS, True)})
    return found


def rooms(format, rng):
    """(range, sigma, flag)."""
    kind = KINDS[format]
    n = COUNTS[format]
    info = np.finfo(kind)
    largest, smallest, normal = (float(x) for x in (info.max, info.smallest_subnormal, info.tiny))
    for z, s in [(2, 0.2), (2, 0.1), (2, 0.05), (5, 0.2), (5, 0.05), (10, 0.01), (0.5, 0.01), (1, 0.5)]:
        yield kind(z), kind(s), "Room"
    ranges = np.exp(rng.uniform(np.log(0.05), np.log(100), n))
    for z, s in zip(ranges, np.exp(rng.uniform(np.log(0.001), np.log(1), n))):
        yield kind(z), kind(s), "Room"
    # Every eighth of an octave in f64, every fifth of these in f32. 0.75 and 5.5 have few bits, so quotients are exact.
    starts = [start for start, _, far in panels() if not far and start > 0]
    borders = [*starts, arb(2) ** (HIGHEST + 1)]
    for i, start in enumerate(borders):
        if format == "f64" or i % 5 == 0:
            sigma = (0.75, 5.5)[i % 2]
            z = float(start) * sigma
            yield kind(z), kind(sigma), "Border"
            yield kind(neighbours(z, format)[1]), kind(sigma), "Border"
    for i in range(1, 8):
        # Above 16 the tables go by 1 / alpha, in steps of 1/128.
        yield kind(384), kind(3 * i), "Border"
    for a in (0.45766379083869217, 1.9028257192353927, 1.1774100225154747, 2.549942984682180):
        for sigma in (0.75, 1.25, 0.3):
            yield kind(a * sigma), kind(sigma), "Extremum"
    for e, sigma_exponent in zip(rng.uniform(-40, 70, n), rng.uniform(-30, 30, n)):
        yield kind(2.0 ** (e + sigma_exponent)), kind(2.0**sigma_exponent), "Random"
    ends = [smallest, 3 * smallest, normal - smallest, normal, 1 / 3, 3.0, largest / 3, largest]
    for z in ends:
        for s in ends:
            yield kind(z), kind(s), "Extreme"


def main():
    ctx.prec = 320
    mpmath.mp.dps = 60
    tests, seen = {op: [] for op in OPS}, set()
    for format in KINDS:
        rng = np.random.default_rng([20261124, len(format), format == "f64"])
        for z, s, flag in rooms(format, rng):
            z, s = float(z), float(s)
            if (format, z, s) in seen:
                continue
            seen.add((format, z, s))
            a = Fraction(z) / Fraction(s)
            flags = [flag, *more_flags(a, format)]
            wrong = limit_traps.known_mistakes(arb(a.numerator) / a.denominator)
            for (op, found), want, values in zip(tests.items(), wants(z, s), wrong):
                found.append(traps.attach(test(op, format, z, s, want, flags), values))
        for bad in (0.0, -0.0, -0.25, math.nan, math.inf, -math.inf):
            for z, s in ((bad, 0.75), (0.75, bad)):
                for op, found in tests.items():
                    found.append(test(op, format, z, s, {"error": "domain"}, ["Domain"]))
    for op, found in tests.items():
        write(op, SOURCE, FLAGS, NOTES, found)


def more_flags(a, format):
    """By a = range / sigma."""
    if a < Fraction(1, 8):
        yield "SmallAlpha"
    if a > 9:
        yield "LargeAlpha"
    if a > 500:
        yield "NarrowPeak"
    if format == "f64" and Fraction(1, 8) <= a <= 500:
        yield "DoubleDigits"


def test(op, format, z, s, want, flags):
    z, s = hex_float(z), hex_float(s)
    name = f"{op.removeprefix('limit.')}/{format}/{z},{s}"
    return {"id": name, "format": format, "args": {"range": z, "sigma": s}, "want": want, "flags": flags}


if __name__ == "__main__":
    main()
