"""What is wrong is said by typed errors, with places and what is nearest; warnings are warnings."""

from __future__ import annotations

import gc
import pickle
import warnings
import weakref
from pathlib import Path

import numpy as np
import pytest

import unripple as ur

_WRONG = """\
format = 1

[outline]
rectangle_mm = [120, 80]
edge = "clampd"

[sheet]
material = "glass"
thicknes_mm = 0.5
thickness_mm = -0.5
loss_factor = 0.01

[drive]
band_hz = [0, 9000]

[[actuator]]
at_mm = [12, 31]
"""


def test_all_faults_of_a_file_come_at_once_with_their_places(folder: Path) -> None:
    file = folder / "plate.toml"
    file.write_text(_WRONG, encoding="utf-8")
    with pytest.raises(ur.SurfaceError) as raised:
        ur.Surface(file)
    error = raised.value
    assert isinstance(error, ur.InputError) and isinstance(error, ValueError)
    assert error.path.endswith("plate.toml")
    faults = {fault.key: fault for fault in error.faults}
    assert set(faults) == {"outline.edge", "sheet.thicknes_mm", "sheet.thickness_mm"}
    for key, fault in faults.items():
        name = key.rpartition(".")[2]
        assert _WRONG.splitlines()[fault.line - 1].startswith(name), fault
        # The place of the value, or that of a key that is not known.
        rest = _WRONG.splitlines()[fault.line - 1][fault.column - 1 :]
        assert rest.startswith((name, '"', "-")), fault
        assert f":{fault.line}:{fault.column}: " in str(error)
    assert faults["outline.edge"].nearest == '"clamped"'
    assert faults["sheet.thicknes_mm"].nearest == "thickness_mm"
    assert faults["sheet.thickness_mm"].found == "-0.5"


def test_check_lists_them_without_raising(folder: Path) -> None:
    (folder / "plate.toml").write_text(_WRONG, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ur.UnrippleWarning)
        report = ur.check("plate.toml")
    assert report.ok is False and len(report.faults) == 3
    assert report.failure is not None


def test_keywords_have_faults_too() -> None:
    with pytest.raises(ur.SurfaceError) as raised:
        ur.Surface("hudin-2012", thickness_mm=-0.1, edge="clampd")
    assert {fault.key for fault in raised.value.faults} == {"outline.edge", "sheet.thickness_mm"}
    with pytest.raises(ur.SurfaceError) as raised:
        ur.Surface("hudin-2012").with_(thickness_mm=-0.1)
    assert [fault.key for fault in raised.value.faults] == ["sheet.thickness_mm"]


@pytest.mark.parametrize(
    ("call", "nearest"),
    [
        (lambda film: film.modes(max_hertz=300), "max_hz"),
        (lambda film: film.focus([(62, 90)], window_m=30), "window_ms"),
        (lambda film: ur.Surface("hudin-2012", tension_n_per_mm=220), "tension_n_per_m"),
        (lambda film: film.with_(thicknes_mm=1), "thickness_mm"),
        (lambda film: ur.run("field", surface=film, drve="drive.wav"), "drive"),
    ],
)
def test_a_name_that_is_not_known_is_a_type_error_with_the_nearest(call, nearest: str, film: ur.Surface) -> None:
    with pytest.raises(ur.OptionError, match=f"nearest: {nearest}") as raised:
        call(film)
    assert isinstance(raised.value, TypeError) and isinstance(raised.value, ur.UnrippleError)


@pytest.mark.parametrize(
    "call",
    [
        lambda film: film.modes(max_hz="many"),
        lambda film: film.modes(max_hz=True),
        lambda film: film.focus(62),
        lambda film: film.focus([(62, 90)], no_figures="yes"),
        lambda film: film.focus([(62, 90)], output=3),
        lambda film: film.modes(threads=0),
        lambda film: film.modes(progress=3),
        lambda film: ur.Drive("noise", rate_hz=48000),
        lambda film: ur.Drive(np.zeros(3), rate_hz=48000),
        lambda film: ur.Surface("hudin-2012", sheet=3),
        lambda film: ur.Responses(),
        lambda film: ur.Field(),
    ],
)
def test_a_value_of_another_type_is_a_type_error(call, film: ur.Surface) -> None:
    with pytest.raises(ur.OptionError):
        call(film)


