#!/usr/bin/env python3
"""Writes vectors/v1/cell.*.json: edges, near-ties and seeded random arguments, with rigorous enclosures of the exact values.

Needs python-flint, mpmath and numpy. The library has no part in it: the enclosures are Arb's, and mpmath's value from the
definition must lie in each.
"""

import math
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np

from exact import DEFINE, FORMATS, enclosure, hardness, rounded, rounds_twice
import traps
from enclosures import want_nearest
from operations import write
from text import DIGITS, KINDS, decimal, hex_float, neighbours
from trap_notes import NOTES

HERE = Path(__file__).parent
RANDOM = {"f64": 700, "f32": 300}

FLAGS = {
    "Edge": "An end of the domain, of a format or of a formula, or a neighbour of one.",
    "NearTie": "Found by a search: the exact value is within 2^-20 ulp of a float or of a midpoint, mostly far closer.",
    "Random": "From a seeded generator, all magnitudes.",
    "Domain": "Outside the domain: the answer is the error `domain`, or NaN from a plain function of floats.",
    "Limit": "The result is exact.",
    "NearHalf": "p within 1/16 of 1/2, or |l| below 1/4: in information 1 - H cancels; a series in 2p - 1, or in l, does not.",
    "NearCertain": "p within 2^-10 of 0 or 1: log(1-p) after 1-p is rounded loses the smaller term; log1p(-p) keeps it.",
    "Certain": "p = 0 or 1: 0 log 0 is 0.",
    "Subnormal": "The argument or the result is below the normal floats: not flushed to zero, rounded once.",
    "LargeLogOdds": "|l| above 30: p is 0 or 1 up to its last bits. What passes through a rounded p, or 1 - p, saturates.",
    "RoundedTwice": "f32, and the float nearest to the f64 answer is another: do not round twice. All there are.",
    "Overflow": "e^|l| overflows: use e^-|l|.",
    "Infinite": "l infinite: p is 0 or 1, as for all large l.",
    "Negative": "Negative log-odds: p below 1/2, and its digits are those of e^l.",
}
SOURCE = "vectors/generate/cell.py: enclosures by Arb (python-flint), which contain mpmath's value of the definition."
FUNCTIONS = ("entropy", "information", "entropy_from_log_odds", "information_from_log_odds", "occupancy_from_log_odds")


def limit(function, x):
    """The value where it is exact, or None."""
    if function.endswith("odds"):
        if x != 0 and not math.isinf(x):
            return None
        certain, occupancy = x != 0, Fraction(1, 2) if x == 0 else Fraction(x > 0)
    else:
        if x not in (0, 0.5, 1):
            return None
        certain, occupancy = x != 0.5, None
    kind = function.split("_")[0]
    return {"entropy": Fraction(not certain), "information": Fraction(certain), "occupancy": occupancy}[kind]


def want(function, format, x):
    """The enclosure: 40 digits, or as many as decide the rounding and 20 more."""
    exact = limit(function, x)
    if exact is not None:
        text = decimal(exact, DIGITS, up=False)
        return {"lo": text, "hi": text}
    bounds = enclosure(function, x)
    value = DEFINE[function](mpmath.mpf(max(-4096.0, min(x, 4096.0))))
    value, slack = Fraction(int(mpmath.nint(mpmath.ldexp(value, 2700))), 2**2700), Fraction(1, 2**2600)
    assert bounds[0] - slack <= value <= bounds[1] + slack, (function, x)

    return want_nearest(*bounds, format)


def edges(of_odds, format):
    precision, lowest = FORMATS[format]
    smallest, normal = 2.0**lowest, 2.0 ** (lowest + precision - 1)
    ends = [smallest, 3 * smallest, 1000 * smallest, normal / 2, normal - smallest, normal, 4.5 * normal]
    if not of_odds:
        around = [1 / 2, 1 / 4, 2**-8, 1 - 2**-8, 15 / 32, 17 / 32, 2**-7, 2**-9, 2**-17, 2**-18, 2**-19, 2.0**-precision]
        around += [0.5 + s * 2.0**-k for k in range(2, precision) for s in (-1, 1)]
        around += [1 - 2.0**-k for k in range(2, precision + 1)]
        around += [0.1, 0.9, 0.3, 0.7, 0.11002786443835955]
        found = ends + [y for x in around for y in neighbours(x, format)]
        return [x for x in found if 0 < x < 1]
    largest = float(np.finfo(KINDS[format]).max)
    around = [2.0**k for k in range(-30, 12)]
    # Multiples of ln 2, where e^-l takes a new exponent; 8 of them end one formula. Where results become subnormal, and 0.
    around += [k * math.log(2) for k in (1, 2, 7, 8, 9, 24, 25, 53, 54, 55, 126, 149, 150, 1022, 1074, 1075)]
    around += [104, 108.66, 110, 714.9, 745.1332191019411, 745.1332191019412, 752.1239618607586, 1477, 1e30]
    around += [2.0**-37, 2.0**-63, 2.0**-74, 2.0**-75] if format == "f32" else [2.0**-511, 2.0**-512, 2.0**-536, 2.0**-537]
    around += [k / 16 for k in range(1, 128, 9)]
    found = ends + [y for x in around for y in neighbours(x, format)] + [largest, neighbours(largest, format)[1]]
    return [s * x for x in found for s in (1, -1)]


