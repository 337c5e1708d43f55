"""Ctrl+C and exceptions of a progress function end long tasks at once, and other threads go on meanwhile."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import unripple as ur

#: Within how long after the signal the call ends, in s.
_AT_MOST = 0.2

#: How long a task has been at work when it is interrupted, in s: past its beginning.
_AT_WORK = 0.4

#: What a child does: it tells when the work has begun, and when the call was left.
_CHILD = """
import sys, time
import numpy as np
import unripple as ur

said = False

def told(stage, share):
    global said
    if not said:
        said = True
        print("begun", flush=True)

try:
    {work}
except KeyboardInterrupt:
    print(time.monotonic(), flush=True)
    sys.exit(7)
print("ended by itself", flush=True)
"""

#: Work of minutes.
_LONG = {
    "reproduce": 'ur.run("reproduce", output="out", progress=told)',
    "respond": 'ur.Surface("hudin-2012").respond("out", grid_mm=3, progress=told)',
    "calibrate": 'ur.Surface("hudin-2012", band_hz=[0, 500]).calibrate("out", grid_mm=5, unknowns=1, progress=told)',
    "compare": 'ur.Surface("hudin-2012").compare([(62, 90), (40, 50)], output="out", progress=told)',
    "place": 'ur.Surface("hudin-2012").place(count=100, rim_mm=(6, 12), restarts=1000, output="out", progress=told)',
    "field": 'ur.Surface("hudin-2012").field(ur.Drive(np.ones((8, 20 * 48000)), rate_hz=48000), progress=told)',
}

#: Tasks whose folder is a library that the same call continues; the others leave nothing.
_CONTINUED = {"respond", "calibrate"}


@pytest.mark.clock
@pytest.mark.parametrize("name", _LONG)
def test_an_interrupt_ends_the_call(name: str, folder: Path) -> None:
    source = _CHILD.format(work=_LONG[name])
    child = subprocess.Popen([sys.executable, "-c", source], cwd=folder, stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    try:
        assert child.stdout.readline() == "begun\n"
        time.sleep(_AT_WORK)
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        left = float(child.stdout.readline())
        assert child.wait(timeout=60) == 7
    finally:
        child.kill()
        child.stdout.close()
    assert left - sent < _AT_MOST
    found = sorted(path.name for path in folder.iterdir())
    assert found in ([], ["out"]) if name in _CONTINUED else found == [], found


def test_what_was_interrupted_goes_on(film: ur.Surface, folder: Path) -> None:
    class Stopped(Exception):
        pass

    def stop(stage: str, share: float | None) -> None:
        # Modes tell their shares, too, before there is anything to go on with.
        if stage == "points" and share is not None and share > 0.3:
            raise Stopped

    with pytest.raises(Stopped):
        film.respond("stopped", grid_mm=10, length_ms=40, progress=stop)
    resumed = film.respond("stopped", grid_mm=10, length_ms=40)
    whole = film.respond("whole", grid_mm=10, length_ms=40)
    assert resumed.points == whole.points
    first, second = (ur.open(name).array for name in ("stopped", "whole"))
    assert first is not None and second is not None
    assert (first == second).all()


def test_an_exception_of_a_progress_function_is_raised(film: ur.Surface, folder: Path) -> None:
    told: list[str] = []

    def stop(stage: str, share: float | None) -> None:
        told.append(stage)
        raise LookupError(stage)

    with pytest.raises(LookupError):
        film.compare([(62, 90)], output="out", progress=stop)
    assert len(told) == 1
    # The next call is not disturbed, and begins when the first has given up what it had begun to write.
    assert film.check().ok
    assert list(folder.iterdir()) == []


def test_progress_is_told(film: ur.Surface) -> None:
    told: list[tuple[str, float | None]] = []
    film.respond("film", grid_mm=20, length_ms=20, progress=lambda stage, share: told.append((stage, share)))
    assert all(stage for stage, _ in told)
    shares = [share for _, share in told if share is not None]
    assert shares and all(0 <= share <= 1 for share in shares)


@pytest.mark.clock
def test_another_thread_counts_while_one_computes() -> None:
    counted, over = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    counting = threading.Thread(target=count)
    film = ur.Surface("hudin-2012")
    counting.start()
    before, began = counted, time.monotonic()
    film.compare([(62, 90)], method=["concentrate"], window_ms=30, threads=1, no_tradeoffs=True)
    took, found = time.monotonic() - began, counted - before
    over.set()
    counting.join()
    # Each pause of a millisecond may become several on a busy machine; a call that holds the GIL would let none be counted.
    assert took > 0.05 and found > 20 * took


def test_calls_of_several_threads_do_not_mix(film: ur.Surface) -> None:
    wanted = {k: film.with_(tension_n_per_m=200 + k).modes(max_hz=300).frequencies_hz for k in range(4)}
    found: dict[int, list[float]] = {}

    def compute(k: int) -> None:
        found[k] = film.with_(tension_n_per_m=200 + k).modes(max_hz=300).frequencies_hz

    threads = [threading.Thread(target=compute, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == wanted


def test_a_forked_process_is_told_what_it_lacks(film: ur.Surface) -> None:
    film.design()
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        # Nothing of the test's own is to run here.
        try:
            film.design()
            said = "done"
        except ur.WorkError as error:
            said = str(error)
        os.write(writer, said.encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, encoding="utf-8") as told:
        assert "`spawn`" in told.read()
    assert os.waitpid(child, 0)[1] == 0
