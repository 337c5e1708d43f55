"""Options of the commands that exchange responses with other programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

from unripple._types import CallOptions, Path, Row, SurfaceOptions


class ImportOptions(SurfaceOptions, total=False):
    """Options of `import`."""

    kind: Literal["frequency-responses", "impulse-responses", "filters"] | None
    quantity: Literal["velocity", "displacement", "acceleration"] | None
    unit: str | None
    per: Literal["newton", "volt", "ampere"] | None
    drive_per_reference: float | None
    band_hz: Row | None
    table: Path | None
    pattern: str | None
    length_unit: str | None
    offset_mm: Row | None
    offset_m: Row | None
    actuator: Mapping[str, str] | Sequence[str] | None
    actuator_names: Sequence[Sequence[str]] | None
    without: Sequence[str] | str | None
    length_ms: float | None
    length_s: float | None


class ExportOptions(CallOptions, total=False):
    """Options of `export`."""

    format: Literal["wav", "sofa", "uff", "uff-modes", "mat"] | None
    author: str | None
    organization: str | None
    license: str | None
