"""Arrays measured."""

from __future__ import annotations  # names in help(), not what they stand for

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import Encoding, axes_of, mask_of, prepared
from ._native import Tally


def tally(cells: npt.ArrayLike, *, encoding: Encoding = "probability", where: npt.ArrayLike | None = None) -> Tally:
    """Measure the cells of a map: the exact sums of entropy and information, and the counts behind them.

    Parameters
    ----------
    cells : array_like
        The cells of a map, of any shape, strides and byte order. Masked cells of a masked array are left out.
    encoding : {"probability", "percent", "log-odds", "mrpt"}
        What the numbers are; never guessed from their type. "probability": floats in [0, 1], 1/2 is unknown. "percent":
        integers 0 to 100 and -1 (or 255 in uint8) for unknown, as `nav_msgs/OccupancyGrid` has them. "log-odds": floats, in
        nats. "mrpt": MRPT's bytes, integers -128 to 127, 16 times the log-odds of being free.
    where : array_like of bool, optional
        The cells that are measured; it is broadcast to the shape of `cells`.

    Returns
    -------
    Tally
        With the precision that cells are computed in: float32 for float32 and float16, float64 for all else.

    Raises
    ------
    TypeError
        If the numbers are of a type that the encoding does not have.
    ValueError
        If a cell is NaN or outside the domain of the encoding: the first one is named by its index.

    Notes
    -----
    The sums are exact sums of the correctly rounded values of the cells, rounded once when they are read: the same bits in
    any order, by any number of parts, and by the command. An array that lies in one block of memory is not copied, and the
    interpreter is free for other threads meanwhile. Who changes the array meanwhile gets sums of no certain state of it.

    Examples
    --------
    >>> import numpy as np
    >>> import mean_information as mi
    >>> mi.tally(np.array([[0.25, 0.5, 0.96875]]))
    <Tally: 0.49404977561407626 bits per observed cell; 2 observed (1 free, 1 occupied), 1 unknown>
    >>> mi.tally(np.array([0, 2, 50, -1, 97, 100], dtype=np.int8), encoding="percent").mean_information
    0.9160418999066507
    """
    array = prepared(cells, encoding)
    return _native.tally(array, encoding, mask_of(cells, where, array.shape))


def mean_information(
    cells: npt.ArrayLike,
    *,
    encoding: Encoding = "probability",
    axis: int | Sequence[int] | None = None,
    keepdims: bool = False,
    where: npt.ArrayLike | None = None,
) -> Any:
    """Compute the mean information of maps, Eq. 4 of the report [1]_, in bits per observed cell.

    The sum of ``1 - H(p)`` over the cells, divided by the number of cells whose occupancy is not 1/2.

    Parameters
    ----------
    cells, encoding, where
        As of `tally`.
    axis : int or sequence of int, optional
        The axes of a map; the others number maps. By default all cells are one map.
    keepdims : bool
        Whether axes of a map stay, with length 1.

    Returns
    -------
    float or ndarray
        A float without `axis` and `keepdims`; else an array of float32 for cells of float32 and float16, of float64 for all
        others, or a scalar of that type where no axis is left. 0.0 where no cell is observed, by the report's convention, as
        numbers add and average; the command prints none there, and null in JSON: `Tally.observed` and `Tally.meaningful`
        tell such maps apart.

    Raises
    ------
    TypeError, ValueError
        As `tally`.

    Notes
    -----
    Within 1.5 ulp of the exact mean information of the cells (proved), the bits of ``tally(cells).mean_information``, and
    faster, as no entropies are computed.

    References
    ----------
    .. [1] J.-L. Blanco, "Derivation of an Expression for the Mean Information Maximum Value", University of Malaga.

    Examples
    --------
    >>> import numpy as np
    >>> import mean_information as mi
    >>> particles = np.array([[[0.25, 0.5]], [[0.125, 1.0]]])
    >>> mi.mean_information(particles)
    0.5483858107804236
    >>> mi.mean_information(particles, axis=(1, 2))
    array([0.18872188, 0.72821778])
    """
    array = prepared(cells, encoding)
    axes = axes_of(axis, array.ndim)
    mask = mask_of(cells, where, array.shape)
    if axes is None and keepdims:
        axes = list(range(array.ndim))
    result = _native.mean_information(array, encoding, axes, mask)
    if axes is None:
        return result
    # As NumPy's reductions, a scalar where no axis is left.
    return np.expand_dims(result, tuple(sorted(axes))) if keepdims else result[()]
