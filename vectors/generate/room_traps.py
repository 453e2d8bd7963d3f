"""Known mistakes with the grids of a room, in floats of 53 bits: traps are cut to 24."""

import math
from itertools import product

EDGE = math.sqrt(2 * math.log(2))
LN2 = math.log(2)


def entropy(p):
    """In bits."""
    return 0.0 if p in (0, 1) else -(p * math.log(p) + (1 - p) * math.log1p(-p)) / LN2


def gaussian(t):
    return math.exp(-t * t / 2)


def sensor(t, edge=EDGE, beyond=0.5):
    return gaussian(t) if t <= edge else beyond


# Occupancy from t and sigma, and how far it reaches.
SENSORS = {
    "SigmaForVariance": (lambda t, s: math.exp(-t * t * s / 2) if t <= EDGE else 0.5, EDGE),
    "HalfMissing": (lambda t, s: math.exp(-t * t) if t <= EDGE else 0.5, EDGE),
    "NormalisedDensity": (lambda t, s: min(1.0, gaussian(t) / (s * math.sqrt(2 * math.pi))) if t <= EDGE else 0.5, EDGE),
    "UnknownFromRange": (lambda t, s: sensor(t, 0), EDGE),
    "EdgeAtOneSigma": (lambda t, s: sensor(t, 1), EDGE),
    "EdgeWithoutTwo": (lambda t, s: sensor(t, math.sqrt(LN2)), EDGE),
    "EdgeAtThreeSigma": (lambda t, s: sensor(t, 3), 3),
    "FreeSpaceUnknown": (lambda t, s: max(sensor(t), 0.5), EDGE),
    "FullWidth": (lambda t, s: math.exp(-4 * LN2 * t * t) if t <= EDGE else 0.5, EDGE),
    "PowerOfTwo": (lambda t, s: 2.0 ** (-t * t / 2) if t <= EDGE else 0.5, EDGE),
}
INFORMATION = {
    "Nats": lambda p: (1 - entropy(p)) * LN2,
    "OneMinusNats": lambda p: 1 - entropy(p) * LN2,
    "Gini": lambda p: (2 * p - 1) ** 2,
    "AbsoluteDeviation": lambda p: abs(2 * p - 1),
    "OneTerm": lambda p: 1 + (p * math.log2(p) if p else 0),
    "Complement": entropy,
    "MrptByte": lambda p: right(mrpt(p)),
    "Percent": lambda p: right(round(100 * p) / 100),
    "ClampedOctoMap": lambda p: right(min(max(p, 1 / (1 + math.e**2)), 1 / (1 + math.exp(-3.5)))),
}


def mrpt(p):
    n = -127 if p == 0 else 127 if p == 1 else max(-127, min(127, round(16 * math.log(p / (1 - p)))))
    return 1 / (1 + math.exp(-n / 16))


def right(p):
    return 1 - entropy(p)


def mean(cells, information=right, keep=lambda p: p != 0.5):
    """Of (p, number of such cells)."""
    seen = sum(n for p, n in cells if keep(p))
    return math.fsum(n * information(p) for p, n in cells if keep(p)) / seen if seen else 0.0


def rings(h, reach, shift=0.5):
    return [((k + shift) * h, 1) for k in range(int(reach / h) + 2) if (k + shift) * h <= reach]


def squares(h, reach, x, y, distance=math.hypot, window=math.inf):
    """Distances of the cells, equal ones together."""
    x, y = x % 1, y % 1
    n = range(-int(reach / h) - 2, int(reach / h) + 3)
    found = {}
    for i, j in product(n, n):
        a, b = (i + x) * h, (j + y) * h
        rho = distance(a, b)
        if rho <= reach and abs(a) <= window and abs(b) <= window:
            found[rho] = found.get(rho, 0) + 1
    return list(found.items())


def quadrant(h, reach, x, y):
    """The distances of the cells of i, j >= 0."""
    x, y = x % 1, y % 1
    n = range(int(reach / h) + 2)
    return [(rho, 1) for i, j in product(n, n) if (rho := math.hypot((i + x) * h, (j + y) * h)) <= reach]


