"""Ctrl+C while a surface is played: the report of what was played is not lost."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

#: What a child does: it plays, sends itself Ctrl+C a while after the first finger was told of, and tells what came of the call. The signal
#: comes while nothing of Python runs in the thread that plays.
_CHILD = """
import json, logging, os, signal, threading
import unripple as ur


class Interrupting(logging.Handler):
    armed = True

    def emit(self, record):
        if self.armed and "finger" in record.getMessage():
            self.armed = False
            threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()


def interrupted(call):
    handler = Interrupting()
    logging.getLogger("unripple").addHandler(handler)
    try:
        return "returned", call()
    except KeyboardInterrupt as interrupt:
        return "raised", getattr(interrupt, "report", None)
    finally:
        logging.getLogger("unripple").removeHandler(handler)


logging.getLogger("unripple").setLevel(logging.INFO)
film = ur.Surface("hudin-2012", band_hz=[0, 500])
how, report = {call}
print(json.dumps([how, report if report is None else report.to_dict(), str(report)]))
"""


def _interrupted(call: str, folder: Path) -> tuple[str, dict[str, Any], str]:
    """Do a call in a process of its own and interrupt it: whether it returned or raised, the report, and that as text."""
    source = _CHILD.replace("{call}", call)
    done = subprocess.run([sys.executable, "-c", source], cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    how, report, text = json.loads(done.stdout)
    return how, report, text


@pytest.mark.parametrize("clock", ["False", "True"], ids=["as it goes", "in real time"])
def test_what_only_an_interrupt_ends_returns_its_report(clock: str, folder: Path) -> None:
    kept = ", keep_drive='kept.wav'" if clock == "False" else ""
    call = f"interrupted(lambda: film.play(fingers=1, window_ms=20, real_time={clock}{kept}))"
    how, report, text = _interrupted(call, folder)
    assert how == "returned"
    assert report["seconds"] > 0 and report["touches"] > 0 and report["run"]["command"] == "play"
    assert text.startswith("hudin-2012: ")
    assert (folder / "kept.wav").exists() == bool(kept)


@pytest.mark.parametrize("play", ["film.play", "lambda **options: ur.play(film, **options)"])
def test_what_has_an_end_is_broken_off_and_has_its_report(play: str, folder: Path) -> None:
    how, report, _ = _interrupted(f"interrupted(lambda: ({play})(seconds=1e6, fingers=1, window_ms=20))", folder)
    assert how == "raised"
    assert 0 < report["seconds"] < 1e6 and report["touches"] > 0


def test_a_play_that_is_done_again_has_its_report(folder: Path) -> None:
    first = (
        "interrupted(lambda: film.play(fingers=1, window_ms=20))\n"
        "open('report.json', 'w').write(report.to_json())\n"
        "how, report = interrupted(lambda: ur.rerun('report.json'))"
    )
    how, report, _ = _interrupted(first, folder)
    assert how == "raised"
    assert report["seconds"] > 0 and report["run"]["command"] == "play"


def test_an_interrupt_before_anything_is_played_has_none(folder: Path) -> None:
    # The modes of this outline need a mesh, which takes seconds.
    call = "(threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start(), interrupted(lambda: ur.play('stadium-film')))[1]"
    how, report, _ = _interrupted(call, folder)
    assert how == "raised" and report is None
