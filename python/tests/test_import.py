"""Measurements that other programs have written, or read: each makes the library that they are of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt
import pytest
import pyuff
import scipy.io
import sofar
import soundfile

import unripple as ur

#: Samples per second, and the band that is compared, in which accelerations can be integrated.
RATE = 48000
BAND = (50.0, 500.0)

#: What has to be said of responses that `respond` computed.
SAID: dict[str, Any] = {"unit": "m/s", "per": "newton"}


@pytest.fixture(scope="module")
def known(library: Path) -> dict[str, Any]:
    """Responses of two points of the library, 40 ms long, and where they are."""
    responses = ur.open(library)
    array, points = responses.array, responses.points_m
    assert array is not None and points is not None
    h = array[:2, :, :1920].astype(float)
    return {"h": h, "points_mm": 1e3 * points[:2], "actuators": responses.names}


def _spectra(h: npt.NDArray[Any]) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Frequencies and frequency responses of velocities, above the mean."""
    return np.fft.rfftfreq(h.shape[-1], 1 / RATE)[1:21], np.fft.rfft(h)[..., 1:21] / RATE


def _imported(output: str) -> npt.NDArray[Any]:
    array = ur.open(output).array
    assert array is not None
    return array


def _near(found: npt.NDArray[Any], wanted: npt.NDArray[Any], share: float = 1e-6) -> None:
    assert found.shape == wanted.shape
    assert np.abs(found - wanted).max() <= share * np.abs(wanted).max()


@pytest.fixture
def wanted(film: ur.Surface, known: dict[str, Any]) -> npt.NDArray[Any]:
    """The responses in the band."""
    frequencies, spectra = _spectra(known["h"])
    given = {name: known[name] for name in ("points_mm", "actuators")}
    report = ur.import_measurements(film, spectra, "wanted", frequency_hz=frequencies, band_hz=BAND, **given, **SAID)
    assert (report.kind, report.points, report.actuators) == ("frequency-responses", 2, 8)
    assert report.band_hz == [50, 500]
    return _imported("wanted")


def test_an_array_in_time_is_kept(film: ur.Surface, known: dict[str, Any]) -> None:
    given = {name: known[name] for name in ("points_mm", "actuators")}
    for name, kind, h in [("impulse", "impulse-responses", known["h"]), ("taps", "filters", known["h"] / RATE)]:
        ur.import_measurements(film, h, name, rate_hz=RATE, kind=kind, **given, **SAID)
        _near(_imported(name), known["h"])


def test_the_band_is_that_of_numpy(film: ur.Surface, known: dict[str, Any], wanted: npt.NDArray[Any]) -> None:
    lines = np.fft.rfft(known["h"])
    frequencies = np.fft.rfftfreq(known["h"].shape[-1], 1 / RATE)
    lines[..., (frequencies < BAND[0] - 1) | (frequencies > BAND[1] + 1)] = 0
    _near(wanted, np.fft.irfft(lines, known["h"].shape[-1]))


# pyuff leaves the files that it writes to be closed by the garbage collector.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("binary", [0, 1])
def test_universal_files_of_pyuff(
    film: ur.Surface, known: dict[str, Any], wanted: npt.NDArray[Any], binary: int
) -> None:
    frequencies, spectra = _spectra(known["h"])
    places = np.concatenate([1e-3 * known["points_mm"], film.actuators_m])
    numbers, zeros = list(range(1, len(places) + 1)), [0.0] * len(places)
    file = pyuff.UFF("scan.uff")
    si = {"length": 1.0, "force": 1.0, "temp": 1.0, "temp_offset": 273.15}
    file.write_sets(pyuff.prepare_164(units_code=1, units_description="SI", temp_mode=1, **si), "overwrite")
    ones = [1] * len(places)
    nodes = {"node_nums": numbers, "def_cs": ones, "disp_cs": ones, "color": ones}
    file.write_sets(pyuff.prepare_15(**nodes, x=list(places[:, 0]), y=list(places[:, 1]), z=zeros), "add")
    for point in range(2):
        for actuator in range(8):
            function = pyuff.prepare_58(
                binary=binary,
                func_type=4,
                id1="acceleration in g",
                rsp_ent_name="NONE",
                rsp_node=point + 1,
                rsp_dir=3,
                ref_ent_name="NONE",
                ref_node=actuator + 3,
                ref_dir=-3,
                x=frequencies,
                data=-spectra[point, actuator] * 2j * np.pi * frequencies / 9.80665,
                abscissa_spacing=1,
                abscissa_spec_data_type=18,
                ordinate_spec_data_type=12,
                ordinate_axis_units_lab="g",
                orddenom_spec_data_type=13,
                orddenom_axis_units_lab="N",
            )
            file.write_sets(function, "add")
    report = ur.import_measurements(film, "scan.uff", "scanned", band_hz=BAND)
    assert (report.quantity, report.per, report.integrated_from_hz) == ("acceleration", "N", 50)
    _near(_imported("scanned"), wanted)


@pytest.mark.parametrize("packed", [False, True])
def test_matlab_files_of_scipy(film: ur.Surface, known: dict[str, Any], packed: bool) -> None:
    arrays = {
        "responses": 1e3 * known["h"],
        "points_mm": known["points_mm"],
        "actuators": np.array(known["actuators"], dtype=object),
        "rate_hz": RATE,
        "kind": "impulse-responses",
        "unit": "mm/s",
        "per": "newton",
    }
    scipy.io.savemat("taps.mat", arrays, do_compression=packed)
    ur.import_measurements(film, "taps.mat", "tapped")
    _near(_imported("tapped"), known["h"])


