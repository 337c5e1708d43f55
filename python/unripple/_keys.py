"""Keywords in place of a surface file: which key of the file each one sets, and the text that they make."""

from __future__ import annotations

import difflib
import math
import os
import re
import tomllib
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from unripple._errors import InputError, OptionError
from unripple._values import shown

#: Keys that stand alone among the keywords, by the table of the file that they are of. A key that several tables have is of the first,
#: and is given within the other: `thickness_mm` is the sheet's, that of a disc is in `scatterers=[…]`. `contact_radius_mm` is left out,
#: since a finger and an actuator have one alike: give `finger={…}` or `actuator_defaults={…}`.
TABLES: dict[str, tuple[str, ...]] = {
    "": ("format", "name", "accuracy"),
    "outline": ("rectangle_mm", "circle_mm", "stadium_mm", "polygon_mm", "path_mm", "svg", "edge"),
    "sheet": (
        "material",
        "young_gpa",
        "density_kg_m3",
        "poisson_ratio",
        "strength_mpa",
        "young_across_gpa",
        "shear_gpa",
        "grain_deg",
        "thickness_mm",
        "tension_n_per_m",
        "decay_time_ms",
        "loss_factor",
        "air",
        "thickness_profile",
        "tension_profile",
        "added_mass_kg_m2",
        "layer",
    ),
    "drive": ("band_hz", "sample_rate_hz", "limit", "rms_limit"),
    "finger": ("mass_g", "damping_n_s_per_m", "stiffness_n_per_mm"),
}

#: Tables of the file, given as mappings, and lists of tables, given as lists of mappings.
SECTIONS = ("outline", "sheet", "drive", "finger", "actuator_defaults")
LISTS = ("hole", "scatterer", "lattice", "actuator")

#: Lists by the names that lists have in Python.
PLURALS = {
    "actuators": "actuator",
    "holes": "hole",
    "scatterers": "scatterer",
    "lattices": "lattice",
    "layers": "layer",
}

#: The table of each key that stands alone.
FLAT = {key: table for table, keys in TABLES.items() for key in keys}

#: What a table of the file begins with where it is written from keywords alone.
_FORMAT = 1

#: A key's path as messages write it: `sheet.tension_n_per_m`, `actuator[3].at_mm`.
_STEP = re.compile(r"([A-Za-z0-9_-]+)((?:\[\d+\])*)")


def path_of(key: str) -> str:
    """Return the path in the file of a keyword: of a key that stands alone, or a path that is one already."""
    key = PLURALS.get(key, key)
    if key in FLAT:
        return f"{FLAT[key]}.{key}".removeprefix(".")
    if key in SECTIONS or key in LISTS or "." in key or "[" in key:
        return key
    known = [*FLAT, *SECTIONS, *LISTS, *PLURALS]
    nearest = difflib.get_close_matches(key, known, 1)
    hint = f" (nearest: {nearest[0]})" if nearest else ""
    raise OptionError(f"surface: expected a key of a surface file, found {key}{hint}")


def changes(keys: Mapping[str, object]) -> dict[str, Any]:
    """Return what keywords set, by paths in the file, in their order; None removes a key."""
    found: dict[str, Any] = {}

    def add(path: str, value: object) -> None:
        if path in found:
            raise OptionError(f"surface: expected {path} once, found it twice")
        found[path] = _plain(path, value)

    for key, value in keys.items():
        path = path_of(str(key))
        if path in SECTIONS and value is not None:
            if not isinstance(value, Mapping):
                raise OptionError(f"{path}: expected a mapping, found {shown(value)}")
            for inner, of_inner in value.items():
                add(f"{path}.{PLURALS.get(str(inner), inner)}", of_inner)
        else:
            add(path, value)
    return found


def document_of(keys: Mapping[str, object]) -> dict[str, Any]:
    """Return the surface file that keywords describe."""
    document: dict[str, Any] = {"format": _FORMAT}
    for path, value in changes(keys).items():
        _set(document, path, value)
    return document


def with_whole_paths(document: dict[str, Any]) -> bool:
    """Make the paths of drawings whole, since they are relative to a file, and tell whether there are any."""
    holes = document.get("hole")
    drawn = [document.get("outline"), *(holes if isinstance(holes, list) else [])]
    found = [table for table in drawn if isinstance(table, dict) and isinstance(table.get("svg"), str)]
    for table in found:
        table["svg"] = os.path.abspath(table["svg"])
    return bool(found)


def changed(text: str, keys: Mapping[str, object]) -> str:
    """Return the text of a surface file with keys set to other values; None removes a key. What is no TOML stays as it is."""
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return text
    for path, value in changes(keys).items():
        _set(document, path, value)
    return write(document)


def settings(keys: Mapping[str, object]) -> dict[str, str]:
    """Return what keywords set as an ask has it: values as TOML, by paths in the file; an empty text removes a key."""
    return {path: "" if value is None else _value(value) for path, value in changes(keys).items()}


