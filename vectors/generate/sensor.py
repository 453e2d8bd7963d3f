#!/usr/bin/env python3
"""Writes vectors/v1/sensor.occupancy.json: Eq. 5 at listed, edge, hard and seeded random distances.

Needs python-flint, mpmath and numpy. The library has no part in it: the enclosures are Arb's, and mpmath's value from the
definition must lie in each.
"""

import math
from fractions import Fraction

import mpmath
import numpy as np
from flint import arb, ctx

import exact
import traps
from enclosures import ball, bounds, number, want_nearest, within
from exact import FORMATS
from operations import write
from text import KINDS, hex_float, neighbours
from trap_notes import NOTES

OP = "sensor.occupancy"
SOURCE = "vectors/generate/sensor.py: enclosures by Arb (python-flint), which contain mpmath's value of the definition."
FLAGS = {
    "Listed": "A sensor as in the report, at distances about its obstacle.",
    "Random": "From a seeded generator: distances from before the sensor to beyond the edge.",
    "Edge": "At the edge z + sigma sqrt(ln 4), or where the formula is 1/2 before the obstacle: within some ulp.",
    "NearRange": "rho next to z, p next to 1: 1 - p lies in the last bits, and (rho - z) / sigma must not be rounded twice.",
    "NearTie": "Within 2^-20 ulp, mostly far closer, of the midpoint of two floats: rho - z over sigma was solved for it. "
    "If only these fail, the result is within an ulp but not correctly rounded.",
    "RoundedTwice": "f32, and the float nearest to the f64 answer is another than that nearest to p: do not round twice.",
    "Subnormal": "p below the normal floats: flushed to zero, or rounded twice.",
    "Vanishing": "p below all floats: the answer is 0.",
    "LargeQuotient": "|rho - z| / sigma above 6: the exponent is large, and an error of its last bit is many ulp of p.",
    "Extreme": "The difference or its square overflows or underflows, p does not.",
    "BehindSensor": "Negative rho: the formula goes on.",
    "Infinite": "rho infinite: 1/2 beyond, 0 before.",
    "Unknown": "Beyond the edge: exactly 1/2.",
    "Domain": "rho NaN, or range or sigma not positive and finite: the answer is the error `domain`, or NaN.",
}
COUNTS = {"f64": 250, "f32": 120}


def is_beyond(rho, z, sigma):
    """Whether rho > z + sigma sqrt(ln 4): decided by ln 2 against a rational, which it is not."""
    if rho <= z:
        return False
    s = ((rho - z) / sigma) ** 2 / 2
    with ctx.workprec(3000):
        return bool(ball(s) > arb.const_log2())


def occupancy(rho, z, sigma):
    """Bounds of p at fractions."""
    if rho == z:
        return Fraction(1), Fraction(1)
    if is_beyond(rho, z, sigma):
        return Fraction(1, 2), Fraction(1, 2)
    s = ((rho - z) / sigma) ** 2 / 2
    if s > 10000:
        return Fraction(0), Fraction(1, 10**400)
    with ctx.workprec(2800), mpmath.workprec(2800):
        lo, hi = bounds((-ball(s)).exp())
        within(lo, hi, mpmath.exp(-(((number(rho) - number(z)) / (number(sigma) * mpmath.sqrt(2))) ** 2)), Fraction(1, 2**2700))
    return lo, min(hi, Fraction(1))


def want(rho, z, sigma, format):
    if math.isnan(rho) or not (0 < z < math.inf) or not (0 < sigma < math.inf):
        return {"error": "domain"}
    if math.isinf(rho):
        lo = hi = Fraction(int(rho > 0), 2)
    else:
        lo, hi = occupancy(*map(Fraction, (rho, z, sigma)))
    return want_nearest(lo, hi, format)


