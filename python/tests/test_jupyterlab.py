"""The page in a notebook: JupyterLab in headless Chromium shows it in a cell, and a press there moves the surface."""

from __future__ import annotations

import importlib.util
import io
import json
import os
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np
import numpy.typing as npt
import pytest
from chromium import Chromium, find, until

#: Where pictures go for whoever wants to look, beside those of the page's own tests.
PICTURES = Path(os.environ.get("CARGO_TARGET_DIR") or Path(__file__).resolve().parents[2] / "target") / "screenshots"

TOKEN = "letters8and9"

#: What the notebook's cell does: few modes, so that the surface is ready at once.
CELL = """\
import unripple as ur

ur.View(ur.Surface("hudin-2012", band_hz=[0, 500]))
"""

#: Where the surface is pressed, in mm, and half the side of the square around it whose pixels are compared.
PLACE = (62, 90)
AROUND = 24

#: Least share of those pixels that change by more than a tenth of the whole range: the finger's mark alone is more, noise is nothing.
CHANGED = 0.05

#: Pictures that have to be the same before the surface is at rest.
STILL = 5

RUN = """
(async () => {
  const { commands, restored, shell } = window.jupyterapp;
  await restored;
  const panel = await commands.execute('docmanager:open', { path: 'view.ipynb', factory: 'Notebook' });
  await Promise.all([panel.context.ready, panel.sessionContext.ready]);
  shell.activateById(panel.id);
  await commands.execute('notebook:run-all-cells');
})()
"""

#: Corner of the frame in the window, and its address.
FRAME = """
(() => {
  const frame = document.querySelector('.jp-OutputArea-output iframe');
  frame?.scrollIntoView({ block: 'end' });
  const box = frame?.getBoundingClientRect();
  return box && [box.left, box.top, frame.src];
})()
"""

#: Where the place lies within the frame.
WITHIN = """
(() => {
  const map = window.unripple?.map.field() && window.unripple.map.maps[0];
  if (!map) return null;
  const box = map.canvas.getBoundingClientRect();
  const [x, y] = map.view().toPx(PLACE);
  return [box.left + x, box.top + y];
})()
""".replace("PLACE", str(list(PLACE)))

#: The fingers that the server has told the page of, and what the page says of the first of them.
FINGERS = "window.unripple.state.last('status')?.fingers"
SAYS = "document.querySelector('.finger')?.innerText"


def _missing(reason: str) -> None:
    """Skip a test for which something is missing; where nothing may be skipped, fail."""
    if os.environ.get("CI") or os.environ.get("UNRIPPLE_NOTHING_SKIPPED") == "1":
        pytest.fail(reason)
    told = os.environ.get("UNRIPPLE_SKIPPED")
    if told:
        with open(told, "a", encoding="utf-8") as skipped:
            skipped.write(f"SKIPPED: the page in a notebook is not tested: {reason}\n")
    pytest.skip(reason)


