"""What objects show of themselves: PNG beside HTML, animations, and texts no longer than a screen can show."""

from __future__ import annotations

import importlib.util
import io
import re
import struct
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread

import unripple as ur
from unripple import _thin

_PNG = b"\x89PNG\r\n\x1a\n"


def _size(png: bytes) -> tuple[int, int]:
    """Return width and height of a picture in pixels."""
    assert png.startswith(_PNG)
    width, height = struct.unpack(">II", png[16:24])
    return int(width), int(height)


def _chunk(png: bytes, name: bytes) -> bytes:
    """Return the content of the first chunk of a name."""
    at = len(_PNG)
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        if png[at + 4 : at + 8] == name:
            return png[at + 8 : at + 8 + length]
        at += 12 + length
    raise AssertionError(name)


@pytest.fixture
def things(film: ur.Surface, drive: ur.Drive, field: ur.Field, library: Path) -> dict[str, Any]:
    """Everything that has a figure, by its name."""
    return {
        "surface": film,
        "drive": drive,
        "noise": ur.Drive(np.ones((2, 100)), rate_hz=48000),
        "field": field,
        "traces": field.traces([(40, 50)], until_ms=40),
        "modal": film.responses(),
        "sampled": ur.open(library),
        "design": film.design(),
        "modes": film.modes(),
    }


def test_everything_with_a_figure_is_a_picture(things: dict[str, Any]) -> None:
    for name, thing in things.items():
        width, height = _size(thing._repr_png_())
        assert 200 < width < 2000 and 100 < height < 2000, name
        # Something is drawn.
        assert np.ptp(imread(io.BytesIO(thing._repr_png_()))[..., :3]) > 0.5, name


def test_reports_without_curves_are_no_pictures(drive: ur.Drive) -> None:
    assert drive.report is not None and drive.report._repr_png_() is None


def test_without_matplotlib_there_are_our_own_figures_alone(
    things: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "matplotlib" else find(name))
    shown = {name for name, thing in things.items() if thing._repr_png_() is not None}
    assert shown == {"surface", "drive", "field"}


def test_pictures_leave_no_figure_open(things: dict[str, Any]) -> None:
    import matplotlib.pyplot as plt

    before = plt.get_fignums()
    for thing in things.values():
        thing._repr_png_()
    assert plt.get_fignums() == before


def test_an_animation_is_that_of_the_folder(film: ur.Surface, drive: ur.Drive, folder: Path) -> None:
    field = film.field(drive, output="out", frames=5, movie_ms=(28, 31))
    animation = field.animation((28, 31), frames=5)
    assert animation.png == (folder / "out" / "animation.png").read_bytes()
    frames, _ = struct.unpack(">II", _chunk(animation.png, b"acTL"))
    assert frames == animation.frames == 5
    assert animation._repr_html_().startswith("<img") and "data:image/png" in animation._repr_html_()


def test_an_animation_is_saved_by_its_ending(field: ur.Field, folder: Path) -> None:
    stages: list[str] = []
    animation = field.animation(frames=2, progress=lambda stage, share: stages.append(stage))
    assert stages[0] == "animation" and all(stage.startswith("animation") for stage in stages)
    animation.save("waves.png")
    assert (folder / "waves.png").read_bytes() == animation.png
    animation.save(folder / "waves.html")
    page = (folder / "waves.html").read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>") and animation._repr_html_() in page
    with pytest.raises(ur.AskError, match=r"\.html"):
        animation.save("waves.gif")
    with pytest.raises(ur.WorkError):
        animation.save("no/such/folder/waves.png")


@pytest.mark.parametrize(
    ("options", "field_of"),
    [
        ({"frames": 0}, "frames"),
        ({"frames": 10**6}, "frames"),
        ({"movie_ms": (31, 28)}, "movie_ms"),
        ({"movie_ms": (0, 1e9)}, "movie_ms"),
    ],
)
def test_animations_that_cannot_be_are_refused(field: ur.Field, options: dict[str, Any], field_of: str) -> None:
    with pytest.raises(ur.AskError) as refused:
        field.animation(**options)
    assert refused.value.field == field_of


def test_a_library_has_no_animation(library: Path) -> None:
    stored = ur.open(library)
    field = stored.field(stored.focus([(60, 90)], window_ms=15, no_figures=True), no_figures=True)
    with pytest.raises(ur.InputError, match="grid"):
        field.animation()


def test_a_page_is_no_longer_than_a_screen_can_show(film: ur.Surface) -> None:
    drive = film.focus([(40, 50), (100, 90)], window_ms=60, duration_ms=200)
    assert len(drive.figures["drive"]) > 200_000 and len(_thin.thinned(drive.figures["drive"])) < 80_000
    page = drive._repr_html_()
    # Fields are images of cells, as long as they were.
    images = sum(map(len, re.findall(r"data:image/png;base64,[A-Za-z0-9+/=]*", page)))
    assert len(page) - images < 200_000
    assert len(page) < 0.8 * sum(map(len, drive.figures.values()))


def test_the_envelope_of_a_curve_is_kept() -> None:
    # 20 samples to a pixel, and a spike between two that are kept otherwise.
    y = 50 + 40 * np.sin(np.arange(8000) * 0.7)
    y[4321] = 99.5
    points = "L".join(f"{x:.2f} {value:.2f}" for x, value in zip(np.arange(8000) * 0.04, y, strict=True))
    svg = f'<svg><path d="M{points}" stroke="#000"/><path d="M0 0L1 1L2 0Z"/></svg>'
    thin = _thin.thinned(svg)
    assert len(thin) < len(svg) / 8 and '<path d="M0 0L1 1L2 0Z"/>' in thin
    found = re.search(r'd="M([^"]*)" stroke', thin)
    assert found is not None
    kept = np.array([point.split() for point in found[1].split("L")], dtype=float)
    # In each pixel the curve reaches as far up and down as before.
    column = np.floor(np.arange(8000) * 0.04 / 0.75)
    for pixel in range(400):
        before = np.round(y[column == pixel], 2)
        after = kept[np.floor(kept[:, 0] / 0.75) == pixel, 1]
        assert after.min() == pytest.approx(before.min()) and after.max() == pytest.approx(before.max())
    # What is short, or runs back, stays.
    for path in ("0 0L1 5L2 3", "L".join(f"{i % 7} {i}" for i in range(900))):
        assert _thin.thinned(f' d="M{path}"') == f' d="M{path}"'


def test_extras_are_those_that_are_used() -> None:
    root = Path(__file__).resolve().parents[2]
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    everything = re.fullmatch(r"unripple\[(.*)\]", extras.pop("all")[0])
    assert everything is not None and everything[1].split(",") == list(extras)
    code = "\n".join(file.read_text(encoding="utf-8") for file in (root / "python/unripple").glob("*.py"))
    guide = (root / "docs/python.md").read_text(encoding="utf-8")
    for extra, packages in extras.items():
        for package in packages:
            name = re.split(r"[\[>=<]", package)[0]
            assert f'"{name}' in code or name in guide, f"{extra}: {name}"
        assert f"`{extra}`" in guide, extra
    # What is said where one is missing is an extra.
    assert set(re.findall(r'needed\([^()]*, "(\w+)"\)', code)) <= set(extras)
