"""The site of these pages: sphinx-build -W docs site (the extra ``docs``)."""

from __future__ import annotations

import os
import re
import tempfile
import tomllib
from html import escape
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
ROOT = HERE.parent

# On GitHub the workflow has the address, also in a fork.
ADDRESS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["urls"][
    "Repository"
]
OWNER, REPOSITORY = os.environ.get("GITHUB_REPOSITORY", "/".join(ADDRESS.split("/")[-2:])).split("/")

project = "foamprb"
author = "The foamprb developers"
release = version = version_of("foamprb")
extensions = [
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx_copybutton",
    "sphinx_design",
]
exclude_patterns = ["_build", "site"]
myst_heading_anchors = 4
myst_enable_extensions = ["attrs_inline", "colon_fence"]
html_theme = "pydata_sphinx_theme"
html_title = "foamprb"
html_static_path = ["_static"]
html_favicon = "_static/favicon.svg"
html_context = {
    "github_user": OWNER, "github_repo": REPOSITORY, "github_version": "main", "doc_path": "docs",
}  # fmt: skip
html_css_files = ["site.css"]
html_show_sourcelink = False
html_sidebars = {"index": []}
html_theme_options: dict[str, Any] = {
    "navbar_align": "left",
    # The field with its shortcut has a label that differs from its text.
    "navbar_persistent": ["search-button"],
    "header_links_before_dropdown": 5,
    "logo": {"text": f"foamprb {version_of('foamprb').partition('+')[0]}"},
    "icon_links": [
        {
            "name": "Repository",
            "url": f"https://github.com/{OWNER}/{REPOSITORY}",
            "icon": "fa-brands fa-github",
        },
    ],
    "secondary_sidebar_items": ["page-toc", "edit-this-page"],
    "use_edit_page_button": True,
    "show_nav_level": 1,
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
    "footer_start": ["copyright"],
    "footer_end": [],
}
copyright = "The foamprb developers. GPL-3.0-or-later"  # noqa: A001
copybutton_exclude = ".linenos, .gp, .go"

# Notebooks are executed when the site is built, and again when they change. Without this variable their
# figures are shown below the cells.
os.environ.pop("MPLBACKEND", None)
nb_execution_mode = "cache"
nb_execution_timeout = 120
nb_execution_raise_on_error = True
nb_merge_streams = True

autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_class_signature = "mixed"
numpydoc_show_class_members = False

SECTIONS = ("tutorials/index", "how-to", "models/index", "reference/index", "evidence")
"""Pages that list others: links of theirs make the table of contents."""
CASES = sorted((HERE / "cases").glob("*.md"))
PAGES = {
    "README.md": "index.md",
    "CHANGELOG.md": "changelog.md",
    "CODE_OF_CONDUCT.md": "conduct.md",
    "CONTRIBUTING.md": "contributing.md",
    "RELEASING.md": "releasing.md",
    "SECURITY.md": "reporting.md",
    "tools/README.md": "tools.md",
    **{f"cases/{page.stem}/README.md": f"cases/{page.name}" for page in CASES},
}
"""Files outside this folder, and the pages of the site that include them."""


def within_the_site(text: str, folder: Path, page: Path) -> str:
    """Return the text of a file in a folder for a page, with links to the pages that include other files."""

    def link(found: re.Match[str]) -> str:
        path, mark, anchor = found[2].partition("#")
        target = (folder / path).resolve()
        if target.is_relative_to(ROOT) and (own := PAGES.get(str(target.relative_to(ROOT)))):
            target = HERE / own
        return f"{found[1]}({os.path.relpath(target, page.parent)}{mark}{anchor})"

    return re.sub(r"(!?\[[^\]]*\])\((?![a-z]+:|#)([^)\s]+)\)", link, text)


def change_page(_: Any, name: str, source: list[str]) -> None:
    """Change the links of a page as it is read."""
    page = HERE / f"{name}.md"
    if not page.exists():
        return
    if name in SECTIONS:
        items = "".join(re.findall(r"^\* .*\n", source[0], re.MULTILINE))
        pages = dict.fromkeys(re.findall(r"\]\(((?:\.\./)?[\w/-]+)\.md\)", items))
        source[0] += "\n```{toctree}\n:hidden:\n\n" + "\n".join(pages) + "\n```\n"
    if name == "examples":
        source[0] = gallery(source[0])
    if name == "reference/commands":
        source[0] += commands()
    if name == "reference/clouds":
        source[0] = source[0].replace("<!-- arrays -->\n", arrays())
    source[0] = within_the_site(source[0], page.parent, page)


