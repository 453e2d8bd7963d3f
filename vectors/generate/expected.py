#!/usr/bin/env python3
"""Writes vectors/v1/expected.mean_information.json: the mean information of the expected map of weighted particles.

The occupancy of a cell is rational; its information is enclosed by Arb, and mpmath's value of the definition must agree.
Needs python-flint, mpmath and numpy. The library has no part in it.
"""

import math
from fractions import Fraction

import numpy as np
from flint import arb, ctx

import cells as draw
import traps
from enclosures import ball, total, want
from exact import FORMATS, rounded
from operations import write
from text import KINDS, hex_float, label, neighbours
from trap_notes import NOTES

OP = "expected.mean_information"
SOURCE = "vectors/generate/expected.py: exact occupancies (Fraction), enclosures by Arb (python-flint); mpmath's sum of the definition agrees."
FLAGS = {
    "Listed": "A handful of cells to work out by hand.",
    "Random": "From a seeded generator: particles that agree but for noise, a half of the cells unknown to all.",
    "Mixed": "From a seeded generator: cells of all kinds, near 0, 1/2 and 1 too.",
    "Empty": "No cells, or none observed: 0.",
    "Single": "One particle of positive weight: the mean information of its map.",
    "UnknownToAll": "Has cells that are 1/2 in all particles: their mean is exactly 1/2, whatever the weights. Sum w (p - 1/2), not w p.",
    "CancelsToHalf": "Has cells that particles saw differently and that average to exactly 1/2: not observed.",
    "NextToHalf": "Has cells whose mean is so near 1/2 that its float may be 1/2: observed all the same.",
    "AllNearHalf": "The mean of every observed cell is within 2^-8 of 1/2: information cancels.",
    "NotNormalised": "Weights that do not add up to 1.",
    "ZeroWeight": "Particles of weight 0: they do not count.",
    "WideWeights": "Weights of very different magnitude, or subnormal, or so large that their sum overflows.",
    "LongSum": "1000 cells or more: naive sums lose digits.",
    "Order": "The particles of another test in another order, or the weights scaled by a power of two.",
    "Domain": "Weights negative, not finite, all zero, none, or not one for each particle; particles of different lengths; cells outside "
    "[0, 1]: the answer is the error `domain`.",
}


def expected_map(weights, particles):
    w = [Fraction(x) for x in weights]
    return [sum(a * Fraction(p) for a, p in zip(w, column)) / sum(w) for column in zip(*particles)]


def want_of(weights, particles):
    cells = [p for p in expected_map(weights, particles) if p != Fraction(1, 2)]
    if not cells:
        return want(Fraction(0), Fraction(0))
    return want(*(x / len(cells) for x in total("information", cells)))


def mean_of(cells):
    """The mean information over balls that are not 1/2."""
    seen = [p for p in cells if p != arb(1) / 2]
    return traps.ratio(sum((1 - traps.entropy(p) for p in seen), arb(0)), len(seen)) if seen else arb(0)


def blurred(weights, particles, format, normalise):
    """The mean by sums of floats; None if no float differs from the exact one by being observed."""
    kind = KINDS[format]
    with np.errstate(all="ignore"):
        w = [kind(x) for x in weights]
        weight = kind(0)
        for x in w:
            weight = kind(weight + x)
        if not (np.isfinite(weight) and weight > 0):
            return None
        if normalise:
            w = [kind(x / weight) for x in w]
        cells = []
        for column in zip(*particles):
            total = kind(0)
            for x, p in zip(w, column):
                total = kind(total + kind(x * kind(p)))
            cells.append(float(total if normalise else kind(total / weight)))
    return mean_of([arb(min(p, 1.0)) for p in cells])


