"""A simulated surface that is stepped block by block."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
import numpy.typing as npt

from unripple import _unripple, _values
from unripple._drive import Drive, floats, refuse_other
from unripple._errors import OptionError
from unripple._motion import FingerMotion
from unripple._surface import Surface
from unripple._typed import Typed

if TYPE_CHECKING:
    from unripple import _types

#: What a fingertip is made of, in the order of the library: names as in a surface file, and what they are divided by to be in SI units.
_CONTACT = {
    "mass_g": 1e3,
    "damping_n_s_per_m": 1.0,
    "stiffness_n_per_mm": 1e-3,
    "contact_radius_mm": 1e3,
}


class VirtualSurface:
    """A simulated surface, stepped block by block: drive in, signals of the actuators' sensors and of a velocity probe out.

    Time passes only in :meth:`exchange`. It may be used from several threads, whose calls take turns.

    Parameters
    ----------
    surface
        The surface that is simulated.
    block
        Samples of a block, 1 to 1000000.
    max_hz
        Highest frequency of the modes in Hz; by default the top of the band, or 1.5 times that where coils or masses load the sheet.
    unknowns
        Seed by which the simulated surface differs at random from `surface`, in noise, gains, places, tension, damping and stray masses; by
        default it does not differ.
    probe_mm
        Place of the probe in mm; by default the middle of the bounding box.
    fingers
        How many fingers there may be at once, 0 to 64; 4 by default.

    Attributes
    ----------
    names : list of str
    rate_hz, time_s : float
    block, samples : int

    Raises
    ------
    AskError
        Of numbers out of range.

    Examples
    --------
    >>> import numpy as np
    >>> import unripple as ur
    >>> virtual = ur.VirtualSurface(ur.Surface("hudin-2012", band_hz=[0, 500]), block=64)
    >>> virtual.tap((62, 90), newtons=1, seconds=1e-3)
    >>> sensors, probe = virtual.exchange(np.zeros((8, 128), np.float32))
    >>> sensors.shape, probe.shape
    ((8, 128), (128,))
    """

    __slots__ = ("_raw", "_surface")

    def __init__(
        self,
        surface: _types.SurfaceLike,
        block: int = 64,
        *,
        max_hz: float | None = None,
        unknowns: int | None = None,
        probe_mm: _types.Row | None = None,
        fingers: int | None = None,
    ) -> None:
        self._surface = surface if isinstance(surface, Surface) else Surface(surface)
        with Typed(probe_m=("probe_mm", probe_mm), seed=("unknowns", unknowns)):
            self._raw = _unripple.VirtualSurface(
                self._surface._raw,
                _values.count("block", block),
                max_hz=None if max_hz is None else _values.number("max_hz", max_hz),
                seed=None if unknowns is None else _values.count("unknowns", unknowns),
                probe_m=None if probe_mm is None else _place("probe_mm", probe_mm),
                fingers=None if fingers is None else _values.count("fingers", fingers),
            )

    @property
    def names(self) -> list[str]:
        """Names of the actuators, in the order of a drive's rows."""
        return self._raw.names

    @property
    def rate_hz(self) -> float:
        """Sample rate in Hz."""
        return self._raw.rate_hz

    @property
    def block(self) -> int:
        """Samples of a block."""
        return self._raw.block

    @property
    def samples(self) -> int:
        """Samples that have passed since the surface was made or last at rest."""
        return self._raw.samples

    @property
    def time_s(self) -> float:
        """Time that has passed since then, in s."""
        return self._raw.time_s

    def exchange(self, drive: npt.ArrayLike | Drive) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Play a drive, and return what is recorded meanwhile.

        Parameters
        ----------
        drive
            Samples of shape (actuators, n) in the actuators' units, n a multiple of the block; it is played as it is, also beyond the
            surface's limit. float32 in C order is taken without conversion. A :class:`Drive` is followed by silence to whole blocks.

        Returns
        -------
        sensors : numpy.ndarray
            Signals of the actuators' sensors of shape (actuators, n), in their units.
        probe : numpy.ndarray
            Velocity at the probe of shape (n,), in m/s.

        Raises
        ------
        AskError
            Of a drive of another shape, or with samples that are not finite.

        Examples
        --------
        >>> import numpy as np
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual(block=64)
        >>> drive = np.zeros((8, 64), np.float32)
        >>> drive[0, 0] = 1
        >>> sensors, probe = virtual.exchange(drive)
        >>> bool(np.abs(sensors).max() > 0)
        True
        """
        if isinstance(drive, Drive):
            refuse_other(drive, self.rate_hz, self.names)
            drive = np.pad(drive.samples, ((0, 0), (0, -drive.samples.shape[1] % self.block)))
        elif getattr(drive, "dtype", None) not in (np.float32, np.float64):
            drive = floats("drive", drive, "actuators", "samples")
        return self._raw.exchange(drive)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a simulated surface cannot be pickled: keep its surface, and what was done to it")

    def touch(self, finger: int, at_mm: _types.Row, contact: Mapping[str, float] | None = None) -> None:
        """Put a finger down, whose load comes within 8 ms from the next block on.

        Parameters
        ----------
        finger
            A number of one's own.
        at_mm
            Place in mm.
        contact
            What it is like, with keys as in a surface file's ``[finger]``: ``mass_g``, ``damping_n_s_per_m``, ``stiffness_n_per_mm``,
            ``contact_radius_mm``; by default, and where it says nothing, as the surface file has it.

        Raises
        ------
        AskError
            Of a place off the surface.
        InputError
            Of a finger that is down, and of too many.

        Examples
        --------
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual()
        >>> virtual.touch(0, (62, 90), {"mass_g": 0.3})
        >>> virtual.lift(0)
        """
        like = None if contact is None else _contact(contact, self._surface)
        with Typed(at_m=("at_mm", at_mm), id=("finger", finger)):
            self._raw.touch(_values.count("finger", finger), _place("at_mm", at_mm), like)

    def move(self, finger: int, at_mm: _types.Row) -> None:
        """Move a finger that is down, whose load is at the new place within 5 ms.

        Parameters
        ----------
        finger
            Its number.
        at_mm
            Place in mm.

        Examples
        --------
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual()
        >>> virtual.touch(0, (62, 90))
        >>> virtual.move(0, (64, 90))
        """
        with Typed(at_m=("at_mm", at_mm), id=("finger", finger)):
            self._raw.move(_values.count("finger", finger), _place("at_mm", at_mm))

    def lift(self, finger: int) -> None:
        """Lift a finger, whose load goes within 8 ms; its number is free at once.

        Parameters
        ----------
        finger
            Its number.

        Examples
        --------
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual()
        >>> virtual.touch(0, (62, 90))
        >>> virtual.lift(0)
        """
        self._raw.lift(_values.count("finger", finger))

    def finger_motion(self, finger: int) -> FingerMotion | None:
        """Return the motion of a finger after the last block; None if it is not down.

        Parameters
        ----------
        finger
            Its number.

        Returns
        -------
        FingerMotion or None

        Examples
        --------
        >>> import numpy as np
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual(block=64)
        >>> virtual.touch(0, (62, 90))
        >>> _ = virtual.exchange(np.zeros((8, 640), np.float32))
        >>> virtual.finger_motion(0).grip
        1.0
        """
        motion = self._raw.finger_motion(_values.count("finger", finger))
        return None if motion is None else FingerMotion(*motion)

    def probe(self, at_mm: _types.Row) -> None:
        """Put the probe at a place, from the next block on.

        Parameters
        ----------
        at_mm
            Place in mm.

        Examples
        --------
        >>> import unripple as ur
        >>> ur.Surface("hudin-2012", band_hz=[0, 500]).virtual().probe((62, 90))
        """
        with Typed(at_m=("at_mm", at_mm)):
            self._raw.probe(_place("at_mm", at_mm))

    def tap(self, at_mm: _types.Row, newtons: float, seconds: float, after_s: float = 0.0) -> None:
        """Tap at a place with half a sine of force.

        Parameters
        ----------
        at_mm
            Place in mm.
        newtons, seconds
            Peak of the force in N, and how long it lasts in s, at most 1.
        after_s
            When it begins, in s after the start of the next block.

        Raises
        ------
        InputError
            Of a second tap in a block.

        Examples
        --------
        >>> import unripple as ur
        >>> ur.Surface("hudin-2012", band_hz=[0, 500]).virtual().tap((62, 90), newtons=1, seconds=1e-3)
        """
        force, length = _values.number("newtons", newtons), _values.number("seconds", seconds)
        with Typed(at_m=("at_mm", at_mm)):
            self._raw.tap(_place("at_mm", at_mm), force, length, _values.number("after_s", after_s))

    def watch(self, points_mm: _types.Places, stride: int = 1) -> None:
        """Watch the displacement at some places, in place of those before: see :meth:`watched`.

        Parameters
        ----------
        points_mm
            Places in mm, at most 4096.
        stride
            Distance of the samples that are kept.

        Examples
        --------
        >>> import unripple as ur
        >>> ur.Surface("hudin-2012", band_hz=[0, 500]).virtual().watch([(62, 90), (40, 50)])
        """
        points = np.array(_values.places("points_mm", points_mm), dtype=np.float64).reshape(-1, 2)
        with Typed(points_m=("points_mm", points_mm)):
            self._raw.watch(points, _values.count("stride", stride))

    def watched(self) -> npt.NDArray[np.float32]:
        """Return the displacement at the watched places since this was last called.

        Returns
        -------
        numpy.ndarray
            In m, of shape (places, samples): of each place the newest 65536 samples at most. It has no noise.

        Examples
        --------
        >>> import numpy as np
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual(block=64)
        >>> virtual.watch([(62, 90)])
        >>> _ = virtual.exchange(np.zeros((8, 64), np.float32))
        >>> virtual.watched().shape
        (1, 64)
        """
        return self._raw.watched()

    def rest(self, seed: int | None = None) -> None:
        """Put the surface at rest as it was made, at time 0, without taps, fingers and watched places.

        Parameters
        ----------
        seed
            Of the noise of a surface with unknowns; by default the same again.

        Examples
        --------
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual()
        >>> virtual.rest()
        >>> virtual.time_s
        0.0
        """
        self._raw.rest(None if seed is None else _values.count("seed", seed))

    def __repr__(self) -> str:
        what = f"{len(self.names)} actuators, blocks of {self.block} samples at {self.rate_hz:g} Hz"
        return f"<VirtualSurface: {what}, {self.time_s:.4g} s have passed>"


def _place(name: str, at_mm: Any) -> tuple[float, float]:
    x, y = _values.place(name, at_mm)
    return x, y


def _contact(like: Mapping[str, float], surface: Surface) -> tuple[float, float, float, float]:
    """Return what a finger is like, in SI units and the library's order; what is not said is as the surface file has it."""
    if not isinstance(like, Mapping):
        raise OptionError(f"contact: expected a mapping, found {_values.shown(like)}")
    for name in like:
        if name not in _CONTACT:
            raise OptionError(f"contact: expected {', '.join(_CONTACT)}, found {name}")
    said = {**tomllib.loads(surface.toml)["finger"], **like}
    mass, damping, stiffness, radius = (
        _values.number(name, said[name]) / by for name, by in _CONTACT.items()
    )
    return mass, damping, stiffness, radius
