"""What somebody records while `play.wav` plays: one file for each take, with whatever is wrong with it."""

from dataclasses import dataclass, field, replace

import numpy as np

import sheet as sheets
import wav

# Samples by which the converters of the bench are late.
LATENCY = 371.3

# Seconds recorded after playing ends.
AFTER = 0.6

# Noise of each channel under its root mean square, in dB.
QUIET = -60.0

# States of the sheet between which what is heard is interpolated, where it changes while it is recorded.
STATES = 12


@dataclass
class Take:
    """One recording, and what is otherwise in it than it should be."""

    file: str
    # Where the probe really is; None where it is not asked for.
    at: object
    seed: int
    # Factor of the sheet's tension (of a plate, its stiffness) at the beginning and at the end.
    stiffer: tuple = (1.0, 1.0)
    probe_late: float = 0.0
    lead: float = None
    # How much faster the recorder's clock runs than the player's, in millionths.
    ppm: float = 0.0
    noise_db: float = QUIET
    # A force on the sheet: place, sample of playing, samples.
    knock: tuple = None
    # What is done to the lines in the end, in order.
    after: list = field(default_factory=list)
    kind: str = "float32"
    rate: float = None
    # Bytes to be written instead of what is recorded.
    raw: bytes = None
    kept: bool = True


class Recorder:
    """The true sheet with its cables, and who records it."""

    def __init__(self, sheet, play, inputs, bend=0.0):
        self.sheet, self.inputs = sheet, inputs
        # A second harmonic of this share, at full scale.
        self.play = (play + 2.0 * bend * play**2) * sheet.limit * sheet.driven()[:, None]
        self.sent = play
        # A sensor's cable leads to the channel of this number.
        self.sensors = list(range(len(play)))
        self.full_scale = 1.0
        # Most seconds by which a take begins before playing.
        self.most = 1.0
        self.memory = {}

    def heard(self, stiffer, knock):
        """What the sheet makes of the drive, kept for the next take where it is the usual."""
        key = (stiffer, knock is None)
        if key in self.memory:
            return self.memory[key]
        sheet = replace(self.sheet, stiffer=self.sheet.stiffer * stiffer)
        samples = self.play.shape[1] + int((AFTER + self.most) * sheet.rate)
        if knock is not None:
            place, start, force = knock
            line = np.zeros(self.play.shape[1])
            line[start : start + len(force)] = force
            knock = place, line
        found = sheets.Heard(sheet, self.play, samples, knock)
        if knock is None and stiffer == 1.0:
            self.memory = {key: found}
        return found

    def lines(self, take):
        """All inputs of a take, `[channel][sample]`."""
        rng = np.random.default_rng(take.seed)
        rate = self.sheet.rate
        lead = take.lead if take.lead is not None else 0.2 * rate + rng.uniform(0.0, 0.2) * rate
        late = lead + LATENCY
        at = self.sheet.points[0] if take.at is None else take.at
        first, last = take.stiffer
        states = np.linspace(first, last, STATES) if first != last else [first]
        found = [self.heard(float(state), take.knock) for state in states]
        slow = late + take.probe_late * rate
        states = [np.vstack([one.sensed(late), one.velocities(at, slow)]) for one in found]
        samples = int(late + self.play.shape[1] + AFTER * rate)
        heard = states[0] if len(states) == 1 else blend(np.array(states), late, self.play.shape[1])
        heard = heard[:, :samples]
        named = dict(zip(self.sheet.names(), heard[:-1][self.sensors]), probe=heard[-1])
        if "reference" in self.inputs:
            named["reference"] = delayed(0.3 * self.reference(), late, samples)
        lines = np.array([named[name] for name in self.inputs])
        if take.ppm or take.rate:
            lines = resampled(lines, (1.0 + 1e-6 * take.ppm) * (take.rate or rate) / rate)
        rms = np.sqrt((lines**2).mean(1, keepdims=True))
        lines = lines + 10 ** (take.noise_db / 20.0) * rms * rng.standard_normal(lines.shape)
        for change in take.after:
            lines = change(lines, rng)
        return lines

    def reference(self):
        return self.sent.sum(0)

    def record(self, folder, takes):
        """Writes the takes that are kept. Integers need a scale common to all: half of full scale for what is loudest."""
        self.most = max([1.0, *(take.lead / self.sheet.rate + 0.1 for take in takes if take.lead)])
        made = {take.file: self.lines(take) for take in takes if take.kept and take.raw is None}
        loudest = max((np.abs(lines[np.isfinite(lines)]).max() for lines in made.values()), default=1.0)
        self.full_scale = 2.0 * loudest
        for take in takes:
            if not take.kept:
                continue
            if take.raw is not None:
                (folder / take.file).write_bytes(take.raw)
                continue
            lines = made[take.file] / (self.full_scale if take.kind.startswith("int") else 1.0)
            wav.write(folder / take.file, lines, take.rate or self.sheet.rate, take.kind)


def blend(states, begin, length):
    """From one state to the next, evenly while it plays."""
    count, _, samples = states.shape
    where = np.clip((np.arange(samples) - begin) / length, 0.0, 1.0) * (count - 1)
    below = np.minimum(where.astype(int), count - 2)
    share = where - below
    index = np.arange(samples)
    return states[below, :, index].T * (1.0 - share) + states[below + 1, :, index].T * share


def delayed(line, late, samples):
    """A line late by a number of samples that need not be whole."""
    size = sheets.good_size(samples + len(line))
    turned = np.exp(-2j * np.pi * np.arange(size // 2 + 1) / size * late)
    return np.fft.irfft(np.fft.rfft(line, size) * turned, size)[:samples]


def resampled(lines, factor):
    """The same sound with `factor` times as many samples a second, by a windowed sinc of 48 samples."""
    samples = int((lines.shape[1] - 1) * factor)
    where = np.arange(samples) / factor
    whole = where.astype(int)
    share = where - whole
    padded = np.pad(lines, ((0, 0), (24, 25)))
    found = np.zeros((len(lines), samples))
    for tap in range(-23, 25):
        away = tap - share
        weight = np.sinc(away) * np.i0(9.0 * np.sqrt(np.maximum(0.0, 1.0 - (away / 24.5) ** 2))) / np.i0(9.0)
        found += weight * padded[:, whole + tap + 24]
    return found
