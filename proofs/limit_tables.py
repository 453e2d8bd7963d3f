#!/usr/bin/env python3
"""Makes src/limit/closed_form/tables.rs: the polynomials of the closed form.

    proofs/limit_tables.py > src/limit/closed_form/tables.rs

A panel's polynomial interpolates the limit at the Chebyshev nodes of the panel, with as few terms as keep it within
2^-68, and its coefficients are rounded to integers. How good the result is, proofs/limit_certify.py proves. Needs
python-flint.
"""

import math

from flint import arb

from limit_exact import at, beyond, taylor

LOWEST, HIGHEST, PANELS = -24, 3, 8
VALUE, SLOPE = 120, 67
TAYLOR = 60
TARGET = arb(2) ** -68
WEIGHTS = ("RADIAL", "AREA")


def panels():
    """Of each panel, in the order of the table: where it begins, its width, and whether its variable is 1/alpha."""
    yield arb(0), arb(2) ** LOWEST, False
    for octave in range(LOWEST, HIGHEST + 1):
        width = arb(2) ** octave / PANELS
        for i in range(PANELS):
            yield (PANELS + i) * width, width, False
    width = arb(2) ** -(HIGHEST + 1) / PANELS
    for i in range(PANELS):
        yield i * width, width, True


def polynomial(coefficients, y):
    """Horner's rule."""
    total = arb(0)
    for c in reversed(coefficients):
        total = total * y + c
    return total


def functions(start, width, far):
    """Both limits as functions of y, from -1/2 to 1/2 across the panel, good to far more than 2^-120."""
    if start == 0 and not far:
        return [lambda y, w=w: at(width * (y + arb(1) / 2))[w] for w in range(2)]
    middle = start + width / 2
    if far:
        return [lambda y, w=w: beyond(middle + width * y)[w] for w in range(2)]
    series = taylor(middle, TAYLOR)
    coefficients = [[c * width**k for k, c in enumerate(s.coeffs())] for s in series]
    return [lambda y, c=c: polynomial(c, y) for c in coefficients]


def nodes(n):
    """The zeros of the Chebyshev polynomial of degree n on [-1/2, 1/2]."""
    return [(arb(2 * i + 1) / (2 * n)).cos_pi() / 2 for i in range(n)]


def interpolant(f, n):
    """The coefficients of the polynomial with n terms through f at the Chebyshev nodes, by Newton's differences."""
    x = nodes(n)
    d = [f(t) for t in x]
    for j in range(1, n):
        for i in range(n - 1, j - 1, -1):
            d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - j])
    coefficients = [d[-1]]
    for i in range(n - 2, -1, -1):
        shifted = [arb(0), *coefficients]
        for k, c in enumerate(coefficients):
            shifted[k] -= x[i] * c
        shifted[0] += d[i]
        coefficients = shifted
    return coefficients


def integer(x, scale):
    """The integer nearest to x 2^scale."""
    whole = (x * arb(2) ** scale + arb(1) / 2).floor().unique_fmpz()
    assert whole is not None, x
    return int(whole)


def fit(f):
    """The shortest interpolant within TARGET of f at the points between its nodes, as integers."""
    for n in range(2, 24):
        coefficients = interpolant(f, n)
        between = [arb(1) / 2, arb(-1) / 2] + [(arb(i) / n).cos_pi() / 2 for i in range(1, n)]
        if all(abs(polynomial(coefficients, y) - f(y)) < TARGET for y in between):
            value, *slopes = coefficients
            return integer(value, VALUE), [integer(c, SLOPE) for c in slopes]
    raise AssertionError("too narrow a target")


def panel(value, slopes):
    """A tuple, in lines of at most 118 columns."""
    lines = [f"    ({value}, &["]
    for slope in slopes:
        text = f"{slope}, "
        if len(lines[-1]) + len(text) > 116:
            lines.append("        ")
        lines[-1] += text
    return "\n".join(line.rstrip() for line in lines).rstrip(",") + "]),"


def main():
    tables = list(zip(*([fit(f) for f in functions(*place)] for place in panels())))
    print("//! The polynomials of the closed form. Written by `proofs/limit_tables.py`; do not edit.\n")
    print(
        "/// The polynomial of a limit on one panel: its constant, scale 120, and the coefficients of `y`, `y^2`, ..., "
        "scale 67."
    )
    print("pub(super) type Polynomial = (u128, &'static [i64]);")
    for name, rows in zip(WEIGHTS, tables):
        print(f"\n/// The panels of the limit with weight {name.lower()}, in the order of `locate`.")
        print(f"pub(super) static {name}: [Polynomial; {len(rows)}] = [")
        for row in rows:
            print(panel(*row))
        print("];")


if __name__ == "__main__":
    main()
