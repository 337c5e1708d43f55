"""Check the pages of the built book: every link within it leads to a page and to a place on it, and every picture is there.

    python3 docs/book/links.py SITE
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

#: What links to something, by the attribute that says to what.
LINKS = {"a": "href", "img": "src", "link": "href", "script": "src"}


class Page(HTMLParser):
    """The places on a page, and where it leads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.places: set[str] = set()
        self.leads: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        self.places.update(value for name in ("id", "name") if (value := values.get(name)))
        to = values.get(LINKS.get(tag, ""))
        if to and not urlsplit(to).scheme and not to.startswith("//"):
            self.leads.add(to)


def faults(site: Path) -> list[str]:
    """Return the links that lead nowhere, with the pages that have them."""
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        for lead in sorted(page.leads):
            parts = urlsplit(lead)
            goal = (path.parent / unquote(parts.path)).resolve() if parts.path else path.resolve()
            if goal.is_dir():
                goal /= "index.html"
            place = unquote(parts.fragment)
            if not goal.is_file():
                found.append(f"{path.relative_to(site)}: {lead}: no such file")
            elif place and goal in pages and place not in pages[goal].places:
                found.append(f"{path.relative_to(site)}: {lead}: no such place on that page")
    print(f"{len(pages)} pages, {sum(len(page.leads) for page in pages.values())} links within the book")
    return found


def main() -> None:
    """Check the site that is named; end with 1 if a link leads nowhere."""
    if len(sys.argv) != 2:
        sys.exit("usage: links.py SITE")
    found = faults(Path(sys.argv[1]).resolve())
    if found:
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
