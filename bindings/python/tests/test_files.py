"""Files of the field, and the errors of those that are none."""

import copy
import errno
import pickle
import re

import mean_information as mi
import numpy as np
import pytest
from conftest import ROOT


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


@pytest.mark.parametrize("dtype", [np.bool_, np.uint8, np.int8, np.int64, np.float64])
@pytest.mark.parametrize("encoding", ["probability", "percent", "log-odds", "mrpt"])
def test_what_is_refused_of_an_array_is_refused_of_its_file(dtype, encoding, tmp_path):
    cells = np.array([[0, 1], [1, 0]]).astype(dtype)
    np.save(tmp_path / "map.npy", cells)
    np.savez(tmp_path / "map.npz", cells=cells)
    try:
        expected = mi.tally(cells, encoding=encoding)
    except TypeError as error:
        for name in ("map.npy", "map.npz", "map.npz:cells"):
            with pytest.raises(ValueError) as refused:
                mi.read_map(tmp_path / name, encoding=encoding)
            assert str(refused.value) == f"{tmp_path / name}: {error}"
    else:
        for name in ("map.npy", "map.npz", "map.npz:cells"):
            assert mi.read_map(tmp_path / name, encoding=encoding).tally == expected


@pytest.mark.parametrize("value", [127, 128, 200, 254, 255])
@pytest.mark.parametrize("encoding", ["percent", "mrpt"])
def test_bytes_without_sign_are_the_same_in_memory_and_in_files(value, encoding, tmp_path):
    cells = np.array([[0, value]], np.uint8)
    np.save(tmp_path / "map.npy", cells)
    if value <= 127 and encoding == "mrpt" or value == 255 and encoding == "percent":
        assert mi.read_map(tmp_path / "map.npy", encoding=encoding).tally == mi.tally(cells, encoding=encoding)
        return
    allowed = {"percent": "a percentage from 0 to 100, or ", "mrpt": "a byte, from -128 to 127"}[encoding]
    for refused in (lambda: mi.tally(cells, encoding=encoding), lambda: mi.read_map(tmp_path / "map.npy", encoding=encoding)):
        with pytest.raises(ValueError, match=f" is {value}, allowed is {allowed}"):
            refused()


@pytest.mark.parametrize("encoding", ["probability", "log-odds", "percent", "mrpt"])
def test_half_precision_is_of_memory_alone(encoding, tmp_path):
    cells = np.array([[0.25, 0.5]], np.float16)
    np.save(tmp_path / "map.npy", cells)
    with pytest.raises(ValueError, match="map.npy: holds floats other than float32 and float64 .*; save p.astype"):
        mi.read_map(tmp_path / "map.npy", encoding=encoding)
    assert "float16" in mi.read_map.__doc__
    if encoding in ("probability", "log-odds"):
        np.save(tmp_path / "map.npy", cells.astype("f4"))
        assert mi.read_map(tmp_path / "map.npy", encoding=encoding).tally == mi.tally(cells, encoding=encoding)


def test_scans_of_bags_are_the_commands(tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "run_0.mcap").write_bytes(b"")
    for bag in ("run", "run.mcap"):
        with pytest.raises(ValueError, match=r"is a bag: read_bag reads its maps, and the command `meaninfo trajectory` its scans$"):
            mi.read_scans(tmp_path / bag)
    (tmp_path / "empty").mkdir()
    for read in (mi.read_scans, mi.read_map, mi.read_bag):
        with pytest.raises(IsADirectoryError, match="is a folder that holds no bag"):
            read(tmp_path / "empty")


@pytest.mark.parametrize("dtype", [np.bool_, np.uint8, np.int8, np.uint16])
def test_no_encoding_is_guessed_from_the_type_of_a_file(dtype, tmp_path):
    np.save(tmp_path / "map.npy", np.array([[0, 1]]).astype(dtype))
    with pytest.raises(ValueError, match=f"map.npy: encoding 'probability' takes floats, not {np.dtype(dtype)}: .* not guessed"):
        mi.read_map(tmp_path / "map.npy")


def test_what_a_kind_of_file_has_no_use_for_is_refused(tmp_path, maps):
    np.save(tmp_path / "map.npy", np.array([[0.25, 0.5]]))
    for path, arguments in [
        (maps / "room.yaml", {"resolution": 0.1}),
        (maps / "room.yaml", {"encoding": "percent"}),
        (maps / "room.yaml", {"topic": "/map"}),
        (tmp_path / "map.npy", {"semantics": "nav2"}),
        (tmp_path / "map.gridmap", {"semantics": "ros1"}),
        (tmp_path / "map.mcap", {"semantics": "ros1"}),
        (tmp_path / "map.npy", {"mode": "raw"}),
        (tmp_path / "map.npy", {"topic": "/map"}),
        (tmp_path / "map.gridmap", {"unknown": 0.5}),
    ]:
        (name, value), *_ = arguments.items()
        with pytest.raises(ValueError, match=re.escape(f"{path}: {name} is {value!r}, which is for ")):
            mi.read_map(path, **arguments)
    assert mi.read_map(tmp_path / "map.npy", unknown=0.25).tally.unknown == 2
    for time in ("sent", "logged", "x"):
        with pytest.raises(ValueError, match=f"a.pbstream: time is '{time}', which is for CARMEN logs"):
            mi.read_scans(tmp_path / "a.pbstream", time=time)
    assert mi.read_map(maps / "room.yaml", semantics="nav2").tally == mi.read_map(maps / "room.yaml").tally
    assert len(mi.read_scans(maps / "room.log", time="sent").scans) == len(mi.read_scans(maps / "room.log").scans)
    with pytest.raises(ValueError, match="time is 'x', allowed are 'sent' and 'logged'"):
        mi.read_scans(maps / "room.log", time="x")


