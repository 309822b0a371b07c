"""What a report page consists of: sections of text, tables, plots and pictured contacts; Markdown.

The same sections fill the HTML template (``pretraining/templates/report.html``), a file that needs
no other. The plots of the Markdown page are files beside it; it has no pictured contacts and points
to the HTML page. Not here: what a report says (``report``, ``tables``, ``failure_sections``).
"""

from __future__ import annotations

import base64
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

    @property
    def text_columns(self) -> set[int]:
        """Columns with sentences, which are wrapped."""
        return {column for row in self.rows for column, cell in enumerate(row) if len(cell) > 40}


@dataclass(frozen=True, slots=True, kw_only=True)
class PagePlot:
    """A drawing.

    Attributes:
        name: Name of its file, without the ending.
        about: Text in place of the image.
        png: Bytes of the image.
    """

    name: str
    about: str
    png: bytes

    @property
    def base64(self) -> str:
        return base64.b64encode(self.png).decode()


@dataclass(frozen=True, slots=True, kw_only=True)
class PageCard:
    """A contact with its picture.

    Attributes:
        webp: The picture, WebP in base64.
        lines: Text below it.
    """

    webp: str
    lines: list[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class PageCardGroup:
    """Cards below one title, unfolded or not."""

    title: str
    cards: list[PageCard]
    is_open: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class PageSection:
    """A part of a report.

    Attributes:
        title: Heading; none when empty.
        text: Paragraphs.
        table: The table below them.
        note: Remark below the table.
        plots: Drawings.
        cards: Pictured contacts, in the HTML page alone.
        code: Commands, one a line.
    """

    title: str
    text: list[str] = field(default_factory=list)
    table: PageTable | None = None
    note: str = ""
    plots: list[PagePlot] = field(default_factory=list)
    cards: list[PageCardGroup] = field(default_factory=list)
    code: list[str] = field(default_factory=list)


def markdown(title: str, sections: Sequence[PageSection], *, plots: str, html_page: str) -> str:
    """Write sections as Markdown.

    Args:
        title: First heading.
        sections: Contents of the page.
        plots: Folder of the plots, relative to the page.
        html_page: The HTML page, relative to it.
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
            lines += ["", f"Pictures: [{html_page}]({html_page})."]
        lines += ["", *(f"- `{line}`" for line in section.code)] if section.code else []
    return "\n".join(lines) + "\n"


def _markdown_table(table: PageTable) -> Iterator[str]:
    yield f"| {' | '.join(table.head)} |"
    yield f"|{'---|' * len(table.head)}"
    for row in table.rows:
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"
