"""Drives computed from responses, and their fields, by the tasks that compute them; folders are written by the tasks themselves."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from unripple import _call, _options, _unripple, _values
from unripple._drive import Drive, floats
from unripple._errors import AskError
from unripple._field import Field
from unripple._report import Report
from unripple._surface import Surface

if TYPE_CHECKING:
    from unripple._responses import Responses

#: What drives are computed for: a surface, whose responses may still have to be computed, or responses.
_Driven: TypeAlias = "Surface | Responses"


def focused(of: _Driven, command: str, options: Mapping[str, Any]) -> Drive:
    """Return the drive that a task computes; have its folder written if one is wanted."""
    call = _call.Call(command, options)
    _refuse(of, call)
    if "output" in call.ask:
        return _from_folder(_run(of, call), call.ask["output"], of.names)
    raw = _solved(of, options)._raw
    task = {"focus": raw.focus, "waveform": raw.waveform, "stroke": raw.stroke}[command]
    found = call.perform(lambda telling, threads: task(call.json, telling, threads))
    return Drive._of(found.drive, Report._of(found.done), found)


def _from_folder(report: Report, folder: str, names: list[str]) -> Drive:
    """Return the drive that a task has written to a folder, with its report and figures."""
    drive = Drive.from_wav(os.path.join(folder, "drive.wav"), names)
    pictures = [Path(folder, name) for name in report.files if name.endswith(".svg")]
    drive._report = report
    drive._figures = {picture.stem: picture.read_text(encoding="utf-8") for picture in pictures}
    return drive


def field(of: _Driven, driven: object, options: Mapping[str, Any]) -> Field:
    """Return the field of a drive, or of a WAV file or samples; have its folder written if one is wanted."""
    drive = _drive(of, driven)
    call = _call.Call("field", {**_aimed(drive, options), **options})
    _refuse(of, call, drive)
    output = call.ask.pop("output", None)
    # First, since a folder may be refused.
    written = None if output is None else _run(of, call, drive=_asked(driven, drive), output=output)
    responses = _solved(of, options)
    raw = call.perform(lambda telling, threads: responses._raw.field(call.json, drive._raw, telling, threads))
    found = Field._of(raw, responses.surface)
    if written is not None:
        found._report = written
    return found


def _refuse(of: _Driven, call: _call.Call, drive: Drive | None = None) -> None:
    """Refuse what makes no sense before the responses of a surface are computed, which may take minutes."""
    if "output" in call.ask:
        _named(of)
    if isinstance(of, Surface):
        surface, raw = of._raw, None if drive is None else drive._raw
        call.perform(lambda telling, threads: surface.refuse(call.command, call.json, raw))


def _solved(of: _Driven, options: Mapping[str, Any]) -> Responses:
    """Return responses, those of a surface computed as a call says."""
    if not isinstance(of, Surface):
        return of
    calls: dict[str, Any] = {name: options[name] for name in _options.OF_CALLS if options.get(name) is not None}
    return of.responses(**calls)


def _named(of: _Driven) -> Any:
    """Return what tasks call a surface or responses; refuse responses that no task makes again."""
    if isinstance(of, Surface):
        return of.as_ask()
    named = of._named
    if named is None:
        expected = "responses of a surface in its own band, or of a library"
        raise AskError(field="output", expected=expected, found=f"others, of {of.source}")
    return named if isinstance(named, str) else named.as_ask()


def _run(of: _Driven, call: _call.Call, **more: Any) -> Report:
    """Have a task fill its folder, from what can be named in the record of the folder; with more fields in its ask."""
    named, ask = _named(of), {**call.ask, **more}
    if isinstance(of, Surface):
        told = json.dumps({**ask, "surface": named}, allow_nan=False)
        done = call.perform(lambda telling, threads: _unripple.run(call.command, told, telling, threads))
    else:
        raw, told = of._raw, json.dumps(ask, allow_nan=False)
        # What is opened is not read again: its name may stand for another place by now.
        done = call.perform(lambda telling, threads: raw.run(call.command, told, telling, threads))
    return Report._of(done)


def _drive(of: _Driven, driven: object) -> Drive:
    if isinstance(driven, Drive):
        return driven
    if isinstance(driven, (str, os.PathLike)):
        return Drive.from_wav(driven, of.names)
    samples = floats("drive", driven, "actuators", "samples")
    return Drive(samples, rate_hz=of.rate_hz, names=of.names)


def _asked(driven: object, drive: Drive) -> Any:
    """Return a drive as an ask holds it: the path of a file, or samples."""
    if isinstance(driven, (str, os.PathLike)):
        return _values.path("drive", driven)
    return {"channels": drive.samples.tolist(), "rate_hz": drive.rate_hz}


def _aimed(drive: Drive, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return where and when a drive is evaluated, and its period, as its report says, where the options do not."""
    if drive.report is None:
        return {}

    def absent(*names: str) -> bool:
        return all(options.get(name) is None for name in names)

    found: dict[str, Any] = {}
    # Of a shape the report has the centroid, which is no place of it.
    targets = [target for target in drive.report.targets if target.points == 1]
    if targets and absent("at", "points_mm", "points_m"):
        found["points_m"] = [target.at_m for target in targets]
        if absent("at_ms", "instants_s"):
            found["instants_s"] = [target.instant_s for target in targets]
    period = drive.report.get("period_s")
    if period is not None and absent("period_ms", "period_s"):
        found["period_s"] = period
    return found
