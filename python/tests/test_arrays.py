"""Arrays between NumPy and Rust: shared memory, layouts, refused values, what responses and fields hold."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple import _unripple as rust

#: Forces on a rectangle, whose modes can be summed by hand; a narrow band and a low rate, to be quick.
FILM = """
format = 1
name = "small film"
[outline]
rectangle_mm = [120, 80]
[sheet]
material = "BoPET"
thickness_mm = 0.1
tension_n_per_m = 150
decay_time_ms = 60
[drive]
band_hz = [0, 1200]
sample_rate_hz = 12000
[[actuator]]
name = "left"
at_mm = [9, 22]
[[actuator]]
name = "top"
at_mm = [31, 71]
[[actuator]]
name = "right"
at_mm = [112, 35]
"""
#: Samples per second, and names of the actuators.
RATE = 12000.0
NAMES = ["left", "top", "right"]
#: A point of the library's grid, in m.
TARGET = [0.05, 0.04]
#: A focus there, in time for all of its field to be known.
FOCUS = {"points": [{"at_m": TARGET}], "window_s": 0.02, "no_figures": True}


@pytest.fixture(scope="module")
def surface() -> Any:
    """The film."""
    return rust.Surface(json.dumps({"toml": FILM, "name": "film.toml"}))


@pytest.fixture(scope="module")
def modal(surface: Any) -> Any:
    """Its modes."""
    return rust.Responses.of_surface(surface)


@pytest.fixture(scope="module")
def library(surface: Any, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Its samples at the points of a grid of 10 mm."""
    folder = tmp_path_factory.mktemp("responses") / "library"
    ask = {"surface": json.loads(surface.ask), "pitch_m": 0.01, "length_s": 0.05, "output": str(folder)}
    rust.run("respond", json.dumps(ask), None, None)
    return rust.Responses.open(str(folder), None)


@pytest.fixture(scope="module")
def field(modal: Any) -> Any:
    """What a focus does to it."""
    drive = modal.focus(json.dumps(FOCUS)).drive
    return modal.field(json.dumps({"points_m": [TARGET], "no_figures": True}), drive)


def is_sealed(array: Any) -> bool:
    """Whether nobody can write to an array, nor allow that."""
    with pytest.raises(ValueError):
        array.setflags(write=True)
    return not array.flags.writeable


def report(done: Any) -> Any:
    """A report without what differs from run to run."""
    found = json.loads(done.json)
    found.get("run", {}).pop("date", None)
    return found


def in_a_record(values: Any) -> Any:
    """The values as one field of records, 12 bytes apart and seldom aligned."""
    records = np.zeros(values.shape, dtype=[("mark", "i4"), ("value", "f8")])
    records["value"] = values
    return records["value"]


def read_only(values: Any) -> Any:
    """The values in an array that nobody can write to."""
    copy = values.copy()
    copy.setflags(write=False)
    return copy


#: The same numbers in many ways.
LAYOUTS: list[Callable[[Any], Any]] = [
    lambda values: values,
    lambda values: values.astype(np.float32),
    np.asfortranarray,
    lambda values: np.asfortranarray(values.astype(np.float32)),
    lambda values: np.repeat(values, 2, axis=1)[:, ::2],
    lambda values: values[::-1, ::-1],
    lambda values: values.T.copy().T,
    in_a_record,
    read_only,
]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout_of_numbers_is_read_as_it_is(layout: Callable[[Any], Any]) -> None:
    """Either precision, either order, steps of any sign and size, aligned or not."""
    given = layout(np.arange(24.0).reshape(3, 8) / 4.0)
    assert np.array_equal(rust.Drive(given, RATE, NAMES).samples, given)


def test_a_drive_has_one_array_that_nobody_can_write_to() -> None:
    """It is made once, and is the drive's own."""
    given = np.arange(12.0).reshape(3, 4)
    drive = rust.Drive(given, RATE, NAMES)
    samples = drive.samples
    assert samples.dtype == np.float64 and samples.shape == (3, 4) and samples.flags.c_contiguous
    assert np.shares_memory(samples, drive.samples) and is_sealed(samples)
    # Whoever has it may change its shape, which is nobody else's.
    samples.shape = (4, 3)
    samples = drive.samples
    assert samples.shape == (3, 4) and samples[2, 3] == 11.0
    # It is the drive's own: what was given may change.
    given[0, 0] = 99.0
    assert samples[0, 0] == 0.0
    assert (drive.rate_hz, drive.names, drive.peak) == (RATE, NAMES, 11.0)
    assert drive.rms == pytest.approx(np.sqrt(np.mean(samples**2)))
    assert drive.energy == pytest.approx(np.sum(samples**2) / RATE)
    del drive
    assert samples[2, 3] == 11.0


