"""Options of every command by their names on the command line, and the ask that they make.

An ask holds what a task is asked, in SI units. Each option below sets one field of it, by the same floating-point operation as the command
line's; the fields' own names are accepted as well.
"""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

from unripple import _targets, _unripple, _values, _wiring
from unripple._errors import OptionError
from unripple._values import NOTHING, count, flag, milli, number, path, percent, text


@dataclass(frozen=True, slots=True)
class Option:
    """An option: its name, the field that it sets (`device.card`: of a table), and how its value becomes the field's."""

    name: str
    field: str
    value: Callable[[str, object], Any]


def _method(name: str, value: object) -> str:
    """Return the name of a method, in which hyphens may be underscores."""
    return text(name, value).replace("_", "-")


def _methods(name: str, value: object) -> list[str]:
    """Return the names of methods."""
    return [_method(name, item) for item in _values.texts(name, value)]


def _same(value: Callable[[str, object], Any], *names: str) -> tuple[Option, ...]:
    """Options that are called as their fields."""
    return tuple(Option(name, name, value) for name in names)


def _in(table: str, value: Callable[[str, object], Any], *names: str) -> tuple[Option, ...]:
    """Options that are called as their fields, which are in a table of the ask."""
    return tuple(Option(name, f"{table}.{name}", value) for name in names)


def _device(name: str, value: object) -> Any:
    """Return the kind of a device; a mapping is a whole device, in the ask's own words."""
    if isinstance(value, Mapping):
        return _values.plain(name, value)
    return {"device": text(name, value)}


def _places(name: str, *more: str) -> tuple[Option, ...]:
    """Places in mm: as the command line calls them, and as their field with another unit."""
    field = f"{more[0]}_m"
    return Option(name, field, _values.places), Option(f"{more[0]}_mm", field, _values.places)


def _polygons(name: str, more: str) -> tuple[Option, ...]:
    """Polygons with corners in mm: as the command line calls them, and as their field with another unit."""
    return Option(name, f"{more}_m", _values.polygons), Option(f"{more}_mm", f"{more}_m", _values.polygons)


def _limit(name: str, value: object) -> Any:
    """Return the level of the drive limit, if it is wanted."""
    return "limit" if flag(name, value) else NOTHING


def _taps(name: str, value: object) -> Any:
    """Return that taps are planned, if they are."""
    return "taps" if flag(name, value) else NOTHING


def _band(name: str, value: object) -> list[float]:
    """Return a lowest and a highest frequency, in Hz."""
    return _values.row(name, value, "LOW,HIGH in Hz", 2, 2)


def _surface(_name: str, value: object) -> Any:
    from unripple._naming import surface_ask

    return surface_ask(value)


def _drive(name: str, value: object) -> Any:
    """Return a drive: a WAV file, or samples."""
    from unripple._drive import Drive

    if isinstance(value, Drive):
        return {"channels": value.samples.tolist(), "rate_hz": value.rate_hz}
    return _values.plain(name, value) if isinstance(value, Mapping) else path(name, value)


_DEVICE = (
    Option("device", "device", _device),
    *_in("device", text, "jack_client", "jack_server", "card", "capture_card"),
    *_in("device", flag, "freewheel"),
    *_in("device", count, "card_block", "unknowns"),
    *_in("device", path, "tape"),
    *_in("device", _values.named, "tape_inputs"),
    *_in("device", number, "output_scale", "snr_db"),
)

_TARGETS = (
    Option("at", "points", _targets.points),
    Option("points", "points", _targets.points),
    Option("shape", "shapes", _targets.shapes),
    Option("shapes", "shapes", _targets.shapes),
    Option("peak_um", "level", _targets.peak_um),
    Option("peak_m", "level", _targets.peak_m),
    Option("felt_db", "level", _targets.felt_db),
    Option("full_limit", "level", _limit),
)

_WINDOW = (Option("window_ms", "window_s", milli),)
_FIGURES = (*_same(flag, "no_figures"), *_same(count, "columns"), *_same(path, "output"))
_JUDGED = (*_same(number, "judge_hz"), Option("on", "on", _surface))
_POINTS = (*_places("at", "points"), Option("grid_mm", "pitch_m", milli))