def typed(given: object) -> dict[str, str]:
    """Return what the option `set` sets as `--set` has it: texts without need of quotes, by paths in the file."""
    if isinstance(given, Mapping):
        found = {}
        for path, value in changes(given).items():
            found[path] = value if isinstance(value, str) else "" if value is None else _value(value)
        return found
    found = {}
    for text in [given] if isinstance(given, str) else list_of(given):
        key, equals, value = str(text).partition("=")
        if not equals or not key.strip():
            raise OptionError(
                f"set: expected KEY=VALUE, as in sheet.tension_n_per_m=220, found {shown(text)}"
            )
        if found.setdefault(path_of(key.strip()), value.strip()) != value.strip():
            raise OptionError(f"set: expected each key once, found {key.strip()} twice")
    return found


def list_of(given: object) -> list[object]:
    """Return the items of a list that an option was given."""
    if isinstance(given, Mapping) or not isinstance(given, Iterable):
        raise OptionError(f"set: expected a list, found {shown(given)}")
    return list(given)


def read_all(given: object) -> dict[str, Any]:
    """Return the values that the option `set` sets, by paths in the file; None removes a key."""
    return {path: _read(text) for path, text in typed(given).items()}


def _read(text: str) -> Any:
    """Return the value that a text stands for where its quotes may be left out; None of an empty text."""
    if not text:
        return None
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def write(document: Mapping[str, Any]) -> str:
    """Return a surface file as TOML."""
    lines = [f"{key} = {_value(value)}" for key, value in document.items() if not _is_headed(value)]
    for key, value in document.items():
        if isinstance(value, Mapping):
            lines += _headed(f"[{key}]", value)
        elif _is_headed(value):
            for item in value:
                lines += _headed(f"[[{key}]]", item)
    return "\n".join(lines) + "\n"


def _is_headed(value: Any) -> bool:
    """Tell whether a value is written below a heading: a table, or a list of tables."""
    if isinstance(value, Mapping):
        return True
    return isinstance(value, list) and bool(value) and all(isinstance(item, Mapping) for item in value)


def _headed(heading: str, table: Mapping[str, Any]) -> list[str]:
    return ["", heading, *(f"{_key(key)} = {_value(value)}" for key, value in table.items())]


def _key(key: str) -> str:
    return key if _STEP.fullmatch(key) else _quoted(key)


def _value(value: Any) -> str:
    """Return a value as TOML, on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        # As long as it has to be for the same number to be read: all its digits.
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return _quoted(str(value))


def _quoted(text: str) -> str:
    escaped = "".join(_escape(character) for character in text)
    return f'"{escaped}"'


def _escape(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    # What TOML refuses to have as it is between quotes.
    return f"\\u{ord(character):04x}" if ord(character) < 0x20 or ord(character) == 0x7F else character


def _plain(path: str, value: object) -> Any:
    """Return a value as TOML knows it: texts, numbers, lists and tables."""
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(path, value.tolist())
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        given = {str(key): item for key, item in value.items() if item is not None}
        return {key: _plain(f"{path}.{key}", item) for key, item in given.items()}
    if isinstance(value, Iterable):
        items = [_plain(f"{path}[{index}]", item) for index, item in enumerate(value)]
        if None in items:
            raise OptionError(f"{path}: expected a value in each place, found None")
        return [_placed(item) for item in items] if path == "actuator" else items
    raise OptionError(f"{path}: expected a text, a number, a list or a mapping, found {shown(value)}")


def _placed(item: Any) -> Any:
    """Return an actuator as a table; a place alone stands for a force there."""
    return {"at_mm": item} if isinstance(item, list) else item


def _steps(path: str) -> list[str | int]:
    """Return the steps of a path such as `actuator[3].at_mm`."""
    steps: list[str | int] = []
    for part in path.split("."):
        match = _STEP.fullmatch(part)
        if match is None:
            raise OptionError(f"surface: expected a key of a surface file, found {path}")
        steps.append(match[1])
        steps += [int(index) for index in re.findall(r"\d+", match[2])]
    return steps


def _set(document: dict[str, Any], path: str, value: Any) -> None:
    """Set the value at a path, or remove it; tables on the way are made."""
    *way, last = _steps(path)
    here: Any = document
    for step in way:
        here = _entered(here, step, path)
    if isinstance(last, str) and isinstance(here, dict):
        if value is None:
            here.pop(last, None)
        else:
            here[last] = value
    elif isinstance(last, int) and isinstance(here, list) and last < len(here):
        here[last : last + 1] = [] if value is None else [value]
    else:
        raise InputError(f"surface: expected a place for {path}, found none")


def _entered(here: Any, step: str | int, path: str) -> Any:
    if isinstance(step, str) and isinstance(here, dict):
        return here.setdefault(step, {})
    if isinstance(step, int) and isinstance(here, list) and step < len(here):
        return here[step]
    raise InputError(f"surface: expected a place for {path}, found none")
