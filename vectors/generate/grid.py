#!/usr/bin/env python3
"""Writes vectors/v1/grid.*.json: the mean information of the polar and the Cartesian grid of a circular room.

The cells are enumerated in exact integers, their information is enclosed by Arb, and mpmath's loop over the definition must
agree. Needs python-flint, mpmath and numpy. The library has no part in it.
"""

import math
import sys
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
from flint import arb, ctx

sys.path.insert(0, str(Path(__file__).parent.parent.parent / "proofs"))
import limit_exact  # noqa: E402
import room_traps  # noqa: E402
import traps  # noqa: E402
from enclosures import bounds, want, within  # noqa: E402
from exact import FORMATS, exponent_of_ulp  # noqa: E402
from operations import write  # noqa: E402
from room import BITS, Room, cartesian, defined, polar, root  # noqa: E402
from text import KINDS, hex_float, neighbours  # noqa: E402
from trap_notes import NOTES  # noqa: E402

SOURCE = "vectors/generate/grid.py: cells in exact integers, enclosures by Arb (python-flint); mpmath's loop over the definition agrees."
FLAGS = {
    "Listed": "A room as in the report.",
    "Random": "From a seeded generator: rooms of centimetres to 100 metres in cells of all sizes.",
    "Boundary": "A cell's centre is so near the place where p is 1/2 that roundings decide whether it is observed: the counts that "
    "rounding otherwise gives are accepted too.",
    "Coarse": "Fewer than 10 observed cells: each counts.",
    "Empty": "No cell is observed: 0.",
    "Peak": "A cell lies on the obstacle, rho = z up to rounding: p = 1, 0 log 0.",
    "Tie": "Distances that are midpoints of two floats, or exact (3, 4, 5): rounded before they are squared they miss.",
    "ManyCells": "2000 observed cells or more: sums in single precision, or one by one, lose digits.",
    "NarrowPeak": "range / sigma above 500: few cells differ from 0.",
    "WideSensor": "range below 2 sigma: all cells are uncertain, and none is certainly free.",
    "Offset": "Offsets other than 0 and 1/2: no mirror symmetry.",
    "OffsetNegative": "Negative offsets, or of many cells: whole cells change nothing, and their fractions are to be kept.",
    "Scaled": "range, sigma and resolution of another test times a power of two: the same answer. Squares of distances overflow or "
    "underflow if they are not scaled.",
    "Domain": "range, sigma or resolution not positive and finite, or an offset not finite: the answer is the error `domain`.",
}
# Rigorous bounds are summed in balls and cut to tenths upwards.
TENTHS = 10


def tolerance(change, mean, format):
    """2 ulp, and what correct roundings of distance and occupancy can change, in ulp of the answer."""
    if not mean:
        return 2
    # The answer may be in the binade below.
    ulp = Fraction(2) ** exponent_of_ulp(mean * (1 - Fraction(1, 2**10)), format)
    return 2 + math.ceil(TENTHS * change / ulp) / TENTHS


def sums_of(count, lo, hi, doubtful):
    """All maps that doubts allow, each as its number of observed cells and the bounds of its sum; the first is the convention."""
    found = [(count, lo, hi)]
    for n, observed, (least, most) in doubtful:
        without, having = found, [(count + n, lo + least, hi + most) for count, lo, hi in found]
        found = having + without if observed else without + having
    return found


def evaluate(kind, format, z, s, h, x, y):
    """The test's want, also, tolerance and the number of cells; None if there are too many answers."""
    exact = [Fraction(v) for v in (z, s, h, x, y)]
    places = polar(*exact[:3]) if kind == "polar" else cartesian(*exact)
    room = Room(z, s, format)
    with ctx.workprec(BITS):
        total, certain, change, sure, convention, doubts, tie = arb(0), arb(0), arb(0), 0, 0, [], False
        for squared, n in places.items():
            observed, doubtful, value, moved = room.judge(squared)
            total, change = total + n * value, change + n * moved
            convention += n * observed
            if doubtful:
                doubts.append((n, observed, bounds(n * value)))
            else:
                sure, certain = sure + n * observed, certain + n * value
            if n > 1 and not tie and room.z / 4 < root_or_zero(squared):
                tie = True
        lo, hi = (max(end, Fraction(0)) for end in bounds(total))
        sums = sums_of(sure, *(max(end, Fraction(0)) for end in bounds(certain)), doubts)
        value, _ = defined(kind, z, s, h, x, y)
    with mpmath.workprec(200):
        if hi > 0:
            within(lo, hi, value, Fraction(1, 2**120))
    answers = []
    for n, low, high in sums:
        answer = want(low / n, high / n) if n else want(Fraction(0), Fraction(0))
        if answer not in answers:
            answers.append(answer)
    if len(answers) > 12:
        return None
    counts = [n for n, _, _ in sums]
    least = lo / max(counts) if max(counts) else Fraction(0)
    moved = bounds(change)[1] / min(n for n in counts if n) if least else 0
    return answers, tolerance(moved, least, format), convention, bool(doubts), tie


