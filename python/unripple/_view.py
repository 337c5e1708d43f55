"""The page of a surface in a browser or a notebook, served by a child process."""

from __future__ import annotations

import html
import json
import os
import sys
import weakref
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import IO, TYPE_CHECKING, Any

from unripple import _options, _values
from unripple._drive import Drive
from unripple._errors import InputError, OptionError, WorkError
from unripple._progress import in_notebook
from unripple._surface import Surface

if TYPE_CHECKING:
    import subprocess
    import tempfile
    from typing import Unpack

    from unripple import _types

#: Options of the command beside those of its device.
_OPTIONS = ("method", "follow_tension", "port", "listen", "token", "framed_by", "folder", "seconds", "set")

#: Origins whose pages may frame the page where this is a notebook's kernel: those of this machine, with any port, since a kernel is not told by
#: which one its notebook is served. A page from there was served by a program on this machine, which can reach the page's server itself.
_NOTEBOOKS = ("http://localhost:*", "http://127.0.0.1:*")

#: Height of the frame in a notebook, in pixels: the surface and what is beside it, on most screens.
_HEIGHT = 720

#: Seconds for the child to end by itself before it is ended.
_PATIENCE = 5.0


class View:
    """A surface in a browser or a notebook: a child process that serves the page, until it is closed or Python ends.

    It is a context manager, which closes it. As the result of a notebook's cell it shows the page there, in a frame, and its address above.

    Parameters
    ----------
    surface
        The surface; also the path of a library of responses.
    drive
        The page begins with the method of this drive; it computes and plays drives of its own.
    browser
        Whether to open a browser; by default unless this is a notebook.
    method, follow_tension
        Method of focusing to begin with, and whether to follow the tension of the sheet.
    port, listen, token
        TCP port, by default any free one; address to listen at, and the token that other machines need.
    framed_by
        Origins, ``scheme://host[:port]``, whose pages may show the page in a frame. By default none, and in a notebook those of this
        machine: ``http://localhost:*`` and ``http://127.0.0.1:*``. An empty list lets nobody frame it; the cell then shows its address.
    folder
        Folder for libraries that are calibrated from the page, by default the current one.
    seconds
        Seconds to run; by default until it is closed.
    device
        The device that plays, with options of its kind, as for :meth:`Surface.calibrate`.

    Attributes
    ----------
    url : str
        Address for a browser on this machine.
    framed_by : tuple of str
        Origins whose pages may show the page in a frame.

    Raises
    ------
    InputError
        Of options that cannot be.
    WorkError
        If the page cannot be served.

    Examples
    --------
    >>> import unripple as ur
    >>> with ur.View("hudin-2012", browser=False) as view:
    ...     view.url.startswith("http://127.0.0.1:")
    True
    """

    def __init__(
        self,
        surface: _types.SurfaceLike = "hudin-2012",
        drive: Drive | None = None,
        *,
        browser: bool | None = None,
        **options: Unpack[_types.ViewOptions],
    ) -> None:
        # Loaded here, since few need them.
        import subprocess
        import tempfile
        import webbrowser

        given: dict[str, Any] = {name: value for name, value in options.items() if value is not None}
        if drive is not None:
            if not isinstance(drive, Drive):
                raise OptionError(f"drive: expected a drive, found {_values.shown(drive)}")
            method = drive.report.get("method") if drive.report is not None else None
            if method in ("time-reversal", "one-bit", "inverse", "concentrate", "limited", "robust", "felt"):
                given.setdefault("method", method)
        framing = given.pop("framed_by", _NOTEBOOKS if in_notebook() else ())
        self.framed_by = tuple(_values.texts("framed_by", framing))
        # What the child says when it fails, and the file of a surface that has none.
        self._room = tempfile.TemporaryDirectory(prefix="unripple-")
        said = Path(self._room.name, "said.txt")
        settings = {"port": 0, "framed_by": self.framed_by, **given}
        typed = [_named(surface, self._room.name), "--no-browser", "--until-input-ends", *_typed(settings)]
        with open(said, "wb") as errors:
            self._child = subprocess.Popen(
                [sys.executable, "-m", "unripple", "view", *typed],
                # It ends with this process, which may be killed before it can end anything.
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
                encoding="utf-8",
                # Ctrl+C at the terminal is for Python, which closes the page when it ends.
                start_new_session=True,
            )
        self._end = weakref.finalize(self, _end, self._child, self._room)
        self.url = self._listened(said)
        _OPEN.add(self)
        if browser or (browser is None and not in_notebook()):
            webbrowser.open(self.url)

    def _listened(self, said: Path) -> str:
        """Wait for the address that the child prints; raise what it says if it ends before."""
        output: IO[str] | None = self._child.stdout
        line = output.readline().strip() if output is not None else ""
        if line.startswith("http"):
            return line
        status = self._child.wait()
        why = said.read_text(encoding="utf-8", errors="replace").strip().removeprefix("error: ")
        self.close()
        raise (InputError if status == 2 else WorkError)(
            why or f"view: expected a page, found exit status {status}"
        )

    @property
    def closed(self) -> bool:
        """Whether the page is served no longer."""
        return self._child.poll() is not None

    def close(self) -> None:
        """Close the page: end the process that serves it.

        Examples
        --------
        >>> import unripple as ur
        >>> view = ur.View("hudin-2012", browser=False)
        >>> view.close()
        >>> view.closed
        True
        """
        _OPEN.discard(self)
        self._end()

    def __enter__(self) -> View:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<View {self.url}{', closed' if self.closed else ''}>"

    def _repr_html_(self) -> str:
        if self.closed:
            return f"<p>{html.escape(repr(self))}</p>"
        address = html.escape(self.url, quote=True)
        link = f'<p><a href="{address}" target="_blank" rel="noopener">{address}</a></p>'
        if not self.framed_by:
            return link
        # Beside what any page may do, this one copies messages.
        frame = f'<iframe src="{address}" title="Unripple" allow="clipboard-write"'
        return f'{link}\n{frame} style="width: 100%; height: {_HEIGHT}px; border: 0"></iframe>'


