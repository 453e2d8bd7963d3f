"""Lists of occupancies as maps hold them, seeded: what the generators of map, fusion and expected map draw from."""

import math

import numpy as np

from exact import FORMATS
from text import KINDS

BAD = (math.nan, math.inf, -math.inf, -0.25, 1.25)


def in_format(values, format):
    """The nearest floats of the format, within [0, 1]."""
    return [float(x) for x in np.clip(np.asarray(values, np.float64), 0, 1).astype(KINDS[format])]


def mapped(n, format, rng):
    """A half unknown, the rest mostly near 0 or 1."""
    sure = rng.beta(0.3, 0.3, n)
    return in_format(np.where(rng.random(n) < 0.5, 0.5, sure), format)


def short(n, rng):
    """Multiples of 1/256, without 1/2."""
    drawn = rng.integers(1, 256, n)
    return [float(k) / 256 if k != 128 else 0.25 for k in drawn]


def near_half(n, format, rng, closest=None):
    """Within 2^-2 to some ulp of 1/2."""
    closest = closest or FORMATS[format][0] - 2
    return in_format(0.5 + rng.choice([-1, 1], n) * np.exp2(-rng.uniform(2, closest, n)), format)


def near_zero(n, format, rng):
    """All magnitudes, subnormal ones included."""
    return in_format(np.exp2(rng.uniform(FORMATS[format][1], -1, n)), format)


def near_one(n, format, rng):
    return in_format(1 - np.exp2(rng.uniform(-FORMATS[format][0], -1, n)), format)


def any_of(n, format, rng):
    """All kinds mixed."""
    drawn = [draw(n, format, rng) for draw in (mapped, near_half, near_zero, near_one)]
    return [drawn[k][j] for j, k in enumerate(rng.integers(0, 4, n))]
