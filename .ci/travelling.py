"""Lists the packages that are compiled into what is handed out, as cargo tells of them."""

import json
import subprocess


def travelling(manifest: str, *options: str) -> dict[str, dict]:
    """Return the packages by their names for cargo, those of the repository itself among them.

    What is only for tests, what is built to build, and macros, which run in the compiler, do not travel. `options` are those
    of `cargo metadata`: features, platforms.
    """
    command = ["cargo", "metadata", "--format-version=1", f"--manifest-path={manifest}", *options]
    metadata = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    needs = {node["id"]: node["deps"] for node in metadata["resolve"]["nodes"]}
    packages = {package["id"]: package for package in metadata["packages"]}
    members = metadata["workspace_members"]
    # A binding is not published on crates.io, and travels all the same.
    left = [name for name in members if packages[name]["publish"] != []] or list(members)
    found = {}
    while left:
        name = left.pop()
        package = packages[name]
        if name in found or any("proc-macro" in target["kind"] for target in package["targets"]):
            continue
        found[name] = package
        left += [need["pkg"] for need in needs[name] if any(kind["kind"] is None for kind in need["dep_kinds"])]
    return found
