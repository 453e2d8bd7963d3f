#!/usr/bin/env python3
"""Writes vectors/v1/fuse.log_odds.json: independent observations of one place, fused.

The result is rational, so that it is known exactly, in integers; mpmath's sum of log-odds must agree. Needs python-flint,
mpmath and numpy. The library has no part in it.
"""

import math
from fractions import Fraction

import mpmath
import numpy as np
from flint import arb, ctx, fmpz

import cells as draw
import traps
from enclosures import ball, bounds, number, want_exact, want_nearest, within
from exact import FORMATS, hardness, rounds_twice
from operations import write
from text import KINDS, hex_float, label, neighbours
from trap_notes import NOTES

OP = "fuse.log_odds"
SOURCE = "vectors/generate/fuse.py: exact in integers (Fraction); Arb's product of odds and mpmath's sum of log-odds agree."
FLAGS = {
    "Listed": "A handful of observations to work out by hand.",
    "Random": "From a seeded generator: all kinds of observations mixed.",
    "Mapped": "From a seeded generator: as sensors are, neither sure nor at 1/2.",
    "Empty": "No observation: the prior, 1/2.",
    "Single": "One observation, or others of 1/2 beside it: returned as it is, to the bit.",
    "Certain": "0 or 1 among others: it prevails.",
    "Contradiction": "0 and 1 together: 0/0, the answer is the error `domain`.",
    "Cancelling": "Opposite observations: the log-odds cancel, or nearly; what is left must not be lost.",
    "NearHalf": "The result is next to 1/2: the sum of the log-odds is tiny, and its digits are those of the arguments.",
    "NearCertain": "Observations within 2^-20 of 0 or 1: log(1-p) needs p exactly.",
    "Underflow": "The products of p and of 1-p underflow: 0/0 unless scaled, or added up as log-odds.",
    "Saturated": "The result is next to 1: 1/(1 + e^-l) knows few digits of 1-p; or next to 0 and below the normal floats.",
    "Subnormal": "Subnormal observations or results.",
    "Tie": "The exact value is the midpoint of two floats: ties go to even. Sums of rounded log-odds cannot tell.",
    "NearTie": "Within 2^-16 ulp, in f64 within 2^-40, of the midpoint of two floats.",
    "RoundedTwice": "f32, and the float nearest to the f64 answer is another: do not round twice.",
    "ManyObservations": "100 observations or more: the errors of rounded log-odds add up.",
    "Order": "The observations of another test in another order: the same bits.",
    "Domain": "An observation is NaN or outside [0, 1]: the answer is the error `domain`.",
}


def fused(cells):
    """Exactly; None if 0 meets 1."""
    occupied = free = 1
    for p in map(Fraction, cells):
        occupied *= p.numerator
        free *= p.denominator - p.numerator
    return Fraction(occupied, occupied + free) if occupied or free else None


def agree(p, cells):
    """The other tools: products of odds in balls, sums of log-odds."""
    with ctx.workprec(3000), mpmath.workprec(3000):
        odds = arb(1)
        log_odds = mpmath.mpf(0)
        for x in map(Fraction, cells):
            odds *= ball(x / (1 - x))
            log_odds += mpmath.log(number(x)) - mpmath.log(1 - number(x))
        lo, hi = bounds(odds / (1 + odds))
        assert lo <= p <= hi
        within(lo, hi, 1 / (1 + mpmath.exp(-log_odds)), Fraction(1, 2**1500))


def want(cells, format):
    p = fused(cells)
    if p is None:
        return {"error": "domain"}
    if 0 < p < 1 and not {0, 1} & set(cells):
        agree(p, cells)
    dyadic = p.denominator & (p.denominator - 1) == 0
    return want_exact(p) if dyadic else want_nearest(p, p, format)


def odds_of(q):
    """Observations whose odds multiply up to an odd integer: q / (2^n - q), and the same for what it divides by."""
    while q > 1:
        n = q.bit_length()
        yield Fraction(q, 2**n)
        q = 2**n - q


