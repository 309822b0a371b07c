"""Retrieval as a demonstration: contacts nearest to a text, or texts nearest to a contact.

Printed on a terminal and written as one HTML page with pictures. How often the right one is found
is measured in ``tacgrasp.pretraining.evaluate``.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from cltp.atomic_write import write_atomically
from cltp.data.dataset import ContactDataset
from cltp.evaluation.retrieval import nearest_contacts, nearest_texts
from cltp.evaluation.splits import EvaluationSplit
from tacgrasp.base.errors import UsageError
from tacgrasp.base.html_page import render_page
from tacgrasp.pretraining.checkpoints import find_method
from tacgrasp.pretraining.evaluate import captions_of
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.report.failures import small_picture

_BAR = 24
_PICTURE_PX = 224


@dataclass(frozen=True, slots=True, kw_only=True)
class RetrievalMatch:
    """A retrieved contact or text.

    Attributes:
        text: The text, or the caption of the contact.
        cosine: Cosine with the query.
        contact: Number of the contact in its split; None for a text.
        object: Name of the pressed object; None for a text.
        is_own: Whether it is the caption of the contact that is the query.
    """

    text: str
    cosine: float
    contact: int | None = None
    object: str | None = None
    is_own: bool = False


@dataclass(frozen=True, slots=True)
class RetrievalMatches:
    """What one query retrieved.

    Attributes:
        query: The text, or the caption of the contact.
        contact: Number of the contact; None for a text.
        rank: Rank of the contact's own caption among all; None for a text.
        among: Number of contacts or texts to choose from.
        split: Evaluation split of the contacts.
        matches: The nearest, best first.
    """

    query: str
    contact: int | None
    rank: int | None
    among: int
    split: EvaluationSplit
    matches: list[RetrievalMatch]


def find_matches(
    run: EvaluationRun,
    *,
    text: str | None,
    contact: int | None,
    count: int = 5,
    method: str = "cltp",
) -> RetrievalMatches:
    """Retrieve the contacts nearest to a text, or the texts nearest to a contact.

    Raises:
        UsageError: Neither or both were given, there is no such contact, or it was not trained.
        TouchError: Weights or data can't be used.
    """
    if (text is None) == (contact is None):
        raise UsageError("name a text or a contact (--contact N), one of them")
    if count < 1:
        raise UsageError(f"--count must be at least 1, got {count}")
    trained = find_method(method, run.weights)
    encoder, towers = trained.encoder(), trained.towers(run.weights)
    split = run.evaluation_splits()[0]
    encoded = run.encode(encoder, split)
    data = ContactDataset(run.data, split=split.split)
    captions = captions_of(data, encoded)
    if text is not None:
        matches = [
            RetrievalMatch(
                text=captions[row],
                cosine=cosine,
                contact=int(encoded.index[row]),
                object=str(data.column("object")[int(encoded.index[row])]),
            )
            for row, cosine in nearest_contacts(towers, encoded, text, count)
        ]
        return RetrievalMatches(text, None, None, len(encoded), split, matches)
    if contact not in encoded.index.tolist():
        raise UsageError(
            f"no contact {contact} in {split.name}; it has 0 to {int(encoded.index.max())}"
        )
    row, texts = encoded.index.tolist().index(contact), sorted(set(captions))
    nearest = nearest_texts(towers, encoded.feature[row], texts, len(texts))
    rank = [one for one, _ in nearest].index(captions[row]) + 1
    matches = [
        RetrievalMatch(text=one, cosine=cosine, is_own=one == captions[row])
        for one, cosine in nearest[:count]
    ]
    return RetrievalMatches(captions[row], contact, rank, len(texts), split, matches)


def print_matches(matches: RetrievalMatches, console: Console) -> None:
    """Print matches, nearest first, each with a bar as long as its cosine."""
    console.print(_heading(matches), markup=False, highlight=False)
    of_text = matches.contact is None
    table = Table(box=None, pad_edge=False)
    table.add_column("", justify="right", style="dim")
    table.add_column("cosine", justify="right")
    table.add_column("", style="cyan", no_wrap=True)
    if of_text:
        table.add_column("contact", justify="right")
        table.add_column("object")
    table.add_column("caption" if of_text else "text")
    for rank, match in enumerate(matches.matches, start=1):
        cells = [str(rank), f"{match.cosine:.3f}", "━" * round(_BAR * max(0.0, match.cosine))]
        if of_text:
            cells += [str(match.contact), match.object or ""]
        table.add_row(*cells, match.text, style="bold green" if match.is_own else None)
    console.print(table, markup=False)


def _heading(matches: RetrievalMatches) -> str:
    if matches.contact is None:
        return f"“{matches.query}”: the nearest of {matches.among} contacts ({matches.split.about})"
    return (
        f"contact {matches.contact} ({matches.split.about}) is: {matches.query}\n"
        f"its own words are number {matches.rank} of {matches.among} texts"
    )


def write_page(folder: Path, matches: RetrievalMatches, path: Path) -> None:
    """Write the matches as one HTML page with pictures.

    Args:
        folder: Data set that the pictures are drawn from.
        matches: Result of ``find_matches``.
        path: HTML file, overwritten.

    Raises:
        UsageError: The page can't be written.
        TouchError: The data are damaged.
    """
    data = ContactDataset(folder, split=matches.split.split)

    def picture(index: int | None) -> str | None:
        return None if index is None else small_picture(data, index, _PICTURE_PX)

    page = render_page(
        "pretraining/templates/retrieval.html",
        title="Touch and language",
        heading=_heading(matches),
        query=matches.query,
        picture=picture(matches.contact),
        matches=matches.matches,
        pictures=[picture(match.contact) for match in matches.matches],
    )
    try:
        write_atomically(path, page)
    except OSError as error:
        raise UsageError(f"the page can't be written to {path}: {error.strerror}") from None
