"""Optimisers of searches: CMA-ES for one objective, NSGA-II and NSGA-III for trade-offs between several.

An optimiser asks for the designs of one generation after the other, and is told what came of them.
"""

from __future__ import annotations

import importlib.metadata
import math
import sys
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from unripple import _labels

#: Designs in a generation of a trade-off, where the plan does not say.
_POPULATION = 50

#: Digits of numbers that are asked for: more of them differ from one processor to another.
_DIGITS = 12

#: How far, as a share of its range, a value may be off that an optimiser asks for once more: by what processors differ in.
_NEAR = 1e-6

#: Most values of an unknown that is searched step by step; whole numbers of longer ranges are those nearest to any number.
_STEPS = 200

#: Most objectives of NSGA-II: of more, most designs are better in something than any other, and NSGA-III goes by directions instead.
_FEW = 3


class Unknown:
    """An unknown of a plan: numbers in order, or values in none, by their coordinate from 0 to 1."""

    def __init__(self, told: Mapping[str, Any]) -> None:
        self.name: str = told["name"]
        values: list[Any] | None = told.get("values")
        #: What a plan writes, by the values; None where any number between the ends is a value.
        self.written: list[str] | None = told.get("written")
        #: Whether values are in no order.
        self.is_choice = False
        self.low: float = told.get("from", 0.0)
        self.high: float = told.get("to", 0.0)
        self.log: bool = told.get("log", False)
        self.whole: bool = told.get("whole", False)
        if values is None and self.whole and self.high - self.low < _STEPS:
            values = list(range(round(self.low), round(self.high) + 1))
            self.written = [str(value) for value in values]
        #: The values, numbers in order; None where any number between the ends is one.
        self.values = values
        if values is not None:
            numbers = all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)
            self.is_choice = not numbers or len(values) < 3
            if numbers and self.written:
                order = sorted(range(len(values)), key=values.__getitem__)
                self.values, self.written = (
                    [values[at] for at in order],
                    [self.written[at] for at in order],
                )

    @property
    def is_stepped(self) -> bool:
        """Whether it has some values, in an order."""
        return self.values is not None and not self.is_choice

    def steps(self) -> list[float]:
        """Return the coordinates of the values of an unknown that is stepped."""
        assert self.values is not None
        scaled = [math.log(value) if self.log else float(value) for value in self.values]
        return [(value - scaled[0]) / (scaled[-1] - scaled[0]) for value in scaled]

    def number(self, share: float) -> float:
        """Return the number at a coordinate, in so many digits that processors agree on them."""
        low, high = self.low, self.high
        found: float = low * (high / low) ** share if self.log else low + (high - low) * share
        rounded = float(round(found)) if self.whole else float(f"{found:.{_DIGITS}g}")
        return min(max(rounded, low), high)

    def at(self, share: float) -> tuple[Any, str]:
        """Return the value at a coordinate, each of a list with the same share, and what a plan writes."""
        if self.values is not None:
            return self.of(min(int(share * len(self.values)), len(self.values) - 1))
        found = self.number(share)
        return found, str(round(found)) if self.whole else repr(found)

    def of(self, index: int) -> tuple[Any, str]:
        """Return a value of a list by its index, and what a plan writes."""
        assert self.values is not None and self.written is not None
        return self.values[index], self.written[index]

    def agrees(self, asked: Any, told: Any) -> bool:
        """Whether a value that is asked for is the one that was told."""
        numbers = isinstance(asked, int | float) and isinstance(told, int | float)
        if self.values is not None or not numbers:
            return bool(asked == told)
        if self.log:
            return told > 0 and abs(math.log(asked / told)) <= _NEAR * math.log(self.high / self.low)
        return bool(abs(asked - told) <= _NEAR * (self.high - self.low) + (0.5 if self.whole else 0.0))


#: A design: the value of each unknown, and what a plan writes.
Design = list[tuple[Any, str]]


