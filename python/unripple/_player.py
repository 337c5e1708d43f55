"""A player whose touches Python pushes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, NoReturn

import numpy as np
import numpy.typing as npt

from unripple import _unripple, _values
from unripple._report import Report
from unripple._surface import Surface
from unripple._typed import Typed
from unripple._virtual import _place

if TYPE_CHECKING:
    from unripple import _types


class Felt(NamedTuple):
    """What a finger felt of the simulated surface.

    Attributes
    ----------
    touch
        Number of the touch, counted from 1 in the order of coming.
    at_m
        Its place in m.
    level_db
        Level in dB above the threshold of touch; None if it felt nothing.
    contrast
        Contrast of what it felt; None if it felt nothing.
    time_s
        Time of the look, in s: it felt this since the look before, 0.2 s earlier.

    Examples
    --------
    >>> import unripple as ur
    >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
    >>> player.felt()
    []
    """

    touch: int
    at_m: tuple[float, float]
    level_db: float | None
    contrast: float | None
    time_s: float


class Player:
    """A surface in play, stepped block by block: touches that are pushed set off effects, whose drives are computed and mixed under the limits.

    Time passes only in :meth:`step`: the same touches at the same times give the same samples. Real devices are played by
    :meth:`Surface.play`. It may be used from several threads, whose calls take turns.

    Parameters
    ----------
    surface
        The surface that is played, and simulated.
    effect
        What a touch triggers: a name of :func:`effects`, or a file.
    method
        Method of focusing.
    window_ms
        Time from a touch to its focus in ms, at most 10000; by default the shortest window that reaches three quarters of the largest
        contrast.
    block
        Samples of a block, 8 to 8192.
    full_limit
        Let a gain of 1 be the surface's drive limit, instead of a level that moves the sheet by about half its thickness.

    Attributes
    ----------
    names : list of str
    rate_hz, window_s, time_s : float
    block : int

    Raises
    ------
    AskError
        Of numbers out of range.
    InputError
        Of an effect or a method that there is not.

    Examples
    --------
    >>> import unripple as ur
    >>> player = ur.Player(ur.Surface("hudin-2012", band_hz=[0, 500]), window_ms=20)
    >>> player.down(0, (62, 90))
    >>> player.step(20).shape
    (8, 1280)
    """

    __slots__ = ("_raw",)

    def __init__(
        self,
        surface: _types.SurfaceLike,
        effect: _types.Path = "click-button",
        *,
        method: _types.Method = "time-reversal",
        window_ms: float | None = None,
        block: int = 64,
        full_limit: bool = False,
    ) -> None:
        played = surface if isinstance(surface, Surface) else Surface(surface)
        with Typed(window_s=("window_ms", window_ms)):
            self._raw = _unripple.Player(
                played._raw,
                _values.path("effect", effect),
                _values.text("method", method).replace("_", "-"),
                None if window_ms is None else _values.milli("window_ms", window_ms),
                _values.count("block", block),
                _values.flag("full_limit", full_limit),
            )

    @property
    def names(self) -> list[str]:
        """Names of the actuators, in the order of the rows."""
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
    def window_s(self) -> float:
        """Time from a touch to its focus, in s."""
        return self._raw.window_s

    @property
    def time_s(self) -> float:
        """Time played, in s: that of the next block's first sample."""
        return self._raw.time_s

    def down(
        self, finger: int, at_mm: _types.Row, time_s: float | None = None, *, force_n: float | None = None
    ) -> None:
        """Put a finger down.

        Parameters
        ----------
        finger
            A number of one's own, which may be used again once the finger has been lifted.
        at_mm
            Place in mm.
        time_s
            When, in s, at :attr:`time_s` or later; by default now. It is noticed at the beginning of the next block from then on.
        force_n
            Force that it presses with in N, 0 to 100; by default unknown.

        Raises
        ------
        AskError
            Of a finger that is down, a place off the surface, a time that has passed, and of too many fingers or touches.

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.down(0, (62, 90), time_s=0.1)
        """
        with Typed(at_m=("at_mm", at_mm)):
            self._raw.down(_values.count("finger", finger), _place("at_mm", at_mm), *_when(time_s, force_n))

    def move(
        self, finger: int, at_mm: _types.Row, time_s: float | None = None, *, force_n: float | None = None
    ) -> None:
        """Move a finger that is down, as :meth:`down` puts it; its times may not decrease.

        Parameters
        ----------
        finger, at_mm, time_s, force_n
            As for :meth:`down`.

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.down(0, (62, 90))
        >>> player.move(0, (64, 90), time_s=0.01)
        """
        with Typed(at_m=("at_mm", at_mm)):
            self._raw.move(_values.count("finger", finger), _place("at_mm", at_mm), *_when(time_s, force_n))

    def up(self, finger: int, time_s: float | None = None) -> None:
        """Lift a finger where it was last.

        Parameters
        ----------
        finger
            Its number.
        time_s
            When, in s; by default now.

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.down(0, (62, 90))
        >>> player.up(0, time_s=0.05)
        """
        self._raw.up(_values.count("finger", finger), _when(time_s, None)[0])

    def step(self, blocks: int = 1) -> npt.NDArray[np.float32]:
        """Play some blocks.

        Parameters
        ----------
        blocks
            Number of blocks.

        Returns
        -------
        numpy.ndarray
            What is sent to the actuators, of shape (actuators, blocks x samples of a block), in their units.

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.step(2).shape
        (8, 128)
        """
        return self._raw.step(_values.count("blocks", blocks))

    def heard(self) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Return what the simulated surface answered to the blocks of the last step.

        Returns
        -------
        sensors : numpy.ndarray
            Signals of the actuators' sensors of shape (actuators, samples), in their units.
        probe : numpy.ndarray
            Velocity in the middle of the surface of shape (samples,), in m/s.

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> _ = player.step(2)
        >>> player.heard()[1].shape
        (128,)
        """
        return self._raw.heard()

    def felt(self) -> list[Felt]:
        """Return what fingers felt at the last of the looks that are made every 0.2 s of played time.

        Returns
        -------
        list of Felt

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.felt()
        []
        """
        return [Felt(*one) for one in self._raw.felt()]

    def report(self) -> Report:
        """Return the report on what was played so far, with the keys of the command `play`.

        ``fingers_down`` counts the fingers that were put down, ``touches`` every :meth:`down`, :meth:`move` and :meth:`up`.

        Returns
        -------
        Report

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.report().touches
        0
        """
        return Report._of(self._raw.done)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a player cannot be pickled: keep its surface and effect, and the touches")

    def __repr__(self) -> str:
        what = f"{len(self.names)} actuators, blocks of {self.block} samples at {self.rate_hz:g} Hz"
        return f"<Player: {what}, {self.time_s:.4g} s played>"


def _when(time_s: float | None, force_n: float | None) -> tuple[float | None, float | None]:
    time = None if time_s is None else _values.number("time_s", time_s)
    return time, None if force_n is None else _values.number("force_n", force_n)
