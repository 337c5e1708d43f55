"""What the tests of the Python package share: small surfaces and their drives, a folder for each test, and the program."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import matplotlib
import pytest

import unripple as ur

matplotlib.use("Agg")

#: What `./soak sweeps` alone runs.
collect_ignore = [] if "UNRIPPLE_DESIGNS" in os.environ else ["test_sweep_many.py"]


def pytest_configure() -> None:
    """Let Ctrl+C through: a shell script starts what it runs in the background with that signal ignored, and so would be what tests start."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of its own, in which each test runs."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="session")
def program() -> str:
    """Path of the program `unripple`, of the same build as the library."""
    return os.environ["UNRIPPLE"]


@pytest.fixture(scope="session")
def film() -> ur.Surface:
    """The paper's film with few modes, for tests that take no time."""
    return ur.Surface("hudin-2012", band_hz=[0, 500])


@pytest.fixture(scope="session")
def drive(film: ur.Surface) -> ur.Drive:
    """A drive for two places of the film."""
    return film.focus([(40, 50), (100, 90)], window_ms=30)


@pytest.fixture(scope="session")
def field(film: ur.Surface, drive: ur.Drive) -> ur.Field:
    """What that drive does to the film."""
    return film.field(drive)


@pytest.fixture(scope="session")
def library(film: ur.Surface, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A library of the film's responses at some points."""
    path = tmp_path_factory.mktemp("libraries") / "film"
    film.respond(path, grid_mm=30, length_ms=40)
    return path