# Pages that are served: one that nobody keeps is not to vanish from the browser.
_OPEN: set[View] = set()


def _end(child: subprocess.Popen[str], room: tempfile.TemporaryDirectory[str]) -> None:
    """End the child, and remove its files."""
    import subprocess

    if child.poll() is None:
        child.terminate()
        try:
            child.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()
    for pipe in (child.stdin, child.stdout):
        if pipe is not None:
            pipe.close()
    room.cleanup()


def _named(surface: object, folder: str) -> str:
    """Return what the command line calls a surface; one that no file holds as it is gets a file."""
    if isinstance(surface, (str, os.PathLike)) and os.path.isdir(surface):
        return os.path.abspath(surface)
    shown = surface if isinstance(surface, Surface) else Surface(surface)  # type: ignore[arg-type]
    named = shown.as_ask()
    if isinstance(named, str):
        return named
    file = Path(folder, "surface.toml")
    file.write_text(shown.toml, encoding="utf-8")
    return str(file)


def _typed(options: Mapping[str, Any]) -> list[str]:
    """Return options as they are typed."""
    device = [option.name for option in _options.OPTIONS["doctor"] if option.field.startswith("device")]
    typed = []
    for name, value in options.items():
        if name not in (*_OPTIONS, *device):
            raise _options.unknown("view", name, [*_OPTIONS, *device])
        flag = f"--{name.replace('_', '-')}"
        if value is True:
            typed.append(flag)
        elif value is not False:
            typed += [f"{flag}={text}" for text in _texts(name, value)]
    return typed


def _texts(name: str, value: Any) -> list[str]:
    if name == "framed_by":
        return list(value)
    if name == "set":
        from unripple import _keys

        return [f"{key}={text}" for key, text in _keys.typed(value).items()]
    if isinstance(value, (list, tuple)):
        return [",".join(str(item) for item in value)]
    if isinstance(value, Mapping):
        raise OptionError(
            f"{name}: expected a text or a number, found {json.dumps(dict(value), default=str)}"
        )
    return [str(value)]
