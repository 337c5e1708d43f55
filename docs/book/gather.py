"""Gather the pages of the book into one folder, as Sphinx reads them.

    python3 docs/book/gather.py FOLDER

Pages keep their paths within the repository, so that links between them stay as they are. Each page of docs/ must stand in one part of
contents.toml. Files that pages link to are copied too; linked folders become the page that shows their files.
"""

from __future__ import annotations

import json
import re
import shutil
import sys
import tomllib
from pathlib import Path
from typing import Any

import python_reference

ROOT = Path(__file__).resolve().parents[2]
HERE = Path("docs/book")

#: Pages that show the files of a folder: their heading, the folder, and what is said above.
FOLDERS = {
    "reference/surfaces.md": (
        "Built-in surfaces",
        "crates/unripple-store/builtin",
        "The files of the surfaces that commands know by name. `unripple check NAME` checks one, and a copy of one is the shortest way to "
        "[a file of your own](../docs/surface-file.md).",
    ),
    "reference/effects.md": (
        "Built-in effects",
        "crates/unripple-store/builtin/effects",
        "The files of the ready-made [effects](../docs/effects.md), for `unripple play --effect NAME`.",
    ),
}

#: Link targets of Markdown: the text in brackets is left out.
LINK = re.compile(r"\]\((?!https?:|mailto:|#)([^)#\s]+)(#[^)\s]*)?\)")

#: A block of `console` in which no line has a prompt: commands alone, which would be shown as output.
COMMANDS = re.compile(r"^```console(\n(?:(?!\$ |```).*\n)*```)$", re.MULTILINE)


class Fault(Exception):
    """What is wrong with the contents or with a page, in words for whoever changed it."""


def contents() -> list[dict[str, Any]]:
    """Return the parts with their pages, patterns replaced by what they name."""
    parts: list[dict[str, Any]] = tomllib.loads((ROOT / HERE / "contents.toml").read_text(encoding="utf-8"))["part"]
    for part in parts:
        pages: list[str] = []
        for pattern in part["pages"]:
            found = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob(pattern))
            if not found:
                raise Fault(f"docs/book/contents.toml, part {part['title']!r}: expected a page, found no {pattern}")
            pages += found
        part["pages"] = pages
    return parts


def check_complete(parts: list[dict[str, Any]]) -> None:
    """Raise a fault if a page of docs/ stands in no part or in two."""
    listed = [page for part in parts for page in part["pages"]]
    twice = sorted({page for page in listed if listed.count(page) > 1})
    if twice:
        raise Fault(f"docs/book/contents.toml: expected each page once, found twice: {', '.join(twice)}")
    paths = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("docs/**/*.ipynb")]
    pages = {path.relative_to(ROOT) for path in paths}
    missing = sorted(str(page) for page in pages if HERE not in page.parents and str(page) not in listed)
    if missing:
        raise Fault(
            f"{', '.join(missing)}: in no part of docs/book/contents.toml; add a line with the path to the `pages` of the part where readers "
            "would look for it"
        )


def notebook(path: Path) -> str:
    """Return a notebook as Markdown: cells as they stand, with the kept picture below the cell that draws it."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    name = path.stem
    out = []
    for number, cell in enumerate(cells):
        text = "".join(cell["source"])
        out.append(text if cell["cell_type"] == "markdown" else f"```python\n{text}\n```")
        if "picture" in cell.get("metadata", {}).get("tags", []):
            out.append(f"![What this cell draws](../images/notebooks/{name}.png)")
        if number == 0:
            out.append(
                f"*This is the notebook `docs/notebooks/{path.name}` without its results; the tests run it. "
                "[How to run it](README.md).*"
            )
    return "\n\n".join(out) + "\n"


def folder_page(heading: str, folder: str, said: str) -> str:
    """Return a page with the text of each file of a folder."""
    out = [f"# {heading}", said]
    for path in sorted((ROOT / folder).glob("*.toml")):
        out += [f"## {path.stem}", f"`{path.relative_to(ROOT)}`", f"```toml\n{path.read_text(encoding='utf-8').rstrip()}\n```"]
    return "\n\n".join(out) + "\n"


def glossary() -> str:
    """Return the glossary of ARCHITECTURE.md as a page of its own."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    found = re.search(r"^## Glossary\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    if not found:
        raise Fault("ARCHITECTURE.md: expected a heading `## Glossary`, found none")
    return f"# Glossary\n\nThe words of these pages beside those of the field, and where to read about them.\n{found[1]}"


