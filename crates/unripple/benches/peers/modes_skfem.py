"""Modes by scikit-fem: Bogner-Fox-Schmit elements, 48 x 48, ARPACK by shift and invert. Arguments and output as modes_numpy.py."""

import sys
import time

import numpy as np
import skfem
from ritz import film
from scipy.sparse.linalg import eigsh
from skfem.helpers import dd, ddot, dot, grad, trace

CELLS, POISSON = 48, 0.3
SIDE, STIFFNESS, TENSION, DENSITY = film()


@skfem.BilinearForm
def energy(u, v, w):
    bending = (1.0 - POISSON) * ddot(dd(u), dd(v)) + POISSON * trace(dd(u)) * trace(dd(v))
    return STIFFNESS * bending + TENSION * dot(grad(u), grad(v))


@skfem.BilinearForm
def mass(u, v, w):
    return DENSITY * u * v


def frequencies(count):
    axis = np.linspace(0.0, SIDE, CELLS + 1)
    basis = skfem.Basis(skfem.MeshQuad.init_tensor(axis, axis), skfem.ElementQuadBFS())
    # Along a clamped edge u and its normal slope vanish, and with them both derivatives along it: all four unknowns.
    free = basis.complement_dofs(basis.get_dofs())
    stiffness, inertia = (form.assemble(basis)[free][:, free] for form in (energy, mass))
    squares, _ = eigsh(stiffness, k=count, M=inertia, sigma=0.0)
    return np.sort(np.sqrt(squares)) / (2.0 * np.pi)


count, runs = int(sys.argv[1]), int(sys.argv[2])
seconds = []
for _ in range(runs):
    start = time.perf_counter()
    hz = frequencies(count)
    seconds.append(time.perf_counter() - start)
print("seconds", *seconds)
print("hz", *hz)
