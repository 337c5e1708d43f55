"""The page that a child process serves: who may frame it, how a notebook shows it, and that it ends with Python."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
import urllib.request
import webbrowser
from pathlib import Path

import pytest

import unripple as ur
from unripple import _view

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


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The addresses for which a browser would have been opened."""
    addresses: list[str] = []
    monkeypatch.setattr(webbrowser, "open", addresses.append)
    return addresses


def _policy(view: ur.View) -> str:
    """The header that tells a browser who may frame the page."""
    with urllib.request.urlopen(view.url, timeout=60) as answer:
        policy: str = answer.headers["Content-Security-Policy"]
    return policy


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


def test_nobody_frames_the_page_unless_it_is_said(film: ur.Surface, opened: list[str]) -> None:
    with film.view() as view:
        assert view.framed_by == ()
        assert _policy(view).endswith("; frame-ancestors 'none'")
        assert view.url in view._repr_html_() and "iframe" not in view._repr_html_()
        assert opened == [view.url]


def test_origins_that_are_named_may_frame_it(film: ur.Surface, opened: list[str]) -> None:
    origins = ["https://lab.example", "http://localhost:8888"]
    with film.view(framed_by=origins, token="abcdef123456", browser=False) as view:
        assert view.framed_by == tuple(origins)
        assert _policy(view).endswith("; frame-ancestors https://lab.example http://localhost:8888")
        assert f'<iframe src="{view.url}"' in view._repr_html_()
        assert view.url.endswith("?token=abcdef123456")
    assert "iframe" not in view._repr_html_() and "closed" in view._repr_html_()
    with film.view(framed_by="http://127.0.0.1:*", browser=False) as view:
        assert _policy(view).endswith("; frame-ancestors http://127.0.0.1:*")
    assert opened == []


@pytest.mark.parametrize("origin", ["*", "http://localhost:8888/", "http://a;script-src *", "http://lab.example:*"])
def test_what_is_no_origin_is_refused(film: ur.Surface, origin: str) -> None:
    with pytest.raises(ur.InputError, match=r"--framed-by: expected scheme://host\[:port\]"):
        film.view(framed_by=["http://localhost:8888", origin], browser=False)


def test_a_notebook_of_this_machine_may_frame_it(
    film: ur.Surface, opened: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_view, "in_notebook", lambda: True)
    with film.view() as view:
        assert _policy(view).endswith("; frame-ancestors http://localhost:* http://127.0.0.1:*")
        assert "<iframe" in view._repr_html_()
    with film.view(framed_by=[]) as view:
        assert _policy(view).endswith("; frame-ancestors 'none'")
        assert "<iframe" not in view._repr_html_()
    # The cell shows it.
    assert opened == []


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
