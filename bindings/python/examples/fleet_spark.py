"""The mean information of tiled maps by Spark: partitions are measured where they lie, and their few tallies merged.

    python fleet_spark.py FOLDER

FOLDER holds tiles as `tiles.py` writes them. Prints the mean information of each map. Needs Java.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import mean_information as mi
import pyarrow as pa
from fleet_dask import Tallies, merge
from pyspark.sql import SparkSession
from tiles import tally_of


def measure(batches: Iterator[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    """Measure the tiles of a partition: a tally of each map."""
    tallies: Tallies = {}
    for batch in batches:
        for map_id, encoding, cells in zip(*(batch[name] for name in ("map_id", "encoding", "cells")), strict=True):
            tallies = merge(tallies, {map_id.as_py(): tally_of(encoding.as_py(), cells.as_buffer())})
    states = [tally.to_bytes() for tally in tallies.values()]
    yield pa.RecordBatch.from_pydict({"map_id": pa.array(tallies, pa.string()), "tally": pa.array(states, pa.binary())})


def tallies_of(spark: SparkSession, folder: Path) -> Tallies:
    """Return the tally of each map."""
    # Workers import what measures.
    for module in (__file__, *(str(Path(__file__).with_name(f"{name}.py")) for name in ("tiles", "fleet_dask"))):
        spark.sparkContext.addPyFile(module)
    states = spark.read.parquet(str(folder)).mapInArrow(measure, "map_id string, tally binary").collect()
    return merge(*({row.map_id: mi.Tally.from_bytes(row.tally)} for row in states))


def main() -> None:
    """Print the mean information of each map."""
    spark = SparkSession.builder.master("local[2]").config("spark.ui.enabled", "false").getOrCreate()
    for name, tally in sorted(tallies_of(spark, Path(sys.argv[1])).items()):
        print(f"{name}\t{tally.mean_information}")
    spark.stop()


if __name__ == "__main__":
    main()
