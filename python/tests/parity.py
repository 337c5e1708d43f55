"""Write docs/python-parity.md: what each command, option and key of a report is called in Python.

    python python/tests/parity.py > docs/python-parity.md

Needs the package with its library, as python/run lays them out. A test holds the page to what this writes.
"""

from __future__ import annotations

import json
import keyword
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import unripple
from unripple import _options, _unripple
from unripple._report import Report

ROOT = Path(__file__).resolve().parents[2]

# What is true of every report, for programs.
SCHEMA = ROOT / "crates/unripple-tasks/schema/report-1.json"

# Classes whose methods do commands, by the name that readers know them by.
CLASSES = {"Surface": unripple.Surface, "Responses": unripple.Responses}

# Functions that are not called as their command, whose name is a word of Python.
NAMED = {"import": "import_measurements"}

# Fields that are given in another way than as options.
APART = {
    "surface": ["the object itself, or the first argument", "keys of it by `set`"],
    "others": ["more surfaces in the first argument", "`vary`", "`others`"],
}

HEAD = """\
# Names in Python

What each command of `unripple`, each of its options and each key of its reports is called in Python. `python/tests/parity.py` writes
this page, and a test fails where something has no name. What they mean: `unripple COMMAND --help`, [JSON output](json.md), and
`help(unripple)`.

Options have the names of the command line, with underscores, or those of the fields of the request, which are in SI units. Every command is
there by its name: `unripple.run("focus", surface="hudin-2012", at=[(62, 90)], window_ms=30)`.
"""

ON_REPORTS = """\
## Reports

Every key is an attribute of its name, at any depth, and a key of a mapping: `report.targets[0].contrast`, `report["targets"]`. The keys in
each part of the schema:

| part | keys |
|---|---|
"""


def commands() -> dict[str, list[str]]:
    """The functions and methods that do each command, but for `run`."""
    found = {}
    for command in _unripple.commands():
        function = NAMED.get(command, command)
        own = [f"unripple.{function}"] if callable(getattr(unripple, function, None)) else []
        found[command] = own + [f"{name}.{command}" for name, of in CLASSES.items() if hasattr(of, command)]
    return found


def options(command: str) -> dict[str, list[str]]:
    """The names of the options that set each field of a command's ask; fields of a table by their path."""
    named: dict[str, list[str]] = {}
    for option in _options.OPTIONS.get(command, ()):
        named.setdefault(option.field, []).append(option.name)
    known = _options.names(command)
    found = {}
    for path in sorted(_options.fields(command).values()):
        field = path.rpartition(".")[2]
        own = [field] if field in known else []
        found[path] = APART.get(path) or [f"`{name}`" for name in dict.fromkeys(named.get(path, []) + own)]
    return found


def keys(part: Any) -> Iterator[str]:
    """The keys of reports that a part of the schema describes; those of other parts that it refers to left out."""
    if isinstance(part, dict):
        properties = part.get("properties", {})
        yield from properties
        yield from (key for inner in properties.values() for key in keys(inner))
        yield from (key for name, inner in part.items() if name != "properties" for key in keys(inner))
    elif isinstance(part, list):
        yield from (key for inner in part for key in keys(inner))


def parts() -> dict[str, list[str]]:
    """The keys of reports by the parts of the schema."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    found = {name: sorted(set(keys(part))) for name, part in schema["$defs"].items()}
    return {name: of_part for name, of_part in found.items() if of_part}


def is_attribute(key: str) -> bool:
    """Whether a key of a report can be an attribute of it, too."""
    return key.isidentifier() and not keyword.iskeyword(key) and not hasattr(Report, key)


def page() -> str:
    """The whole page."""
    lines = [HEAD]
    for command, functions in commands().items():
        named = ", ".join(f"`{function}`" for function in functions)
        lines += [f"## {command}", "", f"{named}.", ""]
        rows = [f"| `{path}` | {', '.join(names)} |" for path, names in options(command).items()]
        if rows:
            lines += ["| field of the request | options |", "|---|---|", *rows, ""]
    rows = [f"| {name} | {', '.join(f'`{key}`' for key in of_part)} |" for name, of_part in parts().items()]
    return "\n".join([*lines, ON_REPORTS + "\n".join(rows)]) + "\n"


if __name__ == "__main__":
    print(page(), end="")
