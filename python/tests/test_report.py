"""Reports: mappings and attributes, text, JSON, tables."""

from __future__ import annotations

import copy
import json
import logging
from pathlib import Path

import pandas as pd
import pytest

import unripple as ur


@pytest.fixture(scope="module")
def design() -> ur.Report:
    return ur.design("hudin-2012")


def test_keys_are_attributes_at_any_depth(design: ur.Report, drive: ur.Drive) -> None:
    assert design.actuators == design["actuators"] == 8
    assert design.dispersion[0].frequency_hz == design["dispersion"][0]["frequency_hz"]
    assert drive.report is not None
    target = drive.report.targets[1]
    assert target.at_m == [0.1, 0.09]
    assert "contrast" in target and list(target)[0] in dir(target)
    assert len(design) == len(design.to_dict()) and set(design) == set(design.to_dict())
    with pytest.raises(AttributeError, match="nearest: dispersion"):
        _ = design.dispersions
    with pytest.raises(KeyError):
        _ = design["dispersions"]


def test_a_report_cannot_be_changed(design: ur.Report) -> None:
    with pytest.raises(TypeError):
        design["actuators"] = 9  # type: ignore[index]
    with pytest.raises(AttributeError):
        design.actuators = 9
    design.band_hz.append(1)
    design.to_dict()["actuators"] = 9
    design.dispersion[0].to_dict()["frequency_hz"] = 1
    assert design.actuators == 8 and len(design.band_hz) == 2


def test_json_is_that_of_the_command_line(design: ur.Report) -> None:
    assert design.to_dict() == json.loads(design.to_json())
    assert design.run.command == "design" and design.run.schema == "report-1"


def test_its_text_is_for_people(design: ur.Report) -> None:
    assert "contrast" in str(design) and str(design) == repr(design)
    assert not str(design).endswith("\n")
    html = design._repr_html_()
    assert html.startswith("<table") and "dispersion" in html


def test_copies_are_equal(design: ur.Report) -> None:
    for other in (copy.copy(design), copy.deepcopy(design)):
        assert other.to_dict() == design.to_dict() and str(other) == str(design)


def test_tables_are_data_frames(film: ur.Surface, design: ur.Report, drive: ur.Drive) -> None:
    modes = film.modes()
    frame = modes.to_dataframe()
    assert isinstance(frame, pd.DataFrame) and len(frame) == modes.count
    assert list(frame["frequencies_hz"]) == modes.frequencies_hz
    assert drive.report is not None
    targets = drive.report.to_dataframe()
    assert len(targets) == 2 and list(targets["contrast"]) == [t.contrast for t in drive.report.targets]
    assert len(design.to_dataframe("dispersion")) == len(design.dispersion)
    assert len(ur.materials().to_dataframe()) == len(ur.materials().materials)
    with pytest.raises(ur.OptionError):
        design.to_dataframe("no_such_key")
    with pytest.raises(ur.OptionError):
        design.to_dataframe(library="dask")  # type: ignore[arg-type]


def test_lines_go_to_the_log(film: ur.Surface, folder: Path, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, logger="unripple"):
        report = film.play(seconds=0.5, fingers=1, window_ms=20)
    assert all(record.name.startswith("unripple") for record in caplog.records)
    assert report.lost_blocks == 0


def test_lists_of_names() -> None:
    assert "hudin-2012" in ur.builtin() and "click-button" in ur.effects()
    assert "glass" in [material.name for material in ur.materials().materials]
    for name, known in (("pet", "BoPET"), ("mdf", "MDF"), ("plywood", "plywood")):
        (material,) = ur.materials(name).materials
        assert material.name == known and material.source
        assert ur.Surface("glass-plate", material=name).toml.count(f'material = "{known}"') == 1
    assert ur.__version__.count(".") == 2
