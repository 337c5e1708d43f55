"""Responses from arrays: with a surface those of a library; without one, what nobody knows is not made up."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple import _unripple as rust

#: Samples per second; places in m, a point of the library's grid and one between its points.
RATE = 12000.0
TARGET = [0.05, 0.04]
BETWEEN = [0.053, 0.041]
#: A focus, and a film of few modes.
FOCUS = {"points": [{"at_m": TARGET}], "no_figures": True}
FILM = {"name": "hudin-2012", "set": {"drive.band_hz": "[0, 800]", "drive.sample_rate_hz": "12000"}}


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A library of the film at the points of a grid of 10 mm."""
    folder = tmp_path_factory.mktemp("responses") / "library"
    ask = {"surface": FILM, "pitch_m": 0.01, "length_s": 0.05, "output": str(folder)}
    rust.run("respond", json.dumps(ask), None, None)
    return rust.Responses.open(str(folder), None)


def arguments(library: Any, **changed: Any) -> dict[str, Any]:
    """What makes responses from the arrays of a library."""
    given = {
        "h": library.array,
        "rate_hz": library.rate_hz,
        "points_m": library.points_m,
        "names": library.names,
        "actuators_m": library.actuators_m,
    }
    return given | changed


def focus(responses: Any, **changed: Any) -> Any:
    """A focus on responses, at the target unless another is named."""
    return responses.focus(json.dumps(FOCUS | changed))


def test_with_its_surface_an_array_is_a_library(library: Any) -> None:
    """To the last digit, between its points as well."""
    array = rust.Responses.from_array(**arguments(library, surface=library.surface, scaled=True))
    assert np.array_equal(array.array, library.array) and not np.shares_memory(array.array, library.array)
    assert (array.band_hz, array.lambda_min_m) == (library.band_hz, library.lambda_min_m)
    assert (array.kind, array.source, array.surface.toml) == ("sampled", "array", library.surface.toml)
    for at in [TARGET, BETWEEN]:
        points = [{"at_m": at}]
        one, other = focus(array, points=points), focus(library, points=points)
        assert np.array_equal(one.drive.samples, other.drive.samples)
        found, expected = json.loads(one.done.json), json.loads(other.done.json)
        assert "run" not in found and "run" in expected
        assert found["targets"] == expected["targets"] and found["level"] == expected["level"]
        assert found["judged_on"] == f"the {len(array.points_m)} points of the array"
    measured = json.dumps({"points_m": [TARGET], "no_figures": True})
    fields = [responses.field(measured, one.drive) for responses in (array, library)]
    assert np.array_equal(fields[0].peak_velocity, fields[1].peak_velocity)
    between = np.array([BETWEEN])
    assert np.array_equal(array.impulse(between, 0.05), library.impulse(between, 0.05))


@pytest.mark.parametrize(
    "layout",
    [lambda h: h.astype(np.float64), np.asfortranarray, lambda h: np.repeat(h, 2, axis=2)[:, :, ::2]],
)
def test_samples_of_every_layout_are_copied(library: Any, layout: Any) -> None:
    """Single precision is what is kept."""
    given = layout(library.array)
    array = rust.Responses.from_array(**arguments(library, h=given, surface=library.surface))
    assert np.array_equal(array.array, library.array) and array.array.dtype == np.float32


def test_without_a_surface_levels_and_waves_are_not_known(library: Any) -> None:
    """What follows from the sheet is left out or refused."""
    given = arguments(library, band_hz=(0.0, 800.0), lambda_min_m=library.lambda_min_m)
    array = rust.Responses.from_array(**given)
    found = json.loads(focus(array).done.json)
    target, notes = found["targets"][0], {note["topic"] for note in found["notes"]}
    assert target["peak_velocity_m_s"] is None and target["contrast"] > 1.5
    # Half of 601 samples.
    assert found["window_s"] == 300 / RATE
    assert {"level", "window"} <= notes and "linear theory" not in notes
    points = [{"at_m": BETWEEN}]
    with pytest.raises(ur.AskError) as refused:
        focus(array, points=points)
    assert refused.value.field == "between"
    near, line = (focus(array, points=points, between=way) for way in ("nearest", "linear"))
    assert not np.array_equal(near.drive.samples, line.drive.samples)
    with pytest.raises(ur.AskError, match="points_m"):
        array.impulse(np.array([BETWEEN]), 0.01)
    assert np.array_equal(array.impulse(array.points_m[:2], 0.05), array.array[:2])
    field = array.field(json.dumps({"points_m": [TARGET]}), near.drive)
    assert field.felt_db is None and field.figures == {}


