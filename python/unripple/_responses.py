"""Responses: what a surface does, from each actuator to each point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from unripple import _png, _unripple, _values
from unripple._drive import channel_names, floats, given
from unripple._errors import AskError, InputError, OptionError
from unripple._focusing import Focusing
from unripple._progress import Telling, chosen_threads
from unripple._surface import Surface
from unripple._typed import Typed, of_places

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from matplotlib.axes import Axes

    from unripple import _types


class Responses(Focusing):
    """Impulse responses of a surface: velocity at its points for a unit impulse at each actuator. Immutable.

    They are made by :meth:`Surface.responses`, :func:`open` (of a library on disk) and :meth:`from_numpy` (of measurements of one's own).
    Those of a model are a sum of modes, which gives the response at any point; others are samples at their own points.

    Attributes
    ----------
    kind : str
    source : str
    surface : Surface
    names : list of str
    actuators_m : numpy.ndarray
    rate_hz : float
    band_hz : tuple of float
    lambda_min_m : float
    points_m, array : numpy.ndarray or None
    samples : int or None
    frequencies_hz, decay_times_s, input : numpy.ndarray or None

    Examples
    --------
    >>> import unripple as ur
    >>> responses = ur.Surface("hudin-2012", band_hz=[0, 500]).responses()
    >>> responses.impulse([(62, 90)], length_ms=10).shape
    (1, 8, 481)
    """

    __slots__ = ("_made", "_named", "_raw", "_surface")

    _raw: _unripple.Responses
    _made: tuple[Callable[..., Responses], tuple[Any, ...]]
    _named: Surface | str | None
    _surface: Surface | None

    def __init__(self) -> None:
        raise OptionError(
            "Responses: expected film.responses(), open(path) or Responses.from_numpy(…), found Responses()"
        )

    @classmethod
    def _of(
        cls,
        raw: _unripple.Responses,
        made: tuple[Callable[..., Responses], tuple[Any, ...]],
        named: Surface | str | None = None,
    ) -> Responses:
        """Make responses of those that the library has made.

        `made` is how they are made again; `named` is the surface or the library from which a task by itself makes the same, if there is one.
        """
        responses = cls.__new__(cls)
        responses._raw, responses._made, responses._named = raw, made, named
        responses._surface = named if isinstance(named, Surface) else None
        return responses

    @classmethod
    def _of_known(cls, surface: Surface, raw: _unripple.Responses) -> Responses:
        """Return the responses of a surface that have been computed."""
        return cls._of(raw, (_of_surface_again, (surface, None, [])), surface)

    @classmethod
    def _of_surface(
        cls, surface: Surface, max_hz: object, fingers_m: list[list[float]], options: Mapping[str, Any]
    ) -> Responses:
        top = None if max_hz is None else _values.number("max_hz", max_hz)
        fingers = [(x, y) for x, y in fingers_m]
        threads = chosen_threads(options.get("threads"))
        with Telling(options.get("progress")) as telling, Typed(fingers_m=("fingers_mm", fingers_m)):
            raw = _unripple.Responses.of_surface(surface._raw, top, fingers, telling, threads)
        plain = top is None and not fingers
        return cls._of(raw, (_of_surface_again, (surface, top, fingers_m)), surface if plain else None)

    @classmethod
    def from_numpy(
        cls,
        h: npt.ArrayLike,
        *,
        rate_hz: float,
        points_mm: _types.Places,
        actuators_mm: _types.Places,
        names: Sequence[str] | None = None,
        band_hz: tuple[float, float] | None = None,
        lambda_min_mm: float | None = None,
        surface: _types.SurfaceLike | None = None,
        scaled: bool = False,
    ) -> Responses:
        """Make responses of measurements of one's own.

        Parameters
        ----------
        h
            Velocities for a unit impulse at each actuator, from the impulse on: shape (points, actuators, samples), float32 or float64.
        rate_hz
            Sample rate in Hz.
        points_mm, actuators_mm, names
            Places in mm of the points and of the actuators, each of shape (…, 2), and names of the actuators; a1, a2 and so on by default.
        band_hz, lambda_min_mm
            Band in Hz, by default the surface's, or 0 to 0.45 of the rate; shortest wavelength in mm (of a focus), needed without a surface.
        surface
            The surface that was measured, for its outline and its limits.
        scaled
            Whether `h` is in m/s for an impulse of 1 N s, A s or V s; otherwise absolute levels are unknown.

        Returns
        -------
        Responses

        Raises
        ------
        InputError
            Of values that are not finite, and of numbers of points and actuators that do not fit.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> points = [(40, 50), (62, 90), (90, 110)]
        >>> h = film.responses().impulse(points, length_ms=50)
        >>> own = ur.Responses.from_numpy(h, rate_hz=48000, points_mm=points, actuators_mm=1e3 * film.actuators_m,
        ...                               names=film.names, band_hz=(0, 500), lambda_min_mm=60)
        >>> own.kind, own.array.shape
        ('sampled', (3, 8, 2401))
        """
        values = floats("h", h, "points", "actuators", "samples")
        known = {
            "rate_hz": _values.number("rate_hz", rate_hz),
            "points_m": _distinct("points_mm", points_mm),
            "names": channel_names(names, values.shape[1]),
            "actuators_m": _metres("actuators_mm", actuators_mm),
            "scaled": _values.flag("scaled", scaled),
        }
        with of_places(points_mm, actuators_mm, lambda_min_mm):
            return cls._of_array(values, {**known, **_of_waves(band_hz, lambda_min_mm, surface)})

    @classmethod
    def _of_array(cls, h: npt.NDArray[Any], known: dict[str, Any]) -> Responses:
        surface = None if known["surface"] is None else known["surface"]._raw
        raw = _unripple.Responses.from_array(h, **{**known, "surface": surface})
        return cls._of(raw, (_of_array_again, (known,)))

    @property
    def kind(self) -> str:
        """``"modal"``: a sum of modes, known everywhere; ``"sampled"``: samples at some points."""
        return self._raw.kind

    @property
    def source(self) -> str:
        """What they are of, for people: a surface's name, a library's path, or ``"array"``."""
        return self._raw.source

    @property
    def surface(self) -> Surface:
        """The surface that responds; made up of the points where none was given."""
        if self._surface is None:
            self._surface = Surface._of(self._raw.surface)
        return self._surface

    @property
    def names(self) -> list[str]:
        """Names of the actuators."""
        return self._raw.names

    @property
    def actuators_m(self) -> npt.NDArray[np.float64]:
        """Places of the actuators in m, of shape (actuators, 2)."""
        return self._raw.actuators_m

    @property
    def rate_hz(self) -> float:
        """Sample rate in Hz."""
        return self._raw.rate_hz

    @property
    def band_hz(self) -> tuple[float, float]:
        """Lowest and highest frequency in Hz."""
        return self._raw.band_hz

    @property
    def lambda_min_m(self) -> float:
        """Shortest wavelength in m."""
        return self._raw.lambda_min_m

    @property
    def points_m(self) -> npt.NDArray[np.float64] | None:
        """Points of sampled responses in m, of shape (points, 2); None of a sum of modes."""
        return self._raw.points_m

    @property
    def samples(self) -> int | None:
        """Samples of each response; None of a sum of modes."""
        return self._raw.samples

    @property
    def array(self) -> npt.NDArray[np.float32] | None:
        """Sampled responses, float32 of shape (points, actuators, samples), read-only; None of a sum of modes."""
        return self._raw.array

    @property
    def frequencies_hz(self) -> npt.NDArray[np.float64] | None:
        """Natural frequencies of a sum of modes in Hz; None of sampled responses."""
        return self._raw.frequencies_hz

    @property
    def decay_times_s(self) -> npt.NDArray[np.float64] | None:
        """Times in s in which the amplitude of each mode falls to 1/e; None of sampled responses."""
        return self._raw.decay_times_s

    @property
    def input(self) -> npt.NDArray[np.float64] | None:
        """Weights of the actuators in each mode, of shape (actuators, modes); None of sampled responses."""
        return self._raw.input

    def impulse(self, points_mm: _types.Places, length_ms: float) -> npt.NDArray[np.float32]:
        """Return impulse responses at some points.

        Parameters
        ----------
        points_mm
            Places in mm, of shape (points, 2), or one alone; of sampled responses, their own points.
        length_ms
            Length of the responses in ms.

        Returns
        -------
        numpy.ndarray
            Velocities of shape (points, actuators, samples).

        Raises
        ------
        InputError
            Of points without responses.

        Examples
        --------
        >>> import unripple as ur
        >>> responses = ur.Surface("hudin-2012", band_hz=[0, 500]).responses()
        >>> responses.impulse((62, 90), length_ms=5).shape
        (1, 8, 241)
        """
        points, length = _metres("points_mm", points_mm), _values.milli("length_ms", length_ms)
        with Typed(points_m=("points_mm", points_mm), length_s=("length_ms", length_ms)):
            return self._raw.impulse(points, length)

    def to_xarray(self) -> xr.Dataset:
        """Return them with labels.

        Returns
        -------
        xarray.Dataset
            Of sampled responses ``h`` of dimensions (point, actuator, time), without a copy; of a sum of modes ``frequency`` (Hz),
            ``decay_time`` (s) and ``input`` of dimensions (actuator, mode).

        Raises
        ------
        ImportError
            If xarray is not installed.

        Examples
        --------
        >>> import unripple as ur
        >>> responses = ur.Surface("hudin-2012", band_hz=[0, 500]).responses()
        >>> responses.to_xarray()["input"].dims
        ('actuator', 'mode')
        """
        from unripple import _labels

        return _labels.responses(self)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the decay time of each mode against its frequency, or the sampled responses of the first point against time.

        Parameters
        ----------
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
        >>> ur.Surface("hudin-2012", band_hz=[0, 500]).responses().plot().get_xlabel()
        'Frequency (Hz)'
        """
        from unripple import _plot

        return _plot.responses(self, ax)

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        if self.array is None:
            raise InputError(
                "responses: expected samples, found a sum of modes (impulse() gives samples of it)"
            )
        return given(self.array, dtype, copy)

    def __reduce__(self) -> tuple[Any, ...]:
        again, arguments = self._made
        if again is _of_array_again:
            arguments = (np.array(self.array), *arguments)
        return again, arguments

    def __repr__(self) -> str:
        many = 0 if self.frequencies_hz is None else len(self.frequencies_hz)
        what = (
            f"{many} modes"
            if self.points_m is None
            else f"{len(self.points_m)} points, {self.samples} samples"
        )
        return f"<Responses of {self.source}: {what}, {len(self.names)} actuators>"

    def _repr_html_(self) -> str:
        from unripple import _html

        return _html.responses(self)

    def _repr_png_(self) -> bytes | None:
        return _png.of_plot(self.plot)

    def _chosen(self, options: dict[str, Any]) -> Responses:
        if options.get("set") is not None:
            raise OptionError("set: expected a surface, whose keys it sets, found responses")
        return self

    def _extent(self) -> tuple[float, float]:
        return self.surface.extent_m


def _metres(name: str, places_mm: object) -> npt.NDArray[np.float64]:
    """Return places given in mm as an array in m, of shape (places, 2)."""
    return np.array(_values.places(name, places_mm), dtype=np.float64).reshape(-1, 2)


def _distinct(name: str, places_mm: object) -> npt.NDArray[np.float64]:
    """Return places as `_metres` does; refuse two that are the same, whose responses would be those of other places."""
    places = _metres(name, places_mm)
    seen: dict[tuple[float, ...], int] = {}
    for index, place in enumerate(places.tolist()):
        before = seen.setdefault(tuple(place), index)
        if before != index:
            raise AskError(field=name, expected="places that differ", found=f"the same at {before} and {index}")
    return places


def _of_surface_again(surface: Surface, max_hz: float | None, fingers_m: list[list[float]]) -> Responses:
    plain = max_hz is None and not fingers_m
    return surface.responses() if plain else Responses._of_surface(surface, max_hz, fingers_m, {})


def _of_array_again(h: npt.NDArray[np.float32], known: dict[str, Any]) -> Responses:
    return Responses._of_array(h, known)


def _of_waves(band_hz: Any, lambda_min_mm: Any, surface: Any) -> dict[str, Any]:
    """Return what is known of the waves of responses, each None where it is not."""
    row = None if band_hz is None else _values.row("band_hz", band_hz, "lowest and highest in Hz", 2, 2)
    return {
        "band_hz": None if row is None else (row[0], row[1]),
        "lambda_min_m": None if lambda_min_mm is None else _values.milli("lambda_min_mm", lambda_min_mm),
        "surface": surface if surface is None or isinstance(surface, Surface) else Surface(surface),
    }
