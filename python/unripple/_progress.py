"""Progress, warnings and log lines of tasks, and the number of threads they use."""

from __future__ import annotations

import importlib
import importlib.util
import logging
import sys
import time
import warnings
from collections.abc import Callable
from types import TracebackType
from typing import Any, TypeAlias

from unripple import _values
from unripple._errors import OptionError, UnrippleWarning

#: Called with the name of a stage, and with the share of it that is done, from 0 to 1, where that is known.
ProgressCallback: TypeAlias = Callable[[str, float | None], object]

#: Lines that tasks tell, other than warnings.
_LOG = logging.getLogger("unripple")

#: How warnings of tasks begin.
_WARNING = "warning: "

#: Seconds before a bar is drawn: what is over sooner needs none.
_PATIENCE = 0.5

#: Steps of a bar, more than a terminal has columns.
_STEPS = 1000


class _Settings:
    """What set_progress and set_threads set."""

    shown: bool | ProgressCallback = True
    threads: int | None = None


def set_progress(shown: bool | ProgressCallback) -> None:
    """Set how the progress of long tasks is shown; ``progress=`` of a call takes precedence.

    Parameters
    ----------
    shown
        True (as at first): a bar by tqdm, if it is installed, where standard error is a terminal or a notebook. False: nothing. Or a
        function, which is called with the name of each stage, and with the share of it that is done, from 0 to 1 (None where that is
        unknown). An exception that it raises cancels the task.

    Raises
    ------
    OptionError
        If it is none of these.

    Examples
    --------
    >>> import unripple as ur
    >>> stages = []
    >>> ur.set_progress(lambda stage, share: stages.append(stage))
    >>> ur.set_progress(True)
    """
    _Settings.shown = _checked(shown)


def set_threads(count: int | None) -> None:
    """Set how many threads a task may use; ``threads=`` of a call takes precedence.

    Results do not depend on it. After ``os.fork`` no thread is left to work: use ``multiprocessing`` with the start method ``spawn``.

    Parameters
    ----------
    count
        Number of threads, from 1; None for all that the machine has.

    Raises
    ------
    OptionError
        If it is no such number.

    Examples
    --------
    >>> import unripple as ur
    >>> ur.set_threads(1)
    >>> ur.set_threads(None)
    """
    _Settings.threads = chosen_threads(count)


def chosen_threads(count: object) -> int | None:
    """Return the number of threads of a call, or else the one that was set."""
    if count is None:
        return _Settings.threads
    found = _values.count("threads", count)
    if found < 1:
        raise OptionError(f"threads: expected a number from 1, or None, found {found}")
    return found


def _checked(shown: object) -> bool | ProgressCallback:
    if isinstance(shown, bool) or callable(shown):
        return shown
    raise OptionError(f"progress: expected True, False or a function, found {_values.shown(shown)}")


class Telling:
    """What one task tells: the protocol that the library calls, and the context in which a bar is shown."""

    def __init__(self, shown: object = None) -> None:
        self._shown = _Settings.shown if shown is None else _checked(shown)
        self._stage = ""
        self._bar: Any = None
        self._since = time.monotonic()

    def __enter__(self) -> Telling:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._close()

    def stage(self, what: str) -> None:
        """Tell that a stage begins."""
        self._close()
        self._stage = what
        self._show(None)

    def done(self, share: float) -> None:
        """Tell which share of the stage is done, from 0 to 1."""
        self._show(share)

    def tell(self, line: str) -> None:
        """Tell a line: a warning, or something for the log."""
        if self._bar is not None:
            # The line has a line of its own.
            self._bar.clear()
        if line.startswith(_WARNING):
            warn(line.removeprefix(_WARNING))
        else:
            _LOG.info(line)

    def _show(self, share: float | None) -> None:
        if not isinstance(self._shown, bool):
            self._shown(self._stage, share)
            return
        if self._bar is None and self._shown and time.monotonic() - self._since > _PATIENCE:
            self._bar = _bar(self._stage)
        if self._bar is not None and share is not None:
            self._bar.update(round(share * _STEPS) - self._bar.n)

    def _close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


def warn(text: str) -> None:
    """Warn, at the line of whoever called this package."""
    depth, frame = 1, sys._getframe(0)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").split(".")[0] == "unripple":
        depth, frame = depth + 1, frame.f_back
    warnings.warn(text, UnrippleWarning, stacklevel=depth)


def in_notebook() -> bool:
    """Tell whether this is a kernel of Jupyter, which shows standard error in its page."""
    kernel = sys.modules.get("ipykernel")
    return kernel is not None and hasattr(sys.stderr, "set_parent")


def _may_draw() -> bool:
    """Tell whether somebody can see a bar on standard error."""
    return sys.stderr is not None and (sys.stderr.isatty() or in_notebook())


class _NoBar:
    """Stands for a bar where none can be seen, or tqdm is not installed."""

    n = 0

    def update(self, steps: int) -> None:
        """Draw nothing."""

    def clear(self) -> None:
        """Remove nothing."""

    def close(self) -> None:
        """Remove nothing."""


def _bar(stage: str) -> Any:
    if not _may_draw() or importlib.util.find_spec("tqdm") is None:
        return _NoBar()
    # Bars of notebooks need their widgets.
    widgets = in_notebook() and importlib.util.find_spec("ipywidgets") is not None
    tqdm = importlib.import_module("tqdm.auto" if widgets else "tqdm").tqdm
    form = "{desc} {bar:40} {percentage:.0f} %, {remaining} left"
    return tqdm(total=_STEPS, desc=stage, leave=False, bar_format=None if widgets else form)
