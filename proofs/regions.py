#!/usr/bin/env python3
"""Runs the Gappa scripts of the vector kernels, once for each value and binade of distances or interval of log-odds.

    proofs/regions.py [--every=N] SCRIPT...

`proofs/lanes.sollya` and `proofs/log_odds_regions.sollya` certify the ranges of a region, which take the place of REGION in a
script; VALUE is the name of the value. The kernel of occupancies without entropies has no complements: there the goals that
speak of them are left out, and so is a goal that ends with `# of` other values. Prints the first region that fails, and ends
with status 1 then. With `--every` only each N-th region runs, the first and the last among them, of a script that has 32 or more;
an odd N, as lower and upper halves alternate. REGIONS may be a file of what both write.
"""

import argparse
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
GAPPA = ["gappa", "-Eprecision=150", "-Eno-auto-dichotomy", "-Wno-null-denominator"]
CERTIFICATES = {"lanes.sollya": 314, "log_odds_regions.sollya": 249}
VALUES = {"near", "entropy", "information", "occupancy"}
KERNELS = {"lanes_f32", "lanes_f64", "log_odds_f32", "log_odds_f64"}


def regions():
    """The regions as (kernel, value, ranges)."""
    if "REGIONS" in os.environ:
        lines = Path(os.environ["REGIONS"]).read_text().splitlines()
    else:
        commands = [["sollya", HERE / name] for name in CERTIFICATES]
        outputs = [subprocess.run(c, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600) for c in commands]
        lines = [line for output in outputs for line in output.stdout.splitlines()]
    split = [line.split(" ", 2) for line in lines]
    if len(split) != sum(CERTIFICATES.values()) or any(line[0] not in KERNELS for line in split):
        sys.exit("\n".join(["proofs/regions.py: a certificate fails:", *lines[-20:]]))
    return split


def is_wanted(line, value):
    """Whether a line is of this value: of all, or of those that it names."""
    named = line.split(" # of ")[1].split(", ") if "/\\ # of " in line else [value]
    if not set(named) <= VALUES:
        sys.exit(f"proofs/regions.py: no such value: {line}")
    return value in named


def instance(script, kernel, value, ranges):
    """The script for a region."""
    script = "\n".join(line for line in script.split("\n") if is_wanted(line, value))
    if value == "information" and kernel.startswith("lanes"):
        script = re.sub(r" /\\\n    complement \+ (?:lower|upper)[^/\n]*[^/\n ]", "", script)
    return script.replace("REGION", ranges).replace("VALUE", value)


def failure(script, kernel, value, ranges):
    """What Gappa says of a region, nothing if all is well."""
    text = instance(script, kernel, value, ranges)
    result = subprocess.run(GAPPA, input=text, capture_output=True, text=True, timeout=600)
    said = [line for line in (result.stdout + result.stderr).splitlines() if not line.startswith("Warning: re")]
    return "\n".join([value, ranges, *said]) if result.returncode or said else None


def main():
    status = 0
    parser = argparse.ArgumentParser()
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("scripts", type=Path, nargs="+")
    arguments = parser.parse_args()
    ranges = regions()
    for path in arguments.scripts:
        script = path.read_text()
        all_of_it = [region for region in ranges if path.stem.startswith(region[0])]
        every = arguments.every if len(all_of_it) >= 32 else 1
        last = len(all_of_it) - 1
        chosen = [region for k, region in enumerate(all_of_it) if k % every == 0 or k == last]
        with ThreadPoolExecutor(2) as pool:
            results = pool.map(lambda region: failure(script, *region), chosen)
            first = next((said for said in results if said), None)
            pool.shutdown(cancel_futures=True)
        if first or not chosen:
            status = 1
            print(f"{path.name}: {first}")
    sys.exit(status)


if __name__ == "__main__":
    main()
