"""Faults of clocks, converters and amplifiers, and sounds that do not belong."""

import numpy as np

from registry import after, each, fault, first, lose, probed, second


@fault("clock-ppm", 20, 100, 200)
def clock(case, ppm):
    each(case, lambda take: setattr(take, "ppm", ppm))


@fault("clock-ppm-below", 20, 100, 200)
def clock_below(case, ppm):
    each(case, lambda take: setattr(take, "ppm", -ppm))


@fault("clock-ppm-beyond", 300, 1000, 5000)
def clock_beyond(case, ppm):
    each(case, lambda take: setattr(take, "ppm", ppm))


@fault("samples-lost", 48, 480, 4800)
def lost(case, count):
    case.own = True
    after(case, lose(count), second)


@fault("samples-lost-of-actuators", 48, 480, 4800)
def lost_of_actuators(case, count):
    case.own = True
    after(case, lose(count), first)


@fault("latency-jitters", 0.5, 5, 64)
def jitter(case, samples):
    """Between the sweeps, for all channels: each comes later or earlier by up to so many samples at 48 kHz."""

    def wander(lines, rng):
        count = lines.shape[1]
        knots = rng.uniform(-samples, samples, 10) * case.sheet.rate / 48e3
        # Steps, a hundredth of a second long.
        where = np.arange(count) / count * 10.0
        index = np.minimum(where.astype(int), 9)
        late = knots[index]
        width = int(0.01 * case.sheet.rate)
        late = np.convolve(np.pad(late, width, mode="edge"), np.ones(width) / width, "same")[width:-width]
        return interpolated(lines, np.arange(count) - late)

    after(case, wander, probed)


def interpolated(lines, where):
    """Lines at times in samples, by a windowed sinc of 32 samples."""
    whole = np.floor(where).astype(int)
    share = where - whole
    padded = np.pad(lines, ((0, 0), (80, 120)))
    found = np.zeros_like(lines)
    for tap in range(-15, 17):
        away = tap - share
        weight = np.sinc(away) * np.i0(8.0 * np.sqrt(np.maximum(0.0, 1.0 - (away / 16.5) ** 2))) / np.i0(8.0)
        found += weight * padded[:, np.clip(whole + tap + 80, 0, padded.shape[1] - 1)]
    return found


@fault("noise-db", -40, -30, -20)
def noise(case, db):
    each(case, lambda take: setattr(take, "noise_db", db))


@fault("noise-alone", 0, 10, 20)
def noise_alone(case, db):
    """The probe hears that much more noise than sheet."""

    def bury(lines, rng):
        rms = np.sqrt(np.mean(lines[-1] ** 2))
        lines[-1] += 10 ** (db / 20.0) * rms * rng.standard_normal(lines.shape[1])
        return lines

    after(case, bury, second)


def added(case, sound, db):
    """A sound in all channels, so loud beside the root mean square of each."""

    def add(lines, rng):
        line = sound(np.arange(lines.shape[1]) / case.sheet.rate, rng)
        line /= np.sqrt(np.mean(line**2))
        return lines + 10 ** (db / 20.0) * np.sqrt((lines**2).mean(1, keepdims=True)) * line

    after(case, add)


@fault("hum-db", -40, -30, -20)
def hum(case, db):
    def mains(times, rng):
        return sum(np.sin(2.0 * np.pi * 50.0 * n * times + rng.uniform(0, 6.28)) / n for n in (1, 2, 3, 5, 7))

    added(case, mains, db)


@fault("talk-db", -40, -30, -20)
def talk(case, db):
    def voice(times, rng):
        """Syllables of harmonics of 120 Hz."""
        loud = np.clip(np.sin(2.0 * np.pi * 3.1 * times + rng.uniform(0, 6.28)), 0.0, None)
        pitch = 2.0 * np.pi * np.cumsum(120.0 + 15.0 * np.sin(2.0 * np.pi * 0.8 * times)) / case.sheet.rate
        return loud * sum(np.sin(n * pitch + rng.uniform(0, 6.28)) / n for n in range(1, 25))

    added(case, voice, db)


@fault("offset", 0.1, 1, 10)
def offset(case, factor):
    """A constant, in root mean squares of the channel."""
    after(case, lambda lines, _: lines + factor * np.sqrt((lines**2).mean(1, keepdims=True)))


@fault("second-harmonic-percent", 0.3, 1, 3)
def bent(case, percent):
    case.bend = 0.01 * percent


@fault("clipped", 0.9, 0.6, 0.3)
def clipped(case, share):
    """The probe's channel of one take is cut at a share of its peak."""

    def cut(lines, _):
        most = share * np.abs(lines[-1]).max()
        lines[-1] = np.clip(lines[-1], -most, most)
        return lines

    after(case, cut, second)


@fault("begun-before-s", 0.05, 1, 10)
def begun(case, seconds):
    """Every take begins so long before playing, the second twice and the last three times."""

    def change(takes):
        for number, take in enumerate(takes):
            take.lead = (1.0 + number % 3) * seconds * case.sheet.rate + 0.37 * number

    case.changes.append(change)


@fault("silent-channel", 1, 5, 9)
def silent(case, channel):
    def mute(lines, _):
        lines[channel - 1] = 0.0
        return lines

    after(case, mute, second)
