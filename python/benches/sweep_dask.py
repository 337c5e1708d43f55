"""Cost of a sweep by two workers of Dask, beside the same sweep in one process.

    pip install 'unripple[dask]' && python python/benches/sweep_dask.py

Modes of the paper's film up to 300 Hz for 2000 tensions, in shards of 20 designs: designs that take so little time that what surrounds them
counts. Every process computes on one thread. The scheduler, the workers and this process, which asks and makes the table, share one machine;
where it has fewer than four cores, or other work, they wait for each other, which wall time contains and processor time does not. Processors
that share a core are slower together: so the same shards are computed by as many processes without Dask too, each every second one. The
overhead is told over both: of wall time, for one process over half of its time, and of processor time, of workers and scheduler. An empty task
is `abs(0)`; what a scheduler and workers without any task use is told beside it, and taken off the scheduler's cost of a shard. In the end
what a shard costs beside its designs in a folder with the rows of 10^6 designs, since each looks at what is there: the projection takes half
of that for each shard.
"""

from __future__ import annotations

import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import distributed

import unripple as ur

#: Designs of the sweep, designs in a shard, workers, and designs to project to.
DESIGNS, SHARD, WORKERS, MANY = 2000, 20, 2, 10**6

#: Empty tasks, calls of which the median is told, and time without any task, in s.
TASKS, CALLS, IDLE = 2000, 5, 10.0

PLAN = f"""
format = 1
task = "modes"
surface = "hudin-2012"
shard = {SHARD}
ask = {{{{ top_hz = 300 }}}}
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
steps = {{designs}}
"""


def plan(folder: Path, designs: int) -> Path:
    """Write a plan with so many designs."""
    path = folder / f"plan-{designs}.toml"
    path.write_text(PLAN.format(designs=designs), encoding="utf-8")
    return path


@contextmanager
def cluster(folder: Path) -> Iterator[distributed.Client]:
    """A scheduler and workers as processes of their own."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{free.getsockname()[1]}"
    commands = [["scheduler", "--host", "127.0.0.1", "--port", address.split(":")[1], "--no-dashboard"]]
    place = ["--host", "127.0.0.1", "--local-directory", os.fspath(folder / "workers")]
    commands += [["worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard", *place]] * WORKERS
    started = []
    try:
        for command in commands:
            quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            started.append(subprocess.Popen([sys.executable, "-m", "dask", *command], **quiet))
        with distributed.Client(address, timeout=60) as client:
            client.wait_for_workers(WORKERS, timeout=60)
            yield client
    finally:
        for process in started:
            process.terminate()
            process.wait()


class Spent:
    """Wall time and processor times that a block takes, in s."""

    def __init__(self, client: distributed.Client | None = None) -> None:
        self.client = client

    def now(self) -> tuple[float, float, float, float]:
        """Wall time, and processor times of this process, of the workers and of the scheduler."""
        workers, scheduler = 0.0, 0.0
        if self.client is not None:
            workers = sum(self.client.run(time.process_time).values())
            scheduler = self.client.run_on_scheduler(time.process_time)
        return time.perf_counter(), time.process_time(), workers, scheduler

    def __enter__(self) -> Spent:
        self.began = self.now()
        return self

    def __exit__(self, *_: object) -> None:
        spent = [now - began for began, now in zip(self.began, self.now(), strict=True)]
        self.wall, self.own, self.workers, self.scheduler = spent
        self.processor = self.own + self.workers + self.scheduler


#: What a process without Dask does: every n-th shard, and the processor time that they took.
ALONE = """
import sys, time, unripple
plan, out, first, step, shards = sys.argv[1:]
began = time.process_time()
for shard in range(int(first), int(shards), int(step)):
    unripple.sweep(plan, out, shard=shard, threads=1, no_figures=True)
