"""Surfaces known by natural frequencies alone: from a knock to a surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

from unripple import _call
from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _frequency_types, _types


def listen(recording: _types.Path, **options: Unpack[_frequency_types.ListenOptions]) -> Report:
    """Find natural frequencies and decay times in the recording of a knock.

    Parameters
    ----------
    recording
        A WAV file with the sound or the motion of a surface that was knocked on.
    channel
        Channel of the file, from 1; by default the loudest.
    band_hz
        Lowest and highest frequency; by default 20 to 5000, but no more than four tenths of the sample rate.
    mains_hz
        Frequency of the mains; by default 50 or 60, whichever is heard.
    hit
        Number of the hit to listen to, from 1; by default the last.
    most, least_db
        Largest number of modes, the strongest ones, 30 by default; and their least level relative to the strongest, -60 dB by default.
    output, no_figures, columns
        Folder for report and figures; as for :meth:`Surface.focus`.

    Returns
    -------
    Report
        With the ``modes``, their ``frequency_hz`` and ``decay_time_s`` with intervals, and ``modes_text``, which :func:`fit_modes` takes,
        without those that are ``doubtful``: less than 24 dB clear of the noise, as sound of a room is.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.listen("no-such-recording.wav")
    ... except ur.UnrippleError:
    ...     print("not there")
    not there
    """
    return _call.report("listen", options, recording=recording)


def fit_modes(
    surface: _types.SurfaceLike,
    modes: _frequency_types.Frequencies,
    **options: Unpack[_frequency_types.FitModesOptions],
) -> Report:
    """Fit a surface to natural frequencies alone: moduli, tension, springs.

    Parameters
    ----------
    surface
        A surface.
    modes
        Measured natural frequencies in Hz, in any order and not necessarily all; each alone, with its decay time in ms as a pair, or as a text
        with its quality factor, such as ``"148:Q40"``.
    free
        Names of the quantities to fit: ``"tension"``, ``"modulus"``, ``"young-along"``, ``"young-across"``, ``"shear"``, ``"spring"``,
        ``"lift"``, ``"tilt"``, ``"spring-1"`` and so on; by default those that are usual for the surface.
    error_percent
        Standard deviation of the frequencies, and of the model, 1 by default.
    sides_known
        Whether it is certain which side is held in which way; if not, others are tried.
    output, no_figures, columns
        Folder for report, fitted surface file and figures; as for :meth:`Surface.focus`.

    Returns
    -------
    Report
        With the fitted ``quantities`` and their intervals, which of the ``modes`` each frequency is, what is ``untold``, ``others`` that
        explain the frequencies as well, and the fitted surface as ``surface_toml``.

    Examples
    --------
    >>> import unripple as ur
    >>> report = ur.fit_modes("hudin-2012", [171.4, 270.8, 270.8, 343.0])
    >>> tension = report.quantities[0]
    >>> tension.quantity, 210 < tension.value < 230
    ('tension', True)
    >>> len(ur.Surface(report.surface_toml).names)
    8
    """
    return _call.report("fit_modes", options, surface=surface, modes=modes)
