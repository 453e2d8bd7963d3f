#!/usr/bin/env python3
"""Searches f64 arguments whose results are hardest to round; README.md has the method.

    cargo build --release --example near_ties
    vectors/generate/near_ties.py BLOCKS SEED > vectors/generate/near_ties_f64.txt

BLOCKS blocks of 2^30 neighbouring arguments are searched in each regime: 2048 take a minute or two a regime.
Lines: function, argument, how many bits after the rounding bit are all equal.
"""

import math
import random
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

from flint import arb, arb_series, ctx

from exact import ENCLOSE, enclosure, exponent_of_ulp, fraction_of, hardness, ln2

PROGRAM = Path(__file__).parents[2] / "target/release/examples/near_ties"
LENGTH = 1 << 30
KEPT = 12
ctx.cap = 8


# The functions of a cell on power series; `tiny_*` are limits for small arguments, of an integer significand.


def entropy(p):
    return -(p * p.log() + (1 - p) * (1 - p).log()) / ln2()


def entropy_from_log_odds(l):
    x = (-l).exp()
    return ((1 + x).log() + l * x / (1 + x)) / ln2()


def tiny_entropy(m):
    """H / q at q = m 2^-n is this + m (n - 52) for small q: the same fraction for all n."""
    return m * (52 + (1 - m.log()) / ln2())


def tiny_information(m):
    """I / 4^e at log-odds m 2^e, small."""
    return m * m / (8 * ln2())


def occupancy(sign):
    return lambda l: 1 / (1 + (-sign * l).exp())


# Function, its series in p or in the magnitude of the log-odds, and the range searched. The binades in it are alike.
REGIMES = [
    ("entropy", entropy, 2**-8, 15 / 32),
    ("entropy", entropy, 17 / 32, 1 - 2**-8),
    ("information", lambda p: 1 - entropy(p), 0.12, 15 / 32),
    ("information", lambda p: 1 - entropy(p), 15 / 32, 0.5 - 2**-8),
    ("information", lambda p: 1 - entropy(p), 0.5 + 2**-8, 17 / 32),
    ("entropy_from_log_odds", entropy_from_log_odds, 1 / 8, 5.5),
    ("entropy_from_log_odds", entropy_from_log_odds, 5.6, 700),
    ("information_from_log_odds", lambda l: 1 - entropy_from_log_odds(l), 1 / 8, 1.7),
    ("occupancy_from_log_odds", occupancy(-1), 1 / 8, 30),
    ("occupancy_from_log_odds", occupancy(-1), 30, 700),
    ("occupancy_from_log_odds", occupancy(1), 1 / 8, 3),
]


def block(series, start, step, unit=None):
    """The coefficients of 2 value / ulp over LENGTH arguments, scale 64, or None if the ulp changes."""
    if unit is None:
        # Values at both ends, to 100 bits.
        ends = [series(arb_series([arb(start) + k * arb(step) * LENGTH]))[0] for k in (0, 1)]
        unit, other = (exponent_of_ulp(fraction_of(end.mid()), "f64") for end in ends)
        if unit != other:
            return None
    value = series(arb_series([arb(start), arb(step) * LENGTH])) * arb(2) ** (1 - unit)
    scaled = [round(fraction_of((value[k] * arb(2) ** 64).mid())) for k in range(8)]
    # Integers and integer multiples of t do not change the fraction.
    scaled[0] %= 1 << 64
    scaled[1] = (scaled[1] + (1 << 93)) % (1 << 94) - (1 << 93)
    return scaled


def search(series, low, high, blocks, rng, unit=None):
    """Yields the arguments found, as fractions, in blocks that start anywhere between low and high."""
    precision, ctx.prec = ctx.prec, 1600
    starts, lines = [], []
    while len(starts) < blocks:
        start = math.exp(rng.uniform(math.log(low), math.log(high)))
        step = math.ulp(start)
        coefficients = block(series, start, step, unit)
        if coefficients and start + step * LENGTH < high:
            starts.append((Fraction(start), Fraction(step)))
            lines.append(" ".join(map(str, coefficients)))
    ctx.prec = precision
    # A window that leaves some hundred arguments.
    bits = str(int(math.log2(blocks)) + 30 - 7)
    answer = subprocess.run([PROGRAM, bits], input="\n".join(lines), capture_output=True, check=True, text=True)
    for line in answer.stdout.splitlines():
        number, t = map(int, line.split())
        start, step = starts[number]
        yield start + t * step


