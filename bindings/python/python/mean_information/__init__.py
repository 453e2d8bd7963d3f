"""The mean information of occupancy maps: how certain a map is of the cells it has observed, in bits per cell.

>>> import mean_information as mi
>>> mi.mean_information([0.1, 0.1, 0.9, 0.5])
0.5310044064107188

* Functions of cells are NumPy ufuncs: `information`, `entropy`, `information_from_log_odds`, `entropy_from_log_odds`,
  `occupancy_from_log_odds`, `log_odds_from_occupancy`.
* Maps are measured by `tally` and `mean_information`, a particle filter's maps together by `expected_map`.
* `ScanMap` makes maps of range scans; `limit` is what the measure of one scan tends to.
* `read_map`, `read_scans` and `read_trajectory` read the files of the field; `meaninfo` is the command.
"""

from ._arrays import Encoding
from ._expected import expected_map
from ._measures import mean_information, tally
from ._native import (
    ExpectedMap,
    GaussianSensor,
    Limit,
    Map,
    RangeScan,
    ScanLog,
    ScanMap,
    SteppedSensor,
    Tally,
    Trajectory,
    __version__,
    entropy,
    entropy_from_log_odds,
    information,
    information_from_log_odds,
    limit,
    log_odds_from_occupancy,
    occupancy_from_log_odds,
    read_map,
    read_scans,
    read_trajectory,
)

__all__ = [
    "Encoding",
    "ExpectedMap",
    "GaussianSensor",
    "Limit",
    "Map",
    "RangeScan",
    "ScanLog",
    "ScanMap",
    "SteppedSensor",
    "Tally",
    "Trajectory",
    "__version__",
    "entropy",
    "entropy_from_log_odds",
    "expected_map",
    "information",
    "information_from_log_odds",
    "limit",
    "log_odds_from_occupancy",
    "mean_information",
    "occupancy_from_log_odds",
    "read_map",
    "read_scans",
    "read_trajectory",
    "tally",
]
