"""What came of a case, and whether that is what it should be."""

import re
from pathlib import Path

# Least share of the clean library's contrast, and most by which a level may differ, of what counts as survived.
LEAST = 0.97
LEVEL = 0.05

FIGURES = ("  signal to noise  ", "  decay time  ", "  latency  ", "  reciprocity  ")

HEAD = f"{'surface':8}{'fault':27}{'strength':>9}  {'came':9}{'wanted':22}{'exit':>4}  {'share':>28}  {'level':>16}  said"


def expected():
    """The table: for a fault and a strength what may come of it, and words of which one must be said."""
    table = {}
    for line in (Path(__file__).parent / "expected.txt").read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, strengths, come, words = (part.strip() for part in line.split(" | "))
            for strength in strengths.split(","):
                key = strength.strip()
                surface, _, number = key.rpartition(":")
                table[(surface, name, float(number) if number != "*" else None)] = (come.split("/"), words)
    return table


TABLE = expected()


def wanted(row):
    for surface in (row["surface"], ""):
        for strength in (float(row["strength"]), None):
            found = TABLE.get((surface, row["fault"], strength))
            if found:
                return found
    return ["survived", "named"], "-"


def judged(row):
    """The row with `came`, which is one of

    survived   exit 0, all points (but those that nobody recorded) focus as those of the clean library do
    named      exit 1 and the cause told; whoever focuses on a point that was kept and is bad is warned
    unwarned   the same, but somebody who focuses is not warned
    unnamed    exit 1 for another reason
    said       exit 0, less than survived, the cause told
    silent     exit 0, less than survived, nothing told
    usage      exit 2: the program does not know an option
    """
    come, words = wanted(row)
    says = row.get("focus", [])
    # Figures that every report has say nothing of what is wrong.
    said = [line for line in row["text"].splitlines() if not line.startswith(FIGURES)]
    told = words != "-" and re.search(words, "\n".join([*said, *says]), re.IGNORECASE)
    good = [share is not None and share >= LEAST for share in row.get("shares", [])]
    warned = [bool(re.search("doubt|warning", said)) for said in says]
    levels = [level is not None and abs(level - 1.0) <= LEVEL for level in row.get("levels", [])]
    there = [point for point in range(len(good)) if point not in row.get("absent", [])]
    well = bool(good) and all(good[point] and (point >= len(levels) or levels[point]) for point in there)
    if row["exit"] < 0 or "panicked" in row["text"]:
        came = "crashed"
    elif row["exit"] == 2:
        came = "usage"
    elif row["exit"] != 0:
        used = [point for point in there if row["shares"][point] is not None]
        quiet = any(not good[point] and not warned[point] for point in used)
        came = ("unwarned" if quiet else "named") if told else "unnamed"
    elif well:
        came = "survived"
    else:
        came = "said" if told else "silent"
    # What is survived is told of too, where the table has words for it.
    as_expected = came in come and (came != "survived" or words == "-" or bool(told) or "quietly" in come)
    return {**row, "came": came, "told": bool(told), "wanted": "/".join(come), "as_expected": as_expected}


def line(row):
    def numbers(values):
        return " ".join("-" if value is None else f"{value:.2f}" for value in values or [])

    shares = numbers(row.get("shares")) + (" of truth" if row.get("reference") == "truth" else "")
    mark = " " if row["as_expected"] else "!"
    return (
        f"{row['surface']:8}{row['fault']:27}{row['strength']:>9}  {row['came']:9}{row['wanted']:22}{row['exit']:>4} {mark}"
        f"{shares:>28}  {numbers(row.get('levels')):>16}  {row['message'][:240]}"
    )