def test_a_scale_gives_levels_without_a_surface(library: Any) -> None:
    """The level is that of a limit of 1."""
    given = arguments(library, band_hz=(0.0, 800.0), lambda_min_m=library.lambda_min_m, scaled=True)
    array = rust.Responses.from_array(**given)
    made, limit = focus(array), array.surface.limit
    target = json.loads(made.done.json)["targets"][0]
    assert target["peak_velocity_m_s"] is not None
    assert limit == 1.0 and made.drive.peak == pytest.approx(limit, rel=1e-6)
    # The surface that is made up has a file.
    again = rust.Surface(json.dumps({"toml": array.surface.toml}))
    assert again.names == library.names and np.array_equal(again.actuators_m, library.actuators_m)
    extent = np.concatenate([library.points_m, library.actuators_m]).max(axis=0)
    assert again.extent_m == pytest.approx(tuple(extent))


def test_the_band_ends_below_half_the_rate(library: Any) -> None:
    """Where none is given, it goes as far as samples tell."""
    array = rust.Responses.from_array(**arguments(library, lambda_min_m=0.01))
    assert array.band_hz == (0.0, 0.45 * RATE)
    for band in [(0.0, 6000.0), (500.0, 500.0), (-1.0, 100.0), (np.nan, 100.0), (0.0, np.inf)]:
        with pytest.raises(ur.AskError, match="band_hz"):
            rust.Responses.from_array(**arguments(library, lambda_min_m=0.01, band_hz=band))


@pytest.mark.parametrize("lambda_min", [None, 0.0, -1.0, np.nan, np.inf])
def test_a_wavelength_is_needed_without_a_surface(library: Any, lambda_min: float | None) -> None:
    """It is above 0 and finite."""
    with pytest.raises(ur.AskError, match="lambda_min_m"):
        rust.Responses.from_array(**arguments(library, lambda_min_m=lambda_min))


def test_arrays_that_do_not_fit_together_are_refused(library: Any) -> None:
    """Empty ones, too, and values that are not finite."""
    array, points, at = library.array, library.points_m, library.actuators_m
    wrong: list[dict[str, Any]] = [
        {"points_m": points[1:]},
        {"actuators_m": at[1:]},
        {"names": library.names[1:]},
        {"h": array[:0], "points_m": points[:0]},
        {"h": array[:, :0], "names": [], "actuators_m": at[:0]},
        {"h": array[:, :, :0]},
        {"h": array[0]},
        {"h": array.astype(np.float16)},
        {"h": np.full_like(array, np.nan)},
        # More than float32 holds.
        {"h": np.full(array.shape, 1e300)},
    ]
    for changed in wrong:
        with pytest.raises(ur.InputError):
            rust.Responses.from_array(**arguments(library, lambda_min_m=0.01, **changed))
    for rate in [0.0, -1.0, np.nan, np.inf]:
        with pytest.raises(ur.AskError, match="rate_hz"):
            rust.Responses.from_array(**arguments(library, lambda_min_m=0.01, rate_hz=rate))


def test_a_surface_must_be_that_of_the_array(library: Any) -> None:
    """By names, places and rate."""
    points, at = library.points_m, library.actuators_m
    wrong = {
        "names": library.names[::-1],
        "actuators_m": at + 1e-3,
        "rate_hz": 48000.0,
        "points_m": points + np.array([0.2, 0.0]),
    }
    for field, value in wrong.items():
        with pytest.raises(ur.AskError) as refused:
            rust.Responses.from_array(**arguments(library, surface=library.surface, **{field: value}))
        assert refused.value.field == field


def test_places_count_from_the_corner_and_names_are_unique(library: Any) -> None:
    """As in the file of a surface."""
    with pytest.raises(ur.AskError, match="lower-left corner"):
        rust.Responses.from_array(**arguments(library, lambda_min_m=0.01, points_m=library.points_m - 0.1))
    with pytest.raises(ur.SurfaceError, match="unique name"):
        rust.Responses.from_array(**arguments(library, lambda_min_m=0.01, names=["one"] * len(library.names)))


def test_the_package_converts_to_metres(library: Any) -> None:
    """The samples stay where they are."""
    responses = ur.Responses.from_numpy(
        library.array,
        rate_hz=RATE,
        points_mm=library.points_m * 1e3,
        actuators_mm=library.actuators_m * 1e3,
        band_hz=(0.0, 800.0),
        lambda_min_mm=library.lambda_min_m * 1e3,
    )
    held = np.asarray(responses)
    assert np.array_equal(held, library.array) and np.shares_memory(held, np.asarray(responses))
    drive = responses.focus([(50, 40)], between="nearest")
    assert drive.report.targets[0].contrast > 1.5