def test_what_was_read_travels(maps, tmp_path):
    read, log = mi.read_map(maps / "room.yaml"), mi.read_scans(maps / "room.log")
    trajectory = mi.read_trajectory(maps / "room.true.tum")
    for travel in (lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy):
        arrived = travel(read)
        assert repr(arrived) == repr(read) and arrived.tally == read.tally and arrived.warnings == read.warnings
        assert (arrived.resolution, arrived.origin, arrived.encoding) == (read.resolution, read.origin, read.encoding)
        np.testing.assert_array_equal(arrived.cells, read.cells)
        arrived = travel(trajectory)
        np.testing.assert_array_equal(arrived.times, trajectory.times)
        np.testing.assert_array_equal(arrived.poses, trajectory.poses)
        assert arrived.warnings == trajectory.warnings and repr(arrived) == repr(trajectory)
        arrived = travel(log)
        assert len(arrived.scans) == len(log.scans) and set(arrived.trajectories) == set(log.trajectories)
        assert (arrived.mount, arrived.warnings, repr(arrived)) == (log.mount, log.warnings, repr(log))
        for ours, theirs in zip(arrived.scans, log.scans, strict=True):
            for name in ("time", "min_range", "max_range", "laser", "odometry"):
                assert getattr(ours, name) == getattr(theirs, name), name
            for name in ("bearings", "ranges"):
                np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
            np.testing.assert_array_equal(ours.beams(no_return="free"), theirs.beams(no_return="free"))


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
    (tmp_path / "folder.yaml").mkdir()
    for read, name, number in [
        (mi.read_map, "none.yaml", errno.ENOENT),
        (mi.read_map, "none.npy", errno.ENOENT),
        (mi.read_map, "none.npz:cells", errno.ENOENT),
        (mi.read_map, "none.mcap", errno.ENOENT),
        (mi.read_bag, "none.mcap", errno.ENOENT),
        (mi.read_scans, "none.log", errno.ENOENT),
        (mi.read_trajectory, "none.tum", errno.ENOENT),
        (mi.read_map, "folder.yaml", errno.EISDIR),
    ]:
        path = str(tmp_path / name)
        with pytest.raises(OSError) as opened:
            open(path.removesuffix(":cells"))
        with pytest.raises(type(opened.value)) as refused:
            read(path)
        assert (refused.value.errno, refused.value.filename) == (number, opened.value.filename)
        if number == errno.ENOENT and ":" not in name:
            assert str(refused.value) == str(opened.value)
    (tmp_path / "lost.yaml").write_text((maps / "room.yaml").read_text())
    with pytest.raises(FileNotFoundError, match="and there is no file .*; write the path of the image") as refused:
        mi.read_map(tmp_path / "lost.yaml")
    assert (refused.value.errno, refused.value.filename) == (errno.ENOENT, str(tmp_path / "room.pgm"))
    # The file is there: an array of it is not.
    np.savez(tmp_path / "a.npz", x=np.array([[0.25]]))
    with pytest.raises(ValueError, match=r'a.npz:y: has no array "y"; it has x$'):
        mi.read_map(tmp_path / "a.npz:y")
    with pytest.raises(MemoryError, match="raise it with max_cells if the file is meant"):
        mi.read_map(maps / "room.yaml", max_cells=5)
    (tmp_path / "cut.yaml").write_text("image: cut.pgm\nresolution: -1\n")
    with pytest.raises(ValueError, match="cut.yaml: resolution is -1, allowed is a positive number of metres"):
        mi.read_map(tmp_path / "cut.yaml")
    np.save(tmp_path / "wide.npy", np.zeros((2, 2), np.int64))
    with pytest.raises(ValueError, match="wide.npy: encoding 'probability' takes floats, not int64"):
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


def test_costmaps_are_admitted_by_the_word_of_the_command():
    bag, topic = ROOT / "crates/files/tests/bags/maps_lz4.bag", "/global_costmap/costmap"
    for read in (mi.read_bag, mi.read_map):
        with pytest.raises(ValueError, match="; topic names one, and costmaps of `meaninfo bag` admits costmaps$"):
            read(bag, topic=topic)
    assert mi.read_bag(bag, topic=topic, costmaps=True)[0].topic == topic


def test_what_means_nothing_is_said(tmp_path):
    path = tmp_path / "map.npy"
    for cells, words in (([[0.0, 1.0, 0.5]], "thresholded"), ([[0.5, 0.5]], "nothing observed"), ([[0.25, 0.5]], None)):
        np.save(path, np.array(cells))
        read = mi.read_map(path)
        assert read.tally.meaningful is (words is None)
        assert [words in warning for warning in read.warnings] == ([] if words is None else [True])
