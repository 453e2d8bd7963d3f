"""Examples of docstrings run, and every public name has one in NumPy's style."""

import doctest
import inspect
import pydoc

import mean_information as mi
import numpy as np
import pytest

PUBLIC = {name: getattr(mi, name) for name in mi.__all__ if name != "Encoding"}
METHODS = {
    f"{name}.{method}": getattr(kind, method)
    for name, kind in PUBLIC.items()
    if inspect.isclass(kind)
    for method in dir(kind)
    if not method.startswith("_") and callable(getattr(kind, method))
}


@pytest.mark.parametrize("name", [*PUBLIC, *METHODS])
def test_examples(name):
    item = {**PUBLIC, **METHODS}[name]
    document = inspect.getdoc(item)
    assert document, name
    test = doctest.DocTestParser().get_doctest(document, {}, name, None, 0)
    results = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test)
    assert results.failed == 0
    if callable(item) and not inspect.isclass(item):
        is_shown = isinstance(item, np.ufunc) or name in ("tally", "mean_information", "expected_map", "limit")
        assert "Returns\n-------" in document or "Raises\n------" in document, name
        assert results.attempted > 0 or not is_shown, name


@pytest.mark.parametrize("name", ["tally", "mean_information", "expected_map", "read_map"])
def test_signatures_are_readable(name):
    signature = str(inspect.signature(PUBLIC[name]))
    assert "ArrayLike" in signature or name == "read_map"
    # No union that an alias stands for.
    assert "Buffer" not in signature and "_SupportsArray" not in signature and "typing." not in signature
    assert len(signature) < 420


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("read_bag", "read_bag(path, *, topic=None, costmaps=False, max_cells=None)"),
        ("read_scans", "read_scans(path, *, max_range=None, time=None)"),
        ("limit", "limit(range, sigma, *, weight='radial', method='closed-form')"),
        ("Tally", "Tally(dtype=None)"),
        ("ScanMap", "ScanMap(resolution, *, sensor=None, reading_limit=3.5, agreement=False)"),
        ("ScanMap", "insert(self, /, pose, bearings, ranges, *, max_range, no_return='free')"),
        ("RangeScan", "beams(self, /, *, no_return='left-out')"),
        ("Trajectory", "pose_at(self, /, time, *, max_gap=1.0)"),
    ],
)
def test_help_shows_the_arguments_of_what_is_compiled(name, shown):
    assert shown in pydoc.render_doc(PUBLIC[name], renderer=pydoc.plaintext)


def test_the_module_says_how_to_begin():
    assert doctest.testmod(mi).failed == 0 and ">>>" in mi.__doc__
