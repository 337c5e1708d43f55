"""Surfaces: what they are made from, what they hold, and that they do not change."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import unripple as ur

_TEXT = """\
format = 1

[outline]
rectangle_mm = [120, 80]

[sheet]
material = "glass"
thickness_mm = 0.5
loss_factor = 0.01

[drive]
band_hz = [0, 9000]

[[actuator]]
at_mm = [12, 31]

[[actuator]]
at_mm = [90, 64]
"""


@pytest.fixture(scope="module")
def plate() -> ur.Surface:
    return ur.Surface(_TEXT)


@pytest.mark.parametrize("name", ur.builtin())
def test_every_built_in_surface_is_read(name: str) -> None:
    surface = ur.Surface(name)
    assert surface.name == name
    assert len(surface.names) == len(surface.units) == len(surface.actuators_m) > 0
    assert surface.actuators_m.dtype == np.float64
    assert np.all(surface.actuators_m >= 0)
    assert np.all(surface.actuators_m <= surface.extent_m)
    assert set(surface.units) <= {"N", "A", "V"}
    assert surface.band_hz[0] < surface.band_hz[1] <= surface.rate_hz / 2
    outer = surface.outline_m[0]
    assert outer.ndim == 2 and outer.shape[1] == 2
    assert np.allclose(outer.min(axis=0), 0, atol=1e-6)
    assert np.allclose(outer.max(axis=0), surface.extent_m, rtol=1e-3)


def test_text_path_and_keywords_say_the_same(plate: ur.Surface, folder: Path) -> None:
    file = folder / "plate.toml"
    file.write_text(_TEXT, encoding="utf-8")
    flat = ur.Surface(
        rectangle_mm=[120, 80],
        material="glass",
        thickness_mm=0.5,
        loss_factor=0.01,
        band_hz=[0, 9000],
        actuators=[(12, 31), (90, 64)],
    )
    tables = ur.Surface(
        outline={"rectangle_mm": (120, 80)},
        sheet={"material": "glass", "thickness_mm": 0.5, "loss_factor": 0.01},
        drive={"band_hz": np.array([0, 9000])},
        actuator=[{"at_mm": [12, 31]}, {"at_mm": [90, 64]}],
    )
    assert flat == tables
    for other in (ur.Surface(file), ur.Surface(str(file)), flat):
        # A file without a name is called as it is; all else is the same.
        assert other.with_(name="plate") == plate.with_(name="plate")
    assert ur.Surface(file).name == "plate"


def test_its_text_is_the_whole_surface(plate: ur.Surface) -> None:
    again = ur.Surface(plate.toml)
    assert again == plate and hash(again) == hash(plate)
    assert again.toml == plate.toml
    for name in ur.builtin():
        surface = ur.Surface(name)
        assert ur.Surface(surface.toml) == surface, name


def test_with_makes_another(plate: ur.Surface) -> None:
    before = plate.toml
    thicker = plate.with_(thickness_mm=0.7)
    assert thicker != plate and plate.toml == before
    assert thicker.with_(thickness_mm=0.5) == plate
    round_one = plate.with_(rectangle_mm=None, circle_mm=60)
    assert round_one.extent_m == pytest.approx((0.12, 0.12))
    moved = plate.with_(**{"actuator[0].at_mm": [20, 30]})
    assert moved.actuators_m[0] == pytest.approx([0.02, 0.03])
    fewer = plate.with_(actuators=[(12, 31)])
    assert len(fewer.names) == 1


def test_it_cannot_be_changed(plate: ur.Surface) -> None:
    with pytest.raises(AttributeError):
        plate.name = "other"  # type: ignore[misc]
    with pytest.raises(AttributeError):
        plate.colour = "red"  # type: ignore[attr-defined]
    with pytest.raises(ValueError, match="read-only"):
        plate.actuators_m[0, 0] = 1
    names = plate.names
    names.append("another")
    assert len(plate.names) == 2
    assert {plate: 1}[ur.Surface(plate.toml)] == 1
    assert (plate == "glass-plate") is False


def test_it_shows_itself(plate: ur.Surface) -> None:
    assert "120 x 80 mm" in repr(plate) and "2 actuators" in repr(plate)
    assert "<svg" in plate._repr_html_() or "<table" in plate._repr_html_()


def test_a_drawing_is_read_beside_its_file(folder: Path) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="60mm" viewBox="0 0 90 60">'
    (folder / "shape.svg").write_text(svg + '<path d="M0 0H90V60H0Z"/></svg>', encoding="utf-8")
    drawn = ur.Surface(
        svg="shape.svg", material="glass", thickness_mm=0.5, loss_factor=0.01, band_hz=[0, 5000], actuators=[(9, 9)]
    )
    assert drawn.extent_m == pytest.approx((0.09, 0.06))
    (folder / "shape.svg").unlink()
    # What it holds is the shape, no longer the drawing.
    assert ur.Surface(drawn.toml) == drawn


def test_results_of_the_same_surface_are_the_same(film: ur.Surface) -> None:
    again = ur.Surface(film.toml)
    assert again.modes(max_hz=300).frequencies_hz == film.modes(max_hz=300).frequencies_hz
    # Computed once.
    assert film.responses()._raw is film.responses()._raw


def test_numbers_do_not_depend_on_threads(film: ur.Surface) -> None:
    alone, many = (film.focus([(40, 50)], window_ms=20, threads=count) for count in (1, 3))
    assert np.array_equal(alone.samples, many.samples)
    assert alone.report is not None and many.report is not None
    assert alone.report.targets[0].contrast == many.report.targets[0].contrast
