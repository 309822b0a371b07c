"""A report as Markdown and as HTML: sections of text, tables, plots and pictured contacts.

The HTML page needs nothing else. Beside the Markdown page its plots lie as files; pictured contacts
are in the HTML alone, to which it points. Not here: what a report says.
"""

from __future__ import annotations

import base64
import html
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class PageTable:
    """Cells in rows.

    Attributes:
        head: Names of columns.
        rows: Cells; the first of a row names it.
    """

    head: list[str]
    rows: list[list[str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class PagePlot:
    """A drawing.

    Attributes:
        name: Of its file.
        about: For those who don't see it.
        png: Its bytes.
    """

    name: str
    about: str
    png: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class PageCard:
    """A contact with its picture.

    Attributes:
        webp: Its bytes in base64.
        lines: Below it.
    """

    webp: str
    lines: list[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class PageCardGroup:
    """Contacts that belong together.

    Attributes:
        title: What they are.
        cards: Them.
        is_open: Whether they are seen at once.
    """

    title: str
    cards: list[PageCard]
    is_open: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class PageSection:
    """A part of a report.

    Attributes:
        title: Above it.
        text: Paragraphs.
        table: What it shows.
        note: Below the table.
        plots: Drawings.
        cards: Pictured contacts.
        code: Commands, one a line.
    """

    title: str
    text: list[str] = field(default_factory=list)
    table: PageTable | None = None
    note: str = ""
    plots: list[PagePlot] = field(default_factory=list)
    cards: list[PageCardGroup] = field(default_factory=list)
    code: list[str] = field(default_factory=list)


def markdown(title: str, sections: Sequence[PageSection], *, plots: str, page: str) -> str:
    """The page.

    Args:
        title: Above everything.
        sections: What it says.
        plots: Folder of the plots, relative to the page.
        page: The HTML page, relative to it.
    """
    lines = [f"# {title}"]
    for section in sections:
        lines += ["", f"## {section.title}"] if section.title else []
        for paragraph in section.text:
            lines += ["", paragraph]
        if section.table is not None:
            lines += ["", *_markdown_table(section.table)]
        lines += ["", section.note] if section.note else []
        for plot in section.plots:
            lines += ["", f"![{plot.about}]({plots}/{plot.name}.png)"]
        if any(group.cards for group in section.cards):
            lines += ["", f"Pictures: [{page}]({page})."]
        lines += ["", *(f"- `{line}`" for line in section.code)] if section.code else []
    return "\n".join(lines) + "\n"


def _markdown_table(table: PageTable) -> Iterator[str]:
    yield f"| {' | '.join(table.head)} |"
    yield f"|{'---|' * len(table.head)}"
    for row in table.rows:
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"


_STYLE = (
    "body{font:15px/1.45 sans-serif;max-width:80em;margin:2em auto;padding:0 1em;color:#222}"
    "h2{margin-top:2em}table{border-collapse:collapse;margin:.5em 0;display:block;overflow-x:auto}"
    "td,th{padding:.25em .6em;border-bottom:1px solid #ccc;text-align:right;white-space:nowrap}"
    "td:first-child,th:first-child{text-align:left}td:last-child{white-space:normal}"
    "img{max-width:100%}.cards{display:flex;flex-wrap:wrap;gap:.8em;margin:.4em 0 1em}"
    "figure{margin:0;width:112px;font-size:12px;line-height:1.3}figure img{border-radius:3px}"
    "summary{cursor:pointer;font-weight:bold;margin:.4em 0}h3{font-size:1em;margin:1em 0 .2em}"
)


def page(title: str, sections: Sequence[PageSection]) -> str:
    """The same as one HTML page."""
    parts = [
        "<!doctype html><html lang=en><meta charset=utf-8>"
        "<meta name=viewport content='width=device-width, initial-scale=1'>"
        f"<title>{html.escape(title)}</title><style>{_STYLE}</style><h1>{html.escape(title)}</h1>"
    ]
    for section in sections:
        parts += [f"<h2>{html.escape(section.title)}</h2>"] if section.title else []
        parts += [f"<p>{html.escape(paragraph)}</p>" for paragraph in section.text]
        if section.table is not None:
            parts.append(f"<table>{_row('th', section.table.head)}")
            parts += [_row("td", row) for row in section.table.rows]
            parts.append("</table>")
        parts += [f"<p>{html.escape(section.note)}</p>"] if section.note else []
        parts += [_drawn(plot) for plot in section.plots]
        parts += [_pictured(group) for group in section.cards if group.cards]
        if section.code:
            lines = "".join(f"<li><code>{html.escape(c)}</code></li>" for c in section.code)
            parts.append(f"<ul>{lines}</ul>")
    return "\n".join(parts) + "\n"


def _row(kind: str, cells: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<{kind}>{html.escape(c)}</{kind}>" for c in cells) + "</tr>"


def _drawn(plot: PagePlot) -> str:
    data = base64.b64encode(plot.png).decode()
    return f'<p><img alt="{html.escape(plot.about)}" src="data:image/png;base64,{data}"></p>'


def _pictured(group: PageCardGroup) -> str:
    figures = "".join(
        f'<figure><img alt="" src="data:image/webp;base64,{card.webp}">'
        f"<figcaption>{'<br>'.join(html.escape(line) for line in card.lines)}</figcaption></figure>"
        for card in group.cards
    )
    title, cards = html.escape(group.title), f"<div class=cards>{figures}</div>"
    if group.is_open:
        return f"<h3>{title}</h3>{cards}"
    return f"<details><summary>{title}</summary>{cards}</details>"