def ties(format, count, rng):
    """Odds a / b with a + b = 2^(precision + 1) and a odd, by their prime factors."""
    precision = FORMATS[format][0]
    while count:
        a = 2 * int(rng.integers(0, 2 ** (precision - 1))) + 2**precision + 1
        b = 2 ** (precision + 1) - a
        factors = [int(q) for x in (a, b) for q, _ in fmpz(x).factor()]
        if a >= 2 ** (precision + 1) or max(factors) >= 2**precision:
            continue
        cells = [p for q, n in fmpz(a).factor() for _ in range(n) for p in odds_of(int(q))]
        cells += [1 - p for q, n in fmpz(b).factor() for _ in range(n) for p in odds_of(int(q))]
        assert fused(cells) == Fraction(a, 2 ** (precision + 1))
        if len(cells) <= 60:
            count -= 1
            yield [float(p) for p in (cells[k] for k in rng.permutation(len(cells)))]


def near_ties(format, count, rng):
    """The last of three observations is solved for, where results near 1 are so crowded that one lies next to a midpoint."""
    precision = FORMATS[format][0]
    for k in range(count):
        cells = draw.in_format(rng.uniform(0.75, 0.999, 2), format)
        odds = fused(cells) / (1 - fused(cells))
        # 1 - p is some odd number of half ulps.
        rest = Fraction(2 * (k % 40) + 1, 2 ** (precision + 1))
        x = (1 - rest) / rest / odds
        p = x / (1 + x)
        last = float(np.asarray(float(p)).astype(KINDS[format]))
        if 0 < last < 1 and 16 < hardness(fused(cells + [last]), format) < math.inf:
            yield cells + [last]


