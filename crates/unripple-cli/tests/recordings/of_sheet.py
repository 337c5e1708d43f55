"""Faults of the sheet: it changes, it rings long, it is another than its file says, it is knocked at."""

from dataclasses import replace

import numpy as np

from registry import each, exchange, fault, first, probed


def drifting(case, percent):
    """The library may be of any tension that there was."""
    case.states = tuple(np.linspace(1.0, 1.0 + 0.01 * percent, 11))


def from_take_to_take(case, percent):
    def change(takes):
        for take, share in zip(takes, np.linspace(0.0, 1.0, len(takes))):
            take.stiffer = (1.0 + 0.01 * percent * share,) * 2

    case.changes.append(change)
    drifting(case, percent)


@fault("tension-between-takes", 0.1, 0.25, 0.5)
def between(case, percent):
    """From take to take, by so much in all."""
    from_take_to_take(case, percent)


@fault("tension-within-takes", 0.1, 0.25, 0.5)
def within(case, percent):
    """In each of the points' takes, from what it was to so much more."""
    each(case, lambda take: setattr(take, "stiffer", (1.0, 1.0 + 0.01 * percent)), probed)
    drifting(case, percent)


@fault("tension-within-actuators", 0.1, 0.25, 0.5)
def within_actuators(case, percent):
    case.own = True
    each(case, lambda take: setattr(take, "stiffer", (1.0, 1.0 + 0.01 * percent)), first)
    drifting(case, percent)


@fault("rings-ms", 70, 100, 200)
def rings(case, decay):
    case.sheet = replace(case.sheet, decay=decay * 1e-3)
    case.truth = replace(case.truth, decay=decay * 1e-3)
    case.of_truth = True


@fault("file-tension-off-percent", 2, 5, 10)
def file_tension(case, percent):
    """The surface file says less tension than there is; of a plate, less bending stiffness."""
    other_file(case, percent, 0.0)


@fault("file-thickness-off-percent", 1, 2, 5)
def file_thickness(case, percent):
    other_file(case, 0.0, percent)


def other_file(case, percent, thicker):
    told = case.sheet
    less = 1.0 - 0.01 * percent
    case.against = told
    case.sheet = replace(
        told,
        tension=told.tension * less,
        young=told.young * (1.0 if told.tension else less),
        thickness=told.thickness * (1.0 + 0.01 * thicker),
    )


@fault("ribs-percent", 1, 3, 10)
def ribs(case, percent):
    """Modes as no sheet of the file's kind has them: there is nothing to hold recordings against.

    With a reference: what an actuator hears of itself at first is not what it would be with ribs somewhere else.
    """
    case.inputs = [*case.sheet.names(), "probe", "reference"]
    case.against = case.truth = replace(case.truth, ribs=0.01 * percent)
    case.of_truth = True


@fault("ribs-percent-and-no-model", 1, 3, 10)
def ribs_and_no_model(case, percent):
    ribs(case, percent)
    case.later.append("--no-model")


@fault("file-off-and-exchanged", 1, 2, 3)
def file_off_and_exchanged(case, kind):
    other_file(case, 5, 0.0)
    case.changes.append(exchange(kind))


@fault("knock-in-one-take", 0.1, 1, 10)
def knock(case, force):
    """A tap of 2 ms beside the probe while a sweep plays; its peak in limits of the drive."""
    shape = force * case.sheet.limit * np.sin(np.pi * np.arange(96) / 96)
    place = np.array([[0.3 * case.sheet.sides[0], 0.7 * case.sheet.sides[1]]])

    def change(takes):
        one = probed(takes)[1]
        one.knock = (place, int(1.7 * case.sheet.rate), shape)

    case.changes.append(change)


@fault("knock-in-one-repeat", 0.1, 1, 10)
def knock_in_repeat(case, force):
    knock(case, force)
    case.options += ["--repeats", "2"]


@fault("fit-after-drift", 0.1, 0.25, 0.5)
def fit_after_drift(case, percent):
    case.fit = True
    from_take_to_take(case, percent)


@fault("fit-after-exchange", 1, 2, 3)
def fit_after_exchange(case, kind):
    case.fit = True
    case.changes.append(exchange(kind))


@fault("fit-after-exchange-unheeded", 1, 2, 3)
def fit_after_exchange_unheeded(case, kind):
    """The library is made without a model, so that the fit is the first to see it."""
    fit_after_exchange(case, kind)
    case.later.append("--no-model")


@fault("fit-clean", 0)
def fit_clean(case, _):
    case.fit = True


@fault("tension-throughout", 0.1, 0.25, 0.5)
def throughout(case, percent):
    """Evenly, from the beginning of the first take to the end of the last."""

    def change(takes):
        steps = 1.0 + 0.01 * percent * np.linspace(0.0, 1.0, len(takes) + 1)
        for take, begin, end in zip(takes, steps, steps[1:]):
            take.stiffer = (begin, end)

    case.changes.append(change)
    drifting(case, percent)
