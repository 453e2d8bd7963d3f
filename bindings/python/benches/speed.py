"""Times beside NumPy and SciPy, for `benches/RESULTS.md`: `python speed.py`. Of processor time, as other work may keep the
machine busy and all of these have one thread; the least of many rounds, in which those that are compared take turns."""

import os
import time

import mean_information as mi
import numpy as np
from scipy.special import entr

ROUNDS = 15
BITS = mi.information(np.arange(101) / 100)


def seconds(*functions, number=1):
    """Return the least time of a call of each."""
    least = [np.inf] * len(functions)
    for _ in range(ROUNDS):
        for k, function in enumerate(functions):
            begun = time.process_time()
            for _ in range(number):
                function()
            least[k] = min(least[k], (time.process_time() - begun) / number)
    return least


def row(work, unit, *times):
    """Print a row: our time, and those of others with their ratios to it."""
    here, *others = times
    shown = [f"{other / unit:.3g} ({other / here:.2f})" for other in others]
    print(f"| {work} | {here / unit:.3g} | " + " | ".join(shown + [""] * (2 - len(shown))) + " |", flush=True)


def by_scipy(p):
    return 1 - (entr(p) + entr(1 - p)) / np.log(2)


def by_numpy(p):
    return 1 + p * np.log2(p) + (1 - p) * np.log2(1 - p)


def mean_by_bincount(cells):
    """The mean information of percentages, -1 unknown, from counts of the values."""
    counts = np.bincount(cells.view(np.uint8), minlength=256)[:101]
    return counts @ BITS / (counts.sum() - counts[50])


def main():
    random = np.random.default_rng(1)
    cells = random.random(10_000_000)
    print("load", *(f"{load:.1f}" for load in os.getloadavg()))
    print("| work | here | SciPy, or NumPy's count | NumPy |")
    print("|---|---|---|---|")
    each = cells.size * 1e-9
    for dtype in (np.float64, np.float32):
        p = cells.astype(dtype)
        np.testing.assert_allclose(mi.information(p), by_scipy(p.astype(float)), rtol=0, atol=2e-7)
        times = seconds(*(lambda f=f: f(p) for f in (mi.information, by_scipy, by_numpy)))
        row(f"`information`, 10^7 random {dtype.__name__}, ns an element", each, *times)
    kinds = {
        "of random values": random.integers(-1, 101, 10_000_000).astype(np.int8),
        "as a mapper's": np.repeat(random.choice([-1, 0, 100, 3, 97], 100_000), 100).astype(np.int8),
    }
    for name, percent in kinds.items():
        value = mi.mean_information(percent, encoding="percent")
        np.testing.assert_allclose(value, mean_by_bincount(percent), rtol=1e-12)
        times = seconds(lambda: mi.mean_information(percent, encoding="percent"), lambda: mean_by_bincount(percent))
        row(f"`mean_information`, 10^7 int8 {name}, ns a cell", each, *times)
    x = np.float64(0.3)
    row("one scalar, ns a call", 1e-9, *seconds(lambda: mi.information(x), lambda: entr(x), number=20_000))
    where = cells < 0.7
    masked = np.ma.array(cells, mask=~where)
    tallies = [lambda: mi.tally(cells, where=where), lambda: mi.tally(masked), lambda: mi.tally(cells)]
    times = seconds(*tallies, lambda: cells[where])
    with_where, with_mask, whole, compress = times
    work = "`tally`, `where=` of 0.7 of 10^7 float64, ns a cell, beside without and NumPy's `cells[where]`"
    row(work, each, with_where, whole, compress)
    row("the same of a masked array", each, with_mask, whole, compress)
    rows = cells[: 16 * 50_000].reshape(-1, 16)
    others = [lambda by=by: by(rows).mean(axis=1) for by in (by_scipy, by_numpy)]
    times = seconds(lambda: mi.mean_information(rows, axis=1), *others)
    row("`mean_information(axis=1)`, 50 000 maps of 16 cells, ns a map", len(rows) * 1e-9, *times)
    particles, weights = random.random((40, 1, 100_000)), random.random(40)
    expected = mi.expected_map(particles, weights).probabilities
    np.testing.assert_allclose(expected, np.average(particles, axis=0, weights=weights), rtol=1e-14)
    times = seconds(lambda: mi.expected_map(particles, weights), lambda: np.average(particles, axis=0, weights=weights))
    row("`expected_map` of 40 x 100 000 cells, ms, beside the mean alone", 1e-3, times[0], np.nan, times[1])
    print("load", *(f"{load:.1f}" for load in os.getloadavg()))


if __name__ == "__main__":
    main()
