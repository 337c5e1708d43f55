"""Errors in the names and values that were typed, where a task names its fields and values in SI units."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import TracebackType

from unripple._errors import AskError, InputError, UnrippleError, WorkError
from unripple._values import is_number, shown

#: A name in the text of an error, and one that its text marks as the name of a field.
_NAME = re.compile(r"[A-Za-z_]\w*")
_MARKED = re.compile(r"`(\w+)`")


class Typed:
    """Has the errors of a block of code say what was typed.

    Parameters
    ----------
    **given
        For each field that errors may name: the argument that set it, and its value.

    Examples
    --------
    >>> from unripple._errors import AskError
    >>> try:
    ...     with Typed(window_s=("window_ms", -1)):
    ...         raise AskError(field="window_s", expected="a number above 0 s", found="-0.001")
    ... except AskError as error:
    ...     print(error)
    window_ms: expected a number above 0 s, found -1 (-0.001)
    """

    __slots__ = ("_given",)

    def __init__(self, **given: tuple[str, object]) -> None:
        self._given = given

    def __enter__(self) -> None:
        pass

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if isinstance(error, UnrippleError):
            names = {field: name for field, (name, _) in self._given.items()}
            told = typed(error, names, {name: value for name, value in self._given.values()})
            if told is not error:
                raise told from None


def typed(error: UnrippleError, names: Mapping[str, str], values: Mapping[str, object]) -> UnrippleError:
    """Return an error with fields by the `names` of what sets them, and with the value as it was typed beside that in SI units.

    `values` are those that were typed, by these names.
    """
    if isinstance(error, AskError):
        return _of_ask(error, names, values)
    if type(error) not in (InputError, WorkError):
        return error
    text = str(error)
    first = _NAME.match(text)
    if first is not None and first[0] in names and text[first.end() :].startswith(":"):
        text = names[first[0]] + text[first.end() :]
    told = _marked(text, names)
    return error if told == str(error) else type(error)(told)


def _of_ask(error: AskError, names: Mapping[str, str], values: Mapping[str, object]) -> AskError:
    # Of several fields those that are set by the same are said once.
    parts = dict.fromkeys(_NAME.sub(lambda name: names.get(name[0], name[0]), part) for part in error.field.split(", "))
    field, found = ", ".join(parts), error.found
    value = values.get(field)
    if field != error.field and is_number(value) and shown(value) != found:
        found = f"{shown(value)} ({found})"
    expected, found = _marked(error.expected, names), _marked(found, names)
    if (field, expected, found) == (error.field, error.expected, error.found):
        return error
    return AskError(field=field, expected=expected, found=found)


def _marked(text: str, names: Mapping[str, str]) -> str:
    """Return a text with the fields that it marks by their names."""
    return _MARKED.sub(lambda mark: f"`{names.get(mark[1], mark[1])}`", text)


def of_places(points_mm: object, actuators_mm: object, lambda_min_mm: object) -> Typed:
    """Return what names in errors the options of `from_numpy` as they were typed, in mm."""
    return Typed(
        points_m=("points_mm", points_mm),
        actuators_m=("actuators_mm", actuators_mm),
        lambda_min_m=("lambda_min_mm", lambda_min_mm),
    )
