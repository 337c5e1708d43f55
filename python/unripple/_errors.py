"""The errors and the warning of Unripple."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any


class UnrippleError(Exception):
    """Base of all errors of Unripple.

    Parameters
    ----------
    message
        What is wrong.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.Surface("hudin-2021")
    ... except ur.UnrippleError as error:
    ...     print("nearest: hudin-2012" in str(error))
    True
    """

    def __init__(self, message: str) -> None:
        super().__init__(message)


class OptionError(UnrippleError, TypeError):
    """An option that no command has, that is given twice, or whose value is of another type.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.modes("hudin-2012", max_hertz=500)
    ... except ur.OptionError as error:
    ...     print(error)
    modes: expected an option that it has, found max_hertz (nearest: max_hz)
    """


class AskError(UnrippleError, ValueError):
    """A value, or a combination of values, that a task does not accept.

    Parameters
    ----------
    field
        Name of the option or argument as it was given, such as ``window_ms``; of several, with commas between them.
    expected, found
        What is accepted, in SI units, and what was found: the value as it was given, and behind it in brackets in SI units, where these
        differ.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.modes("hudin-2012", max_hz=float("nan"))
    ... except ur.AskError as error:
    ...     print(error)
    max_hz: expected a finite number, found nan
    """

    field: str
    expected: str
    found: str

    def __init__(self, *, field: str, expected: str, found: str) -> None:
        super().__init__(f"{field}: expected {expected}, found {found}")
        self.field = field
        self.expected = expected
        self.found = found

    def __reduce__(self) -> tuple[Callable[[], AskError], tuple[()], dict[str, Any]]:
        again = partial(type(self), field=self.field, expected=self.expected, found=self.found)
        return again, (), self.__dict__


class InputError(UnrippleError, ValueError):
    """A file or an argument that cannot be used.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.open("no-such-library")
    ... except ur.InputError:
    ...     print("not there")
    not there
    """


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing wrong with a surface file.

    Attributes
    ----------
    key
        Path of the key, as in ``actuator[3].at_mm``, counted from 0; empty for the whole file.
    line, column
        Where it is, counted from 1.
    message
        All of it in words.
    nearest
        The nearest legal value or known name, in the file's own unit, or None.
    expected, found
        What the file may say there, and what it says.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.Surface("hudin-2012", edge="clampd")
    ... except ur.SurfaceError as error:
    ...     fault = error.faults[0]
    >>> fault.key, fault.nearest
    ('outline.edge', '"clamped"')
    """

    key: str
    line: int
    column: int
    message: str
    nearest: str | None = None
    expected: str = ""
    found: str = ""

    def __str__(self) -> str:
        return self.message


class SurfaceError(InputError):
    """A surface file, or keywords in place of one, with faults; all of them are reported at once.

    Parameters
    ----------
    message
        All faults in words, each with line, column, key and the nearest legal value.
    path
        Name of the file.
    faults
        A mapping for each fault, with the attributes of :class:`Fault`.

    Attributes
    ----------
    faults
        A tuple of :class:`Fault`, in the file's order; empty where no line of a file is at fault, as of a name that no surface has.

    Examples
    --------
    >>> import unripple as ur
    >>> try:
    ...     ur.Surface("hudin-2012", thickness_mm=-0.1, edge="clampd")
    ... except ur.SurfaceError as error:
    ...     print(sorted(fault.key for fault in error.faults))
    ['outline.edge', 'sheet.thickness_mm']
    """

    faults: tuple[Fault, ...]
    path: str

    def __init__(self, message: str, *, path: str = "", faults: Iterable[Mapping[str, Any]] = ()) -> None:
        super().__init__(message)
        self.faults = tuple(Fault(**parts) for parts in faults)
        self.path = path

    def __reduce__(self) -> tuple[type[SurfaceError], tuple[str], dict[str, Any]]:
        return type(self), (str(self),), self.__dict__


class WorkError(UnrippleError, RuntimeError):
    """Work that failed, though its input was good.

    Examples
    --------
    >>> import unripple as ur
    >>> issubclass(ur.WorkError, RuntimeError)
    True
    """


class Cancelled(UnrippleError):
    """Work that was cancelled other than by an exception.

    Examples
    --------
    >>> import unripple as ur
    >>> issubclass(ur.Cancelled, ur.UnrippleError)
    True
    """


class UnrippleWarning(UserWarning):
    """What a reader of the results needs to know, such as that a library is doubtful.

    Examples
    --------
    >>> import unripple as ur
    >>> issubclass(ur.UnrippleWarning, UserWarning)
    True
    """
