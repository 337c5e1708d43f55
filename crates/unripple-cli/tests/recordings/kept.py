"""Rows that were made before, kept in a file: a run of hours that was stopped goes on where it was."""

import hashlib
import json
from pathlib import Path


def digest(program):
    """What a row depends on: the program, and every file of this folder that makes rows."""
    found = hashlib.sha256(Path(program).read_bytes())
    for file in sorted(Path(__file__).parent.glob("*.py")):
        found.update(file.read_bytes())
    return found.hexdigest()


class Kept:
    """Rows of one program by surface, fault and strength. Rows of another program are not taken."""

    def __init__(self, path, program):
        self.path = Path(path)
        self.digest = digest(program)
        text = self.path.read_text(encoding="utf-8") if self.path.exists() else ""
        if text and not text.endswith("\n"):
            # The run was killed in the middle of a line: the next row is to have one of its own.
            with self.path.open("a", encoding="utf-8") as file:
                file.write("\n")
        rows = filter(None, map(whole, text.splitlines()))
        self.rows = {key(row): row for row in rows if row.get("program") == self.digest}

    def take(self, asked):
        """The row that was asked for, if it was made before."""
        return self.rows.get(asked)

    def keep(self, row):
        """Appends a row, which is in the file when this returns."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps({**row, "program": self.digest}) + "\n")


def key(row):
    """The row as it is asked for."""
    return row["surface"], row["fault"], row["strength"]


def whole(line):
    """A line as it was written; nothing of one in the middle of which the run was killed."""
    try:
        return json.loads(line)
    except json.JSONDecodeError:
        return None
