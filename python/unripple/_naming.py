"""Surfaces as asks of tasks name them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from unripple import _keys, _values
from unripple._errors import OptionError
from unripple._surface import UNNAMED, Surface, is_text


def surface_ask(value: object, changed: object = None) -> Any:
    """Return a surface as an ask names it, with keys changed as the option `set` says."""
    if isinstance(value, Surface):
        if changed is None:
            return value.as_ask()
        return value.with_(**_keys.read_all(changed)).as_ask()
    if isinstance(value, Mapping):
        return _values.plain("surface", value)
    if isinstance(value, str) and is_text(value):
        return (
            surface_ask(Surface(value), changed) if changed is not None else {"toml": value, "name": UNNAMED}
        )
    name = _values.path("surface", value)
    return name if changed is None else {"name": name, "set": _keys.typed(changed)}


def surfaces_ask(given: object, changed: object, vary: object) -> tuple[list[Any], list[str]]:
    """Return surfaces as an ask names them, each once for each value of a key that is varied, and what they are called then."""
    if given is None:
        given = "hudin-2012" if changed is not None or vary is not None else []
    surfaces = (
        [given]
        if isinstance(given, (Surface, str, os.PathLike, Mapping))
        else list(_values.many("surface", given))
    )
    if vary is None:
        return [surface_ask(surface, changed) for surface in surfaces], []
    key, values = _varied(vary)
    set_before = {} if changed is None else _keys.typed(changed)
    if key in set_before:
        raise OptionError(f"vary: expected a key that set does not set, found {key}")
    asks, labels = [], []
    for surface in surfaces:
        name = surface.name if isinstance(surface, Surface) else str(surface)
        for value in values:
            asks.append(surface_ask(surface, [f"{k}={v}" for k, v in {**set_before, key: value}.items()]))
            labels.append(f"{key}={value}" if len(surfaces) == 1 else f"{name}, {key}={value}")
    return asks, labels


def _varied(vary: object) -> tuple[str, list[str]]:
    """Return a key and the values that it is to have, as texts."""
    if isinstance(vary, Mapping) and len(vary) == 1:
        [(key, values)] = vary.items()
        path = _keys.path_of(str(key))
        if isinstance(values, str):
            return path, _separated(values)
        if path not in _keys.SECTIONS:
            return path, [_keys.typed({path: value})[path] for value in _values.many("vary", values)]
    if isinstance(vary, str):
        key, equals, values = (part.strip() for part in vary.partition("="))
        if equals and key:
            return _keys.path_of(key), _separated(values)
    raise OptionError(
        f"vary: expected one key and its values, as in sheet.tension_n_per_m=200,300,400, found {_values.shown(vary)}"
    )


def _separated(values: str) -> list[str]:
    """Return values that stand with commas between them; a comma within brackets or quotes is part of a value."""
    parts, depth, quote = [""], 0, ""
    for character in values:
        if quote:
            quote = "" if character == quote else quote
        elif character in "\"'":
            quote = character
        elif character in "[{":
            depth += 1
        elif character in "]}":
            depth -= 1
        if character == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]
