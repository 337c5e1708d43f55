"""Time of a call from Python that does almost no work, beside the simplest call of autd3's package.

    pip install pyautd3 && python python/benches/overhead.py

A call is the time that Python adds to every other call. It is to be under 5 µs. The work beneath it, where there is some, is told beside it: a
block of one sample of a film with a single mode, for which eight sensors and a probe are read.
"""

from __future__ import annotations

import statistics
import timeit
from collections.abc import Callable

import numpy as np

import unripple as ur

#: Calls in a run, and runs of which the median and the worst are told.
CALLS, RUNS = 20_000, 9


def microseconds(call: Callable[[], object]) -> tuple[float, float]:
    """Median and worst of the runs, in µs for a call."""
    runs = [1e6 * seconds / CALLS for seconds in timeit.repeat(call, number=CALLS, repeat=RUNS)]
    return statistics.median(runs), max(runs)


def ours() -> dict[str, Callable[[], object]]:
    """Calls of this package."""
    film = ur.Surface("hudin-2012", band_hz=[0, 200])
    rig = film.virtual(block=1)
    silence = np.zeros((len(film.names), 1), np.float32)
    drive = ur.Drive(np.zeros((8, 1440)), rate_hz=48000, names=film.names)
    return {
        "film.rate_hz (an attribute)": lambda: film.rate_hz,
        "np.asarray(drive) (shared memory)": lambda: np.asarray(drive),
        "rig.exchange(one sample), work included": lambda: rig.exchange(silence),
    }


def autd3() -> dict[str, Callable[[], object]]:
    """The simplest calls of autd3's package: its gain of nothing, made, and made and sent to a link that does nothing."""
    try:
        from pyautd3 import AUTD3, Controller, Nop, Null
    except ImportError:
        return {}
    device = AUTD3(pos=np.array([0.0, 0.0, 0.0]), rot=np.array([1.0, 0.0, 0.0, 0.0]))
    controller = Controller.open([device], Nop())
    return {
        "autd3: Null() (made)": Null,
        "autd3: controller.send(Null()), work included": lambda: controller.send(Null()),
    }


def main() -> None:
    """Print the table."""
    print(f"{'call':50} {'median µs':>10} {'worst µs':>10}")
    for name, call in {**ours(), **autd3()}.items():
        median, worst = microseconds(call)
        print(f"{name:50} {median:10.2f} {worst:10.2f}")


if __name__ == "__main__":
    main()
