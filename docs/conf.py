"""The site made of these pages: sphinx-build -W docs site (the extra ``docs``)."""

from __future__ import annotations

import re
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

project = "foamprb"
author = "The authors of foamprb"
release = version = version_of("foamprb")
extensions = ["myst_parser"]
root_doc = "README"
exclude_patterns = ["_build", "site"]
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]
html_theme = "pydata_sphinx_theme"
html_title = "foamprb"
html_show_sourcelink = False
html_theme_options: dict[str, Any] = {
    "show_prev_next": False,
    "secondary_sidebar_items": ["page-toc"],
    "navbar_align": "left",
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
HERE = Path(__file__).parent


def within_the_site(_: Any, name: str, source: list[str]) -> None:
    """Make words of links to what is no page of the site, and list all pages under the first."""
    page = HERE / f"{name}.md"

    def word(link: re.Match[str]) -> str:
        target = (page.parent / link[2].partition("#")[0]).resolve()
        return link[0] if target.is_relative_to(HERE) and target.is_file() else link[1]

    source[0] = re.sub(r"(?<!!)\[([^\]]+)\]\((?![a-z]+://|#)([^)]+)\)", word, source[0])
    if name == root_doc:
        pages = re.findall(r"\]\(((?!\.\.)[\w/-]+)\.md\)", source[0])
        listed = "\n".join(dict.fromkeys(pages))
        source[0] += f"\n```{{toctree}}\n:hidden:\n\n{listed}\n```\n"


def as_index(app: Any, failure: Exception | None) -> None:
    """Let the site begin at index.html."""
    first = Path(app.outdir) / f"{root_doc}.html"
    if failure is None and first.exists():
        (first.parent / "index.html").write_bytes(first.read_bytes())


def setup(app: Any) -> None:
    """Change pages as they are read, and add the first when all are written."""
    app.connect("source-read", within_the_site)
    app.connect("build-finished", as_index)
