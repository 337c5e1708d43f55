"""Channels of a device and their scales, as options give them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from unripple import _values
from unripple._errors import AskError
from unripple._values import number, text


def wires(name: str, value: object) -> list[list[str]]:
    """Channels by the names of what is connected to them: a mapping, or texts NAME=CHANNEL."""
    if isinstance(value, Mapping):
        return [[text(name, key), text(name, channel)] for key, channel in value.items()]
    return [list(halves(name, item, "NAME=CHANNEL")) for item in _values.texts(name, value)]


def halves(name: str, item: str, form: str) -> tuple[str, str]:
    """Return what stands before and behind the equals sign of a text."""
    key, equals, value = item.partition("=")
    if not (key and equals and value):
        raise AskError(field=name, expected=form, found=f"`{item}`")
    return key, value


def scales(name: str, value: object) -> dict[str, Any]:
    """Scales of inputs: a number for all, a mapping by their names, or texts [NAME=]SCALE."""
    if isinstance(value, Mapping):
        return {"named": {text(name, key): number(name, scale) for key, scale in value.items()}}
    if not isinstance(value, str) and not hasattr(value, "__iter__"):
        return {"all": number(name, value)}
    found: dict[str, Any] = {"named": {}}
    for item in _values.texts(name, value):
        key, equals, scale = item.rpartition("=")
        read = _values.row(name, scale, "a number, as in probe=0.5", 1, 1)[0]
        if equals:
            found["named"][key] = read
        else:
            found["all"] = read
    return found
