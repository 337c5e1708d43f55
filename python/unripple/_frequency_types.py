"""Options of the commands on natural frequencies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from unripple._types import CallOptions, FigureOptions, Row, SurfaceOptions

#: Natural frequencies in Hz, pairs of them with decay times in ms, texts as the command line has them, or mappings; or one alone.
Frequencies: TypeAlias = (
    float | str | Sequence[float | str | Row | Mapping[str, Any]] | npt.NDArray[np.floating[Any]]
)


class FitModesOptions(SurfaceOptions, FigureOptions, total=False):
    """Options of `fit_modes`."""

    free: str | Sequence[str] | None
    error_percent: float | None
    error: float | None
    sides_known: bool | None


class ListenOptions(CallOptions, FigureOptions, total=False):
    """Options of `listen`."""

    channel: int | None
    band_hz: Row | None
    mains_hz: float | None
    hit: int | None
    most: int | None
    least_db: float | None
