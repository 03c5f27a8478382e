"""Page of a report: sections of texts, tables and plots in one file that needs no other."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Sequence
from importlib.resources import files
from typing import NamedTuple

from foamprb.view.report.plots import Plot


class PageSection(NamedTuple):
    """Part of the page with a heading."""

    id: str
    title: str
    body: str
    """HTML."""


def page(
    title: str,
    subtitle: str,
    cards: Sequence[tuple[str, str]],
    warnings: Sequence[str],
    sections: Sequence[PageSection],
) -> str:
    """Return the whole page, HTML; ``cards`` are numbers with their meanings."""
    template = (files("foamprb.view.report") / "page.html").read_text(encoding="utf-8")
    listed = "".join(f"<li>{html.escape(text)}</li>" for text in warnings)
    return template.format(
        title=html.escape(title),
        subtitle=html.escape(subtitle),
        cards="".join(
            f'<li><span class="figures">{html.escape(n)}</span>{html.escape(text)}</li>' for n, text in cards
        ),
        warnings=f'<div class="warnings"><h2>Warnings</h2><ul>{listed}</ul></div>' if warnings else "",
        contents="".join(f'<li><a href="#{s.id}">{html.escape(s.title)}</a></li>' for s in sections),
        sections="\n".join(
            f'<section id="{s.id}" aria-labelledby="{s.id}-title">'
            f'<h2 id="{s.id}-title">{html.escape(s.title)}</h2>\n{s.body}\n</section>'
            for s in sections
        ),
    )


def grid(*parts: str) -> str:
    """Return figures and tables side by side, as far as the page is wide enough."""
    return f'<div class="grid">{"".join(parts)}</div>'


def figure(plot: Plot, caption: str) -> str:
    """Return a plot with its caption, which is also its accessible name."""
    text = html.escape(caption)
    svg = plot.svg.replace("<svg ", f'<svg role="img" aria-label="{text}" ', 1)
    return f"<figure>{svg}<figcaption>{text}</figcaption></figure>"


def image(light: bytes, dark: bytes, caption: str) -> str:
    """Return a picture, PNG, for light and for dark pages, with its caption."""
    text = html.escape(caption)
    on_light, on_dark = (f"data:image/png;base64,{base64.b64encode(data).decode()}" for data in (light, dark))
    return (
        f'<figure><picture><source media="(prefers-color-scheme: dark)" srcset="{on_dark}">'
        f'<img src="{on_light}" alt="{text}"></picture><figcaption>{text}</figcaption></figure>'
    )


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[object]], numbers: bool = True) -> str:
    """Return a table; columns of ``numbers``, from the second on, are aligned at the right."""
    align = ' class="n"' if numbers else ""
    text = html.escape(caption)

    def line(cells: Sequence[object], first: str, tag: str) -> str:
        head, *others = (html.escape(str(cell)) for cell in cells)
        return f"<tr>{first}{head}</th>{''.join(f'<{tag}{align}>{cell}</{tag}>' for cell in others)}</tr>"

    body = "".join(line(row, '<th scope="row">', "td") for row in rows)
    return (
        f'<div class="scroll" tabindex="0" role="region" aria-label="{text}"><table><caption>{text}</caption>'
        f"<thead>{line(head, '<th>', 'th')}</thead><tbody>{body}</tbody></table></div>"
    )
