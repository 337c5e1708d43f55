"""Measurements from other programs, in files or in arrays, as libraries."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from unripple import _call, _values
from unripple._errors import OptionError
from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _exchange_types, _types

#: Types of numbers that are handed over as they are; others become double ones.
_KEPT = (np.float32, np.float64, np.complex64, np.complex128)

#: The names of an array's abscissa, of which one is given.
_ABSCISSAE = ("rate_hz", "time_s", "frequency_hz")

#: The places of an array's points, and the names of its actuators.
_PLACES = ("points_mm", "actuators")


def import_measurements(
    surface: _types.SurfaceLike,
    measured: _types.Path | Sequence[_types.Path] | npt.ArrayLike,
    output: _types.Path,
    *,
    rate_hz: float | None = None,
    time_s: npt.ArrayLike | None = None,
    frequency_hz: npt.ArrayLike | None = None,
    points_mm: npt.ArrayLike | None = None,
    actuators: Sequence[str] | None = None,
    **options: Unpack[_exchange_types.ImportOptions],
) -> Report:
    """Make a library of responses or modes that other programs measured, from files or from an array.

    Parameters
    ----------
    surface
        The surface that was measured, with its actuators.
    measured
        Files with responses or modes (.uff, .unv, .csv, .npz, .mat), folders of WAV files, or an array of shape (points, actuators, samples).
    output
        Folder of the library.
    rate_hz, time_s, frequency_hz, points_mm, actuators
        Of an array: the sample rate or all times of real values, or all frequencies of complex ones, which must be even; places of the points
        in mm, of shape (points, 2); and names of the actuators.
    kind, quantity, unit, per, drive_per_reference
        If the file does not say it: ``"frequency-responses"``, ``"impulse-responses"`` or ``"filters"``; what was measured (``"velocity"``,
        ``"displacement"``, ``"acceleration"``) and its unit (such as ``"mm/s"`` or ``"g"``, which says the quantity as well); the unit of
        the reference (``"newton"``, ``"volt"``, ``"ampere"``); and the drive of the actuators, in their own unit, for one unit of it.
    table, pattern, length_unit, offset_mm
        What names of files, columns or nodes do not say: a CSV, or a pattern such as ``"{actuator}_{x_mm}_{y_mm}.wav"``; the unit of the
        places in files, and what is added to them.
    actuator, without
        Names of actuators in the files, as a mapping from their own, and names of those that were not measured.
    band_hz, length_ms
        The band that is kept, and the length of the responses.

    Returns
    -------
    Report

    Raises
    ------
    AskError, InputError
        Of what has to be said, of a file with a fault, and of points and actuators that are not the surface's.

    Examples
    --------
    >>> import tempfile
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> h = 1e3 * film.responses().impulse([(62, 90)], length_ms=20)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ur.import_measurements(film, h, f"{folder}/own", rate_hz=48000, points_mm=[(62, 90)], actuators=film.names,
    ...                            kind="impulse-responses", unit="mm/s", per="newton").quantity
    'velocity'
    """
    with _files(measured, rate_hz, time_s, frequency_hz, points_mm, actuators) as files:
        return _call.report("import", options, surface=surface, files=files, output=output)


@contextlib.contextmanager
def _files(measured: Any, *beside: Any) -> Iterator[Any]:
    """Yield files with what was measured: those that were named, or one of an array and of its abscissa and places beside it."""
    given = dict(zip((*_ABSCISSAE, *_PLACES), beside, strict=True))
    if _is_files(measured):
        for name, value in given.items():
            if value is not None:
                raise OptionError(f"import: expected {name} beside an array alone, found it beside files")
        yield measured
        return
    abscissa = {name: given[name] for name in _ABSCISSAE if given[name] is not None}
    places = {name: given[name] for name in _PLACES}
    arrays: dict[str, Any] = {"responses": _responses(measured), **_abscissa(abscissa), **_places(places)}
    with tempfile.TemporaryDirectory(prefix="unripple-import-") as folder:
        file = Path(folder, "measured.npz")
        np.savez(file, **arrays)
        yield [file]


def _is_files(measured: object) -> bool:
    """Tell whether something is a path, or a list of paths."""
    if isinstance(measured, (str, os.PathLike)):
        return True
    return isinstance(measured, (list, tuple)) and all(
        isinstance(item, (str, os.PathLike)) for item in measured
    )


def _responses(measured: Any) -> npt.NDArray[Any]:
    """Return responses as an array of three axes."""
    found = np.asarray(measured)
    if found.dtype.kind not in "fciu":
        raise OptionError(f"measured: expected files or an array of numbers, found {_values.shown(measured)}")
    if found.ndim != 3:
        raise OptionError(f"measured: expected a shape (points, actuators, samples), found {found.shape}")
    if found.dtype.type in _KEPT:
        return found
    return found.astype(np.complex128 if found.dtype.kind == "c" else np.float64)


def _abscissa(given: dict[str, Any]) -> dict[str, npt.NDArray[Any]]:
    """Return the abscissa of an array, by its name."""
    if len(given) != 1:
        found = " and ".join(given) or "none"
        raise OptionError(f"import: expected one of {', '.join(_ABSCISSAE)} beside an array, found {found}")
    return {name: _numbers(name, value) for name, value in given.items()}


def _places(given: dict[str, Any]) -> dict[str, npt.NDArray[Any]]:
    """Return the places of points and the names of actuators, by their names."""
    for name, value in given.items():
        if value is None:
            raise OptionError(f"import: expected {name} beside an array, found none")
    names = np.array(_values.texts("actuators", given["actuators"]))
    return {"points_mm": np.atleast_2d(_numbers("points_mm", given["points_mm"])), "actuators": names}


def _numbers(name: str, value: Any) -> npt.NDArray[np.float64]:
    """Return an array of real numbers."""
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise OptionError(f"{name}: expected numbers, found {_values.shown(value)}") from None
