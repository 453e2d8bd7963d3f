#!/usr/bin/env python3
"""Judges an implementation by these files, as README.md says; needs Python 3.8 or later and nothing else.

    judge.py [--ops GLOB] CMD...                      a port: a program that speaks the protocol of docs/porting.md
    judge.py --ops OPERATION --call FILE.py:NAME      a function of Python floats, for the f64 tests of one operation

A function gets the arguments in the order of v1/operations.json, lists as lists. Where they are not allowed it raises
ValueError or gives NaN. Prints a line for each operation and format, the first wrong answers of each, and the counts.
Exit status 0: none failed; 1: some did; 2: bad usage, or a port that does not answer.
"""

import argparse
import fnmatch
import json
import operator
import pathlib
import re
import runpy
import subprocess
import sys
from fractions import Fraction

V1 = pathlib.Path(__file__).resolve().parent / "v1"
FORMATS = {"f32": (24, -149), "f64": (53, -1074)}  # digits, exponent of the smallest number
SHOWN = 3


HEXADECIMAL = re.compile(r"([+-]?)0x([0-9a-f]*)(?:\.([0-9a-f]*))?(?:p([+-]?[0-9]+))?", re.IGNORECASE)


def read(text):
    """Whether a hexadecimal float has a minus sign, and its magnitude, exactly; ValueError of anything else."""
    found = HEXADECIMAL.fullmatch(text) if isinstance(text, str) and len(text) < 10_000 else None
    if not found:
        raise ValueError(text)
    sign, whole, fraction, exponent = found[1], found[2], found[3] or "", int(found[4] or 0)
    if not whole + fraction or abs(exponent) > 100_000:
        raise ValueError(text)
    return sign == "-", int(whole + fraction, 16) * Fraction(2) ** (exponent - 4 * len(fraction))


def parts(x, precision, least):
    """x = m 2^e of x >= 0, m below 2^precision and e as small as can be: 2^e is the ulp. ValueError if m is no integer,
    or e too large: then x is no float of the format."""
    e = least
    if x:
        # The bit length of the quotient is off by one at most.
        e = max(x.numerator.bit_length() - x.denominator.bit_length() - precision, least)
        e += x >= Fraction(2) ** (e + precision)
    m = x / Fraction(2) ** e
    if m.denominator != 1 or e > 3 - 2 * precision - least:
        raise ValueError(x)
    return int(m), e


def is_near(negative, x, lo, hi, tolerance, precision, least):
    """Whether ±x is the nearest float of all between lo and hi (tolerance 1/2), or within so many ulp of one."""
    m, e = parts(x, precision, least)
    ulp = Fraction(2) ** e
    if tolerance != Fraction(1, 2):
        signed = -x if negative else x
        return signed - tolerance * ulp <= hi and lo <= signed + tolerance * ulp
    if negative:
        if not m:
            return False  # a zero is +0
        lo, hi = -hi, -lo
    below = ulp / 4 if m == 2 ** (precision - 1) and e > least else ulp / 2  # half the spacing below a power of two
    inside = (lambda a, b: a <= b) if m % 2 == 0 else (lambda a, b: a < b)
    return inside(m * ulp - below, lo) and inside(hi, m * ulp + ulp / 2)


def is_right(answer, test, tolerance):
    """Whether an answer, {"result": ...} or {"error": ...}, is right for `want` or for one of `also`."""
    precision, least = FORMATS[test["format"]]
    tolerance = Fraction(str(test.get("tolerance_ulp", tolerance)))
    for want in [test["want"], *test.get("also", [])]:
        if "error" in want or "error" in answer:
            if answer.get("error") == want.get("error"):
                return True
        elif "count" in want:
            if type(answer.get("result")) is int and answer["result"] == want["count"]:
                return True
        else:
            try:
                x = read(answer.get("result"))
                if is_near(*x, Fraction(want["lo"]), Fraction(want["hi"]), tolerance, precision, least):
                    return True
            except ValueError:
                continue  # no number of that format
    return False


