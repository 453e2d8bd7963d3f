"""Times beside NumPy and SciPy, for `benches/RESULTS.md`: `python speed.py`. Of processor time, as other work may keep the
machine busy and all of these have one thread; each ratio is that of the least of seven runs."""

import time
import timeit

import mean_information as mi
import numpy as np
from scipy.special import entr


def seconds(function, *arguments, number=1, repeat=7):
    """Return the least time of a call."""
    return min(timeit.repeat(lambda: function(*arguments), timer=time.process_time, number=number, repeat=repeat)) / number


def by_scipy(p):
    return 1 - (entr(p) + entr(1 - p)) / np.log(2)


def by_numpy(p):
    return 1 + p * np.log2(p) + (1 - p) * np.log2(1 - p)


def mean_by_bincount(cells):
    """The mean information of percentages, -1 unknown, from counts of the values."""
    counts = np.bincount(cells.view(np.uint8), minlength=256)[:101]
    return counts @ BITS / (counts.sum() - counts[50])


BITS = mi.information(np.arange(101) / 100)


def main():
    random = np.random.default_rng(1)
    cells = random.random(10_000_000)
    print("| work | here | SciPy, or NumPy's count | NumPy's two logarithms |")
    print("|---|---|---|---|")
    for dtype in (np.float64, np.float32):
        p = cells.astype(dtype)
        np.testing.assert_allclose(mi.information(p), by_scipy(p.astype(float)), rtol=0, atol=2e-7)
        here, scipy, numpy = (100 * seconds(f, p) for f in (mi.information, by_scipy, by_numpy))
        print(
            f"| `information`, 10^7 random {dtype.__name__}, ns an element | {here:.2f} "
            f"| {scipy:.2f} ({scipy / here:.1f}) | {numpy:.2f} ({numpy / here:.1f}) |"
        )
    kinds = {
        "of random values": random.integers(-1, 101, 10_000_000).astype(np.int8),
        "as a mapper's": np.repeat(random.choice([-1, 0, 100, 3, 97], 100_000), 100).astype(np.int8),
    }
    for name, percent in kinds.items():
        value = mi.mean_information(percent, encoding="percent")
        np.testing.assert_allclose(value, mean_by_bincount(percent), rtol=1e-12)
        here = seconds(lambda: mi.mean_information(percent, encoding="percent")) * 100
        count = seconds(mean_by_bincount, percent) * 100
        print(f"| `mean_information`, 10^7 int8 {name}, ns a cell | {here:.3f} | {count:.3f} ({count / here:.1f}) | |")
    x = np.float64(0.3)
    here, scipy = (1e9 * seconds(f, x, number=100_000) for f in (mi.information, entr))
    print(f"| one scalar, ns a call | {here:.0f} | {scipy:.0f} ({scipy / here:.2f}) | |")


if __name__ == "__main__":
    main()
