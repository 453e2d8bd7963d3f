"""Models of readings that are written in Python."""

from typing import Protocol


class Sensor(Protocol):
    """An inverse sensor model, as `ScanMap` takes it. Distances are in metres."""

    def occupancy(self, distance: float, range: float, /) -> float:
        """Return the occupancy of a point at that distance along a beam that read `range`, in [0, 1]."""

    def reach(self, range: float, /) -> float:
        """Return the distance beyond which `occupancy` is 1/2."""