def known_mistakes(rho, z, sigma, format):
    if math.isnan(rho):
        return {}
    if not (0 < z < math.inf) or not (0 < sigma < math.inf):
        return {"NotRefused": 0.5 if rho > z else 1.0 if rho == z else None}
    if math.isinf(rho):
        return {"NoEdge": 0.0, "Complement": 1.0 if rho < 0 else None, "FreeSpaceUnknown": 0.5 if rho < 0 else None}
    with ctx.workprec(200):
        r, m, s = arb(rho), arb(z), arb(sigma)
        t = (r - m) / s
        half, edge = arb(1) / 2, (2 * traps.ln2()).sqrt()
        if abs(t) > 1e6:
            return {"FreeSpaceUnknown": half if rho < z else None, "FreeBeyond": 0.0 if rho > z else None, "NoEdge": 0.0}

        def cut(p, at=edge, beyond=half):
            return beyond if t > at else p

        p = (-t * t / 2).exp()
        swapped, crossed = (r - s) / m, (m - r) / s
        found = {
            "SigmaForVariance": cut((-(r - m) ** 2 / (2 * s)).exp()),
            "HalfMissing": cut((-t * t).exp()),
            "NormalisedDensity": cut(p / (s * (2 * arb.pi()).sqrt())),
            "NoEdge": p,
            "UnknownFromRange": cut(p, arb(0)),
            "EdgeAtOneSigma": cut(p, arb(1)),
            "EdgeWithoutTwo": cut(p, traps.ln2().sqrt()),
            "EdgeAtThreeSigma": cut(p, arb(3)),
            "Complement": 1 - cut(p),
            "FreeSpaceUnknown": half if p < half else cut(p),
            "FreeBeyond": cut(p, beyond=arb(0)),
            "OccupiedBeyond": cut(p, beyond=arb(1)),
            "FullWidth": cut((-4 * traps.ln2() * t * t).exp()),
            "PowerOfTwo": cut((-t * t / 2 * traps.ln2()).exp()),
            "RangeSigmaSwapped": half if swapped > edge else (-swapped * swapped / 2).exp(),
            "RhoRangeSwapped": half if crossed > edge else p,
            "AbsoluteRho": (-(((abs(r) - m) / s) ** 2) / 2).exp() if rho < 0 else None,
            "FlushedToZero": traps.flushed(float(p), format) if t < edge else None,
        }
        if format == "f64" and max(abs(rho), z, sigma) < 1e30 and min(z, sigma) > 1e-30:
            single = [Fraction(float(np.float32(x))) for x in (rho, z, sigma)]
            if not is_beyond(*single):
                found["SinglePrecision"] = (-ball((single[0] - single[1]) / single[2]) ** 2 / 2).exp()
    return found


def hard(format, rng):
    """Distances in solved-for quotients: a / s is the best approximation of sqrt(-2 ln p) with integers that floats hold."""
    precision, lowest = FORMATS[format]
    midpoints = [1 - Fraction(2 * k + 1, 2 ** (precision + 1)) for k in range(6)]
    for e in [0] * 8 + [1] * 8 + [2, 3, 5, 8, 13, 20, 30, 40, 60, 90, 120] + ([200, 400, 800, 1000] if format == "f64" else []):
        m = int(rng.integers(2 ** (precision - 1), 2**precision))
        midpoints.append(Fraction(2 * m + 1, 2 ** (precision + 1 + e)))
    # Next to 1/2, and in subnormals.
    midpoints += [Fraction(1, 2) + Fraction(2 * k + 1, 2 ** (precision + 1)) for k in range(3)]
    midpoints += [Fraction(2 * k + 1, 2) * Fraction(2) ** lowest for k in (0, 1, 6, 1000)]
    for n, p in enumerate(midpoints):
        with mpmath.workprec(600):
            c = mpmath.sqrt(-2 * mpmath.log(number(p)))
            c_fraction = Fraction(int(c * 2**500), 2**500)
        bound = 2 ** (precision - 1)
        q = c_fraction.limit_denominator(int(bound / max(1, math.ceil(c_fraction))))
        a, s = q.numerator, q.denominator
        if a == 0:
            continue
        scale = (-precision, -precision + 3)[n % 2]
        # Before the obstacle at 2^precision units, and where p > 1/2 also behind one at half of that.
        yield [math.ldexp(x, scale) for x in (2**precision - a, 2**precision, s)]
        if p > Fraction(1, 2):
            yield [math.ldexp(x, scale) for x in (bound + a, bound, s)]


def at_the_edge(format):
    """Sensors with rho at most some floats from either place where the Gaussian is 1/2; convergents of sqrt(ln 4)."""
    for z, sigma in [(2, 0.2), (5, 0.05), (0.5, 0.01), (10, 0.01), (0.3, 0.7), (30, 0.75)]:
        z, sigma = (float(KINDS[format](x)) for x in (z, sigma))
        for side in (-1, 1):
            place = float(KINDS[format](z + side * sigma * math.sqrt(math.log(4))))
            for rho in neighbours(place, format, 2):
                yield rho, z, sigma
    with mpmath.workprec(400):
        rest = mpmath.sqrt(2 * mpmath.log(2))
        p, q = [0, 1], [1, 0]
        while True:
            whole = int(mpmath.floor(rest))
            p, q = [p[1], whole * p[1] + p[0]], [q[1], whole * q[1] + q[0]]
            rest = 1 / (rest - whole)
            bound = 2 ** (FORMATS[format][0] - 1)
            if p[1] >= bound:
                break
            for unit in (2.0**-20, 2.0**10):
                yield (bound + p[1]) * unit, bound * unit, q[1] * unit
                yield (2 * bound - p[1]) * unit, 2 * bound * unit, q[1] * unit


