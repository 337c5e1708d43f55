"""How objects show themselves in a notebook: tables, and our own figures."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np
import numpy.typing as npt

from unripple import _thin

if TYPE_CHECKING:
    from unripple._drive import Drive
    from unripple._field import Field
    from unripple._responses import Responses
    from unripple._surface import Surface

#: Rows of a list, and items of a list of values, that a table in a notebook shows.
_MOST_ROWS = 24
_MOST_ITEMS = 8

#: Notebooks align to the right, which suits numbers alone.
_LEFT = 'style="text-align:left"'

#: Width of the drawing of a surface in pixels.
_WIDTH = 280

#: What stands for itself in the address of a picture within quotes: nearly all of a figure, which base64 would make a third longer.
_PLAIN = " !$'()*+,/:;=?@[]^_`{|}~"

#: Decimals of a coordinate in the drawing of a surface, in mm.
_DECIMALS = 2


def table(title: str, rows: Mapping[str, object]) -> str:
    """Return a table of names and values, below a title."""
    body = "".join(
        f"<tr><th {_LEFT}>{html.escape(name)}</th><td {_LEFT}>{html.escape(str(value))}</td></tr>"
        for name, value in rows.items()
    )
    return f"<table><caption {_LEFT}>{html.escape(title)}</caption>{body}</table>"


def pictures(figures: Mapping[str, str]) -> str:
    """Return figures as images, each apart from the others, so that no name in one is taken for that in another."""
    found = []
    for name, svg in figures.items():
        source = f"data:image/svg+xml,{quote(_thin.thinned(svg), safe=_PLAIN)}"
        found.append(
            f'<img alt="{html.escape(name)}" src="{source}" style="background:white;max-width:100%">'
        )
    return "".join(found)


def surface(of: Surface) -> str:
    """Return a surface as a table and a drawing."""
    width, height = (1e3 * side for side in of.extent_m)
    rows = {
        "size": f"{width:g} x {height:g} mm",
        "actuators": f"{len(of.names)} ({', '.join(sorted(set(of.units)))})",
        "band": f"{of.band_hz[0]:g} to {of.band_hz[1]:g} Hz",
        "sample rate": f"{of.rate_hz:g} Hz",
        "limit": f"{of.limit:g}",
    }
    return table(of.name, rows) + drawing(of)


def drawing(of: Surface) -> str:
    """Return the outline and the actuators as SVG, in mm, with y upwards."""
    width, height = (1e3 * side for side in of.extent_m)
    rims = "".join(f"M{_corners(1e3 * rim)}Z" for rim in of.outline_m)
    dot = max(width, height) / 60
    dots = "".join(
        f'<circle cx="{x:.{_DECIMALS}f}" cy="{y:.{_DECIMALS}f}" r="{dot:.{_DECIMALS}f}" fill="#b2182b"/>'
        for x, y in 1e3 * of.actuators_m
    )
    room = dot
    box = f"{-room:g} {-room:g} {width + 2 * room:g} {height + 2 * room:g}"
    rim = f'<path d="{rims}" fill="#e8eef4" fill-rule="evenodd" stroke="#444" stroke-width="{dot / 4:g}"/>'
    turned = f'<g transform="translate(0 {height:g}) scale(1 -1)">{rim}{dots}</g>'
    high = _WIDTH * (height + 2 * room) / (width + 2 * room)
    size = f'width="{_WIDTH}" height="{high:.0f}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="{box}">{turned}</svg>'


def _corners(rim: npt.NDArray[np.float64]) -> str:
    return "L".join(f"{x:.{_DECIMALS}f} {y:.{_DECIMALS}f}" for x, y in rim)


def drive(of: Drive) -> str:
    """Return a drive as a table and its figures."""
    actuators, samples = of.samples.shape
    rows = {
        "actuators": actuators,
        "samples": f"{samples} at {of.rate_hz:g} Hz ({1e3 * of.duration_s:.4g} ms)",
        "peak": f"{of.peak:.4g} {of.unit}",
        "rms": f"{of.rms:.4g} {of.unit}",
        **_targets(of.report.targets if of.report is not None else []),
    }
    return table("drive", rows) + pictures(of.figures)


def field(of: Field) -> str:
    """Return a field as a table and its figures."""
    grid = f"{len(of.points_m)} points" if of.grid is None else f"{of.grid[0]} x {of.grid[1]} cells"
    rows = {"surface": of.surface.name, "evaluated on": grid, **_targets(of.report.targets)}
    return table("field", rows) + pictures(of.figures)


def responses(of: Responses) -> str:
    """Return responses as a table."""
    modes, points = of.frequencies_hz, of.points_m
    rows: dict[str, object] = {
        "actuators": len(of.names),
        "band": f"{of.band_hz[0]:g} to {of.band_hz[1]:g} Hz",
        "sample rate": f"{of.rate_hz:g} Hz",
        "shortest wavelength": f"{1e3 * of.lambda_min_m:.4g} mm",
    }
    if modes is not None:
        rows["modes"] = len(modes)
    if points is not None:
        rows["points"] = f"{len(points)}, of {of.samples} samples each"
    return table(f"responses of {of.source}", rows)


def _targets(targets: Iterable[Mapping[str, object]]) -> dict[str, str]:
    """Return a row for each target: what it is said to reach."""
    found = {}
    for number, target in enumerate(targets, 1):
        parts = []
        for key, name, scale, unit in (
            ("contrast", "contrast", 1.0, ""),
            ("peak_displacement_m", "peak", 1e6, " µm"),
            ("spot_diameter_m", "spot", 1e3, " mm"),
            ("felt_level_db", "felt", 1.0, " dB"),
        ):
            value = target.get(key)
            if isinstance(value, (int, float)):
                parts.append(f"{name} {scale * value:.3g}{unit}")
        found[f"target {number}"] = ", ".join(parts)
    return found


def _shown(value: Any) -> str:
    """Return a single value for a table."""
    if isinstance(value, float):
        return f"{value:.6g}"
    if value is None:
        return "–"
    if isinstance(value, list):
        more = ", …" if len(value) > _MOST_ITEMS else ""
        return ", ".join(_shown(item) for item in value[:_MOST_ITEMS]) + more
    return html.escape(str(value))


def report(data: dict[str, Any]) -> str:
    """Return a table of keys and values, with tables in it."""
    rows = []
    for key, value in data.items():
        cell = _cell(value)
        if key == "run":
            cell = f"<details><summary>how it was made</summary>{cell}</details>"
        rows.append(f"<tr><th {_LEFT}>{html.escape(key)}</th><td {_LEFT}>{cell}</td></tr>")
    return f"<table>{''.join(rows)}</table>"


def _cell(value: Any) -> str:
    if isinstance(value, dict):
        return report(value)
    if isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
        return _rows(value)
    if isinstance(value, str) and "\n" in value:
        return f"<pre>{html.escape(value)}</pre>"
    return _shown(value)


def _rows(items: list[dict[str, Any]]) -> str:
    """Return a table with a row for each of some objects."""
    keys = list(dict.fromkeys(key for item in items for key in item))
    head = "".join(f"<th>{html.escape(key)}</th>" for key in keys)
    body = [
        "".join(f"<td>{_cell(item[key]) if key in item else ''}</td>" for key in keys)
        for item in items[:_MOST_ROWS]
    ]
    if len(items) > _MOST_ROWS:
        body.append(f'<td colspan="{len(keys)}">and {len(items) - _MOST_ROWS} more</td>')
    return f"<table><tr>{head}</tr>{''.join(f'<tr>{row}</tr>' for row in body)}</table>"