class Optimiser(Protocol):
    """An optimiser: it asks for a generation, and is told what came of it."""

    def name(self) -> str:
        """Return what it calls itself, with its version."""
        ...

    def ask(self) -> list[Design]:
        """Return the designs of the next generation."""
        ...

    def tell(self, told: Sequence[Mapping[str, Any]]) -> None:
        """Take losses and violations of the generation that was asked for last."""

    def ended(self, asked: list[Design]) -> str | None:
        """Return why there is no use in the designs that it asks for, nor in any others; None if there is."""
        ...


class _Evolution:
    """CMA-ES where all unknowns are any numbers between two ends."""

    def __init__(self, question: Mapping[str, Any], unknowns: list[Unknown]) -> None:
        import numpy as np

        count = len(unknowns)
        self.unknowns = unknowns
        self.optimiser = _labels.needed("cmaes", "optimise").CMA(
            mean=np.full(count, 0.5),
            sigma=0.3,
            bounds=np.tile([0.0, 1.0], (count, 1)),
            seed=question["seed"],
            population_size=question["population"],
        )
        self.asked: list[Any] = []

    def name(self) -> str:
        return f"CMA-ES of cmaes {importlib.metadata.version('cmaes')}"

    def ask(self) -> list[Design]:
        self.asked = [self.optimiser.ask() for _ in range(self.optimiser.population_size)]
        return [
            [unknown.at(float(share)) for unknown, share in zip(self.unknowns, point, strict=True)]
            for point in self.asked
        ]

    def tell(self, told: Sequence[Mapping[str, Any]]) -> None:
        self.optimiser.tell(list(zip(self.asked, _ranks(told), strict=True)))

    def ended(self, asked: list[Design]) -> str | None:
        if all(design == asked[0] for design in asked):
            return f"the designs that {self.name()} asks for are one and the same in {_DIGITS} digits"
        return _stopped(self)


class _Mixed:
    """CMA-ES with margins where an unknown is stepped, and with categories where it is a choice."""

    def __init__(self, question: Mapping[str, Any], unknowns: list[Unknown]) -> None:
        self.unknowns = unknowns
        any_number = [unknown for unknown in unknowns if unknown.values is None]
        stepped = [unknown for unknown in unknowns if unknown.is_stepped]
        choices = [len(unknown.values or ()) for unknown in unknowns if unknown.is_choice]
        self.steps = [unknown.steps() for unknown in stepped]
        self.optimiser = _labels.needed("cmaes", "optimise").CatCMAwM(
            x_space=[[0.0, 1.0]] * len(any_number) or None,
            z_space=self.steps or None,
            c_space=choices or None,
            population_size=question["population"] or max(4, 4 + math.floor(3 * math.log(len(unknowns)))),
            seed=question["seed"],
        )
        self.asked: list[Any] = []

    def name(self) -> str:
        return f"CatCMA with margin of cmaes {importlib.metadata.version('cmaes')}"

    def ask(self) -> list[Design]:
        self.asked = [self.optimiser.ask() for _ in range(self.optimiser.population_size)]
        return [self._design(point) for point in self.asked]

    def _design(self, point: Any) -> Design:
        numbers, steps, choices = iter(() if point.x is None else point.x), 0, 0
        found: Design = []
        for unknown in self.unknowns:
            if unknown.values is None:
                found.append(unknown.at(float(next(numbers))))
            elif unknown.is_stepped:
                found.append(unknown.of(self.steps[steps].index(float(point.z[steps]))))
                steps += 1
            else:
                found.append(unknown.of(int(point.c[choices].argmax())))
                choices += 1
        return found

    def tell(self, told: Sequence[Mapping[str, Any]]) -> None:
        ranks = _ranks(told)
        self.optimiser.tell(list(zip(self.asked, ranks, strict=True)))

    def ended(self, asked: list[Design]) -> str | None:
        return _stopped(self)


