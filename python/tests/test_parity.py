"""Everything has a name in Python: commands, options, fields of asks, keys of reports."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import parity
import pytest

import unripple as ur
from unripple import _options, _unripple, _view
from unripple._report import Part, Report

#: Options of the command line that are no options of a task: how its results are printed.
_OF_THE_TERMINAL = {"json", "verbose", "quiet", "help", "version"}

#: Commands of the command line that are no tasks: those of the shell and of what the machine keeps, and the page, which is `Surface.view`.
_NO_TASKS = {"view", "cache", "completions", "man", "help"}

#: Options of the command line that its command refuses, those of other targets than points and shapes; and the number of processes, since
#: Python's own process computes.
_REFUSED = {"compare": {"waveform", "silent", "path", "speed_mm_s", "level_mm_s"}, "sweep": {"jobs"}, "optimise": {"jobs"}}

#: The tasks that the command line has as one.
_AS_ONE = {"focus": ("focus", "waveform", "stroke"), "fit": ("fit", "fit_modes")}


def test_the_page_is_up_to_date() -> None:
    page = parity.ROOT / "docs/python-parity.md"
    assert page.read_text(encoding="utf-8") == parity.page(), f"python/tests/parity.py writes {page}"


@pytest.mark.parametrize("command", _unripple.commands())
def test_a_command_is_a_function(command: str) -> None:
    assert parity.commands()[command], "expected a function or a method that does it"


@pytest.mark.parametrize("command", _unripple.commands())
def test_each_field_of_an_ask_has_an_option(command: str) -> None:
    holes = [field for field, names in parity.options(command).items() if not names]
    assert not holes


def test_options_are_of_fields_that_there_are() -> None:
    for command, options in _options.OPTIONS.items():
        fields = set(_options.fields(command).values())
        assert {option.field for option in options} <= fields, command


def _said_options(program: str, command: str) -> set[str]:
    """Long options that the help of a command names, as Python would call them."""
    said = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=True).stdout
    found = re.findall(r"^\s+(?:-\w, )?--([a-z][a-z0-9-]*)", said, re.MULTILINE)
    return {option.replace("-", "_") for option in found} - _OF_THE_TERMINAL


def _said_commands(program: str) -> set[str]:
    said = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    listed = said.split("Commands:")[1].split("Options:")[0]
    return set(re.findall(r"^  ([a-z]+)", listed, re.MULTILINE))


def test_each_command_of_the_command_line_is_here(program: str) -> None:
    listed = _said_commands(program)
    assert len(listed) > 15
    assert listed - _NO_TASKS <= set(_unripple.commands())
    assert hasattr(ur.Surface, "view")


def test_each_option_of_the_page_is_here(program: str) -> None:
    of_devices = {option.name for option in _options.OPTIONS["doctor"] if option.field.startswith("device")}
    # `browser` says the opposite of the one, and the other is how the page ends with Python.
    # The accuracy is a key of the surface.
    known = {*_view._OPTIONS, *of_devices, "no_browser", "until_input_ends", "accuracy"}
    assert _said_options(program, "view") - known == set()


@pytest.mark.parametrize("command", sorted(set(_unripple.commands()) - {"waveform", "stroke", "fit_modes"}))
def test_each_option_of_the_command_line_is_here(program: str, command: str) -> None:
    tasks = _AS_ONE.get(command, (command,))
    known = {name for task in tasks for name in _options.names(task)} | _REFUSED.get(command, set())
    said = _said_options(program, command)
    assert "output" in said or "set" in said, "the help was not understood"
    # Every command line has `--set` and `--accuracy`, and refuses them where no surface is read; in Python they are keys of the surface.
    assert said - known <= {"set", "accuracy"}


def test_each_key_of_a_report_is_an_attribute() -> None:
    parts = parity.parts()
    assert len(parts) > 30
    keys = sorted({key for of_part in parts.values() for key in of_part})
    assert len(keys) > 300
    part = Part(dict.fromkeys(keys, 1))
    assert [key for key in keys if not parity.is_attribute(key) or getattr(part, key) != 1] == []


def test_reports_have_no_key_beside_the_schema(film: ur.Surface, drive: ur.Drive) -> None:
    known = {key for of_part in parity.parts().values() for key in of_part} | {"run"}
    for report in (film.design(), film.check(), film.modes(), drive.report):
        assert isinstance(report, Report)
        assert set(report) <= known


def test_the_page_lists_nothing_twice() -> None:
    text = (Path(parity.ROOT) / "docs/python-parity.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (.*)$", text, re.MULTILINE)
    assert sorted(set(headings)) == sorted(headings)
