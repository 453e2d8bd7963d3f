#!/usr/bin/env python3
"""Writes vectors/v1/map.*.json: entropy, information, their mean, and the number of observed cells of lists of occupancies.

Needs python-flint, mpmath and numpy. The library has no part in it: the enclosures are Arb's, and mpmath's sum of the
definition must agree with each to 60 digits.
"""

from fractions import Fraction

import numpy as np

import cells as draw
import traps
from enclosures import total, want
from exact import FORMATS
from operations import write
from text import hex_float, label, neighbours
from trap_notes import NOTES

OPS = ("map.entropy", "map.information", "map.mean_information", "map.observed")
SOURCE = "vectors/generate/map.py: enclosures by Arb (python-flint); mpmath's sum of the definition agrees."
FLAGS = {
    "Listed": "A handful of cells to work out by hand.",
    "Random": "From a seeded generator: all kinds of cells mixed.",
    "Mapped": "From a seeded generator: as maps are, a half unknown and the rest mostly sure.",
    "Empty": "No cells at all, or none observed: 0, not 0/0.",
    "Unknown": "Has cells with p = 1/2: each has 1 bit of entropy, no information, and is not observed.",
    "NextToHalf": "Has cells within 2^-20 of 1/2, but not at it: they are observed. No threshold, and no equality up to some epsilon.",
    "AllNearHalf": "All observed cells are near 1/2: 1 - H cancels, and the sum must be as near as 2 ulp of itself.",
    "Certain": "Has cells with p = 0 or 1: 0 log 0 is 0, and they are observed.",
    "NearCertain": "Has cells within 2^-20 of 0 or 1: log1p, and no clamping.",
    "Subnormal": "Has subnormal cells: not flushed to zero.",
    "SmallBesideLarge": "Many small terms beside a large one: added one by one to the large one they are lost.",
    "LongSum": "1000 cells or more: naive sums, and all in single precision, lose digits. Sum in pairs, compensated or exactly.",
    "Order": "The cells of another test in another order, or twice.",
    "Domain": "A cell is NaN or outside [0, 1]: the answer is the error `domain`.",
}


