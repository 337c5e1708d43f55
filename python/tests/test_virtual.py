"""The simulated surface, stepped from Python block by block."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import unripple as ur
from unripple import _unripple
from unripple._errors import AskError, InputError

#: Samples per second, samples of a block, actuators of the film, and a place on it in metres.
RATE = 48_000
BLOCK = 64
ACTUATORS = 8
PLACE = (0.062, 0.090)


@pytest.fixture(scope="module")
def film() -> ur.Surface:
    """The paper's film, in a band low enough to be quick."""
    return ur.Surface("hudin-2012", band_hz=[0, 1500])


def raw(surface: ur.Surface) -> Any:
    """The surface as the library in Rust has it."""
    return _unripple.Surface(json.dumps(surface.as_ask()))


def virtual(surface: ur.Surface, block: int = BLOCK, **options: Any) -> Any:
    """A simulated surface."""
    return _unripple.VirtualSurface(raw(surface), block, **options)


@pytest.fixture(scope="module")
def shared(film: ur.Surface) -> Any:
    """One simulated surface for many tests, since making it takes longer than they do."""
    return virtual(film)


def noise(blocks: int, seed: int = 1) -> npt.NDArray[np.float32]:
    """A random drive of so many blocks."""
    return np.random.default_rng(seed).uniform(-1, 1, (ACTUATORS, blocks * BLOCK)).astype(np.float32)


def impulse(blocks: int, actuator: int = 0) -> npt.NDArray[np.float32]:
    """An impulse to one actuator."""
    drive = np.zeros((ACTUATORS, blocks * BLOCK), dtype=np.float32)
    drive[actuator, 0] = 0.5
    return drive


def rms(values: npt.NDArray[Any]) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(np.square(values, dtype=np.float64))))


def apart(found: npt.NDArray[Any], exact: npt.NDArray[Any]) -> float:
    """Largest difference, relative to the largest of the second."""
    difference = np.asarray(found, dtype=np.float64) - exact
    return float(np.max(np.abs(difference)) / np.max(np.abs(exact)))


def test_one_call_plays_what_many_play(film: ur.Surface) -> None:
    """The same samples come out of one call, of a call for each block, and of a surface with other blocks."""
    surface, drive = virtual(film), noise(40)
    assert (surface.names, surface.rate_hz, surface.block) == (film.names, RATE, BLOCK)
    sensors, probe = surface.exchange(drive)
    assert sensors.shape == drive.shape and probe.shape == drive.shape[1:]
    assert sensors.dtype == probe.dtype == np.float32 and np.any(probe)
    assert (surface.samples, surface.time_s) == (40 * BLOCK, 40 * BLOCK / RATE)
    surface.rest()
    assert (surface.samples, surface.time_s) == (0, 0.0)
    short = virtual(film, 16)
    for stepped, block in ((surface, BLOCK), (short, 16)):
        parts = [stepped.exchange(drive[:, i : i + block]) for i in range(0, drive.shape[1], block)]
        np.testing.assert_array_equal(np.concatenate([part[0] for part in parts], axis=1), sensors)
        np.testing.assert_array_equal(np.concatenate([part[1] for part in parts]), probe)


def test_a_drive_may_have_any_layout_and_precision(film: ur.Surface) -> None:
    """Rows in any order of memory, and float64, are the same numbers; no samples at all are a drive, too."""
    surface, drive = virtual(film), noise(4)
    sensors, probe = surface.exchange(drive)
    reversed_twice = np.ascontiguousarray(drive[::-1, ::-1])[::-1, ::-1]
    for other in (np.asfortranarray(drive), drive.astype(np.float64), reversed_twice):
        surface.rest()
        again = surface.exchange(other)
        np.testing.assert_array_equal(again[0], sensors)
        np.testing.assert_array_equal(again[1], probe)
    sensors, probe = surface.exchange(drive[:, :0])
    assert sensors.shape == (ACTUATORS, 0) and probe.shape == (0,)
    assert surface.samples == 4 * BLOCK


def test_the_result_is_the_caller_s_own(film: ur.Surface) -> None:
    """What a call returned is not touched by later calls, nor is the drive that it was given."""
    surface, drive = virtual(film), noise(1)
    given = drive.copy()
    sensors, probe = surface.exchange(drive)
    kept = sensors.copy(), probe.copy()
    surface.exchange(drive)
    np.testing.assert_array_equal(drive, given)
    np.testing.assert_array_equal(sensors, kept[0])
    np.testing.assert_array_equal(probe, kept[1])


