"""What a call asks: the ask of a command, made of options, and how its work is told and done."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from unripple import _options, _targets, _unripple, _values
from unripple._errors import OptionError, UnrippleError
from unripple._progress import Telling, chosen_threads
from unripple._report import Report
from unripple._typed import typed
from unripple._values import NOTHING, Fields

_Done = TypeVar("_Done")

#: Options that mean something only beside another, by command; the command line refuses them alone, too.
_BESIDE = {
    "fit": {"grid_mm": "output", "at": "output", "even_if_doubtful": "output"},
    "calibrate": {"snr_db": "unknowns"},
    "verify": {"snr_db": "unknowns"},
    "drift": {"snr_db": "unknowns"},
    "doctor": {"snr_db": "unknowns"},
    "optimise": {"stop_percent": "stop_after"},
    "play": {"snr_db": "unknowns"},
}

#: Options that exclude each other.
_APART = {"calibrate": (("figure", "check_levels"), ("table", "at"), ("table", "grid_mm")), "place": (("keep", "keep_all"),)}

#: Fields without which there is nothing to do, by command, with the option that sets them.
_NEEDED = {
    "listen": {"recording": "recording"},
    "fit_modes": {"modes": "modes"},
    "stroke": {"path": "path", "speed_m_s": "speed_mm_s"},
    "waveform": {"waveforms": "waveform"},
}


class Call:
    """A call: the ask of a command, and how its work is told and done."""

    def __init__(self, command: str, options: Mapping[str, object]) -> None:
        given = {name: value for name, value in options.items() if value is not None}
        #: What was typed, by the names of options.
        self.typed = dict(given)
        self.command = command
        self.threads = chosen_threads(given.pop("threads", None))
        self.telling = Telling(given.pop("progress", None))
        #: The option that set each field.
        self.set_by: dict[str, str] = {}
        self.ask: dict[str, Any] = {}
        self._surfaces(given)
        for name, value in given.items():
            self._take(name, value)
        self._check(given)

    def _check(self, given: Mapping[str, object]) -> None:
        """Refuse what cannot be together, and what cannot be alone."""
        for name, other in _BESIDE.get(self.command, {}).items():
            if name in given and other not in given:
                raise OptionError(f"{self.command}: expected {other} beside {name}, found none")
        for name, other in _APART.get(self.command, ()):
            if self.ask.get(name) and self.ask.get(other):
                raise OptionError(f"{self.command}: expected one of {name} and {other}, found both")
        for field, name in _NEEDED.get(self.command, {}).items():
            if field not in self.set_by:
                raise OptionError(f"{self.command}: expected {name}, found none")

    def _surfaces(self, given: dict[str, object]) -> None:
        """Read the options that say of which surface, or of which surfaces, something is asked."""
        from unripple._naming import surface_ask, surfaces_ask

        known = _options.fields(self.command)
        changed = given.pop("set", None)
        if "surface" not in known:
            if changed is not None:
                raise OptionError(
                    f"{self.command}: expected no set, since it reads no surface file, found one"
                )
            return
        if "others" in known:
            surfaces, labels = surfaces_ask(given.pop("surface", None), changed, given.pop("vary", None))
            if surfaces:
                self._put("surface", "surface", surfaces[0])
            if len(surfaces) > 1:
                self._put("surface", "others", surfaces[1:])
            if labels:
                self._put("vary", "labels", labels)
            others = given.pop("others", None)
            if others is not None:
                self._put("others", "others", [surface_ask(item) for item in _values.many("others", others)])
        elif "surface" in given or changed is not None:
            self._put("surface", "surface", surface_ask(given.pop("surface", "hudin-2012"), changed))

    def _take(self, name: str, value: object) -> None:
        if name == "targets" and "points" in _options.fields(self.command):
            points, shapes = _targets.targets(name, value)
            for field, found in (("points", points), ("shapes", shapes)):
                if found:
                    self._put(name, field, found)
            return
        option = _options.by_name(self.command).get(name)
        if option is None:
            raise _options.unknown(self.command, name, _options.names(self.command))
        found = option.value(name, value)
        if isinstance(found, Fields):
            for field, item in found.items():
                self._put(name, field, item)
        elif found is not NOTHING:
            self._put(name, option.field, found)

    def _put(self, name: str, field: str, value: Any) -> None:
        """Set a field, once; a mapping of a table's fields sets each of them."""
        table, dot, inner = field.partition(".")
        if not dot and table in ("device", "touch") and isinstance(value, Mapping):
            for key, item in value.items():
                self._put(name, f"{table}.{key}", item)
            return
        if field in self.set_by:
            raise OptionError(f"{self.command}: expected one of {self.set_by[field]} and {name}, found both")
        self.set_by[field] = name
        if dot:
            self.ask.setdefault(table, {})[inner] = value
        else:
            self.ask[field] = value

    @property
    def json(self) -> str:
        """The ask as JSON."""
        return json.dumps(self.ask, allow_nan=False)

    @property
    def goes_on(self) -> bool:
        """Whether only an interrupt ends it: playing without a time or a recorded session."""
        lasts = self.ask.get("seconds"), self.ask.get("touch", {}).get("session")
        return self.command == "play" and lasts == (None, None)

    def perform(self, work: Callable[[Telling, int | None], _Done]) -> _Done:
        """Do the work of a call, with its progress; an error about a field names the option that set it, or that sets it."""
        try:
            with self.telling as telling:
                return work(telling, self.threads)
        except UnrippleError as error:
            told = typed(error, self._names(), self.typed)
            if told is error:
                raise
            raise told from None

    def _names(self) -> dict[str, str]:
        """Return the options by the fields that errors name: those that were typed, else the first that sets a field."""
        found: dict[str, str] = {}
        for option in _options.OPTIONS.get(self.command, ()):
            found.setdefault(option.field.rpartition(".")[2], option.name)
        for field, name in self.set_by.items():
            found[field.rpartition(".")[2]] = name
        # A level is one of several options, and errors name the kind.
        level = self.set_by.get("level")
        found["peak_m"] = level if level in ("peak_um", "peak_m") else "peak_um"
        return found


def focusing(options: Mapping[str, object]) -> str:
    """Return the task that computes a drive for some options of the command `focus`: `focus`, `waveform` or `stroke`."""
    given = {name for name, value in options.items() if value is not None}
    if "path" in given:
        return "stroke"
    return "waveform" if given & {"waveform", "waveforms"} else "focus"


def run(command: str, options: Mapping[str, object]) -> _unripple.Done:
    """Do a command by its name, as the command line has it.

    What has been played when an interrupt comes is returned where only that ends it; otherwise its report is an attribute of the exception.
    """
    if _values.text("command", command) == "focus":
        command = focusing(options)
    call = Call(command, options)
    try:
        return call.perform(lambda telling, threads: _unripple.run(command, call.json, telling, threads))
    except KeyboardInterrupt as interrupt:
        played: _unripple.Done | None = vars(interrupt).pop("done", None)
        if played is None:
            raise
        if call.goes_on:
            return played
        vars(interrupt)["report"] = Report._of(played)
        raise


def report(command: str, options: Mapping[str, Any], **more: Any) -> Report:
    """Return the report of a command; what was given as an argument is no option too."""
    for name in more:
        if name in options:
            raise OptionError(f"{command}: expected {name} once, found it twice")
    return Report._of(run(command, {**more, **options}))
