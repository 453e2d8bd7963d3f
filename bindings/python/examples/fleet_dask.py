"""The mean information of tiled maps by Dask: tiles are measured where they are read, and tallies merged in a tree.

    python fleet_dask.py FOLDER

FOLDER holds tiles as `tiles.py` writes them. Prints the mean information of each map.
"""

import sys
from pathlib import Path

import mean_information as mi
import pyarrow.parquet as pq
from distributed import Client, Future, LocalCluster
from tiles import tally_of

Tallies = dict[str, mi.Tally]


def measure(path: str, row_group: int) -> Tallies:
    """Measure the tiles of a row group: a tally of each map."""
    table = pq.ParquetFile(path).read_row_group(row_group, columns=["map_id", "encoding", "cells"])
    tallies: Tallies = {}
    for map_id, encoding, cells in zip(*(table[name] for name in table.column_names), strict=True):
        tally = tally_of(encoding.as_py(), cells.as_buffer())
        name = map_id.as_py()
        tallies[name] = tallies[name] + tally if name in tallies else tally
    return tallies


def merge(*parts: Tallies) -> Tallies:
    """Merge the tallies of each map."""
    merged: Tallies = {}
    for part in parts:
        for name, tally in part.items():
            merged[name] = merged[name] + tally if name in merged else tally
    return merged


def tallies_of(client: Client, folder: Path) -> Future:
    """Submit the measures of all tiles of a folder; the result has the tally of each map."""
    files = sorted(map(str, folder.rglob("*.parquet")))
    groups = [(path, group) for path in files for group in range(pq.ParquetFile(path).num_row_groups)]
    parts = client.map(measure, *zip(*groups, strict=True))
    while len(parts) > 1:
        parts = [client.submit(merge, *parts[k : k + 8]) for k in range(0, len(parts), 8)]
    return parts[0]


def main() -> None:
    """Print the mean information of each map."""
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        for name, tally in sorted(tallies_of(client, Path(sys.argv[1])).result().items()):
            print(f"{name}\t{tally.mean_information}")


if __name__ == "__main__":
    main()
