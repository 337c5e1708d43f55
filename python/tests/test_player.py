"""Live play, stepped from Python block by block, with touches that Python pushes."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple import _unripple
from unripple._errors import AskError, InputError

#: Samples per second, samples of a block, actuators of the film, and a place on it in metres.
RATE = 48_000
BLOCK = 64
ACTUATORS = 8
PLACE = (0.062, 0.090)

#: Window of the players, in seconds, and blocks that it lasts.
WINDOW = 0.020
LASTS = math.ceil(WINDOW * RATE / BLOCK)


@pytest.fixture(scope="module")
def film() -> ur.Surface:
    """The paper's film, in a band low enough to be quick."""
    return ur.Surface("hudin-2012", band_hz=[0, 1500])


def raw(surface: ur.Surface) -> Any:
    """The surface as the library in Rust has it."""
    return _unripple.Surface(json.dumps(surface.as_ask()))


def player(surface: ur.Surface, effect: str = "click-button", *, full_limit: bool = False) -> Any:
    """A player by time reversal."""
    return _unripple.Player(raw(surface), effect, "time-reversal", WINDOW, BLOCK, full_limit)


def test_a_player_sounds_from_touch_to_silence(film: ur.Surface) -> None:
    """Nothing before a touch, a drive within the limits for it, exact silence two windows after the lift."""
    playing = player(film)
    assert (playing.names, playing.rate_hz, playing.block) == (film.names, RATE, BLOCK)
    assert (playing.window_s, playing.time_s) == (WINDOW, 0.0)
    before = playing.step(50)
    assert before.shape == (ACTUATORS, 50 * BLOCK) and before.dtype == np.float32 and not np.any(before)
    assert playing.time_s == 50 * BLOCK / RATE

    playing.down(1, PLACE)
    pressed = playing.step(2 * LASTS)
    assert np.all(np.any(pressed, axis=1)) and np.max(np.abs(pressed)) <= film.limit * (1 + 1e-6)
    sensors, probe = playing.heard()
    assert sensors.shape == pressed.shape and probe.shape == pressed.shape[1:]
    assert np.any(sensors) and np.any(probe)

    playing.up(1)
    assert np.any(playing.step(LASTS))
    # The lift is heard at the beginning of a block, and the window ends within one.
    playing.step(LASTS + 2)
    assert not np.any(playing.step(500))


def test_the_full_level_is_that_of_the_task(film: ur.Surface) -> None:
    """A gain of 1 is as far as linear theory goes, or the limit, where that is asked for."""
    peaks = []
    for full_limit in (False, True):
        playing = player(film, full_limit=full_limit)
        playing.down(1, PLACE)
        peaks.append(np.max(np.abs(playing.step(LASTS + 1))))
    # The effect has a gain of 0.8.
    assert peaks[1] == pytest.approx(0.8 * film.limit, rel=1e-5)
    assert 0 < peaks[0] < peaks[1]
    usual = _unripple.Player(raw(film), "click-button", "time-reversal", None, BLOCK, False)
    report = json.loads(usual.report())
    assert report["window_s"] == usual.window_s < report["window_unhurried_s"]


#: A finger that slides, one that taps meanwhile, and one that comes again: finger, what it does, place, time.
STROKE = [
    (1, "down", (0.040, 0.050), 0.010),
    *((1, "move", (0.040 + 0.001 * i, 0.050 + 0.0005 * i), 0.010 + 0.005 * i) for i in range(1, 50)),
    (2, "down", PLACE, 0.0333),
    (2, "up", None, 0.0777),
    (1, "up", None, 0.270),
    (1, "down", PLACE, 0.280),
    (1, "up", None, 0.300),
]


def push(playing: Any, finger: int, what: str, place: Any, time: float) -> None:
    """Push one touch."""
    if what == "up":
        playing.up(finger, time)
    else:
        getattr(playing, what)(finger, place, time)