def known_mistakes(weights, particles, format):
    exact = expected_map(weights, particles)
    half = arb(1) / 2
    with ctx.workprec(500):
        w = [ball(Fraction(x)) for x in weights]
        weight = sum(w, arb(0))
        maps = [[arb(p) for p in particle] for particle in particles]
        columns = list(zip(*maps))

        def pooled(w):
            weight = sum(w, arb(0))
            return [sum((a * p for a, p in zip(w, column)), arb(0)) / weight for column in columns]

        cells = [half if p == Fraction(1, 2) else ball(p) for p in exact]
        found = {name: value for name, value in traps.map_values("map.mean_information", cells).items()
                 if name in KEPT and isinstance(value, arb)}
        seen = sum(p != Fraction(1, 2) for p in exact)
        equal = len(set(weights)) == 1
        best = weights.index(max(weights))
        found["BestParticle"] = mean_of(maps[best])
        found["First"], found["Last"] = mean_of(maps[0]), mean_of(maps[-1])
        found["MeanOfMeans"] = sum((a * mean_of(m) for a, m in zip(w, maps)), arb(0)) / weight
        information = sum((a * (1 - traps.entropy(p)) for column in columns for a, p in zip(w, column)), arb(0)) / weight
        found["MeanOfInformation"] = traps.ratio(information, seen)
        if not equal:
            found["WeightsIgnored"] = mean_of(pooled([arb(1)] * len(w)))
            found["WeightsSquared"] = mean_of(pooled([a * a for a in w]))
        if max(weights) < 100:
            found["WeightsExponentiated"] = mean_of([half if all(p == 0.5 for p in c) else q for c, q in zip(zip(*particles), pooled([a.exp() for a in w]))])
        if abs(weight - 1) > 2.0**-20:
            # Weights normalised in floats show another mistake, if any.
            sums = [p * weight for p in cells]
            found["WeightsNotNormalised"] = traps.NAN if any(p > 1 for p in sums) else mean_of(sums)
        alone = [[(a, p) for a, p in zip(w, column) if p != half] for column in columns]
        found["UnknownSkipped"] = mean_of([sum((a * p for a, p in c), arb(0)) / sum((a for a, _ in c), arb(0))
                                           for c in alone if c and sum((a for a, _ in c), arb(0)) > 0])
        any_seen = sum(bool(c) for c in alone)
        found["ObservedByAny"] = traps.ratio(sum((1 - traps.entropy(p) for p in cells), arb(0)), any_seen) if any_seen else None
        if not any(p in (0, 1) for particle in particles for p in particle):
            odds = [[traps.log_odds(p) for p in column] for column in columns]
            pool = [sum((a * l for a, l in zip(w, c)), arb(0)) / weight for c in odds]
            found["MeanOfLogOdds"] = mean_of([traps.logistic(l) for l in pool])
            found["MrptExpectedMap"] = mean_of([traps.logistic(arb(math.trunc(traps.clamped(float(16 * l), -127, 127))) / 16) for l in pool])
            found["Fused"] = mean_of([traps.logistic(sum(c, arb(0))) for c in odds])
        for name, normalise in (("BlurredUnknown", True), ("BlurredQuotient", False)):
            found[name] = blurred(weights, particles, format, normalise)
        found["RoundedMean"] = mean_of([arb(rounded(p, format)) for p in exact])
        if len(maps) == len(exact) > 1:
            found["Transposed"] = mean_of([sum((a * p for a, p in zip(w, m)), arb(0)) / weight for m in maps])
    if not seen:
        found = {name: value for name, value in found.items() if value is not traps.NAN} | {"EmptyMap": traps.NAN}
    return found


KEPT = {
    "Nats", "OneMinusNats", "OneMinusHartleys", "Gini", "AbsoluteDeviation", "OneTerm", "DividedByAll", "UnknownInformative", "MrptThreshold",
    "ThresholdThousandth", "ThresholdHundredth", "SumForMean", "MixedMean", "Complement", "Percent", "Byte", "SinglePrecision",
}


def filtered(count, cells, format, rng):
    """Particles of one filter: a common map with noise, a half of the cells unknown to all, some to one alone."""
    truth = draw.mapped(cells, format, rng)
    particles = []
    for _ in range(count):
        noise = rng.normal(0, 0.1, cells)
        lost = rng.random(cells) < 0.1
        particles.append(draw.in_format([0.5 if p == 0.5 or gone else min(max(p + e, 0.01), 0.99)
                                         for p, e, gone in zip(truth, noise, lost)], format))
    return particles


def weighted(count, format, rng):
    """Normalised in floats, as filters do."""
    w = rng.random(count)
    return [float(x) for x in (w / w.sum()).astype(KINDS[format])]


