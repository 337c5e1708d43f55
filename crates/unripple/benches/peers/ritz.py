"""Ritz modes of a clamped rectangle in plain numpy: (1 - x^2)^2 times Legendre polynomials, four symmetry classes."""

import numpy as np
from numpy.polynomial import legendre


class Line:
    """Functions along a side, orthonormal on [-1, 1], of one parity."""

    def __init__(self, count, parity):
        self.degrees = np.arange(parity, count, 2)
        nodes, weights = legendre.leggauss(count + 6)
        series = [self._series(n) for n in self.degrees]
        value, slope, curve = (
            np.array([legendre.legval(nodes, legendre.legder(c, d)) for c in series]) for d in range(3)
        )
        mass = (value * weights) @ value.T
        self.change = np.linalg.inv(np.linalg.cholesky(mass)).T
        self.slopes = self.change.T @ ((slope * weights) @ slope.T) @ self.change
        self.curves = self.change.T @ ((curve * weights) @ curve.T) @ self.change
        self.highest = self.degrees[-1]

    @staticmethod
    def _series(n):
        bell = legendre.poly2leg([1.0, 0.0, -2.0, 0.0, 1.0])
        return legendre.legmul(bell, np.eye(n + 1)[n])

    def at(self, polynomials, x):
        """Values at x, given all Legendre polynomials there."""
        return ((1.0 - x * x) ** 2 * polynomials[self.degrees]) @ self.change


class Ritz:
    """Modes of a square clamped all round, in four classes of symmetry."""

    def __init__(self, count, side, stiffness, tension, density):
        self.lines = [Line(count, 0), Line(count, 1)]
        self.count, self.side = count, side
        self.scale = 2.0 / np.sqrt(density * side * side)
        bend, pull = stiffness / density * (2.0 / side) ** 4, tension / density * (2.0 / side) ** 2
        self.classes = []
        for i, x in enumerate(self.lines):
            for j, y in enumerate(self.lines):
                one = [np.eye(len(line.degrees)) for line in (x, y)]
                energy = bend * (np.kron(x.curves, one[1]) + np.kron(one[0], y.curves))
                energy += 2.0 * bend * np.kron(x.slopes, y.slopes)
                energy += pull * (np.kron(x.slopes, one[1]) + np.kron(one[0], y.slopes))
                squares, shapes = np.linalg.eigh(energy)
                self.classes.append((i, j, np.sqrt(squares), shapes))

    def frequencies_hz(self):
        """All of them, ascending."""
        return np.sort(np.concatenate([c[2] for c in self.classes])) / (2.0 * np.pi)


def film():
    """The paper's membrane: side, bending stiffness, tension, mass per area."""
    thickness, young, poisson = 0.125e-3, 4e9, 0.3
    return 0.15, young * thickness**3 / 12.0 / (1.0 - poisson**2), 200.0, 1400.0 * thickness