@pytest.mark.parametrize(
    ("call", "field"),
    [
        (lambda film: film.modes(max_hz=float("nan")), "max_hz"),
        (lambda film: film.focus([(62, 90)], window_ms=-1), "window_ms"),
        (lambda film: film.focus([(62, 90)], window_s=-1), "window_s"),
        (lambda film: film.focus([(62, 90)], fingers_mm=[(300, 90)]), "fingers_mm"),
        (lambda film: film.focus([(62, 90)], finger=(300, 90)), "finger"),
        (lambda film: film.focus([(62, 90)], peak_um=0), "peak_um"),
        (lambda film: film.focus([(62, 90)], bear_tension_percent=60), "bear_tension_percent"),
        (lambda film: film.focus([]), "at, shape"),
        (lambda film: film.compare([(62, 90)], window_ms=0), "window_ms"),
        (lambda film: film.field(np.ones((8, 9)), period_ms=-2), "period_ms"),
        (lambda film: film.field(np.ones((8, 9)), at=[(62, 90)], at_ms=[1, 2]), "at_ms"),
        (lambda film: film.calibrate("rig", grid_mm=-1), "grid_mm"),
        (lambda film: film.responses(fingers_mm=[(300, 90)]), "fingers_mm"),
        (lambda film: film.responses().impulse((300, 90), 10), "points_mm"),
        (lambda film: film.responses().impulse((62, 90), length_ms=-1), "length_ms"),
        (lambda film: film.virtual(probe_mm=(300, 90)), "probe_mm"),
        (lambda film: film.virtual().touch(1, (300, 90)), "at_mm"),
        (lambda film: film.virtual().watch([(300, 90)]), "points_mm"),
        (lambda film: film.player(window_ms=20_000), "window_ms"),
        (lambda film: film.player(window_ms=20).down(1, (300, 90)), "at_mm"),
        (lambda film: film.focus([(62, 90)], method="concentrated"), "method"),
        (lambda film: film.focus([(62, float("inf"))]), "targets"),
        (lambda film: film.focus([(62, 90, 1, 2, 3)]), "targets"),
    ],
)
def test_a_value_that_makes_no_sense_names_its_field(call, field: str, film: ur.Surface) -> None:
    with pytest.raises((ur.AskError, ur.InputError)) as raised:
        call(film)
    assert isinstance(raised.value, ValueError)
    if isinstance(raised.value, ur.AskError):
        assert raised.value.field == field
        assert raised.value.expected and raised.value.found


@pytest.mark.parametrize(
    "call",
    [
        lambda film: ur.open("no-such-library"),
        lambda film: ur.Surface("hudin-2021"),
        lambda film: film.field("no-such-drive.wav"),
        lambda film: film.focus([(1000, 1000)]),
        lambda film: film.focus([]),
        lambda film: ur.Drive(np.full((8, 10), np.nan), rate_hz=48000),
        lambda film: ur.Drive(np.zeros((8, 10)), rate_hz=-1),
        lambda film: ur.Drive(np.zeros((8, 10)), rate_hz=48000, names=["a1"]),
        lambda film: ur.run("fokus"),
        lambda film: ur.materials("no-such-material"),
    ],
)
def test_input_that_cannot_be_used_is_a_value_error(call, film: ur.Surface) -> None:
    with pytest.raises(ur.UnrippleError) as raised:
        call(film)
    assert isinstance(raised.value, (ValueError, TypeError))
    assert str(raised.value) and "PanicException" not in type(raised.value).__name__


def test_a_value_is_shown_as_it_was_given(film: ur.Surface) -> None:
    with pytest.raises(ur.AskError, match=r"^window_ms: expected a number above 0 s, found -1 \(-0.001\)$"):
        film.focus([(62, 90)], window_ms=-1)
    # Where the two are the same, once.
    with pytest.raises(ur.AskError, match=r"^window_s: expected a number above 0 s, found -1$"):
        film.focus([(62, 90)], window_s=-1)
    with pytest.raises(ur.AskError, match=r"fingers_mm: .*300.*nearest"):
        film.focus([(62, 90)], fingers_mm=[(300, 90)])
    # Texts that name other fields name their options.
    with pytest.raises(ur.AskError, match="finger_aware: expected `finger` with it"):
        film.focus([(62, 90)], finger_aware=True)
    with pytest.raises(ur.WorkError, match="^`window_ms`: expected at least"):
        film.focus([(62, 90)], window_ms=0.03)


