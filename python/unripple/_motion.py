"""The motion of a surface at some instants, of some places over time, and of a finger."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from unripple import _values
from unripple._errors import OptionError

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from unripple._report import Report

#: Values (instants x points) of the velocity that are computed unasked: 80 MB of float32, in which a focus of 30 ms on the built-in film fits
#: with every sample. Velocity and displacement are computed together, so both take as much.
MOST_VALUES = 20_000_000

#: What is known but for a factor has no unit of its own.
UNSCALED = "arbitrary unit"


def units(scaled: bool) -> dict[str, str]:
    """Return the units of velocity and displacement, of responses with a scale or without."""
    return {"velocity": "m/s", "displacement": "m"} if scaled else {"velocity": UNSCALED, "displacement": UNSCALED}


class Snapshots(NamedTuple):
    """The field at some instants, a value for each point.

    Attributes
    ----------
    times_s
        Instants in s from the drive's first sample, each that of a sample.
    velocity, displacement
        In m/s and m, float32 of shape (instants, points).

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> field = film.field(film.focus([(40, 50)], window_ms=30))
    >>> times, velocity, displacement = field.snapshots([0.02, 0.03])
    >>> velocity.shape == (2, len(field.points_m))
    True
    """

    times_s: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float32]
    displacement: npt.NDArray[np.float32]


class Traces(NamedTuple):
    """The motion of some places over time.

    Attributes
    ----------
    times_s
        Times in s from the drive's first sample.
    velocity, displacement
        In m/s and m (see ``units``), of shape (places, times).
    points_m
        The places in m, of shape (places, 2).

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> field = film.field(film.focus([(40, 50)], window_ms=30))
    >>> traces = field.traces([(40, 50), (90, 20)], until_ms=40)
    >>> traces.velocity.shape == (2, len(traces.times_s))
    True
    """

    times_s: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    displacement: npt.NDArray[np.float64]
    points_m: npt.NDArray[np.float64]

    def to_xarray(self) -> xr.Dataset:
        """Return both with labels: dimensions ``point`` and ``time`` (s).

        Returns
        -------
        xarray.Dataset

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.traces([(40, 50)], until_ms=40).to_xarray().velocity.dims
        ('point', 'time')
        """
        from unripple import _labels

        coords = {
            "time": self.times_s,
            "x": ("point", self.points_m[:, 0]),
            "y": ("point", self.points_m[:, 1]),
        }
        both = {"velocity": self.velocity, "displacement": self.displacement}
        named = {
            name: _labels.array(values, ("point", "time"), coords, name, self.units[name])
            for name, values in both.items()
        }
        return _labels.dataset(named)

    @property
    def units(self) -> dict[str, str]:
        """Units of velocity and displacement."""
        return units(True)

    def plot(self, quantity: Literal["velocity", "displacement"] = "velocity", ax: Axes | None = None) -> Axes:
        """Draw the motion of each place against time, one above the other.

        Parameters
        ----------
        quantity
            ``"velocity"`` or ``"displacement"``.
        ax
            Axes of matplotlib to draw in; new ones by default.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ImportError
            If matplotlib is not installed.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.traces([(40, 50)], until_ms=40).plot().get_xlabel()
        'Time (ms)'
        """
        from unripple import _plot

        if _values.text("quantity", quantity) not in self.units:
            raise OptionError(f"quantity: expected velocity or displacement, found {quantity}")
        return _plot.traces(self, quantity, ax)

    def _repr_png_(self) -> bytes | None:
        from unripple import _png

        return _png.of_plot(lambda ax: self.plot(ax=ax))


class UnscaledTraces(Traces):
    """The motion of some places over time, of responses without a scale: known but for a factor."""

    __slots__ = ()

    @property
    def units(self) -> dict[str, str]:
        """Units of velocity and displacement, which nobody knows."""
        return units(False)


class FingerMotion(NamedTuple):
    """Motion of a finger on a simulated surface after a block.

    Attributes
    ----------
    grip
        How far it is in contact, 0 to 1.
    force_n
        Force on it in N.
    velocity_m_s
        Velocity of the sheet under it in m/s.
    displacement_m
        Displacement of the finger in m.
    power_w
        Mean power into it over the block in W.

    Examples
    --------
    >>> import unripple as ur
    >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual()
    >>> virtual.finger_motion(0) is None
    True
    """

    grip: float
    force_n: float
    velocity_m_s: float
    displacement_m: float
    power_w: float


def span(report: Report, known: int, rate_hz: float) -> tuple[int, int]:
    """Return the first and the last sample of the span that a report evaluates, as far as the field is known."""
    spans = [target.span_s for target in report.targets if target.span_s is not None]
    first = min((one[0] for one in spans), default=0.0)
    last = max((one[1] for one in spans), default=0.0)
    return min(round(first * rate_hz), known - 1), min(round(last * rate_hz), known - 1)


def instants(
    report: Report, within: tuple[int, int], rate_hz: float, points: int
) -> tuple[npt.NDArray[np.float64], int]:
    """Return instants (s) for a series that is not too large, the focal ones among them, and their distance in samples."""
    first, last = within
    every = -(-(last - first + 1) * points // MOST_VALUES)
    focal = sorted({round(target.instant_s * rate_hz) for target in report.targets})
    kept = [sample for sample in focal if first <= sample <= last]
    start = first + (kept[0] - first) % every if kept else first
    samples = np.union1d(np.arange(start, last + 1, every), kept).astype(np.float64)
    return samples / rate_hz, every
