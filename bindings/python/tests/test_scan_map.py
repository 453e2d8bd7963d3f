"""What a ScanMap and a Map say of themselves, and how they differ from the command."""

import numpy as np
import pytest

import mean_information as mi

POSE, BEARINGS, RANGES = (0.13, 0.27, 0.0), [0.0, 1.5, -1.5], [1.5, 2.0, np.inf]


def test_mean_information_is_that_of_the_tally(tmp_path):
    scans = mi.ScanMap(0.25)
    assert scans.mean_information() == 0.0
    scans.insert(POSE, BEARINGS, RANGES, max_range=2.0)
    assert scans.mean_information() == scans.tally().mean_information > 0
    np.save(tmp_path / "a.npy", np.array([[0.25, 0.5], [0.875, 0.5]]))
    read = mi.read_map(tmp_path / "a.npy")
    assert read.mean_information == read.tally.mean_information == mi.mean_information(read.cells)


def test_beams_that_did_not_return_are_free_or_left_out():
    free, left_out, returned = mi.ScanMap(0.25), mi.ScanMap(0.25), mi.ScanMap(0.25)
    free.insert(POSE, BEARINGS, RANGES, max_range=2.0)
    left_out.insert(POSE, BEARINGS, RANGES, max_range=2.0, no_return="left-out")
    returned.insert(POSE, BEARINGS[:1], RANGES[:1], max_range=2.0)
    assert left_out.tally() == returned.tally() != free.tally()
    # A scan of which nothing came back says nothing.
    left_out.insert(POSE, [0.0], [2.0], max_range=2.0, no_return="left-out")
    assert left_out.scans == 1
    left_out.remove(POSE, BEARINGS, RANGES, max_range=2.0, no_return="left-out")
    assert left_out.scans == 0
    with pytest.raises(ValueError, match="no_return is 'none', allowed are 'free' and 'left-out'"):
        free.insert(POSE, BEARINGS, RANGES, max_range=2.0, no_return="none")
    with pytest.raises(ValueError, match="NaN"):
        free.insert(POSE, BEARINGS, RANGES, max_range=np.nan, no_return="left-out")


@pytest.mark.parametrize("name", ["a.ot", "a.BT", "a.pbstream"])
def test_what_the_command_alone_measures_is_said(tmp_path, name):
    path = tmp_path / name
    with pytest.raises(FileNotFoundError):
        mi.read_map(path)
    path.write_bytes(b"x")
    with pytest.raises(ValueError, match="is a.*; the command `meaninfo map` measures it"):
        mi.read_map(path)
