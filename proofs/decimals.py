#!/usr/bin/env python3
"""Writes decimals.txt: every constant that a page prints with more digits than a float has, to 45 digits by Arb.

tests/pages/decimals.rs compares the pages with it. Needs python-flint; compare with `proofs/decimals.py | diff -
proofs/decimals.txt`.
"""

import sys

import limit_exact as limits
from flint import arb, ctx, fmpq

ctx.prec = 320
LN2 = arb.const_log2()


def entropy(p):
    p = arb(p)
    return -(p * p.log() + (1 - p) * (1 - p).log()) / LN2


def occupancy(l):
    return 1 / (1 + (-arb(l)).exp())


def single(x):
    """The float of 24 bits."""
    import struct

    return struct.unpack("f", struct.pack("f", x))[0]


def mean(*cells):
    """The mean information of cells."""
    return sum((1 - entropy(p) if 0 < p < 1 else arb(1) for p in cells), arb(0)) / len(cells)


b = limits.edge()
near, lower, kappa, offset = limits.constants()
values = {
    "b": b,
    "A(b)": near,
    "B": lower,
    "kappa": kappa,
    "M(infinity)": offset,
    "radial limit at 0: 1 - A(b)/b": 1 - near / b,
    "area limit at 0: 1 - 2 B/b^2": 1 - 2 * lower / b**2,
    "integral of H(e^(-t^2/2)) from 0 to 10": limits.large(10)[0],
    "ln 21": arb(21).log(),
    "ln 7": arb(7).log(),
    "e^(7/4) - e^(1/4)": arb(fmpq(7, 4)).exp() - arb(fmpq(1, 4)).exp(),
    "integral of ln from 1/4 to 7/4": arb(fmpq(7, 4)) * (arb(fmpq(7, 4)).log() - 1) - arb(fmpq(1, 4)) * (arb(fmpq(1, 4)).log() - 1),
    "integral of sqrt from 1/4 to 7/4": arb(2) / 3 * (arb(fmpq(7, 4)) ** fmpq(3, 2) - arb(fmpq(1, 4)) ** fmpq(3, 2)),
    "arctan 5 + arctan 3": arb(5).atan() + arb(3).atan(),
    "the float 0.1, times sqrt 2": arb(0.1) * arb(2).sqrt(),
    "mean information of the floats 0, 0.02, 0.03, 0.97": mean(0, 0.02, 0.03, 0.97),
    "mean information of 0, 2, 3 and 97 percent": mean(0, fmpq(2, 100), fmpq(3, 100), fmpq(97, 100)),
    "mean information of the floats 0.1, 0.9": mean(0.1, 0.9),
}
for z, sigma in [("2", "0.2"), ("2", "0.1"), ("2", "0.05"), ("5", "0.2"), ("5", "0.05"), ("10", "0.01"), ("0.5", "0.01"), ("1", "0.5")]:
    radial, area = limits.at(arb(z) / arb(sigma))
    values[f"radial limit, z = {z}, sigma = {sigma}"] = radial
    values[f"area limit, z = {z}, sigma = {sigma}"] = area
for p in [0.3, 0.52, 0.001]:
    values[f"entropy of the float {p}"] = entropy(p)
    values[f"information of the float {p}"] = 1 - entropy(p)
values["entropy of the f32 0.3"] = entropy(single(0.3))
for l in [0.1, 0.7, 9.5]:
    values[f"entropy of log-odds, the float {l}"] = entropy(occupancy(l))
values["information of log-odds, the float 0.7"] = 1 - entropy(occupancy(0.7))
values["occupancy of log-odds, the float -0.7"] = occupancy(-0.7)
values["log-odds of the float 0.3, negative"] = -(arb(0.3) / (1 - arb(0.3))).log()
values["exp of the float 0.3"] = arb(0.3).exp()
values["ln of the float 0.3, negative"] = -arb(0.3).log()
values["sqrt of the float 0.3"] = arb(0.3).sqrt()
values["Eq. 5 at the floats 1.9, 2, 0.2"] = (-(((arb(1.9) - 2) / arb(0.2)) ** 2) / 2).exp()
for x in [-0.05, -0.24, -0.26, -0.7, -3.0]:
    values[f"1 - e^x of the float {x}"] = -arb(x).expm1()
    values[f"entropy of e^x of the float {x}"] = entropy(arb(x).exp())
values["e^x - 1 of the float 0.26"] = arb(0.26).expm1()

for name, value in values.items():
    digits = abs(value).str(45, radius=False)
    assert "e" not in digits and value.rel_accuracy_bits() > 160, (name, value)
    print(f"{name} = {digits}")
