"""The mean information of occupancy maps: how certain a map is of the cells it has observed, in bits per cell.

>>> import mean_information as mi
>>> mi.mean_information([0.1, 0.1, 0.9, 0.5])
0.5310044064107188

* Functions of cells are NumPy ufuncs: `information`, `entropy`, `information_from_log_odds`, `entropy_from_log_odds`,
  `occupancy_from_log_odds`, `log_odds_from_occupancy`.
* Maps are measured by `tally` and `mean_information`, a particle filter's maps together by `expected_map`.
* `ScanMap` makes maps of range scans; `limit` is what the measure of one scan tends to.
* `read_map`, `read_bag`, `read_scans` and `read_trajectory` read the files of the field; `meaninfo` is the command.
"""

# "As" says to type checkers that a name is public.
from ._arrays import Encoding as Encoding
from ._expected import expected_map as expected_map
from ._files import read_map as read_map
from ._measures import mean_information as mean_information
from ._measures import tally as tally
from ._native import (
    BagMap as BagMap,
    ExpectedMap as ExpectedMap,
    GaussianSensor as GaussianSensor,
    Limit as Limit,
    Map as Map,
    RangeScan as RangeScan,
    ScanLog as ScanLog,
    ScanMap as ScanMap,
    SteppedSensor as SteppedSensor,
    Tally as Tally,
    Trajectory as Trajectory,
    entropy as entropy,
    entropy_from_log_odds as entropy_from_log_odds,
    information as information,
    information_from_log_odds as information_from_log_odds,
    limit as limit,
    log_odds_from_occupancy as log_odds_from_occupancy,
    occupancy_from_log_odds as occupancy_from_log_odds,
    read_bag as read_bag,
    read_scans as read_scans,
    read_trajectory as read_trajectory,
)
from ._native import __version__ as __version__

__all__ = [name for name in dir() if not name.startswith("_")]
