"""How the vectors are written: hexadecimal floats, outward decimals, one test a line."""

import hashlib
import json
import math
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np

FOLDER = Path(__file__).parent.parent / "v1"
DIGITS = 40
# The floats of a format, in NumPy.
KINDS = {"f64": np.float64, "f32": np.float32}


def hex_float(x):
    """C99, without trailing zeros: the id of an argument must not depend on a printer's taste."""
    if not math.isfinite(x):
        return str(x)
    mantissa, exponent = x.hex().split("p")
    return f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}p{int(exponent):+d}"


def decimal(value, digits, up):
    """A fraction, not negative, to so many significant digits, rounded down or up."""
    if value == 0:
        return "0"
    exponent = math.floor(mpmath.log10(mpmath.mpf(value.numerator) / value.denominator))
    exponent -= value < Fraction(10) ** exponent  # the logarithm was rounded
    scaled = value / Fraction(10) ** (exponent - digits + 1)
    whole = -(-scaled.numerator // scaled.denominator) if up else scaled.numerator // scaled.denominator
    if whole == 10**digits:
        whole, exponent = whole // 10, exponent + 1
    assert len(str(whole)) == digits
    text = str(whole).rstrip("0")
    return f"{text[0]}.{text[1:] or '0'}e{exponent:+d}"


def neighbours(x, format, n=1):
    """x and the n floats on either side."""
    kind = KINDS[format]
    x = kind(x)
    found = [x]
    for direction in (-np.inf, np.inf):
        y = x
        for _ in range(n):
            y = np.nextafter(y, kind(direction))
            found.append(y)
    return [float(y) for y in found]


def label(op, format, kind, args):
    """The id of a test with lists in its arguments: it ends with a hash of them, so that it can only ever mean one thing."""
    digest = hashlib.sha256(json.dumps(args).encode()).hexdigest()[:12]
    return f"{op}/{format}/{kind}-{digest}"


def write_file(header, tests):
    """The file of one function: v1/OP.json."""
    FOLDER.mkdir(exist_ok=True)
    lines = ",\n".join("    " + json.dumps(test) for test in tests)
    body = json.dumps(header, indent=2).removesuffix("\n}")
    (FOLDER / f"{header['op']}.json").write_text(f'{body},\n  "tests": [\n{lines}\n  ]\n}}\n')
    print(f"{header['op']}: {len(tests)} tests")
