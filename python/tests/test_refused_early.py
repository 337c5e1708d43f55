"""What makes no sense is refused before there is work to lose: no stage of it has begun."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import unripple as ur

#: A place beyond the film, in mm.
_BEYOND = (300, 90)

#: Calls that make no sense, of a surface whose responses nobody has computed.
_FOCUS: list[dict[str, Any]] = [
    {"window_ms": -1},
    # 30 ms in seconds.
    {"window_ms": 0.03},
    {"duration_ms": 0},
    {"method": "felt", "worst": 2},
    {"method": "inverse", "strength": 3},
    {"total_rms": -1},
    {"fingers_mm": [_BEYOND]},
    {"finger_aware": True},
    {"bear_tension_percent": 60, "method": "robust"},
    {"bear_fingers_mm": [_BEYOND], "method": "robust"},
    {"judge_hz": 1},
    {"listen_m": 0},
    {"peak_um": -1},
    {"columns": 3},
    {"on": "no-such-surface"},
    {"no_such_option": 1},
    {"losses": "uniform", "set": {"decay_time_ms": None, "loss_factor": 0.01}},
]


@pytest.fixture
def fresh(film: ur.Surface) -> ur.Surface:
    """The film, whose responses are not there yet."""
    return ur.Surface(film.toml)


def _refused(call: Callable[..., object]) -> None:
    """Hold a call to be refused before its first stage."""
    stages: list[str] = []
    with pytest.raises(ur.UnrippleError):
        call(progress=lambda stage, share: stages.append(stage))
    assert stages == []


@pytest.mark.parametrize("options", _FOCUS, ids=lambda options: ", ".join(options))
def test_a_focus(fresh: ur.Surface, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.focus([(62, 90)], **options, progress=progress))


@pytest.mark.parametrize("targets", [[_BEYOND], [(62, 90, 0)], [(62, 90, 1, -5)], [], ["circle:300,90,5"]])
def test_targets(fresh: ur.Surface, targets: Any) -> None:
    _refused(lambda progress: fresh.focus(targets, progress=progress))
    _refused(lambda progress: fresh.compare(targets, progress=progress))


@pytest.mark.parametrize(
    "options",
    [
        {"count": 0},
        {"keep": "a9"},
        {"keep": "a1", "keep_all": True},
        {"like": "a9"},
        {"rim_mm": (12, 6)},
        {"within": [(0, 0), (150, 0)]},
        {"keep_out_m": [(0, 0), (0.15, 0)]},
        {"grid_mm": 0},
        {"apart_mm": -1},
        {"at": [_BEYOND]},
        {"at": [(62, 90, 0)]},
        {"screen": [(200, 0), (300, 0), (300, 100)]},
        {"targets": 0},
        {"objective": "best"},
        {"share_percent": 200},
        {"mounting_mm": -1},
        {"tension_percent": 60},
        {"window_ms": -1},
        {"window_ms": 0.03},
        {"columns": 3},
        {"no_such_option": 1},
    ],
    ids=lambda options: ", ".join(options),
)
def test_places(fresh: ur.Surface, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.place(**options, progress=progress))


@pytest.mark.parametrize(
    "options",
    [
        {"count": 0},
        {"keep": [_BEYOND]},
        {"rim_mm": (12, 6)},
        {"within": [(0, 0), (150, 0)]},
        {"grid_mm": 0},
        {"apart_mm": -1},
        {"place": [_BEYOND]},
        {"snr_db": 1000},
        {"profile": 9},
        {"sensing": "echoes"},
        {"columns": 3},
        {"no_such_option": 1},
    ],
    ids=lambda options: ", ".join(options),
)
def test_sensors(fresh: ur.Surface, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.sensors(**options, progress=progress))


@pytest.mark.parametrize("options", [{"window_ms": -1}, {"window_ms": 0.03}, {"judge_hz": 1}])
def test_a_comparison(fresh: ur.Surface, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.compare([(62, 90)], **options, progress=progress))


@pytest.mark.parametrize(
    ("waveforms", "options"),
    [
        ([(*_BEYOND, "burst:100,3")], {}),
        ([(62, 90, "burst:100,-3")], {}),
        ([(62, 90, "burst:100,3")], {"silent_mm": [_BEYOND]}),
        ([(62, 90, "burst:100,3")], {"window_ms": -1}),
        ([(62, 90, "burst:100,3")], {"judge_hz": 1}),
    ],
)
def test_waveforms(fresh: ur.Surface, waveforms: Any, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.waveform(waveforms, **options, progress=progress))


@pytest.mark.parametrize(
    ("path", "options"),
    [
        ([(50, 75), _BEYOND], {}),
        ([(50, 75), (60, 75)], {"speed_mm_s": 1e9}),
        ([(50, 75), (60, 75)], {"window_ms": -1}),
        ([(50, 75), (60, 75)], {"judge_hz": 1}),
    ],
)
def test_a_stroke(fresh: ur.Surface, path: Any, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.stroke(path, **{"speed_mm_s": 100, **options}, progress=progress))


@pytest.mark.parametrize(
    "options",
    [
        {"at": [_BEYOND]},
        {"at": [(62, 90)], "at_ms": [1, 2]},
        {"at_ms": [1, 2, 3]},
        {"period_ms": -1},
        {"judge_hz": 1},
        {"fingers_mm": [_BEYOND]},
        {"frames": 10**6},
        {"columns": 3},
    ],
    ids=lambda options: ", ".join(options),
)
def test_a_field(fresh: ur.Surface, drive: ur.Drive, options: dict[str, Any]) -> None:
    _refused(lambda progress: fresh.field(drive, **options, progress=progress))


def test_a_drive_of_another_surface(fresh: ur.Surface) -> None:
    samples = np.ones((8, 100))
    for drive in (
        ur.Drive(samples, rate_hz=48000, names=[f"b{i}" for i in range(8)]),
        ur.Drive(samples, rate_hz=8000, names=fresh.names),
    ):
        _refused(lambda progress, drive=drive: fresh.field(drive, progress=progress))


def test_a_folder_for_responses_that_no_task_makes_again(film: ur.Surface, drive: ur.Drive, folder: Path) -> None:
    points = [(40, 50), (62, 90)]
    own = ur.Responses.from_numpy(
        film.responses().impulse(points, length_ms=60),
        rate_hz=film.rate_hz,
        points_mm=points,
        actuators_mm=1e3 * film.actuators_m,
        names=film.names,
        surface=film,
    )
    under = film.responses(fingers_mm=[(40, 50)])
    for responses in (own, under):
        _refused(lambda progress, of=responses: of.field(drive, output="out", at=[(40, 50)], progress=progress))
        _refused(lambda progress, of=responses: of.focus([(40, 50)], output="out", progress=progress))
    assert list(folder.iterdir()) == []


def test_a_folder_of_something_else(fresh: ur.Surface, drive: ur.Drive, folder: Path) -> None:
    taken = folder / "taken"
    taken.mkdir()
    (taken / "notes").write_text("mine", encoding="utf-8")
    _refused(lambda progress: fresh.field(drive, output="taken", progress=progress))
    _refused(lambda progress: fresh.focus([(62, 90)], output="taken", progress=progress))
    assert [file.name for file in folder.iterdir()] == ["taken"]


def test_what_is_written_is_what_is_returned(fresh: ur.Surface, drive: ur.Drive, folder: Path) -> None:
    field = fresh.field(drive, output="out", no_figures=True)
    written = (folder / "out" / "report.json").read_text(encoding="utf-8")
    assert field.report.to_json() == written
