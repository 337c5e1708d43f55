"""Faults of cables, coils and of where the probe is."""

from dataclasses import replace

import numpy as np

import coils
import sheet as sheets
from registry import after, each, fault, probed, turned


@fault("clean", 0)
def clean(case, _):
    case.of_truth = True


@fault("probe-swapped-with-sensor", 1, 4, 8)
def probe_swapped(case, sensor):
    def swap(lines, _):
        lines[[sensor - 1, -1]] = lines[[-1, sensor - 1]]
        return lines

    after(case, swap)


@fault("sensor-reversed", 1, 4, 8)
def sensor_reversed(case, sensor):
    case.own = True

    def turn(lines, _):
        lines[sensor - 1] *= -1.0
        return lines

    after(case, turn)


@fault("sensors-swapped", 2, 5, 8)
def sensors_swapped(case, sensor):
    case.own = True

    def swap(recorder):
        one, other = sensor - 1, sensor - 2
        recorder.sensors[one], recorder.sensors[other] = other, one

    case.cables.append(swap)


@fault("reference-of-one-output", 1, 4, 8)
def reference_of_one(case, output):
    case.inputs = [*case.sheet.names(), "probe", "reference"]
    case.cables.append(lambda recorder: setattr(recorder, "reference", lambda: recorder.sent[output - 1]))


@fault("reference-of-all-outputs", 0)
def reference_of_all(case, _):
    case.inputs = [*case.sheet.names(), "probe", "reference"]


@fault("dead-actuators", 1, 2, 4)
def dead(case, count):
    die(case, count)


@fault("dead-and-any-wiring", 1, 2, 4)
def dead_and_on(case, count):
    die(case, count)
    case.later.append("--any-wiring")


@fault("dead-and-without", 1, 2, 4)
def dead_and_without(case, count):
    for actuator in die(case, count):
        case.later += ["--without", f"a{actuator + 1}"]


@fault("dead-output", 1, 4, 8)
def dead_output(case, actuator):
    """It is not driven, but hears the others."""
    case.truth = replace(case.truth, gains=tuple(0.0 if i == actuator - 1 else 1.0 for i in range(8)))
    held_against_others(case, [actuator - 1])


def die(case, count):
    """Coils that neither drive nor hear, held against a clean sheet without them."""
    gone = [4, 1, 6, 3][:count]
    case.truth = replace(case.truth, gains=tuple(0.0 if i in gone else 1.0 for i in range(8)))
    held_against_others(case, gone)

    def hush(lines, rng):
        lines[gone] = 1e-6 * np.abs(lines).max() * rng.standard_normal((len(gone), lines.shape[1]))
        return lines

    after(case, hush)
    return gone


def held_against_others(case, gone):
    left = [tuple(at) for i, at in enumerate(case.sheet.places().tolist()) if i not in gone]
    case.against = replace(case.sheet, actuators=tuple(left))
    # Responses of fewer actuators have another level.
    case.level = False


@fault("probe-off-mm", 1, 3, 10)
def probe_off(case, distance):
    """On the film; on other sheets as much of their shortest wave."""
    step = np.array([0.6, 0.8]) * distance * 1e-3 * wave(case.sheet) / wave(sheets.SHEETS["film"])
    each(case, lambda take: setattr(take, "at", (np.array(take.at) + step).tolist()), probed)


def wave(sheet):
    return 2.0 * np.pi / sheets.wavenumber(replace(sheet, stiffer=1.0))


@fault("gain-of-one-take", 0.7, 1.43, 3.0)
def gain(case, factor):
    case.changes.append(turned(factor))


@fault("sign-of-one-take", 1, 0.7, 1.43)
def sign(case, factor):
    case.changes.append(turned(-factor))


@fault("probe-delay-ms", 0.1, 0.5, 1.0)
def probe_delay(case, delay):
    each(case, lambda take: setattr(take, "probe_late", delay * 1e-3))


@fault("probe-delay-ms-told", 0.1, 0.5, 1.0)
def probe_delay_told(case, delay):
    probe_delay(case, delay)
    case.later += ["--probe-delay-ms", str(delay)]


# Coils of the paper's resistance, with a force constant that a magnet which a film carries can have.
COIL = coils.Kind("current", 0.6, 6.2)


@fault("coils-held-at-current-mg", 0, 7, 30)
def coils_current(case, mass):
    made_of(case, replace(COIL, mass=mass * 1e-6))


@fault("coils-held-at-voltage-mh", 0, 0.5, 1.9)
def coils_voltage(case, inductance):
    made_of(case, replace(COIL, held="voltage", inductance=inductance * 1e-3, mass=7e-6))


@fault("patches-mm", 4, 6, 8)
def patches(case, radius):
    made_of(case, coils.Kind("moment", radius=radius * 1e-3, moment=0.01))
    # What a patch hears is no velocity, so that nothing is to be focused there.
    case.own = False


def made_of(case, kind):
    """All actuators are of a kind. The contrast is held against that of the true responses."""
    case.sheet = case.truth = replace(case.sheet, kind=kind)
    case.of_truth = True
    case.own = True
