"""Searches: known optima are found, tables are the same however a search was cut, and fronts are what they are called."""

from __future__ import annotations

import csv
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import unripple as ur
from unripple import _asking

_PLAN = """
format = 1
task = "modes"
surface = "hudin-2012"
ask = {{ top_hz = 400 }}
optimise = {{ generations = {generations}, population = 6, seed = {seed} }}
[[objective]]
figure = "/frequencies_hz/0"
want = "least"
[[constraint]]
figure = "/frequencies_hz/0"
at_least = 180
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
[[axis]]
key = "sheet.thickness_mm"
from = 0.1
to = 0.15
"""

_TRADE = """
format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 400 }
optimise = { generations = 3, population = 10 }
[[objective]]
figure = "/frequencies_hz/0"
want = "least"
[[objective]]
figure = "/count"
want = "least"
[[axis]]
key = "sheet.tension_n_per_m"
from = 100
to = 400
[[axis]]
key = "sheet.thickness_mm"
values = [0.1, 0.125, 0.15]
"""

#: An unknown that is any number, and its questions.
_NUMBER = {"name": "surface:a", "from": 100.0, "to": 400.0, "log": False, "whole": False}


def _question(unknowns: list[dict[str, Any]], told: list[Any], objectives: int = 1) -> dict[str, Any]:
    return {
        "format": 1,
        "generation": len(told),
        "seed": 1,
        "population": None,
        "objectives": objectives,
        "head": "format = 1\n",
        "unknowns": unknowns,
        "told": told,
    }


def _search(
    unknowns: list[dict[str, Any]], figures: Callable[[list[Any]], list[float] | None], generations: int, objectives: int = 1
) -> list[list[dict[str, Any]]]:
    told: list[list[dict[str, Any]]] = []
    for _ in range(generations):
        # As it goes through a file.
        question = json.loads(json.dumps(_question(unknowns, told, objectives)))
        designs = [[json.loads(written) for _, written in design] for design in _asking.designs(question)[1]]
        told.append([{"values": values, "losses": figures(values), "violation": 0.0} for values in designs])
    return told


def _best(told: list[list[dict[str, Any]]]) -> list[Any]:
    known = [design for designs in told for design in designs if design["losses"] is not None]
    values: list[Any] = min(known, key=lambda design: design["losses"])["values"]
    return values


def test_the_optimum_of_numbers_is_found() -> None:
    unknowns = [_NUMBER, {"name": "surface:b", "from": 0.01, "to": 1.0, "log": True, "whole": False}]
    told = _search(unknowns, lambda values: [(values[0] / 100 - 3.1) ** 2 + math.log10(values[1] / 0.1) ** 2], 25)
    assert _best(told) == pytest.approx([310, 0.1], rel=0.01)


def test_the_optimum_of_steps_and_choices_is_found_beside_designs_that_fail() -> None:
    unknowns = [
        _NUMBER,
        {"name": "ask:count", "from": 4.0, "to": 20.0, "log": False, "whole": True},
        {"name": "surface:m", "values": ["glass", "BoPET", "steel"], "written": ['"glass"', '"BoPET"', '"steel"']},
        {"name": "surface:t", "values": [0.5, 0.1, 0.2], "written": ["0.5", "0.1", "0.2"]},
    ]

    def losses(values: list[Any]) -> list[float] | None:
        tension, count, material, thickness = values
        if count == 13:
            return None
        return [(tension / 100 - 3.1) ** 2 + abs(count - 7) + (material != "BoPET") + abs(thickness - 0.2)]

    best = _best(_search(unknowns, losses, 25))
    assert best[1:] == [7, "BoPET", 0.2] and best[0] == pytest.approx(310, rel=0.1)


@pytest.mark.parametrize("objectives", [2, 4])
def test_trade_offs_come_close_to_their_front(objectives: int) -> None:
    targets = [150, 350, 250, 200][:objectives]
    told = _search([_NUMBER], lambda values: [abs(values[0] - target) for target in targets], 12, objectives)
    # No design beyond the targets is on the front: the last generation has hardly any.
    last = [design["values"][0] for design in told[-1]]
    assert sum(145 <= value <= 355 for value in last) > 0.9 * len(last)


