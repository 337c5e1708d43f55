"""Drives: what the actuators are sent."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from unripple import _unripple, _values
from unripple._errors import AskError, OptionError
from unripple._report import Report

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from unripple import _types

#: What an array of single or double precision is; anything else is converted to the latter.
_FLOATS = (np.float32, np.float64)


class Drive:
    """What every actuator is sent, in its own unit (N, A or V). Immutable.

    Parameters
    ----------
    samples
        Samples of shape (actuators, samples), float32 or float64; they are copied.
    rate_hz
        Sample rate in Hz.
    names
        Names of the actuators; a1, a2 and so on by default.

    Attributes
    ----------
    samples : numpy.ndarray
    rate_hz : float
    names : list of str
    peak, rms, energy : float
    report : Report or None
    focal_time : float or None

    Raises
    ------
    InputError
        Of samples that are not finite, of another number of names, or of a rate that is not above 0.

    Examples
    --------
    >>> import numpy as np
    >>> import unripple as ur
    >>> drive = ur.Drive(np.zeros((8, 480), np.float32), rate_hz=48000)
    >>> np.asarray(drive).shape, drive.names[0], drive.report is None
    ((8, 480), 'a1', True)
    """

    __slots__ = ("_figures", "_focused", "_raw", "_report")

    _raw: _unripple.Drive
    _report: Report | None
    _focused: _unripple.Focused | None
    _figures: dict[str, str] | None

    def __init__(self, samples: npt.ArrayLike, *, rate_hz: float, names: Sequence[str] | None = None) -> None:
        values = floats("samples", samples, "actuators", "samples")
        rate = _values.number("rate_hz", rate_hz)
        self._raw = _unripple.Drive(values, rate, channel_names(names, len(values)))
        self._report, self._focused, self._figures = None, None, {}

    @classmethod
    def _of(
        cls, raw: _unripple.Drive, report: Report | None = None, focused: _unripple.Focused | None = None
    ) -> Drive:
        """Make a drive of one that the library has made; its figures are drawn when they are first asked for."""
        drive = cls.__new__(cls)
        drive._raw, drive._report, drive._focused = raw, report, focused
        drive._figures = None if focused is not None else {}
        return drive

    @classmethod
    def from_wav(cls, path: _types.Path, names: Sequence[str] | None = None) -> Drive:
        """Read a drive from a WAV file.

        Parameters
        ----------
        path
            A file with a channel for each actuator: float samples in the actuators' units, whole numbers with full scale as 1.
        names
            Names of the actuators; a1, a2 and so on by default.

        Returns
        -------
        Drive

        Raises
        ------
        InputError
            Of a file that cannot be read, and of another number of names.

        Examples
        --------
        >>> import os, tempfile
        >>> import numpy as np
        >>> import unripple as ur
        >>> drive = ur.Drive(np.zeros((2, 480)), rate_hz=48000)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     drive.to_wav(os.path.join(folder, "drive.wav"))
        ...     again = ur.Drive.from_wav(os.path.join(folder, "drive.wav"))
        >>> again.samples.shape
        (2, 480)
        """
        called = None if names is None else _values.texts("names", names)
        return cls._of(_unripple.read_wav(_values.path("path", path), called))

    @property
    def samples(self) -> npt.NDArray[np.float64]:
        """Samples in the actuators' units, of shape (actuators, samples); read-only, each time a view of the same memory."""
        return self._raw.samples

    @property
    def rate_hz(self) -> float:
        """Sample rate in Hz."""
        return self._raw.rate_hz

    @property
    def names(self) -> list[str]:
        """Names of the actuators, in the order of the rows."""
        return self._raw.names

    @property
    def peak(self) -> float:
        """Largest magnitude of all samples, in the drive's unit."""
        return self._raw.peak

    @property
    def rms(self) -> float:
        """Root mean square of all samples, in the drive's unit."""
        return self._raw.rms

    @property
    def energy(self) -> float:
        """Integral of the square summed over the actuators, in the drive's unit squared times s."""
        return self._raw.energy

    @property
    def duration_s(self) -> float:
        """Length of the drive in s."""
        return float(self.samples.shape[1] / self.rate_hz)

    @property
    def report(self) -> Report | None:
        """The report of the focus that the drive was computed for; None for samples of other origin."""
        return self._report

    @property
    def focal_time(self) -> float | None:
        """Focal instant of the first target in s from the first sample; None without a report."""
        return next(iter(self.focal_times), None)

    @property
    def focal_times(self) -> tuple[float, ...]:
        """Focal instant of each target in s from the first sample; empty without a report."""
        targets = self._report.targets if self._report is not None else []
        return tuple(target.instant_s for target in targets)

    @property
    def figures(self) -> dict[str, str]:
        """Figures of the report, as SVG texts by their names; empty without a report."""
        if self._figures is None:
            self._figures = {} if self._focused is None else self._focused.figures
        return dict(self._figures)

    def to_wav(self, path: _types.Path) -> None:
        """Write the drive as a WAV file of float32 samples in the actuators' units, with a channel for each actuator.

        Parameters
        ----------
        path
            The file, which is replaced.

        Raises
        ------
        WorkError
            If the file cannot be written.

        Examples
        --------
        >>> import os, tempfile
        >>> import numpy as np
        >>> import unripple as ur
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     ur.Drive(np.zeros((2, 480)), rate_hz=48000).to_wav(os.path.join(folder, "drive.wav"))
        ...     os.listdir(folder)
        ['drive.wav']
        """
        self._raw.to_wav(_values.path("path", path))

    def to_xarray(self) -> xr.DataArray:
        """Return the samples with labels: dimensions ``actuator`` (names) and ``time`` (s).

        Returns
        -------
        xarray.DataArray
            In the unit of the first actuator, if a report tells it; without a copy.

        Raises
        ------
        ImportError
            If xarray is not installed.

        Examples
        --------
        >>> import numpy as np
        >>> import unripple as ur
        >>> drive = ur.Drive(np.zeros((2, 480)), rate_hz=48000)
        >>> drive.to_xarray().sel(actuator="a2").shape
        (480,)
        """
        from unripple import _labels

        times = np.arange(self.samples.shape[1]) / self.rate_hz
        coords = {"actuator": self.names, "time": times}
        return _labels.array(self.samples, ("actuator", "time"), coords, "drive", self.unit)

    @property
    def unit(self) -> str:
        """Unit of the first actuator's drive, if a report tells it; empty otherwise."""
        actuators = self._report.actuators if self._report is not None else []
        return str(actuators[0].unit) if actuators else ""

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the samples of each actuator against time, one above the other.

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
        >>> import numpy as np
        >>> import unripple as ur
        >>> ur.Drive(np.zeros((2, 480)), rate_hz=48000).plot().get_xlabel()
        'Time (ms)'
        """
        from unripple import _plot

        return _plot.drive(self, ax)

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return given(self.samples, dtype, copy)

    def __len__(self) -> int:
        return len(self.samples)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (np.array(self.samples), self.rate_hz, self.names, self._report, self.figures)

    def __repr__(self) -> str:
        actuators, samples = self.samples.shape
        what = f"{actuators} actuators, {samples} samples at {self.rate_hz:g} Hz"
        return f"<Drive: {what}, peak {self.peak:.4g}{' ' + self.unit if self.unit else ''}>"

    def _repr_html_(self) -> str:
        from unripple import _html

        return _html.drive(self)

    def _repr_png_(self) -> bytes | None:
        from unripple import _png

        return _png.of_figures(self.figures, ("drive",), self.plot)


def _again(
    samples: npt.NDArray[np.float64],
    rate_hz: float,
    names: list[str],
    report: Report | None,
    figures: dict[str, str],
) -> Drive:
    """Make a drive of what was pickled."""
    drive = Drive(samples, rate_hz=rate_hz, names=names)
    drive._report, drive._figures = report, figures
    return drive


def refuse_other(drive: Drive, rate_hz: float, names: list[str]) -> None:
    """Refuse a drive of another sample rate (Hz), or for other actuators."""
    for field, expected, found in (
        ("rate_hz", rate_hz, drive.rate_hz),
        ("names", list(names), list(drive.names)),
    ):
        if expected != found:
            raise AskError(field=f"drive.{field}", expected=str(expected), found=str(found))


def channel_names(names: object, count: int) -> list[str]:
    """Return the names of channels, or those by which they are called where none are given."""
    if names is None:
        return [f"a{channel + 1}" for channel in range(count)]
    return _values.texts("names", names)


def floats(name: str, values: object, *axes: str) -> npt.NDArray[Any]:
    """Return values as an array of float32 or float64 in C order, without a copy where they are one already; `axes` names its axes."""
    try:
        found = np.asarray(values)
        kind = found.dtype.type if found.dtype.type in _FLOATS else np.float64
        if found.dtype.kind not in "fiub":
            raise TypeError
        made = np.ascontiguousarray(found, dtype=kind)
    except (TypeError, ValueError, OverflowError):
        raise OptionError(f"{name}: expected an array of numbers, found {_values.shown(values)}") from None
    if found.ndim != len(axes):
        raise OptionError(f"{name}: expected a shape ({', '.join(axes)}), found {found.shape}")
    return made


def given(values: npt.NDArray[Any], dtype: npt.DTypeLike | None, copy: bool | None) -> npt.NDArray[Any]:
    """Return an array as `__array__` is asked for it: without a copy where that is possible."""
    wanted = values.dtype if dtype is None else np.dtype(dtype)
    if copy is False and wanted != values.dtype:
        raise ValueError(f"expected no copy, but {wanted} of {values.dtype} needs one")
    return values.astype(wanted, copy=bool(copy))