def lists(format, rng):
    """(kind, cells, flag)."""
    precision, lowest = FORMATS[format]
    smallest, eps = 2.0**lowest, 2.0**-precision
    below, above = (neighbours(0.5, format)[k] for k in (1, 2))
    listed = [
        [0.25], [0.75], [0.0], [1.0], [-0.0], [0.0, 1.0], [0.25, 0.75, 0.5], [0.125, 0.5, 0.5, 0.5], [0.25, 0.25], [0.9375, 0.0625],
        [0.0, 0.5, 1.0], [0.375, 0.5], [0.625] * 3, [0.25, 0.5, 0.875, 0.0, 1.0], [0.75, 0.75, 0.5, 0.125], [0.4375], [0.5078125],
        [0.0, 0.25], [1.0, 0.25], [0.0, 0.0, 0.375], [1.0, 1.0, 0.5, 0.3125],
    ]
    listed += [draw.in_format(x, format) for x in ([0.1, 0.5, 0.9], [0.3, 0.7], [0.499, 0.501, 0.5], [0.4995, 0.5005], [0.2, 0.19, 0.65, 0.66])]
    for x in listed:
        yield "listed", x, "Listed"
    for n in (0, 1, 2, 7, 40):
        yield "unknown", [0.5] * n, "Empty"
    for p in (below, above, 0.5 - 4 * eps, 0.5 + 2.0**-11, 0.5 - 2.0**-18):
        yield "next-to-half", [p], "NextToHalf"
        yield "next-to-half", [0.5, p, 0.5], "NextToHalf"
        yield "next-to-half", [0.25, p], "NextToHalf"
    for n in (2, 5, 12, 30):
        yield "near-half", draw.near_half(n, format, rng, 12), "AllNearHalf"
        yield "near-half", draw.near_half(n, format, rng), "AllNearHalf"
        yield "near-half", draw.near_half(n, format, rng) + [0.5] * n, "AllNearHalf"
    yield "near-half", draw.in_format(0.5 + 2.0**-12 * rng.uniform(-1, 1, 1000).round(3), format), "AllNearHalf"
    for p in (smallest, 3 * smallest, 2.0**-40, 1 - eps, 1 - 4 * eps):
        yield "edge", [p], "Listed"
        yield "edge", [p, 0.5, p, p], "Listed"
    for n in (3, 10, 30):
        yield "small", draw.near_zero(n, format, rng), "Random"
        yield "large", draw.near_one(n, format, rng), "Random"
    # One cell of a bit, then terms each below half an ulp of the sum, of entropy and of information.
    yield "small-beside-large", [0.5] + [2.0 ** -(precision + 8)] * 600, "SmallBesideLarge"
    yield "small-beside-large", [0.0] + [0.5 + 2.0 ** -((precision + 4) // 2)] * 600, "SmallBesideLarge"
    yield "small-beside-large", [0.25] * 2 + draw.near_half(30, format, rng, precision // 2 + 2), "SmallBesideLarge"
    count = {"f64": 24, "f32": 24}[format]
    for _ in range(count):
        yield "random", draw.any_of(int(rng.integers(1, 40)), format, rng), "Random"
        yield "mapped", draw.mapped(int(rng.integers(1, 40)), format, rng), "Mapped"
    shuffled = draw.any_of(25, format, rng)
    yield "order", shuffled, "Random"
    for _ in range(3):
        yield "order", [shuffled[k] for k in rng.permutation(25)], "Order"
    yield "order", shuffled * 2, "Order"
    yield "order", shuffled[::-1], "Order"
    # Few bits, so that the files stay small.
    for n in {"f64": (1000,), "f32": (4000,)}[format]:
        yield "long", draw.short(n, rng), "Random"
    yield "long", [round(256 * p) / 256 for p in draw.mapped(1000, format, rng)], "Mapped"
    # Equal cells: the errors of a naive sum have one sign.
    yield "long", [0.125] * 1500, "Listed"
    yield "long", [0.625] * 1000 + [0.5] * 100, "Listed"
    # 1000 bits, then terms each below half an ulp of that in single precision.
    yield "small-beside-large", [0.5] * 1000 + [1.5 * 2.0**-20] * 1000, "SmallBesideLarge"
    yield "small-beside-large", [0.0] * 1000 + [0.5 + 0.75 * 2.0**-8] * 1000, "SmallBesideLarge"
    for x in ([smallest, 5 * smallest, 1000 * smallest], [7 * smallest] * 2, [2.0 ** (lowest + precision - 2)] * 3):
        yield "edge", x, "Subnormal"
    for bad in draw.BAD:
        yield "domain", [bad], "Domain"
        yield "domain", [0.25, 0.5, bad, 0.875], "Domain"
    yield "domain", [0.25, neighbours(1, format)[2]], "Domain"
    yield "domain", [0.5, -smallest], "Domain"


def more_flags(cells):
    if 0.5 in cells:
        yield "Unknown"
    if any(0 < abs(p - 0.5) < 2.0**-20 for p in cells):
        yield "NextToHalf"
    if 0 in cells or 1 in cells:
        yield "Certain"
    if any(0 < p < 2.0**-20 or 1 - 2.0**-20 < p < 1 for p in cells):
        yield "NearCertain"
    if len(cells) >= 1000:
        yield "LongSum"


def wants(cells):
    """Those of all four operations."""
    exact = [Fraction(p) for p in cells]
    observed = sum(p != 0.5 for p in cells)
    entropy, information = (total(kind, exact) for kind in ("entropy", "information"))
    mean = [x / observed for x in information] if observed else [Fraction(0)] * 2
    return dict(zip(OPS, [want(*entropy), want(*information), want(*mean), {"count": observed}]))


def main():
    tests, seen = {op: [] for op in OPS}, set()
    for format in FORMATS:
        for kind, cells, flag in lists(format, np.random.default_rng([20261126, FORMATS[format][0]])):
            args = {"cells": [hex_float(p) for p in cells]}
            if (format, str(args)) in seen:
                continue
            seen.add((format, str(args)))
            flags = [flag]
            if flag != "Domain":
                flags += [name for name in more_flags(cells) if name != flag]
                if flag != "Subnormal" and any(0 < p < 2.0 ** (sum(FORMATS[format]) - 1) for p in cells):
                    flags.append("Subnormal")
            answers = wants(cells) if flag != "Domain" else {}
            for op, found in tests.items():
                if op == "map.observed" and len(cells) > 1100:
                    continue  # a count has no digits to lose
                test = {"id": label(op, format, kind, args), "format": format, "args": args, "flags": flags}
                test["want"] = answers.get(op, {"error": "domain"})
                wrong = traps.of_map(op, [Fraction(p) for p in cells], format) if answers else traps.of_bad_map(op, cells)
                found.append(traps.attach(test, wrong))
    for op, found in tests.items():
        write(op, SOURCE, FLAGS, NOTES, found)


if __name__ == "__main__":
    main()
