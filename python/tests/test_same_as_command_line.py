"""What Python computes is what the command line computes, to the last digit."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import unripple as ur

#: The film with few modes, as the command line makes it.
_FILM = ["hudin-2012", "--set", "drive.band_hz=[0,500]"]

#: Keys that say how long a run took, or when it was.
_OF_THE_CLOCK = {"seconds", "date", "plan_s", "drive_s"}

#: Prepares what a task reads.
Before = Callable[[Path], None]


def film() -> ur.Surface:
    """The same film in Python."""
    return ur.Surface("hudin-2012", band_hz=[0, 500])


def _respond(folder: Path) -> None:
    film().respond(folder / "film", grid_mm=30, length_ms=40)


def _exported(folder: Path) -> None:
    _respond(folder)
    ur.export(folder / "film", folder / "film-wav")


def _focus(folder: Path) -> None:
    film().focus([(62, 90)], window_ms=20).to_wav(folder / "drive.wav")


def _focused(**options: Any) -> ur.Report:
    report = film().focus(output="out", no_figures=True, **options).report
    assert report is not None
    return report


def _plan(folder: Path) -> None:
    """A plan of three designs, one of which fails."""
    lines = ["format = 1", 'task = "modes"', 'surface = "hudin-2012"', "ask = { top_hz = 250 }"]
    lines += ["[[axis]]", 'key = "sheet.tension_n_per_m"', "values = [150, 200.5, -1]"]
    (folder / "plan.toml").write_text("\n".join(lines), encoding="utf-8")


#: Arguments of the command line, what Python does, and what both need before. Both run in folders of their own, by the same names.
CASES: dict[str, tuple[list[str], Callable[[], ur.Report], Before | None]] = {
    "check": (["check", "glass-plate"], lambda: ur.check("glass-plate"), None),
    "design": (["design", *_FILM], lambda: film().design(), None),
    "modes": (["modes", *_FILM, "--max-hz", "300"], lambda: film().modes(max_hz=300), None),
    "place": (
        ["place", *_FILM, "--count", "2", "--keep", "a2", "--keep", "a5", "--like", "a3", "--rim-mm", "6.1,12.3"]
        + ["--keep-out", "100.1,0,150,0,150,50.3", "--keep-out", "0,140,9.7,140,0,150", "--grid-mm", "4.9"]
        + ["--apart-mm", "10.7", "--at", "62,90.1", "--at", "40.3,50,2.7", "--mounting-mm", "0.7"]
        + ["--tension-percent", "0.9", "--window-ms", "20.3", "--restarts", "2", "--seed", "7", "--up-to", "3"]
        + ["--objective", "quantile", "--share-percent", "30.7", "--method", "one-bit", "--no-figures", "-o", "out"],
        lambda: film().place(
            count=2,
            keep=["a2", "a5"],
            like="a3",
            rim_mm=(6.1, 12.3),
            keep_out=[[(100.1, 0), (150, 0), (150, 50.3)], [(0, 140), (9.7, 140), (0, 150)]],
            grid_mm=4.9,
            apart_mm=10.7,
            at=[(62, 90.1), (40.3, 50, 2.7)],
            mounting_mm=0.7,
            tension_percent=0.9,
            window_ms=20.3,
            restarts=2,
            seed=7,
            up_to=3,
            objective="quantile",
            share_percent=30.7,
            method=["one-bit"],
            no_figures=True,
            output="out",
        ),
        None,
    ),
    "listed places": (
        ["place", *_FILM, "--count", "2", "--keep-all", "--place", "10.1,20", "--place", "75,12.3", "--place", "140,75.7"]
        + ["--place", "12,130", "--within", "0,0,150,0,150,150,0,150.1", "--screen", "40.1,40,110,40,110,110"]
        + ["--targets", "4", "--window-ms", "20", "--restarts", "1"],
        lambda: film().place(
            count=2,
            keep_all=True,
            place=[(10.1, 20), (75, 12.3), (140, 75.7), (12, 130)],
            within=[(0, 0), (150, 0), (150, 150), (0, 150.1)],
            screen="40.1,40,110,40,110,110",
            targets=4,
            window_ms=20,
            restarts=1,
        ),
        None,
    ),
    "sensors": (
        ["sensors", *_FILM, "--count", "2", "--keep", "62,90.1", "--keep", "40.3,50", "--rim-mm", "6.1,70.3"]
        + ["--keep-out", "100.1,0,150,0,150,50.3", "--grid-mm", "19.9", "--apart-mm", "10.7", "--snr-db", "41.5"]
        + ["--profile", "1", "--restarts", "2", "--seed", "7", "--up-to", "3", "--taps", "--no-figures", "-o", "out"],
        lambda: film().sensors(
            count=2,
            keep=[(62, 90.1), (40.3, 50)],
            rim_mm=(6.1, 70.3),
            keep_out=[(100.1, 0), (150, 0), (150, 50.3)],
            grid_mm=19.9,
            apart_mm=10.7,
            snr_db=41.5,
            profile=1,
            restarts=2,
            seed=7,
            up_to=3,
            taps=True,
            no_figures=True,
            output="out",
        ),
        None,
    ),
    "frequencies": (
        ["fit", *_FILM, "--modes", "171.4,270.8:35.1,343:Q40.3", "--free", "tension,modulus", "--error-percent", "1.7"]
        + ["--sides-known", "--no-figures", "-o", "out"],
        lambda: ur.fit_modes(
            film(),
            [171.4, (270.8, 35.1), "343:Q40.3"],
            free=["tension", "modulus"],
            error_percent=1.7,
            sides_known=True,
            no_figures=True,
            output="out",
        ),
        None,
    ),
    "materials": (["materials", "glass"], lambda: ur.materials("glass"), None),
    "points": (
        ["focus", *_FILM, "--at", "40.1,50.3", "--at", "100,90,0.7", "--method", "concentrate", "--peak-um", "1.3"]
        + ["--window-ms", "30.7", "--finger", "40.1,50.3", "--no-figures", "-o", "out"],
        lambda: _focused(
            at=[(40.1, 50.3), (100, 90, 0.7)],
            method="concentrate",
            peak_um=1.3,
            window_ms=30.7,
            fingers_mm=[(40.1, 50.3)],
        ),
        None,
    ),
    "repeated": (
        ["focus", *_FILM, "--at", "62,90,1,50", "--felt-db", "3", "--window-ms", "20", "--no-figures", "-o", "out"],
        lambda: _focused(at=[(62, 90, 1, 50)], felt_db=3, window_ms=20),
        None,
    ),
    "shape": (
        ["focus", *_FILM, "--shape", "circle:75,75,20.3", "--method", "robust", "--spread-percent", "0.7"]
        + ["--bear-tension-percent", "0.9", "--window-ms", "20", "--no-figures", "-o", "out"],
        lambda: _focused(
            shape="circle:75,75,20.3",
            method="robust",
            spread_percent=0.7,
            bear_tension_percent=0.9,
            window_ms=20,
        ),
        None,
    ),
    "waveform": (
        ["focus", *_FILM, "--waveform", "62,90,burst:250,5,1.7", "--silent", "100,60", "--no-figures", "-o", "out"],
        lambda: _report(
            film().waveform([(62, 90, "burst:250,5", 1.7)], silent_mm=[(100, 60)], output="out", no_figures=True)
        ),
        None,
    ),
    "stroke": (
        ["focus", *_FILM, "--path", "line:50,75,60.7,75", "--speed-mm-s", "90.1", "--level-mm-s", "11.3"]
        + ["--no-figures", "-o", "out"],
        lambda: _report(
            film().stroke("line:50,75,60.7,75", speed_mm_s=90.1, level_mm_s=11.3, output="out", no_figures=True)
        ),
        None,
    ),
    "field": (
        ["field", *_FILM, "--drive", "drive.wav", "--at", "62,90.3", "--finger", "70,80.1", "--judge-hz", "700"],
        lambda: film().field("drive.wav", at=[(62, 90.3)], fingers_mm=[(70, 80.1)], judge_hz=700).report,
        _focus,
    ),
    "compare": (
        ["compare", *_FILM, "--at", "62.1,90", "--method", "one-bit", "--method", "inverse", "--window-ms", "20"],
        lambda: film().compare([(62.1, 90)], method=["one-bit", "inverse"], window_ms=20),
        None,
    ),
    "respond": (
        ["respond", *_FILM, "--grid-mm", "40", "--length-ms", "20.3", "-o", "film"],
        lambda: film().respond("film", grid_mm=40, length_ms=20.3),
        None,
    ),
    "library": (
        ["focus", "film", "--at", "62,90", "--window-ms", "15", "--between", "nearest", "--no-figures", "-o", "out"],
        lambda: _report(
            ur.open("film").focus([(62, 90)], window_ms=15, between="nearest", output="out", no_figures=True)
        ),
        _respond,
    ),
    "sweep": (
        ["sweep", "plan.toml", "--no-figures", "-o", "swept"],
        lambda: ur.sweep("plan.toml", "swept", no_figures=True),
        _plan,
    ),
    "import": (
        ["import", *_FILM, "film-wav", "-o", "again", "--band-hz", "50,400", "--offset-mm", "0.3,0", "--length-ms", "15.3"],
        lambda: ur.import_measurements(
            film(), "film-wav", "again", band_hz=(50, 400), offset_mm=(0.3, 0), length_ms=15.3
        ),
        _exported,
    ),
    "export": (["export", "film", "-o", "wav"], lambda: ur.export("film", "wav"), _respond),
    "calibrate": (
        ["calibrate", *_FILM, "--unknowns", "3", "--at", "62,90.1", "--sweep-ms", "100", "--response-ms", "50.3"]
        + ["-o", "rig"],
        lambda: film().calibrate("rig", unknowns=3, at=[(62, 90.1)], sweep_ms=100, response_ms=50.3),
        None,
    ),
    "verify": (
        ["verify", *_FILM, "--drive", "drive.wav", "--at", "62,90", "--probes", "2", "--changed-percent", "1.7"],
        lambda: film().verify("drive.wav", at=(62, 90), probes=2, changed_percent=1.7),
        _focus,
    ),
    "drift": (
        ["drift", *_FILM, "--seconds", "2", "--changed-percent", "1.7"],
        lambda: film().drift(seconds=2, changed_percent=1.7),
        None,
    ),
}


def _report(drive: ur.Drive) -> ur.Report:
    assert drive.report is not None
    return drive.report


def _typed(program: str, arguments: list[str], folder: Path) -> dict[str, Any]:
    """The report that the command line prints. A report that counts as failed is one, too."""
    command = [program, "--json", "--quiet", *arguments]
    said = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert said.returncode in (0, 1), said.stderr
    found: dict[str, Any] = json.loads(said.stdout)
    return found


def _comparable(value: Any) -> Any:
    """A report without its record and what the clock says."""
    if isinstance(value, dict):
        return {key: _comparable(item) for key, item in value.items() if key not in _OF_THE_CLOCK | {"run"}}
    return [_comparable(item) for item in value] if isinstance(value, list) else value


@pytest.mark.filterwarnings("ignore::unripple.UnrippleWarning")
@pytest.mark.parametrize("name", CASES)
def test_the_report_is_the_same(
    name: str, program: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    arguments, in_python, before = CASES[name]
    for part in ("typed", "python"):
        (folder / part).mkdir()
        if before is not None:
            before(folder / part)
    typed = _typed(program, arguments, folder / "typed")
    monkeypatch.chdir(folder / "python")
    found = in_python().to_dict()
    assert _comparable(found) == _comparable(typed)
    assert found["run"]["command"] == typed["run"]["command"]
    # What was asked is the same, too, but for how the surface and the files were named.
    apart = ("surface", "drive", "library", "plan", "output", "files")
    asked = [{k: v for k, v in report["run"]["ask"].items() if k not in apart} for report in (found, typed)]
    assert asked[0] == asked[1]


@pytest.mark.parametrize("name", ["points", "waveform", "respond", "place"])
def test_files_are_the_same_byte_for_byte(
    name: str, program: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    arguments, in_python, _ = CASES[name]
    for part in ("typed", "python"):
        (folder / part).mkdir()
    _typed(program, arguments, folder / "typed")
    monkeypatch.chdir(folder / "python")
    in_python()
    # Those that hold the record tell its date.
    told = {"report.json", "report.md", "zarr.json"}
    typed = [path for path in (folder / "typed").rglob("*") if path.is_file() and path.name not in told]
    visible = [path for path in typed if not path.name.startswith(".")]
    assert visible
    for path in visible:
        other = folder / "python" / path.relative_to(folder / "typed")
        assert other.read_bytes() == path.read_bytes(), other


def test_a_name_makes_the_same_record(program: str, folder: Path) -> None:
    found = ur.run("modes", surface="hudin-2012", set={"drive.band_hz": [0, 500]}, max_hz=300).to_dict()
    typed = _typed(program, ["modes", "hudin-2012", "--set", "drive.band_hz=[0, 500]", "--max-hz", "300"], folder)
    found["run"].pop("date"), typed["run"].pop("date")
    assert found == typed


def test_what_python_did_can_be_done_again(program: str, folder: Path) -> None:
    film().focus([(62, 90)], window_ms=20, output="out", no_figures=True)
    first = json.loads((folder / "out/report.json").read_text(encoding="utf-8"))
    again = _typed(program, ["rerun", "out/report.json", "-o", "again"], folder)
    assert _comparable(again) == _comparable(first)
    assert (folder / "again/drive.wav").read_bytes() == (folder / "out/drive.wav").read_bytes()
    assert _comparable(ur.rerun("out/report.json", "once-more").to_dict()) == _comparable(first)


def test_the_console_script_is_the_command_line(program: str, folder: Path) -> None:
    import sys

    for arguments in (["--version"], ["design", "hudin-2012"], ["focus", "hudin-2012"], ["no-such-command"]):
        own = subprocess.run([program, *arguments], capture_output=True, text=True)
        python = subprocess.run([sys.executable, "-m", "unripple", *arguments], capture_output=True, text=True)
        assert (python.returncode, python.stdout) == (own.returncode, own.stdout)
        assert python.stderr == own.stderr