def test_a_focus_reaches_the_velocity_that_its_field_says(film: ur.Surface) -> None:
    """The simulation in time and the field from the modes are different code for the same motion.

    Both solve the modes to a millionth of their frequencies, which after 30 ms may put a wave of 1500 Hz out
    of phase by 3e-4.
    """
    drive = film.focus((62, 90), window_ms=20)
    field = film.field(drive, judge_hz=1500)
    samples = math.ceil(0.030 * RATE / BLOCK) * BLOCK
    expected = field.traces((62, 90), until_ms=1e3 * (samples - 1) / RATE).velocity[0]
    played = np.zeros((ACTUATORS, samples))
    played[:, : np.asarray(drive).shape[1]] = np.asarray(drive)
    surface = virtual(film, probe_m=PLACE)
    _, probe = surface.exchange(played)
    assert probe.shape == expected.shape
    assert apart(probe, expected) < 1e-3
    focal = round(float(drive.focal_time or 0) * RATE)
    assert abs(int(np.argmax(np.abs(probe))) - focal) <= 1
    # A probe that is moved hears the other place.
    surface.rest()
    surface.probe((0.030, 0.040))
    there = field.traces((30, 40), until_ms=1e3 * (samples - 1) / RATE).velocity[0]
    assert apart(surface.exchange(played)[1], there) < 1e-3


def test_a_finger_damps_what_is_under_it(film: ur.Surface) -> None:
    """A fingertip is stiffer than the film; one without mass, damping and stiffness changes nothing."""
    surface = virtual(film, probe_m=PLACE)
    free = surface.exchange(impulse(20))[1]
    surface.rest()
    surface.touch(7, PLACE, (0.0, 0.0, 0.0, 0.005))
    assert apart(surface.exchange(impulse(20))[1], free) < 1e-6
    surface.rest()
    surface.touch(7, PLACE)
    under = surface.exchange(impulse(20))[1]
    # It has come after 8 ms, 384 samples.
    assert rms(under[400:]) < 0.5 * rms(free[400:])
    grip, _force, _velocity, displacement, power = surface.finger_motion(7)
    assert grip == 1.0 and displacement != 0.0 and math.isfinite(power)
    surface.move(7, (0.030, 0.040))
    surface.lift(7)
    assert surface.finger_motion(7) is None
    surface.touch(7, PLACE)
    with pytest.raises(InputError, match="one that is not down"):
        surface.touch(7, PLACE)


def test_fingers_have_a_bound(film: ur.Surface) -> None:
    """There are as many fingers as were asked for, those that are being lifted included."""
    surface = virtual(film, fingers=1)
    surface.touch(1, PLACE)
    surface.lift(1)
    with pytest.raises(InputError, match="fingers at once"):
        surface.touch(2, PLACE)
    surface.exchange(np.zeros((ACTUATORS, 10 * BLOCK), dtype=np.float32))
    surface.touch(2, PLACE)


def test_displacement_is_watched(film: ur.Surface) -> None:
    """What is watched is the sum of the velocity; each look has what came since the last."""
    surface = virtual(film, probe_m=PLACE)
    assert surface.watched().shape == (0, 0)
    surface.watch(np.array([PLACE, (0.020, 0.033)]), 2)
    probe = surface.exchange(impulse(20))[1].astype(np.float64)
    seen = surface.watched()
    assert seen.shape == (2, 10 * BLOCK) and seen.dtype == np.float32
    summed = np.concatenate([[0.0], np.cumsum(0.5 * (probe[:-1] + probe[1:])) / RATE])
    # The trapezium rule is off by (ωΔt)²/12, 0.3 % at the top of the band.
    assert apart(seen[0], summed[::2]) < 0.01
    assert surface.watched().shape == (2, 0)


def test_a_tap_is_heard_by_all_sensors(film: ur.Surface) -> None:
    """A tap moves the film from its time on, and another may not share its block."""
    surface, silent = virtual(film), np.zeros((ACTUATORS, 20 * BLOCK), dtype=np.float32)
    surface.tap(PLACE, 1.0, 1e-3, 5 * BLOCK / RATE)
    with pytest.raises(InputError, match="taps at once"):
        surface.tap(PLACE, 1.0, 1e-3, 5 * BLOCK / RATE)
    sensors, probe = surface.exchange(silent)
    assert not np.any(sensors[:, : 5 * BLOCK]) and not np.any(probe[: 5 * BLOCK])
    assert np.all(np.any(sensors[:, 5 * BLOCK :], axis=1))


def test_a_seed_makes_one_hidden_surface() -> None:
    """One seed gives the same surface and noise each time, another gives others; none gives the surface."""
    low = ur.Surface("hudin-2012", band_hz=[0, 600])
    surfaces = [virtual(low, seed=seed) for seed in (3, 3, 4, None)]
    first, same, other, plain = (surface.exchange(impulse(20))[0] for surface in surfaces)
    np.testing.assert_array_equal(first, same)
    assert apart(first, other) > 0.01 and apart(first, plain) > 0.01 and apart(other, plain) > 0.01
    hidden = surfaces[0]
    noises = []
    for seed in (None, 5, 6, 5):
        hidden.rest(seed)
        noises.append(hidden.exchange(impulse(20))[0])
    np.testing.assert_array_equal(noises[0], first)
    np.testing.assert_array_equal(noises[1], noises[3])
    assert np.any(noises[1] != noises[2])


