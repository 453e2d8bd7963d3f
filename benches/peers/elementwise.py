"""Entropies, information and occupancies of cells by NumPy and SciPy.

    elementwise.py f64|f32 FUNCTION FILE

FILE holds the arguments as they lie in memory; FUNCTION is one of those below. Prints one line a method: name, seconds,
mean of the results, with tabs between. `cargo bench --bench peers` runs it; a package that is not there is skipped, with a
line on standard error.
"""

import sys
import time

RUNS = 100


def report(name, call):
    """The least processor time of this thread of many runs."""
    least = float("inf")
    for _ in range(RUNS):
        start = time.thread_time()
        results = call()
        least = min(least, time.thread_time() - start)
    print(name, repr(least), repr(float(results.mean(dtype="float64"))), sep="\t", flush=True)


try:
    import numpy
    import scipy
    from scipy.special import entr, expit

    x = numpy.fromfile(sys.argv[3], {"f64": "float64", "f32": "float32"}[sys.argv[1]])
    by_numpy, by_scipy = f"NumPy {numpy.__version__}", f"SciPy {scipy.__version__}"
    ln_2 = x.dtype.type(numpy.log(2))
    if sys.argv[2] == "entropy":
        report(f"{by_numpy} log2", lambda: -(x * numpy.log2(x) + (1 - x) * numpy.log2(1 - x)))
        report(f"{by_scipy} entr", lambda: (entr(x) + entr(1 - x)) / ln_2)
    elif sys.argv[2] == "information_from_log_odds":
        report(f"{by_scipy} entr of expit", lambda: 1 - (entr(expit(x)) + entr(expit(-x))) / ln_2)
    else:
        report(f"{by_numpy} exp", lambda: 1 / (1 + numpy.exp(-x)))
        report(f"{by_scipy} expit", lambda: expit(x))
except ImportError as missing:
    print(f"skipped: {missing}", file=sys.stderr)
