"""Processor time of a search for the best places of actuators, beside the same search in numpy.

    cargo build --release -p unripple-placement --example search
    python python/benches/placement.py target/release/examples/search

The surface is the paper's film with supported edges, whose modes have closed forms. Actuators are chosen among the points of a grid 6 to 12 mm
from the rim, for the mean contrast of time reversal at 20 targets. Both programs precompute the sums that a layout needs, begin with a greedy
layout and ten random ones, the same in both, and improve each by exchange until no actuator gains by moving. The search in numpy is in double
precision, or single with `--single` as in Rust. Both run as processes of their own, in turns, on one thread, and are charged the user and
system time of the whole process, apart from the start of Python with its import of numpy, which has a column of its own. The worst ratio is
the least favourable to the program in Rust.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

#: Processor time that this process had used before any of its own work, in s.
STARTED = time.process_time()

#: Numbers of actuators, random beginnings of each search, and rounds in which both programs are measured.
COUNTS, RESTARTS, ROUNDS = (8, 32), 10, 5

#: The film: side (m), thickness (m), Young's modulus (Pa), density (kg/m³), Poisson's ratio, tension (N/m), decay time (s).
SIDE, THICKNESS, YOUNG, DENSITY, POISSON, TENSION, DECAY = 0.15, 0.125e-3, 4e9, 1400.0, 0.3, 200.0, 0.07

#: Top of the band (Hz), rate (Hz), window (s).
TOP_HZ, RATE, WINDOW = 3000.0, 48e3, 30e-3

#: Places: pitch of their grid, least and greatest distance from the rim; targets: least distance from the rim, number. Lengths in m.
PITCH, NEAR, FAR, INSIDE, TARGETS = 2.07e-3, 6e-3, 12e-3, 15e-3, 20

#: Cells of the field's grid for the shortest wavelength, and the radius of the focal disc in shortest wavelengths.
CELLS, DISC = 4.0, 4.0 / 3.0

#: Least relative gain for which an actuator is moved, and the seed of the random beginnings.
GAIN, SEED = 1e-5, 1

Array: TypeAlias = npt.NDArray[np.floating]
Indices: TypeAlias = npt.NDArray[np.intp]


def medium() -> tuple[float, float]:
    """Squared celerity of waves in the film (m²/s²), and its bending stiffness over its mass per area (m⁴/s²)."""
    mass = DENSITY * THICKNESS
    return TENSION / mass, YOUNG * THICKNESS**3 / (12.0 * (1.0 - POISSON**2)) / mass


def shortest() -> float:
    """Shortest wavelength in the band, in m."""
    tension, bending = medium()
    omega = 2.0 * np.pi * TOP_HZ
    square = (np.sqrt(tension**2 + 4.0 * bending * omega**2) - tension) / (2.0 * bending)
    return float(2.0 * np.pi / np.sqrt(square))


class Modes:
    """Modes of the film in the band: half waves along both sides, and angular frequencies."""

    def __init__(self) -> None:
        tension, bending = medium()
        most = int(2.0 * SIDE / shortest()) + 1
        m, n = (axis.ravel() for axis in np.mgrid[1 : most + 1, 1 : most + 1])
        square = (np.pi / SIDE) ** 2 * (m**2 + n**2)
        omegas = np.sqrt(tension * square + bending * square**2)
        kept = omegas <= 2.0 * np.pi * TOP_HZ
        self.m, self.n, self.omegas = m[kept], n[kept], omegas[kept]

    def at(self, points: Array) -> Array:
        """Shapes, [point, mode], mass-normalised."""
        x, y = np.pi / SIDE * points.T
        scale = 2.0 / (SIDE * np.sqrt(DENSITY * THICKNESS))
        shapes: Array = scale * np.sin(np.outer(x, self.m)) * np.sin(np.outer(y, self.n))
        return shapes

    def sums(self) -> Array:
        """Sums over the window of the products of any two modes' impulse responses."""
        t = np.arange(round(WINDOW * RATE) + 1) / RATE
        sigma = 1.0 / DECAY
        damped = np.sqrt(self.omegas**2 - sigma**2)[:, None]
        ringing = np.exp(-sigma * t) * (np.cos(damped * t) - sigma / damped * np.sin(damped * t))
        sums: Array = ringing @ ringing.T
        return sums


def to_rim(points: Array) -> Array:
    """Distances of points from the rim, in m."""
    distances: Array = np.minimum(points, SIDE - points).min(axis=1)
    return distances