@pytest.fixture
def lab(folder: Path) -> Iterator[str]:
    """The address of a JupyterLab with nobody's settings, in a folder with a notebook."""
    if importlib.util.find_spec("jupyterlab") is None:
        _missing("no jupyterlab")
    cell = {"cell_type": "code", "id": "view", "metadata": {}, "execution_count": None, "outputs": [], "source": CELL}
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": kernel, "cells": [cell]}
    (folder / "view.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    places = {"HOME": "home", "IPYTHONDIR": "ipython", "JUPYTERLAB_SETTINGS_DIR": "settings"}
    places |= {f"JUPYTER_{name}_DIR": name.lower() for name in ("CONFIG", "DATA", "RUNTIME")}
    own = {name: str(folder / "jupyter" / place) for name, place in places.items()}
    for place in own.values():
        Path(place).mkdir(parents=True)
    # It would ask whether to tell news.
    settings = Path(own["JUPYTERLAB_SETTINGS_DIR"], "@jupyterlab", "apputils-extension")
    settings.mkdir(parents=True)
    quiet = {"fetchNews": "false", "checkForUpdates": False, "doNotDisturbMode": True}
    (settings / "notification.jupyterlab-settings").write_text(json.dumps(quiet), encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = {
        "ServerApp.ip": "127.0.0.1",
        # If somebody takes it meanwhile, the next one that is free.
        "ServerApp.port": port,
        "ServerApp.root_dir": folder,
        "ServerApp.allow_root": True,
        "LabApp.expose_app_in_browser": True,
        "LabApp.check_for_updates_class": "jupyterlab.NeverCheckForUpdate",
    }
    said = (folder / "jupyter" / "said.txt").open("wb")
    server = subprocess.Popen(
        [sys.executable, "-m", "jupyterlab", "--no-browser", *(f"--{key}={value}" for key, value in options.items())],
        env={**os.environ, **own, "JUPYTER_TOKEN": TOKEN},
        stdin=subprocess.DEVNULL,
        stdout=said,
        stderr=said,
    )
    try:
        told = until("JupyterLab", lambda: _told(server, Path(own["JUPYTER_RUNTIME_DIR"])))
        # By name: the page in the frame, which has an address of numbers, is of another site then, as it is for most people.
        yield f"http://localhost:{told['port']}/lab?token={TOKEN}"
    finally:
        # It ends its kernels first.
        server.terminate()
        server.wait(60)
        said.close()


def _told(server: subprocess.Popen[bytes], folder: Path) -> dict[str, Any] | None:
    """What a server has written down of itself, once it listens."""
    assert server.poll() is None, "JupyterLab ended"
    for file in folder.glob("jpserver-*.json"):
        try:
            found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except ValueError:
            # It is being written.
            continue
        return found
    return None


def _pixels(picture: bytes, x: float, y: float) -> npt.NDArray[np.floating[Any]]:
    """The colours around a place in a picture, from 0 to 1."""
    colours = matplotlib.image.imread(io.BytesIO(picture), format="png")[:, :, :3]
    column, row = round(x), round(y)
    return colours[row - AROUND : row + AROUND, column - AROUND : column + AROUND]


def _changed(before: npt.NDArray[np.floating[Any]], after: npt.NDArray[np.floating[Any]]) -> float:
    """The share of pixels that have changed."""
    return float(np.mean(np.abs(after - before).max(axis=2) > 0.1))


def _still(browser: Chromium, x: float, y: float) -> npt.NDArray[np.floating[Any]]:
    """The colours around a place when the waves there are over: those that stay for some pictures."""
    pictures: list[npt.NDArray[np.floating[Any]]] = []

    def stays() -> bool:
        pictures.append(_pixels(browser.picture(), x, y))
        return len(pictures) >= STILL and all(_changed(other, pictures[-1]) == 0 for other in pictures[-STILL:])

    until("a surface at rest", stays)
    return pictures[-1]


@pytest.mark.clock
def test_a_press_within_a_cell_moves_the_surface(lab: str, folder: Path) -> None:
    program = find()
    if program is None:
        _missing("no chromium")
        return
    PICTURES.mkdir(parents=True, exist_ok=True)
    with Chromium(program, folder / "chromium", 1280, 1000) as browser:
        browser.open(lab)
        until("JupyterLab's page", lambda: browser.evaluate("Boolean(window.jupyterapp)"))
        browser.evaluate(RUN)
        try:
            _, _, url = until("a frame in the cell's output", lambda: browser.evaluate(FRAME))
            frame = until("the page in the frame", lambda: browser.frame(url))
            x, y = until("the surface", lambda: browser.evaluate(WITHIN, frame))
            # Where the frame lies now that all of the cell is there.
            left, top, _ = browser.evaluate(FRAME)
            x, y = left + x, top + y
            # The first press takes the hint away that lies over the surface.
            for event in ("mouseMoved", "mousePressed", "mouseReleased"):
                browser.mouse(event, x, y)
            before = _still(browser, x, y)
            browser.mouse("mousePressed", x, y)
            (finger,) = until("a finger", lambda: browser.evaluate(FINGERS, frame))
            until("what the finger feels", lambda: "contrast" in (browser.evaluate(SAYS, frame) or ""))
        finally:
            picture = browser.picture()
            (PICTURES / "jupyterlab.png").write_bytes(picture)
        after = _pixels(picture, x, y)
        browser.mouse("mouseReleased", x, y)
        until("no finger", lambda: browser.evaluate(f"{FINGERS}.length === 0", frame))
    assert finger["at_mm"] == pytest.approx(PLACE, abs=0.5)
    assert _changed(before, after) > CHANGED
