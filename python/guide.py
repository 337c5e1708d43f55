"""Print the Python blocks of a page of the documentation as one program, which runs as a reader would type them.

    python3 python/guide.py docs/python.md > python_md.py

Lines keep their numbers: what fails is at that line of the page.
"""

from __future__ import annotations

import sys
from pathlib import Path


def program(page: str) -> str:
    """The lines of all blocks that begin with ```python, every other line empty."""
    lines: list[str] = []
    inside = False
    for line in page.splitlines():
        fence = line.startswith("```")
        lines.append(line if inside and not fence else "")
        inside = not inside and line.rstrip() == "```python" if fence else inside
    return "\n".join(lines) + "\n"


def main() -> None:
    """Print the program of the page that is named."""
    if len(sys.argv) != 2:
        sys.exit("usage: guide.py PAGE.md")
    print(program(Path(sys.argv[1]).read_text(encoding="utf-8")), end="")


if __name__ == "__main__":
    main()
