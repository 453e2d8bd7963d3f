"""Arrays as the compiled part takes them: the element type of their encoding, native and aligned; and NumPy's axes."""

from __future__ import annotations  # names in help(), not what they stand for

import operator
import os
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
    known(encoding)
    if isinstance(cells, (bytes, bytearray)):
        raise TypeError(f"cells is {type(cells).__name__}, allowed is an array; np.frombuffer(cells, np.int8) makes one of bytes")
    if isinstance(cells, (str, os.PathLike)):
        raise TypeError(f"cells is {cells!r}, allowed is an array; read_map({cells!r}).tally measures a file")
    array = np.asarray(cells)
    dtype = array.dtype
    if words := refusal(dtype, encoding):
        raise TypeError(words)
    if encoding in _BYTES:
        array = _as_bytes(array, encoding)
    elif dtype.itemsize == 2:
        array = array.astype(np.float32)
    return np.require(array, array.dtype.newbyteorder("="), "A")


def known(encoding: str) -> None:
    """Refuse a word that names no encoding."""
    if encoding not in _ENCODINGS:
        raise ValueError(f"encoding is {encoding!r}, allowed are {', '.join(map(repr, _ENCODINGS))}")


def refusal(dtype: np.dtype[Any], encoding: str) -> str | None:
    """Say why an encoding has no numbers of a type; None if it has."""
    if encoding in _BYTES:
        hint = {
            "b": "; np.where(cells, 100, 0) makes percentages",
            "f": "; cells.astype(np.int8) makes them integers, if they are whole numbers"
            + ("; of others, np.where(cells == -1, 0.5, cells / 100) are probabilities" if encoding == "percent" else ""),
        }
        return None if dtype.kind in "iu" else f"encoding {encoding!r} takes integers, not {dtype}{hint.get(dtype.kind, '')}"
    if dtype.kind == "f":
        words = f"encoding {encoding!r} takes float64, float32 and float16, not {dtype}: cells.astype(np.float64) rounds the numbers first"
        return None if dtype.itemsize <= 8 else words
    if dtype.kind in "biu":
        return (
            f"encoding {encoding!r} takes floats, not {dtype}: what integers and booleans mean is not guessed. Percentages "
            '(ROS) are encoding="percent", MRPT\'s bytes encoding="mrpt"; if the numbers are meant as they are, '
            "cells.astype(float)"
        )
    return f"encoding {encoding!r} takes an array of floats, not of {dtype}"


def _as_bytes(array: _Array, encoding: str) -> _Array:
    """Return integers as bytes: int8, and uint8 of percentages, as they are, others by their values."""
    if array.dtype == np.int8 or (array.dtype == np.uint8 and encoding == "percent"):
        return array
    with np.errstate(all="ignore"):
        narrow = array.astype(np.int8)
    if not np.array_equal(narrow, array):
        index = tuple(map(int, np.argwhere(narrow != array)[0]))
        place = f"[{', '.join(map(str, index))}]" if index else ""
        words = {"percent": "a percentage from 0 to 100, or -1 for unknown", "mrpt": "a byte, from -128 to 127"}[encoding]
        mended = "; cells.view(np.int8) takes the bytes as MRPT does" if array.dtype.itemsize == 1 else ""
        raise ValueError(f"cells{place} is {array[index]}, allowed is {words}{mended}")
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


def cells_of_map(where: npt.ArrayLike | None, shape: tuple[int, ...]) -> _Array | None:
    """Return bytes that are not 0 where cells of a map of this shape are meant, in one block of memory."""
    if where is None:
        return None
    if np.ndim(where) > len(shape):
        raise ValueError(f"where has {np.ndim(where)} dimensions, allowed are those of a map: of all maps the same cells are meant")
    mask = mask_of((), where, shape)
    return None if mask is None else np.ascontiguousarray(mask)


def axes_of(axis: int | Sequence[int] | None, ndim: int) -> list[int] | None:
    """Return axes by their numbers from 0 on."""
    if axis is None:
        return None
    try:
        given = [operator.index(axis)]  # type: ignore[arg-type]
    except TypeError:
        given = []
    try:
        given = given or [operator.index(one) for one in axis]  # type: ignore[union-attr]
    except TypeError:
        raise TypeError(f"axis is {axis!r}, allowed are an integer, a sequence of integers, and None") from None
    for one in given:
        if not -ndim <= one < ndim:
            raise AxisError(one, ndim)
    axes = [one % ndim for one in given]
    if len(set(axes)) < len(axes):
        raise ValueError(f"axis is {axis}, which names an axis twice")
    return axes
