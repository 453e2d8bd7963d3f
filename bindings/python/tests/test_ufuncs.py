"""Functions of a cell: NumPy's rules, and their values against mpmath."""

import warnings

import mean_information as mi
import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

UFUNCS = [
    mi.entropy,
    mi.information,
    mi.entropy_from_log_odds,
    mi.information_from_log_odds,
    mi.occupancy_from_log_odds,
    mi.log_odds_from_occupancy,
]
OF_OCCUPANCY = [mi.entropy, mi.information, mi.log_odds_from_occupancy]


def exact(name: str, x: float) -> mpmath.mpf:
    """Compute a function of a cell by its definition."""
    x = mpmath.mpf(x)
    p = 1 / (1 + mpmath.exp(-x)) if name.endswith("from_log_odds") else x
    q = 1 / (1 + mpmath.exp(x)) if name.endswith("from_log_odds") else 1 - x
    if name.startswith("occupancy"):
        return p
    if name.startswith("log_odds"):
        return mpmath.log(p / q)
    entropy = -sum(r * mpmath.log(r, 2) for r in (p, q) if r)
    return entropy if name.startswith("entropy") else 1 - entropy


def nearest(x: mpmath.mpf, dtype: type) -> np.floating:
    """Round to nearest: a float of mpmath's is a double at most after rounding to its precision."""
    with mpmath.workprec(53 if dtype is np.float64 else 24):
        return dtype(float(+x))


@given(st.floats(2.0**-900, 1, exclude_max=True))
def test_values_of_occupancies_are_correctly_rounded(p):
    # Subnormal results would be rounded twice by mpmath, whose exponents have no end.
    with mpmath.workprec(2000):
        for ufunc in OF_OCCUPANCY:
            x = exact(ufunc.__name__, p)
            assert float(ufunc(p)) == nearest(x, np.float64), ufunc


@given(st.floats(2.0**-100, 1, exclude_max=True, width=32))
def test_values_in_single_precision_are_correctly_rounded(p):
    with mpmath.workprec(400):
        for ufunc in OF_OCCUPANCY:
            result = ufunc(np.float32(p))
            assert result.dtype == np.float32
            assert result == nearest(exact(ufunc.__name__, p), np.float32), ufunc


@given(st.floats(-300, 300).filter(lambda l: l == 0 or abs(l) > 1e-150))
def test_values_of_log_odds_are_correctly_rounded(log_odds):
    with mpmath.workprec(3000):
        for ufunc in UFUNCS[2:5]:
            assert float(ufunc(log_odds)) == nearest(exact(ufunc.__name__, log_odds), np.float64), ufunc


@pytest.mark.parametrize("ufunc", UFUNCS)
def test_they_are_ufuncs(ufunc):
    assert isinstance(ufunc, np.ufunc)
    assert (ufunc.nin, ufunc.nout, ufunc.identity) == (1, 1, None)
    assert {"e->e", "f->f", "d->d"} <= set(ufunc.types)
    assert ufunc.__doc__.startswith(f"{ufunc.__name__}(x, /, out=None")
    assert "Examples" in ufunc.__doc__


def layouts(cells: np.ndarray):
    """Give arrays of the same numbers in other places."""
    yield "plain", cells
    yield "Fortran", np.asfortranarray(cells)
    yield "big-endian", cells.astype(cells.dtype.newbyteorder(">"))
    yield "strided", np.repeat(cells, 3, axis=1)[:, ::3]
    yield "backwards", cells[::-1, ::-1].copy()[::-1, ::-1]
    yield "transposed", cells.T.copy().T
    record = np.zeros(cells.shape, dtype=[("pad", "u1"), ("x", cells.dtype)])
    record["x"] = cells
    yield "misaligned", record["x"]
    frozen = cells.copy()
    frozen.flags.writeable = False
    yield "read-only", frozen


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
@pytest.mark.parametrize("ufunc", UFUNCS)
def test_any_layout_gives_the_same_bits(ufunc, dtype):
    cells = np.random.default_rng(7).random((53, 131)).astype(dtype)
    scalars = np.array([[ufunc(x) for x in row] for row in cells])
    assert scalars.dtype == dtype
    for name, layout in layouts(cells):
        np.testing.assert_array_equal(ufunc(layout), scalars, err_msg=name)


def test_halves_are_computed_in_single_precision():
    cells = np.arange(0, 0x3C01, dtype=np.uint16).view(np.float16)  # all from 0 to 1
    np.testing.assert_array_equal(mi.information(cells), mi.information(cells.astype(np.float32)).astype(np.float16))


