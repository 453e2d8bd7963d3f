"""Files of the field, and the errors of those that are none."""

import mean_information as mi
import numpy as np
import pytest


def test_a_ros_map(maps):
    room = mi.read_map(maps / "room.yaml")
    assert room.encoding == "percent" and room.cells.dtype == np.int8 and room.resolution == 0.05
    assert room.tally == mi.tally(room.cells, encoding=room.encoding)
    assert isinstance(room.warnings, list) and len(room.origin) == 2
    assert f"shape {room.cells.shape}, percent" in repr(room)
    grey = mi.read_map(str(maps / "room.yaml"), mode="probability", unknown=205)
    assert grey.encoding == "probability" and grey.cells.dtype == np.float64


def test_arrays(tmp_path):
    cells = np.float32([[0.25, 0.5], [0.75, 1.0]])
    np.save(tmp_path / "map.npy", cells)
    read = mi.read_map(tmp_path / "map.npy", resolution=0.1)
    np.testing.assert_array_equal(read.cells, cells)
    assert read.tally == mi.tally(cells) and read.resolution == 0.1
    np.savez(tmp_path / "maps.npz", a=cells, b=cells[:1])
    assert mi.read_map(f"{tmp_path}/maps.npz:b").cells.shape == (1, 2)
    np.save(tmp_path / "signs.npy", np.array([[-32]], np.int8))
    assert mi.read_map(tmp_path / "signs.npy", encoding="mrpt").tally.occupied == 1


def test_scans_and_trajectories(maps):
    log = mi.read_scans(maps / "room.log")
    scan = log.scans[0]
    assert len(log.scans) > 10 and set(log.trajectories) <= {"laser", "odometry"}
    assert scan.bearings.shape == scan.ranges.shape == scan.beams().shape
    assert 0 <= scan.min_range < scan.max_range
    free = scan.beams(no_return="free")
    assert np.isnan(scan.beams()).sum() >= np.isnan(free).sum()
    for path in sorted(maps.glob("*.tum")) + sorted(maps.glob("*.txt")):
        trajectory = mi.read_trajectory(path)
        assert trajectory.poses.shape == (len(trajectory), 3) and (np.diff(trajectory.times) > 0).all()
        assert trajectory.pose_at(trajectory.times[0]) == tuple(trajectory.poses[0])
        assert trajectory.pose_at(trajectory.times[0] - 1) is None


def test_errors_are_pythons_own_in_the_commands_words(tmp_path, maps):
    with pytest.raises(FileNotFoundError, match=r"none\.yaml: cannot be read: No such file"):
        mi.read_map(tmp_path / "none.yaml")
    with pytest.raises(FileNotFoundError):
        mi.read_scans(tmp_path / "none.log")
    with pytest.raises(FileNotFoundError):
        mi.read_trajectory(tmp_path / "none.tum")
    with pytest.raises(OSError, match="is a directory"):
        (tmp_path / "folder.yaml").mkdir()
        mi.read_map(tmp_path / "folder.yaml")
    with pytest.raises(MemoryError, match="raise it with max_cells if the file is meant"):
        mi.read_map(maps / "room.yaml", max_cells=5)
    (tmp_path / "cut.yaml").write_text("image: cut.pgm\nresolution: -1\n")
    with pytest.raises(ValueError, match="cut.yaml: resolution is -1, allowed is a positive number of metres"):
        mi.read_map(tmp_path / "cut.yaml")
    np.save(tmp_path / "wide.npy", np.zeros((2, 2), np.int64))
    with pytest.raises(ValueError, match="encoding percent reads them as they are"):
        mi.read_map(tmp_path / "wide.npy")
    (tmp_path / "line.tum").write_text("1 2 3\n")
    with pytest.raises(ValueError, match="line.tum"):
        mi.read_trajectory(tmp_path / "line.tum")
    with pytest.raises(ValueError, match="is no map file by its name"):
        (tmp_path / "a.doc").write_text("x")
        mi.read_map(tmp_path / "a.doc")
    for arguments in ({"semantics": "x"}, {"mode": "x"}, {"encoding": "x"}):
        with pytest.raises(ValueError, match="is 'x', allowed are"):
            mi.read_map(maps / "room.yaml", **arguments)