def rust() -> str:
    """Return the page on the reference of the Rust crates."""
    return (ROOT / HERE / "rust.md").read_text(encoding="utf-8")


def linked(text: str, page: Path, output: Path) -> str:
    """Return the text of a page with links into the repository that lead somewhere within the book; copy files that it links to."""

    def lead(found: re.Match[str]) -> str:
        target, anchor = found[1], found[2] or ""
        path = (ROOT / page.parent / target).resolve()
        if not path.exists() or not path.is_relative_to(ROOT):
            return found[0]  # Sphinx warns of it, with its line.
        inside = path.relative_to(ROOT)
        if inside == HERE / "index.md":
            return f"]({'../' * len(page.parent.parts)}index.md{anchor})"
        if path.is_dir():
            shown = next((name for name, (_, folder, _) in FOLDERS.items() if Path(folder) == inside), None)
            if shown is None:
                raise Fault(f"{page}: a link to the folder {inside}, which the book does not show; FOLDERS of docs/book/gather.py lists those it does")
            return f"]({'../' * len(page.parent.parts)}{shown}{anchor})"
        if inside.suffix == ".ipynb":
            return f"]({target.removesuffix('.ipynb')}.md{anchor})"
        if inside.suffix != ".md":
            copy(path, output / inside)
        return found[0]

    return COMMANDS.sub(r"```bash\1", LINK.sub(lead, text))


def copy(source: Path, goal: Path) -> None:
    """Copy a file, with the folders that it needs."""
    goal.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, goal)


def write(text: str, goal: Path) -> None:
    """Write a page, with the folders that it needs."""
    goal.parent.mkdir(parents=True, exist_ok=True)
    goal.write_text(text, encoding="utf-8")


def index(parts: list[dict[str, Any]]) -> str:
    """Return the first page with the contents of the book, which the side bar shows."""
    text = (ROOT / HERE / "index.md").read_text(encoding="utf-8").replace("](../../", "](").replace("](../", "](docs/")
    for part in parts:
        pages = [re.sub(r"\.(md|ipynb|rst)$", "", page) for page in [*part["pages"], *part.get("made", [])]]
        text += "\n".join(["", "```{toctree}", ":hidden:", f":caption: {part['title']}", "", *pages, "```", ""])
    return text


def gather(output: Path) -> None:
    """Write all pages into a folder."""
    parts = contents()
    check_complete(parts)
    for page in (Path(page) for part in parts for page in part["pages"]):
        path = ROOT / page
        text = notebook(path) if page.suffix == ".ipynb" else path.read_text(encoding="utf-8")
        write(linked(text, page, output), output / page.with_suffix(".md"))
    made = {name: folder_page(*of) for name, of in FOLDERS.items()}
    made |= {"reference/glossary.md": glossary(), "reference/rust.md": rust(), "reference/python.rst": python_reference.page(ROOT)}
    named = {name for part in parts for name in part.get("made", [])}
    if named != set(made):
        raise Fault(f"docs/book/contents.toml: expected `made` to name {sorted(made)}, found {sorted(named)}")
    for name, text in made.items():
        write(text, output / name)
    write(linked(index(parts), Path("index.md"), output), output / "index.md")


def main() -> None:
    """Gather into the folder that is named, which is emptied first."""
    if len(sys.argv) != 2:
        sys.exit("usage: gather.py FOLDER")
    output = Path(sys.argv[1])
    shutil.rmtree(output, ignore_errors=True)
    try:
        gather(output)
    except Fault as fault:
        sys.exit(str(fault))


if __name__ == "__main__":
    main()
