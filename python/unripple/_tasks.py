"""The tasks by name: a function for each command of the command line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from unripple import _call
from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _plan_types, _types


def run(command: str, **options: Any) -> Report:
    """Do any task by its name, as the command line does.

    Parameters
    ----------
    command
        Name of the command, such as ``"modes"``.
    **options
        Options by their names on the command line with underscores, or by the fields of the request in SI units; ``surface=`` and ``set=`` where
        it reads a surface file; ``progress=`` and ``threads=``.

    Returns
    -------
    Report

    Raises
    ------
    OptionError
        Of an option that the command does not have.
    AskError
        Of a command that there is not, and of a value that it does not accept.

    Examples
    --------
    >>> import unripple as ur
    >>> ur.run("modes", surface="hudin-2012", max_hz=300).run.command
    'modes'
    """
    return Report._of(_call.run(command, options))


def check(surface: _types.SurfaceLike, **options: Unpack[_types.SurfaceOptions]) -> Report:
    """List all faults of a surface file.

    Parameters
    ----------
    surface
        Path or text of a surface file, or name of a built-in surface.
    set
        Keys of the file to set to other values first.

    Returns
    -------
    Report
        With ``ok`` and ``faults``; it counts as failed if there are some.

    Examples
    --------
    >>> import unripple as ur
    >>> ur.check("hudin-2012").ok
    True
    """
    return _call.report("check", options, surface=surface)


def design(surface: _types.SurfaceLike, **options: Unpack[_types.SurfaceOptions]) -> Report:
    """Predict wave speeds, modes, time window, contrast, focal spot and power at the finger; see :meth:`Surface.design`.

    Parameters
    ----------
    surface
        A surface.
    set
        Keys of its file to set to other values.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> ur.design("hudin-2012", set={"tension_n_per_m": 220}).actuators
    8
    """
    return _call.report("design", options, surface=surface)


def modes(surface: _types.SurfaceLike, **options: Unpack[_types.ModesOptions]) -> Report:
    """Compute the modes of a surface: natural frequencies and decay times; see :meth:`Surface.modes`.

    Parameters
    ----------
    surface
        A surface.
    max_hz, accuracy
        Highest frequency in Hz, and relative accuracy.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> ur.modes("hudin-2012", max_hz=300).count > 0
    True
    """
    return _call.report("modes", options, surface=surface)


def place(surface: _types.SurfaceLike, **options: Unpack[_types.PlaceOptions]) -> Report:
    """Find where actuators should be so that time reversal has the most contrast, or which of a library's to keep; see :meth:`Surface.place`.

    Parameters
    ----------
    surface
        A surface, or the path of a library.
    **options
        As for :meth:`Surface.place`; those that need a model are refused of a library, whose `output` has the names of the chosen actuators
        (``actuators.txt``) in place of a surface.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 1000])
    >>> report = ur.place(film, count=3, rim_mm=(6, 12), restarts=1, targets=5)
    >>> report.after.mean_contrast > report.random.mean_contrast
    True
    """
    return _call.report("place", options, surface=surface)


def sensors(surface: _types.SurfaceLike, **options: Unpack[_types.SensorsOptions]) -> Report:
    """Find where sensors or taps tell a fit most about a surface, and what it would then know; see :meth:`Surface.sensors`.

    Parameters
    ----------
    surface
        A surface.
    **options
        As for :meth:`Surface.sensors`.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 400])
    >>> ur.sensors(film, count=2, grid_mm=25, profile=0, restarts=1).certificate.certified
    True
    """
    return _call.report("sensors", options, surface=surface)


def compare(
    surface: _types.SurfaceLike | Sequence[_types.SurfaceLike],
    targets: _types.Targets | None = None,
    /,
    **options: Unpack[_types.CompareOptions],
) -> Report:
    """Compare methods on the same targets, on one surface or several; see :meth:`Surface.compare`.

    Parameters
    ----------
    surface
        A surface, or a list of some.
    targets
        Where to focus.
    vary
        A key and the values that it is to have on each surface.
    **options
        As for :meth:`Surface.compare`.

    Returns
    -------
    Report
        With a row of ``methods`` for each method; of several surfaces, with ``surfaces``.

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> report = ur.compare(film, [(62, 90)], method="one-bit", window_ms=20, vary={"tension_n_per_m": [200, 300]})
    >>> [surface.label for surface in report.surfaces]
    ['sheet.tension_n_per_m=200', 'sheet.tension_n_per_m=300']
    """
    return _call.report("compare", options, surface=surface, targets=targets)


def drift(surface: _types.SurfaceLike, **options: Unpack[_types.DriftOptions]) -> Report:
    """Measure whether a sheet's tension is still what its responses were made for; see :meth:`Surface.drift`.

    Parameters
    ----------
    surface
        A surface, or the path of a library that was calibrated or fitted.
    **options
        As for :meth:`Surface.drift`.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> ur.drift(ur.Surface("hudin-2012", band_hz=[0, 500]), seconds=2).state
    'steady'
    """
    return _call.report("drift", options, surface=surface)


def play(surface: _types.SurfaceLike, **options: Unpack[_types.PlayOptions]) -> Report:
    """Drive a surface live: touches in, waves out; see :meth:`Surface.play`.

    Where neither ``seconds`` nor ``session`` ends it, Ctrl+C does (in a notebook, *Interrupt the kernel*), and the report is returned.

    Parameters
    ----------
    surface
        A surface, or the path of a library.
    **options
        As for :meth:`Surface.play`.

    Returns
    -------
    Report
        On what was played, up to the end or the interrupt.

    Raises
    ------
    KeyboardInterrupt
        Of Ctrl+C before the end that ``seconds`` or ``session`` sets; its attribute ``report`` is the report on what was played until then.
        Without that attribute where nothing was played yet.

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> ur.play(film, seconds=0.2, fingers=1, window_ms=20).lost_blocks
    0
    """
    return _call.report("play", options, surface=surface)


def doctor(surface: _types.SurfaceLike = "hudin-2012", **options: Unpack[_types.DoctorOptions]) -> Report:
    """Check each stage from a touch to the fingertip, and give likely reasons if nothing is felt; see :meth:`Surface.doctor`.

    Parameters
    ----------
    surface
        A surface.
    **options
        As for :meth:`Surface.doctor`.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> ur.doctor().surface
    'hudin-2012'
    """
    return _call.report("doctor", options, surface=surface)


def reproduce(output: _types.Path | None = None, **options: Unpack[_types.ReproduceOptions]) -> Report:
    """Reproduce the paper's table and figures beside ours, as one page. It takes minutes.

    Parameters
    ----------
    output
        Folder for the page and its pictures; by default only the numbers are computed.
    placements
        Random placements of the actuators to average for the statistics of contrast, 2 to 10000; 20 by default.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.reproduce(placements=1)
    ... except ur.UnrippleError as error:
    ...     print("placements" in str(error))
    True
    """
    return _call.report("reproduce", options, output=output)


def sweep(
    plan: _types.Path, output: _types.Path | None = None, **options: Unpack[_plan_types.SweepOptions]
) -> Report:
    """Give the designs of a plan to a task, and write their figures into one table.

    Designs are computed in this process, one after the other, or with `client` by the workers of Dask; the command line computes them by
    several processes. What is in the folder already is not computed again.

    Parameters
    ----------
    plan
        A plan, in TOML.
    output
        Folder for rows, table (``table.csv``), report and figures; needed unless `count` is true.
    shard
        The only shard to compute, counted from 0; by default all that are missing.
    count
        Count designs and shards, and compute nothing.
    no_figures, columns
        As for :meth:`Surface.focus`.
    client
        A ``distributed.Client``, whose workers compute the shards that are missing, on `threads` threads each (by default one); the table is
        made in this process.
    shared
        With `client`: whether workers have the folders of the plan and of `output` by the same paths as this process, as by default. If not,
        the files of the plan are sent to them, and rows are sent back.

    Returns
    -------
    Report
        With the numbers of designs that are ``done``, ``failed`` and ``missing``, and the ``extremes`` of each figure.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import unripple as ur
    >>> plan = '''
    ... format = 1
    ... task = "modes"
    ... surface = "hudin-2012"
    ... ask = { top_hz = 200 }
    ... [[axis]]
    ... key = "sheet.tension_n_per_m"
    ... values = [150, 200]
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder, "plan.toml")
    ...     _ = file.write_text(plan)
    ...     report = ur.sweep(file, pathlib.Path(folder, "out"), no_figures=True)
    >>> report.done, report.failed
    (2, 0)
    """
    if options.get("client") is None and options.get("shared") is None:
        return _call.report("sweep", options, plan=plan, output=output)
    from unripple import _engine

    return _engine.sweep(plan, output, options)


def rerun(
    report: _types.Path, output: _types.Path | None = None, **options: Unpack[_types.CallOptions]
) -> Report:
    """Run again what a report records: the same options, seeds and surfaces, on the same files.

    Parameters
    ----------
    report
        A report.json of an earlier run, or a file with what :meth:`Report.to_json` returned.
    output
        Where results go; by default there is only the report.

    Returns
    -------
    Report
        That of the command that is run again.

    Raises
    ------
    InputError
        Of a file without a record, and of one that the run read and that has changed.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import unripple as ur
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder, "report.json")
    ...     _ = file.write_text(ur.modes("hudin-2012", max_hz=300).to_json())
    ...     ur.rerun(file).run.command
    'modes'
    """
    return _call.report("rerun", options, report=report, output=output)
