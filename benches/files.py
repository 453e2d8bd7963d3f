#!/usr/bin/env python3
"""Times `meaninfo map` of 1000 small maps and of one of 400 million int8 cells beside NumPy, and checks that both agree.

    cargo build --release -p mean-information-cli
    python3 benches/files.py target/release/meaninfo

Each row is a process of its own; the least of three runs. Needs NumPy, and 400 MB in the folder for temporary files.
"""

import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

SMALL, SIDE, LARGE, RUNS = 1000, 100, 20_000, 3


def mean_information(counts):
    """Returns Eq. 4 of counts of bytes, which are percentages and 255 for unknown."""
    p = np.arange(101) / 100
    with np.errstate(divide="ignore", invalid="ignore"):
        entropy = -np.nan_to_num(p * np.log2(p)) - np.nan_to_num((1 - p) * np.log2(1 - p))
    observed = counts[:101] * (p != 0.5)
    return float((observed * (1 - entropy)).sum() / observed.sum())


def numpy_whole(paths):
    """Loads each array, and counts its bytes."""
    return [mean_information(np.bincount(np.load(path).view(np.uint8).ravel(), minlength=256)) for path in paths]


def numpy_by_rows(paths):
    """Maps each array into memory, and counts its bytes by a hundred rows."""
    results = []
    for path in paths:
        cells = np.load(path, mmap_mode="r").view(np.uint8)
        rows = range(0, len(cells), 100)
        counts = sum(np.bincount(cells[row:row + 100].ravel(), minlength=256) for row in rows)
        results.append(mean_information(counts))
    return results


def measured(command, **more):
    """Runs a command; returns its output, its wall and processor time in seconds, and its peak memory in MiB."""
    best = None
    for _ in range(RUNS):
        started = time.perf_counter()
        # A process of its own between, since a child begins with the peak of its parent.
        timed = ["/usr/bin/time", "-f", "%U %S %M", *command]
        process = subprocess.run(timed, capture_output=True, check=True, env={**os.environ, **more})
        user, system, peak = map(float, process.stderr.split()[-3:])
        row = user + system, time.perf_counter() - started, peak / 1024, process.stdout
        best = min(best or row, row)
    return best


def main():
    program = os.path.abspath(sys.argv[1])
    random = np.random.default_rng(7)
    with tempfile.TemporaryDirectory() as folder:
        def array(name, side):
            cells = random.choice(np.array([-1, 0, 3, 40, 50, 77, 100], np.int8), (side, side))
            np.save(os.path.join(folder, name), cells)
            return os.path.join(folder, name), cells

        small, maps = [], []
        for k in range(SMALL):
            path, cells = array(f"{k}.npy", SIDE)
            small.append(path)
            with open(f"{path}.pgm", "wb") as image:
                image.write(b"P5 %d %d 255\n" % (SIDE, SIDE) + cells.view(np.uint8).tobytes())
            with open(f"{path}.yaml", "w") as yaml:
                yaml.write(f"image: {k}.npy.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\nmode: raw\n")
            maps.append(f"{path}.yaml")
        large, _ = array("large.npy", LARGE)

        def ours(paths, **more):
            *times, output = measured([program, "map", "--format", "json", *paths], **more)
            return times, [row["mean_information"] for row in json.loads(output)]

        def theirs(function, paths):
            *times, output = measured([sys.executable, __file__, "--run", function.__name__, *paths])
            return times, json.loads(output)

        print("| what | how | processor time (s) | by ours | wall (s) | peak memory |\n|---|---|---|---|---|---|")
        for what, rows in [
            (f"{SMALL} `.npy` of {SIDE} x {SIDE} int8", [
                ("`meaninfo map`", lambda: ours(small)),
                ("`meaninfo map`, one thread", lambda: ours(small, RAYON_NUM_THREADS="1")),
                ("NumPy, `bincount`", lambda: theirs(numpy_whole, small)),
            ]),
            (f"{SMALL} ROS maps of the same cells", [("`meaninfo map`", lambda: ours(maps))]),
            (f"one `.npy` of {LARGE} x {LARGE} int8", [
                ("`meaninfo map`", lambda: ours([large])),
                ("NumPy, `bincount` of the whole", lambda: theirs(numpy_whole, [large])),
                ("NumPy, `bincount` by 100 rows, mapped", lambda: theirs(numpy_by_rows, [large])),
            ]),
        ]:
            first = None
            for how, run in rows:
                (processor, wall, memory), results = run()
                first = first or (processor, results)
                assert np.allclose(results, first[1], rtol=1e-12, atol=0), how
                print(f"| {what} | {how} | {processor:.2f} | {processor / first[0]:.1f} | {wall:.2f} | {memory:.0f} MiB |")


if __name__ == "__main__":
    if sys.argv[1] == "--run":
        print(json.dumps({"numpy_whole": numpy_whole, "numpy_by_rows": numpy_by_rows}[sys.argv[2]](sys.argv[3:])))
    else:
        main()