def of_tiny_entropy(blocks, rng):
    """H / q = V(m) + m (n-52) in units of ulp(q), and the ulp of H is 2^9 of them for n - 50 < 2^10, n - 51 >= 2^9: one n makes
    it a tie but for the fraction of V."""
    for m in search(tiny_entropy, 2.0**52, 2.0**53, blocks, rng, unit=1):
        m = int(m)
        whole = round(fraction_of(tiny_entropy(arb(m)).mid()))
        for n in range(52 + 512, 1075):
            if (whole + m * (n - 52)) % 512 == 256:
                yield math.ldexp(m, -n)


def of_tiny_information(blocks, rng):
    """The same fraction for all exponents; the correction, l^2 / 24, is far less than 2^-80."""
    for m in search(tiny_information, 2.0**52, 2.0**53, blocks, rng):
        yield math.ldexp(int(m), rng.choice([-120, -300, -560]))


def inverse(function, target, guess):
    """The argument, to 150 bits, at which the function has the target value: secant method."""
    f = lambda x: ENCLOSE[function](x) - arb(target.numerator) / target.denominator
    precision, ctx.prec = ctx.prec, 1400
    a, b = arb(guess), arb(guess) * (1 + arb(2) ** -20)
    fa, fb = f(a), f(b)
    for _ in range(40):
        if abs(a - b) < arb(2) ** -150 * abs(b):
            break
        a, b, fa = b, (b - fb * (b - a) / (fb - fa)).mid(), fb
        fb = f(b)
    ctx.prec = precision
    return fraction_of(b.mid())


def of_crowded_arguments(count):
    """Where arguments are denser than results: the neighbours of the exact solutions for the first midpoints."""
    half, tiny = Fraction(1, 2**54), Fraction(1, 2**1075)
    log = math.log
    limits = [
        # Function, midpoint of an odd number, a first guess of the argument.
        ("information", lambda o: 1 - o * half, lambda o: o * 2.0**-54 / (54 - log(o) / log(2) + 5)),
        ("entropy", lambda o: 1 - o * half, lambda o: 0.5 - math.sqrt(o * 2.0**-54 * 2 * log(2)) / 2),
        ("entropy_from_log_odds", lambda o: 1 - o * half, lambda o: math.sqrt(o * 2.0**-54 * 8 * log(2))),
        ("information_from_log_odds", lambda o: 1 - o * half, lambda o: 41.0 - log(o)),
        ("information_from_log_odds", lambda o: o * tiny, lambda o: math.sqrt(8 * log(2) * o) * 2.0**-537.5),
        ("occupancy_from_log_odds", lambda o: 1 - o * half, lambda o: 54 * log(2) - log(o)),
        ("occupancy_from_log_odds", lambda o: o * tiny, lambda o: log(o) - 1075 * log(2)),
        ("entropy_from_log_odds", lambda o: o * tiny, lambda o: 752.0 - log(o)),
        ("occupancy_from_log_odds", lambda o: Fraction(1, 2) + o * half, lambda o: o * 2.0**-52),
        ("occupancy_from_log_odds", lambda o: Fraction(1, 2) - o * half / 2, lambda o: -o * 2.0**-53),
    ]
    for function, target, guess in limits:
        found = []
        for odd in range(1, 2 * count, 2):
            solution = inverse(function, target(odd), guess(odd))
            nearest = float(solution)
            for x in (math.nextafter(nearest, -math.inf), nearest, math.nextafter(nearest, math.inf)):
                found.append((function, x))
        yield found


def hardest(found, kept):
    """The hardest of the (function, argument) pairs, with their hardness."""
    judged = ((hardness(enclosure(function, x)[0], "f64"), function, x) for function, x in set(found))
    return sorted(judged, reverse=True)[:kept]


def main():
    blocks, rng = int(sys.argv[1]), random.Random(int(sys.argv[2]))
    groups = []
    for function, series, low, high in REGIMES:
        sign = -1 if function == "occupancy_from_log_odds" and series(arb(1)) < 0.5 else 1
        groups.append([(function, sign * float(x)) for x in search(series, low, high, blocks, rng)])
    groups.append([("entropy", x) for x in of_tiny_entropy(blocks, rng)])
    groups.append([("information_from_log_odds", x) for x in of_tiny_information(blocks, rng)])
    groups.extend(of_crowded_arguments(count=2000))
    for group in groups:
        for bits, function, x in hardest(group, KEPT):
            print(f"{function} {x.hex()} {bits:.1f}", flush=True)


if __name__ == "__main__":
    main()
