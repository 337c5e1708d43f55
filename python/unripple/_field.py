"""Fields: the motion that a drive causes on a surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NoReturn

import numpy as np
import numpy.typing as npt

from unripple import _series, _unripple, _values
from unripple._drive import given
from unripple._errors import OptionError
from unripple._motion import Snapshots, Traces, UnscaledTraces
from unripple._progress import ProgressCallback, Telling
from unripple._report import Report
from unripple._typed import Typed

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from unripple import _types
    from unripple._animation import Animation
    from unripple._surface import Surface

_Quantity = Literal["velocity", "displacement"]


class Field:
    """The motion that a drive causes on a surface: report, maps, and the motion at any instant and place.

    It is made by :meth:`Surface.field` and :meth:`Responses.field`. On a surface it is evaluated on a grid, on a library at the library's
    own points. Of responses without a scale, velocities and displacements are known but for a factor.

    Attributes
    ----------
    report : Report
    scaled : bool
    velocity, displacement : xarray.DataArray
    points_m : numpy.ndarray
    peak_velocity, peak_displacement : numpy.ndarray
    felt_db : numpy.ndarray or None
    outside : numpy.ndarray
    rate_hz : float

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> drive = film.focus([(40, 50)], window_ms=30)
    >>> field = film.field(drive)
    >>> field.velocity.sel(time=drive.focal_time, method="nearest").dims
    ('y', 'x')
    """

    __slots__ = ("_figures", "_labelled", "_raw", "_report", "_series", "_surface")

    _raw: _unripple.Field
    _surface: Surface
    _report: Report
    _figures: dict[str, str] | None
    _series: Snapshots | None
    _labelled: dict[str, xr.DataArray]

    def __init__(self) -> None:
        raise OptionError("Field: expected film.field(drive) or responses.field(drive), found Field()")

    @classmethod
    def _of(cls, raw: _unripple.Field, surface: Surface) -> Field:
        """Make a field of one that the library has made."""
        field = cls.__new__(cls)
        field._raw, field._surface, field._report = raw, surface, Report._of(raw.done)
        field._figures, field._series, field._labelled = None, None, {}
        return field

    @property
    def report(self) -> Report:
        """The report, as the command `field` prints it."""
        return self._report

    @property
    def surface(self) -> Surface:
        """The surface that moves."""
        return self._surface

    @property
    def points_m(self) -> npt.NDArray[np.float64]:
        """Points that maps and snapshots have values for, in m, of shape (points, 2)."""
        return self._raw.points_m

    @property
    def grid(self) -> tuple[int, int, float, float] | None:
        """Columns and rows of the grid, and width and height of its cells in m; None on a library."""
        return self._raw.grid

    @property
    def rate_hz(self) -> float:
        """Sample rate in Hz."""
        return self._raw.rate_hz

    @property
    def known(self) -> int:
        """Number of samples, from the drive's first, for which the field is known."""
        return self._raw.known

    @property
    def scaled(self) -> bool:
        """Whether velocities are in m/s and displacements in m; otherwise they are known but for a factor."""
        return self._raw.scaled

    @property
    def peak_velocity(self) -> npt.NDArray[np.float32]:
        """Largest magnitude of the velocity at each point over the span evaluated, in m/s."""
        return self._raw.peak_velocity

    @property
    def peak_displacement(self) -> npt.NDArray[np.float32]:
        """Largest magnitude of the displacement at each point over the span evaluated, in m."""
        return self._raw.peak_displacement

    @property
    def felt_db(self) -> npt.NDArray[np.float32] | None:
        """Largest vibration at each point as felt, in dB above the threshold of touch; None without a scale."""
        return self._raw.felt_db

    @property
    def outside(self) -> npt.NDArray[np.bool_]:
        """Whether each point lies outside the focal discs."""
        return self._raw.outside

    @property
    def figures(self) -> dict[str, str]:
        """Figures of the report, as SVG texts by their names."""
        if self._figures is None:
            self._figures = self._raw.figures
        return dict(self._figures)

    @property
    def velocity(self) -> xr.DataArray:
        """Velocity in m/s, of dimensions (time, y, x), NaN outside the outline; on a library (time, point).

        It is computed when it is first asked for, over the span that the report evaluates. If that is more than about 20 million values,
        instants are left out evenly around the focal ones, which `attrs["every"]` and a warning say: see :meth:`velocity_at`.
        """
        return _series.labelled(self, "velocity")

    @property
    def displacement(self) -> xr.DataArray:
        """Displacement in m, as :attr:`velocity`."""
        return _series.labelled(self, "displacement")

    def velocity_at(self, times: _types.Times) -> xr.DataArray:
        """Return the velocity at instants of one's own.

        Parameters
        ----------
        times
            Instants in s from the drive's first sample, each rounded to a sample.

        Returns
        -------
        xarray.DataArray
            In m/s, of dimensions (time, y, x), NaN outside the outline; on a library (time, point).

        Raises
        ------
        InputError
            Of instants at which the field is not known, or of too many.
        ImportError
            If xarray is not installed.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.velocity_at([0.02, 0.03]).sizes["time"]
        2
        """
        return _series.at(self, self.snapshots(times), "velocity")

    def displacement_at(self, times: _types.Times) -> xr.DataArray:
        """Return the displacement at instants of one's own, in m, as :meth:`velocity_at`.

        Parameters
        ----------
        times
            Instants in s from the drive's first sample, each rounded to a sample.

        Returns
        -------
        xarray.DataArray

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.displacement_at(0.03).attrs["units"]
        'm'
        """
        return _series.at(self, self.snapshots(times), "displacement")

    def snapshots(self, times: _types.Times) -> Snapshots:
        """Return velocity and displacement of all points at some instants.

        Parameters
        ----------
        times
            Instants in s from the drive's first sample, each rounded to a sample. Ask for many at once: each call prepares anew.

        Returns
        -------
        Snapshots
            ``times_s``, and ``velocity`` (m/s) and ``displacement`` (m) of shape (instants, points).

        Raises
        ------
        InputError
            Of instants at which the field is not known, or of too many.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.snapshots(0.03).velocity.shape[0]
        1
        """
        asked = _values.times("times", times)
        velocity, displacement = self._raw.snapshots(asked)
        samples = np.round(np.asarray(asked) * self.rate_hz)
        return Snapshots(samples / self.rate_hz, velocity, displacement)

    def traces(self, points_mm: _types.Places, until_ms: float | None = None) -> Traces:
        """Return velocity and displacement of some places over time.

        Parameters
        ----------
        points_mm
            Places in mm, of shape (places, 2), or one alone.
        until_ms
            Time in ms up to which they are wanted; by default the end of the span that the report evaluates.

        Returns
        -------
        Traces
            ``times_s``, ``velocity`` (m/s) and ``displacement`` (m) of shape (places, times), and ``points_m``.

        Raises
        ------
        InputError
            Of places without responses, and of times at which the field is not known.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.traces((40, 50)).velocity.shape[0]
        1
        """
        points = np.asarray(_values.places("points_mm", points_mm), dtype=np.float64).reshape(-1, 2)
        until = _series.end_s(self) if until_ms is None else _values.milli("until_ms", until_ms)
        with Typed(points_m=("points_mm", points_mm), until_s=("until_ms", until_ms)):
            velocity, displacement = self._raw.traces(points, until)
        traces = Traces if self.scaled else UnscaledTraces
        return traces(np.arange(velocity.shape[1]) / self.rate_hz, velocity, displacement, points)

    def maps(self) -> xr.Dataset:
        """Return the maps over the surface: what is largest over the span evaluated.

        Returns
        -------
        xarray.Dataset
            ``peak_velocity`` (m/s), ``peak_displacement`` (m), ``felt`` (dB above the threshold of touch, if it is known) and ``outside``
            (whether a point lies outside the focal discs), of dimensions (y, x), or (point) on a library.

        Raises
        ------
        ImportError
            If xarray is not installed.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.maps().peak_velocity.dims
        ('y', 'x')
        """
        return _series.maps(self)

    def plot(
        self, time: float | None = None, *, quantity: _Quantity = "velocity", ax: Axes | None = None
    ) -> Axes:
        """Draw the surface at an instant: the field in colours, the rim, the actuators and the places evaluated.

        Parameters
        ----------
        time
            Instant in s; by default that of the report's first target.
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
        >>> field.plot().get_xlabel()
        'x (mm)'
        """
        from unripple import _plot

        if _values.text("quantity", quantity) not in ("velocity", "displacement"):
            raise OptionError(f"quantity: expected velocity or displacement, found {quantity}")
        return _plot.field(self, time, quantity, ax)

    def animation(
        self,
        movie_ms: _types.Row | None = None,
        *,
        frames: int = 60,
        progress: bool | ProgressCallback | None = None,
    ) -> Animation:
        """Return the displacement in motion, as the command `field` writes it in its folder.

        Parameters
        ----------
        movie_ms
            Start and end in ms from the drive's first sample; by default from 6 ms before the instant of the first place to 3 ms after.
        frames
            Number of frames, 1 to 5000, of which a second shows 15.
        progress
            How progress is shown, as for :func:`set_progress`.

        Returns
        -------
        Animation
            An animated PNG, which notebooks show; ``save`` writes it.

        Raises
        ------
        AskError
            Of a span or a number of frames that cannot be.
        InputError
            At the points of a library, which are no grid.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> field = film.field(film.focus([(40, 50)], window_ms=30))
        >>> field.animation((28, 31), frames=3)._repr_html_()[:4]
        '<img'
        """
        from unripple._animation import Animation

        count = _values.count("frames", frames)
        span = None if movie_ms is None else _values.span_ms("movie_ms", movie_ms)
        with Typed(movie_s=("movie_ms", movie_ms)), Telling(progress) as telling:
            return Animation(self._raw.animation(count, span, telling), count)

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return given(_series.cells(self, _series.everything(self).velocity), dtype, copy)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a field cannot be pickled: keep its surface and its drive")

    def __repr__(self) -> str:
        grid = self.grid
        where = f"{len(self.points_m)} points" if grid is None else f"{grid[0]} x {grid[1]} cells"
        return f"<Field on {self._surface.name!r}: {where}, {len(self._report.targets)} places evaluated>"

    def _repr_html_(self) -> str:
        from unripple import _html

        return _html.field(self)

    def _repr_png_(self) -> bytes | None:
        from unripple import _png

        return _png.of_figures(self.figures, ("snapshot", "peaks"), lambda ax: self.plot(ax=ax))
