"""The table of operations, v1/operations.json, and the file of vectors that each has."""

import json

from text import FOLDER, write_file

OPERATIONS = {operation["name"]: operation for operation in json.loads((FOLDER / "operations.json").read_text())}

VERDICTS = {
    0: "The same count.",
    0.5: "The float nearest to the exact value, which lies between lo and hi; a zero is +0. No enclosure holds a midpoint of two "
    "floats, unless lo = hi: that is the exact value, and ties go to even.",
    2: "Within so many ulp, the spacing of the floats at the answer, of some number between lo and hi, or of one of `also`.",
}


def named(notes, used):
    """The notes that the tests use, in the order of the notes."""
    missing = used - notes.keys()
    assert not missing, f"no notes: {missing}"
    return {name: note for name, note in notes.items() if name in used}


def thin(tests, most=40):
    """Of tests beyond so many with one trap in one format, evenly many lose it: a cause shows in 40 tests as in 1000."""
    holders = {}
    for test in tests:
        for name in test.get("traps", {}):
            holders.setdefault((name, test["format"]), []).append(test)
    for (name, _), found in holders.items():
        kept = {k * len(found) // most for k in range(most)}
        for k, test in enumerate(found):
            if len(found) > most and k not in kept:
                del test["traps"][name]
                if not test["traps"]:
                    del test["traps"]


def write(op, source, flags, traps, tests):
    operation = OPERATIONS[op]
    thin(tests)
    ids = {test["id"] for test in tests}
    assert len(ids) == len(tests), f"{op}: an id twice"
    write_file({
        "op": op,
        "version": 1,
        "formula": operation["equation"],
        "tolerance_ulp": operation["tolerance_ulp"],
        "verdict": VERDICTS[operation["tolerance_ulp"]],
        "source": source,
        "flags": named(flags, {flag for test in tests for flag in test["flags"]}),
        "traps": named(traps, {trap for test in tests for trap in test.get("traps", {})}),
    }, tests)