def test_rows_of_another_optimiser_are_refused() -> None:
    told = _search([_NUMBER], lambda values: [values[0]], 2)
    told[0][0]["values"] = [100.0]
    with pytest.raises(ur.WorkError, match="generation 0 as CMA-ES of cmaes"):
        _asking.designs(_question([_NUMBER], told))


def _table(folder: Path | str) -> bytes:
    return Path(folder, "table.csv").read_bytes()


def _rows(folder: Path | str) -> list[dict[str, str]]:
    with open(Path(folder, "table.csv"), encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


def _plan(generations: int = 8, seed: int = 1) -> Path:
    path = Path(f"plan-{generations}-{seed}.toml")
    path.write_text(_PLAN.format(generations=generations, seed=seed), encoding="utf-8")
    return path


def test_a_search_ends_at_the_bound_and_its_surface_can_be_used() -> None:
    report = ur.optimise(_plan(), "out", no_figures=True)
    assert (report.done, report.designs, report.failed) == (8, 48, 0)
    first = report.best.figures[0]
    assert first.name == "/frequencies_hz/0" and 180 <= first.value < 186
    surface = ur.Surface(report.best_surface)
    assert surface.modes(max_hz=400).frequencies_hz[0] == pytest.approx(first.value, rel=1e-6)
    bests = [step.best for step in report.history if step.best is not None]
    assert bests == sorted(bests, reverse=True)


def test_the_same_seed_makes_the_same_table_by_any_way(program: str) -> None:
    ur.optimise(_plan(3), "whole", no_figures=True)
    ur.optimise(_plan(3), "processes", no_figures=True, jobs=2)
    command = [program, "optimise", str(_plan(3)), "--no-figures", "--jobs", "2", "-o", "typed"]
    environment = {**os.environ, "UNRIPPLE_PYTHON": sys.executable}
    subprocess.run(command, check=True, capture_output=True, env=environment)
    # Longer later, and by both in turn.
    ur.optimise(_plan(1), "turns", no_figures=True)
    subprocess.run([*command[:2], str(_plan(2)), *command[3:-1], "turns"], check=True, capture_output=True, env=environment)
    ur.optimise(_plan(3), "turns", no_figures=True)
    assert _table("whole") == _table("processes") == _table("typed") == _table("turns")
    ur.optimise(_plan(3, seed=2), "other", no_figures=True)
    assert _table("other") != _table("whole")


def test_a_search_that_was_killed_goes_on_to_the_same_table(program: str) -> None:
    ur.optimise(_plan(4), "whole", no_figures=True)
    command = [program, "optimise", str(_plan(4)), "--no-figures", "-o", "killed"]
    environment = {**os.environ, "UNRIPPLE_PYTHON": sys.executable}
    for parts in (2, 8, 15):
        running = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60
        while len(list(Path("killed").glob("generations/*/parts/*.jsonl"))) < parts and time.monotonic() < until:
            time.sleep(0.002)
        running.send_signal(signal.SIGKILL)
        running.wait()
    # What it started ends with it, and rows may be lost otherwise.
    time.sleep(0.5)
    shutil.rmtree("killed/generations/0/parts")
    report = ur.optimise(_plan(4), "killed", no_figures=True)
    assert report.done == 4 and _table("killed") == _table("whole")


def test_the_front_has_all_designs_that_nothing_is_better_than_and_nothing_else() -> None:
    Path("plan.toml").write_text(_TRADE, encoding="utf-8")
    report = ur.optimise("plan.toml", "out")
    assert report.best is None and "optimise.svg" in report.files
    values = [(float(row["/frequencies_hz/0"]), float(row["/count"])) for row in _rows("out")]
    hashes = [row["hash"] for row in _rows("out")]
    better = [
        index
        for index, (one, two) in enumerate(values)
        if not any(a <= one and b <= two and (a < one or b < two) for a, b in values)
        and hashes.index(hashes[index]) == index
    ]
    assert [good.index for good in report.front] == better


def test_what_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cmaes", None)
    with pytest.raises(ImportError, match=r"pip install 'unripple\[optimise\]'"):
        ur.optimise(_plan(1), "out")
    assert _asking.main(["out", "0"]) == 1
    with pytest.raises(ur.OptionError, match="jobs: expected a number from 1"):
        ur.optimise(_plan(1), "out", jobs=0)
    report = ur.optimise(_plan(1), "out", no_ask=True)
    assert (report.to_ask, report.designs) == (0, 0)
