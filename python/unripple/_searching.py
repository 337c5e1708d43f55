"""Searches from Python: generations that are computed here, by processes, or by workers of Dask, and asked for by this process."""

from __future__ import annotations

import contextlib
import json
import sys
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from unripple import _call, _unripple, _values
from unripple._errors import OptionError, UnrippleError, UnrippleWarning
from unripple._progress import Telling
from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _plan_types, _types

#: Options that only say who computes.
_WHO = ("client", "shared", "jobs")


def optimise(
    plan: _types.Path, output: _types.Path, **options: Unpack[_plan_types.OptimiseOptions]
) -> Report:
    """Search the designs whose figures are most or least, or the best trade-offs between several figures.

    The designs of one generation after the other are asked for by an optimiser, and computed: in this process, by `jobs` processes, or with
    `client` by the workers of Dask. What is in the folder already is neither asked for nor computed again, so that a search that was stopped
    goes on where it was, from here or from the command line. A design that is asked for once more is not computed once more.

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
    stop_after, stop_percent
        Generations without an improvement (of the best design or of the front) that ends it, and the least that counts, by default 0.1.
    client, shared, no_figures, columns
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
    call = _call.Call("optimise", {"plan": plan, "output": output, **given})
    if who:
        who.update({name: given[name] for name in ("threads", "progress") if name in given})
    return Report._of(
        call.perform(lambda telling, threads: _Searching(call, jobs, who, telling, threads).done())
    )


class _Searching:
    """A search in this process: who computes, who asks, and how it is told."""

    def __init__(
        self, call: _call.Call, jobs: int, who: Mapping[str, Any], telling: Telling, threads: int | None
    ) -> None:
        self.search = _unripple.Search(call.json)
        self.call, self.jobs, self.who = call, jobs, who
        self.telling, self.threads = telling, threads

    def done(self) -> _unripple.Done:
        """Go through the generations, and return the report."""
        try:
            self._go()
        except (UnrippleError, ImportError):
            # What is known is in the table, unless more of it was there.
            with contextlib.suppress(UnrippleError):
                self.search.keep()
            raise
        return self.search.finish(self.telling)

    def _go(self) -> None:
        from unripple import _asking

        asking, folder = _asking.Asking(), Path(self.call.ask["output"])
        while True:
            if self.who:
                self._by_dask()
            generation = self.search.go(self.jobs, sys.executable, self.telling, self.threads)
            if generation is None:
                return
            if self.call.ask.get("no_ask"):
                self.search.put_question()
                return
            self.telling.stage(f"asking for generation {generation}")
            try:
                ended = asking.ask(folder, json.loads(self.search.question(asking.since)))
            except (UnrippleError, ImportError):
                # It is there for whoever asks in another way.
                self.search.put_question()
                raise
            if ended is not None:
                self.search.over(ended)

    def _by_dask(self) -> None:
        """Have the workers of Dask compute what is missing of a generation that has been asked for."""
        missing = self.search.missing()
        if missing is None:
            return
        from unripple import _engine

        plan, place, shards = missing
        with warnings.catch_warnings():
            # The search goes on where all designs of a generation fail.
            warnings.simplefilter("ignore", UnrippleWarning)
            _engine.sweep(plan, place, {**self.who, "no_figures": True}, shards)
