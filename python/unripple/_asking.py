"""Asks for the designs of a search: what an optimiser is told, and the plan of the generation that it asks for.

An optimiser lives as long as its search does in one process, and is told each generation once. In another process it is begun anew and told
all generations before, so that the table of results is the only state of a search.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import tempfile
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

from unripple import _optimisers
from unripple._errors import UnrippleError, WorkError
from unripple._optimisers import Design, Optimiser, Unknown

#: The designs of a generation.
Designs = list[Design]


class Asking:
    """The optimiser of one search, with all that it has been told."""

    def __init__(self) -> None:
        #: Number of generations that it has been told.
        self.since = 0
        self._unknowns: list[Unknown] = []
        self._optimiser: Optimiser | None = None
        #: The designs that it asks for next; None as long as it has not been asked for them.
        self._asked: Designs | None = None

    def designs(self, question: Mapping[str, Any]) -> tuple[str, Designs, str | None]:
        """Return the optimiser as it calls itself, the designs that it asks for once it is told what is new, and why they are of no use.

        Raises
        ------
        WorkError
            If rows are those of another optimiser, or begin at another generation.
        ImportError
            If the optimiser is not installed.
        """
        first = question.get("since", 0)
        if first != self.since:
            raise WorkError(f"expected what came of generations from {self.since}, found it from {first}")
        with warnings.catch_warnings():
            # What libraries say of themselves is nothing to whoever searches.
            warnings.simplefilter("ignore")
            if self._optimiser is None:
                self._unknowns = [Unknown(told) for told in question["unknowns"]]
                self._optimiser = _optimisers.optimiser(question, self._unknowns)
            optimiser = self._optimiser
            for told in question["told"]:
                _hold(optimiser, self._unknowns, self._next(optimiser), self.since, told)
                optimiser.tell(told)
                self._asked = None
                self.since += 1
            asked = self._next(optimiser)
            return optimiser.name(), asked, optimiser.ended(asked) if self.since else None

    def _next(self, optimiser: Optimiser) -> Designs:
        """Return the designs that it asks for next, which it is asked for once."""
        if self._asked is None:
            self._asked = optimiser.ask()
        return self._asked

    def ask(self, folder: Path, question: Mapping[str, Any]) -> str | None:
        """Ask for the designs of a generation: write ``asked/G.toml`` in the folder of a search, or return why there is no use in more.

        Raises
        ------
        WorkError
            If it is no question of this format, or its rows are those of another optimiser.
        ImportError
            If the optimiser is not installed.
        """
        if question.get("format") != 1:
            raise WorkError("expected a question of format 1, found another")
        name, found, ended = self.designs(question)
        if ended is None:
            _put(folder / f"asked/{question['generation']}.toml", _text(question, name, found))
        return ended


def _hold(
    optimiser: Optimiser,
    unknowns: list[Unknown],
    asked: Designs,
    generation: int,
    told: Sequence[Mapping[str, Any]],
) -> None:
    """Refuse rows of designs that the optimiser does not ask for: it would be told what came of others."""
    same = len(asked) == len(told) and all(
        unknown.agrees(value, found)
        for design, row in zip(asked, told, strict=True)
        for unknown, (value, _), found in zip(unknowns, design, row["values"], strict=True)
    )
    if not same:
        raise WorkError(
            f"expected designs of generation {generation} as {optimiser.name()} asks for them, found those of another optimiser, or of another "
            f"version; the first line of asked/{generation}.toml names it"
        )


def _text(question: Mapping[str, Any], name: str, found: Designs) -> str:
    """Return the plan of the generation that a question is for, in TOML."""
    names = [json.dumps(told["name"], ensure_ascii=False) for told in question["unknowns"]]
    tables = (
        "[[design]]\n" + "".join(f"{key} = {value}\n" for key, (_, value) in zip(names, design, strict=True))
        for design in found
    )
    return f"# asked for by {name}\n{question['head']}" + "".join(tables)


def ask(folder: Path, generation: int) -> str | None:
    """Ask for the designs of a generation as its question in ``asked/G.json`` says, by an optimiser that is told everything; see `Asking.ask`.

    Raises
    ------
    WorkError
        If there is no such question, or its rows are those of another optimiser.
    ImportError
        If an optimiser is not installed.
    """
    place = folder / f"asked/{generation}.json"
    try:
        question = json.loads(place.read_text(encoding="utf-8"))
    except OSError as error:
        # Another process may have asked, and have removed the question.
        if place.with_suffix(".toml").exists():
            return None
        raise WorkError(f"expected the folder of a search with a question, found {error}") from None
    if question.get("generation") != generation:
        raise WorkError(f"{place}: expected the question of generation {generation}, found another")
    return Asking().ask(folder, question)


def _put(place: Path, content: str) -> None:
    """Write a file that is complete and on the disk, or not there; one that is there already stays."""
    with tempfile.TemporaryDirectory(prefix=f".{place.name}.", dir=place.parent) as aside:
        with open(os.path.join(aside, "content"), "w", encoding="utf-8", newline="\n") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        try:
            # Unlike a rename, it never replaces the designs of another process, which may have begun to compute them.
            os.link(file.name, place)
        except FileExistsError:
            return
        except OSError:
            # Some file systems have one name for each file.
            if not place.exists():
                os.replace(file.name, place)
    with contextlib.suppress(OSError):
        folder = os.open(place.parent, os.O_RDONLY)
        os.fsync(folder)
        os.close(folder)


def answered(folder: Path, lines: Iterable[bytes], answers: BinaryIO) -> None:
    """Answer questions, a line of JSON each, until there are no more: each by a line of JSON.

    An answer has ``generation`` once designs have been asked for, ``over`` with the reason if there is no use in more, or else ``error``.
    """
    asking = Asking()
    for line in lines:
        answer: dict[str, Any]
        try:
            question = json.loads(line)
            ended = asking.ask(folder, question)
            answer = {"generation": question["generation"]} if ended is None else {"over": ended}
        except (UnrippleError, ImportError, OSError) as error:
            answer = {"error": str(error)}
        answers.write(json.dumps(answer).encode() + b"\n")
        answers.flush()


def main(arguments: Sequence[str]) -> int:
    """Ask for generations, as ``python -m unripple ask FOLDER`` does; return the exit status.

    Questions come by standard input, and answers go to standard output. With a number behind the folder the question is that in
    ``asked/G.json``.
    """
    match arguments:
        case [folder]:
            answers = sys.stdout.buffer
            # What libraries print is no answer.
            with contextlib.redirect_stdout(sys.stderr), contextlib.suppress(KeyboardInterrupt):
                answered(Path(folder), sys.stdin.buffer, answers)
            return 0
        case [folder, generation] if generation.isdecimal():
            try:
                ended = ask(Path(folder), int(generation))
            except (UnrippleError, ImportError) as error:
                print(f"error: {error}", file=sys.stderr)
                return 1
            if ended is not None:
                print(f"over: {ended}")
            return 0
    print(
        "error: expected the folder of a search, and a generation if its question is there", file=sys.stderr
    )
    return 2