#: What is no drive of three actuators.
WRONG = [
    [[0.0, 1.0]] * 3,
    None,
    np.zeros((3, 4), dtype=np.int64),
    np.zeros((3, 4), dtype=np.complex128),
    np.zeros((3, 4), dtype=">f8"),
    np.zeros(3),
    np.zeros((3, 4, 1)),
    np.zeros((0, 4)),
    np.zeros((3, 0)),
    np.full((3, 4), np.nan),
    np.full((3, 4), np.inf, dtype=np.float32),
]


@pytest.mark.parametrize("samples", WRONG, ids=range(len(WRONG)))
def test_what_is_no_drive_is_refused(samples: Any) -> None:
    """Other objects, other numbers, other shapes, and values that are not finite."""
    with pytest.raises(ur.InputError, match="samples: expected"):
        rust.Drive(samples, RATE, NAMES)


def test_a_value_that_is_not_finite_is_named_by_its_place() -> None:
    """In whatever order the values lie in memory."""
    samples = np.zeros((3, 4))
    samples[1, 2] = np.nan
    with pytest.raises(ur.InputError, match=r"found NaN at \[1, 2\]"):
        rust.Drive(samples, RATE, NAMES)
    # Fortran order has the same places.
    with pytest.raises(ur.InputError, match=r"found NaN at \[1, 2\]"):
        rust.Drive(np.asfortranarray(samples), RATE, NAMES)


@pytest.mark.parametrize(
    ("rate", "names"), [(0.0, 3), (-1.0, 3), (np.nan, 3), (np.inf, 3), (RATE, 2), (RATE, 4), (RATE, 0)]
)
def test_a_drive_has_a_rate_and_a_name_for_each_channel(rate: float, names: int) -> None:
    """Rates are above 0 and finite."""
    with pytest.raises(ur.InputError):
        rust.Drive(np.zeros((3, 4)), rate, [f"a{i}" for i in range(names)])


def test_a_drive_comes_back_from_its_file(tmp_path: Path) -> None:
    """Single precision is what the file holds."""
    samples = np.linspace(-1.0, 1.0, 30, dtype=np.float32).reshape(3, 10)
    path = tmp_path / "drive.wav"
    rust.Drive(samples, RATE, NAMES).to_wav(path)
    back = rust.read_wav(path, NAMES)
    assert back.names == NAMES and back.rate_hz == RATE and np.array_equal(back.samples, samples)
    assert rust.read_wav(str(path)).names == ["a1", "a2", "a3"]
    with pytest.raises(ur.InputError, match="3 channels"):
        rust.read_wav(path, ["a1"])
    with pytest.raises(ur.InputError, match="none.wav"):
        rust.read_wav(tmp_path / "none.wav")


def test_a_library_shares_its_samples(library: Any) -> None:
    """Its array is the library's own memory, which lives as long as the array."""
    array = library.array
    points, actuators = library.points_m, library.actuators_m
    assert array.dtype == np.float32 and array.shape == (len(points), 3, library.samples) == (77, 3, 601)
    assert np.shares_memory(array, library.array) and is_sealed(array)
    assert array.flags.c_contiguous and points.shape == (77, 2) and is_sealed(points) and is_sealed(actuators)
    assert library.kind == "sampled" and library.frequencies_hz is None and library.input is None
    # The array keeps what it shares alive.
    path, first = library.source, array[0].copy()
    again = rust.Responses.open(path, None)
    alone = again.array
    del again
    assert np.array_equal(alone[0], first)


