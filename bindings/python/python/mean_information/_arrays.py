"""Arrays as the compiled part takes them: the element type of their encoding, native and aligned; and NumPy's axes."""

import operator
from collections.abc import Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt
from numpy.exceptions import AxisError

Encoding: TypeAlias = Literal["probability", "percent", "log-odds", "mrpt"]
"""What the numbers of an array are: probabilities, ROS's percentages, log-odds in nats, MRPT's bytes."""

_BYTES = ("percent", "mrpt")
_ENCODINGS = ("probability", "percent", "log-odds", "mrpt")
_Array: TypeAlias = npt.NDArray[Any]


def prepared(cells: npt.ArrayLike, encoding: str) -> _Array:
    """Return the cells as an array of the element type of their encoding; without a copy where they are one."""
    if encoding not in _ENCODINGS:
        allowed = ", ".join(map(repr, _ENCODINGS))
        raise ValueError(f"encoding is {encoding!r}, allowed are {allowed}")
    array = np.asarray(cells)
    dtype = array.dtype
    if encoding in _BYTES:
        array = _as_bytes(array, encoding)
    elif dtype.kind != "f":
        raise TypeError(
            f"encoding {encoding!r} takes floats, not {dtype}: what integers and booleans mean is not guessed. Percentages "
            '(ROS) are encoding="percent", MRPT\'s bytes encoding="mrpt"; if the numbers are meant as they are, '
            "cells.astype(float)"
            if dtype.kind in "biu"
            else f"encoding {encoding!r} takes an array of floats, not of {dtype}"
        )
    elif dtype.itemsize > 8:
        raise TypeError(f"encoding {encoding!r} takes float64, float32 and float16, not {dtype}: cells.astype(float)")
    elif dtype.itemsize == 2:
        array = array.astype(np.float32)
    return np.require(array, array.dtype.newbyteorder("="), "A")


def _as_bytes(array: _Array, encoding: str) -> _Array:
    """Return integers as int8: bytes by their bits, wider ones by their values."""
    dtype = array.dtype
    if dtype.kind not in "iu":
        hint = {"f": '; floats are encoding="probability" or "log-odds"', "b": "; np.where(cells, 100, 0) makes percentages"}
        raise TypeError(f"encoding {encoding!r} takes integers, not {dtype}{hint.get(dtype.kind, '')}")
    if dtype.itemsize == 1:
        return array.view(np.int8)
    with np.errstate(all="ignore"):
        narrow = array.astype(np.int8)
    if not np.array_equal(narrow, array):
        index = tuple(map(int, np.argwhere(narrow != array)[0]))
        place = f"[{', '.join(map(str, index))}]" if index else ""
        raise ValueError(f"cells{place} is {array[index]}, allowed for encoding {encoding!r} are values of a byte, -128 to 127")
    return narrow


def mask_of(cells: npt.ArrayLike, where: npt.ArrayLike | None, shape: tuple[int, ...]) -> _Array | None:
    """Return bytes that are not 0 where cells are meant: by `where`, and by the mask of a masked array."""
    mask = None
    if where is not None:
        mask = np.asarray(where)
        if mask.dtype != np.bool_:
            raise TypeError(f"where takes booleans, not {mask.dtype}")
        mask = np.broadcast_to(mask, shape)
    if isinstance(cells, np.ma.MaskedArray):
        unmasked = ~np.ma.getmaskarray(cells)
        mask = unmasked if mask is None else mask & unmasked
    return None if mask is None else mask.view(np.uint8)


def axes_of(axis: int | Sequence[int] | None, ndim: int) -> list[int] | None:
    """Return axes by their numbers from 0 on."""
    if axis is None:
        return None
    try:
        given = [operator.index(axis)]  # type: ignore[arg-type]
    except TypeError:
        given = [operator.index(one) for one in axis]  # type: ignore[union-attr]
    for one in given:
        if not -ndim <= one < ndim:
            raise AxisError(one, ndim)
    axes = [one % ndim for one in given]
    if len(set(axes)) < len(axes):
        raise ValueError(f"axis is {axis}, which names an axis twice")
    return axes