def cases(format, rng):
    """(kind, weights, particles, flag)."""
    precision, lowest = FORMATS[format]
    kind = KINDS[format]
    smallest, largest, eps = 2.0**lowest, float(np.finfo(kind).max), 2.0**-precision
    third, fifth, tenth = (float(kind(x)) for x in (1 / 3, 0.2, 0.1))
    above = neighbours(0.5, format)[2]
    yield "listed", [0.75, 0.25], [[0.125, 0.875, 0.5, 0.5], [0.125, 0.125, 0.875, 0.5]], "Listed"
    yield "listed", [6.0, 2.0], [[0.125, 0.5, 0.5], [0.5, 0.5, 0.875]], "NotNormalised"
    yield "listed", [0.5, 0.5], [[0.0625, 0.25], [0.0625, 0.75]], "CancelsToHalf"
    yield "listed", [0.5, 0.5], [[0.25], [0.75]], "CancelsToHalf"
    yield "listed", [0.75, 0.25], [[0.375, 0.0], [0.875, 0.125]], "CancelsToHalf"
    yield "listed", [1.0, 2.0], [[0.0, 0.75, 1.0], [1.0, 0.75, 0.25]], "NotNormalised"
    yield "listed", [0.25, 0.75], [[0.0, 1.0], [1.0, 0.0]], "Listed"
    yield "listed", [2.0, 0.0], [[0.25, 0.5], [0.875, 0.125]], "ZeroWeight"
    yield "listed", [0.0, 3.0, 0.0], [[0.25, 0.5], [0.875, 0.125], [0.0, 1.0]], "ZeroWeight"
    yield "listed", [0.0, -0.0, 0.75], [[0.25], [0.875], [0.0625]], "ZeroWeight"
    yield "listed", [0.375, 0.625, 0.125], [[0.25, 0.75, 0.5]] * 3, "NotNormalised"
    yield "empty", [0.75], [[]], "Empty"
    yield "empty", [0.75, 0.25], [[], []], "Empty"
    yield "empty", [tenth] * 10, [[0.5] * 4] * 10, "Empty"
    yield "empty", [third, 2 * third], [[0.5]] * 2, "Empty"
    for w in (0.75, third, 3.0, smallest, largest):
        yield "single", [w], [draw.any_of(9, format, rng)], "Single"
        yield "single", [w], [draw.near_half(5, format, rng) + [0.5]], "Single"
    for count in (3, 5, 7, 10, 20):
        for _ in range(4):
            w = weighted(count, format, rng)
            yield "unknown", w, [[p, 0.5, 0.5, 0.5] for p in draw.in_format(rng.uniform(0.6, 0.9, count), format)], "UnknownToAll"
    yield "unknown", [tenth] * 10, [[0.875] + [0.5] * 12] * 10, "UnknownToAll"
    yield "unknown", [fifth, tenth, third, tenth], [[0.0] + [0.5] * 30] * 4, "UnknownToAll"
    for _ in range(6):
        # Opposite in pairs of equal weight; 1 - p is exact above 1/2.
        w = weighted(3, format, rng)
        rows = [draw.in_format(rng.uniform(0.5, 1, 6), format) for _ in range(3)]
        opposite = [[float(kind(1 - p)) for p in row[:3]] + row[3:] for row in rows]
        yield "cancels", w + w, rows + opposite, "CancelsToHalf"
    for e in (10, 20, precision - 2, precision + 5, 2 * precision, 3 * precision):
        w = 2.0**-e
        if w > smallest:
            yield "next-to-half", [1.0, w], [[0.25, 0.5, 0.5], [0.25, 0.5, 0.875]], "NextToHalf"
            yield "next-to-half", [0.75, w * 1.5, w], [[0.5, 0.5], [0.125, 0.75], [0.875, 0.5]], "NextToHalf"
            yield "next-to-half", [w, 0.875, w], [[0.25, 0.5], [0.5, 0.5], [0.5, 0.0]], "NextToHalf"
    yield "next-to-half", [0.5, 0.5], [[0.25, 0.0], [neighbours(0.75, format)[2], 0.125]], "NextToHalf"
    yield "next-to-half", [third, third, third], [[above, 0.125], [0.5, 0.25], [0.5, 0.125]], "NextToHalf"
    for count, cells in ((2, 5), (4, 20), (10, 30)):
        w = weighted(count, format, rng)
        yield "near-half", w, [draw.in_format(0.5 + 2.0**-9 * rng.uniform(-1, 1, cells), format) for _ in range(count)], "AllNearHalf"
        yield "near-half", w, [draw.near_half(cells, format, rng, precision - 2)[: cells - 2] + [0.5] * 2 for _ in range(count)], "Mixed"
    scales = [1.0, 2.0**-20, 2.0 ** -(precision + 3), smallest * 1000, 2.0 ** (precision + 1), largest / 4]
    for k in range(6):
        w = [float(kind(scale * x)) for scale, x in zip(scales[k:] + scales[:k], rng.uniform(0.5, 1, 3))]
        yield "wide", w, [draw.any_of(6, format, rng) for _ in range(3)], "WideWeights"
    yield "wide", [largest, largest, largest], [[0.25, 0.5, 0.75], [0.125, 0.5, 0.375], [0.25, 0.5, 1.0]], "WideWeights"
    yield "wide", [smallest, 3 * smallest], [[0.25, 0.5, 0.75], [0.125, 0.5, 0.375]], "WideWeights"
    for count, cells in ((2, 10), (3, 15), (5, 20), (8, 12), (20, 10), (6, 6), (3, 40)):
        for _ in range(3):
            w = weighted(count, format, rng)
            yield "random", w, filtered(count, cells, format, rng), "Random"
            yield "mixed", w, [draw.any_of(cells, format, rng) for _ in range(count)], "Mixed"
            yield "not-normalised", [float(kind(x * 5)) for x in w], filtered(count, cells, format, rng), "NotNormalised"
    w, rows = weighted(6, format, rng), filtered(6, 12, format, rng)
    yield "order", w, rows, "Random"
    yield "order", w[::-1], rows[::-1], "Order"
    order = rng.permutation(6)
    yield "order", [w[k] for k in order], [rows[k] for k in order], "Order"
    for scale in (2.0**-60, 2.0**60):
        yield "order", [x * scale for x in w], rows, "Order"
    yield "long", [0.625, 0.375], [draw.short(1000, rng) for _ in range(2)], "Mixed"
    yield "long", [third, fifth], [[0.5 if k % 3 else p for k, p in enumerate(draw.short(1000, rng))] for _ in range(2)], "UnknownToAll"
    row = [0.25, 0.5]
    for bad in (math.nan, math.inf, -math.inf, -0.25, -smallest):
        yield "domain", [bad], [row], "Domain"
        yield "domain", [0.75, bad], [row, row], "Domain"
    for bad in draw.BAD:
        yield "domain", [0.75, 0.25], [row, [0.25, bad]], "Domain"
        yield "domain", [0.75, 0.0], [row, [0.25, bad]], "Domain"
    yield "domain", [0.0, 0.0], [row, row], "Domain"
    yield "domain", [0.0], [[]], "Domain"
    yield "domain", [], [], "Domain"
    yield "domain", [0.75, 0.25], [row, [0.25]], "Domain"
    yield "domain", [0.75, 0.25], [row, [0.25, 0.5, 0.75]], "Domain"
    yield "domain", [0.75], [row, row], "Domain"
    yield "domain", [0.75, 0.25], [row], "Domain"


