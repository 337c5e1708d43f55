"""A scheduler and workers of Dask, each a process of its own, for tests of sweeps."""

from __future__ import annotations

import contextlib
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import distributed


class Cluster:
    """A scheduler and workers, each a process of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.address = folder, ""
        self.processes: list[subprocess.Popen[bytes]] = []

    def end(self) -> None:
        """End all processes."""
        for process in self.processes:
            process.kill()
            process.wait()

    def start(self, *command: str, inside: Sequence[str] = ()) -> subprocess.Popen[bytes]:
        """Start a process of Dask, by the command `inside` if there is one; its log is beside the rows."""
        whole = [*inside, sys.executable, "-m", "dask", *command]
        with open(self.folder / f"dask-{len(self.processes)}.log", "wb") as log:
            started = subprocess.Popen(whole, stdout=log, stderr=log)
        self.processes.append(started)
        return started

    def scheduler(self, host: str = "127.0.0.1", inside: Sequence[str] = ()) -> subprocess.Popen[bytes]:
        """Start a scheduler at a free port."""
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address = f"tcp://{host}:{port}"
        place = ("--host", host, "--port", str(port))
        return self.start("scheduler", *place, "--no-dashboard", "--no-show", inside=inside)

    def worker(self, host: str = "127.0.0.1", inside: Sequence[str] = ()) -> subprocess.Popen[bytes]:
        """Start a worker of one thread, which no nanny starts again."""
        place = ("--host", host, "--local-directory", str(self.folder / "workers"))
        one = ("--no-nanny", "--nthreads", "1", "--no-dashboard")
        return self.start("worker", self.address, *one, *place, inside=inside)

    @contextlib.contextmanager
    def client(self) -> Iterator[distributed.Client]:
        """Connect to the scheduler; give up soon where it does not come back."""
        with distributed.Client(self.address, timeout=60, set_as_default=False) as client:  # type: ignore[no-untyped-call]
            yield client


def once(share: float, act: Callable[[], object]) -> Callable[[str, float | None], None]:
    """A progress function that does something once, when that share of the designs is there."""
    done: list[object] = []

    def told(stage: str, now: float | None) -> None:
        if not done and stage == "designs" and now is not None and now >= share:
            done.append(act())

    return told