def test_out_and_where():
    cells = np.random.default_rng(8).random(5000)
    expected = mi.information(cells)
    out = np.full(5000, 7.0)
    assert mi.information(cells, out=out) is out
    np.testing.assert_array_equal(out, expected)
    out = np.full(5000, 7.0)
    chosen = cells < 0.3
    mi.information(cells, out=out, where=chosen)
    np.testing.assert_array_equal(out, np.where(chosen, expected, 7.0))
    # In place, and into an overlapping part of the same memory.
    own = cells.copy()
    mi.information(own, out=own)
    np.testing.assert_array_equal(own, expected)
    own = cells.copy()
    mi.information(own[:-1], out=own[1:])
    np.testing.assert_array_equal(own[1:], expected[:-1])
    single = np.empty(5000, np.float32)
    mi.information(cells, out=single, casting="same_kind")
    np.testing.assert_array_equal(single, expected.astype(np.float32))


def test_shapes():
    assert mi.information(np.array(0.25)).shape == ()
    assert isinstance(mi.information(0.25), np.float64)
    assert mi.information(np.empty((3, 0, 2))).shape == (3, 0, 2)
    assert mi.information(np.broadcast_to(0.25, (4, 5))).sum() == pytest.approx(20 * 0.18872187554086714)
    with pytest.raises(TypeError):
        mi.information(0.25, 0.5, 0.75)


def test_arrays_of_others_stay_what_they_are():
    masked = np.ma.array([0.25, 0.75], mask=[False, True])
    result = mi.information(masked)
    assert isinstance(result, np.ma.MaskedArray) and result.mask.tolist() == [False, True]
    assert result[0] == 0.18872187554086714
    xarray = pytest.importorskip("xarray")
    cells = xarray.DataArray([[0.25, 0.5]], dims=["y", "x"], coords={"x": [1, 2]}, attrs={"a": 1})
    result = mi.information(cells)
    assert isinstance(result, xarray.DataArray) and result.dims == ("y", "x") and result.coords["x"].size == 2


def test_dask_stays_lazy():
    dask = pytest.importorskip("dask.array")
    lazy = mi.information(dask.full((4, 4), 0.25, chunks=2))
    assert isinstance(lazy, dask.Array) and float(lazy.sum()) == 16 * 0.18872187554086714


@pytest.mark.parametrize("ufunc", UFUNCS)
@pytest.mark.parametrize("dtype", ["?", "b", "B", "h", "H", "i", "I", "l", "L", "q", "Q"])
@pytest.mark.parametrize("size", [1, 100_000])
def test_integers_and_booleans_are_refused_with_the_reason(ufunc, dtype, size):
    with pytest.raises(TypeError, match=r'takes floats.*tally\(cells, encoding="percent"\)'):
        ufunc(np.zeros(size, dtype))


def test_other_types_are_refused():
    for cells in [1, True, [0, 1]]:
        with pytest.raises(TypeError, match="takes floats"):
            mi.entropy(cells)
    for cells in [np.longdouble(0.5), 0.5j, "0.5", np.array([0.5], object), np.array([1], "m8[s]")]:
        with pytest.raises(TypeError):
            mi.entropy(cells)


@pytest.mark.skipif(np.dtype(np.longdouble).itemsize <= 8, reason="longdouble has no more digits here")
@pytest.mark.parametrize("ufunc", UFUNCS)
def test_longdouble_is_refused_with_a_way_out(ufunc):
    cells = np.array([0.25, 0.5], np.longdouble)
    with pytest.raises(TypeError, match=rf"{ufunc.__name__}\(cells.astype\(np.float64\)\) rounds the numbers first"):
        ufunc(cells)
    assert ufunc(cells.astype(np.float64)).dtype == np.float64


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_outside_the_domain_is_nan_with_numpys_warning(dtype):
    bad = np.array([-0.5, 1.5, np.inf, -np.inf], dtype)
    for ufunc in OF_OCCUPANCY:
        with pytest.warns(RuntimeWarning, match=f"invalid value encountered in {ufunc.__name__}"):
            assert np.isnan(ufunc(bad)).all()
        with np.errstate(invalid="raise"), pytest.raises(FloatingPointError):
            ufunc(bad)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert np.isnan(ufunc(np.array([np.nan, 0.5], dtype))).tolist() == [True, False]


@settings(max_examples=30)
@given(st.integers(0, 2**32))
def test_no_other_warning(seed):
    random = np.random.default_rng(seed)
    cells = np.concatenate([random.random(2000), 2.0 ** -random.integers(1, 1075, 2000), [0.0, 0.5, 1.0, 5e-324]])
    log_odds = np.concatenate([random.normal(0, 10, 2000), random.normal(0, 1, 999) * 1e300, [np.inf, -np.inf, 0.0]])
    for dtype in (np.float64, np.float32):
        with np.errstate(all="ignore"):
            occupancies, narrow = cells.astype(dtype), log_odds.astype(dtype)
        with np.errstate(all="raise"):
            for ufunc in OF_OCCUPANCY:
                ufunc(occupancies)
            for ufunc in UFUNCS[2:5]:
                ufunc(narrow)
