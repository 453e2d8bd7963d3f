"""The expected map of a particle filter."""

from __future__ import annotations  # names in help(), not what they stand for

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import Encoding, cells_of_map, known, prepared
from ._native import ExpectedMap


def expected_map(
    particles: npt.ArrayLike | Iterable[npt.ArrayLike],
    weights: npt.ArrayLike | None = None,
    *,
    encoding: Encoding = "probability",
    where: npt.ArrayLike | None = None,
) -> ExpectedMap:
    """Compute the expected map of weighted maps, such as the particles of a filter, and its mean information, EMMI.

    The marginal of each cell over the particles, ``sum(w * p) / sum(w)``.

    Parameters
    ----------
    particles : array_like, shape (n, rows, columns), or iterable of array_like, shape (rows, columns)
        The maps.
    weights : array_like of float, shape (n,), optional
        One weight for each map, not negative, in any scale; equal ones by default.
    encoding : {"probability", "percent", "log-odds", "mrpt"}
        What the numbers are, see `tally`.
    where : array_like of bool, optional
        The cells that are measured, of all maps alike; it is broadcast to (rows, columns). The others may hold anything, and
        are NaN in the expected map.

    Returns
    -------
    ExpectedMap

    Raises
    ------
    TypeError, ValueError
        As `tally`, where the first cell that is not allowed is named by its map and its index in that, as
        ``particles[1][2, 0]``; for masked cells; for weights that are negative, NaN, infinite, or all zero, or not one for
        each map.

    Notes
    -----
    Means are exact before they are rounded: EMMI is within half an ulp and 2**-63 bits of the exact one (proved). The cells
    of all particles are copied.

    Examples
    --------
    >>> import numpy as np
    >>> import mean_information as mi
    >>> particles = np.array([[[0.125]], [[0.75]]])
    >>> expected = mi.expected_map(particles, [6.0, 2.0])
    >>> expected.mean_information, expected.mean_of_particles
    (0.14285156257162834, 0.3895071364855195)
    """
    known(encoding)
    if not isinstance(particles, np.ndarray):
        particles = list(particles)  # type: ignore[arg-type]
    if any(np.ma.is_masked(particle) for particle in particles):
        raise TypeError("particles have masked cells: give what is unknown as 0.5, as by np.ma.filled(particles, 0.5)")
    maps = [prepared(particle, encoding) for particle in particles]
    shapes = {particle.shape for particle in maps}
    if any(len(shape) != 2 for shape in shapes) or len(shapes) > 1:
        shown = ", ".join(map(str, sorted(shapes)))
        raise ValueError(f"particles are maps of one shape (rows, columns), not of {shown}")
    if len({particle.dtype for particle in maps}) > 1:
        types = ", ".join(sorted({str(particle.dtype) for particle in maps}))
        raise TypeError(f"particles are arrays of one type, not of {types}")
    given = np.ones(len(maps)) if weights is None else np.asarray(weights, dtype=np.float64)
    if given.ndim != 1:
        raise ValueError(f"weights are a list of numbers, not an array of {given.ndim} dimensions")
    mask = cells_of_map(where, maps[0].shape) if maps else None
    return _native.expected_map(maps, given.tolist(), encoding, mask)
