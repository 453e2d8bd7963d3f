#!/usr/bin/env python3
"""Proves what docs/closed_form.md, "How it is computed", takes from the tables of src/limit/closed_form/tables.rs.

    proofs/limit_certify.py            15 s; ends with status 1 if anything fails

For every panel and both weights, in ball arithmetic, hence rigorously (Arb through python-flint):

* error: the polynomial with the integer coefficients of the file is within 2^-67 of the limit, on all of the panel;
* derivative: that of the polynomial is at most 2^-4, so that a unit of `y` counts for 2^-68.

A panel is cut into pieces. On each, the limit is its Taylor polynomial about the middle, plus a remainder whose
coefficient is that of the Taylor series about the ball of all points of the piece (Taylor's theorem). Further, that the
two expansions of A and C agree, and where the limits are largest and smallest: the numbers of the chapter.
"""

import math
import re
import sys
from pathlib import Path

from flint import arb, arb_poly

from limit_exact import at, beyond, constants, edge, error, large, line, one, small, taylor, within, zeta_sum
from limit_tables import SLOPE, VALUE, WEIGHTS, panels

TABLES = Path(__file__).parent.parent / "src/limit/closed_form/tables.rs"
ORDER = 24
PIECES = 32
ERROR, DERIVATIVE = arb(2) ** -67, arb(2) ** -4


def tables():
    """Per weight, the integers of each panel."""
    _, *texts = TABLES.read_text().split("pub(super) static ")
    assert [text.split(":")[0] for text in texts] == list(WEIGHTS)
    found = []
    for text in texts:
        rows = re.findall(r"\((\d+), &\[([^\]]*)\]\)", text)
        assert int(re.search(r"; (\d+)\]", text).group(1)) == len(rows) == len(list(panels()))
        found.append([(int(value), [int(c) for c in slopes.split(",")]) for value, slopes in rows])
    return found


def digest(found):
    """FNV-1a over the numbers as decimals: what src/limit/closed_form/tests.rs knows the tables by."""
    hash = 0xCBF29CE484222325
    rows = (row for table in found for row in table)
    text = "".join(f"{value}:" + "".join(f"{slope}," for slope in slopes) for value, slopes in rows)
    for byte in text.encode():
        hash = (hash ^ byte) * 0x100000001B3 % 2**64
    return hash


def pieces():
    """Middles and half-lengths; shorter towards the ends, where polynomial and limit part most steeply."""
    ends = [-math.cos(math.pi * i / PIECES) / 2 for i in range(PIECES + 1)]
    return [((arb(lower) + upper) / 2, (arb(upper) - lower) / 2) for lower, upper in zip(ends, ends[1:])]


def models(start, width, far, y, half):
    """Of both limits, for the distances from y up to half: a polynomial, with balls as coefficients, that contains the limit."""
    middle = start + width * (y + arb(1) / 2)
    ball = middle + width * error(half)
    # What the series leave out.
    rest = [arb(0), arb(0)]
    if far:
        series = [beyond(line(place, ORDER), one(ORDER)) for place in (middle, ball)]
        rest = [error(arb(2) ** -170)] * 2  # lemma "tail"
    elif start == 0:
        series = [within(line(place, ORDER), one(ORDER)) for place in (middle, ball)]
        # A and C increase, from 0.
        lower = small(ball.lower()) if ball.lower() > 0 else (arb(0), arb(0))
        first, second = (low.union(high) for low, high in zip(lower, small(ball.upper())))
        total = ball + edge()
        rest = [-first / total, -2 * second / total**2]
    else:
        series = [taylor(middle, ORDER), taylor(middle, ORDER, ball)]

    def model(at_middle, at_ball, rest):
        coefficients = [at_middle[k] for k in range(ORDER - 1)] + [at_ball[ORDER - 1]]
        return arb_poly([c * width**k for k, c in enumerate(coefficients)]) + rest

    return [model(*parts) for parts in zip(*series, rest)]


def certify(found):
    """Complains of every panel that is not as stated, and prints the worst."""
    good = True
    worst = [[0.0, 0.0] for _ in WEIGHTS]
    for panel, place in enumerate(panels()):
        rows = [table[panel] for table in found]
        exact = [
            arb_poly([arb(value) / 2**VALUE] + [arb(c) / 2**SLOPE for c in slopes]) for value, slopes in rows
        ]
        for y, half in pieces():
            for w, limit in enumerate(models(*place, y, half)):
                difference = exact[w](arb_poly([y, 1])) - limit
                bound = sum(abs(c) * half**k for k, c in enumerate(difference.coeffs()))
                worst[w][0] = max(worst[w][0], float((bound / ERROR).upper()))
                if not bound <= ERROR:
                    good = False
                    print(f"FAILED: {WEIGHTS[w]}, panel {panel}, about y = {float(y):.3f}: error {float(bound):.3e}")
        for w, (_, slopes) in enumerate(rows):
            bound = sum(k * abs(c) * arb(2) ** (1 - k) for k, c in enumerate(slopes, 1)) / 2**SLOPE
            worst[w][1] = max(worst[w][1], float((bound / DERIVATIVE).upper()))
            if not bound <= DERIVATIVE:
                good = False
                print(f"FAILED: {WEIGHTS[w]}, panel {panel}: derivative {float(bound):.3e}")
    for name, (error, derivative) in zip(WEIGHTS, worst):
        count = len(found[0])
        print(f"{name}: {count} panels, error {error:.3f} of 2^-67, derivative {derivative:.3f} of 2^-4")
    return good


def expansions_agree():
    """Both expansions of A and C, which share nothing, to 60 digits."""
    good = True
    for a in ("1", "1.0625", "1.25", "1.5"):
        for p, q in zip(small(arb(a)), large(arb(a))):
            good = good and p.overlaps(q) and p.rad() < 1e-60 and q.rad() < 1e-60
    print("expansions agree" if good else "FAILED: the expansions differ")
    return good


def extremum(w, lower, upper):
    """The zero of the derivative in an interval where it changes its sign once (chapter, "Not monotone")."""
    lower, upper = arb(lower), arb(upper)
    rising = taylor(lower, 2)[w][1] > 0
    for _ in range(100):
        middle = ((lower + upper) / 2).mid()
        slope = taylor(middle, 2)[w][1]
        assert slope > 0 or slope < 0
        lower, upper = (middle, upper) if (slope > 0) == rising else (lower, middle)
    return lower.union(upper)


def main():
    found = tables()
    good = certify(found)
    good = expansions_agree() and good
    for name, value in zip(("A(b)", "B", "kappa", "M(inf)"), constants()):
        print(f"{name} = {value.str(24, radius=False)}")
    print(f"S = {zeta_sum().str(24, radius=False)}")
    for w, lower, upper in ((0, "0.1", "1"), (0, "1.2", "4"), (1, "0.5", "2"), (1, "2", "4")):
        a = extremum(w, lower, upper)
        print(f"{WEIGHTS[w]}: extremum at {a.str(24, radius=False)}, value {at(a.mid())[w].str(24, radius=False)}")
    print(f"{'certified' if good else 'NOT certified'}: tables {digest(found):#018x}")
    sys.exit(not good)


if __name__ == "__main__":
    main()
