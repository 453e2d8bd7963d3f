#!/usr/bin/env python3
"""Checks every file of vectors; with --write, writes the checksums v1/SHA256SUMS, else checks them too.

Needs only the standard library; the schema is checked where the package jsonschema is installed. It knows nothing of the
generators: it reads the files as a port's author would.
"""

import hashlib
import json
import math
import re
import struct
import sys
from fractions import Fraction
from pathlib import Path

VECTORS = Path(__file__).parent.parent
FOLDER = VECTORS / "v1"
SUMS = FOLDER / "SHA256SUMS"
# Significant bits, exponent of the smallest float, code of struct.
FORMATS = {"f64": (53, -1074, "d"), "f32": (24, -149, "f")}
TRAP_APART = Fraction(1, 2**16)
LARGEST_FILE, LARGEST_FOLDER = 1_500_000, 8_000_000
DECIMAL_DIGITS = 40

problems = []


def check(holds, *place):
    if not holds:
        problems.append(": ".join(map(str, place)))


def canonical(x):
    """The one spelling of a float."""
    if not math.isfinite(x):
        return str(x)
    significand, exponent = x.hex().split("p")
    return f"{significand.rstrip('0').rstrip('.') if '.' in significand else significand}p{int(exponent):+d}"


def check_float(text, format, *place):
    x = float.fromhex(text)
    check(text == canonical(x), *place, f"{text} is not canonical")
    if math.isfinite(x):
        try:
            fits = struct.unpack(FORMATS[format][2], struct.pack(FORMATS[format][2], x))[0] == x
        except OverflowError:
            fits = False
        check(fits, *place, f"{text} is no {format}")
    return x


def floats(value):
    if isinstance(value, list):
        for item in value:
            yield from floats(item)
    else:
        yield value


def shape_of(value):
    if isinstance(value, str):
        return "float"
    return "rows" if any(isinstance(item, list) for item in value) else "list"


def named_by(test):
    """How an id ends: with the arguments, or where these are lists with the kind of the test and a hash of them."""
    if all(isinstance(value, str) for value in test["args"].values()):
        return ",".join(test["args"].values())
    kind = test["id"].split("/")[-1].rsplit("-", 1)[0]
    return f"{kind}-{hashlib.sha256(json.dumps(test['args']).encode()).hexdigest()[:12]}"


def spacing(x, format):
    """Of the floats of a format at a fraction."""
    precision, lowest, _ = FORMATS[format]
    if x == 0:
        return Fraction(2) ** lowest
    top = x.numerator.bit_length() - x.denominator.bit_length()
    top -= x < Fraction(2) ** top
    return Fraction(2) ** max(top - precision + 1, lowest)


def nearest(x, format):
    step = spacing(x, format)
    return round(x / step) * step


def check_want(want, result, tolerance, format, *place):
    check(("count" in want) == (result == "count") or "error" in want, *place, "the wrong kind of result")
    if "lo" not in want:
        return
    lo, hi = Fraction(want["lo"]), Fraction(want["hi"])
    check(lo <= hi, *place, "an enclosure that holds nothing")
    if lo < hi:
        # A zero lo: the value is below every float.
        written = max(len(re.sub(r"\D", "", end.split("e")[0]).strip("0")) for end in (want["lo"], want["hi"]))
        check(written >= DECIMAL_DIGITS - 6 or lo == 0 or hi == 1, *place, "fewer than 40 digits")
        check(hi - lo <= hi * Fraction(1, 10 ** (DECIMAL_DIGITS - 2)) or hi < Fraction(2) ** -1200, *place, "a wide enclosure")
    if tolerance == 0.5:
        check(nearest(lo, format) == nearest(hi, format), *place, "the enclosure does not decide the rounding")


