"""This package as a port: `meaninfo check -- python -m mean_information.port` judges it by the vectors.

Each operation is answered by the function of this package that a user calls; operations that no function has are answered by
the compiled part, by their names.
"""

import json
import sys
from collections.abc import Callable
from typing import Any

import numpy as np

import mean_information as mi

from . import _native

_FORMATS = {"f32": np.float32, "f64": np.float64}
Float = np.float32 | np.float64


class _Domain(Exception):
    """An argument lies outside the domain."""


def _cell(function: Any) -> Callable[..., Float]:
    """Return the function for one number, which refuses what it gives NaN for."""

    def answer(x: Float) -> Float:
        with np.errstate(invalid="ignore"):
            result: Float = function(x)
        if np.isnan(result):
            raise _Domain
        return result

    return answer


def _expected(weights: np.ndarray[Any, Any], particles: list[np.ndarray[Any, Any]]) -> float:
    """Return the EMMI of particles of one row each."""
    return mi.expected_map([cells[np.newaxis, :] for cells in particles], weights).mean_information


_OPERATIONS: dict[str, Callable[..., Any]] = {
    "cell.entropy": _cell(mi.entropy),
    "cell.information": _cell(mi.information),
    "cell.entropy_from_log_odds": _cell(mi.entropy_from_log_odds),
    "cell.information_from_log_odds": _cell(mi.information_from_log_odds),
    "cell.occupancy_from_log_odds": _cell(mi.occupancy_from_log_odds),
    "map.entropy": lambda cells: mi.tally(cells).entropy,
    "map.information": lambda cells: mi.tally(cells).information,
    "map.mean_information": lambda cells: mi.mean_information(cells),
    "map.observed": lambda cells: mi.tally(cells).observed,
    "expected.mean_information": _expected,
}
"""What functions of this package compute."""

_DOUBLE_ONLY: dict[str, Callable[..., Any]] = {
    "limit.radial": lambda range, sigma: mi.limit(float(range), float(sigma)).value,
    "limit.area": lambda range, sigma: mi.limit(float(range), float(sigma), weight="area").value,
}
"""What functions of this package compute in float64 only."""


def _run(request: dict[str, Any]) -> dict[str, Any]:
    """Return the reply to a request."""
    name, format = request["op"], request["format"]
    if name not in _native.operation_names():
        return {"error": "unknown-operation"}
    if format not in _FORMATS:
        return {"error": "unknown-format"}
    float_type = _FORMATS[format]

    def read(value: Any) -> Any:
        if isinstance(value, str):
            return float_type(float.fromhex(value))
        if value and isinstance(value[0], list):
            return [read(row) for row in value]
        return np.array([float.fromhex(x) for x in value], dtype=float_type)

    names = _native.arguments_of(name)
    if set(names) != set(request["args"]):
        return {"error": "arguments"}
    try:
        arguments = [read(request["args"][key]) for key in names]
    except (TypeError, ValueError):
        return {"error": "arguments"}
    function = _OPERATIONS.get(name) or (_DOUBLE_ONLY.get(name) if format == "f64" else None)
    try:
        if function is not None:
            result = function(*arguments)
        else:
            plain = [argument.tolist() if isinstance(argument, np.ndarray) else float(argument) for argument in arguments]
            result = _native.run_operation(name, format, *plain)
    except (ValueError, _Domain):
        return {"error": "domain"}
    except OverflowError as error:
        return {"skipped": str(error)}
    except TypeError:
        return {"error": "arguments"}
    return {"result": result if isinstance(result, int) else float(result).hex()}


def main() -> None:
    """Serve the port protocol on standard input and output."""
    for line in sys.stdin:
        try:
            request = json.loads(line)
            command = request["cmd"]
        except (ValueError, TypeError, KeyError):
            print(json.dumps({"error": "malformed"}), flush=True)
            continue
        if command == "stop":
            return
        if command == "start" and request.get("protocol") != 1:
            reply: dict[str, Any] = {"error": "protocol"}
        elif command == "start":
            reply = {
                "protocol": 1,
                "name": "mean-information",
                "language": "Python",
                "version": mi.__version__,
                "formats": list(_FORMATS),
                "ops": _native.operation_names(),
            }
        else:
            reply = {"seq": request["seq"], **_run(request)}
        print(json.dumps(reply), flush=True)


if __name__ == "__main__":
    main()
