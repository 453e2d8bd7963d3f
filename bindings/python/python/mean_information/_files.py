"""Maps of files: what may be said of which kind of file."""

from __future__ import annotations  # names in help(), not what they stand for

from os import PathLike, fspath
from typing import Literal

import numpy as np

from . import _native
from ._arrays import Encoding, known, refusal
from ._native import Map

# Maps that are no grid of cells.
_BY_COMMAND = (".ot", ".bt", ".pbstream")


def read_map(
    path: str | PathLike[str],
    *,
    semantics: Literal["nav2", "nav2-humble", "ros1"] | None = None,
    mode: Literal["trinary", "scale", "raw", "probability"] | None = None,
    unknown: float | None = None,
    encoding: Encoding | None = None,
    resolution: float | None = None,
    topic: str | None = None,
    max_cells: int | None = None,
) -> Map:
    """Read a map: a ROS yaml with its image, an array of NumPy, MRPT's grid map, the last map of a bag.

    Parameters
    ----------
    path : path-like
        `.yaml` or `.yml`; `.npy`; `.npz` of one array, or ``FILE.npz:KEY``; `.gridmap` or `.gridmap.gz`; a bag: `.mcap`,
        `.db3`, `.bag`, or the folder of one.
    semantics : {"nav2", "nav2-humble", "ros1"}, optional
        The loader whose rules turn the grey levels of a ROS map into percentages, "nav2" by default; other files have none.
    mode : {"trinary", "scale", "raw", "probability"}, optional
        How grey levels of a ROS map are meant; the file's own mode by default.
    unknown : float, optional
        The value that means unknown: a grey level of a ROS map with mode "probability", or a number of an array of floats.
    encoding : {"probability", "percent", "log-odds", "mrpt"}, optional
        What the numbers of an `.npy` or `.npz` array are, as of `tally`: "probability" by default, whatever their type.
        float16, which `tally` takes, is not read: save it as float32. Other files say it themselves.
    resolution : float, optional
        The side of a cell of an `.npy` or `.npz` array, in metres. Other files say it themselves.
    topic : str, optional
        The topic of a bag's maps; by default the only one that is no costmap.
    max_cells : int, optional
        Larger maps are refused before any cell is read; 2**28 by default.

    Returns
    -------
    Map

    Raises
    ------
    FileNotFoundError, OSError
        If the file, or the image that it names, cannot be read; `errno` and `filename` are set as `open` sets them.
    MemoryError
        If the map is too large.
    ValueError
        If the file is damaged, or no map, or an archive without the array of that key, in the words of the command; if an
        array's numbers are of a type that the encoding does not have; if an argument is given that the kind of file has no
        use for.
    """
    if encoding is not None:
        known(encoding)
    dtype = _native.type_of_array(path)
    given = {
        "semantics": semantics,
        "mode": mode,
        "unknown": unknown,
        "encoding": encoding,
        "resolution": resolution,
        "topic": topic,
    }
    for name, value in given.items():
        if value is not None and (its_files := _native.no_use(name, path)):
            raise ValueError(f"{fspath(path)}: {name} is {value!r}, which is for {its_files}")
    if dtype is not None and (words := refusal(np.dtype(dtype), encoding or "probability")):
        raise ValueError(f"{fspath(path)}: {words}")
    try:
        return _native.read_map(
            path,
            semantics=semantics,
            mode=mode,
            unknown=unknown,
            encoding=encoding,
            resolution=resolution,
            topic=topic,
            max_cells=max_cells,
        )
    except ValueError as refused:
        if fspath(path).lower().endswith(_BY_COMMAND):
            raise ValueError(f"{refused}; the command `meaninfo map` measures it") from None
        raise