def gallery(text: str) -> str:
    """Return the page of the examples with a card for each on top, and code and download in its section."""
    example = r"^## (.+)\n\n`examples/(\w+)\.py`"
    cards = []
    for title, name in re.findall(example, text, re.MULTILINE):
        link = title.lower().replace(" ", "-")
        options = f':img-top: examples/{name}.png\n:img-alt: ""\n:link: "#{link}"'
        cards.append(f":::{{grid-item-card}} {title}\n{options}\n:::")
    grid = "\n\n".join(["::::{grid} 1 2 3 3\n:gutter: 2", *cards, "::::"])
    code = (
        r"\g<0>\n\n:::{dropdown} Code\n```{literalinclude} ../examples/\1.py\n:language: python\n```\n:::\n\n"
        r"{download}`Download \1.py <../examples/\1.py>`"
    )
    text = re.sub(r"^!\[.*\]\(examples/(\w+)\.png\)$", code, text, flags=re.MULTILINE)
    return text.replace("\n## ", f"\n{grid}\n\n## ", 1)


def commands() -> str:
    """Return a section for each command, with a table of its options, from the parser of the command line."""
    from foamprb.cli.main import _parser

    (chosen,) = (action for action in _parser()._actions if action.choices)
    text = ""
    for help_, (name, parser) in zip(chosen._choices_actions, chosen.choices.items(), strict=True):
        rows = [(option(action), action.help) for action in parser._actions if action.dest != "help"]
        lines = [f"| `{words}` | {meaning.replace('|', '/')} |" for words, meaning in rows]
        text += (
            f"\n## {name}\n\n`foamprb {name}`: {help_.help}\n\n| option | meaning |\n|---|---|\n"
            + "\n".join(lines)
            + "\n"
        )
    return text


def arrays() -> str:
    """Return a table of the arrays of particles, from their declarations."""
    from foamprb.cloud.state import VARIABLES

    rows = [
        f"| `{name}` | {v.unit} | {', '.join(map(str, v.shape))} | {v.meaning} |"
        for name, v in VARIABLES.items()
    ]
    return "| array | unit | components | meaning |\n|---|---|---|---|\n" + "\n".join(rows) + "\n"


def skip(_: Any, __: str, ___: str, member: Any, skipped: bool, ____: Any) -> bool | None:
    """Leave out fields of tuples without a description of their own."""
    return (
        True
        if (getattr(member, "__doc__", "") or "").startswith("Alias for field number")
        else skipped or None
    )


def option(action: Any) -> str:
    """Return an option with its argument, in OpenFOAM's manner with a single dash."""
    choices = f"{{{','.join(map(str, action.choices))}}}" if action.choices else action.dest.upper()
    value = action.metavar or choices
    if not action.option_strings:
        return f"[{value}]" if action.nargs == "?" else str(value)
    words = [word.replace("--", "-", 1) for word in action.option_strings]
    takes = "" if action.nargs == 0 else " " + (" ".join(value) if isinstance(value, tuple) else str(value))
    return ", ".join(words) + takes


def change_included(_: Any, path: Path, _parent: str, source: list[str]) -> None:
    """Change the links of an included file as it is read."""
    file = (HERE / path).resolve()
    source[0] = within_the_site(source[0], file.parent, HERE / PAGES[str(file.relative_to(ROOT))])


def write_scene(app: Any, failure: Exception | None) -> None:
    """Write the page of ``foamprb view`` that the first page shows, from a run of the pipe case."""
    if failure is not None or app.builder.name != "html":
        return
    import foamprb

    with tempfile.TemporaryDirectory() as scratch:
        job = foamprb.prepare(ROOT / "cases/pipe", output=scratch)
        foamprb.execute(job)
        run = foamprb.open_run(ROOT / "cases/pipe", results=scratch)
        run.view(Path(app.outdir) / "scene.html", max_size=3.0, enlargement=50.0)


def describe(_: Any, name: str, __: str, context: dict[str, Any], doctree: Any) -> None:
    """Add the first paragraph as the description of a page; the first page has the name of the site once."""
    if name == "index":
        context["docstitle"] = ""
    paragraphs = [] if doctree is None else list(doctree.findall(lambda node: node.tagname == "paragraph"))
    if paragraphs:
        text = escape(" ".join(paragraphs[0].astext().split()), quote=True)
        title = escape(f"{context['title']} – foamprb" if name != "index" else "foamprb", quote=True)
        context["metatags"] += "".join(
            f'<meta {kind} content="{content}" />\n'
            for kind, content in (
                ('name="description"', text),
                ('property="og:title"', title),
                ('property="og:description"', text),
                ('property="og:type"', "website"),
            )
        )


def setup(app: Any) -> None:
    """Change pages as they are read, and add the scene when all are written."""
    app.connect("autodoc-skip-member", skip)
    app.connect("source-read", change_page)
    app.connect("include-read", change_included)
    app.connect("html-page-context", describe)
    app.connect("build-finished", write_scene)
