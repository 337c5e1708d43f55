"""Recordings as benches make them, with one thing wrong, through `unripple calibrate --device tape` and `focus`; a row for each.

    python3 run.py --program target/release/unripple --surface film --fault clock-ppm --strength 200

needs numpy and nothing of the program. Without --fault all, without --strength all three, without --surface film, glass and panel.
Ends with 1 where something came otherwise than `expected.txt` wants it.
"""

import argparse
import atexit
import json
import os
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed

sys.dont_write_bytecode = True
# One process is to be one processor, unless somebody wants it otherwise.
for library in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(library, "1")

import bench as benches  # noqa: E402
import faults  # noqa: E402
import kept  # noqa: E402
import verdict  # noqa: E402
from sheet import SHEETS  # noqa: E402

# What is run where nothing else is asked for.
USUAL = ["film", "glass", "panel"]

BENCH = []


def begin(program, keep):
    """A bench of this process's own."""
    BENCH.append(benches.Bench(program, keep))
    atexit.register(BENCH[0].close)


def work(row):
    name, fault, strength = row
    strength = int(strength) if strength == int(strength) else strength
    found = BENCH[0].work(faults.made(fault, strength, SHEETS[name]))
    return {"surface": name, "fault": fault, "strength": strength, **found}


def made(asked, given):
    """Rows as they come, in any order: those kept from before, then the others."""
    before = kept.Kept(given.kept, given.program) if given.kept else None
    known = [before.take(row) if before else None for row in asked]
    yield from filter(None, known)
    left = [row for row, found in zip(asked, known) if found is None]
    with ProcessPoolExecutor(given.jobs, initializer=begin, initargs=(given.program, given.keep)) as pool:
        for future in as_completed([pool.submit(work, row) for row in left]):
            row = future.result()
            if before:
                before.keep(row)
            yield row


def asked(given):
    """Rows of which nobody knows yet what comes: surface, fault, strength."""
    if given.rows:
        lines = (line.split() for line in open(given.rows, encoding="utf-8") if line.strip() and line[0] != "#")
        return [(name, fault, float(strength)) for name, fault, strength in lines]
    return [
        (name, fault, strength)
        for name in given.surface or USUAL
        for fault in given.fault or faults.FAULTS
        for strength in given.strength or faults.FAULTS[fault][1]
    ]


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--program", default="target/release/unripple")
    ask.add_argument("--surface", choices=SHEETS, action="append")
    ask.add_argument("--fault", choices=faults.FAULTS, action="append")
    ask.add_argument("--strength", type=float, action="append")
    ask.add_argument("--rows", metavar="FILE", help="lines of surface, fault and strength in place of these three")
    ask.add_argument("--json", action="store_true", help="one object a line")
    ask.add_argument("--text", action="store_true", help="all that the program said, after each row")
    ask.add_argument("--keep", metavar="DIR", help="leave the files of the last case there")
    ask.add_argument("--jobs", type=int, default=1, help="rows at once")
    ask.add_argument("--kept", metavar="FILE", help="rows made before by the same program are taken from there, and new ones put there")
    given = ask.parse_args()
    if not given.json:
        print(verdict.HEAD)
    wrong = rows = 0
    for row in made(asked(given), given):
        # Judged anew each time: what is wanted may have changed since the row was made.
        row = verdict.judged(row)
        rows, wrong = rows + 1, wrong + (not row["as_expected"])
        print(json.dumps(row) if given.json else verdict.line(row), flush=True)
        if given.text:
            print(row["text"], *row.get("focus", []), sep="\n", flush=True)
    if not given.json:
        print(f"{rows} rows, {wrong} otherwise than wanted")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