def check_traps(test, *place):
    for name, trap in test.get("traps", {}).items():
        if isinstance(trap, int):
            check(trap != test["want"].get("count"), *place, name, "a trap that is right")
            continue
        value = check_float(trap, test["format"], *place, name)
        if not math.isfinite(value):
            continue
        for want in [test["want"], *test.get("also", [])]:
            if "lo" in want:
                lo, hi = Fraction(want["lo"]), Fraction(want["hi"])
                close = lo - TRAP_APART * lo <= Fraction(value) <= hi + TRAP_APART * hi
                check(not close, *place, name, "a trap too close to a right answer")


def check_file(path, operation):
    check(path.exists(), path.name, "no such file")
    if not path.exists():
        return
    text = path.read_text()
    check(len(text) <= LARGEST_FILE, path.name, f"{len(text)} bytes")
    file = json.loads(text)
    if not keeps_schema(file, path.name):
        return
    name = operation["name"]
    for key, value in (("op", name), ("formula", operation["equation"]), ("tolerance_ulp", operation["tolerance_ulp"])):
        check(file[key] == value, path.name, key, "not as in operations.json")
    shapes = {argument["name"]: argument["shape"] for argument in operation["arguments"]}
    ids, arguments = set(), set()
    flags, traps = set(), set()
    for test in file["tests"]:
        place, format = (path.name, test["id"]), test["format"]
        check(test["id"] not in ids, *place, "an id twice")
        ids.add(test["id"])
        key = format + json.dumps(test["args"], sort_keys=True)
        check(key not in arguments, *place, "the arguments of another test")
        arguments.add(key)
        check(test["id"].split("/")[1:] == [format, named_by(test)], *place, "its id is not that of its format and arguments")
        check(list(test["args"]) == list(shapes), *place, "arguments are not those of the operation")
        for argument, value in test["args"].items():
            found = shape_of(value)
            check(found == shapes.get(argument) or value == [] and shapes.get(argument) == "rows", *place, argument, f"is a {found}")
            for item in floats(value):
                check_float(item, format, *place, argument)
        for want in [test["want"], *test.get("also", [])]:
            check_want(want, operation["result"], file["tolerance_ulp"], format, *place)
        check("also" not in test or "Boundary" in test["flags"], *place, "other answers without the flag Boundary")
        check_traps(test, *place)
        flags.update(test["flags"])
        traps.update(test.get("traps", {}))
    for kind, used in (("flags", flags), ("traps", traps)):
        notes = set(file[kind])
        check(used == notes, path.name, kind, f"without note or unused: {sorted(used ^ notes)}")
    formats = {test["format"] for test in file["tests"]}
    check(formats == set(FORMATS), path.name, "a format is missing")


def keeps_schema(file, name):
    try:
        import jsonschema
    except ImportError:
        return True
    found = list(jsonschema.Draft202012Validator(json.loads((VECTORS / "schema.json").read_text())).iter_errors(file))
    for error in found[:5]:
        check(False, name, "/".join(map(str, error.absolute_path)), error.message[:200])
    return not found


def sums():
    """As sha256sum writes them."""
    files = sorted(path for path in FOLDER.iterdir() if path.suffix == ".json")
    return "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in files)


def main():
    operations = json.loads((FOLDER / "operations.json").read_text())
    for operation in operations:
        check_file(FOLDER / f"{operation['name']}.json", operation)
    names = {f"{operation['name']}.json" for operation in operations} | {"operations.json", SUMS.name}
    for path in sorted(FOLDER.iterdir()):
        check(path.name in names, path.name, "belongs to no operation")
    size = sum(path.stat().st_size for path in FOLDER.iterdir())
    check(size <= LARGEST_FOLDER, f"{size} bytes in all")
    if "--write" in sys.argv:
        SUMS.write_text(sums())
    check(SUMS.exists() and SUMS.read_text() == sums(), SUMS.name, "is not up to date")
    for problem in problems[:40]:
        print(problem)
    print(f"{len(operations)} operations, {size} bytes, {len(problems)} problems")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
