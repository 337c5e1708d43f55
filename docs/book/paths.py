"""Check that every source file and folder that the pages name is there, and that the version to be cited is that of the program.

A path that begins with a crate (`crates/unripple-dsp/src/synth.rs`, or without `crates/`), with `python/` or with `xtask/` is looked for.
"""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: A path in a code span: of a crate, of the Python package, of the tasks of development.
PATH = re.compile(r"`((?:crates/)?unripple(?:-[a-z]+)?/(?:src|tests|schema|builtin|assets|browser)[\w/.-]*|(?:python|xtask)/[\w/.-]+)`")

#: What stands in a path for a name that somebody will choose.
TEMPLATE = re.compile(r"KIND|DEVICE|VERB")


def faults() -> list[str]:
    """Return the paths that pages name and that are not there."""
    found = []
    for page in [*ROOT.glob("*.md"), *sorted(ROOT.glob("docs/**/*.md"))]:
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            for path in PATH.findall(line):
                if not (ROOT / path).exists() and not (ROOT / "crates" / path).exists() and not TEMPLATE.search(path):
                    found.append(f"{page.relative_to(ROOT)}:{number}: no {path}")
    return found + citation()


def citation() -> list[str]:
    """Return what is wrong if CITATION.cff has another version than the program."""
    program = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    cited = re.search(r"^version: (\S+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    return [] if cited and cited[1] == program else [f"CITATION.cff: expected version {program}, found {cited and cited[1]}"]


if __name__ == "__main__":
    missing = faults()
    if missing:
        sys.exit("\n".join(missing))
