"""What a report page consists of: sections of text, tables, plots and pictured contacts.

The same sections fill two templates. ``pretraining/templates/report.html`` becomes a file that
needs no other. The plots of the Markdown page (``report.md.txt``) are files beside it; it has no
pictured contacts and points to the HTML page. Not here: what a report says (``report``, ``tables``,
``failure_sections``).
"""

from __future__ import annotations

import base64
from dataclasses import dataclass, field

from tacgrasp.pretraining.report.failures import Failure


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
class PageCardGroup:
    """Pictured contacts below one title, unfolded or not."""

    title: str
    cards: list[Failure]
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

    @property
    def is_empty(self) -> bool:
        """Whether nothing stands below the heading."""
        return not (self.text or self.table or self.plots or self.cards or self.code)
