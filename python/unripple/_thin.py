"""Curves of figures, reduced to what a screen shows: min-max decimation."""

from __future__ import annotations

import re

import numpy as np

#: Width of a column of which a curve keeps its lowest and highest points alone, in points of 1/72 inch: one pixel of a screen at the
#: figure's own size. Halved, texts are up to twice as long.
_COLUMN = 0.75

#: Points in a column from which on some are left out: fewer than three have no more than their lowest and highest.
_MOST = 3.0

#: A path of straight lines that is not closed, as figures draw curves.
_CURVE = re.compile(r' d="M([-\d. LM]+)"')


def thinned(svg: str) -> str:
    """Return a figure whose long curves, as far as they run rightwards, are their envelopes."""
    return _CURVE.sub(lambda path: ' d="M' + "M".join(map(_run, path[1].split("M"))) + '"', svg)


def _run(run: str) -> str:
    """Return a run of points `x yLx y…` with those alone that can be seen."""
    points = run.split("L")
    if len(points) < _MOST:
        return run
    x, y = np.array([point.split() for point in points], dtype=np.float64).T
    column = np.floor((x - x[0]) / _COLUMN)
    if np.any(np.diff(x) < 0.0) or len(points) < _MOST * (column[-1] + 1.0):
        return run
    first = np.flatnonzero(np.diff(column, prepend=-1.0))
    kept = {0, len(points) - 1}
    for begin, end in zip(first, [*first[1:], len(points)], strict=True):
        kept |= {int(begin + np.argmin(y[begin:end])), int(begin + np.argmax(y[begin:end]))}
    return "L".join(points[index] for index in sorted(kept))
