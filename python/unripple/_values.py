"""Values of options: what Python gives, as an ask has it, by the arithmetic of the command line."""

from __future__ import annotations

import math
import numbers
import operator
import os
import warnings
from collections.abc import Collection, Iterable, Mapping
from typing import Any

import numpy as np

from unripple._errors import AskError, OptionError, UnrippleWarning

#: Stands for an option that is given and sets nothing, such as a flag that is False.
NOTHING: Any = object()

#: What a polygon may be, for messages.
_POLYGON = "at least three corners X,Y in mm"

#: What a polygon with a weight may be, for messages.
_WEIGHTED = "a polygon in mm and its weight"

#: Most corners of a polygon that is a text: of more the command line takes some for a mistake.
_CORNERS = 1000

#: Share of a surface's larger side within which places are taken to be metres given for millimetres: any place on it would lie there. Nobody
#: aims so near to a corner.
_METRES = 1e-3

#: Most characters of a value in a message; twice as many fill two lines with one value.
_SHOWN = 80


class Fields(dict[str, Any]):
    """Values of several fields by their names, all of which one option sets."""


def shown(value: object) -> str:
    """Return a value as messages show it."""
    text = repr(value)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"


def number(name: str, value: object) -> float:
    """Return a finite number."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        raise OptionError(f"{name}: expected a number, found {shown(value)}")
    try:
        found = float(value)
    except (TypeError, ValueError, OverflowError):
        raise OptionError(f"{name}: expected a number, found {shown(value)}") from None
    if not math.isfinite(found):
        raise AskError(field=name, expected="a finite number", found=str(found))
    return found


def is_number(value: object) -> bool:
    """Tell whether a value is one number."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


def milli(name: str, value: object) -> float:
    """Return a number of thousandths, such as mm or ms, as one of wholes."""
    return number(name, value) / 1e3


def percent(name: str, value: object) -> float:
    """Return a number of per cent as a share."""
    return number(name, value) / 100.0


def count(name: str, value: object) -> int:
    """Return a whole number that is not below 0."""
    try:
        found = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise OptionError(f"{name}: expected a whole number, found {shown(value)}") from None
    if isinstance(value, (bool, np.bool_)):
        raise OptionError(f"{name}: expected a whole number, found {shown(value)}")
    if not 0 <= found < 2**64:
        raise AskError(field=name, expected="a whole number from 0", found=str(found))
    return found


def flag(name: str, value: object) -> bool:
    """Return whether something is wanted."""
    if not isinstance(value, (bool, np.bool_)):
        raise OptionError(f"{name}: expected True or False, found {shown(value)}")
    return bool(value)


def text(name: str, value: object) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise OptionError(f"{name}: expected a text, found {shown(value)}")
    if any("\ud800" <= character <= "\udfff" for character in value):
        raise AskError(field=name, expected="a text of whole characters", found=shown(value))
    return value


def texts(name: str, value: object) -> list[str]:
    """Return a list of texts; one alone stands for a list of one."""
    return [text(name, item) for item in many(name, value)]


def named(name: str, value: object) -> list[str]:
    """Return a list of names, which may also be given with commas between them."""
    return [part.strip() for item in texts(name, value) for part in item.split(",")]