@pytest.mark.parametrize("effect", ["click-button", "sandpaper"])
def test_the_same_touches_give_the_same_samples(film: ur.Surface, effect: str) -> None:
    """However many blocks a call plays, and whether the touches were pushed long before or just in time."""
    blocks = 300
    before = player(film, effect)
    for touch in STROKE:
        push(before, *touch)
    expected = before.step(blocks)
    assert np.any(expected)
    timely, parts = player(film, effect), []
    left = sorted(STROKE, key=lambda touch: touch[3])
    for _ in range(blocks):
        while left and left[0][3] < timely.time_s + BLOCK / RATE:
            push(timely, *left.pop(0))
        parts.append(timely.step(1))
    np.testing.assert_array_equal(np.concatenate(parts, axis=1), expected)
    assert not left


def test_a_player_reports_what_was_played_and_felt(film: ur.Surface) -> None:
    """The report has the keys of the task, and a finger that rests on the film feels the click."""
    playing = player(film)
    assert playing.felt() == []
    playing.down(9, PLACE, force_n=0.5)
    playing.step(math.ceil(0.25 * RATE / BLOCK))
    ((touch, place, level, contrast, time),) = playing.felt()
    assert touch == 1 and place == pytest.approx(PLACE) and level > 0 and contrast > 0
    # The first look is at the first block that ends after 0.2 s.
    assert 0.2 <= time < 0.2 + 2 * BLOCK / RATE
    playing.up(9)
    playing.step(1)
    report = json.loads(playing.report())
    # Put down and lifted; a click for the press, and a softer one for the release.
    assert report["fingers_down"] == 1
    assert (report["touches"], report["refused_touches"], report["cues"]) == (2, 0, 2)
    assert report["seconds"] == playing.time_s and report["felt"]["looks"] == 1
    assert json.loads(playing.done.json) == report
    assert playing.done.text.startswith("hudin-2012: ")


@pytest.mark.parametrize(
    ("field", "call"),
    [
        ("finger", lambda playing: playing.down(1, PLACE)),
        ("finger", lambda playing: playing.down(-1, PLACE)),
        ("finger", lambda playing: playing.move(2, PLACE)),
        ("finger", lambda playing: playing.up(2)),
        ("at_m", lambda playing: playing.down(2, (0.2, 0.05))),
        ("at_m", lambda playing: playing.move(1, (math.nan, 0.05))),
        ("at_m", lambda playing: playing.down(2, "here")),
        ("force_n", lambda playing: playing.down(2, PLACE, None, 101.0)),
        ("time_s", lambda playing: playing.down(2, PLACE, 0.0)),
        ("time_s", lambda playing: playing.down(2, PLACE, math.inf)),
        ("time_s", lambda playing: playing.up(1, playing.time_s)),
        ("blocks", lambda playing: playing.step(-1)),
        ("blocks", lambda playing: playing.step(0.5)),
        ("blocks", lambda playing: playing.step(10**12)),
    ],
)
def test_touches_that_cannot_be_are_refused(
    film: ur.Surface, field: str, call: Callable[[Any], object]
) -> None:
    """The error names the argument, and nothing of it is played."""
    playing = player(film)
    playing.step(10)
    # Its time is to come.
    playing.down(1, PLACE, 0.5)
    with pytest.raises(AskError) as refused:
        call(playing)
    assert refused.value.field == field
    assert not np.any(playing.step(10))
    assert playing.step(0).shape == (ACTUATORS, 0)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (("no-such-effect", "time-reversal", WINDOW, BLOCK, False), InputError),
        (("click-button", "no-such-method", WINDOW, BLOCK, False), InputError),
        (("click-button", "time-reversal", 0.0, BLOCK, False), AskError),
        (("click-button", "time-reversal", 11.0, BLOCK, False), AskError),
        (("click-button", "time-reversal", math.nan, BLOCK, False), AskError),
        (("click-button", "time-reversal", WINDOW, 7, False), AskError),
        (("click-button", "time-reversal", WINDOW, 10_000, False), AskError),
    ],
)
def test_a_player_that_cannot_be_is_refused(
    film: ur.Surface, arguments: tuple[Any, ...], error: type[Exception]
) -> None:
    """Effects, methods, windows and blocks that there are not."""
    with pytest.raises(error):
        _unripple.Player(raw(film), *arguments)
