"""The mean information of tiled maps by SQL: the tally as a user-defined aggregate of DataFusion.

    python fleet_datafusion.py FOLDER

FOLDER holds tiles as `tiles.py` writes them. Prints the mean information of each map, and of each day.
"""

import sys

import mean_information as mi
import pyarrow as pa
from datafusion import Accumulator, SessionContext, udaf, udf
from tiles import tally_of

_NONE = pa.scalar(None, pa.binary())


class _Tallies(Accumulator):
    """Tallies that are merged. The state, partial or final, is `Tally.to_bytes`: null of no cells."""

    def __init__(self) -> None:
        self.tally: mi.Tally | None = None

    def add(self, tally: mi.Tally) -> None:
        self.tally = tally if self.tally is None else self.tally + tally

    def merge(self, states: list[pa.Array]) -> None:
        for state in states[0]:
            if state.is_valid:
                self.add(mi.Tally.from_bytes(state.as_buffer()))

    def state(self) -> list[pa.Scalar]:
        return [self.evaluate()]

    def evaluate(self) -> pa.Scalar:
        return _NONE if self.tally is None else pa.scalar(self.tally.to_bytes(), pa.binary())


class TallyOfCells(_Tallies):
    """tally(encoding, cells): tiles are measured."""

    def update(self, *values: pa.Array) -> None:
        for encoding, cells in zip(*values, strict=True):
            if cells.is_valid:
                self.add(tally_of(encoding.as_py(), cells.as_buffer()))


class MergeOfTallies(_Tallies):
    """merge_tallies(tally): tallies that were stored, yesterday's with today's."""

    def update(self, *values: pa.Array) -> None:
        self.merge(list(values))


def _mean_information(tallies: pa.Array) -> pa.Array:
    """Read the mean information of tallies; null where nothing is observed."""

    def mean(data: pa.Scalar) -> float | None:
        tally = mi.Tally.from_bytes(data.as_buffer()) if data.is_valid else None
        return tally.mean_information if tally is not None and tally.observed else None

    return pa.array([mean(data) for data in tallies], pa.float64())


def register(context: SessionContext, binary: pa.DataType | None = None) -> None:
    """Add `tally`, `merge_tallies` and `mean_information` to a context, for cells in Binary or, as Parquet is read, in views."""
    binary = binary or pa.binary()
    one = pa.binary()
    context.register_udaf(udaf(TallyOfCells, [pa.string(), binary], one, [one], "immutable", name="tally"))
    context.register_udaf(udaf(MergeOfTallies, [one], one, [one], "immutable", name="merge_tallies"))
    context.register_udf(udf(_mean_information, [one], pa.float64(), "immutable", name="mean_information"))


BY_MAP = "SELECT map_id, tally(encoding, cells) AS tally FROM tiles GROUP BY map_id ORDER BY map_id"
BY_DAY = "SELECT day, mean_information(tally(encoding, cells)) AS bits FROM tiles GROUP BY day ORDER BY day"


def main() -> None:
    """Print the mean information of each map and of each day."""
    context = SessionContext()
    context.register_parquet("tiles", sys.argv[1], table_partition_cols=[("day", pa.string())])
    register(context)
    print(context.sql(f"SELECT map_id, mean_information(tally) AS bits FROM ({BY_MAP}) ORDER BY map_id"))
    print(context.sql(BY_DAY))


if __name__ == "__main__":
    main()