def stop(reason):
    print(f"judge.py: {reason}", file=sys.stderr)
    sys.exit(2)


class Port:
    """A program that speaks the protocol: one request and one answer at a time."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.welcome = self.ask({"cmd": "start", "protocol": 1})
        if not all(isinstance(self.welcome.get(name), list) for name in ("ops", "formats")):
            stop(f"no answer to the start with lists of ops and formats: {json.dumps(self.welcome)[:200]}")
        self.seq = 0

    def ask(self, request):
        try:
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
            answer = json.loads(self.process.stdout.readline())
        except (OSError, ValueError) as error:
            stop(f"no answer ({error}) to {json.dumps(request)[:200]}")
        if not isinstance(answer, dict):
            stop(f"no answer, but {json.dumps(answer)[:200]}, to {json.dumps(request)[:200]}")
        return answer

    def declares(self, op, test):
        return op in self.welcome["ops"] and test["format"] in self.welcome["formats"]

    def answer(self, op, test):
        self.seq += 1
        answer = self.ask({"cmd": "run", "seq": self.seq, "op": op, "format": test["format"], "args": test["args"]})
        return answer if answer.get("seq") == self.seq else {"error": f"answers {answer.get('seq')}, not {self.seq}"}


class Function:
    """A function of Python floats, in the place of a port."""

    def __init__(self, place, operations):
        file, _, name = place.rpartition(":")
        self.call, self.operations = runpy.run_path(file)[name], operations

    def declares(self, _op, test):
        return test["format"] == "f64"

    def answer(self, op, test):
        floats = lambda x: [floats(y) for y in x] if isinstance(x, list) else float.fromhex(x)
        try:
            result = self.call(*(floats(test["args"][a["name"]]) for a in self.operations[op]["arguments"]))
        except ValueError:
            return {"error": "domain"}
        except ArithmeticError as error:
            return {"error": repr(error)}
        # The operation says of which kind the result is: an integer may stand for a float, and a count be NumPy's.
        is_count = self.operations[op]["result"] == "count"
        try:
            if result != result:
                return {"error": "domain"}
            return {"result": int(operator.index(result)) if is_count else float(result).hex()}
        except (TypeError, ValueError, OverflowError):
            stop(f"{test['id']}: no {'count' if is_count else 'number'}, but {str(result)[:90]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ops", default="*", metavar="GLOB")
    parser.add_argument("--call", metavar="FILE.py:NAME")
    parser.add_argument("command", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    command = options.command[1:] if options.command[:1] == ["--"] else options.command
    operations = {operation["name"]: operation for operation in json.loads((V1 / "operations.json").read_text())}
    chosen = fnmatch.filter(operations, options.ops)
    if bool(options.call) == bool(command) or not chosen or options.call and len(chosen) > 1:
        parser.error("a command, or --call and one operation" if chosen else f"--ops {options.ops}: no operation")
    judged = Function(options.call, operations) if options.call else Port(command)
    total = [0, 0, 0]
    for op in chosen:
        file = json.loads((V1 / f"{op}.json").read_text())
        for form in FORMATS:
            counts, wrong = [0, 0, 0], []
            for test in (test for test in file["tests"] if test["format"] == form):
                answer = judged.answer(op, test) if judged.declares(op, test) else {"skipped": "not declared"}
                verdict = 2 if "skipped" in answer else 0 if is_right(answer, test, file["tolerance_ulp"]) else 1
                counts[verdict] += 1
                if verdict == 1 and len(wrong) < SHOWN:
                    wrong.append(f"    {test['id']}: {str(answer)[:90]}, wanted {str(test['want'])[:160]}")
            print(f"{op} {form}: {counts[0]} passed, {counts[1]} failed, {counts[2]} skipped", *wrong, sep="\n")
            total = [a + b for a, b in zip(total, counts)]
    print(f"{total[0]} passed, {total[1]} failed, {total[2]} skipped")
    sys.exit(1 if total[1] else 0)


if __name__ == "__main__":
    main()
