"""Drives for new points by numpy: the same modes, one product with precomputed oscillations, reversed and scaled.

Arguments: count of points, top of the band in Hz, samples, rate, decay time, then x y of each actuator in metres.
Prints seconds for each point, and the first channel of the drive for (62, 90) mm.
"""

import sys
import time

import numpy as np
from numpy.polynomial import legendre
from ritz import Ritz, film

points, top_hz, samples, rate, decay = (float(a) for a in sys.argv[1:6])
points, samples = int(points), int(samples)
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
ringing = np.exp(-sigma * t) * (np.cos(damped * t) - sigma / damped * np.sin(damped * t))
ringing = ringing.astype(np.float32)
inputs = np.array([readout(x, y) for x, y in actuators])


def drive(x, y):
    """The reversed responses, their peak scaled to 1."""
    responses = (inputs * readout(x, y)).astype(np.float32) @ ringing
    reversed_ = responses[:, ::-1].astype(np.float64)
    return reversed_ / np.abs(reversed_).max()


def place(i):
    along = lambda share: (5.0 + 140.0 * ((0.5 + share * (i + 1)) % 1.0)) * 1e-3
    return along(0.7548776662466928), along(0.5698402909980533)


seconds = []
for i in range(points + 20):
    x, y = place(i)
    start = time.perf_counter()
    drive(x, y)
    seconds.append(time.perf_counter() - start)
print("seconds", *seconds[20:])
print("modes", len(omegas))
print("drive", *drive(0.062, 0.090)[0])
