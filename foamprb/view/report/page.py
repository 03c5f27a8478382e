"""The page of a report: sections of words, tables and plots in one file that needs no other."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Sequence
from importlib.resources import files
from typing import NamedTuple

from foamprb.view.report.plots import Plot

__all__ = ["Section", "figure", "image", "page", "table"]


class Section(NamedTuple):
    """A part of the page with a heading."""

    id: str
    title: str
    body: str
    """HTML."""


def page(
    title: str,
    subtitle: str,
    cards: Sequence[tuple[str, str]],
    warnings: Sequence[str],
    sections: Sequence[Section],
) -> str:
    """Return the whole page, HTML.

    Parameters
    ----------
    title, subtitle
        At its top.
    cards
        Numbers and what they are.
    warnings
        Sentences.
    sections
        In their order.
    """
    template = (files("foamprb.view.report") / "page.html").read_text(encoding="utf-8")
    listed = "".join(f"<li>{html.escape(text)}</li>" for text in warnings)
    return template.format(
        title=html.escape(title),
        subtitle=html.escape(subtitle),
        cards="".join(
            f'<li><span class="figures">{html.escape(n)}</span>{html.escape(what)}</li>' for n, what in cards
        ),
        warnings=f'<div class="warnings"><h3>Warnings</h3><ul>{listed}</ul></div>' if warnings else "",
        contents="".join(f'<li><a href="#{s.id}">{html.escape(s.title)}</a></li>' for s in sections),
        sections="\n".join(
            f'<section id="{s.id}" aria-labelledby="{s.id}-title">'
            f'<h2 id="{s.id}-title">{html.escape(s.title)}</h2>\n{s.body}\n</section>'
            for s in sections
        ),
    )


def figure(plot: Plot, caption: str) -> str:
    """Return a plot with its caption, by which it is also called."""
    text = html.escape(caption)
    svg = plot.svg.replace("<svg ", f'<svg role="img" aria-label="{text}" ', 1)
    return f"<figure>{svg}<figcaption>{text}</figcaption></figure>"


def image(light: bytes, dark: bytes, caption: str) -> str:
    """Return a picture in two colourings, PNG, with its caption."""
    text = html.escape(caption)
    sources = [f"data:image/png;base64,{base64.b64encode(data).decode()}" for data in (light, dark)]
    return (
        f'<figure><picture><source media="(prefers-color-scheme: dark)" srcset="{sources[1]}">'
        f'<img src="{sources[0]}" alt="{text}"></picture><figcaption>{text}</figcaption></figure>'
    )


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[object]], numbers: bool = True) -> str:
    """Return a table; from the second column on, ``numbers`` stand at the right."""
    align = ' class="n"' if numbers else ""

    def line(cells: Sequence[object], tag: str) -> str:
        scope = ' scope="row"' if tag == "td" else ""
        first = f"<th{scope}>{html.escape(str(cells[0]))}</th>"
        others = "".join(f"<{tag}{align}>{html.escape(str(cell))}</{tag}>" for cell in cells[1:])
        return f"<tr>{first}{others}</tr>"

    body = "".join(line(row, "td") for row in rows)
    return (
        f'<div class="scroll" tabindex="0" role="region" aria-label="{html.escape(caption)}"><table>'
        f"<caption>{html.escape(caption)}</caption><thead>{line(head, 'th')}</thead><tbody>{body}</tbody>"
        "</table></div>"
    )