#: The options of each command but `surface`, `set` and `vary`, which are read apart.
OPTIONS: dict[str, tuple[Option, ...]] = {
    "check": (),
    "materials": _same(text, "name"),
    "devices": _same(text, "server"),
    "design": (),
    "modes": (Option("max_hz", "top_hz", number), *_same(number, "accuracy")),
    "place": (
        *_same(count, "count", "targets", "restarts", "seed", "up_to", "evaluations"),
        *_same(_values.texts, "keep"),
        *_same(flag, "keep_all"),
        *_same(text, "like", "objective"),
        Option("rim_mm", "rim_m", _values.distances),
        *_polygons("within", "within"),
        *_polygons("keep_out", "keep_out"),
        *_polygons("screen", "targets_within"),
        *_same(path, "importance"),
        *_same(_values.important, "important"),
        *_places("place", "places"),
        Option("grid_mm", "pitch_m", milli),
        Option("apart_mm", "apart_m", milli),
        Option("at", "points_m", _targets.weighted),
        Option("points_mm", "points_m", _targets.weighted),
        Option("share_percent", "share", percent),
        Option("mounting_mm", "mounting_m", milli),
        Option("tension_percent", "tension", percent),
        *_WINDOW,
        Option("method", "methods", _methods),
        *_same(_method, "by"),
        *_FIGURES,
    ),
    "sensors": (
        *_same(count, "count", "profile", "restarts", "seed", "up_to"),
        Option("taps", "sensing", _taps),
        *_same(text, "sensing"),
        *_places("keep", "keep"),
        Option("rim_mm", "rim_m", _values.distances),
        *_polygons("within", "within"),
        *_polygons("keep_out", "keep_out"),
        *_places("place", "places"),
        Option("grid_mm", "pitch_m", milli),
        Option("apart_mm", "apart_m", milli),
        *_same(number, "snr_db"),
        *_FIGURES,
    ),
    "respond": (
        Option("grid_mm", "pitch_m", milli),
        Option("length_ms", "length_s", milli),
        *_same(path, "output"),
    ),
    "focus": (
        *_TARGETS,
        *_WINDOW,
        *_FIGURES,
        *_JUDGED,
        *_same(_method, "method", "losses"),
        *_same(text, "between"),
        *_same(number, "strength", "push", "total_rms", "worst", "economy", "listen_m"),
        *_same(flag, "rest", "finger_aware"),
        Option("spread_percent", "spread", percent),
        Option("duration_ms", "duration_s", milli),
        *_places("finger", "fingers"),
        *_places("bear_finger", "bear_fingers"),
        Option("bear_tension_percent", "bear_tension", percent),
    ),
    "waveform": (
        Option("waveform", "waveforms", _targets.waveforms),
        Option("waveforms", "waveforms", _targets.waveforms),
        *_places("silent", "silent"),
        *_WINDOW,
        *_FIGURES,
        *_JUDGED,
    ),
    "stroke": (
        Option("path", "path", _targets.stroke_path),
        Option("speed_mm_s", "speed_m_s", milli),
        Option("level_mm_s", "level_m_s", milli),
        *_WINDOW,
        *_FIGURES,
        *_JUDGED,
    ),
    "compare": (
        *_TARGETS,
        *_WINDOW,
        *_FIGURES,
        *_same(number, "judge_hz", "listen_m"),
        Option("method", "methods", _methods),
        *_same(_values.texts, "labels"),
    ),
    "field": (
        Option("drive", "drive", _drive),
        *_places("at", "points"),
        Option("at_ms", "instants_s", _values.times_ms),
        Option("instants_s", "instants_s", _values.times),
        *_places("finger", "fingers"),
        Option("period_ms", "period_s", milli),
        *_same(number, "judge_hz", "listen_m"),
        *_FIGURES,
        Option("movie_ms", "movie_s", _values.span_ms),
        *_same(count, "frames"),
        *_same(text, "between"),
    ),
    "calibrate": (
        *_DEVICE,
        *_POINTS,
        *_same(text, "by"),
        *_same(count, "repeats"),
        Option("sweep_ms", "sweep_s", milli),
        Option("response_ms", "response_s", milli),
        *_same(number, "level"),
        Option("wire", "wires", _wiring.wires),
        Option("input_scale", "input_scales", _wiring.scales),
        *_same(_values.texts, "without"),
        Option("probe_delay_ms", "probe_delay_s", milli),
        *_same(flag, "no_model", "resample", "check_levels", "any_wiring"),
        *_same(path, "table", "figure", "output"),
    ),
    "fit": (
        *_same(path, "library", "output"),
        *_POINTS,
        *_same(count, "strays", "profile"),
        *_same(flag, "even_if_doubtful"),
        *_same(number, "accuracy"),
    ),
    "listen": (
        *_same(path, "recording"),
        *_same(count, "channel", "hit", "most"),
        *_same(_values.interval, "band_hz"),
        *_same(number, "mains_hz", "least_db"),
        *_FIGURES,
    ),
    "fit_modes": (
        *_same(_values.frequencies, "modes"),
        *_same(_values.named, "free"),
        Option("error_percent", "error", percent),
        *_same(flag, "sides_known"),
        *_FIGURES,
    ),
    "import": (
        *_same(_values.paths, "files"),
        *_same(text, "kind", "quantity", "unit", "per", "pattern", "length_unit"),
        *_same(number, "drive_per_reference"),
        *_same(_band, "band_hz"),
        *_same(path, "table", "output"),
        Option("offset_mm", "offset_m", _values.place),
        Option("actuator", "actuator_names", _wiring.wires),
        *_same(_values.texts, "without"),
        Option("length_ms", "length_s", milli),
    ),
    "export": (
        *_same(path, "library", "output"),
        *_same(text, "format", "author", "organization", "license"),
    ),
    "verify": (
        *_DEVICE,
        Option("drive", "drive", _drive),
        Option("at", "target_m", _values.place),
        Option("at_ms", "instant_s", milli),
        Option("probe_mm", "probes_m", _values.places),
        Option("probes", "probe_count", count),
        *_same(number, "level", "probe_scale", "judge_hz", "clipped"),
        Option("wire", "wires", _wiring.wires),
        *_same(text, "between"),
        *_same(flag, "dry_run"),
        Option("changed_percent", "changed", percent),
        *_same(_wiring.wires, "swapped"),
    ),
    "drift": (
        *_DEVICE,
        *_same(number, "seconds"),
        Option("within_percent", "range", percent),
        Option("changed_percent", "changed", percent),
        Option("changing_percent_per_min", "changing_per_min", percent),
    ),
    "doctor": (*_DEVICE, Option("tuio", "tuio", partial(_values.port, 3333)), *_same(text, "listen")),
    "play": (
        *_DEVICE,
        *_same(path, "effect", "keep_drive"),
        *_in("touch", count, "fingers", "seed"),
        Option("tuio", "touch.tuio", partial(_values.port, 3333)),
        Option("websocket", "touch.websocket", partial(_values.port, 8765)),
        *_in("touch", text, "listen"),
        *_in("touch", _values.paths, "screen"),
        *_in("touch", path, "session", "record"),
        *_same(_method, "method"),
        *_WINDOW,
        *_same(count, "block"),
        *_same(number, "seconds"),
        *_same(flag, "full_limit", "follow_tension", "real_time"),
        Option("drift_percent", "drift", percent),
    ),
    "sweep": (*_same(path, "plan"), *_same(count, "shard"), *_same(flag, "count"), *_FIGURES),
    "optimise": (
        *_same(path, "plan"),
        *_same(flag, "no_ask"),
        *_same(count, "stop_after"),
        Option("stop_percent", "stop_share", percent),
        *_FIGURES,
    ),
    "reproduce": (*_same(path, "output"), *_same(count, "placements")),
    "rerun": _same(path, "report", "output"),
}

