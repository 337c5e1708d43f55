"""Whether a drive does on the bench what was predicted."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from unripple import _call
from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _bench_types, _types


def verify(
    surface: _types.SurfaceLike, drive: _types.DriveLike, **options: Unpack[_bench_types.VerifyOptions]
) -> Report:
    """Play a drive through a device, and compare what a probe records with the prediction; see :meth:`Surface.verify`.

    Parameters
    ----------
    surface
        A surface, or the path of a library: what the drive was made for.
    drive
        A drive, or the path of a WAV file.
    **options
        As for :meth:`Surface.verify`.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> drive = ur.focus(film, [(62, 90)], window_ms=20)
    >>> ur.verify(film, drive, at=(62, 90), dry_run=True).state
    'planned'
    """
    return _call.report("verify", options, surface=surface, drive=drive)


class Verifying:
    """A surface on which drives are played and compared with their prediction."""

    __slots__ = ()

    @abstractmethod
    def _report(self, command: str, options: Mapping[str, Any]) -> Report:
        """Return the report of a task on this surface."""

    def verify(self, drive: _types.DriveLike, **options: Unpack[_bench_types.VerifyOptions]) -> Report:
        """Play a drive through a device, record a probe at its target and elsewhere, and compare with the prediction.

        Parameters
        ----------
        drive
            A drive, or the path of a WAV file; the report of a focus beside that file says place and instant.
        device
            The device that plays and records, with options of its kind, as for :meth:`calibrate`.
        at, at_ms
            Place and instant of the focus, in mm and ms.
        probe_mm, probes
            Places at which the probe records besides the target, in mm, or how many are chosen outside the focal disc.
        level
            Level at which the drive is played, as a share of the drive as it is.
        dry_run
            Only say what would be played, and how loud.
        probe_scale, wire
            Velocity in m/s that the probe's input at full scale stands for, and channels by their names.
        judge_hz, between
            Up to which frequency modes predict, and how responses of a library are interpolated.
        changed_percent, swapped, clipped
            Virtual: deviation of the tension, pairs of actuators whose wires are exchanged, and the share of the drive's peak at which
            amplifiers clip.

        Returns
        -------
        Report
            With ``state``, ``predicted``, ``measured`` and its ``causes``.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> drive = film.focus([(62, 90)], window_ms=20)
        >>> film.verify(drive, at=(62, 90), probes=2).state
        'agrees'
        """
        return self._report("verify", {"drive": drive, **options})
