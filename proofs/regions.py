#!/usr/bin/env python3
"""Runs the Gappa scripts of the vector kernels, once for each value and binade of distances.

    proofs/regions.py SCRIPT...

`proofs/lanes.sollya` certifies the ranges of a region, which take the place of REGION in a script; VALUE is the name of
the value, near, entropy or information. The kernel without entropies has no complements: there the goals that speak of
them are left out. Prints the first region that fails, and ends with status 1 then. REGIONS may be a file of what
lanes.sollya writes.
"""

import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
GAPPA = ["gappa", "-Eprecision=150", "-Eno-auto-dichotomy"]
REGIONS = 124


def regions():
    """The regions as (format, value, ranges)."""
    command = ["cat", os.environ["REGIONS"]] if "REGIONS" in os.environ else ["sollya", HERE / "lanes.sollya"]
    output = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300).stdout
    lines = [line.split(" ", 2) for line in output.splitlines()]
    if len(lines) != REGIONS or any(line[0] not in ("f32", "f64") for line in lines):
        sys.exit(f"proofs/regions.py: lanes.sollya fails:\n{output[-2000:]}")
    return lines


def instance(script, value, ranges):
    """The script for a region."""
    if value == "information":
        script = re.sub(r" /\\\n    complement \+ (?:lower|upper)[^/\n]*[^/\n ]", "", script)
    return script.replace("REGION", ranges).replace("VALUE", value)


def failure(script, value, ranges):
    """What Gappa says of a region, nothing if all is well."""
    text = instance(script, value, ranges)
    result = subprocess.run(GAPPA, input=text, capture_output=True, text=True, timeout=120)
    said = [line for line in (result.stdout + result.stderr).splitlines() if not line.startswith("Warning: re")]
    return "\n".join([value, ranges, *said]) if result.returncode or said else None


def main():
    status = 0
    ranges = regions()
    for path in map(Path, sys.argv[1:]):
        script = path.read_text()
        chosen = [region for region in ranges if region[0] in path.stem]
        with ThreadPoolExecutor(2) as pool:
            results = pool.map(lambda region: failure(script, *region[1:]), chosen)
            first = next((said for said in results if said), None)
            pool.shutdown(cancel_futures=True)
        if first or not chosen:
            status = 1
            print(f"{path.name}: {first}")
    sys.exit(status)


if __name__ == "__main__":
    main()
