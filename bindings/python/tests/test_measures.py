"""Arrays measured: encodings, axes, masks, and what is refused."""

import pathlib
import threading
import warnings

import mean_information as mi
import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

ULP = 2.0**-52


@given(hnp.arrays(np.float64, hnp.array_shapes(max_dims=3), elements=st.floats(0, 1)))
def test_sums_are_those_of_the_definition(cells):
    tally = mi.tally(cells)
    with mpmath.workprec(2200):
        information = mpmath.mpf(0)
        for p in map(mpmath.mpf, cells.ravel().tolist()):
            information += 1 + sum(r * mpmath.log(r, 2) for r in (p, 1 - p) if r)
        observed = int(np.count_nonzero(cells != 0.5))
        # Within 1.5 ulp, and half the smallest number for each subnormal term: docs/guarantees.md.
        least = 2.0**-1074 * cells.size
        assert abs(tally.information - information) <= 1.5 * ULP * float(information) + least
        assert abs(tally.entropy - (cells.size - information)) <= 1.5 * ULP * tally.entropy + least
        if observed:
            assert abs(tally.mean_information - information / observed) <= 1.5 * ULP * tally.mean_information + least
    assert tally.observed == observed and tally.cells == cells.size
    assert tally.free == np.count_nonzero(cells < 0.5) and tally.occupied == np.count_nonzero(cells > 0.5)
    assert mi.mean_information(cells) == tally.mean_information


def other_layouts(cells):
    yield np.asfortranarray(cells)
    yield cells[::-1].copy()[::-1]
    yield np.repeat(cells, 2, axis=-1)[..., ::2]
    yield cells.astype(cells.dtype.newbyteorder(">"))
    record = np.zeros(cells.shape, dtype=[("pad", "u1"), ("x", cells.dtype)])
    record["x"] = cells
    yield record["x"]


@pytest.mark.parametrize(
    ("encoding", "dtypes"),
    [
        ("probability", ["f2", "f4", "f8"]),
        ("log-odds", ["f2", "f4", "f8"]),
        ("percent", ["i1", "u1", "i2", "u4", "i8"]),
        ("mrpt", ["i1", "u1", "i4"]),
    ],
)
def test_layouts_and_splits_change_no_bit(encoding, dtypes):
    random = np.random.default_rng(3)
    for dtype in map(np.dtype, dtypes):
        shape = (7, 61, 83)
        if dtype.kind == "f":
            cells = random.random(shape) if encoding == "probability" else random.normal(0, 3, shape)
        else:
            low = 0 if dtype.kind == "u" else -1
            cells = random.integers(low, 101, shape)
        cells = cells.astype(dtype)
        whole = mi.tally(cells, encoding=encoding)
        assert whole.cells == cells.size
        assert whole.dtype == (np.float32 if dtype in ("f2", "f4") else np.float64)
        for layout in other_layouts(cells):
            assert mi.tally(layout, encoding=encoding) == whole
        assert sum(mi.tally(part, encoding=encoding) for part in cells) == whole
        each = mi.mean_information(cells, encoding=encoding, axis=(1, 2))
        assert each.dtype == whole.dtype
        assert [float(x) for x in each] == [mi.tally(part, encoding=encoding).mean_information for part in cells]
        along = mi.mean_information(cells, encoding=encoding, axis=0)
        assert along.shape == shape[1:]
        assert float(along[5, 7]) == mi.mean_information(cells[:, 5, 7], encoding=encoding)
        columns = mi.mean_information(cells, encoding=encoding, axis=-2, keepdims=True)
        assert columns.shape == (7, 1, 83)
        assert float(columns[2, 0, 9]) == mi.mean_information(cells[2, :, 9], encoding=encoding)


@given(hnp.arrays(np.float64, (3, 4, 5), elements=st.floats(0, 1)), hnp.arrays(np.bool_, (4, 1)))
def test_where_leaves_cells_out(cells, where):
    chosen = cells[np.broadcast_to(where, cells.shape)]
    assert mi.tally(cells, where=where) == mi.tally(chosen)
    assert mi.mean_information(cells, where=where) == mi.mean_information(chosen)
    masked = np.ma.array(cells, mask=~np.broadcast_to(where, cells.shape))
    assert mi.tally(masked) == mi.tally(chosen)
    assert mi.tally(masked, where=cells < 0.7) == mi.tally(cells, where=where & (cells < 0.7))
    rows = mi.mean_information(cells, where=where, axis=(0, 2))
    for row, (mean, meant) in enumerate(zip(rows, where[:, 0], strict=True)):
        assert mean == (mi.mean_information(cells[:, row]) if meant else 0)


