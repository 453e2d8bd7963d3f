"""A map measured: `python measure_map.py ../../../maps/room.yaml`."""

import sys

import mean_information as mi
import numpy as np


def main(path: str) -> None:
    """Print the measures of a map, and where its information is."""
    read = mi.read_map(path)
    tally = read.tally
    print(f"mean information  {tally.mean_information:.4f} bits per observed cell")
    print(f"information       {tally.information:.1f} bits of {tally.observed} observed cells")
    print(f"entropy           {tally.entropy:.1f} bits, of which {tally.unknown} of unknown cells")
    # Percentages to probabilities, then a ufunc: bits of each cell.
    p = np.where(read.cells == -1, 0.5, read.cells / 100)
    bits = mi.information(p)
    print(f"rows with most    {np.argsort(bits.sum(axis=1))[::-1][:3]}")


if __name__ == "__main__":
    main(sys.argv[1])
