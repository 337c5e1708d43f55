"""What is done in more than one go: takes recorded again, points added, plans that differ."""

import numpy as np

from bench import once
from registry import exchange, fault, second, turned


def recorded_again(bad):
    """Calibrated with a bad take, then with a good one in its place."""

    def flow(bench, case, folder):
        run = bench.calibrate(case, folder)
        if run.exit != 0:
            return run
        bench.record(case, folder, [bad])
        bench.calibrate(case, folder)
        bench.record(case, folder, [])
        return bench.calibrate(case, folder)

    return flow


@fault("recorded-again", 1, 2, 3)
def again(case, kind):
    """What was first: a probe 3 mm off, two takes exchanged, another gain."""

    def off(takes):
        for one in second(takes):
            one.at = (np.array(one.at) + [2e-3, 2e-3]).tolist()

    case.flow = recorded_again({1: off, 2: exchange(1), 3: turned(1.43)}[kind])


def more_points(sheet, count):
    shares = [(0.5, 0.31), (0.24, 0.66), (0.71, 0.52), (0.38, 0.45)][:count]
    return [tuple(np.round(np.array(share) * sheet.sides, 6)) for share in shares]


@fault("points-added", 1, 2, 4)
def points_added(case, count):
    case.points = [*case.sheet.points, *more_points(case.sheet, count)]

    def flow(bench, case, folder):
        run = bench.calibrate(case, folder, points=case.sheet.points)
        bench.record(case, folder)
        bench.calibrate(case, folder, points=case.sheet.points)
        run = bench.calibrate(case, folder)
        if run.exit != 0:
            return run
        there = {path.name for path in (folder / "takes").iterdir()}

        def new_ones(takes):
            for take in takes:
                take.kept = take.file not in there

        bench.record(case, folder, [new_ones])
        return bench.calibrate(case, folder)

    case.flow = flow


@fault("plan-differs", 1, 2, 3)
def plan_differs(case, kind):
    """Other sweeps, a point 1 mm elsewhere, another number of repeats."""

    def flow(bench, case, folder):
        once(bench, case, folder)
        if kind == 2:
            points = [(x + 1e-3 * (i == 1), y) for i, (x, y) in enumerate(case.sheet.points)]
            return bench.calibrate(case, folder, points=points)
        return bench.calibrate(case, folder, *(["--sweep-ms", "640"] if kind == 1 else ["--repeats", "2"]))

    case.flow = flow


@fault("one-after-the-other", 1)
def one_after_the_other(case, _):
    """Calibrated after each take."""

    def flow(bench, case, folder):
        bench.calibrate(case, folder)
        recorder, takes = bench.recorder(case, folder)
        for take in takes:
            recorder.record(folder / "takes", [take])
            run = bench.calibrate(case, folder)
        return run

    case.flow = flow
