"""Tables of sweeps as Parquet files."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import pytest

import unripple as ur

_PLAN = """
format = 1
task = "modes"
surface = "hudin-2012"
ask = { top_hz = 250 }
figures = ["/count", "/frequencies_hz/0", "/surface", "/loaded"]
shard = 2
[[axis]]
key = "sheet.material"
values = ["BoPET", "glass"]
[[axis]]
key = "sheet.tension_n_per_m"
values = [150, -1, 200.5]
"""


@pytest.fixture
def report(folder: Path) -> ur.Report:
    """The report of a sweep of six designs, two of which have no figures."""
    (folder / "plan.toml").write_text(_PLAN)
    return ur.sweep("plan.toml", "out", no_figures=True)


def test_a_table_has_the_values_of_the_rows(report: ur.Report, folder: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    report.to_parquet(folder / "table.parquet")
    table = parquet.read_table(folder / "table.parquet")
    with open("out/table.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert table.column_names == list(rows[0])
    kinds = {field.name: str(field.type) for field in table.schema}
    assert (kinds["index"], kinds["surface:sheet.tension_n_per_m"]) == ("int64", "double")
    assert (kinds["/count"], kinds["/surface"], kinds["hash"]) == ("int64", "string", "string")
    columns = table.to_pydict()
    assert columns["index"] == list(range(6))
    assert columns["surface:sheet.tension_n_per_m"] == [150, -1, 200.5] * 2
    for name in ("/count", "/frequencies_hz/0"):
        assert columns[name] == [float(row[name]) if row[name] else None for row in rows]
    assert [error is None for error in columns["error"]] == [True, False, True] * 2
    assert table.schema.metadata[b"plan_sha256"].decode() == report.plan_sha256
    assert sorted(path.name for path in folder.iterdir()) == ["out", "plan.toml", "table.parquet"]


def test_who_has_no_pyarrow_is_told_what_to_install(
    report: ur.Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("pyarrow", "pyarrow.csv", "pyarrow.parquet"):
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=r"pip install 'unripple\[parquet\]'"):
        report.to_parquet("table.parquet")


def test_a_report_without_a_table_is_refused(report: ur.Report, film: ur.Surface, folder: Path) -> None:
    pytest.importorskip("pyarrow")
    with pytest.raises(ur.InputError, match="expected the report of a sweep, found that of `modes`"):
        film.modes(max_hz=200).to_parquet("table.parquet")
    part = ur.sweep("plan.toml", "part", shard=0)
    with pytest.raises(ur.InputError, match="4 of 6 designs are missing"):
        part.to_parquet("table.parquet")
    (folder / "out/table.csv").unlink()
    with pytest.raises(ur.InputError, match="found no out"):
        report.to_parquet("table.parquet")