def lists(format, rng):
    precision, lowest = FORMATS[format]
    smallest, eps = 2.0**lowest, 2.0**-precision
    below, above = (neighbours(0.5, format)[k] for k in (1, 2))
    yield "empty", [], "Empty"
    for p in (0.25, 0.875, 0.0, 1.0, -0.0, 0.5, smallest, 3 * smallest, 1 - eps, below, above, *draw.in_format([0.1, 0.3, 0.9], format)):
        yield "single", [p], "Single"
        yield "single", [0.5, p, 0.5], "Single"
    yield "single", [0.5] * 30, "Single"
    listed = [
        [0.75, 0.75], [0.75, 0.25], [0.75, 0.875], [0.25, 0.25, 0.25], [0.75, 0.5, 0.875], [0.625, 0.625], [0.9375, 0.125], [0.75, 0.75, 0.25],
        [0.125, 0.25, 0.875, 0.625], [0.6875] * 5, [0.3125] * 7, [0.75] * 2 + [0.25] * 3,
    ]
    listed += [draw.in_format(x, format) for x in ([0.7, 0.9, 0.4], [0.1, 0.2], [0.6] * 10, [0.9, 0.9, 0.1], [0.3, 0.7], [0.65, 0.65, 0.65, 0.2])]
    for x in listed:
        yield "listed", x, "Listed"
    for certain in (0.0, 1.0, -0.0):
        yield "certain", [certain, 0.75], "Certain"
        yield "certain", [0.125] * 3 + [certain] + [0.875] * 20, "Certain"
        yield "certain", [certain] * 3, "Certain"
        yield "certain", [1 - eps] * 30 + [certain] + [smallest], "Certain"
    for x in ([0.0, 1.0], [1.0, 0.0], [0.25, 1.0, 0.5, 0.0], [-0.0, 1.0], [1.0] * 3 + [0.0]):
        yield "contradiction", x, "Contradiction"
    for _ in range(8):
        x = draw.in_format(rng.uniform(0.55, 0.95, 5), format)
        # 1 - p is exact above 1/2.
        opposite = [float(np.asarray(1 - p).astype(KINDS[format])) for p in x]
        yield "cancelling", x + opposite, "Cancelling"
        yield "cancelling", x + neighbours(opposite[0], format)[1:2] + opposite[1:], "Cancelling"
        yield "near-half", draw.near_half(int(rng.integers(2, 9)), format, rng), "NearHalf"
    for k in (3, 20, 40):
        yield "near-half", [above] * k, "NearHalf"
        yield "near-half", [below] * k + [above] * (2 * k), "NearHalf"
    for count in (2, 9, 30):
        yield "near-certain", draw.near_one(count, format, rng), "NearCertain"
        yield "near-certain", draw.near_one(count, format, rng) + draw.near_zero(count, format, rng), "NearCertain"
    yield "near-certain", [1 - eps, eps], "NearCertain"
    yield "near-certain", [1 - eps, eps, 0.75], "NearCertain"
    yield "near-certain", [1 - eps, smallest], "NearCertain"
    yield "near-certain", [1 - eps] * 20 + [smallest], "NearCertain"
    x = draw.in_format([0.001, 0.999, 0.002, 0.9975], format)
    for k in (20, 50, 300):
        yield "underflow", x[:2] * k + [0.75], "Underflow"
        yield "underflow", x * (k // 2) + [0.25], "Underflow"
    yield "underflow", [2.0**-30] * 60 + [1 - 2.0**-20] * 90, "Underflow"
    yield "underflow", [0.0625] * 400 + [0.9375] * 399, "Underflow"
    for p in (0.75, 0.9375):
        for k in (6, 10, 12, 16, 24, 33, 40):
            yield "saturated", [p] * k, "Saturated"
            yield "saturated", [1 - p] * k, "Saturated"
    for k in (2, 4, 8, 37, 80):
        yield "saturated", [2.0 ** (lowest // 8)] * k, "Saturated"
        yield "saturated", [0.1875] * 10 * k, "Saturated"
    for p in (smallest, 5 * smallest, 1000 * smallest):
        yield "subnormal", [p, 0.75], "Subnormal"
        yield "subnormal", [p, 0.25], "Subnormal"
        yield "subnormal", [p, 0.375, 0.9375], "Subnormal"
        yield "subnormal", [p] * 2, "Subnormal"
        yield "subnormal", [0.625, p, 1 - 2.0**-12], "Subnormal"
    for x in ties(format, 24, rng):
        yield "tie", x, "Tie"
    for x in near_ties(format, 60, rng):
        yield "near-tie", x, "NearTie"
    for _ in range(60):
        yield "random", draw.any_of(int(rng.integers(2, 25)), format, rng), "Random"
        yield "mapped", draw.in_format(rng.uniform(0.05, 0.95, int(rng.integers(2, 25))), format), "Mapped"
    x = draw.in_format(rng.uniform(0.2, 0.8, 20), format)
    yield "order", x, "Mapped"
    for _ in range(4):
        yield "order", [x[k] for k in rng.permutation(20)], "Order"
    for k in (100, 1000):
        yield "many", draw.short(k, rng), "Mapped"
        yield "many", [0.5 + 2.0**-7 * j for j in rng.integers(-9, 10, k).tolist()], "Mapped"
    # 1/2 + an odd number of half ulps, up to a product of three small numbers: f64 rounds to the midpoint itself.
    for a in range(1, 8):
        for b in range(1, 2 * a, 4):
            x = [0.5 + a * eps, 0.5 - b * eps / 2]
            if rounds_twice(fused(x), format):
                yield "rounded-twice", x, "RoundedTwice"
    for bad in draw.BAD:
        yield "domain", [bad], "Domain"
        yield "domain", [0.25, 0.5, bad, 0.875], "Domain"
        yield "domain", [0.0, bad], "Domain"
    yield "domain", [0.25, neighbours(1, format)[2]], "Domain"
    yield "domain", [0.75, -smallest], "Domain"


def known_mistakes(cells, answer, format):
    if not cells:
        return {"EmptyFusion": 0.0}
    inside = [p for p in cells if 0 <= p <= 1]
    if len(inside) < len(cells):
        moved = [min(max(p, 0.0), 1.0) for p in cells if not math.isnan(p)]
        return {"SkippedOutside": fused(inside), "ClampedIntoDomain": fused(moved)}
    x = [Fraction(p) for p in cells]
    if "error" in answer:
        return {"ContradictionAccepted": Fraction(1, 2), "MeanOccupancy": sum(x) / len(x), "Last": x[-1], "First": x[0],
                "Maximum": Fraction(1), "Product": Fraction(0)}
    p = fused(cells)
    found = {"MeanOccupancy": sum(x) / len(x), "Maximum": max(x), "Last": x[-1], "First": x[0], "Complement": 1 - p,
             "EqualOnce": fused(set(cells))}
    with ctx.workprec(2400):
        balls = [ball(q) for q in x]
        found["Product"], found["NoisyOr"] = arb(1), arb(1)
        for q in balls:
            found["Product"] *= q
            found["NoisyOr"] *= 1 - q
        found["NoisyOr"] = 1 - found["NoisyOr"]
        l = [traps.log_odds(q) for q in balls]
        if {0, 1} & set(cells):
            finite = [q if isinstance(q, arb) else arb(traps.clamped(q, -3.5, 3.5)) for q in l]
            return found | {"CertaintyOutvoted": traps.logistic(sum(finite, arb(0)))}
        total = sum(l, arb(0))
        state = arb(0)
        for q in l:
            state = traps.clamped(state + q, arb(-2), arb(3.5))
        found |= {
            "MeanLogOdds": traps.logistic(total / len(l)),
            "ClampedUpdates": traps.logistic(state),
            "ClampedOctoMap": traps.logistic(traps.clamped(total, arb(-2), arb(3.5))),
            "PriorCounted": traps.logistic(total + len(l) * traps.ln2()),
            "LogOddsBase2": traps.logistic(total * traps.ln2()),
            "LogOddsBase10": traps.logistic(total * arb(10).log()),
            "LogOddsSign": traps.logistic(-total),
            "ComplementOfLogistic": arb(1 - traps.nearest(1 - ball(p), format)) if total < -8 else None,
        }
        if len(cells) < 100:
            for name, store in traps.STORED.items():
                if name in ("PercentCut", "HalfPrecision"):  # small p are 0 there, which prevails over all else
                    continue
                odds = [traps.log_odds(store(q)) for q in balls]
                if all(isinstance(q, arb) for q in odds):
                    found[name] = traps.logistic(sum(odds, arb(0)))
    kind = KINDS[format]
    occupied = free = kind(1)
    with np.errstate(under="ignore"):
        for q in cells:
            occupied, free = kind(occupied * kind(q)), kind(free * (1 - kind(q)))
    if occupied == 0 == free:
        found["ProductUnderflow"] = traps.NAN
    elif occupied == 0 or free == 0:
        found["ProductUnderflow"] = 0.0 if occupied == 0 else 1.0
    found["FlushedToZero"] = traps.flushed(float(p), format)
    return found


def more_flags(cells, answer, format):
    if "error" in answer or not cells:
        return
    precision, lowest = FORMATS[format]
    normal = Fraction(2) ** (lowest + precision - 1)
    p = Fraction(answer["hi"])
    if any(0 < q < 2.0**-20 or 1 - 2.0**-20 < q < 1 for q in cells):
        yield "NearCertain"
    if 0 < p < normal or any(0 < Fraction(q) < normal for q in cells):
        yield "Subnormal"
    if 0 < p < Fraction(1, 2**30) or 1 - Fraction(1, 2**20) < p < 1:
        yield "Saturated"
    if 0 < abs(p - Fraction(1, 2)) < Fraction(1, 2**12):
        yield "NearHalf"
    if rounds_twice(Fraction(answer["lo"]), format):
        yield "RoundedTwice"
    if len(cells) >= 100:
        yield "ManyObservations"


def main():
    tests, seen = [], set()
    for format in FORMATS:
        for kind, cells, flag in lists(format, np.random.default_rng([20261127, FORMATS[format][0]])):
            args = {"cells": [hex_float(p) for p in cells]}
            if (format, str(args)) in seen:
                continue
            seen.add((format, str(args)))
            answer = {"error": "domain"} if flag == "Domain" else want(cells, format)
            flags = [flag] + [name for name in more_flags(cells, answer, format) if name != flag]
            test = {"id": label(OP, format, kind, args), "format": format, "args": args, "want": answer, "flags": flags}
            tests.append(traps.attach(test, known_mistakes(cells, answer, format)))
    write(OP, SOURCE, FLAGS, NOTES, tests)


if __name__ == "__main__":
    main()