class _TradeOff:
    """NSGA-II between two or three objectives, NSGA-III between more."""

    def __init__(self, question: Mapping[str, Any], unknowns: list[Unknown]) -> None:
        import numpy as np

        self.unknowns, self.objectives = unknowns, question["objectives"]
        _labels.needed("pymoo.config", "optimise").Config.warnings["not_compiled"] = False
        population = question["population"] or _POPULATION
        self.by_directions = self.objectives > _FEW and population >= self.objectives
        if self.by_directions:
            made = _labels.needed("pymoo.algorithms.moo.unsga3", "optimise").UNSGA3(
                ref_dirs=self._directions(population), pop_size=population
            )
        else:
            made = _labels.needed("pymoo.algorithms.moo.nsga2", "optimise").NSGA2(pop_size=population)
        problem = _labels.needed("pymoo.core.problem", "optimise").Problem(
            n_var=len(unknowns),
            n_obj=self.objectives,
            n_ieq_constr=1,
            xl=np.zeros(len(unknowns)),
            xu=np.ones(len(unknowns)),
        )
        # The plan says when it is over.
        self.optimiser = made.setup(
            problem, seed=question["seed"], termination=("n_gen", sys.maxsize), verbose=False
        )
        self.problem = problem
        self.asked: Any = None

    def _directions(self, population: int) -> Any:
        """Return as many evenly spread directions as there are designs for."""
        parts = 1
        while math.comb(self.objectives + parts, parts + 1) <= population:
            parts += 1
        of = _labels.needed("pymoo.util.ref_dirs", "optimise").get_reference_directions
        return of("das-dennis", self.objectives, n_partitions=parts)

    def name(self) -> str:
        called = "U-NSGA-III" if self.by_directions else "NSGA-II"
        return f"{called} of pymoo {importlib.metadata.version('pymoo')}"

    def ask(self) -> list[Design]:
        self.asked = self.optimiser.ask()
        return [
            [unknown.at(float(share)) for unknown, share in zip(self.unknowns, point, strict=True)]
            for point in self.asked.get("X")
        ]

    def tell(self, told: Sequence[Mapping[str, Any]]) -> None:
        import numpy as np

        known = [design["losses"] for design in told if design["losses"] is not None]
        worst = np.max(known, axis=0).tolist() if known else [0.0] * self.objectives
        beyond = 1.0 + max((design["violation"] for design in told), default=0.0)
        # A design that failed is further from its bounds than any other.
        losses = [worst if design["losses"] is None else design["losses"] for design in told]
        violations = [
            [max(1e6, 1e3 * beyond) if design["losses"] is None else design["violation"]] for design in told
        ]
        static = _labels.needed("pymoo.problems.static", "optimise").StaticProblem(
            self.problem, F=np.array(losses, dtype=float), G=np.array(violations, dtype=float)
        )
        _labels.needed("pymoo.core.evaluator", "optimise").Evaluator().eval(static, self.asked)
        self.optimiser.tell(infills=self.asked)

    def ended(self, asked: list[Design]) -> str | None:
        # It asks for as long as it may.
        return None


def _stopped(of: _Evolution | _Mixed) -> str | None:
    """Return that the search distribution of CMA-ES cannot lead any further, by its own criteria; None if it can."""
    if not of.optimiser.should_stop():
        return None
    return f"{of.name()} stops by its own criteria: its steps have become too small, too large, or degenerate"


def _ranks(told: Sequence[Mapping[str, Any]]) -> list[float]:
    """Return the place of each design of a generation with one objective, the best first.

    Designs that keep all constraints come by their loss, then others by how far they are out of their bounds, then those that failed. CMA-ES
    goes by places alone.
    """

    def key(at: int) -> tuple[int, float]:
        losses, violation = told[at]["losses"], told[at]["violation"]
        if losses is None:
            return 2, 0.0
        return (1, violation) if violation > 0 else (0, losses[0])

    ranks = [0.0] * len(told)
    for place, at in enumerate(sorted(range(len(told)), key=key)):
        ranks[at] = float(place)
    return ranks


def optimiser(question: Mapping[str, Any], unknowns: list[Unknown]) -> Optimiser:
    """Return the optimiser of a search, that has been told nothing."""
    if question["objectives"] > 1:
        return _TradeOff(question, unknowns)
    if all(unknown.values is None for unknown in unknowns):
        return _Evolution(question, unknowns)
    return _Mixed(question, unknowns)