def test_responses_of_modes_are_their_sums(modal: Any) -> None:
    """A response is the sum over modes of input weight, shape and decaying oscillation."""
    omega, sigma, weights = 2.0 * np.pi * modal.frequencies_hz, 1.0 / modal.decay_times_s, modal.input
    assert weights.shape == (3, len(omega)) and is_sealed(weights) and is_sealed(modal.frequencies_hz)
    assert (modal.kind, modal.array, modal.points_m, modal.samples) == ("modal", None, None, None)
    # A force drives a mode by its shape at the force's place: at the actuators the shapes are known.
    found = modal.impulse(modal.actuators_m, 0.02)
    assert found.shape == (3, 3, 241) and found.dtype == np.float32 and is_sealed(found)
    time = np.arange(241)[:, None] / RATE
    damped = np.sqrt(omega**2 - sigma**2)
    rings = np.exp(-sigma * time) * (np.cos(damped * time) - sigma / damped * np.sin(damped * time))
    expected = np.einsum("pm,am,tm->pat", weights, weights, rings)
    bound = np.einsum("pm,am->pa", np.abs(weights), np.abs(weights)).max()
    assert np.abs(found - expected).max() < 1e-5 * bound
    # Reciprocity: what one does to the place of another, the other does to its own.
    assert np.allclose(found, found.transpose(1, 0, 2), atol=1e-5 * bound)


def test_responses_of_a_library_are_those_of_its_points(modal: Any, library: Any) -> None:
    """Between its points they are interpolated."""
    some = library.points_m[[3, 40, 76]]
    found = library.impulse(some, 0.05)
    assert np.array_equal(found, library.array[[3, 40, 76]])
    assert np.array_equal(library.impulse(some, 0.01), library.array[[3, 40, 76], :, :121])
    # Between them they are nearly those of the model.
    between = np.array([[0.052, 0.037]])
    model, guessed = modal.impulse(between, 0.05), library.impulse(between, 0.05)
    assert np.std(guessed - model) < 0.5 * np.std(model)
    assert library.impulse(np.empty((0, 2)), 0.01).shape == (0, 3, 121)


@pytest.mark.parametrize("length", [0.0, -1.0, np.nan, np.inf, 1e9, 1e300])
@pytest.mark.parametrize("kind", ["modal", "library"])
def test_lengths_that_make_no_sense_are_refused(
    kind: str, length: float, request: pytest.FixtureRequest
) -> None:
    """Among them those that no memory holds."""
    with pytest.raises(ur.AskError, match="length_s"):
        request.getfixturevalue(kind).impulse(np.array([TARGET]), length)


@pytest.mark.parametrize("at", [[-1e-3, 0.0], [0.2, 0.04], [1e300, -1e300]])
@pytest.mark.parametrize("kind", ["modal", "library"])
def test_places_beyond_the_rim_are_refused(
    kind: str, at: list[float], request: pytest.FixtureRequest
) -> None:
    """There is nothing that could move."""
    with pytest.raises(ur.AskError, match="points_m"):
        request.getfixturevalue(kind).impulse(np.array([at]), 0.01)


@pytest.mark.parametrize("points", [[TARGET], np.zeros((2, 3)), np.zeros(2), np.array([[np.nan, 0.0]])])
def test_points_are_an_array_of_x_and_y(modal: Any, points: Any) -> None:
    """Everything else is refused."""
    with pytest.raises(ur.InputError, match="points_m"):
        modal.impulse(points, 0.01)


def test_a_library_longer_than_asked_for_is_needed(library: Any) -> None:
    """The longest length is said."""
    with pytest.raises(ur.AskError, match=r"at most 0\.05 s"):
        library.impulse(np.array([TARGET]), 0.0501)


