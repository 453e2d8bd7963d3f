"""The mean information of a map by NumPy and SciPy, as it is usually written.

    maps.py f64|f32|i8 FILE

FILE holds the cells as they lie in memory: probabilities other than 0 and 1, or log-odds of being free times 16 in a byte.
Prints one line a method: name, seconds, value, with tabs between. `cargo bench --bench peers` runs it; a package that is
not there is skipped, with a line on standard error.
"""

import sys
import time


def report(name, call):
    """Runs it for a second, at least five times; the least processor time of this thread."""
    times = []
    while len(times) < 5 or sum(times) < 1:
        start = time.thread_time()
        value = call()
        times.append(time.thread_time() - start)
    print(name, repr(min(times)), repr(float(value)), sep="\t", flush=True)


def floats(numpy, p):
    def log2():
        information = 1 + p * numpy.log2(p) + (1 - p) * numpy.log2(1 - p)
        return information[p != 0.5].mean(dtype=numpy.float64)

    report(f"NumPy {numpy.__version__} log2", log2)

    import scipy
    from scipy.special import entr

    def entropies():
        information = 1 - (entr(p) + entr(1 - p)) / p.dtype.type(numpy.log(2))
        return information[p != 0.5].mean(dtype=numpy.float64)

    report(f"SciPy {scipy.__version__} entr", entropies)


def bytes_counted(numpy, cells):
    levels = numpy.arange(256, dtype=numpy.uint8).view(numpy.int8).clip(-127)
    p = 1 / (1 + numpy.exp(levels / 16))
    table = numpy.where(levels == 0, 0, 1 + p * numpy.log2(p) + (1 - p) * numpy.log2(1 - p))

    def bincount():
        counts = numpy.bincount(cells.view(numpy.uint8), minlength=256)
        return counts @ table / counts[1:].sum()

    report(f"NumPy {numpy.__version__} bincount", bincount)


try:
    import numpy

    kind = numpy.dtype({"f64": "float64", "f32": "float32", "i8": "int8"}[sys.argv[1]])
    cells = numpy.fromfile(sys.argv[2], kind)
    (bytes_counted if kind.itemsize == 1 else floats)(numpy, cells)
except ImportError as missing:
    print(f"skipped: {missing}", file=sys.stderr)