def root_or_zero(squared):
    return root(squared) or Fraction(0)


def on_the_edge(format, h, squared, sigma, side):
    """A range so that the cells at this squared distance (in cells) are next to the edge (1) or to where p rises to 1/2 (-1)."""
    with mpmath.workprec(200):
        rho = mpmath.mpf(float(h)) * mpmath.sqrt(mpmath.mpf(squared.numerator) / squared.denominator)
        z = rho - side * mpmath.mpf(float(sigma)) * mpmath.sqrt(2 * mpmath.log(2))
        return float(KINDS[format](float(z)))


def shared(format, rng, coarsest):
    """(range, sigma, resolution, flag) for both grids."""
    kind = KINDS[format]
    for z, s in [(2, 0.2), (2, 0.1), (0.5, 0.01), (5, 0.2), (0.75, 0.5), (3, 0.25)]:
        for cells in coarsest:
            yield kind(z), kind(s), kind((z + 1.1774 * s) / cells * 0.97), "Listed"
    for z, s in [(0.75, 1.5), (0.3, 2.5), (1, 0.75)]:
        for cells in coarsest[:-1]:
            yield kind(z), kind(s), kind((z + 1.1774 * s) / cells), "WideSensor"
    for z, s in [(4, 0.005), (10, 0.01), (30, 0.02)]:
        yield kind(z), kind(s), kind(z / coarsest[-1]), "NarrowPeak"
        yield kind(z), kind(s), kind(z / coarsest[1] * 2 / 2), "NarrowPeak"
    count = {"f64": 26, "f32": 18}[format]
    ranges, alphas = np.exp(rng.uniform(-3, 4.5, count)), np.exp(rng.uniform(0, 6, count))
    for z, a, cells in zip(ranges, alphas, np.exp(rng.uniform(0, np.log(coarsest[-1]), count))):
        yield kind(z), kind(z / a), kind(z / cells), "Random"
    scales = (-1000, -500, 1000) if format == "f64" else (-110, 110)
    for e in (0, *scales):
        yield *(kind(math.ldexp(v, e)) for v in (2.0, 0.25, 0.1875)), "Scaled" if e else "Listed"


def polar_cases(format, rng):
    kind = KINDS[format]
    for case in shared(format, rng, (3, 7, 20, 60, 200, 800)):
        yield *case, 0.0, 0.0
    for z, s, h in [(2, 0.2, 0.00125), (3, 0.75, 0.002), (10, 0.25, 0.001)]:
        yield kind(z), kind(s), kind(h), "ManyCells", 0.0, 0.0
    for z, s, h in [(0.5, 0.125, 5), (0.5, 0.125, 1.3), (2, 0.2, 1000), (2, 0.2, 4.5)]:
        yield kind(z), kind(s), kind(h), "Empty", 0.0, 0.0
    for k in range(4):
        yield kind(0.25 * (k + 0.5)), kind(0.125), kind(0.25), "Peak", 0.0, 0.0
    for n in range(14):
        h, s = kind(rng.uniform(0.02, 0.3)), kind(rng.uniform(0.05, 0.3))
        k, side = int(rng.integers(6, 60)), (1, -1)[n % 2]
        z = on_the_edge(format, h, Fraction((2 * k + 1) ** 2, 4), s, side)
        for z in neighbours(z, format, 1) + neighbours(z, format, 12)[-1:]:
            if z > 0:
                yield z, s, h, "Boundary", 0.0, 0.0


