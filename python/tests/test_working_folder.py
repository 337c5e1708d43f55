"""A library that was opened by a relative path is that library wherever Python goes afterwards."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import unripple as ur


def _focus(opened: ur.Responses, **options: Any) -> ur.Drive:
    return opened.focus([(62, 90)], window_ms=15, between="nearest", **options)


def _field(opened: ur.Responses, **options: Any) -> ur.Field:
    return opened.field(opened.focus([(62, 90)], window_ms=15), **options)


def _told(report: ur.Report) -> dict[str, Any]:
    """A report without the date of its run."""
    told = report.to_dict()
    told["run"].pop("date")
    return told


@pytest.mark.parametrize("task", [_focus, _field])
@pytest.mark.parametrize("output", [None, "out"], ids=["in memory", "in a folder"])
def test_tasks_use_the_library_that_was_opened(
    task: Callable[..., Any],
    output: str | None,
    film: ur.Surface,
    library: Path,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    here, elsewhere = folder / "here", folder / "elsewhere"
    shutil.copytree(library, here / "film")
    # Another one that the same name would find.
    film.respond(elsewhere / "film", grid_mm=50, length_ms=20)
    options = {"no_figures": True} if output is None else {"no_figures": True, "output": output}
    monkeypatch.chdir(here)
    opened = ur.open("film")
    before = task(opened, **options).report
    monkeypatch.chdir(elsewhere)
    after = task(opened, **options).report
    # The report names the library as it was opened, its record by where that is.
    assert str(after) == str(before) and "points of film" in str(after)
    assert after.run.ask.surface == str(here / "film")
    assert after.run["files"][0].path == str(here / "film")
    assert _told(after) == _told(before)
    if output is not None:
        assert (elsewhere / "out" / "report.json").exists()
        assert ur.rerun(elsewhere / "out" / "report.json", "again").run.command == after.run.command
