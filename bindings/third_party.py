#!/usr/bin/env python3
"""Writes what others wrote that travels in the wheel and in the page, with its licences: `bindings/third_party.py [--check]`.

`python/THIRD_PARTY.txt` and `web/THIRD_PARTY.txt`, from the lock files and the licence files of the packages themselves. With
`--check` nothing is written, and the status is 1 where a file is not what would be. Needs cargo, and the packages, which cargo
fetches.
"""

import difflib
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / ".ci"))
from travelling import travelling  # noqa: E402: it is beside what checks licences

DESKTOPS = ["x86_64-unknown-linux-gnu", "aarch64-apple-darwin", "x86_64-pc-windows-msvc"]
TRAVEL = {"python": ("the wheel", DESKTOPS), "web": ("the page in a browser", ["wasm32-unknown-unknown"])}
CHOICE = ["MIT", "BSD-2-Clause", "BSD-3-Clause", "Zlib", "BSL-1.0", "bzip2-1.0.6", "Unicode-3.0", "Apache-2.0"]
"""Which licence is taken where a package offers several: the first of these. All that `deny.toml` allows are among them."""
FILES = {"BSL-1.0": "BOOST", "BSD-2-Clause": "BSD", "BSD-3-Clause": "BSD", "Apache-2.0": "APACHE"}
"""What a licence is called in the name of its file, where that is not its own name."""
BESIDE = {
    "libsqlite3-sys": "holds SQLite, which its authors put in the public domain: https://www.sqlite.org/copyright.html",
    "noto-sans-mono-bitmap": "holds pictures of the font Noto Sans Mono, under the SIL Open Font License 1.1: https://openfontlicense.org",
}
"""What is within a package and not in its licence file."""
STANDARD = """\
Rust's standard library is compiled in: MIT OR Apache-2.0, of the Rust Project Developers and others, whose notices are in
https://github.com/rust-lang/rust/blob/main/COPYRIGHT and in COPYRIGHT-library.html of each release."""
BODY = re.compile(
    r"(?:Permission is hereby granted|Redistribution and use in source|This software is provided 'as-is'"
    r"|Boost Software License - Version|Apache License\s+Version 2\.0).*",
    re.DOTALL,
)
"""A licence from the words on that stand in all of its copies; before it are the names of those who give it."""


def licence_of(package: dict) -> tuple[str, str]:
    """Return the licence that is taken, and its text."""
    offered = re.split(r" OR |/", package["license"])
    licence = next(one for one in CHOICE if one in offered)
    folder = Path(package["manifest_path"]).parent
    files = {path.name.upper(): path for path in sorted(folder.iterdir()) if re.match("(UN)?LICEN[CS]E|COPYING", path.name.upper())}
    word = FILES.get(licence, licence).upper()
    named = [path for name, path in files.items() if word in name] or [path for name, path in files.items() if "-" not in name]
    text = named[0].read_text()
    notice = folder / "NOTICE"
    return licence, f"{text.rstrip()}\n\n{notice.read_text()}" if notice.exists() else text


def written(folder: str) -> str:
    """Return the text of a binding."""
    what, targets = TRAVEL[folder]
    manifest, found = str(HERE / folder / "Cargo.toml"), {}
    for target in targets:
        found |= travelling(manifest, "--locked", f"--filter-platform={target}")
    # The repository's own have no source.
    others = [package for package in found.values() if package["source"]]
    listed = sorted(others, key=lambda package: (package["name"], package["version"]))
    lines = [f"Packages of others that travel in {what}, and their licences.", "Written by bindings/third_party.py.", "", STANDARD, ""]
    # Licences by their words, whatever their line breaks: the text as the first has it, and who gives it.
    texts: dict[str, tuple[str, list[str]]] = {}
    for package in listed:
        licence, text = licence_of(package)
        name = f"{package['name']} {package['version']}"
        lines.append(f"{name}: {licence}, {package['repository'] or package['homepage']}")
        if package["name"] in BESIDE:
            lines.append(f"  {BESIDE[package['name']]}")
        body = BODY.search(text)
        before = [line.strip(" #*\t") for line in text[: body.start()].splitlines()] if body else []
        givers = [line for line in before if line.lower().startswith(("copyright", "(c)"))]
        is_known = body is not None and len(before) - len(givers) <= 6 and len(body[0]) < 12_000
        shown = body[0] if is_known else text
        key = "".join(re.sub(r"\W", "", shown).split()).lower()
        texts.setdefault(key, (shown, []))[1].append(f"{name}{': ' if givers else ''}{'; '.join(givers)}")
    for shown, names in texts.values():
        lines += ["", "-" * 80, *names, "", *(line.rstrip() for line in shown.strip().splitlines())]
    return "\n".join(lines) + "\n"


def main() -> int:
    """Write the files, or compare them."""
    stale = 0
    for folder in TRAVEL:
        path, text = HERE / folder / "THIRD_PARTY.txt", written(folder)
        if "--check" not in sys.argv[1:]:
            path.write_text(text)
            continue
        old = path.read_text().splitlines() if path.exists() else []
        differences = list(difflib.unified_diff(old, text.splitlines(), str(path), "what it would be", lineterm="", n=0))
        if differences:
            print(*differences[:20], "run bindings/third_party.py", sep="\n")
            stale = 1
    return stale


if __name__ == "__main__":
    sys.exit(main())
