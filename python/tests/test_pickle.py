"""Objects go to other processes and come back the same."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
from pathlib import Path

import numpy as np

import unripple as ur


def _again(thing: object) -> object:
    return pickle.loads(pickle.dumps(thing))


def test_surfaces_are_pickled_as_text(film: ur.Surface) -> None:
    assert _again(film) == film and copy.deepcopy(film) == film
    assert film.toml.encode() in pickle.dumps(film)


def test_drives_and_reports_come_back(drive: ur.Drive) -> None:
    again = _again(drive)
    assert isinstance(again, ur.Drive)
    assert np.array_equal(again.samples, drive.samples) and again.names == drive.names
    assert drive.report is not None and again.report is not None
    assert again.report.to_dict() == drive.report.to_dict()
    assert again.focal_time == drive.focal_time


def test_responses_come_back(film: ur.Surface, library: Path) -> None:
    modal = _again(film.responses())
    assert isinstance(modal, ur.Responses)
    assert np.array_equal(modal.frequencies_hz, film.responses().frequencies_hz)
    stored = ur.open(library)
    again = _again(stored)
    assert isinstance(again, ur.Responses) and again.array is not None
    assert np.array_equal(again.array, stored.array)
    # A library is its path, however large it is.
    assert len(pickle.dumps(stored)) < 10_000


def _contrast(surface: ur.Surface, window_ms: float) -> float:
    """What a process computes."""
    report = surface.focus([(62, 90)], window_ms=window_ms, no_figures=True).report
    assert report is not None
    contrast: float = report.targets[0].contrast
    return contrast


def test_spawned_processes_compute_the_same(film: ur.Surface) -> None:
    windows = [15.0, 20.0]
    wanted = [_contrast(film, window) for window in windows]
    context = multiprocessing.get_context("spawn")
    with context.Pool(2) as pool:
        found = pool.starmap(_contrast, [(film, window) for window in windows])
    assert found == wanted
