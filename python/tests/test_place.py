"""Places of actuators: forms of polygons and weights, errors in the names that were typed, and the surface that is written."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple._call import Call

_CORNERS = [(10, 20), (30.3, 20), (30, 40)]
_CORNERS_M = [[0.01, 0.02], [30.3 / 1e3, 0.02], [0.03, 0.04]]
_OTHER = [(50, 60), (70, 60), (70, 80)]
_OTHER_M = [[0.05, 0.06], [0.07, 0.06], [0.07, 0.08]]

#: What takes no time on the film.
_SMALL: dict[str, Any] = {"count": 2, "rim_mm": (6, 12), "at": [(62, 90), (40, 50)], "window_ms": 20, "restarts": 1}


def _asked(**options: Any) -> dict[str, Any]:
    return Call("place", options).ask


@pytest.mark.parametrize("option", ["within", "within_mm"])
@pytest.mark.parametrize(
    "value",
    [
        _CORNERS,
        [_CORNERS],
        np.array(_CORNERS),
        np.array([_CORNERS]),
        [np.array(_CORNERS)],
        "10,20,30.3,20,30,40",
        ["10, 20, 30.3, 20, 30, 40"],
    ],
    ids=lambda value: type(value).__name__,
)
def test_one_polygon(option: str, value: Any) -> None:
    assert _asked(**{option: value})["within_m"] == [_CORNERS_M]


@pytest.mark.parametrize(
    "value",
    [
        [_CORNERS, _OTHER],
        (np.array(_CORNERS), _OTHER),
        np.array([_CORNERS, _OTHER]),
        ["10,20,30.3,20,30,40", "50,60,70,60,70,80"],
        ["10,20,30.3,20,30,40", _OTHER],
    ],
    ids=lambda value: type(value).__name__,
)
def test_several_polygons(value: Any) -> None:
    assert _asked(keep_out=value, screen=value) == {
        "keep_out_m": [_CORNERS_M, _OTHER_M],
        "targets_within_m": [_CORNERS_M, _OTHER_M],
    }


def test_polygons_in_metres() -> None:
    for value in (_CORNERS_M, [_CORNERS_M], np.array(_CORNERS_M)):
        assert _asked(within_m=value) == {"within_m": [_CORNERS_M]}
    assert _asked(targets_within_m=[_CORNERS_M, np.array(_OTHER_M)])["targets_within_m"] == [_CORNERS_M, _OTHER_M]


def test_any_iterable_is_a_list() -> None:
    assert _asked(within=zip([10, 30.3, 30], [20, 20, 40], strict=True)) == {"within_m": [_CORNERS_M]}
    assert _asked(within=(corners for corners in (_CORNERS, _OTHER))) == {"within_m": [_CORNERS_M, _OTHER_M]}
    assert _asked(within=[], at=[]) == {"within_m": [], "points_m": []}


@pytest.mark.parametrize(
    ("value", "points_m", "weights"),
    [
        ((62, 90), [[0.062, 0.09]], None),
        ("62,90", [[0.062, 0.09]], None),
        ((62, 90, 2), [[0.062, 0.09]], [2]),
        ([(62, 90), (40, 50, 0.5)], [[0.062, 0.09], [0.04, 0.05]], [1, 0.5]),
        (["62,90,3", (40, 50)], [[0.062, 0.09], [0.04, 0.05]], [3, 1]),
        (np.array([[62, 90], [40, 50]]), [[0.062, 0.09], [0.04, 0.05]], None),
        (np.array([[62, 90, 2], [40, 50, 1]]), [[0.062, 0.09], [0.04, 0.05]], [2, 1]),
    ],
)
def test_weights(value: Any, points_m: list[list[float]], weights: list[float] | None) -> None:
    wanted: dict[str, Any] = {"points_m": points_m} | ({} if weights is None else {"weights": weights})
    assert _asked(at=value) == _asked(points_mm=value) == wanted


@pytest.mark.parametrize(
    "value",
    [
        (_CORNERS, 3),
        [(_CORNERS, 3)],
        [(np.array(_CORNERS), np.float64(3))],
        "10,20,30.3,20,30,40:3",
        ["10,20,30.3,20,30,40:3"],
        [{"area_m": _CORNERS_M, "weight": 3}],
    ],
    ids=lambda value: type(value).__name__,
)
def test_areas_with_weights(value: Any) -> None:
    assert _asked(important=value) == {"important": [{"area_m": _CORNERS_M, "weight": 3}]}


def test_a_figure_of_a_method_is_named_as_on_the_command_line() -> None:
    wanted = {"methods": ["inverse"], "by": "felt-contrast", "evaluations": 9}
    assert _asked(method="inverse", by="felt-contrast", evaluations=9) == wanted
    assert _asked(methods=["inverse"], by="felt_contrast", evaluations=9) == wanted


def test_options_in_si_units_are_the_same() -> None:
    wanted = {"rim_m": [0.006, 0.012], "places_m": [[0.01, 0.02]], "pitch_m": 0.002, "share": 0.3, "tension": 0.01}
    assert _asked(rim_mm="6,12", place=(10, 20), grid_mm=2, share_percent=30, tension_percent=1) == wanted
    assert _asked(rim_m=(0.006, 0.012), places_m=(0.01, 0.02), pitch_m=0.002, share=0.3, tension=0.01) == wanted
    assert _asked(at=[(62, 90)], weights=np.array([2.0])) == {"points_m": [[0.062, 0.09]], "weights": [2.0]}


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"within": _CORNERS[:2]}, "within: expected at least three corners X,Y in mm, found 2 corners"),
        ({"screen": "1,2,3,4"}, "screen: expected at least three corners X,Y in mm, found 4 numbers"),
        ({"keep_out": "1,2,3,4,5,6,7"}, "keep_out: expected pairs X,Y in mm, found 7 numbers"),
        ({"keep_out": [(1, 2), (3, 4), (5, 6, 7)]}, "keep_out: expected X,Y in mm, found 3 numbers"),
        ({"within": 3}, "within: expected a list, found 3"),
        ({"within": "1,2,3,4,5,x"}, "within: expected at least three corners X,Y in mm, found 'x'"),
        ({"important": "1,2,3,4,5,6"}, "important: expected a polygon in mm and its weight, found '1,2,3,4,5,6'"),
        ({"important": [(_CORNERS[:2], 1)]}, "important: expected at least three corners X,Y in mm, found 2 corners"),
        ({"at": (1, 2, 3, 4)}, "at: expected X,Y[,WEIGHT] in mm, found 4 numbers"),
        ({"rim_mm": (6, 9, 12)}, "rim_mm: expected LEAST,MOST in mm, found 3 numbers"),
        ({"targets": [(62, 90)]}, "targets: expected a whole number, found [(62, 90)]"),
        ({"keep": "a1", "keep_all": True}, "place: expected one of keep and keep_all, found both"),
        ({"at": (1, 2, 3), "weights": [3]}, "place: expected one of at and weights, found both"),
        ({"screen": _CORNERS, "targets_within_m": _CORNERS_M}, "place: expected one of screen and targets_within_m, found both"),
        ({"keepout": _CORNERS}, "place: expected an option that it has, found keepout (nearest: keep_out)"),
    ],
)
def test_what_cannot_be_read(options: dict[str, Any], said: str) -> None:
    with pytest.raises(ur.UnrippleError, match=f"^{re.escape(said)}$"):
        _asked(**options)


def test_names_stay_or_all_do() -> None:
    assert _asked(keep=np.array(["a1", "a2"]), keep_all=False) == {"keep": ["a1", "a2"], "keep_all": False}


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"count": 0}, "count"),
        ({"keep": "a9"}, "keep"),
        ({"like": "a9"}, "like"),
        ({"rim_mm": (12, 6)}, "rim_mm"),
        ({"rim_mm": None, "rim_m": (0.012, 0.006)}, "rim_m"),
        ({"within_m": _CORNERS_M[:2]}, "within_m"),
        ({"grid_mm": 0}, "grid_mm"),
        ({"apart_mm": -1}, "apart_mm"),
        ({"at": (300, 90)}, "at"),
        ({"at": (62, 90, -2)}, "at"),
        ({"at": [(62, 90), (40, 50)], "weights": [2]}, "weights"),
        ({"at": None, "screen": [(200, 0), (300, 0), (300, 100)]}, "at, screen"),
        ({"share_percent": 200}, "share_percent"),
        ({"mounting_mm": -1}, "mounting_mm"),
        ({"tension_percent": 60}, "tension_percent"),
        ({"window_ms": -1}, "window_ms"),
        ({"place": [(10, 20)]}, "place, grid_mm, rim_mm, within, keep_out"),
    ],
)
def test_errors_name_what_was_typed(film: ur.Surface, options: dict[str, Any], field: str) -> None:
    with pytest.raises(ur.AskError) as raised:
        film.place(**{**_SMALL, **options})
    assert raised.value.field == field


def test_texts_of_errors_name_what_was_typed(film: ur.Surface) -> None:
    with pytest.raises(ur.AskError, match=r"^mounting_mm: .*, found -1 \(-1 mm\)$"):
        film.place(**_SMALL, mounting_mm=-1)
    with pytest.raises(ur.AskError, match="^weights: expected 2, one for each of `at`, found 1$"):
        film.place(**_SMALL, weights=[2])


def test_the_surface_is_written_with_the_actuators_in_their_places(film: ur.Surface) -> None:
    report = film.place(**_SMALL, keep="a4", up_to=4, output="placed", no_figures=True)
    placed = ur.Surface("placed/surface.toml")
    assert placed.names == [actuator.name for actuator in report.after.actuators] and len(placed.names) == 3
    assert placed.actuators_m == pytest.approx(np.array([actuator.at_m for actuator in report.after.actuators]))
    assert report.kept == ["a4"]
    rim = np.minimum(placed.actuators_m, 0.15 - placed.actuators_m).min(axis=1)[:2]
    assert (rim > 0.0059).all() and (rim < 0.0121).all()
    table = report.to_dataframe()
    assert list(table["actuators"]) == [number.actuators for number in report.each_number]
    assert list(table["mean_contrast"]) == [number.mean_contrast for number in report.each_number]


def test_the_actuators_of_a_library_to_keep(library: Path) -> None:
    report = ur.place(
        library, count=2, at=[(30, 30), (120, 120)], window_ms=20, output="chosen", no_figures=True
    )
    names = [actuator.name for actuator in report.after.actuators]
    assert Path("chosen/actuators.txt").read_text(encoding="utf-8").split() == names and len(names) == 2
    assert report.before.mean_contrast > 0 and len(report.before.actuators) == report.places
    assert report.one_more.name not in names and report.mounting == [] and report.methods == []
    with pytest.raises(ur.AskError, match="expected a surface, whose modes it needs, found .*a library") as raised:
        ur.place(library, count=2, mounting_mm=1)
    assert raised.value.field == "mounting_mm"
