"""Processor time of a million samples of a simulated surface, stepped from Python, beside the same from Rust.

    cargo build --release -p unripple-devices --example stepping
    python python/benches/stepping.py --rust target/release/examples/stepping

In blocks of 64 the speed is to be at least 80 % of that from Rust. Every block is driven and recorded.
Without `--rust`, the times from Python stand alone.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import time
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

import unripple as ur
from unripple import _unripple

#: Samples of a block.
BLOCK = 64

#: Plays a block, [channel, sample], and returns what is recorded.
Exchange: TypeAlias = Callable[[npt.NDArray[np.float32]], object]


def python_seconds(exchange: Exchange, samples: int, channels: int) -> float:
    """Processor time of so many samples, stepped in blocks."""
    drive = np.random.default_rng(1).uniform(-1, 1, (channels, BLOCK)).astype(np.float32)
    began = time.process_time()
    for _ in range(samples // BLOCK):
        exchange(drive)
    return time.process_time() - began


def rust_seconds(program: str, samples: int) -> float:
    """Processor time of the same, as the program in Rust measures it."""
    done = subprocess.run([program, str(samples), str(BLOCK)], check=True, capture_output=True, text=True)
    return float(done.stdout)


def main() -> None:
    """Measure in turns, and print the medians."""
    parser = argparse.ArgumentParser(description="Times of a simulated surface stepped from Python and Rust.")
    parser.add_argument("--rust", metavar="PATH", help="the example `stepping` of unripple-devices")
    parser.add_argument("--samples", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=5)
    asked = parser.parse_args()

    film = ur.Surface("hudin-2012")
    channels = len(film.names)
    ways: dict[str, Callable[[], float]] = {}
    if asked.rust:
        ways["Rust"] = lambda: rust_seconds(asked.rust, asked.samples)
    bare = _unripple.VirtualSurface(_unripple.Surface(f'"{film.name}"'), BLOCK)
    ways["_unripple.VirtualSurface"] = lambda: python_seconds(bare.exchange, asked.samples, channels)
    public = film.virtual(block=BLOCK)
    ways["unripple.VirtualSurface"] = lambda: python_seconds(public.exchange, asked.samples, channels)

    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(asked.runs):
        for name, way in ways.items():
            times[name].append(way())
    medians = {name: statistics.median(found) for name, found in times.items()}
    print(f"{asked.samples} samples of {film.name} in blocks of {BLOCK}, median of {asked.runs} runs")
    print(f"{'':<26}{'processor time, s':>18}{'µs a block':>12}{'speed, % of Rust':>18}")
    for name, seconds in medians.items():
        block = 1e6 * seconds * BLOCK / asked.samples
        share = f"{100 * medians['Rust'] / seconds:.1f}" if "Rust" in medians else "-"
        print(f"{name:<26}{seconds:>18.3f}{block:>12.2f}{share:>18}")


if __name__ == "__main__":
    main()
