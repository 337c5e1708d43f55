"""Fields in motion, as pictures that notebooks play."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import TYPE_CHECKING

from unripple import _values
from unripple._errors import AskError, OptionError, WorkError

if TYPE_CHECKING:
    from unripple import _types

#: Endings of files that an animation is saved as.
_PICTURES = (".png", ".apng")
_PAGES = (".html", ".htm")

#: What the picture shows, for those who do not see it.
_TITLE = "displacement of the surface"


class Animation:
    """The displacement of a surface in motion: an animated PNG, which notebooks and browsers play.

    It is made by :meth:`Field.animation`.

    Parameters
    ----------
    png
        The bytes of the animated PNG.
    frames
        Number of its frames.

    Attributes
    ----------
    png : bytes
    frames : int

    Examples
    --------
    >>> import unripple as ur
    >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
    >>> animation = film.field(film.focus([(40, 50)], window_ms=30)).animation(frames=3)
    >>> animation.frames, animation.png[1:4]
    (3, b'PNG')
    """

    __slots__ = ("_frames", "_png")

    def __init__(self, png: bytes, frames: int) -> None:
        if not isinstance(png, bytes):
            raise OptionError(f"png: expected bytes, found {_values.shown(png)}")
        self._png = png
        self._frames = _values.count("frames", frames)

    @property
    def png(self) -> bytes:
        """The animated PNG; a program that plays none shows its first frame."""
        return self._png

    @property
    def frames(self) -> int:
        """Number of frames."""
        return self._frames

    def save(self, path: _types.Path) -> None:
        """Write the animation as a file.

        Parameters
        ----------
        path
            The file, which is replaced: an animated PNG if its name ends in .png or .apng, a page that shows it if it ends in .html.

        Raises
        ------
        AskError
            Of another ending.
        WorkError
            If the file cannot be written.

        Examples
        --------
        >>> import os, tempfile
        >>> import unripple as ur
        >>> film = ur.Surface("hudin-2012", band_hz=[0, 500])
        >>> animation = film.field(film.focus([(40, 50)], window_ms=30)).animation(frames=3)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     animation.save(os.path.join(folder, "waves.html"))
        ...     os.listdir(folder)
        ['waves.html']
        """
        file = Path(_values.path("path", path))
        if file.suffix.lower() in _PICTURES:
            content = self._png
        elif file.suffix.lower() in _PAGES:
            page = f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{_TITLE}</title>{self._repr_html_()}</html>\n'
            content = page.encode()
        else:
            expected = f"a name that ends in {', '.join((*_PICTURES, *_PAGES))}"
            raise AskError(field="path", expected=expected, found=str(file))
        try:
            file.write_bytes(content)
        except (OSError, ValueError) as error:
            # The latter of a name that no file can have.
            raise WorkError(f"{file}: {error}") from error

    def __repr__(self) -> str:
        return f"<Animation: {self._frames} frames, {len(self._png) / 1e6:.2g} MB>"

    def _repr_html_(self) -> str:
        data = base64.b64encode(self._png).decode()
        return f'<img alt="{_TITLE}" src="data:image/png;base64,{data}" style="max-width:100%">'
