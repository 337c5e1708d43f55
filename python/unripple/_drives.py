"""Drives, and their fields, of whatever is named: a surface, responses, a library."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from unripple._libraries import open as open_library
from unripple._responses import Responses
from unripple._surface import Surface

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _types
    from unripple._drive import Drive
    from unripple._field import Field


def focus(
    surface: _types.SurfaceLike | Responses,
    targets: _types.Targets | None = None,
    /,
    **options: Unpack[_types.FocusOptions],
) -> Drive:
    """Compute a drive that focuses on points and shapes, and evaluate it; see :meth:`Surface.focus`.

    Parameters
    ----------
    surface
        A surface, responses, or the path of a library.
    targets
        Where to focus.
    **options
        As for :meth:`Surface.focus`.

    Returns
    -------
    Drive

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> ur.focus(film, [(62, 90)], window_ms=20).report.method
    'time-reversal'
    """
    return _opened(surface).focus(targets, **options)


def waveform(
    surface: _types.SurfaceLike | Responses,
    waveforms: _types.Waveforms | None = None,
    /,
    **options: Unpack[_types.WaveformOptions],
) -> Drive:
    """Compute a drive by which targets follow waveforms; see :meth:`Surface.waveform`.

    Parameters
    ----------
    surface
        A surface, or its responses.
    waveforms
        Targets with their waveforms.
    **options
        As for :meth:`Surface.waveform`.

    Returns
    -------
    Drive

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> len(ur.waveform(film, [(62, 90, "burst:250,5")]).report.waveforms)
    1
    """
    return _opened(surface).waveform(waveforms, **options)


def stroke(
    surface: _types.SurfaceLike | Responses,
    path: _types.StrokePath | None = None,
    /,
    **options: Unpack[_types.StrokeOptions],
) -> Drive:
    """Compute a drive whose focus moves along a path; see :meth:`Surface.stroke`.

    Parameters
    ----------
    surface
        A surface, or its responses.
    path
        The path.
    **options
        As for :meth:`Surface.stroke`.

    Returns
    -------
    Drive

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> ur.stroke(film, "line:50,75,60,75", speed_mm_s=100).report.stroke.pulses > 1
    True
    """
    return _opened(surface).stroke(path, **options)


def field(
    surface: _types.SurfaceLike | Responses,
    drive: _types.DriveLike,
    /,
    **options: Unpack[_types.FieldOptions],
) -> Field:
    """Simulate what a drive does to a surface; see :meth:`Surface.field`.

    Parameters
    ----------
    surface
        A surface, responses, or the path of a library.
    drive
        A drive, or the path of a WAV file.
    **options
        As for :meth:`Surface.field`.

    Returns
    -------
    Field

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> drive = ur.focus(film, [(62, 90)], window_ms=20)
    >>> len(ur.field(film, drive).report.targets)
    1
    """
    return _opened(surface).field(drive, **options)


def _opened(surface: _types.SurfaceLike | Responses) -> Surface | Responses:
    """Return a surface, or the responses of a library if it is the path of one."""
    if isinstance(surface, (Surface, Responses)):
        return surface
    if isinstance(surface, (str, os.PathLike)) and os.path.isdir(surface):
        return open_library(surface)
    return Surface(surface)
