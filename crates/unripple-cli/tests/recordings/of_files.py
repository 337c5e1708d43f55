"""Faults of files: exchanged, copied, missing, of another kind, rate or scale."""

from dataclasses import replace

import numpy as np

from registry import after, each, exchange, fault, first, lose, probed, second


@fault("takes-exchanged", 1, 2, 3)
def exchanged(case, kind):
    """Two exchanged; three in a circle; one recorded with the probe left where it was."""
    case.changes.append(exchange(kind))


@fault("take-copied", 1, 2, 3)
def copied(case, count):
    """A file in place of so many others; by 3 that of the actuators in place of a point's."""

    def change(takes):
        ones = probed(takes)
        source = takes[0] if count == 3 else ones[0]
        for one in ones[1 : 2 if count == 3 else 1 + count]:
            one.at, one.seed, one.lead = source.at, source.seed, source.lead

    case.changes.append(change)


@fault("take-missing", 1, 2, 3)
def missing(case, count):
    """So many points' takes; by 3 the last, and that of the actuators is there."""

    def change(takes):
        for take in probed(takes)[: count if count < 3 else 0] + (probed(takes)[-1:] if count == 3 else []):
            take.kept = False

    case.changes.append(change)
    case.absent = [0] if count == 1 else [0, 1] if count == 2 else [2]


@fault("actuators-missing", 0)
def actuators_missing(case, _):
    each(case, lambda take: setattr(take, "kept", False), first)
    case.absent = [0, 1, 2]


@fault("take-surplus", 1, 2, 3)
def surplus(case, kind):
    """A file that the plan does not know: of another point, of a second repeat, of a name mistyped."""
    name = {1: "point-009.wav", 2: "point-001-2.wav", 3: "point-1.wav"}[kind]

    def change(takes):
        takes.append(replace(probed(takes)[0], file=name, seed=999, after=[]))

    case.changes.append(change)


@fault("integers", 16, 24, 32)
def integers(case, bits):
    """What full scale is, is not said."""
    each(case, lambda take: setattr(take, "kind", f"int{bits}"))


@fault("integers-with-scale", 16, 24, 32)
def integers_with_scale(case, bits):
    each(case, lambda take: setattr(take, "kind", f"int{bits}"))
    case.later.append(lambda recorder: ["--input-scale", f"{recorder.full_scale:.9g}", "--output-scale", f"{case.sheet.limit}"])


@fault("eight-bits", 8)
def eight_bits(case, _):
    each(case, lambda take: setattr(take, "kind", "int8"))


@fault("float64", 0)
def float64(case, _):
    each(case, lambda take: setattr(take, "kind", "float64"))


@fault("other-rate", 44_100, 96_000, 47_952)
def other_rate(case, rate):
    """Where the sheet's is 48 kHz; of others as much more or less."""
    each(case, lambda take: setattr(take, "rate", round(rate / 48e3 * case.sheet.rate)))


@fault("other-rate-resampled", 44_100, 96_000, 47_952)
def other_rate_resampled(case, rate):
    other_rate(case, rate)
    case.later.append("--resample")


@fault("not-a-number", 1, 5, 9)
def not_a_number(case, channel):
    def spoil(lines, _):
        middle = lines.shape[1] // 2
        lines[channel - 1, middle : middle + 10] = np.nan
        return lines

    after(case, spoil, second)


@fault("garbage", 1, 2, 3)
def garbage(case, kind):
    """Nothing, a text, half a file."""
    raw = {1: b"", 2: b"not a recording\n" * 40, 3: b"RIFF\x24\0\0\0WAVEfmt \x10\0\0\0"}[kind]
    each(case, lambda take: setattr(take, "raw", raw), second)


@fault("ended-early-s", 0.5, 1, 3)
def short(case, seconds):
    after(case, lambda lines, _: lines[:, : -int((seconds + 0.6) * case.sheet.rate)], second)


@fault("begun-late-s", 0.1, 0.5, 2)
def late(case, seconds):
    def change(takes):
        for take in second(takes):
            take.lead = 0.0
            take.after.append(lambda lines, _: lines[:, int((seconds + 0.01) * case.sheet.rate) :])

    case.changes.append(change)


@fault("second-repeat-bad", 1, 2, 3)
def second_repeat(case, kind):
    """Of the first point: noise, samples lost, clipping."""
    case.options += ["--repeats", "2"]

    def spoil(lines, rng):
        rms = np.sqrt(np.mean(lines[-1] ** 2))
        if kind == 1:
            lines[-1] += 3.0 * rms * rng.standard_normal(lines.shape[1])
        elif kind == 2:
            lines = lose(960)(lines, rng)
        else:
            lines[-1] = np.clip(lines[-1], -rms, rms)
        return lines

    after(case, spoil, lambda takes: [take for take in takes if take.file == "point-001-2.wav"])


@fault("other-folder", 1, 2, 3)
def other_folder(case, kind):
    """Takes of another calibration: of other sweeps, longer or shorter, or of white noise."""

    def change(lines, rng):
        if kind == 1:
            return lines[:, ::-1].copy()
        if kind == 2:
            return np.roll(lines, 3, 0)
        return rng.standard_normal(lines.shape) * np.abs(lines).max() * 0.2

    after(case, change, second)


@fault("response-ms", 200, 300, 350)
def response_ms(case, kept):
    case.options += ["--response-ms", str(kept)]