def more_flags(weights, particles):
    exact = expected_map(weights, particles)
    half = Fraction(1, 2)
    unknown = [all(p == 0.5 for p in column) for column in zip(*particles)]
    if any(unknown) and not all(unknown):
        yield "UnknownToAll"
    if any(p == half and not u for p, u in zip(exact, unknown)):
        yield "CancelsToHalf"
    if any(0 < abs(p - half) < Fraction(1, 2**22) for p in exact):
        yield "NextToHalf"
    if all(abs(p - half) < Fraction(1, 2**8) for p in exact) and any(p != half for p in exact):
        yield "AllNearHalf"
    if len(exact) >= 1000:
        yield "LongSum"


def main():
    tests, seen = [], set()
    for format in FORMATS:
        for kind, weights, particles, flag in cases(format, np.random.default_rng([20261128, FORMATS[format][0]])):
            args = {"weights": [hex_float(w) for w in weights], "particles": [[hex_float(p) for p in m] for m in particles]}
            if (format, str(args)) in seen:
                continue
            seen.add((format, str(args)))
            test = {"id": label(OP, format, kind, args), "format": format, "args": args}
            if flag == "Domain":
                tests.append(test | {"want": {"error": "domain"}, "flags": [flag]})
                continue
            test["want"] = want_of(weights, particles)
            test["flags"] = [flag] + [name for name in more_flags(weights, particles) if name != flag]
            tests.append(traps.attach(test, known_mistakes(weights, particles, format)))
    write(OP, SOURCE, FLAGS, NOTES, tests)


if __name__ == "__main__":
    main()
