"""Checks the licences of all that is compiled in: `python3 .ci/licences.py [MANIFEST]`, needs cargo and its packages.

Each dependency's licence, an expression with AND and OR, must be met by those that `deny.toml` allows. Prints how many
packages have which; the status is 1 if one has another. What travels, `travelling.py` says.
"""

import re
import sys
from collections import Counter
from pathlib import Path

from travelling import travelling

ROOT = Path(__file__).resolve().parent.parent


def allowed() -> set[str]:
    """Reads the licences of `deny.toml`, whose list is on one line."""
    (line,) = re.findall(r"^allow = \[(.*)\]$", (ROOT / "deny.toml").read_text(), re.MULTILINE)
    return set(re.findall(r'"([^"]+)"', line))


def is_met(expression: str, by: set[str]) -> bool:
    """Tells whether an expression holds if these licences do; `/` is an old OR, exceptions only add rights."""
    expression = re.sub(r"\s+WITH\s+\S+", "", expression).replace("/", " OR ")
    words = re.findall(r"[()]|[^\s()]+", expression)
    python = [word.lower() if word in ("AND", "OR") else word if word in "()" else str(word in by) for word in words]
    return bool(python) and eval(" ".join(python))  # noqa: S307: True, False, and, or, parentheses


def main() -> int:
    """Prints the licences, and those that are not allowed."""
    packages = travelling(sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "Cargo.toml"), "--all-features").values()
    licences = {f"{package['name']} {package['version']}": package["license"] or "" for package in packages}
    for licence, count in sorted(Counter(licences.values()).items()):
        print(f"{count:4} {licence}")
    by = allowed()
    others = sorted(f"{package}: {licence or 'no licence'}" for package, licence in licences.items() if not is_met(licence, by))
    for line in others:
        print(f"not allowed by deny.toml: {line}")
    print(f"{len(licences)} packages, {len(others)} not allowed")
    return 1 if others else 0


if __name__ == "__main__":
    sys.exit(main())
