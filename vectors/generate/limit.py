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
from text import DIGITS, decimal, hex_float, neighbours, write_file  # noqa: E402

ctx.prec = 320
mpmath.mp.dps = 60
OPS = {
    "limit.radial": "1 - int H(e^(-t^2/2)) dt / (a + b), t from -a to b, a = range / sigma, b = sqrt(ln 4), in bits",
    "limit.area": "1 - 2 int (a + t) H(e^(-t^2/2)) dt / (a + b)^2, t, a and b as for limit.radial, in bits",
}
FLAGS = {
    "Room": "As sensors have it: centimetres to 100 metres, noise from a millimetre to a metre; those of the report.",
    "Border": "range / sigma where the tables of this crate change, or one float below.",
    "Extremum": "range / sigma next to where the limit is largest or smallest.",
    "Random": "From a seeded generator, all quotients from 2^-40 to 2^70.",
    "Extreme": "Ends of the format: subnormal or largest numbers, quotients that overflow or underflow.",
    "Domain": "Not positive, or not finite: the answer is the error `domain`.",
}
KINDS = {"f64": np.float64, "f32": np.float32}
COUNTS = {"f64": 200, "f32": 60}


def fraction(x):
    """An exact arb."""
    m, e = map(int, x.man_exp())
    return m * Fraction(2) ** e


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
        lo, hi = fraction(ball.lower()), min(fraction(ball.upper()), Fraction(1))
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
    tests, seen = {op: [] for op in OPS}, set()
    for format in KINDS:
        rng = np.random.default_rng([20261124, len(format), format == "f64"])
        for z, s, flag in rooms(format, rng):
            z, s = float(z), float(s)
            if (format, z, s) in seen:
                continue
            seen.add((format, z, s))
            for (op, found), want in zip(tests.items(), wants(z, s)):
                found.append(test(op, format, z, s, want, flag))
        for bad in (0.0, -0.0, -0.25, math.nan, math.inf, -math.inf):
            for z, s in ((bad, 0.75), (0.75, bad)):
                for op, found in tests.items():
                    found.append(test(op, format, z, s, {"error": "domain"}, "Domain"))
    for op, found in tests.items():
        write_file({
            "op": op,
            "version": 1,
            "formula": OPS[op],
            "tolerance_ulp": 2,
            "verdict": "Within 2 ulp, the spacing of the floats at the answer, of the exact value, between lo and hi.",
            "source": "vectors/generate/limit.py: enclosures by Arb (python-flint); mpmath's quadrature agrees.",
            "flags": FLAGS,
        }, found)


def test(op, format, z, s, want, flag):
    z, s = hex_float(z), hex_float(s)
    name = f"{op.removeprefix('limit.')}/{format}/{z},{s}"
    return {"id": name, "format": format, "args": {"range": z, "sigma": s}, "want": want, "flags": [flag]}


if __name__ == "__main__":
    main()
