"""A particle filter's maps: how consistent are its hypotheses? `python particle_filter.py`

Three particles agree on a corridor and disagree on a wall. The mean information of each map says nothing of that; that of
the expected map, EMMI, falls as soon as particles that disagree have weight.
"""

import mean_information as mi
import numpy as np


def particles() -> np.ndarray:
    """Return three maps of 40 x 60 cells."""
    maps = np.full((3, 40, 60), 0.5)
    maps[:, 10:30, :] = 0.1
    for particle, column in enumerate((40, 41, 47)):
        maps[particle, 10:30, column] = 0.9
        maps[particle, 10:30, column + 1 :] = 0.5
    return maps


def main() -> None:
    """Print EMMI for shares of weight of the third particle."""
    maps = particles()
    print("each particle:", mi.mean_information(maps, axis=(1, 2)))
    for share in (0.0, 0.1, 0.3, 0.5):
        expected = mi.expected_map(maps, [1 - share, 0.0, share])
        print(f"third particle {share:.1f}: EMMI {expected.mean_information:.4f}, of particles {expected.mean_of_particles:.4f}")


if __name__ == "__main__":
    main()
