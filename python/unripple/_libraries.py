"""Libraries of responses: computed, measured, fitted, exported and opened."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from unripple import _call, _unripple, _values
from unripple._progress import ProgressCallback, Telling
from unripple._report import Report
from unripple._responses import Responses

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _exchange_types, _types


def open(path: _types.Path, *, progress: bool | ProgressCallback | None = None) -> Responses:
    """Open a library of responses.

    Parameters
    ----------
    path
        Folder of the library, as `respond`, `calibrate` and `fit` write it.
    progress
        How progress is shown, as for :func:`set_progress`.

    Returns
    -------
    Responses

    Raises
    ------
    InputError
        Of a folder that is none.

    Examples
    --------
    >>> import tempfile
    >>> import unripple as ur
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = ur.Surface("hudin-2012", band_hz=[0, 500]).respond(f"{folder}/film", grid_mm=50, length_ms=20)
    ...     ur.open(f"{folder}/film").kind
    'sampled'
    """
    named = _values.path("path", path)
    with Telling(progress) as telling:
        raw = _unripple.Responses.open(named, telling)
    return Responses._of(raw, (open, (os.path.abspath(named),)), named)


def respond(
    surface: _types.SurfaceLike, output: _types.Path, **options: Unpack[_types.RespondOptions]
) -> Report:
    """Compute impulse responses from the model, as a library; see :meth:`Surface.respond`.

    Parameters
    ----------
    surface
        A surface.
    output
        Folder of the library.
    grid_mm, length_ms
        Spacing of the points in mm, and length of the responses in ms.

    Returns
    -------
    Report

    Examples
    --------
    >>> import tempfile
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     report = ur.respond(film, f"{folder}/film", grid_mm=50, length_ms=20)
    >>> report.points
    4
    """
    return _call.report("respond", options, surface=surface, output=output)


def calibrate(
    surface: _types.SurfaceLike, output: _types.Path, **options: Unpack[_types.CalibrateOptions]
) -> Report:
    """Measure impulse responses through a device, as a library; see :meth:`Surface.calibrate`.

    Parameters
    ----------
    surface
        What is known of the surface before the measurement.
    output
        The library: a new folder, or that of an unfinished run with the same options.
    **options
        As for :meth:`Surface.calibrate`.

    Returns
    -------
    Report

    Examples
    --------
    >>> import tempfile
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     report = ur.calibrate(film, f"{folder}/rig", at=[(62, 90)], sweep_ms=500, response_ms=50)
    >>> report.probed
    1
    """
    return _call.report("calibrate", options, surface=surface, output=output)


def fit(
    library: _types.Path, output: _types.Path | None = None, /, **options: Unpack[_types.FitOptions]
) -> Report:
    """Fit the model to the responses between the actuators of a calibrated library, and compute its responses anywhere.

    Parameters
    ----------
    library
        A library from :func:`calibrate` on a device whose actuators can sense.
    output
        Library to write, with responses of the fitted model; needs `grid_mm` or `at`.
    grid_mm, at
        Where the responses of the fitted model are computed for `output`: spacing of a square grid of points, and single points, in mm.
        They need not have been measured. (Those of :func:`calibrate` are measured; what is fitted are the responses between actuators.)
    strays, profile
        Largest numbers of unknown point masses, and of half waves in the variation of the tension; 3 each by default.
    even_if_doubtful
        Write the library even if the model is doubtful.
    accuracy
        Relative accuracy of the modes' frequencies, 1e-6 by default.

    Returns
    -------
    Report
        ``verdict`` is ``"good"`` or ``"doubtful"``; a doubtful fit counts as failed.

    Raises
    ------
    InputError
        Of a library without responses between actuators.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.fit("no-such-library")
    ... except ur.InputError:
    ...     print("not there")
    not there
    """
    return _call.report("fit", options, library=library, output=output)


def export(
    library: _types.Path, output: _types.Path, **options: Unpack[_exchange_types.ExportOptions]
) -> Report:
    """Export a library of responses as WAV files, or as one SOFA, universal or MATLAB file.

    Parameters
    ----------
    library
        A library of responses.
    output
        Folder for WAV, or file for other formats. An earlier export is replaced if it is WAV or SOFA; other files must not exist yet.
    format
        ``"wav"``, ``"sofa"``, ``"uff"``, ``"uff-modes"`` (the modes of the library's surface) or ``"mat"``; by default what the ending of
        the name implies, or WAV if it has none.
    author, organization, license
        SOFA: what the file says of itself.

    Returns
    -------
    Report

    Examples
    --------
    >>> import tempfile
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = film.respond(f"{folder}/film", grid_mm=50, length_ms=20)
    ...     report = ur.export(f"{folder}/film", f"{folder}/wav")
    >>> report.format
    'wav'
    """
    return _call.report("export", options, library=library, output=output)
