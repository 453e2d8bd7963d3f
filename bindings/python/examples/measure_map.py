"""A map measured: `python measure_map.py ../../../maps/room.yaml`; of an array of integers `... FILE.npy percent`."""

import sys

import mean_information as mi
import numpy as np


def main(path: str, encoding: str | None = None) -> None:
    """Print the measures of a map, and where its information is."""
    read = mi.read_map(path, encoding=encoding)
    tally = read.tally
    print(f"mean information  {tally.mean_information:.4f} bits per observed cell")
    print(f"information       {tally.information:.1f} bits of {tally.observed} observed cells")
    print(f"entropy           {tally.entropy:.1f} bits, of which {tally.unknown} of unknown cells")
    bits = bits_of_cells(read.cells, read.encoding)
    print(f"rows with most    {np.argsort(bits.sum(axis=1))[::-1][:3]}")
    for warning in read.warnings:
        print(f"but               {warning}")


def bits_of_cells(cells: np.ndarray, encoding: str) -> np.ndarray:
    """Return the information of each cell, by a ufunc."""
    if encoding == "percent":
        return mi.information(np.where(cells == -1, 0.5, cells / 100))
    if encoding == "log-odds":
        return mi.information_from_log_odds(cells)
    return mi.information(cells)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("which map? python measure_map.py FILE [ENCODING]")
    main(*sys.argv[1:])
