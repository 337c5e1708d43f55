"""Faults by name, and what several of them share."""

import numpy as np

from bench import Case

FAULTS = {}


def fault(name, *strengths):
    """Registers what makes a case of a strength."""

    def register(make):
        FAULTS[name] = (make, strengths)
        return make

    return register


def made(name, strength, sheet):
    """A case of a fault on a sheet."""
    case = Case(sheet, sheet)
    FAULTS[name][0](case, strength)
    return case


def everything(takes):
    return takes


def probed(takes):
    return [take for take in takes if take.file.startswith("point-")]


def second(takes):
    """That of the second point."""
    return probed(takes)[1:2]


def first(takes):
    """That of the actuators."""
    return takes[:1]


def each(case, change, chosen=everything):
    """Does something to all takes, or to those chosen."""
    case.changes.append(lambda takes: [change(take) for take in chosen(takes)])


def after(case, change, chosen=everything):
    """Does something to the lines of all takes, or of those chosen."""
    each(case, lambda take: take.after.append(change), chosen)


def lose(count):
    """Takes samples out of the middle of a recording."""

    def cut(lines, _):
        at = lines.shape[1] // 2
        return np.delete(lines, np.s_[at : at + int(count)], 1)

    return cut


def exchange(kind):
    """Takes made elsewhere than the plan says: 1 two exchanged, 2 three in a circle, 3 the probe left where it was."""

    def change(takes):
        ones = probed(takes)
        order = {1: [1, 0, 2], 2: [1, 2, 0], 3: [0, 0, 2]}[kind]
        places = [ones[i].at for i in order]
        for one, at in zip(ones, places):
            one.at = at

    return change


def turned(factor):
    """The probe of the second point's take, with another gain."""

    def change(takes):
        for take in second(takes):
            take.after.append(lambda lines, _: np.vstack([lines[:-1], factor * lines[-1:]]))

    return change
