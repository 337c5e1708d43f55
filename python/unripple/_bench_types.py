"""Options of the command that compares a bench with its prediction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from unripple._types import Between, DeviceOptions, Places, Row


class VerifyOptions(DeviceOptions, total=False):
    """Options of `verify`."""

    at: Row | None
    target_m: Row | None
    at_ms: float | None
    instant_s: float | None
    probe_mm: Places | None
    probes_m: Places | None
    probes: int | None
    probe_count: int | None
    level: float | None
    probe_scale: float | None
    judge_hz: float | None
    clipped: float | None
    wire: Mapping[str, str] | Sequence[str] | str | None
    wires: Sequence[Sequence[str]] | None
    between: Between | None
    dry_run: bool | None
    changed_percent: float | None
    changed: float | None
    swapped: Mapping[str, str] | Sequence[str] | str | None
