"""Drives computed from responses, and their fields, by the tasks that compute them; folders are written by the tasks themselves."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from unripple import _call, _values
from unripple._drive import Drive, floats
from unripple._errors import AskError
from unripple._field import Field
from unripple._report import Report

if TYPE_CHECKING:
    from unripple._responses import Responses


def focused(responses: Responses, command: str, options: Mapping[str, Any]) -> Drive:
    """Return the drive that a task computes from responses; have its folder written if one is wanted."""
    call = _call.Call(command, options)
    if "output" in call.ask:
        return _from_folder(_run(responses, call), call.ask["output"], responses.names)
    raw = responses._raw
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


def field(responses: Responses, driven: object, options: Mapping[str, Any]) -> Field:
    """Return the field of a drive, or of a WAV file or samples; have its folder written if one is wanted."""
    drive = _drive(responses, driven)
    call = _call.Call("field", {**_aimed(drive, options), **options})
    output = call.ask.pop("output", None)
    raw = call.perform(lambda telling, threads: responses._raw.field(call.json, drive._raw, telling, threads))
    found = Field._of(raw, responses.surface)
    if output is not None:
        is_path = isinstance(driven, (str, os.PathLike))
        samples = {"channels": drive.samples.tolist(), "rate_hz": drive.rate_hz}
        call.ask["drive"] = _values.path("drive", driven) if is_path else samples
        call.ask["output"] = output
        found._report = _run(responses, call)
    return found


def _run(responses: Responses, call: _call.Call) -> Report:
    """Have a task fill its folder, from responses of what can be named in the record of the folder."""
    if responses._named is None:
        expected = "responses of a surface in its own band, or of a library"
        raise AskError(field="output", expected=expected, found=f"others, of {responses.source}")
    raw = responses._raw
    done = call.perform(lambda telling, threads: raw.run(call.command, call.json, telling, threads))
    return Report._of(done)


def _drive(responses: Responses, driven: object) -> Drive:
    if isinstance(driven, Drive):
        return driven
    if isinstance(driven, (str, os.PathLike)):
        return Drive.from_wav(driven, responses.names)
    samples = floats("drive", driven, "actuators", "samples")
    return Drive(samples, rate_hz=responses.rate_hz, names=responses.names)


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