def square_of(axis: Array) -> Array:
    """The points of a square grid, row by row, by the coordinates along one side."""
    x, y = np.meshgrid(axis, axis)
    return np.column_stack([x.ravel(), y.ravel()])


def grid_of_places() -> Array:
    """The places that may be chosen, in m."""
    count = int(SIDE / PITCH) + 1
    points = square_of(0.5 * (SIDE - (count - 1) * PITCH) + PITCH * np.arange(count))
    distance = to_rim(points)
    return points[(distance >= NEAR) & (distance <= FAR)]


def spread_targets() -> Array:
    """The targets, points of Roberts's low-discrepancy sequence far enough from the rim, in m."""
    steps = np.array([0.7548776662466927, 0.5698402909980532])
    points = SIDE * ((0.5 + np.outer(np.arange(1, 10 * TARGETS), steps)) % 1.0)
    return points[to_rim(points) >= INSIDE][:TARGETS]


class Forms:
    """What a layout's contrasts are computed from.

    Peaks, [target, place], and Gram matrices of the fields outside the focal disc, [target, place, place], add up over the members of a
    layout and over pairs of them. The diagonals of the Gram matrices are `own`, [target, place].
    """

    def __init__(self, places: Array, targets: Array, precision: type[np.floating]) -> None:
        modes = Modes()
        sums = modes.sums().astype(precision)
        inputs = modes.at(places).astype(precision)
        cells = int(np.ceil(CELLS * SIDE / shortest()))
        grid = square_of(SIDE / cells * (np.arange(cells) + 0.5))
        shapes = modes.at(grid)
        everywhere = shapes.T @ shapes
        self.peaks = np.empty((len(targets), len(places)), precision)
        self.gram = np.empty((len(targets), len(places), len(places)), precision)
        for case, (target, shape) in enumerate(zip(targets, modes.at(targets).astype(precision), strict=True)):
            disc = np.hypot(*(grid - target).T) <= DISC * shortest()
            near = shapes[disc]
            outside = (everywhere - near.T @ near) / (len(grid) - len(near))
            aimed = inputs * shape
            states = aimed @ sums
            self.peaks[case] = np.einsum("am,am->a", states, aimed)
            states *= inputs
            # With a factor of the symmetric matrix, the product is one of a matrix with its own transpose, for which numpy computes one half.
            fields = states @ np.linalg.cholesky(outside).astype(precision)
            np.matmul(fields, fields.T, out=self.gram[case])
        self.own = np.einsum("caa->ca", self.gram).copy()


@dataclass(frozen=True)
class Sums:
    """Sums over the members of a layout: peaks and squares, [target], and rows of the Gram matrices, [target, place]."""

    forms: Forms
    peak: Array
    square: Array
    cross: Array

    @classmethod
    def of(cls, forms: Forms, layout: Indices) -> Sums:
        """The sums over a layout."""
        cross = forms.gram[:, layout].sum(axis=1)
        return cls(forms, forms.peaks[:, layout].sum(axis=1), cross[:, layout].sum(axis=1), cross)

    def with_one(self, place: int) -> Sums:
        """The sums with one more member."""
        forms = self.forms
        square = self.square + 2 * self.cross[:, place] + forms.own[:, place]
        return Sums(forms, self.peak + forms.peaks[:, place], square, self.cross + forms.gram[:, place])

    def without(self, member: int) -> Sums:
        """The sums without a member."""
        forms = self.forms
        square = self.square - 2 * self.cross[:, member] + forms.own[:, member]
        return Sums(forms, self.peak - forms.peaks[:, member], square, self.cross - forms.gram[:, member])

    def best(self, taken: Indices) -> tuple[int, float]:
        """The best place for one more member that is not taken, and the mean contrast with it."""
        root = 2 * self.cross
        root += self.forms.own
        root += self.square[:, None]
        np.sqrt(root, out=root)
        contrasts = self.forms.peaks + self.peak[:, None]
        contrasts /= root
        means = contrasts.mean(axis=0)
        means[taken] = -np.inf
        place = int(means.argmax())
        return place, float(means[place])


def greedy(forms: Forms, count: int) -> Indices:
    """A layout to which the best place is added, one at a time."""
    layout = np.empty(0, np.intp)
    sums = Sums.of(forms, layout)
    for _ in range(count):
        place, _ = sums.best(layout)
        sums, layout = sums.with_one(place), np.append(layout, place)
    return layout


