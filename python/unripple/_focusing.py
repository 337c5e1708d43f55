"""Focusing, and the field of a drive: on a surface, and on responses."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Any

from unripple import _call, _values

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _types
    from unripple._drive import Drive
    from unripple._field import Field
    from unripple._responses import Responses
    from unripple._surface import Surface


class Focusing:
    """What drives are computed for, and evaluated on."""

    __slots__ = ()

    @abstractmethod
    def _chosen(self, options: dict[str, Any]) -> Surface | Responses:
        """Return what drives are computed for: this, with keys changed as the option `set` says, which is taken out."""

    @abstractmethod
    def _extent(self) -> tuple[float, float]:
        """Return width and height of the outline's bounding box, in m."""

    def _computed(self, command: str, options: dict[str, Any]) -> Drive:
        from unripple import _evaluation

        chosen = self._chosen(options)
        _values.warn_of_metres("targets", options.get("targets", options.get("at")), chosen._extent())
        return _evaluation.focused(chosen, command, options)

    def focus(
        self, targets: _types.Targets | None = None, /, **options: Unpack[_types.FocusOptions]
    ) -> Drive:
        """Compute a drive that focuses on points and shapes, and evaluate it.

        Parameters
        ----------
        targets
            Where to focus: points ``(x, y)``, ``(x, y, gain)`` or ``(x, y, gain, hz)`` in mm and Hz (repeated so often), or an array of
            them; shapes ``"triangle:X,Y,SIZE"``, ``"circle:X,Y,R"`` in mm, the path of an SVG file, or mappings: ``{"circle_mm": (x, y, r)}``,
            ``{"triangle_mm": (x, y, side)}``, ``{"lines_mm": [[(x, y), …], …], "closed": …, "filled": …}``.
        method
            ``"time-reversal"`` (the default), ``"one-bit"``, ``"inverse"``, ``"concentrate"``, ``"limited"``, ``"robust"`` or ``"felt"``.
        strength, push, worst, economy, rest, spread_percent, bear_tension_percent, bear_finger
            Parameters of methods.
        peak_um, felt_db, full_limit, total_rms
            Level at the first target, as peak displacement in µm or in dB above the threshold of touch; by default as strong as linear theory
            allows. Largest rms of all actuators together.
        window_ms, duration_ms
            Window T, by default the recommended one, and length of a repeated drive, in ms.
        losses
            Compensation of the waves' decay: ``"none"``, ``"uniform"`` or ``"per-mode"``.
        fingers_mm, finger_aware
            Places of fingers that rest on the surface while the drive is evaluated, and whether it is computed for the surface with them.
        on, judge_hz
            Another surface to evaluate the drive on, and up to which frequency.
        listen_m
            Height above the middle of the surface at which the sound pressure level is computed, in m: 0.05 to 100, 0.3 by default.
        output, no_figures, columns
            Folder for drive, report and figures, as the command line writes it.

        Returns
        -------
        Drive
            With its report and figures.

        Raises
        ------
        AskError
            Of a value that makes no sense.
        InputError
            Of a target outside the surface; the nearest place on it is named.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> drive = film.focus([(40, 50), (100, 90, 0.5)], window_ms=30, method="concentrate")
        >>> len(drive.report.targets)
        2
        """
        given: dict[str, Any] = {"targets": targets, **options}
        return self._computed(_call.focusing(given), given)

    def waveform(
        self, waveforms: _types.Waveforms | None = None, /, **options: Unpack[_types.WaveformOptions]
    ) -> Drive:
        """Compute a drive by which targets follow waveforms while other places stay still.

        Parameters
        ----------
        waveforms
            Targets: ``(x, y, what)`` or ``(x, y, what, um)``, place in mm and peak displacement in µm (1 by default), with `what` as
            ``"sine:HZ,MS"``, ``"burst:HZ,CYCLES"``, ``"click:MS"``, the path of a WAV file, or samples with their rate ``(samples, rate_hz)``.
        silent_mm
            Places in mm that are to stay still.
        window_ms
            Time in ms by which the drive may begin before a waveform and end after it.
        on, judge_hz, output, no_figures, columns
            As for :meth:`focus`.

        Returns
        -------
        Drive

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> drive = film.waveform([(62, 90, "burst:250,5")], silent_mm=[(100, 60)])
        >>> len(drive.report.waveforms), len(drive.report.silent)
        (1, 1)
        """
        return self._computed("waveform", {"waveform": waveforms, **options})

    def stroke(
        self, path: _types.StrokePath | None = None, /, **options: Unpack[_types.StrokeOptions]
    ) -> Drive:
        """Compute a drive whose focus moves along a path.

        Parameters
        ----------
        path
            ``"line:X1,Y1,X2,Y2"`` in mm, corners ``[(x, y), …]`` in mm, or a shape as for :meth:`focus`.
        speed_mm_s
            Speed of the focus in mm/s; required.
        level_mm_s
            Peak velocity of the sheet at each pulse in mm/s, 10 by default.
        window_ms
            Window of each pulse in ms.
        on, judge_hz, output, no_figures, columns
            As for :meth:`focus`.

        Returns
        -------
        Drive

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> drive = film.stroke([(50, 75), (60, 75)], speed_mm_s=100)
        >>> drive.report.stroke.pulses > 1
        True
        """
        return self._computed("stroke", {"path": path, **options})

    def field(self, drive: _types.DriveLike, /, **options: Unpack[_types.FieldOptions]) -> Field:
        """Simulate what a drive does to the surface.

        Parameters
        ----------
        drive
            A drive, or the path of a WAV file with a channel for each actuator, in the actuators' units.
        at, at_ms, period_ms
            Places in mm and instants in ms to evaluate, and the period of a repeated drive in ms; by default those of the targets in the
            drive's report, or else the place and instant of the largest velocity.
        fingers_mm
            Places in mm of fingers that rest on the surface.
        judge_hz
            Highest frequency of the modes in Hz; by default up to twice the top of the band.
        listen_m
            Height above the middle of the surface at which the sound pressure level is computed, in m: 0.05 to 100, 0.3 by default.
        output, no_figures, columns, movie_ms, frames
            Folder for report, pictures and animation, as the command line writes it.

        Returns
        -------
        Field

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> drive = film.focus([(40, 50)], window_ms=30)
        >>> field = film.field(drive, fingers_mm=[(40, 50)])
        >>> field.report.targets[0].at_m
        [0.04, 0.05]
        """
        from unripple import _evaluation

        given: dict[str, Any] = {**options}
        return _evaluation.field(self._chosen(given), drive, given)