def path(name: str, value: object) -> str:
    """Return the path of a file or folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise OptionError(f"{name}: expected a path, found {shown(value)}")
    return text(name, os.fspath(value))


def paths(name: str, value: object) -> list[str]:
    """Return a list of paths; one alone stands for a list of one."""
    return [path(name, item) for item in many(name, value)]


def port(usual: int, name: str, value: object) -> Any:
    """Return a port; True stands for the usual one."""
    if isinstance(value, (bool, np.bool_)):
        return usual if value else NOTHING
    return count(name, value)


def many(name: str, value: object) -> list[Any]:
    """Return the items of a list; a text, a path or a mapping alone stands for a list of one."""
    if isinstance(value, (str, os.PathLike, Mapping)):
        return [value]
    if isinstance(value, np.ndarray) and value.ndim == 0 or not isinstance(value, Iterable):
        raise OptionError(f"{name}: expected a list, found {shown(value)}")
    return list(value)


def row(name: str, value: object, form: str, least: int, most: int) -> list[float]:
    """Return numbers given as a sequence, or as a text with commas between them."""
    parts = value.split(",") if isinstance(value, str) else many(name, value)
    if not least <= len(parts) <= most:
        raise AskError(field=name, expected=form, found=f"{len(parts)} numbers")
    return [_parsed(name, part, form) for part in parts]


def _parsed(name: str, part: object, form: str) -> float:
    if not isinstance(part, str):
        return number(name, part)
    try:
        read = float(part)
    except ValueError:
        raise AskError(field=name, expected=form, found=shown(part.strip())) from None
    return number(name, read)


def is_row(value: object) -> bool:
    """Tell whether a value is one row of numbers rather than a list of rows."""
    if isinstance(value, np.ndarray):
        return value.ndim == 1 and value.dtype != object
    if isinstance(value, (str, Mapping)) or not isinstance(value, Collection):
        return False
    return len(value) > 0 and all(isinstance(item, numbers.Real) for item in value)


def place(name: str, value: object) -> list[float]:
    """Return a place, given in mm, in m."""
    x, y = row(name, value, "X,Y in mm", 2, 2)
    return [x / 1e3, y / 1e3]


def places(name: str, value: object) -> list[list[float]]:
    """Return places, given in mm, in m; one alone stands for a list of one."""
    return [place(name, item) for item in ([value] if is_row(value) else many(name, value))]


def places_m(name: str, value: object) -> list[list[float]]:
    """Return places in m; one alone stands for a list of one."""
    rows = [value] if is_row(value) else many(name, value)
    return [row(name, item, "x and y in m", 2, 2) for item in rows]


def polygons(name: str, value: object) -> list[list[list[float]]]:
    """Return polygons, given by their corners in mm or as texts of all these, in m; one alone stands for a list of one."""
    return [_polygon(name, item) for item in _polygons(name, value)]


def polygons_m(name: str, value: object) -> list[list[list[float]]]:
    """Return polygons, given by their corners in m; one alone stands for a list of one."""
    return [places_m(name, many(name, item)) for item in _polygons(name, value)]


def _polygons(name: str, value: object) -> list[Any]:
    """Return polygons as they are; corners, which are rows of numbers, are those of one alone."""
    items = many(name, value)
    return [items] if any(is_row(item) for item in items) else items


def _polygon(name: str, value: object) -> list[list[float]]:
    if isinstance(value, str):
        mm = row(name, value, _POLYGON, 6, 2 * _CORNERS)
        if len(mm) % 2 == 1:
            raise AskError(field=name, expected="pairs X,Y in mm", found=f"{len(mm)} numbers")
        return [[x / 1e3, y / 1e3] for x, y in zip(mm[::2], mm[1::2], strict=True)]
    corners = [place(name, corner) for corner in many(name, value)]
    if len(corners) < 3:
        raise AskError(field=name, expected=_POLYGON, found=f"{len(corners)} corners")
    return corners


def important(name: str, value: object) -> list[dict[str, Any]]:
    """Return areas with their weights: pairs of a polygon in mm and a number, texts as the command line has them, or mappings in m."""
    if isinstance(value, tuple) and len(value) == 2 and is_number(value[1]):
        return [_important(name, value)]
    return [_important(name, item) for item in many(name, value)]


def _important(name: str, item: object) -> dict[str, Any]:
    if isinstance(item, Mapping):
        return {str(key): plain(name, part) for key, part in item.items()}
    if isinstance(item, str):
        typed, colon, number_typed = item.rpartition(":")
        parts: list[Any] = [typed, number_typed] if colon else []
    else:
        parts = many(name, item)
    if len(parts) != 2:
        raise AskError(field=name, expected=_WEIGHTED, found=shown(item))
    corners, weight = parts
    return {"area_m": _polygon(name, corners), "weight": _parsed(name, weight, _WEIGHTED)}


def distances(name: str, value: object) -> list[float]:
    """Return a least and a greatest distance, given in mm, in m."""
    least, most = row(name, value, "LEAST,MOST in mm", 2, 2)
    return [least / 1e3, most / 1e3]


def interval(name: str, value: object) -> list[float]:
    """Return a lowest and a highest frequency in Hz."""
    return row(name, value, "LOW,HIGH in Hz", 2, 2)


def frequencies(name: str, value: object) -> list[dict[str, Any]]:
    """Return measured modes: frequencies in Hz, pairs of them with decay times in ms, texts as the command line has them, or mappings."""
    items = [value] if is_number(value) else many(name, value)
    found = []
    for item in items:
        if isinstance(item, str):
            found += [_frequency(name, part.strip()) for part in item.split(",")]
        elif isinstance(item, Mapping):
            found.append(plain(name, item))
        elif is_number(item):
            found.append({"frequency_hz": number(name, item)})
        else:
            hz, ms = row(name, item, "a frequency in Hz and a decay time in ms", 2, 2)
            found.append({"frequency_hz": hz, "decay_time_s": ms / 1e3})
    return found


def _frequency(name: str, text: str) -> dict[str, Any]:
    """Return a mode of a text HZ[:MS] or HZ:Q with a quality factor."""
    form = "HZ[:MS] or HZ:Q with a quality factor"
    typed, colon, time = text.partition(":")
    hz = _parsed(name, typed, form)
    if not colon:
        return {"frequency_hz": hz}
    time = time.strip()
    if time[:1] in ("Q", "q"):
        if hz == 0:
            raise AskError(field=name, expected=form, found=shown(text))
        return {"frequency_hz": hz, "decay_time_s": _parsed(name, time[1:], form) / (math.pi * hz)}
    return {"frequency_hz": hz, "decay_time_s": _parsed(name, time, form) / 1e3}


def times_ms(name: str, value: object) -> list[float]:
    """Return times, given in ms, in s; one alone stands for a list of one."""
    return [milli(name, item) for item in times(name, value)]


def times(name: str, value: object) -> list[float]:
    """Return times as they are; one alone stands for a list of one."""
    single = isinstance(value, numbers.Real) or isinstance(value, np.ndarray) and value.ndim == 0
    return [number(name, item) for item in ([value] if single else many(name, value))]


def span_ms(name: str, value: object) -> list[float]:
    """Return a start and an end, given in ms, in s."""
    start, end = row(name, value, "FROM,TO in ms", 2, 2)
    if not 0.0 <= start < end:
        raise AskError(field=name, expected="0 <= FROM < TO", found=f"{start}, {end}")
    return [start / 1e3, end / 1e3]


def plain(name: str, value: object) -> Any:
    """Return a value of a field in SI units as JSON knows it."""
    if isinstance(value, (np.ndarray, np.generic)):
        return plain(name, value.tolist())
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, numbers.Real):
        return number(name, value)
    if isinstance(value, os.PathLike):
        return path(name, value)
    if isinstance(value, Mapping):
        return {str(key): plain(name, item) for key, item in value.items()}
    if isinstance(value, Iterable):
        return [plain(name, item) for item in value]
    raise OptionError(f"{name}: expected a number, a text, a list or a mapping, found {shown(value)}")


def warn_of_metres(name: str, points: object, extent_m: tuple[float, float]) -> None:
    """Warn if all points among targets, in mm, are so near to the corner of a surface that they seem to be in metres."""
    if not isinstance(points, (list, tuple, np.ndarray)):
        # What can be read once alone is left to whoever takes it.
        return
    try:
        places = [(float(point[0]), float(point[1])) for point in points if not isinstance(point, (str, Mapping))]
    except (TypeError, ValueError, LookupError):
        # What they are is said by whoever takes them.
        return
    near = 1e3 * _METRES * max(extent_m)
    if places and max(max(abs(x), abs(y)) for x, y in places) <= near:
        said = f"{name} are given in mm, and these lie within {near:.2g} mm of the surface's corner"
        warnings.warn(f"{said}: are they in metres?", UnrippleWarning, stacklevel=4)
