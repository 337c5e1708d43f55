"""The tasks of a surface whose result is a report."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _frequency_types, _types


class Reporting:
    """A surface of which tasks are asked."""

    __slots__ = ()

    @abstractmethod
    def _report(self, command: str, options: Mapping[str, Any]) -> Report:
        """Return the report of a task on this surface."""

    def check(self, **options: Unpack[_types.SurfaceOptions]) -> Report:
        """List the faults of the surface; it has none, or it would not be there.

        Returns
        -------
        Report
            With ``ok`` and ``faults``. See :func:`check` for files with faults.

        Examples
        --------
        >>> import unripple as ur
        >>> ur.Surface("hudin-2012").check().ok
        True
        """
        return self._report("check", options)

    def design(self, **options: Unpack[_types.SurfaceOptions]) -> Report:
        """Predict wave speeds, modes, time window, contrast, focal spot and power at the finger.

        Returns
        -------
        Report

        Examples
        --------
        >>> import unripple as ur
        >>> report = ur.Surface("hudin-2012").design()
        >>> report.actuators
        8
        """
        return self._report("design", options)

    def modes(self, **options: Unpack[_types.ModesOptions]) -> Report:
        """Compute the modes: natural frequencies and decay times.

        Parameters
        ----------
        max_hz
            Highest frequency in Hz; by default the top of the surface's band.
        accuracy
            Relative accuracy of the frequencies, 1e-6 by default.

        Returns
        -------
        Report
            With ``frequencies_hz``, ``decay_times_s`` and ``bending_shares``, a value for each mode.

        Examples
        --------
        >>> import unripple as ur
        >>> report = ur.Surface("hudin-2012").modes(max_hz=300)
        >>> max(report.frequencies_hz) <= 300
        True
        """
        return self._report("modes", options)

    def place(self, **options: Unpack[_types.PlaceOptions]) -> Report:
        """Find where actuators should be so that time reversal has the most contrast, and how many are enough.

        Parameters
        ----------
        count, like
            How many to place, 8 by default, and the name of the actuator whose kind and constants they get; by default the surface's first.
        keep, keep_all
            Names of the surface's actuators that are kept where they are, or whether all are; by default all are removed.
        rim_mm, within, keep_out
            Where places may be: between two distances from the rim, in one of some polygons, and in none of others. A polygon is a sequence
            of corners ``(x, y)`` in mm; one alone stands for a list of one.
        grid_mm, place
            Spacing of the grid of places to choose from, by default a seventh of the shortest wavelength; or the places themselves, in mm.
        apart_mm
            Least distance between any two actuators; by default that at which two of those placed would touch.
        at, screen, targets
            What the layout is optimised for: targets ``(x, y)`` or ``(x, y, weight)`` in mm, or polygons in which so many targets
            are spread, 20 by default; without either anywhere at least one shortest wavelength from the rim.
        importance, important
            How much targets that are spread count by where they are: a CSV file with the columns ``x_mm``, ``y_mm`` and ``weight``, of
            whose points the nearest one counts, and pairs ``(polygon, weight)`` by which the weights inside are multiplied.
        objective, share_percent
            What is maximised: the ``"mean"`` of the contrasts at all targets (the default), the ``"worst"`` one, or as a ``"quantile"`` the
            one that a share of the targets, 10 % by default, stays below.
        mounting_mm, tension_percent
            Largest errors of the actuators' places along each axis, and largest deviation of the tension up and down; the layout is
            optimised for the mean over both.
        window_ms
            Window in ms; by default the one that :meth:`design` recommends for evenly spread actuators.
        restarts, seed, up_to
            Number of random layouts from which the search is restarted, in addition to its start from the greedy layout, and their seed; and
            the largest number of actuators in the table of contrast against their number, by default twice `count`.
        method
            Methods of focusing whose drives are evaluated with the surface's own actuators and with the placed ones.
        by, evaluations
            A figure of the drives of the first method by which layouts are compared in a second search, ``"contrast"``,
            ``"felt-contrast"``, ``"felt-level"`` or ``"energy-for-peak"``; without it there is none. And the largest number of layouts
            whose drives are computed and evaluated for it, by default 6, and 8 for each actuator that is placed, up to 200.
        output, no_figures, columns
            Folder for the surface with the placed actuators (``surface.toml``), report and figures; as for :meth:`focus`.

        Returns
        -------
        Report
            The layout found as ``after``, the surface's own as ``before``, ``random`` ones, and contrasts of ``each_number`` of actuators.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> screen = [(40, 40), (110, 40), (110, 110), (40, 110)]
        >>> report = film.place(count=3, rim_mm=(6, 12), screen=screen, restarts=1, targets=5)
        >>> report.after.mean_contrast > report.random.mean_contrast
        True
        >>> places_mm = [[1e3 * x for x in actuator.at_m] for actuator in report.after.actuators]
        >>> len(film.with_(actuators=places_mm).names)
        3
        """
        return self._report("place", options)

    def sensors(self, **options: Unpack[_types.SensorsOptions]) -> Report:
        """Find where sensors or taps tell a fit most about the surface, and what it would then know.

        Parameters
        ----------
        count, taps
            How many to plan, 4 by default, and whether they are taps, recorded by the sensors of all actuators, in place of a sensor that
            records sweeps.
        keep
            Places ``(x, y)`` in mm that are measured in any case, beside `count` others.
        rim_mm, within, keep_out
            Where places may be: between two distances from the rim, in one of some polygons, and in none of others. A polygon is a sequence
            of corners ``(x, y)`` in mm; one alone stands for a list of one.
        grid_mm, place
            Spacing of the grid of places to choose from, by default a quarter of the shortest wavelength; or the places themselves, in mm.
        apart_mm
            Least distance between any two places.
        snr_db
            Signal-to-noise ratio of the measured spectra, the mean over all places, 50 dB by default.
        profile
            Largest number of half waves in the variation of tension that is fitted, 3 by default; 0 for uniform tension.
        restarts, seed
            Number of random choices that the search begins from, beside the greedy one, and their seed.
        up_to
            Largest number of places in the table of deviations against their number; by default twice `count`.
        output, no_figures, columns
            Folder for report and figures; as for :meth:`focus`.

        Returns
        -------
        Report
            With the places as ``at_m``, the standard deviations of all ``unknowns`` with them and with others, their ``certificate``, and
            the deviations with ``each_number`` of places.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 400])
        >>> report = film.sensors(count=2, grid_mm=25, profile=0, restarts=1)
        >>> report.certificate.certified
        True
        >>> tension = report.unknowns[0]
        >>> tension.name == "tension" and tension.planned < tension.prior
        True
        """
        return self._report("sensors", options)

    def fit_modes(
        self, modes: _frequency_types.Frequencies, /, **options: Unpack[_frequency_types.FitModesOptions]
    ) -> Report:
        """Fit the surface to natural frequencies alone, as :func:`fit_modes` does.

        Returns
        -------
        Report

        Examples
        --------
        >>> import unripple as ur
        >>> ur.Surface("hudin-2012").fit_modes([171.4, 270.8, 343.0]).quantities[0].quantity
        'tension'
        """
        return self._report("fit_modes", {**options, "modes": modes})

    def compare(
        self, targets: _types.Targets | None = None, /, **options: Unpack[_types.CompareOptions]
    ) -> Report:
        """Compare methods of focusing on the same targets.

        Parameters
        ----------
        targets
            Where to focus, as for :meth:`focus`.
        method
            Methods to compare with time reversal; by default every method if there is one surface, only ``concentrate``
            if there are several.
        vary
            A key and the values that it is to have, each on a surface of its own: ``{"tension_n_per_m": [200, 300]}``.
        no_tradeoffs
            Leave out the tradeoff that each method's parameter controls, which takes half of the time.
        peak_um, felt_db, full_limit, window_ms, judge_hz, listen_m, output, no_figures, columns
            As for :meth:`focus`.

        Returns
        -------
        Report
            With a row of ``methods`` for each method; of several surfaces, with ``surfaces``.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> report = film.compare([(62, 90)], method=["one-bit"], window_ms=20, no_tradeoffs=True)
        >>> [row.method for row in report.methods]
        ['time-reversal', 'one-bit']
        """
        return self._report("compare", {"targets": targets, **options})

    def respond(self, folder: _types.Path, **options: Unpack[_types.RespondOptions]) -> Report:
        """Compute impulse responses from the model on a grid of points, as a library.

        Parameters
        ----------
        folder
            Folder of the library. An unfinished library with the same options is continued.
        grid_mm
            Spacing of the points in mm.
        length_ms
            Length of the responses in ms; by default twice the window that :meth:`design` recommends.

        Returns
        -------
        Report

        Examples
        --------
        >>> import tempfile
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     report = film.respond(f"{folder}/film", grid_mm=50, length_ms=20)
        ...     library = ur.open(f"{folder}/film")
        >>> library.kind
        'sampled'
        """
        return self._report("respond", {"output": folder, **options})

    def calibrate(self, folder: _types.Path, **options: Unpack[_types.CalibrateOptions]) -> Report:
        """Measure impulse responses through a device, as a library.

        Parameters
        ----------
        folder
            The library: a new folder, or that of an unfinished run with the same options.
        device
            ``"virtual"`` (a simulated surface, the default), ``"jack"``, ``"card"`` or ``"tape"`` (recordings made elsewhere).
        unknowns
            Virtual: seed by which the simulated surface differs at random from this one.
        grid_mm, at
            Spacing of a square grid of points to measure, and single points, in mm.
        by, repeats, sweep_ms, response_ms, level, check_levels
            How points are measured: by ``"probe"``, ``"tap"`` or ``"hammer"``, how often, and with which sweeps.
        table
            Tape, by taps or hammer: table (CSV) of the places of the recordings.
        wire, input_scale, output_scale, without, probe_delay_ms, any_wiring, no_model, resample
            Channels by the names of what is connected to them, scales by the names of inputs, and what to leave out.
        figure
            Folder for a picture of the signal-to-noise ratio.

        Returns
        -------
        Report
            ``report.doubtful`` says why the library is doubtful; it is empty if it is not.

        Raises
        ------
        InputError
            Where a person has to move the probe or to tap: the command line asks for that, Python cannot.

        Examples
        --------
        >>> import tempfile
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     report = film.calibrate(f"{folder}/rig", at=[(62, 90)], sweep_ms=500, response_ms=50)
        >>> report.probed
        1
        """
        return self._report("calibrate", {"output": folder, **options})

    def doctor(self, **options: Unpack[_types.DoctorOptions]) -> Report:
        """Check each stage from a touch to the fingertip, and give likely reasons if nothing is felt.

        Parameters
        ----------
        device
            The device to check, with options of its kind, as for :meth:`calibrate`.
        tuio, listen
            UDP port and address at which touches would arrive.

        Returns
        -------
        Report
            With ``checks`` and ``why_you_may_feel_nothing``.

        Examples
        --------
        >>> import unripple as ur
        >>> report = ur.Surface("hudin-2012").doctor()
        >>> len(report.checks) > 0
        True
        """
        return self._report("doctor", options)

    def drift(self, **options: Unpack[_types.DriftOptions]) -> Report:
        """Measure whether the sheet's tension is still what the surface says, and whether it goes on changing.

        Parameters
        ----------
        device
            The device that plays and records, with options of its kind, as for :meth:`calibrate`.
        seconds
            Duration of the sequence of pings in s, 4 by default.
        within_percent
            Largest change of tension that is searched for, up and down, in per cent.
        changed_percent, changing_percent_per_min
            Virtual: deviation of the simulated sheet's tension, and its change in a minute, in per cent.

        Returns
        -------
        Report

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> report = film.drift(seconds=2, changed_percent=2)
        >>> report.state
        'steady'
        """
        return self._report("drift", options)

    def play(self, **options: Unpack[_types.PlayOptions]) -> Report:
        """Drive the surface live: touches in, waves out, until it is cancelled or ``seconds`` are over.

        For touches that Python pushes, see :meth:`player`.

        Parameters
        ----------
        effect
            What a touch triggers: a name of :func:`effects`, or a file.
        seconds
            Seconds to play; by default until it is interrupted, or until the recorded session ends.
        device, block, real_time, keep_drive
            The device that plays, with options of its kind as for :meth:`calibrate`; samples per block; whether to play in real time where
            nothing requires it; WAV file for the drive that was played.
        fingers, seed, tuio, websocket, listen, screen, session, record
            Where touches come from: simulated fingers, ports (True for the usual ones), screens, recorded sessions.
        method, window_ms, full_limit, follow_tension, drift_percent
            How drives are computed, and how the virtual tension drifts.

        Returns
        -------
        Report

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> report = film.play(seconds=0.2, fingers=1, window_ms=20)
        >>> report.lost_blocks
        0
        """
        return self._report("play", options)
