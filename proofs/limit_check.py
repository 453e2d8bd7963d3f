#!/usr/bin/env python3
"""Random rooms through the closed form, both limits of each against Arb.

    cargo build --release --example limit_results
    proofs/limit_check.py N SEED [f32|f64]

draws N rooms, from those that robots see to all that the format holds, and compares with the expansions of
limit_exact.py, whose balls are below 2^-200: each result must be within 0.501 ulp. Prints how many are not the nearest
float, and the largest error. Needs python-flint and numpy.
"""

import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
from flint import arb

from limit_exact import at

PROGRAM = Path(__file__).parent.parent / "target/release/examples/limit_results"
PRECISION = {"f4": 24, "f8": 53}
BOUND = Fraction(501, 1000)
NAMES = ("radial", "area")


def rooms(random, n, kind):
    """Rooms that robots see; quotients of all sizes that matter, and around the extrema; any positive floats."""
    low, high = {"f4": (-126, 127), "f8": (-1022, 1023)}[kind]
    sigma = np.exp2(random.uniform(-10, 1, n))
    z = [
        np.exp2(random.uniform(-4, 7, n)),
        sigma * np.exp2(random.uniform(-30, 60, n)),
        sigma * random.uniform(0, 20, n),
        np.exp2(random.uniform(low, high, n)),
    ]
    which = random.integers(0, len(z), n)
    z = np.choose(which, z)
    sigma = np.where(which == 3, np.exp2(random.uniform(low, high, n)), sigma)
    return np.stack([z, sigma], 1).astype("<" + kind)


def exact(ball):
    """The middle of a ball below 2^-200, as a fraction."""
    assert ball.rad() < arb(2) ** -200
    m, e = map(int, ball.mid().man_exp())
    return m * Fraction(2) ** e


def error(result, value, precision):
    """In ulps of the result."""
    ulp = np.ldexp(1.0, int(np.frexp(result)[1]) - precision)
    return (Fraction(float(result)) - value) / Fraction(float(ulp))


def main():
    count, seed = int(sys.argv[1]), int(sys.argv[2])
    kind = {"f32": "f4", "f64": "f8"}[sys.argv[3] if len(sys.argv) > 3 else "f64"]
    arguments = rooms(np.random.default_rng(seed), count, kind)
    assert (arguments > 0).all() and np.isfinite(arguments).all()
    started = time.time()
    command = [PROGRAM, f"f{8 * int(kind[1])}"]
    output = subprocess.run(command, input=arguments.tobytes(), capture_output=True, check=True)
    results = np.frombuffer(output.stdout, "<" + kind).reshape(-1, 2)
    assert len(results) == count
    wrong, second, largest = [0, 0], [0, 0], [0.0, 0.0]
    for (z, s), row in zip(arguments.tolist(), results.tolist()):
        a = Fraction(z) / Fraction(s)
        for w, ball in enumerate(at(arb(a.numerator) / a.denominator)):
            off = abs(error(row[w], exact(ball), PRECISION[kind]))
            largest[w] = max(largest[w], float(off))
            second[w] += off > Fraction(1, 2)
            if off > BOUND:
                wrong[w] += 1
                print(f"WRONG: {NAMES[w]} of {z.hex()}, {s.hex()} is {row[w].hex()}, off by {float(off):.6f} ulp")
    for name, *counts in zip(NAMES, wrong, second, largest):
        print("{} {}: {} rooms, seed {}, {} wrong, {} not nearest, largest error {:.6f} ulp".format(
            name, sys.argv[3] if len(sys.argv) > 3 else "f64", count, seed, *counts))
    print(f"  {time.time() - started:.0f} s")
    sys.exit(sum(wrong) > 0)


if __name__ == "__main__":
    main()
