"""One case from beginning to end: the plan asked for, the takes recorded, the library made, its drives played on the true sheet."""

import json
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

import library as stored
import sheet as sheets
import wav
from takes import Recorder, Take

# Seconds that a command may take before it counts as one that hangs.
PATIENCE = 900


@dataclass
class Case:
    """A fault of one strength on one sheet."""

    sheet: sheets.Sheet
    # The true sheet.
    truth: sheets.Sheet
    # Options of `calibrate` when it plans, and those that only come with the recordings.
    options: list = field(default_factory=list)
    later: list = field(default_factory=list)
    # Names of the channels, where they are not those of the plan by default.
    inputs: list = None
    points: list = None
    # What is done to the list of takes, and to the recorder.
    changes: list = field(default_factory=list)
    cables: list = field(default_factory=list)
    bend: float = 0.0
    # Whether the actuators' own points are judged as well.
    own: bool = False
    # The sheet whose clean library this one is held against, and its options.
    against: sheets.Sheet = None
    # Factors of the tension that the sheet had: the library may be of any.
    states: tuple = (1.0,)
    # Whether a model is fitted to the library, and judged in its place.
    fit: bool = False
    # What is done instead of planning, recording and calibrating once.
    flow: object = None
    # Whether the level of responses counts.
    level: bool = True
    # Whether contrast is held against that of the true responses, since there is nothing wrong.
    of_truth: bool = False
    # Points that nobody recorded.
    absent: list = field(default_factory=list)


@dataclass
class Ran:
    """What a command said."""

    exit: int
    text: str

    def message(self):
        """What a person looks at first: the first complaint, or else the first line."""
        lines = [line.strip() for line in self.text.splitlines() if line.strip()]
        told = [line for line in lines if "expected" in line or "doubt" in line or "warning" in line or ".wav:" in line]
        return (told or lines or [""])[0]


