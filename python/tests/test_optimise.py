"""Searches: known optima are found, tables are the same however a search was cut, and fronts are what they are called."""

from __future__ import annotations

import csv
import io
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


def _question(
    unknowns: list[dict[str, Any]], told: list[Any], objectives: int = 1, since: int = 0
) -> dict[str, Any]:
    question = {
        "format": 1,
        "generation": len(told),
        "seed": 1,
        "population": None,
        "objectives": objectives,
        "head": "format = 1\n",
        "unknowns": unknowns,
        "since": since,
        "told": told[since:],
    }
    # As it goes through a file.
    read: dict[str, Any] = json.loads(json.dumps(question))
    return read


def _search(
    unknowns: list[dict[str, Any]], figures: Callable[[list[Any]], list[float] | None], generations: int, objectives: int = 1
) -> list[list[dict[str, Any]]]:
    told: list[list[dict[str, Any]]] = []
    asking = _asking.Asking()
    for _ in range(generations):
        _, found, ended = asking.designs(_question(unknowns, told, objectives, asking.since))
        if ended is not None:
            break
        told.append(_told(found, figures))
    return told


def _told(found: _asking.Designs, figures: Callable[[list[Any]], list[float] | None]) -> list[dict[str, Any]]:
    designs = [[json.loads(written) for _, written in design] for design in found]
    return [{"values": values, "losses": figures(values), "violation": 0.0} for values in designs]


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
        _asking.Asking().designs(_question([_NUMBER], told))


@pytest.mark.parametrize("objectives", [1, 2, 4])
@pytest.mark.parametrize("stepped", [False, True])
def test_an_optimiser_that_is_begun_anew_asks_exactly_as_one_that_lives(
    objectives: int, stepped: bool
) -> None:
    steps = {"name": "ask:count", "from": 1.0, "to": 9.0, "log": False, "whole": True}
    unknowns = [_NUMBER, steps] if stepped else [_NUMBER]
    living, told = _asking.Asking(), list[Any]()
    for _ in range(6):
        asked = living.designs(_question(unknowns, told, objectives, living.since))
        # Asked once more, it asks for the same.
        assert living.designs(_question(unknowns, told, objectives, living.since)) == asked
        assert _asking.Asking().designs(_question(unknowns, told, objectives)) == asked
        told.append(_told(asked[1], lambda values: [abs(values[0] - 150 - 50 * at) for at in range(objectives)]))


def test_cma_es_ends_a_search_by_its_own_criteria() -> None:
    asking, told = _asking.Asking(), list[Any]()
    for _ in range(200):
        name, found, ended = asking.designs(_question([_NUMBER], told, 1, asking.since))
        if ended is not None:
            break
        told.append(_told(found, lambda values: [(values[0] - 310) ** 2]))
    assert ended is not None and ended.startswith(name) and len(told) > 20
    assert _best(told) == pytest.approx([310], rel=1e-6)
    # One that is begun anew says so again.
    assert _asking.Asking().designs(_question([_NUMBER], told))[2] == ended


def test_questions_are_answered_line_by_line(folder: Path) -> None:
    Path("asked").mkdir()
    told = _search([_NUMBER], lambda values: [values[0]], 2)
    lines = [
        json.dumps(_question([_NUMBER], told[:count], 1, since)).encode() + b"\n"
        for count, since in ((0, 0), (1, 0), (2, 1), (2, 1))
    ]
    answers = io.BytesIO()
    _asking.answered(folder, lines, answers)
    *asked, refused = [json.loads(answer) for answer in answers.getvalue().splitlines()]
    assert asked == [{"generation": generation} for generation in range(3)]
    assert "expected what came of generations from 2, found it from 1" in refused["error"]
    first = Path("asked/0.toml").read_text(encoding="utf-8")
    assert first.startswith("# asked for by CMA-ES of cmaes") and first.count("[[design]]") == len(told[0])


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


def test_a_design_that_is_asked_for_again_is_not_computed_again_by_processes() -> None:
    plan = _plan(2)
    assert ur.optimise(plan, "out", no_ask=True).to_ask == 0
    head = json.loads(Path("out/asked/0.json").read_text(encoding="utf-8"))["head"]
    design = '[[design]]\n"surface:sheet.tension_n_per_m" = {}\n"surface:sheet.thickness_mm" = 0.125\n'
    for generation, tensions in enumerate([(200, 250), (250, 220, 250)]):
        text = head + "".join(design.format(tension) for tension in tensions)
        Path(f"out/asked/{generation}.toml").write_text(text, encoding="utf-8")
        report = ur.optimise(plan, "out", no_ask=True, no_figures=True, jobs=2)
        if generation == 0:
            # What stands in for a computation that nobody repeats.
            part = Path("out/generations/0/parts/1.jsonl")
            part.write_text(part.read_text(encoding="utf-8").replace('"/frequencies_hz/0":', '"/frequencies_hz/0":1'))
    assert (report.designs, report.failed, report.ended.by) == (5, 0, "generations")
    hz = [float(row["/frequencies_hz/0"]) for row in _rows("out")]
    assert hz[1] > 1000 and hz[2] == hz[4] == hz[1] and hz[3] < 1000


def test_a_search_stops_where_it_does_not_improve() -> None:
    report = ur.optimise(_plan(20), "out", no_figures=True, stop_after=1, stop_percent=99)
    assert (report.ended.by, report.get("to_ask")) == ("no-improvement", None) and report.done < 20
    with pytest.raises(ur.OptionError, match="expected stop_after beside stop_percent"):
        ur.optimise(_plan(20), "out", stop_percent=1)
    with pytest.raises(ur.UnrippleError, match="stop_after: expected at least 1"):
        ur.optimise(_plan(20), "out", stop_after=0)


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
