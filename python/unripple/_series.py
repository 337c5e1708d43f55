"""Fields as arrays: the motion over a whole span, values on the cells of a grid, and labels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from unripple import _labels, _progress
from unripple._motion import MOST_VALUES, Snapshots, instants, span, units

if TYPE_CHECKING:
    import xarray as xr

    from unripple._field import Field


def end_s(of: Field) -> float:
    """Return the end of the span that the report evaluates, in s."""
    return span(of.report, of.known, of.rate_hz)[1] / of.rate_hz


def everything(of: Field) -> Snapshots:
    """Return the motion over the span that the report evaluates, computed when it is first asked for."""
    if of._series is None:
        times, every = _instants(of)
        if every > 1:
            _progress.warn(
                f"the field has every {every}th sample around the focal instants, since it would be larger than "
                f"{MOST_VALUES} values (velocity_at gives instants of your own)"
            )
        of._series = Snapshots(times, *of._raw.snapshots(times.tolist()))
    return of._series


def _instants(of: Field) -> tuple[npt.NDArray[Any], int]:
    """Return the instants (s) of the motion that is computed unasked, and the distance between them in samples."""
    points = len(of.points_m) if of.grid is None else of.grid[0] * of.grid[1]
    return instants(of.report, span(of.report, of.known, of.rate_hz), of.rate_hz, points)


def labelled(of: Field, quantity: str) -> xr.DataArray:
    """Return a quantity over the whole span with labels: each time another array on the same values, which nobody can write to."""
    kept = of._labelled.get(quantity)
    if kept is None:
        kept = at(of, everything(of), quantity, every=_instants(of)[1])
        kept.values.setflags(write=False)
        of._labelled[quantity] = kept
    # Whoever has one may change its labels, and the shape of its values.
    return kept.copy(data=kept.values.view())


def at(of: Field, series: Snapshots, quantity: str, **attrs: Any) -> xr.DataArray:
    """Return a quantity at some instants with labels."""
    values = series.velocity if quantity == "velocity" else series.displacement
    dims, coords = _axes(of)
    coords = {"time": series.times_s, **coords}
    attrs = {"surface": of.surface.name, **attrs}
    unit = units(of.scaled)[quantity]
    return _labels.array(cells(of, values), ("time", *dims), coords, quantity, unit, **attrs)


def maps(of: Field) -> xr.Dataset:
    """Return the maps over the surface with labels."""
    unit = units(of.scaled)
    found: dict[str, tuple[npt.NDArray[Any], str]] = {
        "peak_velocity": (of.peak_velocity, unit["velocity"]),
        "peak_displacement": (of.peak_displacement, unit["displacement"]),
        "outside": (of.outside, ""),
    }
    felt = of.felt_db
    if felt is not None:
        found["felt"] = (felt, "dB")
    dims, coords = _axes(of)
    arrays = {
        name: _labels.array(cells(of, values), dims, coords, name, own)
        for name, (values, own) in found.items()
    }
    return _labels.dataset(arrays, surface=of.surface.name)


def _axes(of: Field) -> tuple[tuple[str, ...], Mapping[str, Any]]:
    """Return the dimensions of a map, and its coordinates in m."""
    if of.grid is not None:
        return ("y", "x"), _labels.centres(of.grid)
    points = of.points_m
    return ("point",), {"x": ("point", points[:, 0]), "y": ("point", points[:, 1])}


def cells(of: Field, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return values of all points on the cells of the grid, NaN outside; on a library a view of them as they are."""
    inside = of._raw.inside
    return values.view() if of.grid is None or inside is None else _labels.spread(values, of.grid, inside)
