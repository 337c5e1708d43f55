"""The table of a sweep as an Apache Parquet file."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from unripple import _labels
from unripple._errors import InputError

#: The table in the folder of a sweep.
_TABLE = "table.csv"

#: Columns of text, though a hash may have digits alone.
_TEXTS = ("hash", "version", "error")


def parquet(report: Mapping[str, Any], path: Path) -> None:
    """Write the table of a sweep, from the folder that its report names."""
    csv, files = _labels.needed("pyarrow.csv", "parquet"), _labels.needed("pyarrow.parquet", "parquet")
    run = report["run"]
    if run["command"] != "sweep":
        raise InputError(f"to_parquet: expected the report of a sweep, found that of `{run['command']}`")
    if _TABLE not in report["files"]:
        missing = f"{report['missing']} of {report['designs']} designs are missing"
        raise InputError(f"to_parquet: expected a sweep that has its table, found one whose {missing}")
    source = Path(run["ask"]["output"], _TABLE)
    if not source.is_file():
        raise InputError(f"to_parquet: expected the table of the sweep, found no {source}")
    table = _typed(csv, source)
    about = {"unripple": report["version"], "plan_sha256": report["plan_sha256"]}
    table = table.replace_schema_metadata(about)
    # Beside its place first, so that no file is there in part.
    with tempfile.TemporaryDirectory(prefix=f".{path.name}.", dir=path.parent) as aside:
        written = os.path.join(aside, "content")
        files.write_table(table, written)
        os.replace(written, path)


def _typed(csv: Any, source: Path) -> Any:
    """Return the table with columns of whole numbers, numbers, truths or texts, by all of their values."""
    arrow = _labels.needed("pyarrow", "parquet")
    with csv.open_csv(source, parse_options=csv.ParseOptions(newlines_in_values=True)) as reader:
        names = reader.schema.names
    options = csv.ConvertOptions(
        column_types=dict.fromkeys(names, arrow.string()), strings_can_be_null=True, null_values=[""]
    )
    table = csv.read_csv(
        source, parse_options=csv.ParseOptions(newlines_in_values=True), convert_options=options
    )
    kinds = (arrow.int64(), arrow.float64(), arrow.bool_())
    columns = {}
    for name in names:
        column = table[name]
        known = name not in _TEXTS and column.null_count < len(column)
        for kind in kinds if known else ():
            try:
                column = column.cast(kind)
                break
            except arrow.ArrowInvalid:
                continue
        columns[name] = column
    return arrow.table(columns)
