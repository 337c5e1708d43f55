"""Sweeps by workers of Dask: each row once and the same to the last bit, also if a worker or the scheduler is killed in the middle."""

from __future__ import annotations

import csv
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from dask_processes import Cluster, once

import unripple as ur

#: Number of designs of the plan, in shards of five.
_DESIGNS = 300

_PLAN = f"""
format = 1
task = "modes"
surface = "{{surface}}"
shard = 5
ask = {{{{ top_hz = 300 }}}}
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
steps = {_DESIGNS}
"""


@pytest.fixture
def cluster(folder: Path) -> Iterator[Cluster]:
    """Processes of Dask, which end with the test."""
    started = Cluster(folder)
    yield started
    started.end()


@pytest.fixture(scope="module")
def serial(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The table that one process makes."""
    folder = tmp_path_factory.mktemp("serial")
    (folder / "plan.toml").write_text(_PLAN.format(surface="hudin-2012"))
    ur.sweep(folder / "plan.toml", folder / "out", no_figures=True)
    return (folder / "out/table.csv").read_bytes()


@pytest.mark.parametrize("shared", [True, False], ids=["shared folder", "rows sent"])
def test_a_killed_worker_changes_nothing(cluster: Cluster, folder: Path, serial: bytes, shared: bool) -> None:
    (folder / "plan.toml").write_text(_PLAN.format(surface="hudin-2012"))
    cluster.scheduler()
    first, _ = cluster.worker(), cluster.worker()
    replaced: list[int] = []

    def replace() -> None:
        first.kill()
        replaced.append(len(list(folder.glob("out/parts/*.jsonl"))))
        cluster.worker()

    with cluster.client() as client:
        client.wait_for_workers(2, timeout=60)
        told = once(0.3, replace)
        report = ur.sweep("plan.toml", "out", client=client, shared=shared, no_figures=True, progress=told)
    assert replaced and 0 < replaced[0] < _DESIGNS // 5
    assert (report.done, report.failed, report.missing) == (_DESIGNS, 0, 0)
    assert (folder / "out/table.csv").read_bytes() == serial
    assert sorted(path.name for path in folder.glob("out/*")) == [
        "parts",
        "plan.json",
        "sweep.json",
        "table.csv",
    ]


def test_a_sweep_goes_on_after_its_scheduler_was_killed(
    cluster: Cluster, folder: Path, serial: bytes
) -> None:
    (folder / "plan.toml").write_text(_PLAN.format(surface="hudin-2012"))
    scheduler = cluster.scheduler()
    cluster.worker()
    with cluster.client() as client:
        told = once(0.3, scheduler.kill)
        with pytest.raises(ur.UnrippleError, match="the same call goes on where it was"):
            ur.sweep("plan.toml", "out", client=client, no_figures=True, progress=told)
    # The worker ends the shard that it has.
    time.sleep(1.0)
    before = {path.name: path.stat().st_mtime_ns for path in folder.glob("out/parts/*.jsonl")}
    assert 0.3 * _DESIGNS / 5 <= len(before) < _DESIGNS / 5 and not (folder / "out/table.csv").exists()

    cluster.scheduler()
    cluster.worker()
    with cluster.client() as client:
        report = ur.sweep("plan.toml", "out", client=client, no_figures=True)
    assert (report.done, report.failed, report.missing) == (_DESIGNS, 0, 0)
    with open("out/table.csv", encoding="utf-8", newline="") as table:
        assert [int(row["index"]) for row in csv.DictReader(table)] == list(range(_DESIGNS))
    assert (folder / "out/table.csv").read_bytes() == serial
    after = {path.name: path.stat().st_mtime_ns for path in folder.glob("out/parts/*.jsonl")}
    assert {name: after[name] for name in before} == before


def test_a_surface_file_is_sent_to_workers(cluster: Cluster, folder: Path) -> None:
    (folder / "plans").mkdir()
    (folder / "film.toml").write_text(ur.Surface("hudin-2012").toml, encoding="utf-8")
    text = _PLAN.format(surface="../film.toml").replace(f"steps = {_DESIGNS}", "steps = 12")
    (folder / "plans/plan.toml").write_text(text)
    ur.sweep("plans/plan.toml", "serial", no_figures=True)
    cluster.scheduler()
    cluster.worker()
    with cluster.client() as client:
        ur.sweep("plans/plan.toml", "out", client=client, shared=False, no_figures=True)
        # A plan elsewhere that says from where it names files.
        (folder / "made/deep").mkdir(parents=True)
        (folder / "made/deep/plan.toml").write_text(f'folder = "../../plans"\n{text}')
        ur.sweep("made/deep/plan.toml", "made/out", client=client, shared=False, no_figures=True)
        # What fails on workers is told here; a folder of something else is refused here.
        (folder / "other/folder").mkdir(parents=True)
        with pytest.raises(ur.WorkError, match="found a folder with `folder`"):
            ur.sweep("plans/plan.toml", "other", client=client)
        (folder / "plans/away.toml").write_text(text.replace("../film.toml", str(folder / "film.toml")))
        with pytest.raises(ur.InputError, match="a path from the plan's folder"):
            ur.sweep("plans/away.toml", "away", client=client, shared=False)
    for out in ("out", "made/out"):
        assert (folder / out / "table.csv").read_bytes() == (folder / "serial/table.csv").read_bytes()


def test_files_that_a_request_names_are_sent_to_workers(cluster: Cluster, folder: Path) -> None:
    (folder / "plans").mkdir()
    narrow = ur.Surface("hudin-2012", band_hz=[0, 600], sample_rate_hz=4800)
    for name in ("film", "other"):
        (folder / f"{name}.toml").write_text(narrow.with_(name=name).toml, encoding="utf-8")
    text = """
    format = 1
    task = "compare"
    surface = "../film.toml"
    shard = 1
    figures = ["/surfaces/0/label", "/surfaces/1/label"]
    ask = { points = [{ at_m = [0.062, 0.09] }], methods = ["concentrate"], no_tradeoffs = true, others = ["../other.toml"] }
    [[axis]]
    ask = "window_s"
    values = [0.01, 0.012]
    """
    (folder / "plans/plan.toml").write_text(text)
    serial = ur.sweep("plans/plan.toml", "serial", no_figures=True)
    assert serial.failed == 0
    assert [Path(file.path).name for file in serial.run.files] == ["plan.toml", "film.toml", "other.toml"]
    cluster.scheduler()
    cluster.worker()
    with cluster.client() as client:
        ur.sweep("plans/plan.toml", "out", client=client, shared=False, no_figures=True)
        (folder / "plans/away.toml").write_text(text.replace("../other.toml", str(folder / "other.toml")))
        with pytest.raises(ur.InputError, match="a path from the plan's folder.*other.toml"):
            ur.sweep("plans/away.toml", "away", client=client, shared=False)
    assert (folder / "out/table.csv").read_bytes() == (folder / "serial/table.csv").read_bytes()


def test_what_is_no_client_is_refused() -> None:
    with pytest.raises(ur.OptionError, match="expected a distributed.Client"):
        ur.sweep("plan.toml", "out", client="tcp://127.0.0.1:8786")  # type: ignore[arg-type]
