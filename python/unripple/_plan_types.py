"""Options of the commands that compute the designs of a plan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from unripple._types import CallOptions

if TYPE_CHECKING:
    import distributed


class PlanOptions(CallOptions, total=False):
    """Options of every command that reads a plan."""

    no_figures: bool | None
    columns: Literal[1, 2] | None
    client: distributed.Client | None
    shared: bool | None


class SweepOptions(PlanOptions, total=False):
    """Options of `sweep`."""

    shard: int | None
    count: bool | None


class OptimiseOptions(PlanOptions, total=False):
    """Options of `optimise`."""

    jobs: int | None
    no_ask: bool | None
    stop_after: int | None
    stop_percent: float | None
    stop_share: float | None
