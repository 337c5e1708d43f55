"""Call everything that is public with random arguments of random types, and end at the first thing that must not happen.

    python fuzzing.py SECONDS SEED

Runs in a folder of its own, since some calls write files. Each call is written to standard output before it is made, so that the last line
tells what was called where the process ended in an abort. Status 0: all calls ended as they may; 1: one did not.
"""

from __future__ import annotations

import inspect
import random
import signal
import sys
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any

# Imported here, so that none is interrupted.
import matplotlib.pyplot as plt
import numpy as np
import pandas  # noqa: F401
import xarray  # noqa: F401

import unripple as ur
from unripple import _options, _unripple

#: Longest time of a call in s; what takes longer is interrupted as by Ctrl+C.
PATIENCE = 0.3

#: Calls that are left out: those that open a browser, those that ask sound servers, which other tests stop and start, the class of reports,
#: which tasks make, and what every tuple has.
LEFT_OUT = {"view", "View", "devices", "doctor", "Report", "count", "index"}

#: Options that would reach for devices, and for ports at which other tests listen.
NEVER = {"device", "jack_client", "jack_server", "card", "capture_card", "screen", "tuio", "websocket", "listen"}


class Enough(Exception):
    """A call took its time."""


#: What a call may end with.
MAY = (ur.UnrippleError, TypeError, Enough)


def _ring(_number: int, _frame: FrameType | None) -> None:
    raise Enough


class Values:
    """Random values: some that fit, most that do not."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.numpy = np.random.default_rng(seed)
        self.film = ur.Surface("hudin-2012", band_hz=[0, 300])
        self.drive = self.film.focus([(62, 90)], window_ms=10)
        self.made = 0

    def fitting(self, name: str) -> Any:
        """A value that an option of this name may have."""
        self.made += 1
        place = (self.random.uniform(0, 150), self.random.uniform(0, 150))
        if name in ("output", "figure", "record", "keep_drive", "path", "folder", "library", "report"):
            return self.random.choice([f"made-{self.made}", f"made-{self.random.randint(1, self.made)}"])
        known: dict[str, list[Any]] = {
            "surface": [self.film, "hudin-2012", self.film.toml],
            "source": ["drum", "picture-frame", self.film.toml],
            "drive": [self.drive, np.zeros((8, 480))],
            "method": ["inverse", "concentrate", "one-bit", "felt", "limited", "robust", "time-reversal"],
            "effect": ur.effects(),
            "command": [command for command in _unripple.commands() if command not in LEFT_OUT],
            "seconds": [0.05, 0.3],
            "block": [16, 64, 128],
            "blocks": [1, 3],
            "waveforms": [[(*place, "burst:100,3")], [(*place, "click:5", 2)]],
            "h": [np.zeros((2, 3, 100), np.float32)],
            "samples": [np.ones((8, 64), np.float32)],
            "until_ms": [5.0],
            "times": [[0.001, 0.002]],
            "threads": [1, 2],
            "names": [[f"a{k}" for k in range(1, 9)]],
        }
        if name in known:
            return self.random.choice(known[name])
        if name.startswith(("within", "keep_out", "targets_within")):
            corners = [(10, 10), (140, 10), place]
            return self.random.choice([corners, [corners], np.array(corners), "10,10,140,10,75,140"])
        if name.endswith("_mm") or name in ("targets", "at", "finger", "silent", "at_m", "points_m"):
            return self.random.choice([[place], place, [place, (40, 50)], np.array([place])])
        return self.random.choice([1, 0.5, 20, 100.0, True, "kernel", 3])

    def any(self, depth: int = 0) -> Any:
        """A value of any type."""
        plain: list[Callable[[], Any]] = [
            lambda: None,
            lambda: self.random.choice([True, False]),
            lambda: self.random.choice([0, 1, -1, 7, 2**31, 2**63, -(2**63), 2**70, 10**30]),
            lambda: self.random.choice([0.0, -0.0, 1.5, -3.0, 1e-300, 1e300, 1e9, float("nan"), float("inf"), -float("inf")]),
            lambda: self.random.choice(["", " ", "a", "a,b", "1,2", "nan,1", "x=1", "[a]\nb=1", "\0", "µ", "\udcff", ".", "no/such"]),
            lambda: self.random.choice([b"", b"\xff", bytearray(3), 1j, object(), len, int, Ellipsis, range(3), {1, 2}]),
            lambda: self.random.choice([self.film, self.drive, self.drive.report, np.float32(3), np.int64(-1), np.bool_(True)]),
            self.array,
        ]
        if depth < 3 and self.random.random() < 0.3:
            many = self.random.choice([0, 1, 2, 3, 8])
            if self.random.random() < 0.5:
                kind = self.random.choice([list, tuple])
                return kind(self.any(depth + 1) for _ in range(many))
            keys = ["at_mm", "at_m", "gain", "circle_mm", "svg", "lines_mm", "sheet", "name", "", 3]
            return {self.random.choice(keys): self.any(depth + 1) for _ in range(many)}
        return self.random.choice(plain)()

    def array(self) -> Any:
        """An array of any shape, type and layout."""
        shape = tuple(self.random.choice([0, 1, 2, 3, 8, 64]) for _ in range(self.random.randint(0, 3)))
        kind = self.random.choice(["f4", "f8", ">f8", "f2", "i4", "u8", "c16", "?", "U3", "O", "M8[s]"])
        values = self.numpy.standard_normal(shape) * 10.0 ** self.random.choice([-3, 0, 3])
        if kind in ("U3", "O", "M8[s]"):
            return np.full(shape, 3).astype(kind)
        array = np.asarray(np.abs(values) if kind == "u8" else values).astype(kind)
        if array.ndim and self.random.random() < 0.3:
            array = array.T if self.random.random() < 0.5 else array[::-1]
        if array.size and array.dtype.kind == "f" and self.random.random() < 0.1:
            array = array.copy()
            array.flat[0] = self.random.choice([np.nan, np.inf])
        return array

    def value(self, name: str) -> Any:
        """A value for an argument of this name."""
        return self.fitting(name) if self.random.random() < 0.6 else self.any()


def things(values: Values) -> dict[str, Any]:
    """What has public methods, by its name."""
    film, drive = values.film, values.drive
    points = [(40, 50), (62, 90)]
    h = film.responses().impulse(points, length_ms=20)
    places = 1e3 * film.actuators_m
    own = ur.Responses.from_numpy(h, rate_hz=film.rate_hz, points_mm=points, actuators_mm=places, surface=film)
    return {
        "unripple": ur,
        "film": film,
        "drive": drive,
        "report": drive.report,
        "responses": film.responses(),
        "own": own,
        "field": film.field(drive),
        "traces": film.field(drive).traces((62, 90)),
        "animation": film.field(drive).animation(frames=2),
        "virtual": film.virtual(block=16),
        "player": film.player(window_ms=10),
    }


def calls(values: Values) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Every public callable, with its name."""
    for owner, thing in things(values).items():
        names = ur.__all__ if thing is ur else [name for name in dir(thing) if not name.startswith("_")]
        for name in sorted(names):
            if name in LEFT_OUT or isinstance(getattr(type(thing), name, None), property):
                continue
            found = getattr(thing, name)
            is_error = isinstance(found, type) and issubclass(found, BaseException)
            if callable(found) and not is_error:
                yield f"{owner}.{name}", found