def test_errors_can_be_sent_to_other_processes(folder: Path) -> None:
    (folder / "plate.toml").write_text(_WRONG, encoding="utf-8")
    calls = [
        lambda: ur.Surface("plate.toml"),
        lambda: ur.modes("hudin-2012", max_hz=float("nan")),
        lambda: ur.modes("hudin-2012", max_hertz=3),
        lambda: ur.open("no-such-library"),
    ]
    for call in calls:
        with pytest.raises(ur.UnrippleError) as raised:
            call()
        again = pickle.loads(pickle.dumps(raised.value))
        assert type(again) is type(raised.value) and str(again) == str(raised.value)
        assert getattr(again, "faults", ()) == getattr(raised.value, "faults", ())


def test_a_doubtful_library_warns(library: Path, folder: Path) -> None:
    import shutil

    doubtful = folder / "doubtful"
    shutil.copytree(library, doubtful)
    (doubtful / "calibration").mkdir(exist_ok=True)
    # A record that cannot be read is a reason to doubt.
    (doubtful / "calibration" / "zarr.json").write_text("{}", encoding="utf-8")
    with pytest.warns(ur.UnrippleWarning, match="doubtful") as caught:
        responses = ur.open(doubtful)
    # The warning is said to come from the line that called.
    assert caught[0].filename == __file__
    assert responses.kind == "sampled"


def test_a_report_that_counts_as_failed_warns(folder: Path) -> None:
    (folder / "plate.toml").write_text(_WRONG, encoding="utf-8")
    with pytest.warns(ur.UnrippleWarning) as caught:
        ur.check("plate.toml")
    assert caught[0].filename == __file__


def test_metres_in_place_of_mm_are_warned_of() -> None:
    film = ur.Surface("hudin-2012", band_hz=[0, 300])
    with pytest.warns(ur.UnrippleWarning, match="given in mm"), pytest.raises(ur.InputError):
        film.focus([(0.062, 0.09)], window_ms=20)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        film.focus([(62, 90)], window_ms=20, method="time_reversal")
        assert len(film.focus(zip([62, 90], [90, 40], strict=True), window_ms=20).report.targets) == 2


def test_points_that_are_the_same_are_refused() -> None:
    with pytest.raises(ur.AskError, match="the same at 0 and 1"):
        ur.Responses.from_numpy(
            np.ones((2, 1, 9), np.float32),
            rate_hz=48000,
            points_mm=[(30, 40), (30, 40)],
            actuators_mm=[(10, 10)],
            lambda_min_mm=20,
        )


def test_what_cannot_be_pickled_says_what_to_keep() -> None:
    film = ur.Surface("hudin-2012", band_hz=[0, 300])
    field = film.field(film.focus([(62, 90)], window_ms=20))
    for thing in (field, film.virtual(), film.player("sandpaper")):
        with pytest.raises(TypeError, match="keep its surface"):
            pickle.dumps(thing)


def test_a_drive_is_played_to_whole_blocks() -> None:
    film = ur.Surface("hudin-2012", band_hz=[0, 300])
    rig = film.virtual(block=64)
    sensors, probe = rig.exchange(ur.Drive(np.ones((8, 100)), rate_hz=48000, names=film.names))
    assert sensors.shape == (8, 128) and probe.shape == (128,)
    # Lists and whole numbers are converted.
    assert rig.exchange([[0] * 64] * 8)[1].shape == (64,)
    assert rig.exchange(np.zeros((8, 64), int))[1].shape == (64,)


def test_a_drive_of_another_rate_or_surface_is_not_played() -> None:
    film = ur.Surface("hudin-2012", band_hz=[0, 300])
    rig, samples = film.virtual(block=64), np.ones((8, 64))
    with pytest.raises(ur.AskError, match="rate_hz"):
        rig.exchange(ur.Drive(samples, rate_hz=8000, names=film.names))
    with pytest.raises(ur.AskError, match="names"):
        rig.exchange(ur.Drive(samples, rate_hz=48000, names=[f"b{i}" for i in range(8)]))


def test_surfaces_that_nobody_has_any_more_are_gone() -> None:
    film = ur.Surface("hudin-2012", band_hz=[0, 300])
    film.focus([(62, 90)], window_ms=20)
    gone = weakref.ref(film)
    gc.disable()
    try:
        del film
        assert gone() is None
    finally:
        gc.enable()