def test_maps_of_a_field_share_memory(field: Any) -> None:
    """They lie on the grid, and nobody can write to them."""
    columns, rows, width, height = field.grid
    cells = field.inside
    assert cells.dtype == np.int64 and len(cells) == len(field.points_m) == columns * rows
    middles = np.stack([(cells % columns + 0.5) * width, (cells // columns + 0.5) * height], axis=1)
    assert np.allclose(field.points_m, middles, atol=1e-12)
    for name, kind in [("peak_velocity", np.float32), ("peak_displacement", np.float32), ("outside", bool)]:
        one, other = getattr(field, name), getattr(field, name)
        assert one.dtype == kind and one.shape == cells.shape
        assert np.shares_memory(one, other) and is_sealed(one)
    figures = json.loads(field.done.json)
    assert field.outside.sum() == figures["outside_points"]
    assert field.felt_db.max() > 0.0 and is_sealed(field.felt_db)
    assert field.rate_hz == RATE and field.known > 241


def test_snapshots_are_what_traces_pass_through(field: Any) -> None:
    """Both are the same motion, on the grid and at points."""
    samples, some = np.array([5, 100, 240]), np.array([0, 17, len(field.points_m) // 2])
    both = field.snapshots((samples / RATE).tolist())
    traces = field.traces(field.points_m[some], 240 / RATE)
    for snapshots, trace in zip(both, traces, strict=True):
        assert snapshots.dtype == np.float32 and snapshots.shape == (3, len(field.points_m))
        assert trace.dtype == np.float64 and trace.shape == (3, 241)
        assert is_sealed(snapshots) and is_sealed(trace)
        assert np.abs(snapshots[:, some] - trace[:, samples].T).max() < 1e-4 * np.abs(snapshots).max()
    # Displacement is the integral of velocity.
    velocity, displacement = traces
    moved = np.cumsum(velocity, axis=1) / RATE
    assert np.corrcoef(moved.ravel(), displacement.ravel())[0, 1] > 0.9


def test_instants_and_points_of_a_field_are_checked(field: Any) -> None:
    """Too early, too late, too many, none, and elsewhere."""
    here = np.array([TARGET])
    for instants in [[-1.0], [np.nan], [np.inf], [1e9], [0.0] * 1_000_000]:
        with pytest.raises(ur.InputError):
            field.snapshots(instants)
    for until in [-1.0, np.nan, np.inf, 1e9, 1e300]:
        with pytest.raises(ur.InputError):
            field.traces(here, until)
    with pytest.raises(ur.InputError):
        field.traces(np.array([[0.5, 0.5]]), 0.01)
    with pytest.raises(ur.AskError, match="instants_s"):
        field.snapshots([])
    with pytest.raises(ur.AskError, match="points_m"):
        field.traces(np.empty((0, 2)), 0.01)


def test_the_field_of_a_library_is_at_its_points(library: Any) -> None:
    """It has no grid."""
    drive = library.focus(json.dumps(FOCUS)).drive
    field = library.field(json.dumps({"points_m": [TARGET], "no_figures": True}), drive)
    assert field.grid is None and field.inside is None and np.array_equal(field.points_m, library.points_m)
    assert field.known >= library.samples and field.peak_velocity.shape == (77,)


def test_reports_are_those_of_the_tasks(surface: Any, modal: Any) -> None:
    """To the last digit, with the record of how they were made."""
    named = {"surface": json.loads(surface.ask)}
    focused = modal.focus(json.dumps(FOCUS))
    assert report(focused.done) == report(rust.run("focus", json.dumps(FOCUS | named), None, None))
    drive = focused.drive
    ask = {"points_m": [TARGET], "instants_s": [0.02], "no_figures": True}
    field = modal.field(json.dumps(ask), drive)
    played = {"channels": drive.samples.tolist(), "rate_hz": drive.rate_hz}
    asked = json.dumps(ask | named | {"drive": played})
    assert report(field.done) == report(rust.run("field", asked, None, None))
    assert focused.figures == {} and field.figures == {}
    drawn = modal.focus(json.dumps(FOCUS | {"no_figures": False})).figures
    assert {"drive", "focus", "traces", "peaks"} <= drawn.keys()
    assert all("<svg" in text for text in drawn.values())
    with pytest.raises(ur.AskError, match="output"):
        modal.focus(json.dumps(FOCUS | {"output": "somewhere"}))


def test_responses_under_fingers_are_evaluated_under_them(surface: Any) -> None:
    """Waveforms and strokes know no fingers."""
    touched = rust.Responses.of_surface(surface, None, [tuple(TARGET)])
    found = json.loads(touched.focus(json.dumps(FOCUS)).done.json)
    # No ask makes a drive from these.
    assert len(found["fingers"]) == 1 and "run" not in found
    with pytest.raises(ur.AskError, match="fingers_m"):
        touched.stroke(json.dumps({"path": {"circle": {"centre_m": TARGET, "radius_m": 0.01}}}))
    with pytest.raises(ur.AskError, match="fingers_m"):
        rust.Responses.of_surface(surface, None, [(0.5, 0.5)])
    for hz in [np.nan, -1.0, 100.0]:
        with pytest.raises(ur.InputError):
            rust.Responses.of_surface(surface, hz)


def test_what_is_no_library_is_not_opened(tmp_path: Path) -> None:
    """A folder without one, and none."""
    for path in [tmp_path, tmp_path / "none"]:
        with pytest.raises(ur.InputError, match="expected a library"):
            rust.Responses.open(path, None)
