"""Check that docs/troubleshooting.md has a row for every error, warning and note of the sources, and no row of one that is gone.

What a program puts into a text stands as … there: `no surface `…`: expected a file, or one of ……`.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/troubleshooting.md"

#: A text of Rust, with its escapes.
TEXT = r'"((?:[^"\\]|\\.)*)"'
ERROR = re.compile(r"#\[error\(\s*" + TEXT, re.DOTALL)
WARNING = re.compile(r'"(warning: (?:[^"\\]|\\.)*)"', re.DOTALL)
TOPIC = re.compile(r'\btopic: (?:"([^"]+)"|([A-Z_]+)\b)')
ADDED = re.compile(r'\badd\(\s*"([^"]+)"')

#: Crates whose notes go with results; in others the word `topic` means something else.
NOTING = ("unripple/", "unripple-tasks/", "unripple-physics/", "unripple-python/")


def sources() -> Iterator[tuple[str, str]]:
    """Return the path within crates/ and the text of each source file, tests left out."""
    for path in sorted(ROOT.glob("crates/*/src/**/*.rs")):
        name = path.relative_to(ROOT / "crates").as_posix()
        if not name.endswith("/tests.rs") and "/tests/" not in name:
            yield name, path.read_text(encoding="utf-8").partition("#[cfg(test)]")[0]


def plain(text: str) -> str:
    """Return a text of Rust as it is shown, with … where the program puts something."""
    joined = re.sub(r"\\\n\s*", "", text).replace('\\"', '"')
    return re.sub(r"\{[^{}]*\}", "…", joined).strip()


def topics(text: str) -> Iterator[str]:
    """Return the topics of the notes that a source file makes."""
    for literal, constant in TOPIC.findall(text):
        if literal:
            yield literal
        elif value := re.search(rf'const {constant}: &str = "([^"]+)"', text):
            yield value[1]
    if "let mut add = |topic" in text:
        yield from ADDED.findall(text)


def wanted() -> dict[str, dict[str, str]]:
    """Return what must have a row: by heading of the page, each text with a file that has it."""
    found: dict[str, dict[str, str]] = {"Errors": {}, "Warnings": {}, "Notes": {}}
    for name, text in sources():
        for error in map(plain, ERROR.findall(text)):
            # A text that is all the program's says nothing by itself.
            if error.strip("…"):
                found["Errors"].setdefault(error, name)
        for warning in map(plain, WARNING.findall(text)):
            found["Warnings"].setdefault(warning, name)
        if name.startswith(NOTING):
            for topic in topics(text):
                found["Notes"].setdefault(topic, name)
    return found


def rows() -> dict[str, list[str]]:
    """Return the first cells of the tables below each heading of the second level."""
    found: dict[str, list[str]] = {}
    for part in re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]:
        heading, _, body = part.partition("\n")
        cells = re.findall(r"^\| (`+) ?(.*?) ?\1 \|", body, re.MULTILINE)
        found[heading.strip()] = [text for _, text in cells]
    return found


def faults() -> list[str]:
    """Return what has no row, and what rows have no source."""
    have = rows()
    found = []
    for heading, texts in wanted().items():
        listed = have.get(heading, [])
        missing = [f"no row for `{text}` of crates/{name} under `{heading}`" for text, name in texts.items() if text not in listed]
        gone = [f"a row under `{heading}` for `{text}`, which is in no source" for text in listed if text not in texts]
        found += [f"docs/troubleshooting.md: {fault}" for fault in missing + gone]
    return found


if __name__ == "__main__":
    wrong = faults()
    if wrong:
        sys.exit("\n".join(wrong))
