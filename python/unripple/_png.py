"""Pictures as PNG, for what shows neither tables nor SVG: our own figures, or those of matplotlib where there are none."""

from __future__ import annotations

import importlib.util
import io
from collections.abc import Callable, Mapping
from typing import Any

from unripple import _labels, _unripple

#: Dots to an inch: sharp on a screen at the figures' own size. Doubled, a notebook's file is up to four times as large.
_DPI = 150.0


def of_figures(figures: Mapping[str, str], preferred: tuple[str, ...], draw: Callable[[Any], object]) -> bytes | None:
    """Return the first of the `preferred` figures that there is, or any; without figures what `draw` draws, as of_plot()."""
    for name in (*preferred, *figures):
        if name in figures:
            return _unripple.png(figures[name], _DPI)
    return of_plot(draw)


def of_svg(svg: str) -> bytes:
    """Return a drawing as a picture."""
    return _unripple.png(svg, _DPI)


def of_plot(draw: Callable[[Any], object]) -> bytes | None:
    """Return what `draw` draws with matplotlib into axes; None if that is not installed."""
    if importlib.util.find_spec("matplotlib") is None:
        return None
    # Not by pyplot, which would show it a second time.
    figure = _labels.needed("matplotlib.figure", "plot").Figure(layout="constrained")
    draw(figure.add_subplot())
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=_DPI)
    return picture.getvalue()