def known_mistakes(kind, z, s, h, x, y, limits):
    """Traps of a grid test; `limits` are the radial and the area limit."""
    reach = z + EDGE * s

    def occupancies(places, model=None, z=z, s=s):
        return [(model((rho - z) / s, s) if model else sensor((rho - z) / s), n) for rho, n in places]

    def places(h=h, reach=reach):
        return rings(h, reach) if kind == "polar" else squares(h, reach, x, y)

    own = places()
    cells = occupancies(own)
    found = {name: mean(cells, information) for name, information in INFORMATION.items()}
    for name, (model, edge) in SENSORS.items():
        found[name] = mean(occupancies(places(reach=z + edge * s) if edge > EDGE else own, model))
    found["CutAtRange"] = mean([(sensor((rho - z) / s), n) for rho, n in own if rho <= z])
    found["MrptThreshold"] = mean(cells, keep=lambda p: entropy(p) * LN2 < LN2 - 0.001)
    found["ThresholdThousandth"] = mean(cells, keep=lambda p: abs(p - 0.5) >= 0.001)
    found["ThresholdHundredth"] = mean(cells, keep=lambda p: abs(p - 0.5) >= 0.01)
    found["OccupiedOnly"] = mean(cells, keep=lambda p: p > 0.5)
    found["FreeOnly"] = mean(cells, keep=lambda p: p < 0.5)
    found["SumForMean"] = math.fsum(n * right(p) for p, n in cells)
    found["LimitForGrid"] = limits[kind == "cartesian"]
    if 5e-3 < 1 / h / reach:
        found["CellsPerMetre"] = mean(occupancies(places(h=1 / h))) if reach * h < 60 else None
    found["HalfResolution"] = mean(occupancies(places(h=2 * h)))
    found["Diameter"] = mean(occupancies(places(reach=z / 2 + EDGE * s), z=z / 2))
    found["RangeSigmaSwapped"] = mean(occupancies(places(reach=s + EDGE * z), z=s, s=z)) if (s + EDGE * z) / h < 100 else None
    seen = sum(n for p, n in cells if p != 0.5)
    total = math.fsum(n * right(p) for p, n in cells)
    if kind == "polar":
        found["SampledAtStart"] = mean(occupancies(rings(h, reach, 0)))
        found["SampledAtEnd"] = mean(occupancies(rings(h, reach, 1)))
        found["AreaWeighted"] = mean([(p, n * rho) for (rho, n), (p, _) in zip(own, cells)])
        found["BeyondReachCounted"] = total / (math.floor(reach / h) + 1)
        found["AreaForRadial"] = limits[1]
        found["FirstCellDropped"], found["LastCellDropped"] = mean(cells[1:]), mean(cells[:-1])
        return found
    found["SampledAtStart"] = mean(occupancies(squares(h, reach, x + 0.5, y + 0.5)))
    found["PolarForCartesian"] = mean(occupancies(rings(h, reach)))
    found["RadialForArea"] = limits[0]
    found["OffsetIgnored"] = mean(occupancies(squares(h, reach, 0, 0)))
    found["OffsetHalf"] = mean(occupancies(squares(h, reach, 0.5, 0.5)))
    found["OffsetXForBoth"] = mean(occupancies(squares(h, reach, x, x))) if x % 1 != y % 1 else None
    found["OffsetYForBoth"] = mean(occupancies(squares(h, reach, y, y))) if x % 1 != y % 1 else None
    found["OffsetInMetres"] = mean(occupancies(squares(h, reach, x / h, y / h)))
    found["OneQuadrant"] = mean(occupancies(quadrant(h, reach, x, y)))
    found["Manhattan"] = mean(occupancies(squares(h, reach, x, y, lambda a, b: abs(a) + abs(b))))
    found["Chebyshev"] = mean(occupancies(squares(h, reach, x, y, lambda a, b: max(abs(a), abs(b)))))
    found["SquareOfDistance"] = mean(occupancies([(rho * rho, n) for rho, n in squares(h, max(reach, math.sqrt(reach)), x, y)]))
    found["WindowCutAtRange"] = mean(occupancies(squares(h, reach, x, y, window=z)))
    side = [sum(abs(i + o % 1) * h <= reach for i in range(-int(reach / h) - 2, int(reach / h) + 3)) for o in (x, y)]
    found["BeyondReachCounted"] = total / (side[0] * side[1]) if seen else None
    return found
