"""Types of arguments, and the options of every command, in the command line's names and units, and in SI units."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypeAlias, TypedDict

import numpy as np
import numpy.typing as npt

from unripple._drive import Drive
from unripple._progress import ProgressCallback
from unripple._surface import Surface

#: Path of a file or folder.
Path: TypeAlias = str | os.PathLike[str]
#: A surface, the name of a built-in one, the path of a file, or the text of one.
SurfaceLike: TypeAlias = Surface | Path
#: Numbers in a row, such as x and y.
Row: TypeAlias = Sequence[float] | npt.NDArray[np.floating[Any]] | npt.NDArray[np.integer[Any]] | str
#: Places, or one alone.
Places: TypeAlias = Row | Sequence[Row]
#: A polygon: its corners, or a text of all these.
Polygon: TypeAlias = Sequence[Row] | npt.NDArray[np.floating[Any]] | npt.NDArray[np.integer[Any]] | str
#: Polygons, or one alone.
Polygons: TypeAlias = Polygon | Sequence[Polygon]
#: A polygon with its weight, in mm as a pair or a text, in m as a mapping.
Important: TypeAlias = tuple[Polygon, float] | Mapping[str, Any] | str
#: Points to be in focus, `(x, y[, gain[, hz]])` in mm and Hz, or mappings; or one alone.
Points: TypeAlias = Row | Mapping[str, Any] | Sequence[Row | Mapping[str, Any]]
#: A shape: a text as the command line has it, an SVG file, or a mapping.
Shape: TypeAlias = Path | Mapping[str, Any]
#: Shapes, or one alone.
Shapes: TypeAlias = Shape | Sequence[Shape]
#: Points and shapes, or one alone.
Targets: TypeAlias = Row | Shape | Sequence[Row | Shape]
#: A target with its waveform.
Waveform: TypeAlias = str | Sequence[Any] | Mapping[str, Any]
#: Targets with their waveforms, or one alone.
Waveforms: TypeAlias = Waveform | Sequence[Waveform]
#: The path of a moving focus.
StrokePath: TypeAlias = Shape | Sequence[Row] | npt.NDArray[np.floating[Any]]
#: A drive, or the path of a WAV file.
DriveLike: TypeAlias = Drive | Path
#: Keys of a surface file and their values, or texts KEY=VALUE.
Keys: TypeAlias = Mapping[str, Any] | Sequence[str] | str
#: Times, or one alone.
Times: TypeAlias = float | Sequence[float] | npt.NDArray[np.floating[Any]]

Method: TypeAlias = Literal["time-reversal", "one-bit", "inverse", "concentrate", "limited", "robust", "felt"]
Between: TypeAlias = Literal["nearest", "linear", "kernel"]
Objective: TypeAlias = Literal["mean", "worst", "quantile"]
Figure: TypeAlias = Literal["contrast", "felt-contrast", "felt-level", "energy-for-peak"]
Sensing: TypeAlias = Literal["sweeps", "taps"]
Losses: TypeAlias = Literal["none", "uniform", "per-mode"]
Device: TypeAlias = Literal["virtual", "jack", "card", "tape"]


class CallOptions(TypedDict, total=False):
    """Options of every call."""

    progress: bool | ProgressCallback | None
    threads: int | None


class SurfaceOptions(CallOptions, total=False):
    """Options of every command that reads a surface file."""

    set: Keys | None


class ModesOptions(SurfaceOptions, total=False):
    """Options of `modes`."""

    max_hz: float | None
    top_hz: float | None
    accuracy: float | None


class RespondOptions(SurfaceOptions, total=False):
    """Options of `respond`."""

    grid_mm: float | None
    pitch_m: float | None
    length_ms: float | None
    length_s: float | None


class FigureOptions(TypedDict, total=False):
    """Options of what is written."""

    no_figures: bool | None
    columns: Literal[1, 2] | None
    output: Path | None


class AreaOptions(TypedDict, total=False):
    """Options of where things may be placed, and of the search for places."""

    count: int | None
    rim_mm: Row | None
    rim_m: Row | None
    within: Polygons | None
    within_mm: Polygons | None
    within_m: Polygons | None
    keep_out: Polygons | None
    keep_out_mm: Polygons | None
    keep_out_m: Polygons | None
    place: Places | None
    places_mm: Places | None
    places_m: Places | None
    grid_mm: float | None
    pitch_m: float | None
    apart_mm: float | None
    apart_m: float | None
    restarts: int | None
    seed: int | None
    up_to: int | None


class PlaceOptions(SurfaceOptions, AreaOptions, FigureOptions, total=False):
    """Options of `place`."""

    keep: str | Sequence[str] | None
    keep_all: bool | None
    like: str | None
    at: Places | None
    points_mm: Places | None
    points_m: Places | None
    weights: Sequence[float] | npt.NDArray[np.floating[Any]] | None
    screen: Polygons | None
    targets_within_mm: Polygons | None
    targets_within_m: Polygons | None
    importance: Path | None
    important: Important | Sequence[Important] | None
    targets: int | None
    objective: Objective | None
    share_percent: float | None
    share: float | None
    mounting_mm: float | None
    mounting_m: float | None
    tension_percent: float | None
    tension: float | None
    window_ms: float | None
    window_s: float | None
    method: Method | Sequence[Method] | None
    methods: Sequence[Method] | None
    by: Figure | None
    evaluations: int | None


class SensorsOptions(SurfaceOptions, AreaOptions, FigureOptions, total=False):
    """Options of `sensors`."""

    taps: bool | None
    sensing: Sensing | None
    keep: Places | None
    keep_mm: Places | None
    keep_m: Places | None
    snr_db: float | None
    profile: int | None


class TargetOptions(TypedDict, total=False):
    """Options that say where to focus, and how strongly."""

    at: Points | None
    points: Points | None
    shape: Shapes | None
    shapes: Shapes | None
    peak_um: float | None
    peak_m: float | None
    felt_db: float | None
    full_limit: bool | None
    level: str | Mapping[str, float] | None


class JudgedOptions(SurfaceOptions, FigureOptions, total=False):
    """Options of how drives are evaluated, and of their window."""

    window_ms: float | None
    window_s: float | None
    judge_hz: float | None


class FocusOptions(TargetOptions, JudgedOptions, total=False):
    """Options of `focus`."""

    on: SurfaceLike | None
    listen_m: float | None
    method: Method | None
    between: Between | None
    losses: Losses | None
    strength: float | None
    push: float | None
    total_rms: float | None
    worst: float | None
    economy: float | None
    rest: bool | None
    finger_aware: bool | None
    spread_percent: float | None
    spread: float | None
    duration_ms: float | None
    duration_s: float | None
    finger: Places | None
    fingers_mm: Places | None
    fingers_m: Places | None
    bear_finger: Places | None
    bear_fingers_mm: Places | None
    bear_fingers_m: Places | None
    bear_tension_percent: float | None
    bear_tension: float | None


class WaveformOptions(JudgedOptions, total=False):
    """Options of `focus` with waveforms."""

    on: SurfaceLike | None
    silent: Places | None
    silent_mm: Places | None
    silent_m: Places | None


class StrokeOptions(JudgedOptions, total=False):
    """Options of `focus` along a path."""

    on: SurfaceLike | None
    speed_mm_s: float | None
    speed_m_s: float | None
    level_mm_s: float | None
    level_m_s: float | None


class CompareOptions(TargetOptions, JudgedOptions, total=False):
    """Options of `compare`."""

    listen_m: float | None
    method: Method | Sequence[Method] | None
    methods: Sequence[Method] | None
    vary: str | Mapping[str, Sequence[Any]] | None
    others: Sequence[SurfaceLike] | None
    labels: Sequence[str] | None
    no_tradeoffs: bool | None


class FieldOptions(SurfaceOptions, FigureOptions, total=False):
    """Options of `field`."""

    at: Places | None
    points_mm: Places | None
    points_m: Places | None
    at_ms: Times | None
    instants_s: Times | None
    finger: Places | None
    fingers_mm: Places | None
    fingers_m: Places | None
    period_ms: float | None
    period_s: float | None
    judge_hz: float | None
    listen_m: float | None
    movie_ms: Row | None
    movie_s: Row | None
    frames: int | None
    between: Between | None


class DeviceOptions(SurfaceOptions, total=False):
    """Options of a device, and of the kinds of devices."""

    device: Device | Mapping[str, Any] | None
    jack_client: str | None
    jack_server: str | None
    freewheel: bool | None
    card: str | None
    capture_card: str | None
    card_block: int | None
    tape: Path | None
    tape_inputs: str | Sequence[str] | None
    output_scale: float | None
    unknowns: int | None
    snr_db: float | None


class CalibrateOptions(DeviceOptions, total=False):
    """Options of `calibrate`."""

    grid_mm: float | None
    pitch_m: float | None
    at: Places | None
    points_mm: Places | None
    points_m: Places | None
    by: Literal["probe", "tap", "hammer"] | None
    table: Path | None
    repeats: int | None
    sweep_ms: float | None
    sweep_s: float | None
    response_ms: float | None
    response_s: float | None
    level: float | None
    wire: Mapping[str, str] | Sequence[str] | str | None
    wires: Sequence[Sequence[str]] | None
    input_scale: float | Mapping[str, float] | Sequence[str] | str | None
    input_scales: Mapping[str, Any] | None
    without: str | Sequence[str] | None
    probe_delay_ms: float | None
    probe_delay_s: float | None
    no_model: bool | None
    resample: bool | None
    check_levels: bool | None
    any_wiring: bool | None
    figure: Path | None


class FitOptions(CallOptions, total=False):
    """Options of `fit`."""

    grid_mm: float | None
    pitch_m: float | None
    at: Places | None
    points_mm: Places | None
    points_m: Places | None
    strays: int | None
    profile: int | None
    even_if_doubtful: bool | None
    accuracy: float | None


class DriftOptions(DeviceOptions, total=False):
    """Options of `drift`."""

    seconds: float | None
    within_percent: float | None
    range: float | None
    changed_percent: float | None
    changed: float | None
    changing_percent_per_min: float | None
    changing_per_min: float | None


class DoctorOptions(DeviceOptions, total=False):
    """Options of `doctor`."""

    tuio: int | bool | None
    listen: str | None


class PlayOptions(DeviceOptions, total=False):
    """Options of `play`."""

    effect: Path | None
    touch: Mapping[str, Any] | None
    fingers: int | None
    seed: int | None
    tuio: int | bool | None
    websocket: int | bool | None
    listen: str | None
    screen: Path | Sequence[Path] | None
    session: Path | None
    record: Path | None
    method: Method | None
    window_ms: float | None
    window_s: float | None
    block: int | None
    seconds: float | None
    full_limit: bool | None
    follow_tension: bool | None
    real_time: bool | None
    drift_percent: float | None
    drift: float | None
    keep_drive: Path | None


class ReproduceOptions(CallOptions, total=False):
    """Options of `reproduce`."""

    placements: int | None


class ViewOptions(DeviceOptions, total=False):
    """Options of `view`."""

    method: Method | None
    follow_tension: bool | None
    port: int | None
    listen: str | None
    token: str | None
    framed_by: str | Sequence[str] | None
    folder: Path | None
    seconds: float | None