def arguments(name: str, call: Callable[..., Any], values: Values) -> tuple[list[Any], dict[str, Any]]:
    """Random arguments for a call: some of those that it has, sometimes one that it has not."""
    try:
        known = list(inspect.signature(call).parameters.values())
    except (TypeError, ValueError):
        known = []
    positional = [p.name for p in known if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    keywords = [p.name for p in known if p.kind in (p.KEYWORD_ONLY, p.POSITIONAL_OR_KEYWORD)]
    command = name.rpartition(".")[2]
    if command in _unripple.commands():
        keywords += [option for option in _options.names(command) if option not in NEVER]
    given = [values.value(argument) for argument in positional[: values.random.choice([0, 1, 1, 2, 3])]]
    wanted = values.random.sample(keywords, k=min(len(keywords), values.random.choice([0, 1, 2, 4])))
    named = {argument: values.value(argument) for argument in wanted if argument not in positional[: len(given)]}
    if values.random.random() < 0.05:
        named["colour"] = values.any()
    if values.random.random() < 0.05:
        given.append(values.any())
    return given, named


def shown(name: str, given: list[Any], named: dict[str, Any]) -> str:
    """A call as a line of text."""
    parts = [f"{value!r:.80}" for value in given] + [f"{key}={value!r:.80}" for key, value in named.items()]
    return f"{name}({', '.join(parts)})".encode("ascii", "backslashreplace").decode().replace("\n", " ")


def tried(name: str, call: Callable[..., Any], values: Values) -> bool:
    """Make one call; tell whether it ended as it may."""
    given, named = arguments(name, call, values)
    print(shown(name, given, named), flush=True)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE)
    try:
        call(*given, **named)
    except MAY:
        pass
    except BaseException:
        signal.setitimer(signal.ITIMER_REAL, 0)
        traceback.print_exc()
        return False
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        ur.set_progress(False)
        ur.set_threads(None)
        plt.close("all")
    return True


def main() -> None:
    """Make calls until the time is over."""
    seconds, seed = float(sys.argv[1]), int(sys.argv[2])
    warnings.simplefilter("ignore")
    signal.signal(signal.SIGALRM, _ring)
    values = Values(seed)
    known = dict(calls(values))
    end, made = time.monotonic() + seconds, 0
    # Each once, and then any of them.
    order = list(known)
    while time.monotonic() < end or made < len(known):
        name = order[made] if made < len(order) else values.random.choice(order)
        made += 1
        try:
            well = tried(name, known[name], values)
        except Enough:
            # It rang when the call was over.
            well = True
        if not well:
            sys.exit(1)
    print(f"{made} calls of {len(known)} callables")


if __name__ == "__main__":
    main()
