"""What came of recordings with faults, as a page of the documentation.

    python3 table.py --kept ROWS --of COMMIT > ../../../../docs/recordings.md

Rows of all programs in the file are taken, the last of each; --of names the commit that they were made with.
"""

import argparse
import json
from pathlib import Path

import faults
import verdict

SURFACES = ["film", "glass", "panel"]

HEAD = """# Recordings with the faults of real benches

What `unripple calibrate --device tape`, and `focus` after it, make of recordings in which one thing is wrong. The recordings are made by a
program of the tests that shares no code with this one (numpy, a modal solver of its own with modes above the band), on a stretched film, a
glass plate and a slow aluminium panel, each fault in three strengths. No real surface was measured.

- **survived**: exit 0, and the drive from the library has at least 0.97 of the contrast that the clean library's has, on the true surface;
  the number is the least over the points judged.
- **named**: exit 1, the cause is told, and whoever focuses on a point that was kept and is bad is warned.
- **said**: exit 0, less than survived, the cause is told.
- **silent** would be less than survived without a word, and **unnamed** another reason than the true one: `./soak 1 recordings` fails then.

"""


def cell(row):
    """What came of a row, with the least share of contrast where there is one."""
    if row is None:
        return "not run"
    shares = [share for point, share in enumerate(row.get("shares", [])) if share is not None and point not in row.get("absent", [])]
    least = f" {min(shares):.2f}" if shares and row["came"] in ("survived", "said") else ""
    mark = "" if row["as_expected"] else " (not as wanted)"
    return f"{row['came']}{least}{mark}"


def page(rows, commit):
    """The page, of rows by surface, fault and strength."""
    wanted = [(name, fault, strength) for fault, (_, strengths) in faults.FAULTS.items() for strength in strengths for name in SURFACES]
    there = [rows[key] for key in wanted if key in rows]
    came = {kind: sum(row["came"] == kind for row in there) for kind in sorted({row["came"] for row in there})}
    count = ", ".join(f"{number} {kind}" for kind, number in came.items())
    text = HEAD + f"Of {len(wanted)} rows {len(there)} were run, with the program of {commit}: {count}.\n\n"
    text += "| fault | strength | " + " | ".join(SURFACES) + " |\n|---|---|" + "---|" * len(SURFACES) + "\n"
    for fault, (_, strengths) in faults.FAULTS.items():
        for strength in strengths:
            cells = " | ".join(cell(rows.get((name, fault, strength))) for name in SURFACES)
            text += f"| {fault} | {strength:g} | {cells} |\n"
    return text


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--kept", required=True, help="file of rows that `run.py --kept` wrote")
    ask.add_argument("--of", required=True, help="the commit whose program made them")
    given = ask.parse_args()
    lines = Path(given.kept).read_text(encoding="utf-8").splitlines()
    rows = (verdict.judged(json.loads(line)) for line in lines if line.strip())
    print(page({(row["surface"], row["fault"], row["strength"]): row for row in rows}, given.of), end="")


if __name__ == "__main__":
    main()
