#!/usr/bin/env python3
"""Random inputs through the library, every bit of every result against MPFR.

    cargo build --release --example cell_results
    proofs/random_check.py N SEED [f32|f64]

draws N occupancies and N log-odds from mixtures that reach all magnitudes and both sides of every hard place, and
compares the five functions of a cell. MPFR works with 320 bits and no digits cancel but in I = 1 - H, where
I > 2^-207 leaves over 100; the value widened by 2^-100 on both sides must round to one float, which is the expectation.
Needs gmpy2 and numpy.
"""

import subprocess
import sys
import time
from pathlib import Path

import gmpy2
import numpy as np
from gmpy2 import exp, log, log1p, mpfr

BATCH = 250_000
PROGRAM = Path(__file__).parent.parent / "target/release/examples/cell_results"
gmpy2.set_context(gmpy2.context(precision=320, emin=-10_000, emax=10_000))
ONE, INV_LN2 = mpfr(1), 1 / gmpy2.const_log2()
DOWN, UP = ONE - mpfr(2) ** -100, ONE + mpfr(2) ** -100


def from_occupancy(p):
    """H(p) and I(p)."""
    q = mpfr(1 - p if p > 0.5 else p)  # exact in binary64
    if q == 0:
        return q, ONE
    h = -(q * log(q) + (1 - q) * log1p(-q)) * INV_LN2
    return h, 1 - h if q != 0.5 else mpfr(0)


def from_log_odds(l):
    """H, I and the occupancy."""
    a = mpfr(abs(l))
    x = exp(-a)
    minor = x / (1 + x)
    h = (log1p(x) + a * minor) * INV_LN2
    # Below 2^-100 the next term of the series is l^2 / 24 of the first.
    i = 1 - h if a > 1e-30 else a * a * INV_LN2 / 8
    return h, i, minor if l < 0 else 1 / (1 + x)


def rounder(kind):
    to_format = gmpy2.ieee(np.dtype(kind).itemsize * 8).plus

    def rounded(value):
        nearest = to_format(value * DOWN)
        assert nearest == to_format(value * UP), f"more than 320 bits are needed: {value}"
        return float(nearest)

    return rounded


def occupancies(random, n, kind):
    """Uniform; all magnitudes; near 1/2; near 1; tiny."""
    scale = np.exp2(-random.uniform(1, 60, n))
    one = int(np.ones((), kind).view(f"u{kind[1]}"))
    bits = random.integers(0, one, n, f"u{kind[1]}", endpoint=True).view(kind).astype("f8")
    sign = random.choice([-1, 1], n)
    tiny = random.uniform(0, 1, n) * np.exp2(-random.uniform(6, 80, n))
    columns = [random.uniform(0, 1, n), bits, 0.5 + sign * scale / 2, 1 - scale, tiny]
    return np.choose(random.integers(0, len(columns), n), columns).astype(kind)


def log_odds(random, n, kind):
    """As maps hold them; all bit patterns; all magnitudes from 2^-40 to 2^10; where e^-l ends."""
    bits = random.integers(0, 1 << 8 * int(kind[1]), n, f"u{kind[1]}", endpoint=False).view(kind)
    bits[~np.isfinite(bits)] = 0
    sign = random.choice([-1, 1], n)
    magnitude = sign * np.exp2(random.uniform(-40, 10, n))
    columns = [random.normal(0, 3, n), bits, magnitude, random.uniform(-40, 40, n), sign * random.uniform(80, 760, n)]
    return np.choose(random.integers(0, len(columns), n), columns).astype(kind)


def library(function, kind, arguments):
    name = {"f4": "f32", "f8": "f64"}[kind]
    answer = subprocess.run(
        [PROGRAM, function, name], input=arguments.astype("<" + kind).tobytes(), capture_output=True, check=True
    )
    return np.frombuffer(answer.stdout, "<" + kind)


CHECKS = [
    (occupancies, from_occupancy, ["entropy", "information"]),
    (log_odds, from_log_odds, ["entropy_from_log_odds", "information_from_log_odds", "occupancy_from_log_odds"]),
]


def main():
    count, seed = int(sys.argv[1]), int(sys.argv[2])
    kind = {"f32": "f4", "f64": "f8"}[sys.argv[3] if len(sys.argv) > 3 else "f64"]
    random, rounded = np.random.default_rng(seed), rounder(kind)
    failures = 0
    for draw, exact, functions in CHECKS:
        wrong, started = dict.fromkeys(functions, 0), time.time()
        for start in range(0, count, BATCH):
            arguments = draw(random, min(BATCH, count - start), kind)
            expected = np.array([[rounded(v) for v in exact(x)] for x in arguments.tolist()], kind)
            for column, function in enumerate(functions):
                results = library(function, kind, arguments)
                bad = results.view(f"u{kind[1]}") != expected[:, column].view(f"u{kind[1]}")
                for x, got, want in zip(arguments[bad], results[bad], expected[bad, column]):
                    print(f"WRONG: {function}({float(x).hex()}) = {float(got).hex()}, not {float(want).hex()}")
                wrong[function] += int(bad.sum())
        for function, n in wrong.items():
            print(f"{function} {kind}: {count} inputs, seed {seed}, {n} wrong", flush=True)
        print(f"  {time.time() - started:.0f} s", flush=True)
        failures += sum(wrong.values())
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
