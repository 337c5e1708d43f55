"""What drives a sheet and listens to it: forces, coils held at a current or a voltage, glued patches; coupled at each frequency."""

from dataclasses import dataclass

import numpy as np

# Modes beside those that are swept, up to so many times the top of the band, give way without swinging: what hangs on a
# sheet rests on them.
STIFF = 12.0


@dataclass(frozen=True)
class Kind:
    """How all actuators of a sheet are made, SI units. `held` is what the amplifier holds: force, current, voltage or moment."""

    held: str = "force"
    force_constant: float = 1.0
    resistance: float = 1.0
    inductance: float = 0.0
    mass: float = 0.0
    radius: float = 0.0
    moment: float = 0.0

    def file(self):
        """Keys of a table of the surface file."""
        if self.held == "force":
            return ""
        if self.held == "moment":
            return f'kind = "piezo"\nradius_mm = {self.radius * 1e3:.6f}\nmoment_n_per_v = {self.moment:.9f}\n'
        text = f'kind = "moving-magnet"\nforce_constant_n_per_a = {self.force_constant:.9f}\ndriven_by = "{self.held}"\n'
        text += f"resistance_ohm = {self.resistance:.9f}\ninductance_mh = {self.inductance * 1e3:.9f}\n"
        return text + f"moving_mass_mg = {self.mass * 1e6:.9f}\n"

    def weights(self, shapes, waves):
        """What a mode does to the actuator, `[mode][actuator]`: its shape there, or the moment along a patch's rim."""
        if self.held != "moment":
            return shapes
        k = np.sqrt((waves**2).sum(1))
        return shapes * (-self.moment * 2.0 * np.pi * self.radius * k * bessel1(k * self.radius))[:, None]

    def impedance(self, w):
        return self.resistance + 1j * w * self.inductance

    def load(self, w):
        """Force against the motion, per velocity."""
        braking = self.force_constant**2 / self.impedance(w) if self.held == "voltage" else 0.0
        return 1j * w * self.mass + braking

    def pull(self, w):
        """Force at rest, per unit of drive."""
        if self.held == "voltage":
            return self.force_constant / self.impedance(w)
        return np.full(len(w), self.force_constant if self.held == "current" else 1.0)

    def sense(self, w):
        """What a sensor says of a velocity: itself, the voltage of the coil, the current that motion alone drives through it."""
        return self.pull(w)


def bessel1(x):
    """J1, by its integral; the trapezium rule of a periodic function is exact beyond so many points."""
    angles = (np.arange(400) + 0.5) * np.pi / 400
    return np.cos(angles - np.outer(x, np.sin(angles))).mean(1)


def forces(kind, weights, omega, sigma, below, w, drives):
    """Forces and velocities `[frequency][actuator]` of drives `[actuator][frequency]`.

    `below` has the compliance of the modes that only give way, and the next term of its series in the frequency squared.
    """
    turn = 1j * w / (omega[:, None] ** 2 - w**2 + 2j * sigma[:, None] * w)
    couplings = np.einsum("ma,mb->mab", weights, weights).reshape(len(omega), -1)
    count = weights.shape[1]
    admittance = (turn.T @ couplings).reshape(len(w), count, count)
    admittance += 1j * w[:, None, None] * (below[0] + w[:, None, None] ** 2 * below[1])
    matrix = np.eye(count) + kind.load(w)[:, None, None] * admittance
    force = np.linalg.solve(matrix, (kind.pull(w) * drives).T[:, :, None])
    return force[:, :, 0], (admittance @ force)[:, :, 0]


def gives_way(sheet, top, at=None):
    """Compliance `[place][actuator]` of the modes between two frequencies, and the next term; places are the actuators' own by default."""
    waves, omega = sheet.waves_between(top, STIFF * sheet.band)
    weights = sheet.kind.weights(sheet.shapes(waves, sheet.places()), waves)
    there = weights if at is None else sheet.shapes(waves, at)
    return [(there.T / omega**power) @ weights for power in (2, 4)]
