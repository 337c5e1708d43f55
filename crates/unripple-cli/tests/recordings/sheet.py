"""Supported rectangles: their file, their modes in closed form, what is heard of a drive, how well a drive focuses."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

import coils

# Modes reach so many times the top of the band: a real sheet does not end there.
ABOVE = 2.0

# Spectra are worked out up to so many times the top of the band; sweeps end a fifth above it.
HEARD = 1.6

# The places of the paper's film, in shares of its sides.
PLACES = np.array([(12, 31), (9, 84), (40, 140), (95, 137), (141, 106), (138, 44), (103, 11), (50, 9)]) / 150.0


@dataclass(frozen=True)
class Sheet:
    """A supported rectangle with point forces, SI units."""

    name: str
    sides: tuple
    young: float
    density: float
    poisson: float
    thickness: float
    tension: float
    decay: float
    band: float
    limit: float
    window: float
    points: tuple
    rate: float = 48e3
    actuators: tuple = ()
    # What the true sheet has otherwise than its file says.
    stiffer: float = 1.0
    gains: tuple = ()
    uneven_decay: float = 0.1
    # Share by which each mode's frequency is off, at random, neighbours mixed: a sheet with ribs, which no even sheet is like.
    ribs: float = 0.0
    kind: coils.Kind = coils.Kind()

    @property
    def mass(self):
        return self.density * self.thickness

    @property
    def bending(self):
        return self.young * self.thickness**3 / 12.0 / (1.0 - self.poisson**2)

    def places(self):
        return np.array(self.actuators or PLACES * np.array(self.sides))

    def names(self):
        return [f"a{i + 1}" for i in range(len(self.places()))]

    def file(self):
        """The surface file."""
        text = f'format = 1\nname = "{self.name}"\n[outline]\n'
        text += f"rectangle_mm = [{self.sides[0] * 1e3:.6f}, {self.sides[1] * 1e3:.6f}]\nedge = \"supported\"\n[sheet]\n"
        text += f"young_gpa = {self.young / 1e9:.9f}\ndensity_kg_m3 = {self.density:.6f}\npoisson_ratio = {self.poisson}\n"
        text += f"thickness_mm = {self.thickness * 1e3:.9f}\n"
        text += f"tension_n_per_m = {self.tension:.9f}\n" if self.tension else ""
        text += f"decay_time_ms = {self.decay * 1e3:.6f}\n[drive]\nband_hz = [0, {self.band:.3f}]\n"
        text += f"sample_rate_hz = {self.rate:.3f}\nlimit = {self.limit}\n"
        for name, (x, y) in zip(self.names(), self.places()):
            text += f'[[actuator]]\nname = "{name}"\nat_mm = [{x * 1e3:.6f}, {y * 1e3:.6f}]\n'
            text += self.kind.file()
        return text

    def frequencies(self, squares):
        """Angular frequencies of wavenumbers squared. `stiffer` is of the tension, or of a plate's bending stiffness."""
        bending = self.bending * (1.0 if self.tension else self.stiffer)
        return np.sqrt(squares * (self.tension * self.stiffer + bending * squares) / self.mass)

    def waves_between(self, low, high):
        """Wavenumbers `[mode][axis]` and angular frequencies of the modes between two frequencies of the sheet as it was."""
        still = replace(self, stiffer=1.0)
        most = wavenumber(replace(still, band=high)) * np.array(self.sides) / np.pi
        counts = [np.arange(1, int(count) + 1) for count in most]
        waves = np.pi * np.stack(np.meshgrid(*(n / side for n, side in zip(counts, self.sides)), indexing="ij"), -1)
        waves = waves.reshape(-1, 2)
        omega = still.frequencies((waves**2).sum(1))
        waves = waves[(omega > 2.0 * np.pi * low) & (omega <= 2.0 * np.pi * high)]
        return waves, self.frequencies((waves**2).sum(1))

    def modes(self):
        """Wavenumbers, angular frequencies and decay rates of all modes, those above the band included."""
        waves, omega = self.waves_between(0.0, ABOVE * self.band)
        # Each mode has a loss of its own, the same whenever it is asked for.
        losses = np.exp(self.uneven_decay * np.random.default_rng(5).standard_normal(len(waves)))
        omega = omega * np.exp(self.ribs * np.random.default_rng(6).standard_normal(len(waves)))
        return waves, omega, losses / self.decay

    def shapes(self, waves, at):
        """Mode shapes `[mode][place]`, of unit modal mass."""
        at = np.atleast_2d(at)
        scale = 2.0 / np.sqrt(self.mass * self.sides[0] * self.sides[1])
        found = scale * np.sin(np.outer(waves[:, 0], at[:, 0])) * np.sin(np.outer(waves[:, 1], at[:, 1]))
        if self.ribs:
            # Each with its neighbour in frequency, by an angle that leaves unit modal masses.
            order = np.argsort((waves**2).sum(1), kind="stable")[: len(waves) // 2 * 2]
            angles = np.random.default_rng(7).uniform(0.0, min(1.0, 20.0 * self.ribs) * np.pi / 2.0, len(order) // 2)
            one, other = found[order[::2]], found[order[1::2]]
            turn, side = np.cos(angles)[:, None], np.sin(angles)[:, None]
            found[order[::2]], found[order[1::2]] = turn * one + side * other, turn * other - side * one
        return found

    def driven(self):
        """Gains of the actuators, 1 where they are as they should be."""
        return np.array(self.gains or np.ones(len(self.places())))


class Heard:
    """What a sheet makes of a drive `[actuator][sample]`, ready to be listened to anywhere."""

    def __init__(self, sheet, drive, samples, knock=None, reach=HEARD):
        self.sheet, self.samples = sheet, samples
        # Long enough that the end of what rings does not come round to the beginning.
        self.size = good_size(samples + int(8.0 * sheet.decay * sheet.rate))
        self.waves, omega, sigma = sheet.modes()
        bins = min(int(reach * sheet.band * self.size / sheet.rate), self.size // 2 + 1)
        self.omegas = 2.0 * np.pi * sheet.rate / self.size * np.arange(bins)
        spectra = np.fft.rfft(drive, self.size)[:, :bins]
        weights = sheet.kind.weights(sheet.shapes(self.waves, sheet.places()), self.waves)
        held = sheet.kind.held in ("force", "moment")
        below = None if held else coils.gives_way(sheet, ABOVE * sheet.band)
        self.motion = np.empty((len(omega), bins), np.complex64)
        self.felt = np.empty((len(weights.T), bins), np.complex128)
        # Forces of coils, once and thrice derived: what gives way under them moves with these.
        self.pressed = None if held else np.empty((2, len(weights.T), bins), np.complex128)
        for first in range(0, bins, 2048):
            part = slice(first, first + 2048)
            w = self.omegas[part]
            force = spectra[:, part]
            if not held:
                force, felt = coils.forces(sheet.kind, weights, omega, sigma, below, w, force)
                force, self.felt[:, part] = force.T, felt.T * sheet.kind.sense(w)
                self.pressed[:, :, part] = 1j * w * force, 1j * w**3 * force
            pushed = weights @ force
            if knock is not None:
                # A force somewhere on the sheet.
                line = np.fft.rfft(knock[1], self.size)[:bins][part]
                pushed = pushed + sheet.shapes(self.waves, knock[0]) * line
            transfer = 1j * w / (omega[:, None] ** 2 - w**2 + 2j * sigma[:, None] * w)
            self.motion[:, part] = transfer * pushed
        if held:
            self.felt = weights.T.astype(np.float32) @ self.motion

    def velocities(self, at, late):
        """Normal velocities `[place][sample]`, late by so many samples, which need not be whole."""
        return self.inverse(self.moved(at), late)

    def moved(self, at):
        """Spectra of the normal velocities `[place][frequency]`: an actuator's own place moves as its sensor hears."""
        found = self.sheet.shapes(self.waves, at).astype(np.float32).T @ self.motion
        if self.pressed is None:
            return found
        return found + sum(map(np.matmul, coils.gives_way(self.sheet, ABOVE * self.sheet.band, at), self.pressed))

    def sensed(self, late):
        """What actuators hear, `[actuator][sample]`."""
        return self.inverse(self.felt, late)

    def inverse(self, spectra, late):
        turned = np.exp(-1j * late / self.sheet.rate * self.omegas)
        return np.fft.irfft(spectra * turned, self.size)[:, : self.samples]


def good_size(samples):
    """The next product of a power of 2 and 1, 3, 5, 9 or 15."""
    sizes = [factor << power for factor in (1, 3, 5, 9, 15) for power in range(8, 26)]
    return min(size for size in sizes if size >= samples)


def impulse(sheet, times):
    """Velocity of each mode after a unit impulse, `[mode][time]`."""
    _, omega, sigma = sheet.modes()
    damped = np.sqrt(omega**2 - sigma**2)[:, None]
    turn = damped * times
    return np.exp(-sigma[:, None] * times) * (np.cos(turn) - sigma[:, None] / damped * np.sin(turn))


def state_at_last(sheet, drive):
    """The end of the window: a function from places to normal velocities."""
    last = round(sheet.window * sheet.rate)
    played = np.zeros((len(drive), last + 1))
    played[:, : min(last + 1, drive.shape[1])] = drive[:, : last + 1]
    played *= sheet.driven()[:, None]
    waves, _, _ = sheet.modes()
    if sheet.kind.held in ("current", "voltage"):
        heard = Heard(sheet, played, last + 1, reach=ABOVE)
        modes = heard.inverse(heard.motion, 0.0)[:, last]
        pressed = [heard.inverse(lines, 0.0)[:, last] for lines in heard.pressed]
        below = partial(coils.gives_way, sheet, ABOVE * sheet.band)
        return lambda at: modes @ sheet.shapes(waves, at) + sum(map(np.matmul, below(at), pressed))
    weights = sheet.kind.weights(sheet.shapes(waves, sheet.places()), waves)
    response = impulse(sheet, (last - np.arange(last + 1)) / sheet.rate)
    modes = np.einsum("ma,as,ms->m", weights, played, response, optimize=True) / sheet.rate
    return lambda at: modes @ sheet.shapes(waves, at)


def contrast(sheet, drive, target):
    """Velocity at the target over the root mean square outside its disc, both at the end of the window.

    The drive is `[actuator][sample]`. Disc and grid are those of the program's own definition of the contrast.
    """
    state = state_at_last(sheet, drive)
    shortest = 2.0 * np.pi / wavenumber(replace(sheet, stiffer=1.0))
    counts = [int(np.ceil(8.0 * side / shortest)) for side in sheet.sides]
    centres = [(np.arange(count) + 0.5) * side / count for count, side in zip(counts, sheet.sides)]
    grid = np.stack(np.meshgrid(*centres, indexing="ij"), -1).reshape(-1, 2)
    outside = grid[np.hypot(*(grid - target).T) > 4.0 / 3.0 * shortest]
    return float(state(target)[0]) / float(np.sqrt(np.mean(state(outside) ** 2)))


def wavenumber(sheet):
    """At the top of the band."""
    square = (2.0 * np.pi * sheet.band) ** 2 * sheet.mass
    if sheet.bending == 0.0:
        return np.sqrt(square / sheet.tension)
    root = np.sqrt(sheet.tension**2 + 4.0 * sheet.bending * square)
    return np.sqrt((root - sheet.tension) / (2.0 * sheet.bending))


def swept(sheet, hertz):
    """The band that sweeps reach: it fades out in the fifth above the top."""
    return np.cos(np.pi / 2.0 * np.clip((hertz / sheet.band - 1.0) / 0.2, 0.0, 1.0)) ** 2


def reversal(sheet, target):
    """The drive of time reversal by the true responses, in the band that sweeps reach."""
    last = round(sheet.window * sheet.rate)
    if sheet.kind.held in ("current", "voltage"):
        lines = []
        for line in np.eye(len(sheet.places())):
            one = Heard(sheet, np.outer(line, np.eye(1, last + 1)[0]), last + 1, reach=ABOVE)
            lines.append(one.inverse(one.moved(target) * swept(sheet, one.omegas / (2.0 * np.pi)), 0.0)[0])
        return np.array(lines)[:, ::-1]
    waves, omega, _ = sheet.modes()
    shapes = sheet.shapes(waves, target)[:, 0]
    response = impulse(sheet, (last - np.arange(last + 1)) / sheet.rate)
    heard = shapes * swept(sheet, omega / (2.0 * np.pi))
    weights = sheet.kind.weights(sheet.shapes(waves, sheet.places()), waves)
    return np.einsum("ma,m,ms->as", weights, heard, response, optimize=True)


def mm(*places):
    return tuple((x / 1e3, y / 1e3) for x, y in places)


SHEETS = {
    "film": Sheet("film", (0.15, 0.15), 4e9, 1400.0, 0.3, 0.125e-3, 200.0, 0.05, 1500.0, 1.0, 0.03,
                  mm((62, 90), (100, 60), (45, 50))),
    "glass": Sheet("glass", (0.2, 0.15), 70e9, 2500.0, 0.22, 0.7e-3, 0.0, 0.02, 6000.0, 5.0, 0.02,
                   mm((80, 90), (130, 60), (62, 48))),
    "panel": Sheet("panel", (0.4, 0.3), 70e9, 2700.0, 0.33, 1e-3, 0.0, 0.12, 2500.0, 5.0, 0.04,
                   mm((165, 180), (265, 120), (120, 100))),
    # The film in a narrower band and at a lower rate, for tests that are to be quick.
    "small": Sheet("small", (0.15, 0.15), 4e9, 1400.0, 0.3, 0.125e-3, 200.0, 0.05, 800.0, 1.0, 0.03,
                   mm((62, 90), (100, 60), (45, 50)), rate=12e3),
}
