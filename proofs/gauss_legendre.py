"""Makes src/quadrature/rigorous/nodes.rs: the nodes and weights of Gauss-Legendre rules, by Arb's balls.

    python3 proofs/gauss_legendre.py > src/quadrature/rigorous/nodes.rs

Each number is the floor of its value times 2^127: the script stops if a ball does not decide it. Needs python-flint.
`cargo test` checks the file again, without Arb, in exact rational arithmetic.
"""

from flint import arb, ctx

ctx.prec = 400
ORDERS = [4, 6, 8, 10, 12, 14, 16, 18, 20, 24, 28, 32]


def floor(x):
    value = (x * arb(2) ** 127).floor().unique_fmpz()
    assert value is not None, "more precision is needed"
    return int(value)


print("//! Gauss-Legendre rules. Written by `proofs/gauss_legendre.py`; do not edit.")
print()
print("/// The positive nodes of each rule and their weights, scale 127, floored: what is dropped is below a unit.")
print(f"pub(super) const RULES: [&[(u128, u128)]; {len(ORDERS)}] = [")
for n in ORDERS:
    print("    &[")
    for k in reversed(range(n // 2)):
        node, weight = arb.legendre_p_root(n, k, weight=True)
        assert 0 < node < 1
        print(f"        ({floor(node)}, {floor(weight)}),")
    print("    ],")
print("];")
