"""Records of fields: written when they are asked for, and then what they always were."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple import _unripple

#: Bytes that the report of a field has without its record, at most; with the samples of a short drive it has twenty times as many.
SHORT = 20_000


def _timeless(data: dict[str, Any]) -> dict[str, Any]:
    """Return a report without what differs from run to run."""
    return {**data, "run": {key: value for key, value in data["run"].items() if key != "date"}}


@pytest.fixture
def report(film: ur.Surface, drive: ur.Drive) -> ur.Report:
    """A report whose record nobody has asked for."""
    return film.field(drive).report


def test_what_nobody_asks_for_is_not_written(film: ur.Surface, drive: ur.Drive) -> None:
    done = film.field(drive)._raw.done
    assert done.unrecorded is not None and len(done.unrecorded) < SHORT
    assert "run" not in json.loads(done.unrecorded)
    assert len(done.json) > 15 * SHORT
    # Of other tasks the record is short, and there at once.
    assert film.design().run.command == "design"


def test_a_record_is_the_same_as_by_name(film: ur.Surface, drive: ur.Drive, report: ur.Report) -> None:
    by_name = ur.run("field", **_asked(drive), surface=film, drive=drive)
    assert _timeless(report.to_dict()) == _timeless(by_name.to_dict())
    assert list(report) == list(by_name)
    # To the letter, but for the date.
    dates = [f'"date": "{one.run.date}"' for one in (report, by_name)]
    assert report.to_json().replace(dates[0], "") == by_name.to_json().replace(dates[1], "")


def _asked(drive: ur.Drive) -> dict[str, Any]:
    """Return where and when a drive is evaluated by default."""
    assert drive.report is not None
    targets = drive.report.targets
    return {
        "points_m": [target.at_m for target in targets],
        "instants_s": [target.instant_s for target in targets],
    }


def test_keys_are_known_before_the_record_is_written(report: ur.Report) -> None:
    names = list(report)
    assert names[-1] == "run" and len(report) == len(names) and "run" in dir(report)
    assert report._late is not None
    assert report.targets and report.get("no-such-key") is None and report._late is not None
    assert not hasattr(report, "no_such_key") and report._late is not None


def test_a_record_holds_the_samples_that_were_played(report: ur.Report, drive: ur.Drive) -> None:
    played = report.run.ask.drive
    assert report._late is None and played.rate_hz == drive.rate_hz
    assert np.array_equal(np.array(played.channels), drive.samples)
    assert report["run"]["command"] == "field" and list(report)[-1] == "run"


@pytest.mark.parametrize("how", [copy.copy, copy.deepcopy, lambda report: pickle.loads(pickle.dumps(report))])
def test_copies_have_the_record(how: Any, report: ur.Report) -> None:
    assert how(report).run.to_dict() == report.run.to_dict()


def test_a_field_is_run_again(report: ur.Report, folder: Path) -> None:
    file = folder / "report.json"
    file.write_text(report.to_json(), encoding="utf-8")
    again = ur.rerun(file)
    assert again.to_dict()["targets"] == report.to_dict()["targets"]


def test_a_field_of_a_library_names_what_was_read(library: Path) -> None:
    stored = ur.open(library)
    focus = stored.focus([(60, 90)], window_ms=15, no_figures=True)
    record = stored.field(focus, no_figures=True).report.run
    assert [file.path for file in record.files] == [str(library)]


def test_an_array_has_no_record() -> None:
    responses = ur.Responses.from_numpy(
        np.ones((1, 1, 300), np.float32), rate_hz=8000, points_mm=[(30, 40)], actuators_mm=[(10, 10)], lambda_min_mm=20
    )
    found = responses.field(np.ones((1, 100)), at=[(30, 40)]).report
    assert "run" not in found and "run" not in list(found)
    with pytest.raises(AttributeError):
        _ = found.run
    with pytest.raises(KeyError):
        _ = found["run"]


def test_the_record_of_a_task_by_name_is_there(film: ur.Surface) -> None:
    ask = json.dumps({"surface": film.as_ask()})
    assert _unripple.run("modes", ask).unrecorded is None