#: Fields in SI units that are lists of places, which are given as arrays too.
_PLACES_M = ("points_m", "fingers_m", "silent_m", "bear_fingers_m", "places_m", "keep_m", "probes_m")

#: Fields in SI units that are lists of polygons.
_POLYGONS_M = ("within_m", "keep_out_m", "targets_within_m")

#: Options of every call, which are no part of an ask.
OF_CALLS = ("progress", "threads")


@cache
def fields(command: str) -> Mapping[str, str]:
    """The fields of a command's ask by their names; those of a table stand beside the others, by their path."""
    found: dict[str, str] = {}
    for field, value in json.loads(_unripple.default_ask(command)).items():
        found[field] = field
        if field in ("device", "touch"):
            found.update({inner: f"{field}.{inner}" for inner in value if inner != field})
    return found


@cache
def by_name(command: str) -> Mapping[str, Option]:
    """All options of a command by their names: those of the command line, and its fields in SI units."""
    found = {option.name: option for option in OPTIONS.get(command, ())}
    for name, field in fields(command).items():
        found.setdefault(name, Option(name, field, _in_si(name)))
    return found


def _in_si(name: str) -> Callable[[str, object], Any]:
    """Return how the value of a field in SI units is read."""
    if name in _PLACES_M:
        return _values.places_m
    return _values.polygons_m if name in _POLYGONS_M else _values.plain


def names(command: str) -> list[str]:
    """All names that options of a command may have."""
    own = {"surface": ["set"], "others": ["vary"], "points": ["targets"]}
    more = [name for field, names in own.items() if field in fields(command) for name in names]
    return [*by_name(command), *more, *OF_CALLS]


def unknown(command: str, name: str, known: list[str]) -> OptionError:
    """Return the error of an option that a command does not have."""
    nearest = difflib.get_close_matches(name, known, 1)
    hint = f" (nearest: {nearest[0]})" if nearest else ""
    return OptionError(f"{command}: expected an option that it has, found {name}{hint}")
