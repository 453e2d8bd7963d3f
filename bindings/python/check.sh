#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh environment and tests it there: `bindings/python/check.sh [ENVIRONMENT [WHEEL]]`.
# With WHEEL, tests this one. Needs Rust, Python with venv, and PyPI. Compiles into the target folder of the repository, as
# `cargo test` does and with what that compiled; the library with optimization.
set -euo pipefail
cd "$(dirname "$0")"
here=$PWD
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$here/../../target}
environment=${1:-$CARGO_TARGET_DIR/wheel}
wheel=${2:+$(realpath "$2")}

cargo fmt --check
python3 -m venv --clear "$environment"
environment=$(cd "$environment" && pwd)
export PATH="$environment/bin:$PATH" PIP_DISABLE_PIP_VERSION_CHECK=1
if [ -z "$wheel" ]; then
  pip install --quiet 'maturin>=1.9,<2'
  maturin build --quiet --out "$environment/dist"
  wheel=$(echo "$environment"/dist/*.whl)
fi
pip install --quiet --no-compile "$wheel[test,examples]"

# Away from the source: nothing of it is imported but the tests.
cd "$environment"
python -m pytest --quiet --config-file="$here/pyproject.toml" --rootdir="$environment" -p no:cacheprovider \
  "$here/tests" "$here/README.md"
python -m mypy.stubtest --ignore-unused-allowlist --allowlist "$here/stubtest_allowed.txt" mean_information
python -m mypy --config-file="$here/pyproject.toml" --package mean_information