class Bench:
    """Runs cases through the program, in folders of its own."""

    def __init__(self, program, keep=None):
        self.program = str(program)
        self.keep = keep
        self.clean = {}

    def run(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE)
        return Ran(done.returncode, done.stderr + done.stdout)

    def work(self, case):
        """Runs a case and judges it: a dictionary."""
        folder = Path(self.keep) if self.keep else Path(tempfile.mkdtemp(prefix="unripple-recordings-"))
        folder.mkdir(parents=True, exist_ok=True)
        try:
            (folder / "surface.toml").write_text(case.sheet.file())
            run = (case.flow or once)(self, case, folder)
            run = Ran(run.exit, run.text.replace(f"{folder}/", ""))
            fitted = None
            if case.fit and (folder / "library").exists():
                at = [f"--at={x * 1e3:.6f},{y * 1e3:.6f}" for x, y in case.sheet.points]
                fitted = self.run("fit", folder / "library", *at, "-o", folder / "fitted")
                run = Ran(run.exit or fitted.exit, run.text + fitted.text)
            library = folder / ("fitted" if fitted else "library")
            found = self.judged(case, library, folder) if library.exists() else {}
            return {"exit": run.exit, "text": run.text, "message": run.message(), **found}
        finally:
            if not self.keep:
                shutil.rmtree(folder, ignore_errors=True)

    def calibrate(self, case, folder, *more, points=None, library="library"):
        points = points if points is not None else case.points or case.sheet.points
        at = [f"--at={x * 1e3:.6f},{y * 1e3:.6f}" for x, y in points]
        inputs = ["--tape-inputs", ",".join(case.inputs)] if case.inputs else []
        surface, takes = folder / "surface.toml", folder / "takes"
        fixed = ["calibrate", surface, "--device", "tape", "--tape", takes, "-o", folder / library]
        return self.run(*fixed, *at, *inputs, *case.options, *more)

    def recorder(self, case, folder):
        """The true sheet, and the takes that the plan asks for."""
        plan = json.loads((folder / "takes" / "plan.json").read_text())
        play, _ = wav.read(folder / "takes" / "play.wav")
        recorder = Recorder(case.truth, play, plan["inputs"], case.bend)
        for change in case.cables:
            change(recorder)
        wanted = plan["recordings"]
        takes = [Take(one["file"], one["probe_at_m"], 100 + number) for number, one in enumerate(wanted)]
        return recorder, takes

    def record(self, case, folder, changes=None):
        recorder, takes = self.recorder(case, folder)
        for change in case.changes if changes is None else changes:
            change(takes)
        recorder.record(folder / "takes", takes)
        return recorder

    def judged(self, case, library, folder):
        """Shares of the clean library's contrast, and of its responses' level, point by point."""
        against = case.against or replace(case.sheet, stiffer=1.0)
        clean = self.reference(against, case)
        own = case.sheet.places()[[0, 3, 7]].tolist() if case.own else []
        shares, levels, says = [], [], []
        for at in [*(case.points or case.sheet.points), *own]:
            point, there = stored.number(library, at), stored.number(clean[0] / "library", at)
            drive, said = (None, "") if point is None else self.drive(library, at, case.sheet, folder)
            says.append(said)
            if case.level and there is not None and not case.fit:
                levels.append(None if point is None else stored.level(library, point, clean[0] / "library", there))
            if drive is None:
                shares.append(None)
                continue
            states = [replace(case.truth, stiffer=case.truth.stiffer * float(s)) for s in case.states]
            best = max(sheets.contrast(state, drive, at) for state in states)
            shares.append(best / (of_truth(against, at) if case.of_truth else self.of_clean(clean, at, against)))
        reference = "library" if clean[2] and not case.of_truth else "truth"
        return {"shares": shares, "levels": levels, "focus": says, "absent": case.absent, "reference": reference}

    def reference(self, sheet, case):
        """The library of takes without a fault, made once."""
        key = (sheet, tuple(case.points or ()))
        if key not in self.clean:
            folder = Path(tempfile.mkdtemp(prefix="unripple-recordings-clean-"))
            (folder / "surface.toml").write_text(sheet.file())
            plain = Case(sheet, sheet, points=case.points)
            run = once(self, plain, folder)
            shutil.rmtree(folder / "takes")
            self.clean[key] = folder, {}, run.exit == 0
        return self.clean[key]

    def of_clean(self, clean, at, sheet):
        """Contrast of the clean library; of time reversal by the true responses, where clean recordings make none."""
        folder, known, made = clean
        key = tuple(at)
        if key not in known:
            drive = self.drive(folder / "library", at, sheet, folder)[0] if made else None
            known[key] = of_truth(sheet, at) if drive is None else sheets.contrast(sheet, drive, at)
        return known[key]

    def drive(self, library, at, sheet, folder):
        """What the program would play, a line for each actuator of the sheet, and what it said."""
        out = Path(tempfile.mkdtemp(prefix="focus-", dir=folder)) / "out"
        place = f"{at[0] * 1e3:.6f},{at[1] * 1e3:.6f}"
        ran = self.run("focus", library, f"--at={place}", "--window-ms", f"{sheet.window * 1e3:g}", "-o", out, "--json")
        if not (out / "drive.wav").exists():
            return None, ran.text
        lines, _ = wav.read(out / "drive.wav")
        names = [one["name"] for one in json.loads((out / "report.json").read_text())["actuators"]]
        found = dict(zip(names, lines))
        still = np.zeros(lines.shape[1])
        text = "\n".join(line for line in ran.text.splitlines() if not line.startswith((" ", "{", "}")))
        return np.array([found.get(name, still) for name in sheet.names()]), text

    def close(self):
        for folder, _, _ in self.clean.values():
            shutil.rmtree(folder, ignore_errors=True)


def once(bench, case, folder):
    """The plan, the recordings, the library."""
    run = bench.calibrate(case, folder)
    if run.exit != 0:
        return run
    recorder = bench.record(case, folder)
    later = [option(recorder) if callable(option) else [option] for option in case.later]
    return bench.calibrate(case, folder, *sum(later, []))


def of_truth(sheet, at):
    """Contrast of time reversal by the true responses."""
    return sheets.contrast(sheet, sheets.reversal(sheet, at), at)