@pytest.mark.parametrize("save", [np.savez, np.savez_compressed])
def test_archives_of_numpy(film: ur.Surface, known: dict[str, Any], save: Any) -> None:
    turned = np.asfortranarray(known["h"].astype(">f8"))
    times = np.arange(turned.shape[-1]) / RATE
    save("taps.npz", responses=turned, time_s=times, points_mm=known["points_mm"], actuators=known["actuators"])
    ur.import_measurements(film, "taps.npz", "tapped", kind="impulse-responses", **SAID)
    _near(_imported("tapped"), known["h"])


def test_wav_files_of_soundfile(film: ur.Surface, known: dict[str, Any]) -> None:
    Path("sweeps").mkdir()
    for (x, y), point in zip(known["points_mm"], known["h"], strict=True):
        for name, h in zip(known["actuators"], point, strict=True):
            soundfile.write(f"sweeps/{name} at {x:g},{y:g}.wav", h, RATE, subtype="DOUBLE")
    pattern = "{actuator} at {x_mm},{y_mm}.wav"
    ur.import_measurements(film, "sweeps", "swept", pattern=pattern, kind="impulse-responses", **SAID)
    # Files come in the order of their names.
    opened = ur.open("swept")
    assert opened.points_m is not None
    order = [int(np.argmin(np.hypot(*(1e-3 * at - opened.points_m).T))) for at in known["points_mm"]]
    _near(_imported("swept")[order], known["h"])


def test_sofa_and_matlab_7_3_come_through_their_readers(film: ur.Surface, library: Path) -> None:
    responses = ur.open(library)
    ur.export(library, "film.sofa")
    sofa = sofar.read_sofa("film.sofa", verbose=False)
    h = sofa.Data_IR[:, 0].transpose(0, 2, 1)
    with h5py.File("film.mat", "w") as file:
        # As MATLAB has it: axes reversed.
        file["responses"] = h.T
    with h5py.File("film.mat") as file:
        again = file["responses"][()].T
    ur.import_measurements(
        film,
        again,
        "again",
        rate_hz=float(np.ravel(sofa.Data_SamplingRate)[0]),
        points_mm=1e3 * sofa.ListenerPosition[:, :2],
        actuators=responses.names,
        kind="impulse-responses",
        **SAID,
    )
    assert responses.array is not None and np.array_equal(_imported("again"), responses.array)


def test_what_is_exported_is_read_by_others(library: Path) -> None:
    responses = ur.open(library)
    array, points = responses.array, responses.points_m
    assert array is not None and points is not None
    ur.export(library, "film.uff")
    sets = pyuff.UFF("film.uff").read_sets()
    assert [found["type"] for found in sets[:2]] == [164, 2411] and len(sets) == 2 + array[..., 0].size
    assert np.allclose(sets[1]["x"][: len(points)], points[:, 0]) and sets[0]["length"] == 1
    padded = np.pad(array.astype(float), ((0, 0), (0, 0), (0, array.shape[-1] % 2)))
    _near(sets[2 + 8 + 3]["data"], np.fft.rfft(padded[1, 3]) / RATE, 1e-9)
    assert (sets[13]["rsp_node"], sets[13]["ref_ent_name"].strip(), sets[13]["func_type"]) == (2, "a4", 4)
    ur.export(library, "modes.unv", format="uff-modes")
    modes = [found for found in pyuff.UFF("modes.unv").read_sets() if found["type"] == 55]
    assert len(modes) > 10 and modes[0]["analysis_type"] == 2 and modes[0]["modal_m"] == 1
    assert len(modes[0]["node_nums"]) == len(points) + 8
    ur.export(library, "film.mat")
    arrays = scipy.io.loadmat("film.mat")
    assert np.array_equal(arrays["responses"], array) and np.allclose(arrays["points_m"], points)
    assert [str(name[0][0]) for name in arrays["actuators"]] == responses.names


def test_files_and_arrays_are_told_apart(film: ur.Surface, known: dict[str, Any]) -> None:
    given = {name: known[name] for name in ("points_mm", "actuators")}
    for arguments, expected in [
        ((known["h"],), "one of rate_hz, time_s, frequency_hz beside an array, found none"),
        ((known["h"][0],), "expected a shape"),
        (("taps.csv",), "expected points_mm beside an array alone"),
        ((["a", 1],), "expected files or an array of numbers"),
    ]:
        with pytest.raises(ur.OptionError, match=expected):
            ur.import_measurements(film, *arguments, "out", **given, **SAID)
    with pytest.raises(ur.AskError) as raised:
        ur.import_measurements(film, known["h"], "out", rate_hz=RATE, kind="impulse-responses", unit="m/s", **given)
    assert raised.value.field == "per"
    bad = known["h"].copy()
    bad[1, 2, 3] = np.nan
    with pytest.raises(ur.InputError, match="finite values"):
        ur.import_measurements(film, bad, "out", rate_hz=RATE, kind="filters", **given, **SAID)
    with pytest.raises(ur.InputError, match="on the surface"):
        ur.import_measurements(film, known["h"], "out", rate_hz=RATE, kind="filters", offset_mm=(200, 0), **given, **SAID)