def extreme(format):
    info = np.finfo(KINDS[format])
    largest, smallest, normal = (float(x) for x in (info.max, info.smallest_subnormal, info.tiny))
    for z, sigma in [(largest, largest), (largest / 2, largest / 4), (normal, normal / 2), (1000 * smallest, 300 * smallest),
                     (smallest, smallest), (normal, largest), (1.5, largest), (largest, 1.5), (1.5, smallest), (smallest, 1.5)]:
        for rho in (0.0, -0.0, smallest, z / 2, z, z * 0.75, 1.5 * z, largest, -largest, 1.0):
            if abs(rho) <= largest:
                yield float(KINDS[format](rho)), z, sigma


def cases(format, rng):
    kind = KINDS[format]
    sensors = [(2, 0.2), (2, 0.05), (5, 0.2), (10, 0.01), (0.5, 0.01), (0.75, 0.5), (30, 3), (0.3, 2.5)]
    for z, sigma in sensors:
        for k in (-6, -3, -2.5, -2, -1.5, -1.1, -0.75, -0.5, -0.1, 0, 0.1, 0.5, 0.75, 1.1, 1.2, 2, 2.9, 4):
            yield kind(z + k * sigma), kind(z), kind(sigma), "Listed"
        for rho in (0, -0.5, z / 3, 2 * z, 100):
            yield kind(rho), kind(z), kind(sigma), "Listed"
        for rho in neighbours(kind(z), format, 3):
            yield rho, kind(z), kind(sigma), "NearRange"
    precision = FORMATS[format][0]
    for k in range(1, precision + 12):
        # |t| = 2^-k, on either side.
        for z, side in ((2.0, -1), (3.0, 1)):
            yield kind(z + side * 2.0 ** (1 - min(k, precision - 2))), kind(z), kind(2.0 ** (1 - min(k, precision - 2) + k)), "NearRange"
    for rho, z, sigma in hard(format, rng):
        yield rho, z, sigma, "NearTie"
    for rho, z, sigma in at_the_edge(format):
        yield rho, z, sigma, "Edge"
    for rho, z, sigma in extreme(format):
        yield rho, z, sigma, "Extreme"
    count = COUNTS[format]
    deepest = {"f64": 38.7, "f32": 14.5}[format]
    for z, sigma, t in zip(np.exp(rng.uniform(-3, 4, count)), np.exp(rng.uniform(-7, 0, count)), rng.uniform(-1, 1, count)):
        t = (-deepest * t * t if t < -0.3 else 4 * t)
        yield kind(z + t * sigma), kind(z), kind(sigma), "Random"
    for z, sigma in [(2, 0.2), (0.5, 3)]:
        for rho in (math.inf, -math.inf):
            yield rho, kind(z), kind(sigma), "Infinite"
    for bad in (0.0, -0.0, -0.25, -math.inf, math.inf, math.nan):
        for rho in (0.5, 0.75, 1.25):
            yield rho, bad, 0.25, "Domain"
            yield rho, 0.75, bad, "Domain"
    yield math.nan, 0.75, 0.25, "Domain"
    yield math.inf, math.inf, 0.25, "Domain"


def more_flags(rho, z, sigma, answer, format):
    """What the numbers show."""
    if "error" in answer or math.isinf(rho):
        return
    precision, lowest = FORMATS[format]
    hi = Fraction(answer["hi"])
    if hi < Fraction(2) ** (lowest - 1):
        yield "Vanishing"
    elif hi < Fraction(2) ** (lowest + precision - 1):
        yield "Subnormal"
    elif abs(Fraction(rho) - Fraction(z)) > 6 * Fraction(sigma) and hi < Fraction(1, 2):
        yield "LargeQuotient"
    if exact.rounds_twice(Fraction(answer["lo"]), format):
        yield "RoundedTwice"
    if rho < 0:
        yield "BehindSensor"
    if answer["lo"] == answer["hi"] == "5.0e-1":
        yield "Unknown"


def main():
    tests, seen = [], set()
    for format in FORMATS:
        for *arguments, flag in cases(format, np.random.default_rng([20261125, FORMATS[format][0]])):
            rho, z, sigma = map(float, arguments)
            key = ",".join(map(hex_float, (rho, z, sigma)))
            if (format, key) in seen:
                continue
            seen.add((format, key))
            answer = want(rho, z, sigma, format)
            if flag == "NearTie" and exact.hardness(Fraction(answer["lo"]), format) < 20:
                continue
            tests.append(traps.attach({
                "id": f"{OP}/{format}/{key}",
                "format": format,
                "args": {"rho": hex_float(rho), "range": hex_float(z), "sigma": hex_float(sigma)},
                "want": answer,
                "flags": [flag, *more_flags(rho, z, sigma, answer, format)],
            }, known_mistakes(rho, z, sigma, format)))
    write(OP, SOURCE, FLAGS, NOTES, tests)


if __name__ == "__main__":
    main()
