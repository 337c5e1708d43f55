"""Targets, levels, waveforms and paths: what Python gives, as asks have it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from unripple._errors import AskError, OptionError
from unripple._values import Fields, flag, is_row, many, number, path, place, plain, row, shown

#: What a point may be, for messages.
_POINT = "X,Y[,GAIN[,HZ]] in mm and Hz"

#: What a waveform may be, for messages.
_WAVEFORM = "X,Y and sine:HZ,MS, burst:HZ,CYCLES, click:MS, a WAV file, or samples with their rate"


def point(name: str, value: object) -> dict[str, Any]:
    """Return a point to be in focus: `(x, y[, gain[, hz]])` in mm and Hz, such numbers as a text, or a mapping."""
    if isinstance(value, Mapping):
        return _point_of(name, value)
    x, y, *more = row(name, value, _POINT, 2, 4)
    found: dict[str, Any] = {"at_m": [x / 1e3, y / 1e3]}
    if more:
        found["gain"] = more[0]
    if len(more) > 1:
        found["rate_hz"] = more[1]
    return found


def _point_of(name: str, value: Mapping[str, object]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, item in value.items():
        if key == "at_mm":
            found["at_m"] = place(name, item)
        else:
            found[str(key)] = plain(name, item)
    return found


def points(name: str, value: object) -> list[dict[str, Any]]:
    """Return points to be in focus; one alone stands for a list of one."""
    return [point(name, item) for item in ([value] if is_row(value) else many(name, value))]


def weighted(name: str, value: object) -> Fields:
    """Return places, `(x, y[, weight])` in mm, in m, and their weights if any has one; one alone stands for a list of one."""
    rows = [
        row(name, item, "X,Y[,WEIGHT] in mm", 2, 3) for item in ([value] if is_row(value) else many(name, value))
    ]
    found = Fields(points_m=[[x / 1e3, y / 1e3] for x, y, *_ in rows])
    if any(weight for _, _, *weight in rows):
        found["weights"] = [weight[0] if weight else 1.0 for _, _, *weight in rows]
    return found


def shape(name: str, value: object) -> dict[str, Any]:
    """Return a shape: a text as the command line has it, the path of an SVG file, or a mapping."""
    if isinstance(value, Mapping):
        return _shape_of(name, value)
    given = path(name, value)
    kind, colon, rest = given.partition(":")
    if colon and kind in ("triangle", "circle"):
        return _sized(kind, row(f"{name} {kind}:", rest, "X,Y and a size in mm", 3, 3))
    return {"svg": {"file": given}}


def _sized(kind: str, mm: list[float]) -> dict[str, Any]:
    size = "side_m" if kind == "triangle" else "radius_m"
    return {kind: {"centre_m": [mm[0] / 1e3, mm[1] / 1e3], size: mm[2] / 1e3}}


def _shape_of(name: str, value: Mapping[str, object]) -> dict[str, Any]:
    for kind in ("triangle", "circle"):
        key = f"{kind}_mm"
        if key in value:
            only(name, value, key)
            return _sized(kind, row(name, value[key], "x, y and a size in mm", 3, 3))
    if "lines_mm" in value:
        only(name, value, "lines_mm", "closed", "filled")
        given = value["lines_mm"]
        closed, filled = (flag(name, value.get(key, False)) for key in ("closed", "filled"))
        lines = [_line(name, line, closed) for line in many(name, given)]
        return {"lines": {"lines": lines, "filled": filled}}
    if "svg" in value and isinstance(value["svg"], (str, os.PathLike)):
        only(name, value, "svg")
        return {"svg": {"file": path(name, value["svg"])}}
    found: dict[str, Any] = plain(name, value)
    return found


def _line(name: str, value: object, closed: bool) -> dict[str, Any]:
    return {"points_m": [place(name, corner) for corner in many(name, value)], "closed": closed}


def only(name: str, value: Mapping[str, object], *keys: str) -> None:
    """Refuse a mapping with other keys."""
    for key in value:
        if key not in keys:
            raise OptionError(f"{name}: expected {', '.join(keys)}, found {key}")


def shapes(name: str, value: object) -> list[dict[str, Any]]:
    """Return shapes to be in focus; one alone stands for a list of one."""
    return [shape(name, item) for item in many(name, value)]


def targets(name: str, value: object) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Return targets of both kinds: the points among them, and the shapes, each in their order."""
    points_found: list[dict[str, Any]] = []
    shapes_found: list[dict[str, Any]] = []
    for item in [value] if is_row(value) else many(name, value):
        if _is_shape(item):
            shapes_found.append(shape(name, item))
        else:
            points_found.append(point(name, item))
    return points_found, shapes_found


def _is_shape(item: object) -> bool:
    if isinstance(item, Mapping):
        return not ("at_mm" in item or "at_m" in item)
    if isinstance(item, os.PathLike):
        return True
    if not isinstance(item, str):
        return False
    try:
        return not [float(part) for part in item.split(",")]
    except ValueError:
        return True


