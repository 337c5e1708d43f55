"""Labelled arrays: dimensions, coordinates and units, equal to the plain arrays that they hold."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import unripple as ur


def _labelled(array: xr.DataArray, units: str) -> None:
    """Hold an array to what every labelled array has."""
    assert array.attrs["units"] == units
    for name in array.coords:
        if name in ("x", "y"):
            assert array.coords[name].attrs["units"] == "m"
        if name == "time":
            assert array.coords[name].attrs["units"] == "s"


def test_a_drive_is_labelled(drive: ur.Drive) -> None:
    array = drive.to_xarray()
    assert array.dims == ("actuator", "time")
    _labelled(array, "N")
    assert list(array.actuator.values) == drive.names
    assert np.shares_memory(array.values, drive.samples)
    assert array.time.values[1] == pytest.approx(1 / drive.rate_hz)
    assert np.array_equal(array.sel(actuator="a3").values, drive.samples[2])


def test_a_field_is_labelled(field: ur.Field, drive: ur.Drive) -> None:
    for array, units in ((field.velocity, "m/s"), (field.displacement, "m")):
        assert array.dims == ("time", "y", "x")
        _labelled(array, units)
    assert field.grid is not None and drive.focal_time is not None
    columns, rows, width, height = field.grid
    assert field.velocity.shape[1:] == (rows, columns)
    assert field.velocity.x.values[0] == pytest.approx(width / 2)
    assert field.velocity.y.values[-1] == pytest.approx((rows - 0.5) * height)


def test_the_focus_is_where_and_when_it_was_asked_for(field: ur.Field, drive: ur.Drive) -> None:
    assert drive.focal_time is not None
    snapshot = field.velocity.sel(time=drive.focal_time, method="nearest")
    near = abs(snapshot.sel(x=0.04, y=0.05, method="nearest"))
    # The grid is far finer than the spot; the report measures at the very place.
    peak = abs(field.report.targets[0].peak_velocity_m_s)
    assert float(near) == pytest.approx(peak, rel=0.1)


def test_labels_hold_what_plain_arrays_hold(field: ur.Field) -> None:
    assert field.grid is not None
    columns, rows, width, height = field.grid
    instants = field.velocity.time.values[[0, 10, 20]]
    plain = field.snapshots(instants)
    labelled = field.velocity_at(instants)
    column = np.round(field.points_m[:, 0] / width - 0.5).astype(int)
    row = np.round(field.points_m[:, 1] / height - 0.5).astype(int)
    assert np.array_equal(labelled.values[:, row, column], plain.velocity)
    maps = field.maps()
    assert np.array_equal(maps.peak_velocity.values[row, column], field.peak_velocity)
    assert maps.peak_displacement.attrs["units"] == "m" and maps.felt.attrs["units"] == "dB"


def test_a_round_sheet_has_nothing_outside() -> None:
    drum = ur.Surface("hudin-2012", rectangle_mm=None, circle_mm=60, band_hz=[0, 400], actuators=[(30, 60), (70, 20)])
    field = drum.field(drum.focus([(60, 60)], window_ms=20, judge_hz=400), judge_hz=400)
    corner = field.maps().peak_velocity.isel(x=0, y=0)
    assert np.isnan(float(corner))
    assert not np.isnan(field.peak_velocity).any()


def test_traces_are_labelled(field: ur.Field) -> None:
    traces = field.traces([(40, 50), (100, 90)], until_ms=40)
    assert traces.velocity.shape == traces.displacement.shape == (2, len(traces.times_s))
    assert traces.times_s[-1] == pytest.approx(0.04)
    data = traces.to_xarray()
    assert data.velocity.dims == ("point", "time")
    _labelled(data.velocity, "m/s")
    _labelled(data.displacement, "m")
    assert np.array_equal(data.x.values, [0.04, 0.1])


def test_responses_are_labelled(film: ur.Surface, library: Path) -> None:
    modal = film.responses().to_xarray()
    assert modal["input"].dims == ("actuator", "mode")
    assert modal["frequency"].attrs["units"] == "Hz" and modal["decay_time"].attrs["units"] == "s"
    stored = ur.open(library)
    assert stored.array is not None and stored.points_m is not None
    data = stored.to_xarray()
    assert data.h.dims == ("point", "actuator", "time")
    assert np.shares_memory(data.h.values, stored.array)
    assert np.array_equal(data.x.values, stored.points_m[:, 0])


def test_a_library_is_evaluated_at_its_points(library: Path) -> None:
    stored = ur.open(library)
    field = stored.field(stored.focus([(60, 90)], window_ms=15, no_figures=True))
    assert field.grid is None
    assert field.velocity.dims == ("time", "point")
    assert field.velocity.shape[1] == len(field.points_m)


def test_what_has_no_scale_has_no_unit(film: ur.Surface) -> None:
    points = [(40, 50), (62, 90), (100, 110)]
    known = {
        "rate_hz": film.rate_hz,
        "points_mm": points,
        "actuators_mm": 1e3 * film.actuators_m,
        "names": film.names,
        "surface": film,
    }
    h = film.responses().impulse(points, length_ms=60)
    for scaled, units in ((False, ["arbitrary unit"] * 2), (True, ["m/s", "m"])):
        responses = ur.Responses.from_numpy(h, **known, scaled=scaled)
        field = responses.field(responses.focus([(62, 90)], window_ms=25))
        assert field.scaled is scaled
        maps, traces = field.maps(), field.traces(points[:2])
        for velocity, displacement in (
            (field.velocity, field.displacement),
            (field.velocity_at(0.01), field.displacement_at(0.01)),
            (maps.peak_velocity, maps.peak_displacement),
            (traces.to_xarray().velocity, traces.to_xarray().displacement),
        ):
            assert [velocity.attrs["units"], displacement.attrs["units"]] == units
        # With a prefix, where there is one to have.
        label = field.plot().figure.axes[-1].get_ylabel()
        assert ("arbitrary unit" in label) is not scaled and ("m/s" in label) is scaled
        assert isinstance(traces, ur.Traces) and len(traces) == 4


def test_labelled_arrays_are_nobody_elses(field: ur.Field) -> None:
    first = field.velocity
    assert np.shares_memory(first.values, field.velocity.values)
    first.attrs["units"] = "km/h"
    first.values.shape = (-1,)
    assert field.velocity.attrs["units"] == "m/s" and field.velocity.dims == ("time", "y", "x")
    assert field.velocity.values.ndim == 3
    with pytest.raises(ValueError):
        field.velocity.values[0, 0, 0] = 1.0


def test_a_library_opens_without_us(library: Path) -> None:
    opened = xr.open_zarr(library, consolidated=False, chunks=None)
    stored = ur.open(library)
    assert stored.array is not None
    assert opened.responses.dims == ("point", "actuator", "sample")
    assert np.array_equal(opened.responses.values, stored.array)
