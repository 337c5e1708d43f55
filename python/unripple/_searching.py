"""Searches from Python: generations that are computed here, by processes, or by workers of Dask, and asked for by this process."""

from __future__ import annotations

import contextlib
import os
import sys
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from unripple import _call, _values
from unripple._errors import OptionError, UnrippleWarning, WorkError
from unripple._progress import chosen_threads
from unripple._report import Report

if TYPE_CHECKING:
    import subprocess
    from typing import Unpack

    from unripple import _plan_types, _types

#: Options that only say who computes.
_WHO = ("client", "shared", "jobs")

#: Most shards that a process is told at once, so that its command line is no longer than any system allows.
_AT_ONCE = 2000


def optimise(plan: _types.Path, output: _types.Path, **options: Unpack[_plan_types.OptimiseOptions]) -> Report:
    """Search the designs whose figures are most or least, or the best trade-offs between several figures.

    The designs of one generation after the other are asked for by an optimiser, and computed: in this process, by `jobs` processes, or with
    `client` by the workers of Dask. What is in the folder already is neither asked for nor computed again, so that a search that was stopped
    goes on where it was, from here or from the command line. A design of an earlier generation that is asked for once more is computed once
    more by `jobs` and `client`, and by this process not.

    Parameters
    ----------
    plan
        A plan, in TOML.
    output
        Folder for designs, table (``table.csv``), report and figures.
    jobs
        Number of processes that compute at a time; by default this process computes alone.
    no_ask
        Compute the designs that have been asked for, and ask for no others.
    no_figures, columns
        As for :meth:`Surface.focus`.
    client, shared
        As for :func:`sweep`.

    Returns
    -------
    Report
        With the ``best`` design and its surface file ``best_surface``, or the ``front`` of trade-offs, and the ``history`` of generations.

    Raises
    ------
    ImportError
        If an optimiser is not installed: ``pip install 'unripple[optimise]'``.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import unripple as ur
    >>> plan = '''
    ... format = 1
    ... task = "modes"
    ... surface = "hudin-2012"
    ... ask = { top_hz = 200 }
    ... optimise = { generations = 2, population = 4 }
    ... [[objective]]
    ... figure = "/frequencies_hz/0"
    ... want = "least"
    ... [[axis]]
    ... key = "sheet.tension_n_per_m"
    ... from = 100
    ... to = 400
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder, "plan.toml")
    ...     _ = file.write_text(plan)
    ...     report = ur.optimise(file, pathlib.Path(folder, "out"), no_figures=True)
    >>> report.designs, "tension_n_per_m" in report.best_surface
    (8, True)
    """
    return _searched(plan, output, options)


def _searched(plan: Any, output: Any, options: Mapping[str, Any]) -> Report:
    """Ask for generations and have them computed, until the search is over."""
    given = {name: value for name, value in options.items() if value is not None}
    who = {name: given.pop(name) for name in _WHO if name in given}
    jobs = _values.count("jobs", who.pop("jobs", 1))
    if jobs < 1:
        raise OptionError(f"jobs: expected a number from 1, found {jobs}")
    if who and jobs > 1:
        raise OptionError("optimise: expected one of client and jobs, found both")
    folder = None if output is None else Path(_values.path("output", output))
    while True:
        if folder is not None and (who or jobs > 1):
            _compute(folder, jobs, who, given)
        report = _call.report("optimise", {**given, "no_ask": True, "no_figures": True}, plan=plan, output=output)
        if report.get("to_ask") is None or given.get("no_ask") or folder is None:
            break
        from unripple import _asking

        _asking.ask(folder, report.to_ask)
    # Once more, with figures, as it was asked.
    return _call.report("optimise", given, plan=plan, output=output)


def _compute(folder: Path, jobs: int, who: Mapping[str, Any], given: Mapping[str, Any]) -> None:
    """Compute the generation that was asked for last, unless its rows are there."""
    asked = [int(path.stem) for path in folder.glob("asked/*.toml") if path.stem.isdecimal()]
    if not asked:
        return
    plan, place = folder / f"asked/{max(asked)}.toml", folder / f"generations/{max(asked)}"
    missing = [shard for shard in range(_shards(plan)) if not (place / f"parts/{shard}.jsonl").exists()]
    if who and missing:
        from unripple import _engine

        more = {name: given[name] for name in ("threads", "progress") if name in given}
        with warnings.catch_warnings():
            # The search goes on where all designs of a generation fail.
            warnings.simplefilter("ignore", UnrippleWarning)
            _engine.sweep(plan, place, {**who, **more, "no_figures": True})
        return
    for first in range(0, len(missing), jobs * _AT_ONCE):
        shards = missing[first : first + jobs * _AT_ONCE]
        _by_processes(plan, place, shards, min(jobs, len(shards)), chosen_threads(given.get("threads")))


def _shards(plan: Path) -> int:
    """Return the number of shards of the plan of a generation; 0 if it cannot be read, which the task then says."""
    import tomllib

    try:
        read = tomllib.loads(plan.read_text(encoding="utf-8"))
        return -(-len(read["design"]) // int(read.get("shard", 20)))
    except (OSError, ValueError, KeyError, ZeroDivisionError):
        return 0


def _by_processes(plan: Path, place: Path, shards: list[int], jobs: int, threads: int | None) -> None:
    """Compute shards by so many processes, which end with this one. Those that memory is lacking for are left to this process."""
    import subprocess

    share = threads or max(1, (os.cpu_count() or 1) // max(jobs, 1))
    environment = {"RAYON_NUM_THREADS": str(share), **os.environ}
    if threads is not None:
        environment["RAYON_NUM_THREADS"] = str(threads)
    running: list[subprocess.Popen[bytes]] = []
    try:
        for first in range(jobs):
            piece = f"shards:{','.join(map(str, shards[first::jobs]))}"
            command = [sys.executable, "-m", "unripple", "sweep", "--quiet", "--piece", piece]
            command += ["-o", str(place), "--", str(plan)]
            running.append(
                subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, env=environment)
            )
        statuses = [process.wait() for process in running]
    finally:
        for process in running:
            # Each ends by itself when its input does.
            if process.stdin is not None:
                process.stdin.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(2)
            process.kill()
            process.wait()
    ended = [status for status in statuses if status != 0]
    if ended:
        raise WorkError(
            f"optimise: a process of {plan} ended with status {ended[0]}; the command `unripple optimise` finds the designs that end their "
            "process, and makes rows of them"
        )
