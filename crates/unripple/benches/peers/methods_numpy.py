"""Drives for new targets by numpy and scipy: the inverse and the concentration of velocity, factorised where that helps.

Arguments: count of drives, top of the band in Hz, samples, rate, decay time, then x y of each actuator in metres.
Prints seconds for each drive, by method and number of targets.
"""

import sys
import time

import numpy as np
from numpy.polynomial import legendre
from ritz import Ritz, film
from scipy.linalg import cho_factor, cho_solve

drives, top_hz, samples, rate, decay = (float(a) for a in sys.argv[1:6])
drives, samples = int(drives), int(samples)
actuators = np.array(sys.argv[6:], dtype=float).reshape(-1, 2)
ritz = Ritz(40, *film())
classes = []
for i, j, omegas, shapes in ritz.classes:
    kept = np.flatnonzero(omegas <= 2.0 * np.pi * top_hz)
    classes.append((i, j, omegas[kept], np.ascontiguousarray(shapes[:, kept] * ritz.scale)))
omegas = np.concatenate([c[2] for c in classes])


def readout(x, y):
    """Mass-normalised shapes at a point in metres."""
    x, y = 2.0 * x / ritz.side - 1.0, 2.0 * y / ritz.side - 1.0
    along_x, along_y = legendre.legvander(np.array([x, y]), ritz.count - 1)
    along_x = [line.at(along_x, x) for line in ritz.lines]
    along_y = [line.at(along_y, y) for line in ritz.lines]
    return np.concatenate([np.multiply.outer(along_x[i], along_y[j]).ravel() @ c for i, j, _, c in classes])


t = np.arange(samples) / rate
sigma = 1.0 / decay
damped = np.sqrt(omegas**2 - sigma**2)[:, None]
ringing = np.exp(-sigma * t) * (np.cos(damped * t) - sigma / damped * np.sin(damped * t)) / rate
inputs = np.array([readout(x, y) for x, y in actuators])
gram = (inputs.T @ inputs) * (ringing @ ringing.T)
modes = len(omegas)
scale = np.trace(gram) / modes
whitening = np.linalg.cholesky(gram)
inverse = cho_factor(0.97 * gram + 0.03 * scale * np.eye(modes))

wavelength = 14.5497e-3
cells = int(np.ceil(6.0 * ritz.side / wavelength))
axis = (np.arange(cells) + 0.5) / cells * ritz.side
places = np.array([(x, y) for y in axis for x in axis])
shapes = np.array([readout(x, y) for x, y in places])
mean = (shapes**2).mean()
white = shapes @ whitening * np.sqrt(0.92 / mean / len(places))
whole = white.T @ white + 0.08 * scale * np.eye(modes)


def emit(weights):
    """The drive of modal weights, its peak scaled to 1."""
    made = ((inputs * weights) @ ringing)[:, ::-1]
    return made / np.abs(made).max()


def by_inverse(targets):
    at = np.array([readout(x, y) for x, y in targets]).T
    solved = cho_solve(inverse, at)
    return emit(solved @ np.linalg.solve(at.T @ gram @ solved, np.ones(len(targets))))


def by_concentration(targets):
    at = whitening.T @ np.array([readout(x, y) for x, y in targets]).T
    near = np.zeros(len(places), dtype=bool)
    for x, y in targets:
        near |= np.hypot(places[:, 0] - x, places[:, 1] - y) <= 4.0 / 3.0 * wavelength
    disc = white[near]
    solved = cho_solve(cho_factor(whole - disc.T @ disc), at)
    state = solved @ np.linalg.solve(at.T @ solved, np.ones(len(targets)))
    return emit(np.linalg.solve(whitening.T, state))


def place(i):
    along = lambda share: (5.0 + 140.0 * ((0.5 + share * (i + 1)) % 1.0)) * 1e-3
    return along(0.7548776662466928), along(0.5698402909980533)


for name, method, count in (
    ("inverse-1", by_inverse, 1),
    ("inverse-10", by_inverse, 10),
    ("concentrate-1", by_concentration, 1),
    ("concentrate-10", by_concentration, 10),
):
    seconds = []
    for i in range(drives + 3):
        targets = [place(i * count + k) for k in range(count)]
        start = time.perf_counter()
        method(targets)
        seconds.append(time.perf_counter() - start)
    print(name, *seconds[3:])
