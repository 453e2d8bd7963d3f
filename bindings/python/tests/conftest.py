"""What the tests share: the repository's files, and the binary to compare the command with."""

import os
import sys
from pathlib import Path

import hypothesis
import pytest

# Times are no matter of tests.
hypothesis.settings.register_profile("untimed", deadline=None)
hypothesis.settings.load_profile("untimed")

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def maps() -> Path:
    """Return the folder of sample maps and logs."""
    return ROOT / "maps"


@pytest.fixture
def meaninfo() -> str:
    """Return the binary `meaninfo` that cargo built, or skip."""
    path = os.environ.get("MEANINFO", str(ROOT / "target/release/meaninfo"))
    if not Path(path).exists():
        pytest.skip(f"{path} is not there: cargo build --release --package mean-information-cli, or MEANINFO names it")
    return path


@pytest.fixture
def python() -> str:
    """Return the interpreter that runs the tests."""
    return sys.executable