def random_arguments(of_odds, format, rng):
    """A half as maps hold them, a half of all magnitudes."""
    n = RANDOM[format] // 2
    kind = KINDS[format]
    precision, lowest = FORMATS[format]
    if of_odds:
        drawn = np.concatenate([rng.normal(0, 4, n), rng.choice([-1, 1], n) * np.exp2(rng.uniform(lowest, 10.5, n))])
    else:
        drawn = np.concatenate([rng.uniform(0, 1, n), np.exp2(rng.uniform(lowest, -1, n))])
    return [float(x) for x in drawn.astype(kind)]


def near_ties(function, format):
    """Arguments from the searches. Those of f32 are what f64 enclosures leave undecided among all floats."""
    found = []
    if format == "f64":
        for line in (HERE / "near_ties_f64.txt").read_text().splitlines():
            name, x, _ = line.split()
            if name == function:
                found.append(float.fromhex(x))
        return found
    for line in (HERE / "near_ties_f32.txt").read_text().splitlines():
        name, bits = line.removeprefix("near-tie ").rsplit(" ", 1)
        x = float(np.array(int(bits, 16), np.uint32).view(np.float32))
        if name.split()[0] == function:
            found.append(-x if name.endswith("minus") else x)
    exact = {x: enclosure(function, x)[0] for x in found}
    found.sort(key=lambda x: -hardness(exact[x], format))
    return found[:60] + [x for x in found[60:] if rounds_twice(exact[x], format)]


def more_flags(of_odds, x, answer, format):
    """What the numbers show."""
    if "error" in answer:
        return
    precision, lowest = FORMATS[format]
    normal = Fraction(2) ** (lowest + precision - 1)
    size = abs(x)
    if 0 < size < 0.25 if of_odds else 0 < abs(x - 0.5) < 0.0625:
        yield "NearHalf"
    if not of_odds and (0 < x < 2.0**-10 or 1 - 2.0**-10 < x < 1):
        yield "NearCertain"
    if not of_odds and x in (0, 1):
        yield "Certain"
    if 0 < size < normal or 0 < Fraction(answer["hi"]) < normal:
        yield "Subnormal"
    if rounds_twice(Fraction(answer["lo"]), format):
        yield "RoundedTwice"
    if of_odds:
        if math.isinf(x):
            yield "Infinite"
        elif size > 30:
            yield "LargeLogOdds"
        if size > {"f64": 709.8, "f32": 88.8}[format]:
            yield "Overflow"
        if x < 0:
            yield "Negative"


def known_mistakes(function, x, answer, format):
    if "error" in answer:
        moved = function in ("entropy", "information") and not math.isnan(x)
        return {"ClampedIntoDomain": float(function == "information")} if moved else {}
    kind, of_odds = function.split("_")[0], function.endswith("odds")
    result = rounded(Fraction(answer["lo"]), format)
    return (traps.of_log_odds if of_odds else traps.of_occupancy)(kind, x, format, result)


def make(function):
    of_odds = function.endswith("odds")
    name = "l" if of_odds else "p"
    tests, seen = [], set()

    def add(format, x, flag, answer=None):
        key = f"{function}/{format}/{hex_float(x)}"
        if key not in seen:
            seen.add(key)
            answer = answer or want(function, format, x)
            flags = [flag, *more_flags(of_odds, x, answer, format)]
            test = {"id": key, "format": format, "args": {name: hex_float(x)}, "want": answer, "flags": flags}
            tests.append(traps.attach(test, known_mistakes(function, x, answer, format)))

    for format in FORMATS:
        rng = np.random.default_rng([20261121, FUNCTIONS.index(function), FORMATS[format][0]])
        for x in [0.0, -0.0] + ([math.inf, -math.inf] if of_odds else [0.5, 1.0]):
            add(format, x, "Limit")
        domain = [math.nan] if of_odds else [math.nan, -0.25, 1.5, math.inf, -math.inf, neighbours(1, format)[2], -(2.0 ** FORMATS[format][1])]
        for x in domain:
            add(format, x, "Domain", {"error": "domain"})
        for x in near_ties(function, format):
            add(format, x, "NearTie")
        for x in edges(of_odds, format):
            add(format, x, "Edge")
        for x in random_arguments(of_odds, format, rng):
            add(format, x, "Random")
    write(f"cell.{function}", SOURCE, FLAGS, NOTES, tests)


if __name__ == "__main__":
    for function in FUNCTIONS:
        make(function)
