"""A sweep of many designs by every engine: all rows, each once, as one process makes them, and what the engines cost.

Only `./soak sweeps` runs it, with UNRIPPLE_DESIGNS as the number of designs. Times are printed, not held: those of a machine that does
something else as well say nothing. GNU parallel and network namespaces (`ip`, as root) must be there.
"""

from __future__ import annotations

import os
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from dask_processes import Cluster, once

import unripple as ur

#: Number of designs.
_DESIGNS = int(os.environ.get("UNRIPPLE_DESIGNS", "0"))
#: Designs of a shard: some seconds of work.
_SHARD = 20

_PLAN = f"""
format = 1
task = "focus"
surface = "hudin-2012"
shard = {_SHARD}
ask = {{ points = [{{ at_m = [0.062, 0.09] }}], window_s = 0.02, judge_hz = 700.0 }}
[[axis]]
key = "drive.band_hz"
values = [[0.0, 600.0]]
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
steps = {_DESIGNS}
"""


def _processor_s(pid: int) -> float:
    """Processor time of a process, in s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.fixture(scope="module")
def serial(tmp_path_factory: pytest.TempPathFactory) -> tuple[bytes, float]:
    """The table that one process on one thread makes, and the time that it takes in s."""
    folder = tmp_path_factory.mktemp("serial")
    (folder / "plan.toml").write_text(_PLAN)
    began = time.monotonic()
    report = ur.sweep(folder / "plan.toml", folder / "out", no_figures=True, threads=1)
    took = time.monotonic() - began
    assert (report.done, report.failed) == (_DESIGNS, 0)
    print(f"\n{_DESIGNS} designs by one process on one thread: {took:.1f} s")
    return (folder / "out/table.csv").read_bytes(), took


@pytest.fixture
def cluster(folder: Path) -> Iterator[Cluster]:
    """Processes of Dask, which end with the test."""
    (folder / "plan.toml").write_text(_PLAN)
    started = Cluster(folder)
    yield started
    started.end()


def _overhead(name: str, took: float, alone: float) -> None:
    print(f"{name}: {took:.1f} s, {100 * (2 * took / alone - 1):.1f} % more than half of one process's time")


def test_two_workers(cluster: Cluster, serial: tuple[bytes, float], folder: Path) -> None:
    scheduler = cluster.scheduler()
    cluster.worker(), cluster.worker()
    with cluster.client() as client:
        client.wait_for_workers(2, timeout=60)
        idle, began = _processor_s(scheduler.pid), time.monotonic()
        report = ur.sweep("plan.toml", "out", client=client, no_figures=True)
        took, spent = time.monotonic() - began, _processor_s(scheduler.pid) - idle
    assert (report.done, report.failed, report.missing) == (_DESIGNS, 0, 0)
    assert (folder / "out/table.csv").read_bytes() == serial[0]
    _overhead("two workers of Dask", took, serial[1])
    shards = -(-_DESIGNS // _SHARD)
    print(f"the scheduler: {1e3 * spent / shards:.2f} ms of processor time for each of {shards} shards")


def test_a_worker_and_then_the_scheduler_are_killed(
    cluster: Cluster, serial: tuple[bytes, float], folder: Path
) -> None:
    scheduler = cluster.scheduler()
    first, _ = cluster.worker(), cluster.worker()
    begin = once(0.3, first.kill)
    end = once(0.6, scheduler.kill)

    def told(stage: str, now: float | None) -> None:
        begin(stage, now)
        end(stage, now)

    with cluster.client() as client:
        client.wait_for_workers(2, timeout=60)
        with pytest.raises(ur.UnrippleError, match="the same call goes on where it was"):
            ur.sweep("plan.toml", "out", client=client, no_figures=True, progress=told)
    assert not (folder / "out/table.csv").exists()
    cluster.scheduler()
    cluster.worker(), cluster.worker()
    with cluster.client() as client:
        report = ur.sweep("plan.toml", "out", client=client, no_figures=True)
    assert (report.done, report.failed, report.missing) == (_DESIGNS, 0, 0)
    assert (folder / "out/table.csv").read_bytes() == serial[0]


def test_gnu_parallel(program: str, serial: tuple[bytes, float], folder: Path) -> None:
    (folder / "plan.toml").write_text(_PLAN)
    shards = "\n".join(str(k) for k in range(-(-_DESIGNS // _SHARD)))
    command = ["parallel", "-j2", program, "sweep", "plan.toml", "--shard", "{}", "-o", "out", "--no-figures"]
    began = time.monotonic()
    environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
    subprocess.run(
        command, input=shards, text=True, check=True, env=environment, stdout=subprocess.DEVNULL
    )
    _overhead("two jobs of GNU parallel", time.monotonic() - began, serial[1])
    assert (folder / "out/table.csv").read_bytes() == serial[0]


@pytest.fixture
def hosts() -> Iterator[list[str]]:
    """Three network namespaces on one bridge, as three hosts of one network; their names."""
    names = [f"unripple-{k}" for k in range(3)]

    def ip(*arguments: str) -> None:
        subprocess.run(["ip", *arguments], check=True)

    ip("link", "add", "unripple-br", "type", "bridge")
    ip("address", "add", "10.91.7.254/24", "dev", "unripple-br")
    ip("link", "set", "unripple-br", "up")
    for k, name in enumerate(names):
        ip("netns", "add", name)
        ip("link", "add", f"unripple-v{k}", "type", "veth", "peer", "name", "eth0", "netns", name)
        ip("link", "set", f"unripple-v{k}", "master", "unripple-br", "up")
        ip("-n", name, "address", "add", f"10.91.7.{k + 1}/24", "dev", "eth0")
        ip("-n", name, "link", "set", "eth0", "up")
        ip("-n", name, "link", "set", "lo", "up")
    yield names
    for name in names:
        ip("netns", "delete", name)
    ip("link", "delete", "unripple-br")


def test_hosts_of_their_own(
    cluster: Cluster, hosts: list[str], serial: tuple[bytes, float], folder: Path
) -> None:
    inside = [["ip", "netns", "exec", name] for name in hosts]
    cluster.scheduler("10.91.7.1", inside[0])
    cluster.worker("10.91.7.2", inside[1])
    cluster.worker("10.91.7.3", inside[2])
    with cluster.client() as client:
        client.wait_for_workers(2, timeout=60)
        began = time.monotonic()
        # No folder in common: the rows travel.
        report = ur.sweep("plan.toml", "out", client=client, shared=False, no_figures=True)
    assert (report.done, report.failed, report.missing) == (_DESIGNS, 0, 0)
    _overhead("two workers in network namespaces", time.monotonic() - began, serial[1])
    assert (folder / "out/table.csv").read_bytes() == serial[0]
