"""A headless Chromium with one page, driven by the Chrome DevTools protocol."""

from __future__ import annotations

import base64
import itertools
import json
import os
import shutil
import subprocess
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from websockets.sync.client import connect

_Found = TypeVar("_Found")

_NAMES = ("chromium", "chromium-browser", "google-chrome")

#: As for the page's own tests in crates/unripple-viewer/browser; and each site has a process of its own, so that a frame of another site is
#: a target that can be spoken to.
_ARGUMENTS = (
    "--headless=new",
    "--remote-debugging-port=0",
    "--site-per-process",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-unsafe-swiftshader",
)

#: Longest wait for anything, in s: many times what it takes, since other tests may have the cores.
PATIENCE = 180.0


def find() -> str | None:
    """Path of a Chromium, if there is one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, _NAMES)), None)


def until(what: str, ask: Callable[[], _Found | None]) -> _Found:
    """Ask again and again until there is an answer, and return it."""
    began = time.monotonic()
    while time.monotonic() - began < PATIENCE:
        found = ask()
        if found:
            return found
        time.sleep(0.1)
    raise TimeoutError(f"waited in vain for {what}")


class Refused(Exception):
    """What the browser did not do, or what a page's script raised."""


class Chromium:
    """A browser with one page, ended by leaving its context."""

    def __init__(self, program: str, profile: Path, width: int, height: int) -> None:
        arguments = [*_ARGUMENTS, f"--user-data-dir={profile}", f"--window-size={width},{height}", "about:blank"]
        quiet, self._opened = subprocess.DEVNULL, ExitStack()
        self._process = subprocess.Popen([program, *arguments], stdin=quiet, stdout=quiet, stderr=quiet)
        try:
            address = until("a browser", lambda: _address(profile / "DevToolsActivePort"))
            # Pictures are long.
            connection = connect(address, max_size=None, open_timeout=PATIENCE, proxy=None)
            self._socket = self._opened.enter_context(connection)
            self._numbers = itertools.count(1)
            target = self.send("Target.createTarget", url="about:blank")["targetId"]
            self._page: str = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        except BaseException:
            self._opened.close()
            self._process.kill()
            self._process.wait()
            raise

    def __enter__(self) -> Chromium:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._opened.close()
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def send(self, method: str, session: str | None = None, /, **parameters: Any) -> Any:
        """Send a command to the browser, or to a target by its session; return what is answered."""
        number = next(self._numbers)
        message = {"id": number, "method": method, "params": parameters}
        self._socket.send(json.dumps(message if session is None else {**message, "sessionId": session}))
        while True:
            heard = json.loads(self._socket.recv(timeout=PATIENCE))
            # Of events, which have no number, nothing is wanted.
            if heard.get("id") == number:
                if "error" in heard:
                    raise Refused(f"{method}: {heard['error']['message']}")
                return heard["result"]

    def open(self, url: str) -> None:
        """Open an address in the page."""
        self.send("Page.navigate", self._page, url=url)

    def evaluate(self, expression: str, frame: str | None = None) -> Any:
        """Return the value of an expression, or of the promise that it is, in the page or in a frame of it."""
        session = self._page if frame is None else frame
        asked = {"expression": expression, "returnByValue": True, "awaitPromise": True}
        found = self.send("Runtime.evaluate", session, **asked)
        if "exceptionDetails" in found:
            raised = found["exceptionDetails"]
            raise Refused(f"{expression}: {raised.get('exception', {}).get('description', raised['text'])}")
        return found["result"].get("value")

    def frame(self, url: str) -> str | None:
        """Return the frame of another site that shows an address, if one does."""
        targets = self.send("Target.getTargets", filter=[{"type": "iframe"}])["targetInfos"]
        shown = [target["targetId"] for target in targets if target["url"] == url]
        if not shown:
            return None
        frame: str = self.send("Target.attachToTarget", targetId=shown[0], flatten=True)["sessionId"]
        return frame

    def mouse(self, event: str, x: float, y: float) -> None:
        """Move the mouse to a place in the window, press it there, or release it: `mouseMoved`, `mousePressed`, `mouseReleased`."""
        button = {} if event == "mouseMoved" else {"button": "left", "clickCount": 1}
        self.send("Input.dispatchMouseEvent", self._page, type=event, x=x, y=y, **button)

    def picture(self) -> bytes:
        """Return a picture of the window, as PNG."""
        return base64.b64decode(self.send("Page.captureScreenshot", self._page)["data"])


def _address(file: Path) -> str | None:
    """Return the address that a browser has written down, if it has."""
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    return f"ws://127.0.0.1:{lines[0]}{lines[1]}" if len(lines) == 2 else None