@pytest.mark.parametrize(
    "call",
    [
        lambda surface: surface.exchange(np.zeros((ACTUATORS, BLOCK - 1), dtype=np.float32)),
        lambda surface: surface.exchange(np.zeros((ACTUATORS - 1, BLOCK), dtype=np.float32)),
        lambda surface: surface.exchange(np.zeros(BLOCK, dtype=np.float32)),
        lambda surface: surface.exchange(np.zeros((ACTUATORS, BLOCK), dtype=np.complex128)),
        lambda surface: surface.exchange(np.full((ACTUATORS, BLOCK), np.nan, dtype=np.float32)),
        lambda surface: surface.exchange("a drive"),
        lambda surface: surface.exchange(None),
        lambda surface: surface.touch(-1, PLACE),
        lambda surface: surface.touch(1 << 64, PLACE),
        lambda surface: surface.touch(1.5, PLACE),
        lambda surface: surface.touch(1, (0.150001, 0.05)),
        lambda surface: surface.touch(1, (math.nan, 0.05)),
        lambda surface: surface.touch(1, (0.05, 10**400)),
        lambda surface: surface.touch(1, (0.05,)),
        lambda surface: surface.touch(1, None),
        lambda surface: surface.touch(1, PLACE, (1e-4, 1.0, -1.0, 5e-3)),
        lambda surface: surface.touch(1, PLACE, (1e-4, 1.0)),
        lambda surface: surface.move(1, PLACE),
        lambda surface: surface.lift(1),
        lambda surface: surface.probe((0.05, -1e-6)),
        lambda surface: surface.tap(PLACE, math.inf, 1e-3),
        lambda surface: surface.tap(PLACE, 1.0, 0.0),
        lambda surface: surface.tap(PLACE, 1.0, 1e-3, -1.0),
        lambda surface: surface.tap(PLACE, 1.0, 1e-3, 1e9),
        lambda surface: surface.watch(np.array([[0.2, 0.05]])),
        lambda surface: surface.watch(np.zeros((2, 3))),
        lambda surface: surface.watch(np.full((5000, 2), 0.05)),
        lambda surface: surface.watch(np.array([PLACE]), 0),
        lambda surface: surface.rest(-1),
    ],
)
def test_what_cannot_be_is_refused(shared: Any, call: Callable[[Any], object]) -> None:
    """Every argument that makes no sense is an error of ours, and leaves the surface as it was."""
    shared.rest()
    expected = shared.exchange(impulse(2))[1]
    shared.rest()
    with pytest.raises((AskError, InputError)):
        call(shared)
    np.testing.assert_array_equal(shared.exchange(impulse(2))[1], expected)


@pytest.mark.parametrize(
    ("field", "options"),
    [
        ("block", {"block": 0}),
        ("block", {"block": 1_000_001}),
        ("block", {"block": "many"}),
        ("max_hz", {"max_hz": math.nan}),
        ("max_hz", {"max_hz": -5.0}),
        ("seed", {"seed": -1}),
        ("probe_m", {"probe_m": (0.2, 0.05)}),
        ("fingers", {"fingers": 65}),
    ],
)
def test_a_surface_that_cannot_be_is_refused(film: ur.Surface, field: str, options: dict[str, Any]) -> None:
    """The error names the argument."""
    with pytest.raises(AskError) as refused:
        virtual(film, **options)
    assert refused.value.field == field


def test_threads_step_surfaces_at_once(film: ur.Surface) -> None:
    """Two surfaces in two threads do what they do one after the other; one in four threads loses no block."""
    surfaces, drives = [virtual(film), virtual(film)], [noise(300, 2), noise(300, 3)]
    alone = [surface.exchange(drive)[1] for surface, drive in zip(surfaces, drives, strict=True)]

    def stepped(number: int) -> npt.NDArray[np.float32]:
        surface, drive = surfaces[number], drives[number]
        surface.rest()
        spans = range(0, drive.shape[1], BLOCK)
        return np.concatenate([surface.exchange(drive[:, i : i + BLOCK])[1] for i in spans])

    with ThreadPoolExecutor(4) as pool:
        both = [pool.submit(stepped, number) for number in range(2)]
        for found, expected in zip(both, alone, strict=True):
            np.testing.assert_array_equal(found.result(timeout=60), expected)

        one = surfaces[0]
        one.rest()

        def meddled(number: int) -> None:
            one.touch(number, PLACE)
            for _ in range(50):
                one.exchange(drives[1][:, :BLOCK])
                one.move(number, (0.05 + 0.01 * number, 0.06))
                assert one.samples >= BLOCK
            one.lift(number)

        for done in [pool.submit(meddled, number) for number in range(4)]:
            done.result(timeout=60)
    assert one.samples == 4 * 50 * BLOCK
