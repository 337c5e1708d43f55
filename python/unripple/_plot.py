"""Drawings by matplotlib, which is imported when it is first needed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from unripple import _labels, _series, _values
from unripple._errors import OptionError
from unripple._motion import UNSCALED, units

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from unripple._drive import Drive
    from unripple._field import Field
    from unripple._motion import Traces
    from unripple._responses import Responses

#: Most actuators that are drawn one above the other: of more none could be told apart.
_MOST = 16

#: Prefixes of units by powers of ten.
_PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: ""}


def axes(ax: Any) -> Axes:
    """Return the axes to draw in: those given, or new ones."""
    if ax is None:
        figure: Any = _labels.needed("matplotlib.pyplot", "plot").figure(layout="constrained")
        made: Axes = figure.add_subplot()
        return made
    if not isinstance(ax, _labels.needed("matplotlib.axes", "plot").Axes):
        raise OptionError(f"ax: expected axes of matplotlib, found {_values.shown(ax)}")
    given: Axes = ax
    return given


def prefixed(largest: float, unit: str) -> tuple[float, str]:
    """Return the factor and the unit with a prefix that suit a largest value; what has no unit of its own has no prefix."""
    if unit == UNSCALED:
        return 1.0, unit
    powers = [power for power in _PREFIXES if largest >= 10.0**power]
    power = max(powers, default=0 if largest == 0.0 else min(_PREFIXES))
    return 10.0**-power, _PREFIXES[power] + unit


def drive(of: Drive, ax: Axes | None) -> Axes:
    """Draw the samples of each actuator, one above the other."""
    drawn = axes(ax)
    shown = of.samples[:_MOST]
    step = 2.2 * of.peak or 1.0
    time = 1e3 * np.arange(shown.shape[1]) / of.rate_hz
    for lane, samples in enumerate(shown):
        drawn.plot(time, samples - lane * step, linewidth=0.8)
    for instant in sorted(set(of.focal_times)):
        drawn.axvline(1e3 * instant, color="0.5", linewidth=0.8, linestyle=":")
    drawn.set_yticks([-lane * step for lane in range(len(shown))], of.names[: len(shown)])
    drawn.set_xlabel("Time (ms)")
    drawn.set_ylabel(f"Actuator (lanes {step:.3g}{' ' + of.unit if of.unit else ''} apart)")
    more = f", first {_MOST} of {len(of.names)}" if len(of.names) > _MOST else ""
    drawn.set_title(f"Drive{more}")
    return drawn


def field(of: Field, time: float | None, quantity: str, ax: Axes | None) -> Axes:
    """Draw the surface at an instant."""
    drawn = axes(ax)
    targets = of.report.targets
    instant = time if time is not None else targets[0].instant_s if targets else 0.0
    series = of.snapshots(instant)
    values = (series.velocity if quantity == "velocity" else series.displacement)[0].astype(np.float64)
    largest = float(np.abs(values).max(initial=0.0))
    factor, unit = prefixed(largest, units(of.scaled)[quantity])
    most = largest * factor or 1.0
    how: dict[str, Any] = {"cmap": "RdBu_r", "vmin": -most, "vmax": most}
    cells = _series.cells(of, values * factor)
    if of.grid is None:
        x, y = 1e3 * of.points_m.T
        picture: Any = drawn.scatter(x, y, c=cells, s=18, **how)
    else:
        places = _labels.centres(of.grid)
        picture = drawn.pcolormesh(1e3 * places["x"], 1e3 * places["y"], cells, shading="nearest", **how)
    for rim in of.surface.outline_m:
        closed = np.vstack([rim, rim[:1]])
        drawn.plot(1e3 * closed[:, 0], 1e3 * closed[:, 1], color="0.3", linewidth=1.0)
    drawn.plot(*(1e3 * of.surface.actuators_m.T), "s", color="0.3", markersize=4)
    for target in targets:
        drawn.plot(*(1e3 * np.asarray(target.at_m)), "+", color="k", markersize=9)
    if drawn.figure is not None:
        drawn.figure.colorbar(picture, ax=drawn, label=f"{quantity.capitalize()} ({unit})")
    drawn.set_aspect("equal")
    drawn.set_xlabel("x (mm)")
    drawn.set_ylabel("y (mm)")
    drawn.set_title(f"{of.surface.name}, t = {1e3 * series.times_s[0]:.2f} ms")
    return drawn


def responses(of: Responses, ax: Axes | None) -> Axes:
    """Draw the decay times of modes, or the sampled responses of the first point."""
    drawn = axes(ax)
    frequencies, decay, sampled = of.frequencies_hz, of.decay_times_s, of.array
    if sampled is None and frequencies is not None and decay is not None:
        drawn.plot(frequencies, 1e3 * decay, ".")
        drawn.set_xlabel("Frequency (Hz)")
        drawn.set_ylabel("Decay time (ms)")
        drawn.set_title(f"Modes of {of.source}")
    elif sampled is not None:
        time = 1e3 * np.arange(sampled.shape[2]) / of.rate_hz
        for name, values in zip(of.names[:_MOST], sampled[0], strict=False):
            drawn.plot(time, values, linewidth=0.8, label=name)
        drawn.legend(fontsize="small")
        drawn.set_xlabel("Time (ms)")
        drawn.set_ylabel("Velocity per unit impulse")
        drawn.set_title(f"Responses at the first point of {of.source}")
    return drawn


def traces(of: Traces, quantity: str, ax: Axes | None) -> Axes:
    """Draw the motion of some places over time, one above the other."""
    drawn = axes(ax)
    shown = (of.velocity if quantity == "velocity" else of.displacement)[:_MOST]
    factor, unit = prefixed(float(np.abs(shown).max(initial=0.0)), of.units[quantity])
    step = 2.2 * factor * float(np.abs(shown).max(initial=0.0)) or 1.0
    for lane, values in enumerate(shown):
        drawn.plot(1e3 * of.times_s, factor * values - lane * step, linewidth=0.8)
    places = [f"({1e3 * x:.4g}, {1e3 * y:.4g})" for x, y in of.points_m[: len(shown)]]
    drawn.set_yticks([-lane * step for lane in range(len(shown))], places)
    drawn.set_xlabel("Time (ms)")
    drawn.set_ylabel(f"Place (mm), lanes apart by {step:.3g} ({unit})")
    more = f", first {_MOST} of {len(of.points_m)}" if len(of.points_m) > _MOST else ""
    drawn.set_title(f"{quantity.capitalize()}{more}")
    return drawn


def curves(data: Mapping[str, Any]) -> Callable[[Axes], None] | None:
    """Return what draws the curves that a report has: of a design the contrast against the window, of modes their decay; None without curves."""
    if data.get("contrast_by_window"):
        return lambda ax: _contrast(data, ax)
    if data.get("frequencies_hz") and data.get("decay_times_s"):
        return lambda ax: _decay(data, ax)
    return None


def _contrast(data: Mapping[str, Any], ax: Axes) -> None:
    """Draw the predicted contrast against the window, a curve for each number of actuators."""
    rows = data["contrast_by_window"]
    windows = [1e3 * row["window_s"] for row in rows]
    for index, actuators in enumerate(data["actuator_counts"]):
        label = f"{actuators} actuator{'s' if actuators > 1 else ''}"
        ax.plot(windows, [row["contrast"][index] for row in rows], label=label)
    ax.axvline(1e3 * data["window_recommended_s"], color="0.5", linewidth=0.8, linestyle=":")
    ax.legend(fontsize="small")
    ax.set_xlabel("Window (ms)")
    ax.set_ylabel("Contrast predicted")
    ax.set_title(str(data["surface"]))


def _decay(data: Mapping[str, Any], ax: Axes) -> None:
    """Draw the decay time of each mode against its frequency; modes that do not decay are left out."""
    both = zip(data["frequencies_hz"], data["decay_times_s"], strict=True)
    found = [(hz, 1e3 * seconds) for hz, seconds in both if seconds is not None]
    ax.plot([hz for hz, _ in found], [ms for _, ms in found], ".")
    ax.set_xlabel("Frequency (Hz)")
    ax.set_ylabel("Decay time (ms)")
    ax.set_title(f"Modes of {data['surface']}")
