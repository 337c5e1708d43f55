"""What there is: tasks, built-in surfaces and effects, materials, devices."""

from __future__ import annotations

from typing import TYPE_CHECKING

from unripple import _call, _unripple
from unripple._report import Report

if TYPE_CHECKING:
    from typing import Unpack

    from unripple import _types


def devices(server: str | None = None, **options: Unpack[_types.CallOptions]) -> Report:
    """List the devices that can play a drive: virtual surface, files, sound server, cards.

    Parameters
    ----------
    server
        Name of the JACK server to query; by default JACK's default server.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> ur.devices().devices[0].device
    'virtual'
    """
    return _call.report("devices", options, server=server)


def materials(name: str | None = None, **options: Unpack[_types.CallOptions]) -> Report:
    """List the materials that surfaces may name, with the sources of their values.

    Parameters
    ----------
    name
        Name of one; by default all are listed.

    Returns
    -------
    Report

    Examples
    --------
    >>> import unripple as ur
    >>> [material.name for material in ur.materials("glass").materials]
    ['glass']
    """
    return _call.report("materials", options, name=name)


def commands() -> list[str]:
    """Return the names of all tasks.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import unripple as ur
    >>> "focus" in ur.commands()
    True
    """
    return _unripple.commands()


def builtin() -> list[str]:
    """Return the names of the built-in surfaces.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import unripple as ur
    >>> "hudin-2012" in ur.builtin()
    True
    """
    return _unripple.builtin()


def effects() -> list[str]:
    """Return the names of the built-in effects.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import unripple as ur
    >>> "click-button" in ur.effects()
    True
    """
    return _unripple.effects()
