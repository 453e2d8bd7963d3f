"""Which trajectory makes the most consistent map of a log's scans? `python trajectories.py LOG [TUM...] [--picture OUT.png]`

`meaninfo trajectory` does it with standard errors and a page; this is the same idea in a loop of Python.
"""

import argparse
from pathlib import Path

import mean_information as mi


def map_of(log: mi.ScanLog, trajectory: mi.Trajectory, resolution: float) -> mi.ScanMap:
    """Make the map of all scans that the trajectory has a pose for."""
    scans = mi.ScanMap(resolution, agreement=True)
    for scan in log.scans:
        pose = trajectory.pose_at(scan.time)
        if pose is not None:
            scans.insert(pose, scan.bearings, scan.beams(), max_range=scan.max_range)
    return scans


def compare(log: mi.ScanLog, trajectories: dict[str, mi.Trajectory], resolution: float = 0.1) -> dict[str, mi.ScanMap]:
    """Make and print a map for each trajectory."""
    maps = {name: map_of(log, trajectory, resolution) for name, trajectory in trajectories.items()}
    for name, scans in maps.items():
        print(f"{name}\t{scans.tally().mean_information:.4f} bits per observed cell\tagreement {scans.agreement:.4f}")
    return maps


def draw(maps: dict[str, mi.ScanMap], out: Path) -> None:
    """Draw the maps beside one another, in metres."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(maps), squeeze=False, figsize=(5 * len(maps), 5), layout="constrained")
    for ax, (name, scans) in zip(axes[0], maps.items(), strict=True):
        p = scans.probabilities()
        (x, y), side = scans.origin, scans.resolution
        extent = (x, x + side * p.shape[1], y, y + side * p.shape[0])
        ax.imshow(p, cmap="gray_r", vmin=0, vmax=1, origin="lower", extent=extent)
        ax.set(title=f"{name}: {scans.tally().mean_information:.4f} bits per observed cell", xlabel="x (m)", ylabel="y (m)")
    figure.savefig(out, dpi=100)


def main() -> None:
    """Compare the trajectories of a log and of files."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("log", type=Path)
    parser.add_argument("tum", type=Path, nargs="*")
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    log = mi.read_scans(arguments.log)
    trajectories = dict(log.trajectories) | {path.name: mi.read_trajectory(path) for path in arguments.tum}
    maps = compare(log, trajectories)
    if arguments.picture:
        draw(maps, arguments.picture)


if __name__ == "__main__":
    main()
