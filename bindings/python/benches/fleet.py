"""What the aggregate costs in processor time, for `docs/fleets.md`: `python fleet.py TILES...`, tiles of 64 x 64 percentages of
100 maps."""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
from datafusion import SessionConfig, SessionContext

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples"))
import fleet_datafusion
import tiles

SIDE = 64


def write(folder, count):
    """Write `count` tiles, in files of at most 10 000."""
    random = np.random.default_rng(1)
    for start in range(0, count, 10_000):
        numbers = range(start, min(start + 10_000, count))
        cells = random.integers(-1, 101, (len(numbers), SIDE, SIDE)).astype(np.int8)
        rows = (
            {"map_id": f"{number % 100:03}", "tile": number // 100, "width": SIDE, "height": SIDE, "resolution_m": 0.05}
            | {"encoding": "percent", "cells": tile.tobytes()}
            for number, tile in zip(numbers, cells, strict=True)
        )
        tiles.write(folder / "day=2026-11-30" / f"{start}.parquet", list(rows))


def seconds(context, query):
    """Return the least processor time of three runs."""
    times = []
    for _ in range(3):
        begun = time.process_time()
        context.sql(query).collect()
        times.append(time.process_time() - begun)
    return min(times)


def main():
    for count in map(int, sys.argv[1:]):
        with tempfile.TemporaryDirectory() as folder:
            write(Path(folder), count)
            context = SessionContext(SessionConfig().with_target_partitions(2))
            context.register_parquet("tiles", folder, table_partition_cols=[("day", pa.string())])
            fleet_datafusion.register(context, pa.binary_view())
            read = seconds(context, "SELECT map_id, max(cells) FROM tiles GROUP BY map_id")
            tally = seconds(context, fleet_datafusion.BY_MAP)
            print(f"{count} tiles: read {read:.2f} s, tally {tally:.2f} s, {1e6 * tally / count:.0f} us a tile")


if __name__ == "__main__":
    main()
