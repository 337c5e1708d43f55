"""Write the licences of the crates that are linked into the library of the Python package, with their texts.

    python3 python/licences.py > THIRD-PARTY-LICENCES.txt

Needs cargo, which knows the crates and has their sources.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent

# The crate whose library is in the wheel.
OWN = "unripple-python"

# Names under which crates keep the texts of their licences.
TEXTS = re.compile(r"(licen[cs]e|copying|copyright|notice|unlicense)", re.IGNORECASE)

HEAD = """\
Licences of what is linked into the library of the Python package `unripple`, besides its own (MIT OR Apache-2.0).

Each crate is named with its version and the licence that it is under, as an SPDX expression; the texts that crates carry
follow, each once. Rust's standard library is linked in, too: MIT OR Apache-2.0.
"""


def metadata() -> dict[str, Any]:
    """Ask cargo for all packages and what depends on what, on this platform."""
    version = subprocess.run(["rustc", "-vV"], capture_output=True, text=True, check=True).stdout
    host = next(line.split()[1] for line in version.splitlines() if line.startswith("host:"))
    command = ["cargo", "metadata", "--locked", "--format-version", "1", "--filter-platform", host]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if said.returncode:
        sys.exit(f"licences: {said.stderr.strip()}")
    found: dict[str, Any] = json.loads(said.stdout)
    return found


def linked(found: dict[str, Any]) -> list[dict[str, Any]]:
    """Packages from elsewhere that the library is linked with, by name: build scripts and tests left out."""
    packages = {package["id"]: package for package in found["packages"]}
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    todo = [key for key, package in packages.items() if package["name"] == OWN]
    seen: set[str] = set()
    while todo:
        key = todo.pop()
        if key in seen:
            continue
        seen.add(key)
        for dependency in nodes[key]["deps"]:
            if any(kind["kind"] is None for kind in dependency["dep_kinds"]):
                todo.append(dependency["pkg"])
    # Packages of the workspace come from nowhere.
    others = [packages[key] for key in seen if packages[key]["source"]]
    return sorted(others, key=lambda package: (package["name"], package["version"]))


def texts(package: dict[str, Any]) -> list[str]:
    """Texts of a package's licences, without spaces at the ends of lines."""
    folder = Path(package["manifest_path"]).parent
    files = sorted(path for path in folder.iterdir() if TEXTS.match(path.name))
    inner = [path for entry in files if entry.is_dir() for path in sorted(entry.iterdir())]
    named = [path for path in [*files, *inner] if path.is_file() and path.suffix != ".rs"]
    read = (path.read_text(encoding="utf-8", errors="replace") for path in named)
    return ["\n".join(line.rstrip() for line in text.strip().splitlines()) for text in read]


def main() -> None:
    """Print the list of crates, then each text with the crates that carry it."""
    carried: dict[str, list[str]] = defaultdict(list)
    lines = [HEAD]
    for package in linked(metadata()):
        name = f"{package['name']} {package['version']}"
        found = texts(package)
        where = "" if found else f"; it carries no text, see {package['repository'] or 'its package'}"
        lines.append(f"{name}: {package['license'] or 'licence in its text'}{where}")
        for text in found:
            carried[text].append(name)
    for text, names in carried.items():
        lines += ["", "=" * 100, ", ".join(names), "", text]
    print("\n".join(lines))


if __name__ == "__main__":
    main()
