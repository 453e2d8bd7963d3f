"""Tiles of maps as rows of Parquet: the schema, cells to bytes and back, and a program that writes them.

    python tiles.py OUT MAP... [--tile 256] [--day 2026-11-30]

writes `OUT/day=DAY/MAP.parquet` for each map file that `mean_information.read_map` reads.
"""

import argparse
import datetime
from collections.abc import Iterator
from pathlib import Path

import mean_information as mi
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

SCHEMA = pa.schema(
    [
        ("map_id", pa.string()),
        ("tile", pa.int32()),
        ("width", pa.int32()),
        ("height", pa.int32()),
        ("resolution_m", pa.float64()),
        # What the cells are: "percent", "mrpt", or an encoding of floats with their type, "probability float32".
        ("encoding", pa.string()),
        # height rows of width cells, the lowest first; little-endian.
        ("cells", pa.binary()),
    ]
)
"""The columns of a tile. The day stands in the name of the folder, as a partition."""


def encoding_of(cells: np.ndarray, encoding: str) -> str:
    """Return what the column `encoding` says of such cells."""
    return encoding if cells.dtype == np.int8 else f"{encoding} {cells.dtype.name}"


def tally_of(encoding: str, cells: bytes | memoryview) -> mi.Tally:
    """Measure the cells of a tile."""
    name, _, dtype = encoding.partition(" ")
    return mi.tally(np.frombuffer(cells, np.dtype(dtype or np.int8).newbyteorder("<")), encoding=name)


def tiles_of(map_id: str, cells: np.ndarray, encoding: str, resolution: float | None, size: int) -> Iterator[dict]:
    """Cut a map into tiles of at most `size` cells a side, from the lowest row on."""
    little = cells.astype(cells.dtype.newbyteorder("<"), copy=False)
    corners = [(y, x) for y in range(0, cells.shape[0], size) for x in range(0, cells.shape[1], size)]
    for number, (y, x) in enumerate(corners):
        tile = little[y : y + size, x : x + size]
        yield {
            "map_id": map_id,
            "tile": number,
            "width": tile.shape[1],
            "height": tile.shape[0],
            "resolution_m": resolution,
            "encoding": encoding_of(cells, encoding),
            "cells": tile.tobytes(),
        }


def write(path: Path, tiles: list[dict], schema: pa.Schema = SCHEMA) -> None:
    """Write tiles as a file of Parquet, which appears under its name when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(".part")
    pq.write_table(pa.Table.from_pylist(tiles, schema=schema), part, row_group_size=256)
    part.replace(path)


def main() -> None:
    """Write the tiles of map files."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("maps", type=Path, nargs="+")
    parser.add_argument("--tile", type=int, default=256)
    parser.add_argument("--encoding", help="of the arrays among the maps, .npy and .npz: percent, log-odds, mrpt")
    parser.add_argument("--day", type=datetime.date.fromisoformat, default=datetime.date.today())
    arguments = parser.parse_args()
    for path in arguments.maps:
        # Other files say it themselves.
        read = mi.read_map(path, encoding=arguments.encoding if path.suffix in (".npy", ".npz") else None)
        for warning in read.warnings:
            print(f"{path}: {warning}")
        tiles = list(tiles_of(path.stem, read.cells, read.encoding, read.resolution, arguments.tile))
        write(arguments.out / f"day={arguments.day}" / f"{path.stem}.parquet", tiles)
        print(f"{path}: {len(tiles)} tiles")


if __name__ == "__main__":
    main()