def test_encodings_mean_what_they_say():
    assert mi.tally([-1, 0, 50, 100], encoding="percent").observed == 2
    assert mi.tally(np.array([255, 83], np.uint8), encoding="percent").information == mi.information(0.83)
    assert mi.tally(np.array([-32], np.int8), encoding="mrpt").information == mi.information_from_log_odds(2.0)
    assert mi.tally([2.0, np.inf], encoding="log-odds").information == 1.4729346589968385
    single = mi.tally(np.float32([0.3]))
    assert single.information == float(mi.information(np.float32(0.3)))


@pytest.mark.parametrize("encoding", ["probability", "log-odds", "percent", "mrpt"])
@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.float16])
@pytest.mark.parametrize("size", [1, 15, 16, 100, 1023, 1024, 5000])
def test_many_maps_have_the_bits_of_each(encoding, dtype, size):
    random = np.random.default_rng(size)
    shape = (size, 7) if size > 1000 else (size, 211)
    if encoding in ("percent", "mrpt"):
        if dtype != np.float64:
            pytest.skip("bytes have one type")
        cells = random.integers(-1, 101, shape).astype(np.int8)
        cells[random.random(shape) < 0.3] = -1
    else:
        cells = random.random(shape) if encoding == "probability" else random.normal(0, 9, shape)
        cells[random.random(shape) < 0.3] = 0.5 if encoding == "probability" else 0.0
        # Information that is rounded to 0 is no unknown cell.
        cells[0, 0] = 0.5 - 2.0**-54 if encoding == "probability" else 1e-170
        cells = cells.astype(dtype)
    where = random.random(shape) < 0.6
    expected = [mi.tally(cells[:, k], encoding=encoding).mean_information for k in range(shape[1])]
    chosen = [mi.tally(cells[where[:, k], k], encoding=encoding).mean_information for k in range(shape[1])]
    for layout in (cells, np.asfortranarray(cells), np.repeat(cells, 2, axis=0)[::2]):
        assert mi.mean_information(layout, encoding=encoding, axis=0).tolist() == expected
        assert mi.mean_information(layout, encoding=encoding, axis=0, where=where).tolist() == chosen
    rows = np.ascontiguousarray(cells.T)
    assert mi.mean_information(rows, encoding=encoding, axis=1).tolist() == expected
    assert mi.mean_information(rows, encoding=encoding, axis=1, where=where.T).tolist() == chosen


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_masks_of_any_layout(dtype):
    random = np.random.default_rng(12)
    cells = random.random((37, 5, 143)).astype(dtype)
    for share in (0.0, 0.02, 0.5, 0.98, 1.0):
        where = random.random(cells.shape) < share
        expected = mi.tally(cells[where])
        for mask in (where, np.asfortranarray(where), np.repeat(where, 2, axis=2)[..., ::2]):
            assert mi.tally(cells, where=mask) == expected
            assert mi.tally(np.asfortranarray(cells), where=mask) == expected
            assert mi.tally(np.repeat(cells, 2, axis=2)[..., ::2], where=mask) == expected
        assert mi.tally(np.ma.array(cells, mask=~where)) == expected
    for mask in (np.array(True), where[:1], where[:, :, :1], where[0, 0], random.random((5, 1)) < 0.5):
        whole = np.broadcast_to(mask, cells.shape)
        assert mi.tally(cells, where=mask) == mi.tally(cells[whole])
        assert mi.tally(cells.T, where=whole.T) == mi.tally(cells[whole])
    with pytest.raises(ValueError, match=r"cells\[3, 4, 142\] is nan"):
        cells[3, 4, 142] = np.nan
        mi.tally(cells, where=np.arange(143) > 140)


def test_types_of_results():
    for dtype, result in [(np.float16, np.float32), (np.float32, np.float32), (np.float64, np.float64)]:
        cells = np.array([0.25, 0.5], dtype)
        assert type(mi.mean_information(cells, axis=0)) is result
        assert mi.mean_information(cells[None], axis=1).dtype == result
        assert mi.mean_information(cells, axis=0, keepdims=True).dtype == result
        assert type(mi.mean_information(cells)) is float
    assert type(mi.mean_information([-1, 0], encoding="percent", axis=0)) is np.float64


def test_results_of_no_cells():
    for cells in (np.empty(0), np.empty((0, 3)), [0.5, 0.5]):
        assert mi.mean_information(cells) == 0.0
    assert mi.mean_information(np.empty((2, 0)), axis=1).tolist() == [0.0, 0.0]
    assert mi.mean_information(np.empty((0, 2)), axis=1).shape == (0,)
    assert mi.mean_information(np.array(0.25)) == 0.18872187554086714
    assert mi.mean_information([[0.25]], axis=()).tolist() == [[0.18872187554086714]]
    assert mi.mean_information([[0.25]], keepdims=True).tolist() == [[0.18872187554086714]]
    assert mi.tally([]) == mi.Tally()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("size", [10, 4097, 3_000_001])
