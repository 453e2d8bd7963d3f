#!/usr/bin/env python3
"""Nodes and weights of the Gauss-Kronrod rules: writes src/quadrature/adaptive/tables.rs.

    proofs/gauss_kronrod.py > src/quadrature/adaptive/tables.rs

The n Gauss nodes are the zeros of the Legendre polynomial P_n, the n + 1 that Kronrod adds those of the Stieltjes
polynomial E_{n+1}, orthogonal to 1, x, ..., x^n with the weight P_n on [-1, 1]. Both polynomials are computed in
rational numbers, their zeros and the weights (integrals of the Lagrange polynomials) with 150 digits. Checked before
printing: the rules integrate every power they should to 1e-90.
"""

from fractions import Fraction

from mpmath import mp, mpf

mp.dps = 150
DIGITS = 36  # of which the test of the degree uses all


def legendre(n):
    """The coefficients of P_n, from the constant upwards."""
    previous, current = [Fraction(1)], [Fraction(0), Fraction(1)]
    for k in range(1, n):
        following = [Fraction(0)] + [Fraction(2 * k + 1, k + 1) * c for c in current]
        for i, c in enumerate(previous):
            following[i] -= Fraction(k, k + 1) * c
        previous, current = current, following
    return current


def integral(polynomial):
    return sum(2 * c / (i + 1) for i, c in enumerate(polynomial) if i % 2 == 0)


def stieltjes(n):
    """The coefficients of the monic E_{n+1}, from the linear system of its orthogonality."""
    p = legendre(n)
    unknown = list(range((n + 1) % 2, n + 1, 2))
    rows = []
    for k in range(n + 1):
        row = [integral([Fraction(0)] * (j + k) + p) for j in unknown + [n + 1]]
        if any(row):
            rows.append(row[:-1] + [-row[-1]])
    assert len(rows) == len(unknown)
    for c in range(len(unknown)):
        pivot = next(i for i in range(c, len(rows)) if rows[i][c])
        rows[c], rows[pivot] = rows[pivot], rows[c]
        rows[c] = [x / rows[c][c] for x in rows[c]]
        for i, row in enumerate(rows):
            if i != c and row[c]:
                rows[i] = [x - row[c] * y for x, y in zip(row, rows[c])]
    e = [Fraction(0)] * (n + 1) + [Fraction(1)]
    for j, row in zip(unknown, rows):
        e[j] = row[-1]
    return e


def real(polynomial):
    """From the highest coefficient down, as mpmath takes them."""
    return [mpf(c.numerator) / c.denominator for c in reversed(polynomial)]


def product(a, b):
    result = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


def zeros(polynomial):
    return sorted(mp.re(x) for x in mp.polyroots(real(polynomial), maxsteps=500, extraprec=600))


def weights(polynomial, nodes):
    """The integral of polynomial / (x - node), over the value of that quotient at the node."""
    coefficients = real(polynomial)
    result = []
    for node in nodes:
        quotient = coefficients[:1]
        for c in coefficients[1:-1]:
            quotient.append(c + node * quotient[-1])
        result.append(integral(list(reversed(quotient))) / mp.polyval(quotient, node))
    return result


def check(nodes, weights, degree):
    for k in range(degree + 1):
        exact = mpf(2) / (k + 1) if k % 2 == 0 else mpf(0)
        assert abs(mp.fsum(w * x**k for x, w in zip(nodes, weights)) - exact) < mpf(10) ** -90


def rule(n):
    p, e = legendre(n), stieltjes(n)
    gauss, nodes = zeros(p), sorted(zeros(p) + zeros(e))
    gauss_weights, kronrod_weights = weights(p, gauss), weights(product(p, e), nodes)
    check(gauss, gauss_weights, 2 * n - 1)
    check(nodes, kronrod_weights, 3 * n + 1)
    assert all(g == x for g, x in zip(gauss, nodes[1::2]))
    return nodes, kronrod_weights, gauss_weights


def array(name, what, numbers):
    print(f"/// {what}")
    print(f"pub(super) const {name}: [f64; {len(numbers)}] = [")
    for x in numbers:
        print(f"    {mp.nstr(x, DIGITS, min_fixed=-99, max_fixed=99, strip_zeros=False) if x else '0.0'},")
    print("];")


print("//! Nodes and weights on `[-1, 1]`, to 36 digits: the compiler rounds them once.")
print("//!")
print("//! Written by `proofs/gauss_kronrod.py`.")
print("//!")
print("//! Nodes from the outermost inwards, the last one is 0; every second one from the second on is a Gauss node.")
print()
print("#![allow(clippy::excessive_precision)]")
for n in (7, 10, 15, 20, 25, 30):
    nodes, kronrod, gauss = rule(n)
    size = 2 * n + 1
    print()
    one_side = [abs(x) for x in nodes[: n + 1]]
    array(f"NODES_{size}", f"The nodes of the rule {n}-{size} from the outermost to the middle.", one_side)
    array(f"KRONROD_{size}", f"Kronrod's weights of the rule {n}-{size}.", kronrod[: n + 1])
    array(f"GAUSS_{size}", f"Gauss's weights of the rule {n}-{size}.", gauss[: (n + 1) // 2])