print(time.process_time() - began)
"""


def processes(path: Path, out: Path) -> Spent:
    """What as many processes without Dask take for the shards."""
    numbers = [[str(first), str(WORKERS), str(DESIGNS // SHARD)] for first in range(WORKERS)]
    command = [sys.executable, "-c", ALONE, os.fspath(path), os.fspath(out)]
    with Spent() as spent:
        started = [subprocess.Popen([*command, *rest], stdout=subprocess.PIPE, text=True) for rest in numbers]
        spent_by = [float(process.communicate()[0]) for process in started]
    spent.workers = spent.processor = sum(spent_by)
    return spent


def empty_tasks(client: distributed.Client) -> Spent:
    """What empty tasks take."""
    with Spent(client) as spent:
        futures = [client.submit(abs, 0, key=f"empty-{task}", pure=False, retries=5) for task in range(TASKS)]
        client.gather(futures)
    return spent


def beside_designs(folder: Path) -> float:
    """Time of a call for a shard that is there already, among as many parts as the projection has, in s."""
    many, out = plan(folder, MANY), folder / "many"
    ur.sweep(many, out, shard=0, threads=1, no_figures=True)
    for shard in range(1, MANY // SHARD - 1):
        os.link(out / "parts/0.jsonl", out / f"parts/{shard}.jsonl")
    times = []
    for _ in range(CALLS):
        with Spent() as spent:
            ur.sweep(many, out, shard=0, threads=1, no_figures=True)
        times.append(spent.wall)
    return statistics.median(times)


def main() -> None:
    """Print the tables."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = plan(folder, DESIGNS)
        with Spent() as serial:
            ur.sweep(path, folder / "serial", threads=1, no_figures=True)
        apart = processes(path, folder / "apart")
        with cluster(folder) as client:
            with Spent(client) as idle:
                time.sleep(IDLE)
            empty = empty_tasks(client)
            with Spent(client) as spread:
                ur.sweep(path, folder / "spread", client=client, no_figures=True)
        same = (folder / "serial/table.csv").read_bytes() == (folder / "spread/table.csv").read_bytes()
        listing = beside_designs(folder)
    print(f"the tables are the same to the last bit: {same}\n")
    tell_times(serial, apart, spread)
    tell_scheduler(serial, spread, idle, empty, listing)


def tell_times(serial: Spent, apart: Spent, spread: Spent) -> None:
    """Print the table of times."""
    print(f"{DESIGNS} designs, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}")
    print(f"{'':32} {'wall s':>9} {'workers, processor s':>21} {'scheduler':>10} {'caller':>7}")
    print(f"{'one process':32} {serial.wall:9.2f} {serial.own:21.2f}")
    print(f"{f'{WORKERS} processes':32} {apart.wall:9.2f} {apart.workers:21.2f}")
    parts = f"{spread.workers:21.2f} {spread.scheduler:10.2f} {spread.own:7.2f}"
    print(f"{f'{WORKERS} workers of Dask':32} {spread.wall:9.2f} {parts}")
    for name, wall, processor in (
        ("one process", serial.wall / WORKERS, serial.own),
        (f"{WORKERS} processes", apart.wall, apart.workers),
    ):
        shares = [100.0 * (spread.wall / wall - 1.0), 100.0 * (spread.workers / processor - 1.0)]
        shares.append(100.0 * spread.scheduler / processor)
        told = f"per cent over {name}"
        print("{:32} {:9.1f} {:21.1f} {:10.1f}".format(told, *shares))
    print()


def tell_scheduler(serial: Spent, spread: Spent, idle: Spent, empty: Spent, listing: float) -> None:
    """Print the table of what tasks cost beside their work, and the projection."""
    shards, many = DESIGNS // SHARD, MANY // SHARD
    resting = idle.scheduler / idle.wall
    of_shard = (spread.scheduler - resting * spread.wall) / shards
    print(f"{'processor time':32} {'scheduler':>9} {'caller':>12} {'workers':>11}")
    shares = (100.0 * of / idle.wall for of in (idle.scheduler, idle.own, idle.workers))
    print("{:32} {:9.2f} {:12.2f} {:11.2f}".format("without tasks, per cent of time", *shares))
    costs = (1e3 * of / TASKS for of in (empty.scheduler, empty.own, empty.workers))
    print("{:32} {:9.2f} {:12.2f} {:11.2f}".format("empty task, ms", *costs))
    print(f"{'shard, ms':32} {1e3 * of_shard:9.2f} {1e3 * spread.own / shards:12.2f}\n")
    each, busy = serial.processor / shards, max(of_shard, empty.scheduler / TASKS)
    print(f"projection to {MANY} designs in {many} shards")
    print(f"{'designs, processor h':32} {each * many / 3600:9.2f}")
    looked = f"{1e3 * listing:.0f} ms for the last shard"
    print(f"{'looking at the folder, h':32} {listing / 2 * many / 3600:9.2f}  ({looked})")
    print(f"{'scheduler, processor s':32} {busy * many:9.0f}")
    print(f"{'caller, processor s':32} {spread.own * many / shards:9.0f}")
    print(f"{'workers that it keeps busy':32} {each / busy:9.0f}")


if __name__ == "__main__":
    main()
