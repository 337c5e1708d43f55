"""Reports of tasks: read-only mappings whose keys are attributes too."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from unripple import _progress
from unripple._errors import InputError

if TYPE_CHECKING:
    from unripple import _unripple


#: The key of the record of how a report was made, the last of its keys.
_RECORD = "run"


class Part(Mapping[str, Any]):
    """A part of a report: a read-only mapping whose keys are attributes too."""

    __slots__ = ("_data",)

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data

    def __getitem__(self, key: str) -> Any:
        return _wrapped(self._data[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self._keys())

    def __len__(self) -> int:
        return len(self._keys())

    def __getattr__(self, name: str) -> Any:
        # Looked up in the class's own way only: a copy under construction has no data yet.
        data: dict[str, Any] = object.__getattribute__(self, "_data")
        if name in data:
            return _wrapped(data[name])
        nearest = difflib.get_close_matches(name, data, 1)
        hint = f" (nearest: {nearest[0]})" if nearest else ""
        raise AttributeError(f"expected a key of the report, found {name}{hint}")

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *self._keys()]

    def __repr__(self) -> str:
        return repr(self._data)

    def __reduce__(self) -> tuple[Any, ...]:
        return Part, (self._data,)

    def to_dict(self) -> dict[str, Any]:
        """Return a copy as nested dicts and lists."""
        copied: dict[str, Any] = json.loads(json.dumps(self._data))
        return copied

    def _repr_html_(self) -> str:
        from unripple import _html

        return _html.report(self._whole())

    def _keys(self) -> list[str]:
        """Return all keys."""
        return list(self._data)

    def _whole(self) -> dict[str, Any]:
        """Return all data."""
        return self._data


class Report(Part):
    """Results of a task: a read-only mapping in SI units, whose keys are attributes too, at every depth.

    ``str()`` is the report for people, as the command line prints it. Keys are defined in ``docs/json.md``; their endings name units
    (``_m``, ``_s``, ``_hz``, ``_m_s``, ``_db``).

    Attributes
    ----------
    failure
        Why the task counts as failed although there is a report, such as a doubtful library; None if it succeeded.

    Examples
    --------
    >>> import unripple as ur
    >>> report = ur.modes("hudin-2012", max_hz=300)
    >>> report.count == len(report["frequencies_hz"])
    True
    >>> report.run.command
    'modes'
    >>> report.failure is None
    True
    """

    __slots__ = ("_failure", "_json", "_late", "_text")

    #: What writes the report with its record, where nobody has asked for that yet.
    _late: _unripple.Done | None

    def __init__(self, text: str, as_json: str, failure: str | None = None) -> None:
        super().__init__(_parsed(as_json))
        self._text = text
        self._json = as_json
        self._failure = failure
        self._late = None

    @classmethod
    def _of(cls, done: _unripple.Done) -> Report:
        """Return the report of a task that is done; warn if it counts as failed."""
        unrecorded = done.unrecorded
        report = cls(done.text, done.json if unrecorded is None else unrecorded, done.failure)
        report._late = None if unrecorded is None else done
        if done.failure is not None:
            _progress.warn(done.failure)
        return report

    def __getitem__(self, key: str) -> Any:
        return _wrapped((self._whole() if key == _RECORD else self._data)[key])

    def __getattr__(self, name: str) -> Any:
        if name == _RECORD:
            self._whole()
        return super().__getattr__(name)

    def _keys(self) -> list[str]:
        return super()._keys() if self._late is None else [*self._data, _RECORD]

    def _whole(self) -> dict[str, Any]:
        late = self._late
        if late is not None:
            # In this order: who sees no `_late` may be another thread, and finds the rest.
            self._json = late.json
            self._data = _parsed(self._json)
            self._late = None
        return self._data

    @property
    def failure(self) -> str | None:
        """Why the task counts as failed although it has a report, or None."""
        return self._failure

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def __repr__(self) -> str:
        return str(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return Report, (self._text, self.to_json(), self._failure)

    def _repr_png_(self) -> bytes | None:
        from unripple import _plot, _png

        draw = _plot.curves(self._data)
        return None if draw is None else _png.of_plot(draw)

    def to_dict(self) -> dict[str, Any]:
        """Return a copy as nested dicts and lists, equal to what ``json.loads`` makes of the command line's ``--json``.

        Returns
        -------
        dict

        Examples
        --------
        >>> import json
        >>> import unripple as ur
        >>> report = ur.design("hudin-2012")
        >>> report.to_dict() == json.loads(report.to_json())
        True
        """
        copied: dict[str, Any] = json.loads(self.to_json())
        return copied

    def to_json(self) -> str:
        """Return the report as JSON: the text that the command line prints with ``--json``.

        Returns
        -------
        str

        Examples
        --------
        >>> import unripple as ur
        >>> ur.design("hudin-2012").to_json()[0]
        '{'
        """
        # Another thread may be reading it.
        late = self._late
        return self._json if late is None else late.json

    def to_dataframe(
        self, key: str | None = None, *, library: Literal["pandas", "polars"] | None = None
    ) -> Any:
        """Return a table of the report as a data frame.

        Parameters
        ----------
        key
            What becomes the table: a key, or keys joined by dots (``"paper.table1"``). A list of objects becomes a row each, a list of
            numbers a column, an object one row. By default the report's own table, such as ``targets`` of a focus, ``methods`` of a
            comparison, ``each_number`` of placed actuators, ``dispersion`` of a design, or one row for each mode.
        library
            ``"pandas"`` or ``"polars"``; by default the one that is installed, pandas if both are.

        Returns
        -------
        pandas.DataFrame or polars.DataFrame
            Columns are called as the keys; those of nested objects are joined by dots.

        Raises
        ------
        ImportError
            If the library is not installed.
        OptionError
            If the report has no such key.

        Examples
        --------
        >>> import unripple as ur
        >>> report = ur.modes("hudin-2012", max_hz=300)
        >>> frame = report.to_dataframe()
        >>> len(frame) == report.count
        True
        """
        from unripple import _labels

        return _labels.dataframe(self._data if key is None else self._whole(), key, library)

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write the table of a sweep as an Apache Parquet file: a row for each design, with the columns of ``table.csv``.

        A column holds whole numbers, numbers, truths or texts, by all of its values; what is unknown is null. The table is read from the
        folder of the sweep.

        Parameters
        ----------
        path
            The file to write; one that is there is replaced.

        Raises
        ------
        ImportError
            If ``pyarrow`` is not installed.
        InputError
            If this is no report of a sweep that has its table.

        Examples
        --------
        >>> import unripple as ur
        >>> try:
        ...     ur.modes("hudin-2012", max_hz=200).to_parquet("table.parquet")
        ... except (ImportError, ur.InputError) as error:
        ...     print("parquet" in str(error))
        True
        """
        from unripple import _table, _values

        _table.parquet(self._whole(), Path(_values.path("path", path)))


def _parsed(text: str) -> dict[str, Any]:
    """Return the data of a report from its JSON."""
    try:
        data = json.loads(text)
    except ValueError as error:
        raise InputError(f"report: expected JSON, found {error}") from None
    if not isinstance(data, dict):
        raise InputError("report: expected an object of JSON, found another value")
    return data


def _wrapped(value: Any) -> Any:
    """Return a value of the data, with what would let it be changed replaced by copies."""
    if isinstance(value, dict):
        return Part(value)
    if isinstance(value, list):
        return [_wrapped(item) for item in value]
    return value