def exchange(forms: Forms, start: Indices) -> tuple[Indices, float]:
    """A layout of which each member in turn has been moved to the best place until none gained, and its mean contrast."""
    layout, sums = start.copy(), Sums.of(forms, start)
    score = float(np.mean(sums.peak / np.sqrt(sums.square)))
    position, settled = 0, 0
    while settled < len(layout):
        rest = sums.without(int(layout[position]))
        place, reached = rest.best(np.delete(layout, position))
        if reached > score * (1.0 + GAIN):
            layout[position] = place
            sums, score, settled = rest.with_one(place), reached, 0
        else:
            settled += 1
        position = (position + 1) % len(layout)
    return layout, score


def random_layouts(count: int, layouts: int, places: int) -> list[Indices]:
    """Random layouts by shuffling all places, with the generator SplitMix64 and the seed of the program in Rust."""
    with np.errstate(over="ignore"):
        z = np.uint64(SEED) + np.uint64(0x9E3779B97F4A7C15) * np.arange(1, layouts * places + 1, dtype=np.uint64)
        z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        z ^= z >> np.uint64(31)
    uniform = ((z >> np.uint64(11)) / 2.0**53).reshape(layouts, places)[:, :count]
    drawn = []
    for numbers in uniform:
        order = np.arange(places)
        for i, number in enumerate(numbers):
            j = i + min(int(number * (places - i)), places - i - 1)
            order[[i, j]] = order[[j, i]]
        drawn.append(order[:count])
    return drawn


def search(count: int, restarts: int, precision: type[np.floating]) -> float:
    """The largest mean contrast found."""
    places = grid_of_places()
    forms = Forms(places, spread_targets(), precision)
    starts = [greedy(forms, count), *random_layouts(count, restarts, len(places))]
    return max(exchange(forms, start)[1] for start in starts)


@dataclass(frozen=True)
class Run:
    """A process: the objective it printed, its processor time without, and that of its start, in s."""

    objective: float
    seconds: float
    start: float


def run(command: list[str]) -> Run:
    """Run a program that prints its objective, processor time, and, if it counts it, the processor time of its start."""
    threads = dict.fromkeys(
        ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS"), "1"
    )
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, **threads}) as child:
        assert child.stdout is not None
        printed = child.stdout.read()
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise subprocess.CalledProcessError(child.returncode, command)
    numbers = [float(number) for number in printed.split()]
    start = numbers[2] if len(numbers) > 2 else 0.0
    return Run(numbers[0], used.ru_utime + used.ru_stime - start, start)


def main() -> None:
    """Measure in turns, and print the table."""
    parser = argparse.ArgumentParser(description="Times of a search for places in Rust and in numpy.")
    parser.add_argument("program", help="the example `search` of unripple-placement", nargs="?")
    parser.add_argument("--single", action="store_true", help="numpy in single precision")
    parser.add_argument("--numpy", metavar="N", type=int, help="only the search in numpy, for N actuators")
    asked = parser.parse_args()
    if asked.numpy:
        objective = search(asked.numpy, RESTARTS, np.float32 if asked.single else np.float64)
        print(objective, time.process_time() - STARTED, STARTED)
        return
    if not asked.program:
        parser.error("the path of the example `search` is missing")

    precision = ["--single"] if asked.single else []
    print(f"{'N':>3}{'objective, numpy':>18}{'ours':>9}{'start of numpy, s':>19}{'numpy, s':>10}{'ours, s':>9}"
          f"{'ratio':>8}{'worst':>8}")  # fmt: skip
    for count in COUNTS:
        numpy, ours = [], []
        for _ in range(ROUNDS):
            numpy.append(run([sys.executable, __file__, "--numpy", str(count), *precision]))
            ours.append(run([asked.program, str(count), str(RESTARTS)]))
        ratios = [theirs.seconds / own.seconds for theirs, own in zip(numpy, ours, strict=True)]
        start, theirs, own = (
            statistics.median(seconds)
            for seconds in ([r.start for r in numpy], [r.seconds for r in numpy], [r.seconds for r in ours])
        )
        print(f"{count:>3}{numpy[0].objective:>18.3f}{ours[0].objective:>9.3f}{start:>19.3f}{theirs:>10.3f}{own:>9.3f}"
              f"{statistics.median(ratios):>8.2f}{min(ratios):>8.2f}")  # fmt: skip


if __name__ == "__main__":
    main()