def peak_um(name: str, value: object) -> dict[str, float]:
    """Return the level of a peak displacement in µm."""
    return {"peak-m": number(name, value) / 1e6}


def peak_m(name: str, value: object) -> dict[str, float]:
    """Return the level of a peak displacement in m."""
    return {"peak-m": number(name, value)}


def felt_db(name: str, value: object) -> dict[str, float]:
    """Return the level of what is felt, in dB above the threshold of touch."""
    return {"felt-db": number(name, value)}


def waveforms(name: str, value: object) -> list[dict[str, Any]]:
    """Return targets with their waveforms; one alone stands for a list of one."""
    alone = isinstance(value, tuple) and len(value) in (3, 4) and is_row(value[:2])
    return [waveform(name, item) for item in ([value] if alone else many(name, value))]


def waveform(name: str, value: object) -> dict[str, Any]:
    """Return a target and its waveform: `(x, y, what[, um])`, such a text as the command line's, or a mapping."""
    if isinstance(value, Mapping):
        return _waveform_of(name, value)
    parts = value.split(",", 2) if isinstance(value, str) else many(name, value)
    if not 3 <= len(parts) <= 4:
        raise AskError(field=name, expected=_WAVEFORM, found=shown(value))
    found: dict[str, Any] = {
        "at_m": place(name, f"{parts[0]},{parts[1]}" if isinstance(value, str) else parts[:2])
    }
    found["sound"], um = sound(name, parts[2])
    if len(parts) == 4:
        if um is not None:
            raise OptionError(f"{name}: expected one level, found two")
        um = number(name, parts[3])
    if um is not None:
        found["level_m"] = um * 1e-6
    return found


def _waveform_of(name: str, value: Mapping[str, object]) -> dict[str, Any]:
    only(name, value, "at_mm", "at_m", "sound", "level_um", "level_m")
    found: dict[str, Any] = {}
    for key, item in value.items():
        if key == "at_mm":
            found["at_m"] = place(name, item)
        elif key == "level_um":
            found["level_m"] = number(name, item) * 1e-6
        elif key == "sound":
            found["sound"], um = sound(name, item)
            if um is not None:
                found["level_m"] = um * 1e-6
        else:
            found[key] = plain(name, item)
    return found


def sound(name: str, value: object) -> tuple[dict[str, Any], float | None]:
    """Return a waveform, and its level in µm if its text ends with one."""
    if isinstance(value, Mapping):
        return plain(name, value), None
    if not isinstance(value, (str, os.PathLike)):
        return _samples(name, value), None
    what = path(name, value)
    kind, colon, rest = what.partition(":")
    if colon and kind == "sine":
        n = row(f"{name} sine:", rest, "HZ,MS[,UM]", 2, 3)
        return {"sine": {"hz": n[0], "length_s": n[1] / 1e3}}, n[2] if len(n) > 2 else None
    if colon and kind == "burst":
        n = row(f"{name} burst:", rest, "HZ,CYCLES[,UM]", 2, 3)
        return {"burst": {"hz": n[0], "cycles": n[1]}}, n[2] if len(n) > 2 else None
    if colon and kind == "click":
        n = row(f"{name} click:", rest, "MS[,UM]", 1, 2)
        return {"click": {"length_s": n[0] / 1e3}}, n[1] if len(n) > 1 else None
    file, comma, um = what.rpartition(",")
    try:
        level = float(um) if comma else None
    except ValueError:
        level = None
    return {"wav": {"file": what if level is None else file}}, level


def _samples(name: str, value: object) -> dict[str, Any]:
    parts = many(name, value)
    if len(parts) != 2:
        raise AskError(field=name, expected=_WAVEFORM, found=f"{len(parts)} parts")
    values, rate = parts
    try:
        samples = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise OptionError(f"{name}: expected samples, found {shown(values)}") from None
    if samples.ndim != 1 or not np.isfinite(samples).all():
        raise AskError(field=name, expected="one row of finite samples", found=f"shape {samples.shape}")
    return {"samples": {"values": samples.tolist(), "rate_hz": number(name, rate)}}


def stroke_path(name: str, value: object) -> dict[str, Any]:
    """Return the path of a moving focus: `line:X1,Y1,X2,Y2`, corners in mm, or a shape."""
    if isinstance(value, str) and value.startswith("line:"):
        mm = row(f"{name} line:", value.removeprefix("line:"), "X1,Y1,X2,Y2 in mm", 4, 4)
        corners = [[mm[0] / 1e3, mm[1] / 1e3], [mm[2] / 1e3, mm[3] / 1e3]]
        return {"lines": {"lines": [{"points_m": corners, "closed": False}], "filled": False}}
    if isinstance(value, (str, os.PathLike, Mapping)):
        return shape(name, value)
    return {"lines": {"lines": [_line(name, value, False)], "filled": False}}