def test_the_first_cell_outside_the_domain_is_named(dtype, size):
    cells = np.full(size, 0.3, dtype)
    cells[[size - 2, size - 1]] = 1.5
    with pytest.raises(ValueError, match=rf"^cells\[{size - 2}\] is 1.5, allowed is a probability from 0 to 1; if they are per"):
        mi.tally(cells)
    cells[size // 2] = np.nan
    for measure in (mi.tally, mi.mean_information):
        with pytest.raises(ValueError, match=rf"cells\[{size // 2}\] is nan.*; where=~np.isnan\(cells\)"):
            measure(cells)
    assert mi.tally(cells, where=(cells < 1)).cells == size - 3


def test_its_index_is_that_of_the_whole_array():
    cells = np.full((3, 4, 5), 0.3)
    cells[2, 1, 0] = cells[1, 3, 2] = -0.25
    for axis in (None, 0, (1, 2)):
        with pytest.raises(ValueError, match=r"cells\[1, 3, 2\] is -0.25"):
            mi.mean_information(np.asfortranarray(cells), axis=axis)
    with pytest.raises(ValueError, match=r"^cells is nan"):
        mi.tally(np.array(np.nan))
    with pytest.raises(ValueError, match=r"cells\[1, 0\] is 101, allowed is a percentage from 0 to 100, or -1"):
        mi.tally(np.array([[1], [101]], np.int8), encoding="percent")
    with pytest.raises(ValueError, match=r"cells\[1\] is 300, allowed is a percentage from 0 to 100, or -1 for unknown$"):
        mi.tally([1, 300], encoding="percent")
    with pytest.raises(ValueError, match=r"cells\[1\] is 300, allowed is a byte, from -128 to 127$"):
        mi.tally([1, 300], encoding="mrpt")
    with pytest.raises(ValueError, match=r"cells\[1\] is 224, allowed is a byte, from -128 to 127; cells.view\(np.int8\) takes"):
        mi.tally(np.array([1, 224], np.uint8), encoding="mrpt")


def test_bytes_without_sign_are_shown_without():
    grey = np.array([[0, 254], [205, 100]], np.uint8)
    for measure in (mi.tally, mi.mean_information):
        words = r"cells\[0, 1\] is 254, allowed is a percentage from 0 to 100, or 255 for unknown; "
        with pytest.raises(ValueError, match=words):
            measure(grey, encoding="percent")
    assert mi.mean_information(np.array([[0, 255], [50, 83]], np.uint8), encoding="percent", axis=1).tolist() == [
        1.0,
        mi.information(0.83),
    ]


WHOLE = r'; of percentages \(ROS\) in floats, -1 for unknown, cells.astype\(np.int8\) with encoding="percent", as all are whole'
OTHERS = r"; if they are percentages, -1 for unknown, np.where\(cells == -1, 0.5, cells / 100\) makes probabilities of them$"


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ([0.5, 1.0, 17.3], OTHERS),
        ([0.0, 1.0, 50.0], WHOLE),
        ([-1.0, 0.0, 100.0], WHOLE),
        ([-1.0, 33.7, 100.0], OTHERS),
        ([-1.0, 0.0, 0.5, 1.0], r"; np.where\(cells == -1, 0.5, cells\) makes -1 unknown$"),
        ([-1e-9, -1.0, 0.25], r"; np.where\(cells == -1, 0.5, cells\) makes -1 unknown$"),
        ([0.5, 1.0, 1.0000000001], r"; np.clip\(cells, 0, 1\) cuts rounding off$"),
        ([-1.0, -0.25, 0.5], "a probability from 0 to 1$"),
        ([-7.0, 50.0], "a probability from 0 to 1$"),
        ([0.5, 255.0], "a probability from 0 to 1$"),
    ],
)
def test_a_refusal_says_what_may_help(cells, words):
    with pytest.raises(ValueError, match=words):
        mi.tally(np.array(cells))


STEPS = {
    "np.where(cells == -1, 0.5, cells)": lambda cells: (np.where(cells == -1, 0.5, cells), "probability"),
    "np.where(cells == -1, 0.5, cells / 100)": lambda cells: (np.where(cells == -1, 0.5, cells / 100), "probability"),
    "cells.astype(np.int8)": lambda cells: (cells.astype(np.int8), "percent"),
    "np.clip(cells, 0, 1)": lambda cells: (np.clip(cells, 0, 1), "probability"),
}


