"""The page that a child process serves: it ends with Python."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

import unripple as ur

#: Within how long after Python the server ends, in s: it looks ten times a second, and the machine may be busy.
_AT_MOST = 20.0

#: What a Python does that is killed: it tells the number of its child and the page's address, and waits.
_CHILD = """
import time
import unripple as ur

view = ur.View(ur.Surface("hudin-2012", band_hz=[0, 300]), browser=False)
print(view._child.pid, view.url, flush=True)
time.sleep(600)
"""


def _answers(url: str) -> bool:
    try:
        with urllib.request.urlopen(url, timeout=60):
            return True
    except OSError:
        return False


def _runs(process: int) -> bool:
    """Whether a process runs. One that has ended and was not waited for, as where nobody does that for orphans, does not."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    stat = Path(f"/proc/{process}/stat")
    return not (stat.exists() and stat.read_text(encoding="utf-8").rpartition(") ")[2].startswith("Z"))


@pytest.mark.clock
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_the_server_ends_with_python_however_that_ends(how: signal.Signals) -> None:
    python = subprocess.Popen([sys.executable, "-c", _CHILD], stdout=subprocess.PIPE, text=True)
    assert python.stdout is not None
    child = 0
    try:
        number, url = python.stdout.readline().split()
        child = int(number)
        assert _runs(child) and _answers(url)
        python.send_signal(how)
        assert python.wait(timeout=60) == -how
        began = time.monotonic()
        while (_runs(child) or _answers(url)) and time.monotonic() - began < _AT_MOST:
            time.sleep(0.05)
        assert not _runs(child) and not _answers(url)
    finally:
        python.kill()
        python.stdout.close()
        if child and _runs(child):
            os.kill(child, signal.SIGKILL)


def test_the_server_goes_on_while_python_does(film: ur.Surface) -> None:
    with film.view(browser=False) as view:
        time.sleep(1)
        assert not view.closed and _answers(view.url)
    assert view.closed and not _answers(view.url)
