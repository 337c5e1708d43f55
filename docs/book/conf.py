"""Configuration of Sphinx for the book; ./book gathers the pages and calls it."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

project = "Unripple"
author = "the Unripple contributors"
with (Path(__file__).parents[2] / "Cargo.toml").open("rb") as manifest:
    release = tomllib.load(manifest)["workspace"]["package"]["version"]
version = release

extensions = ["myst_parser", "sphinx_copybutton", "mathml"]
root_doc = "index"
exclude_patterns: list[str] = []
# Anchors of headings as GitHub makes them, so that the same links work in both.
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_fence_as_directive = ["math"]
# $ stands for money or a shell nowhere in running text, but a formula between two $ has no space inside.
myst_dmath_allow_space = False
myst_dmath_allow_digits = False
# Blocks of `console` show commands with what they print, and `py` is Python that is not run; neither must be valid to the last sign.
suppress_warnings = ["misc.highlighting_failure"]
copybutton_prompt_text = r"\$ |>>> |\.\.\. "
copybutton_prompt_is_regexp = True
copybutton_only_copy_prompt_lines = False

# Longer signatures have a line for each argument.
python_maximum_signature_line_length = 90

html_theme = "furo"
html_title = "Unripple"
html_static_path = ["static"]
html_css_files = ["book.css"]
html_copy_source = False
html_show_sourcelink = False
# The build of a commit is the same wherever and whenever it is made.
html_last_updated_fmt = None
html_theme_options = {"navigation_with_keys": True, "top_of_page_buttons": []}
pygments_style = "friendly"
pygments_dark_style = "monokai"