def cartesian_cases(format, rng):
    kind = KINDS[format]
    for n, case in enumerate(shared(format, rng, (1.5, 4, 10, 22))):
        flag = case[3]
        offsets = [(0.0, 0.0), (0.5, 0.5), (0.0, 0.5)]
        if flag in ("Listed", "WideSensor"):
            offsets = offsets[n % 3 :][:1] + [(float(kind(rng.uniform(-0.5, 0.5))), float(kind(rng.uniform(-0.5, 0.5))))]
        elif flag != "Scaled":
            offsets = [(float(kind(rng.uniform(-0.5, 0.5))), 0.25), offsets[n % 3]][: 1 + n % 2]
        for x, y in offsets:
            yield *case, x, y
    for z, s, h, x, y in [(2, 0.2, 0.08, 0.5, 0.5), (2, 0.2, 0.05, 0.0, 0.0), (2, 0.25, 0.05, 0.25, 0.0), (3, 0.75, 0.1, 0.3, 0.7)]:
        yield kind(z), kind(s), kind(h), "ManyCells", float(kind(x)), float(kind(y))
    if format == "f64":
        yield 2.0, 0.2, 0.03, "ManyCells", 0.5, 0.5
        yield 5.0, 0.2, 0.07, "ManyCells", 0.0, 0.0
    else:
        yield kind(2), kind(0.2), kind(0.03), "ManyCells", 0.0, 0.0
    for h in (1.1, 5, 1000):
        yield kind(0.5), kind(0.125), kind(h), "Empty", 0.5, 0.5
        yield kind(0.5), kind(0.125), kind(h), "Coarse", 0.0, 0.0
        yield kind(0.5), kind(0.125), kind(h), "Coarse", 0.0, 0.25
    # 5, 13, 17 and 25 of Pythagoras; 0.05 (3, 4, 5).
    for z, h in [(5, 1), (0.25, 0.05), (13, 1), (3.25, 0.25), (17, 1), (1.25, 0.25)]:
        yield kind(z), kind(z / 8), kind(h), "Tie", 0.0, 0.0
    tenth = float(kind(0.1))
    for x, y in [(-0.25, 0.75), (7.25, -3.0), (1000.125, 0.375), (-2.0**20 - 0.5, 2.0**18), (tenth, -tenth), (1 - 2.0 ** -FORMATS[format][0], 0.25),
                 (2.0 ** -FORMATS[format][0], 0.0), (-(2.0**-60), 2.0**-70), (2.0 ** (FORMATS[format][0] + 20), -0.0)]:
        yield kind(2), kind(0.2), kind(0.3), "OffsetNegative", x, y
        yield kind(0.75), kind(0.25), kind(0.125), "OffsetNegative", y, x
    for n in range(16):
        h, s = kind(rng.uniform(0.05, 0.3)), kind(rng.uniform(0.05, 0.3))
        i, j, side = int(rng.integers(3, 14)), int(rng.integers(0, 14)), (1, -1)[n % 2]
        x, y = [(0.0, 0.0), (0.5, 0.5), (0.25, 0.0), (float(kind(0.3)), float(kind(0.1)))][n // 2 % 4]
        squared = (i + Fraction(x)) ** 2 + (j + Fraction(y)) ** 2
        z = on_the_edge(format, h, squared, s, side)
        for z in neighbours(z, format, 1)[: 1 + n % 2] + neighbours(z, format, 12)[-1:]:
            if z > 0:
                yield z, s, h, "Boundary", x, y


def domain(kind):
    for bad in (0.0, -0.0, -0.25, math.nan, math.inf, -math.inf):
        for place in range(3):
            args = [0.75, 0.125, 0.25]
            args[place] = bad
            yield *args, "Domain", 0.0, 0.5
    if kind == "cartesian":
        for bad in (math.nan, math.inf, -math.inf):
            yield 0.75, 0.125, 0.25, "Domain", bad, 0.0
            yield 0.75, 0.125, 0.25, "Domain", 0.25, bad


def more_flags(z, s, h, x, y, kind, count, doubtful, tie):
    if doubtful:
        yield "Boundary"
    if not count:
        yield "Empty"
    elif count < 10:
        yield "Coarse"
    if count >= 2000:
        yield "ManyCells"
    if z > 500 * s:
        yield "NarrowPeak"
    if z < 2 * s:
        yield "WideSensor"
    if kind == "cartesian":
        if (x % 1, y % 1) not in ((0, 0), (0.5, 0.5), (0, 0.5), (0.5, 0)):
            yield "Offset"
        if tie:
            yield "Tie"


def make(kind):
    op = f"grid.{kind}.mean_information"
    cases = {"polar": polar_cases, "cartesian": cartesian_cases}[kind]
    tests, seen = [], set()
    for format in FORMATS:
        rng = np.random.default_rng([20261129, FORMATS[format][0], kind == "polar"])
        for *numbers, flag, x, y in [*cases(format, rng), *domain(kind)]:
            z, s, h, x, y = map(float, (*numbers, x, y))
            names = ("range", "sigma", "resolution", "offset_x", "offset_y")[: 3 if kind == "polar" else 5]
            args = dict(zip(names, map(hex_float, (z, s, h, x, y))))
            key = f"{op}/{format}/{','.join(args.values())}"
            if key in seen:
                continue
            seen.add(key)
            test = {"id": key, "format": format, "args": args}
            if flag == "Domain":
                tests.append(test | {"want": {"error": "domain"}, "flags": [flag]})
                continue
            answer = evaluate(kind, format, z, s, h, x, y)
            if answer is None:
                continue
            wants, allowed, count, doubtful, tie = answer
            if flag == "Boundary" and not doubtful:
                flag = "Random"
            test["want"] = wants[0]
            if wants[1:]:
                test["also"] = wants[1:]
            if allowed > 2:
                test["tolerance_ulp"] = allowed
            test["flags"] = [flag] + [name for name in more_flags(z, s, h, x, y, kind, count, doubtful, tie) if name != flag]
            if count <= 3000 and 2.0**-100 < z < 2.0**100:
                with ctx.workprec(320):
                    limits = [float(value) for value in limit_exact.at(arb(z) / arb(s))]
                traps.attach(test, room_traps.known_mistakes(kind, z, s, h, x, y, limits))
            tests.append(test)
    write(op, SOURCE, FLAGS, NOTES, tests)


if __name__ == "__main__":
    make("polar")
    make("cartesian")
