"""Surfaces: what a surface file describes."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from unripple import _call, _keys, _options, _unripple, _values
from unripple._errors import SurfaceError
from unripple._focusing import Focusing
from unripple._report import Report
from unripple._reporting import Reporting
from unripple._verifying import Verifying

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _types
    from unripple._drive import Drive
    from unripple._player import Player
    from unripple._responses import Responses
    from unripple._view import View
    from unripple._virtual import VirtualSurface

#: What a surface made from keywords is called in messages, and in reports if it is given no name.
UNNAMED = "surface"


class Surface(Reporting, Verifying, Focusing):
    """A surface: the sheet, its edge, the actuators, and the limits of their drive. Immutable.

    Parameters
    ----------
    source
        Name of a built-in surface (see :func:`builtin`), path of a surface file, or the text of one.
    **keys
        Keys of a surface file, in its own units: in place of a file, or changes to `source`. A key may stand alone
        (``tension_n_per_m=220``), within its table (``sheet={"tension_n_per_m": 220}``), or be a path
        (``**{"actuator[0].at_mm": [12, 31]}``). ``actuators``, ``holes``, ``scatterers``, ``lattices`` and ``layers`` are lists of
        tables; an actuator that is a force may be a place alone. None removes a key. ``docs/surface-file.md`` has all keys.

    Attributes
    ----------
    name : str
    toml : str
    names : list of str
    units : list of str
    actuators_m : numpy.ndarray
    band_hz : tuple of float
    rate_hz : float
    limit : float
    extent_m : tuple of float
    outline_m : list of numpy.ndarray

    Raises
    ------
    SurfaceError
        With all faults, each with its key, line, column and the nearest legal value.
    OptionError
        Of a keyword that is no key.

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012")
    >>> film.rate_hz, len(film.names)
    (48000.0, 8)
    >>> plate = ur.Surface(rectangle_mm=[120, 80], material="glass", thickness_mm=0.5, loss_factor=0.01,
    ...                    band_hz=[0, 9000], actuators=[(12, 31), (90, 64)])
    >>> plate.actuators_m.shape
    (2, 2)
    """

    __slots__ = ("__weakref__", "_ask", "_raw", "_responses")

    _raw: _unripple.Surface
    _ask: str | dict[str, Any] | None
    # What the library computed: responses as Python has them know the surface, and the two would keep each other alive.
    _responses: _unripple.Responses | None

    def __init__(self, source: str | os.PathLike[str] | None = None, /, **keys: object) -> None:
        if source is None:
            raw = _of_keys(keys)
        elif isinstance(source, str) and is_text(source):
            text = _keys.changed(source, keys) if keys else source
            raw = _of_text(text, UNNAMED)
        else:
            name = _values.path("source", source)
            raw = _unripple.Surface(json.dumps({"name": name, "set": _keys.settings(keys)} if keys else name))
        self._take(raw)

    @classmethod
    def _of(cls, raw: _unripple.Surface) -> Surface:
        """Make a surface of one that the library has made."""
        surface = cls.__new__(cls)
        surface._take(raw)
        return surface

    def _take(self, raw: _unripple.Surface) -> None:
        self._raw, self._ask, self._responses = raw, None, None

    @property
    def name(self) -> str:
        """Name of the surface, from its file."""
        return self._raw.name

    @property
    def toml(self) -> str:
        """Text of a surface file that describes the surface completely, without other files."""
        return self._raw.toml

    @property
    def names(self) -> list[str]:
        """Names of the actuators, in the order of the channels."""
        return self._raw.names

    @property
    def units(self) -> list[str]:
        """Unit of each actuator's drive: N, A or V."""
        return self._raw.units

    @property
    def actuators_m(self) -> npt.NDArray[np.float64]:
        """Places of the actuators in m, of shape (actuators, 2); read-only."""
        return _sealed(self._raw.actuators_m)

    @property
    def band_hz(self) -> tuple[float, float]:
        """Lowest and highest frequency of the drive, in Hz."""
        return self._raw.band_hz

    @property
    def rate_hz(self) -> float:
        """Sample rate of drives, in Hz."""
        return self._raw.rate_hz

    @property
    def limit(self) -> float:
        """Largest drive of each actuator, in its unit."""
        return self._raw.limit

    @property
    def extent_m(self) -> tuple[float, float]:
        """Width and height of the outline's bounding box, in m."""
        return self._raw.extent_m

    @property
    def outline_m(self) -> list[npt.NDArray[np.float64]]:
        """The outer boundary, then the holes, as closed polygons for drawing, in m, each of shape (corners, 2); read-only."""
        return [_sealed(rim) for rim in self._raw.outline_m]

    def with_(self, **keys: object) -> Surface:
        """Return another surface that differs in some keys.

        Parameters
        ----------
        **keys
            As for :class:`Surface`; lists such as ``actuators`` are replaced as a whole. None removes a key, so that one that excludes it
            can be given: ``rectangle_mm=None, circle_mm=70``.

        Returns
        -------
        Surface

        Raises
        ------
        SurfaceError
            With all faults.

        Examples
        --------
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012")
        >>> tighter = film.with_(tension_n_per_m=220)
        >>> tighter == film, tighter.with_(tension_n_per_m=200) == film
        (False, True)
        """
        return Surface._of(_of_text(_keys.changed(self.toml, keys), self.name))

    def __eq__(self, other: object) -> bool:
        return self.toml == other.toml if isinstance(other, Surface) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> tuple[type[Surface], tuple[str]]:
        return Surface, (self.toml,)

    def __repr__(self) -> str:
        width, height = (1e3 * side for side in self.extent_m)
        low, high = self.band_hz
        size, band = f"{width:g} x {height:g} mm", f"{low:g} to {high:g} Hz"
        return f"<Surface {self.name!r}: {size}, {len(self.names)} actuators, {band}>"

    def _repr_html_(self) -> str:
        from unripple import _html

        return _html.surface(self)

    def _repr_png_(self) -> bytes:
        from unripple import _html, _png

        return _png.of_svg(_html.drawing(self))

    def as_ask(self) -> str | dict[str, Any]:
        """Return the surface as asks of tasks name it.

        Returns
        -------
        str or dict
            The name of a built-in surface; for any other ``{"toml": …, "name": …}``.

        Examples
        --------
        >>> import unripple as ur
        >>> ur.Surface("hudin-2012").as_ask()
        'hudin-2012'
        """
        ask: Any = self._ask
        if ask is None:
            ask = self._ask = json.loads(self._raw.ask)
        return ask if isinstance(ask, str) else dict(ask)

    def _report(self, command: str, options: Mapping[str, Any]) -> Report:
        return _call.report(command, options, surface=self)

    def _chosen(self, options: dict[str, Any]) -> Surface:
        changed = options.pop("set", None)
        return self if changed is None else self.with_(**_keys.read_all(changed))

    def _extent(self) -> tuple[float, float]:
        return self.extent_m

    def responses(
        self,
        max_hz: float | None = None,
        fingers_mm: _types.Places = (),
        **options: Unpack[_types.CallOptions],
    ) -> Responses:
        """Compute the impulse responses of the surface, as a sum of modes.

        Parameters
        ----------
        max_hz
            Highest frequency of the modes in Hz; by default the top of the band.
        fingers_mm
            Places in mm where fingers rest on the surface.

        Returns
        -------
        Responses

        Examples
        --------
        >>> import unripple as ur
        >>> responses = ur.Surface("hudin-2012", band_hz=[0, 500]).responses()
        >>> responses.kind, len(responses.names)
        ('modal', 8)
        """
        from unripple._responses import Responses

        for name in options:
            if name not in _options.OF_CALLS:
                raise _options.unknown("responses", name, ["max_hz", "fingers_mm", *_options.OF_CALLS])
        fingers_m = _values.places("fingers_mm", fingers_mm)
        plain = max_hz is None and not fingers_m
        if plain and self._responses is not None:
            return Responses._of_known(self, self._responses)
        found = Responses._of_surface(self, max_hz, fingers_m, options)
        if plain:
            self._responses = found._raw
        return found

    def virtual(self, block: int = 64, **options: Any) -> VirtualSurface:
        """Make a simulated surface that is stepped block by block; see :class:`VirtualSurface`.

        Returns
        -------
        VirtualSurface

        Examples
        --------
        >>> import unripple as ur
        >>> virtual = ur.Surface("hudin-2012", band_hz=[0, 500]).virtual(block=64)
        >>> virtual.block
        64
        """
        from unripple._virtual import VirtualSurface

        return VirtualSurface(self, block, **options)

    def player(self, effect: str = "click-button", **options: Any) -> Player:
        """Make a player whose touches Python pushes; see :class:`Player`.

        Returns
        -------
        Player

        Examples
        --------
        >>> import unripple as ur
        >>> player = ur.Surface("hudin-2012", band_hz=[0, 500]).player(window_ms=20)
        >>> player.rate_hz
        48000.0
        """
        from unripple._player import Player

        return Player(self, effect, **options)

    def view(
        self, drive: Drive | None = None, *, browser: bool | None = None, **options: Unpack[_types.ViewOptions]
    ) -> View:
        """Show the surface in a browser or a notebook: touch it, see its numbers, design it, compare methods; see :class:`View`.

        Parameters
        ----------
        drive
            The page begins with the method of this drive; it computes and plays drives of its own. See :meth:`Field.plot` for this one.
        browser
            Whether to open a browser; by default unless this is a notebook, whose cell shows the page.

        Returns
        -------
        View

        Examples
        --------
        >>> import unripple as ur
        >>> with ur.Surface("hudin-2012").view(browser=False) as view:
        ...     view.url.startswith("http://127.0.0.1:")
        True
        """
        from unripple._view import View

        return View(self, drive, browser=browser, **options)


def _sealed(places: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return an array that cannot be written to."""
    places.flags.writeable = False
    return places


def is_text(source: str) -> bool:
    """Tell whether a text is that of a surface file rather than a name."""
    return "\n" in source or ("=" in source and not os.path.exists(source))


def _of_text(text: str, name: str) -> _unripple.Surface:
    return _unripple.Surface(json.dumps({"toml": text, "name": name}))


def _of_keys(keys: Mapping[str, object]) -> _unripple.Surface:
    """Read a surface from keywords alone. Drawings are read beside a file only, so one that names some is written for that."""
    document = _keys.document_of(keys)
    drawn = _keys.with_whole_paths(document)
    text = _keys.write(document)
    if not drawn:
        return _of_text(text, UNNAMED)
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"{UNNAMED}.toml")
        file.write_text(text, encoding="utf-8", errors="replace")
        try:
            return _unripple.Surface(json.dumps(str(file)))
        except SurfaceError as error:
            message = str(error).replace(str(file), UNNAMED)
            faults = [asdict(fault) for fault in error.faults]
            raise SurfaceError(message, path=UNNAMED, faults=faults) from None
