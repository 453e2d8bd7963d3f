"""The class Tally."""

import copy
import hashlib
import pickle

import mean_information as mi
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

CELLS = st.lists(st.floats(0, 1), max_size=20)


@given(CELLS, CELLS)
def test_tallies_add_up_and_travel(here, there):
    a, b = mi.tally(np.array(here, float)), mi.tally(np.array(there, float))
    whole = mi.tally(np.array(here + there, float))
    assert a + b == b + a == sum([a, b]) == whole
    assert hash(a + b) == hash(whole) and len({a + b, whole}) == 1
    for arrived in (
        mi.Tally.from_bytes(a.to_bytes()),
        mi.Tally.from_bytes(memoryview(bytearray(a.to_bytes()))),
        pickle.loads(pickle.dumps(a)),
        copy.deepcopy(a),
    ):
        assert arrived == a and arrived.to_bytes() == a.to_bytes()
    assert (a == b) == (a.to_bytes() == b.to_bytes())


def test_bytes_are_the_golden_ones():
    """Those of cells at 1/4, 1/2 and 1: tests/library/tally_bytes.rs."""
    data = bytearray(324)
    data[:8] = b"\x89MI\n\x01\x00\x40\x00"
    data[8] = data[16] = data[24] = 1
    data[159:167] = [96, 124, 12, 82, 177, 191, 62, 7]
    data[303:311] = [152, 131, 243, 173, 78, 64, 193, 4]
    data[320:] = [50, 224, 48, 97]
    assert mi.tally([0.25, 0.5, 1.0]).to_bytes() == data
    assert mi.Tally.from_bytes(data) == mi.tally([0.25, 0.5, 1.0])
    assert len(hashlib.sha256(data).hexdigest()) == 64


def test_single_and_double_precision_stay_apart():
    single, double = mi.tally(np.float32([0.25])), mi.tally([0.25])
    assert single != double and single.dtype == np.float32
    assert mi.Tally.from_bytes(single.to_bytes()) == single
    with pytest.raises(TypeError, match="float32 and of float64"):
        single + double
    assert mi.Tally(dtype="float32") + single == single
    assert mi.Tally() + double == double


def test_an_empty_tally_takes_what_numpy_takes_for_a_type():
    for dtype in ("float32", np.float32, np.dtype("f4"), mi.tally(np.float32([0.5])).dtype):
        assert mi.Tally(dtype).dtype == np.float32
    assert mi.Tally().dtype == mi.Tally(float).dtype == np.float64
    for dtype in ("float16", np.int8):
        with pytest.raises(ValueError, match="dtype is .*, allowed are float64 and float32"):
            mi.Tally(dtype)
    assert mi.Tally(np.float64(0.3).dtype).dtype == np.float64

    class Column:
        dtype = np.dtype(np.float32)

    for cells in (np.array([0.25, 0.5]), [0.25, 0.5], 0.25, np.float64(0.3), Column(), mi.tally([0.25])):
        with pytest.raises(TypeError, match=r"tally\(cells\) measures an array"):
            mi.Tally(cells)


def test_bytes_of_no_tally_are_refused():
    data = mi.tally([0.25, 0.5]).to_bytes()
    for bit in range(8 * len(data)):
        flipped = bytearray(data)
        flipped[bit // 8] ^= 1 << bit % 8
        with pytest.raises(ValueError):
            mi.Tally.from_bytes(flipped)
    later = data[:4] + b"\x02\x00" + data[6:]
    with pytest.raises(ValueError, match="version of the bytes of a tally is 2, allowed is 1: a later release wrote them"):
        mi.Tally.from_bytes(later)
    with pytest.raises(ValueError, match="number of bytes of a tally is 0, allowed is 324"):
        mi.Tally.from_bytes(b"")
    with pytest.raises(TypeError):
        mi.Tally.from_bytes(324)
    with pytest.raises(TypeError):
        mi.Tally.from_bytes("text")


def test_a_tally_is_immutable_and_says_something():
    tally = mi.tally([0.25, 0.5, 0.96875])
    assert repr(tally) == "<Tally: 0.49404977561407626 bits per observed cell; 2 observed (1 free, 1 occupied), 1 unknown>"
    assert repr(mi.tally([1.0])).startswith("<Tally: 1.0 bits per observed cell; ")
    for name in ("entropy", "observed", "other"):
        with pytest.raises(AttributeError):
            setattr(tally, name, 1)
    before = tally.to_bytes()
    total = tally
    total += mi.tally([0.75])
    assert tally.to_bytes() == before and total.cells == 4
    for other in (1, 0.5, "x", None):
        with pytest.raises(TypeError):
            tally + other
        with pytest.raises(TypeError):
            other + tally
        assert tally != other


def test_more_cells_than_counts_hold_are_refused():
    tally = mi.tally([0.5])
    for _ in range(63):
        tally = tally + tally
    assert tally.cells == 2**63
    with pytest.raises(OverflowError, match=r"2\^64 - 1"):
        tally + tally


def test_thresholded_and_empty_maps_mean_nothing():
    for cells in ([0.0, 1.0, 0.5], [1.0, 1.0], [0.5, 0.5], []):
        assert mi.tally(cells).meaningful is False
        assert mi.tally(np.array(cells, dtype=np.float32)).meaningful is False
    for cells in ([0.0, 1.0, 0.25], [0.5, 0.75]):
        assert mi.tally(cells).meaningful is True
    assert mi.tally(np.array([0, 100, -1], dtype=np.int8), encoding="percent").meaningful is False
    assert sum([mi.tally([0.0]), mi.tally([0.25])]).meaningful is True