@pytest.mark.parametrize(
    ("cells", "meant"),
    [
        ([-1.0, 0.0, 100.0], [0.5, 0.0, 1.0]),
        ([100.0, -1.0, 0.0, 37.0], [1.0, 0.5, 0.0, 0.37]),
        ([-1.0, 33.7, 100.0], [0.5, 0.337, 1.0]),
        ([-1.0, 0.25, 1.0], [0.5, 0.25, 1.0]),
        ([-1e-9, -1.0, 0.25], [0.0, 0.5, 0.25]),
        ([1.0000000001, -1.0, 0.25], [1.0, 0.5, 0.25]),
    ],
)
@pytest.mark.parametrize("asked", ["probability", "percent"])
def test_what_refusals_say_leads_to_the_map_that_was_meant(cells, meant, asked):
    """Whoever does what the words say, as often as they say it, gets the tally of what was meant, or no tally."""
    given = cells = np.array(cells)
    encoding = asked
    for _ in range(4):
        try:
            tally = mi.tally(cells, encoding=encoding)
            break
        except (TypeError, ValueError) as error:
            words = str(error)
        named = [step for step in STEPS if step in words]
        # Where there are two, the last is for whole numbers.
        are_whole = (cells == np.floor(cells)).all()
        cells, encoding = STEPS[named[-1 if are_whole else 0]](cells)
    if asked == "probability" or given.max() > 1.5:
        assert tally == mi.tally(meant)


@pytest.mark.parametrize(
    ("cells", "encoding", "words"),
    [
        ([0, 1], "probability", "takes floats, not int64.*encoding=\"percent\""),
        ([True], "log-odds", "takes floats, not bool"),
        ([0.5], "percent", r"takes integers, not float64; cells.astype\(np.int8\) .* cells / 100\) are probabilities"),
        ([0.5], "mrpt", r"takes integers, not float64; cells.astype\(np.int8\) makes them integers, if they are whole numbers$"),
        ([True], "mrpt", "takes integers, not bool; np.where"),
        (np.array([0.5], object), "probability", "array of floats, not of object"),
        (["0.5"], "probability", "array of floats, not of <U3"),
        ([0.5j], "probability", "array of floats, not of complex128"),
        (
            np.longdouble([0.5]),
            "probability",
            r"float64, float32 and float16, not .*: cells.astype\(np.float64\) rounds the numbers first$",
        ),
    ],
)
def test_a_type_that_an_encoding_does_not_have_is_refused(cells, encoding, words):
    with pytest.raises(TypeError, match=words):
        mi.tally(cells, encoding=encoding)


def test_other_arguments_are_refused():
    with pytest.raises(ValueError, match="encoding is 'percentage', allowed are 'probability', 'percent'"):
        mi.tally([0.5], encoding="percentage")
    with pytest.raises(TypeError, match="where takes booleans, not int64"):
        mi.tally([0.5], where=[1])
    with pytest.raises(ValueError, match="broadcast"):
        mi.tally([0.5, 0.3], where=[True, False, True])
    with pytest.raises(np.exceptions.AxisError):
        mi.mean_information([0.5], axis=1)
    with pytest.raises(ValueError, match="axis"):
        mi.mean_information([[0.5]], axis=(0, -2))
    for axis in (1.0, "0", (0, 1.5), ((0, 1), 0), [[0], [1]]):
        with pytest.raises(TypeError, match="axis is .*, allowed are an integer, a sequence of integers, and None"):
            mi.mean_information([[0.5]], axis=axis)
    with pytest.raises(TypeError):
        mi.mean_information([0.5], "probability")
    for file in ("map.npy", pathlib.Path("map.npy")):
        with pytest.raises(TypeError, match=r"cells is .*map.npy.*, allowed is an array; read_map\(.*\).tally measures a file"):
            mi.tally(file)
    for contents in (bytes(10_000), bytearray(10_000)):
        with pytest.raises(TypeError, match=r"^cells is byte\w+, allowed is an array; np.frombuffer") as refused:
            mi.tally(contents)
        assert len(str(refused.value)) < 100


def test_no_warning_is_given():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mi.tally([0.0, 1.0, 0.5])
        mi.mean_information([])
        mi.tally([-1, 100], encoding="percent")


def test_maps_that_another_thread_writes_have_means_that_maps_have():
    cells = np.full((2000, 16), 0.5)
    ends = threading.Event()

    def write():
        while not ends.is_set():
            for value in (0.5, 1.0):
                cells[:] = value

    writer = threading.Thread(target=write)
    writer.start()
    try:
        # Of 1/2 and 1 the mean is 0 or 1, whatever mixture is seen.
        for _ in range(300):
            assert np.isin(mi.mean_information(cells, axis=1), (0, 1)).all()
    finally:
        ends.set()
        writer.join()
