"""Modes of a clamped film of any convex outline by scikit-fem: Argyris elements, ARPACK by shift and invert.

Arguments: number of modes, edge length in metres, runs, then the outline's vertices x y ... in metres. Prints `seconds`,
`unknowns` and `hz`. The mesh is a triangular lattice, the best there is for its number of unknowns, and is not timed.
"""

import sys
import time

import numpy as np
import skfem
from ritz import film
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import eigsh
from scipy.spatial import Delaunay
from skfem.helpers import dd, ddot, dot, grad, trace

POISSON = 0.3
_, STIFFNESS, TENSION, DENSITY = film()


@skfem.BilinearForm
def energy(u, v, w):
    bending = (1.0 - POISSON) * ddot(dd(u), dd(v)) + POISSON * trace(dd(u)) * trace(dd(v))
    return STIFFNESS * bending + TENSION * dot(grad(u), grad(v))


@skfem.BilinearForm
def mass(u, v, w):
    return DENSITY * u * v


def mesh(corners, size):
    nexts = np.roll(corners, -1, axis=0)
    rim = []
    for a, b in zip(corners, nexts):
        pieces = max(1, round(np.hypot(*(b - a)) / size))
        rim.extend(a + (b - a) * i / pieces for i in range(pieces))
    low, high = corners.min(axis=0), corners.max(axis=0)
    rows = np.arange(low[1], high[1] + size, size * np.sqrt(0.75))
    lattice = [
        (x + 0.5 * size * (i % 2), y) for i, y in enumerate(rows) for x in np.arange(low[0], high[0] + size, size)
    ]
    normals = np.stack([corners[:, 1] - nexts[:, 1], nexts[:, 0] - corners[:, 0]], axis=1)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    inside = [p for p in lattice if np.min(np.sum((np.array(p) - corners) * normals, axis=1)) > 0.6 * size]
    points = np.array(rim + inside)
    triangles = Delaunay(points).simplices
    p = points[triangles]
    one, two = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    area = 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    return skfem.MeshTri(points.T, triangles[area > 1e-6 * size**2].T)


def reduction(grid, basis):
    """From free unknowns to all: on a clamped side only the second derivative along the normal is left, at corners nothing."""
    rim = grid.boundary_facets()
    ends = grid.facets[:, rim]
    along = grid.p[:, ends[1]] - grid.p[:, ends[0]]
    normals = np.stack([-along[1], along[0]]) / np.linalg.norm(along, axis=0)
    vertices = np.unique(ends)
    held = np.concatenate([basis.nodal_dofs[:, vertices].ravel(), basis.facet_dofs[:, rim].ravel()])
    free = np.setdiff1d(np.arange(basis.N), held)
    rows, columns, values = list(free), list(range(len(free))), [1.0] * len(free)
    count = len(free)
    for vertex in vertices:
        one, two = (normals[:, i] for i in np.flatnonzero(np.any(ends == vertex, axis=0)))
        if abs(one[0] * two[1] - one[1] * two[0]) < 1e-9:
            x, y = one
            rows.extend(basis.nodal_dofs[3:, vertex])
            columns.extend([count] * 3)
            values.extend([x * x, x * y, y * y])
            count += 1
    return csc_matrix((values, (rows, columns)), shape=(basis.N, count))


def frequencies(grid, count):
    basis = skfem.Basis(grid, skfem.ElementTriArgyris(), intorder=10)
    free = reduction(grid, basis)
    stiffness, inertia = (free.T @ form.assemble(basis) @ free for form in (energy, mass))
    squares, _ = eigsh(stiffness.tocsc(), k=count, M=inertia.tocsc(), sigma=0.0)
    return free.shape[1], np.sort(np.sqrt(squares)) / (2.0 * np.pi)


def main():
    count, size, runs = int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
    grid = mesh(np.array(sys.argv[4:], dtype=float).reshape(-1, 2), size)
    seconds = []
    for _ in range(runs):
        start = time.perf_counter()
        unknowns, hz = frequencies(grid, count)
        seconds.append(time.perf_counter() - start)
    print("seconds", *seconds)
    print("unknowns", unknowns)
    print("hz", *hz)


if __name__ == "__main__":
    main()
