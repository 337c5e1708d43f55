"""Pictures: axes with labels and units, drawn into given axes or new ones; our own figures in notebooks."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from matplotlib.axes import Axes

import unripple as ur


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    """No figure is left open."""
    yield
    plt.close("all")


def _labelled(ax: Axes) -> None:
    assert ax.get_xlabel() and ax.get_ylabel()
    assert ax.get_xlabel()[-1] in ")]", "expected a unit"
    ax.figure.canvas.draw()


def test_drives_fields_and_responses_are_drawn(
    drive: ur.Drive, field: ur.Field, film: ur.Surface, library: Path
) -> None:
    for thing in (drive, field, film.responses(), ur.open(library)):
        _labelled(thing.plot())


def test_axes_may_be_given(drive: ur.Drive, field: ur.Field) -> None:
    _, (left, right) = plt.subplots(1, 2)
    assert drive.plot(left) is left
    assert field.plot(ax=right) is right
    assert len(plt.get_fignums()) == 1


def test_a_field_is_drawn_at_an_instant(field: ur.Field, drive: ur.Drive) -> None:
    _labelled(field.plot(drive.focal_time, quantity="displacement"))
    with pytest.raises(ur.OptionError):
        field.plot(quantity="pressure")  # type: ignore[arg-type]


def test_a_labelled_field_draws_itself(field: ur.Field, drive: ur.Drive) -> None:
    field.velocity.sel(time=drive.focal_time, method="nearest").plot()
    _labelled(plt.gca())


def test_notebooks_show_figures(drive: ur.Drive, field: ur.Field, film: ur.Surface) -> None:
    for thing in (drive, field, film, film.responses(), drive.report):
        html = thing._repr_html_()
        assert "<" in html and "Error" not in html


def test_figures_are_those_of_the_folder(film: ur.Surface, folder: Path) -> None:
    written = film.focus([(62, 90)], window_ms=20, output="out")
    drive = film.focus([(62, 90)], window_ms=20)
    assert drive.figures and drive.figures == written.figures
    for name, text in drive.figures.items():
        assert (folder / "out" / f"{name}.svg").read_text(encoding="utf-8") == text
