"""Retrieval as a demonstration: contacts most similar to a text, texts most similar to a contact.

On a terminal, and as one HTML page with pictures. How often the right one is found is measured in
``tacgrasp.pretraining.evaluate``.
"""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import torch
from rich.console import Console
from rich.table import Table

from cltp.atomic_write import write_atomically
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.evaluation.zero_shot import nearest_contacts, nearest_texts
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.checkpoints import stored
from tacgrasp.pretraining.evaluate import captions_of
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.report.failures import small_picture

_BAR = 24
_PICTURE_PX = 224


@dataclass(frozen=True, slots=True, kw_only=True)
class Likeness:
    """Something found, and how near it is.

    Attributes:
        what: A caption: of the contact found, or the text found.
        cosine: Nearness.
        contact: Number in its split; None for a text.
        object: What was pressed; None for a text.
        own: Whether it is the caption of the contact that was asked for.
    """

    what: str
    cosine: float
    contact: int | None = None
    object: str | None = None
    own: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class RetrievalMatches:
    """What was found for one question.

    Attributes:
        asked: The text, or the caption of the contact.
        contact: Its number, where a contact was asked for.
        rank: EvaluationRun of the contact's own caption among all; None where a text was asked for.
        among: How many contacts or texts there are.
        split: Whose contacts.
        about: For people: what the trial is.
        found: Nearest first.
    """

    asked: str
    contact: int | None
    rank: int | None
    among: int
    split: Split
    about: str
    found: list[Likeness]


def find(
    place: EvaluationRun,
    *,
    text: str | None,
    contact: int | None,
    count: int = 5,
    method: str = "cltp",
) -> RetrievalMatches:
    """The contacts most similar to a text, or the texts most similar to a contact.

    Raises:
        UsageError: Neither or both were given, there is no such contact, or it was not trained.
        TouchError: Weights or data can't be used.
    """
    if (text is None) == (contact is None):
        raise UsageError("name a text or a contact (--contact N), one of them")
    if count < 1:
        raise UsageError(f"--count must be at least 1, got {count}")
    how = stored(method, place.weights)
    encoder, towers = how.encoder(), how.towers(place.weights)
    trial = place.trying()[0]
    seen = place.seen(encoder, trial.split, trial.noise)
    data = ContactDataset(place.data, split=trial.split)
    captions = captions_of(data, seen)
    if text is not None:
        near = [
            Likeness(
                what=captions[row],
                cosine=cosine,
                contact=int(seen.index[row]),
                object=str(data.column("object")[int(seen.index[row])]),
            )
            for row, cosine in nearest_contacts(towers, seen, text, count)
        ]
        return RetrievalMatches(
            asked=text,
            contact=None,
            rank=None,
            among=len(seen),
            split=trial.split,
            about=trial.about,
            found=near,
        )
    rows = torch.eq(seen.index, contact if contact is not None else -1).nonzero()
    if not len(rows):
        raise UsageError(
            f"no contact {contact} in {trial.name}; it has 0 to {int(seen.index.max())}"
        )
    row, texts = int(rows[0, 0]), sorted(set(captions))
    every = nearest_texts(towers, seen.feature[row], texts, len(texts))
    rank = next(n for n, (said, _) in enumerate(every, start=1) if said == captions[row])
    return RetrievalMatches(
        asked=captions[row],
        contact=contact,
        rank=rank,
        among=len(texts),
        split=trial.split,
        about=trial.about,
        found=[
            Likeness(what=said, cosine=cosine, own=said == captions[row])
            for said, cosine in every[:count]
        ],
    )


def show_answer(answer: RetrievalMatches, to: Console) -> None:
    """Print what was found, nearest first; a bar as long as the cosine."""
    to.print(_heading(answer), markup=False, highlight=False)
    table = Table(box=None, pad_edge=False)
    table.add_column("", justify="right", style="dim")
    table.add_column("cosine", justify="right")
    table.add_column("", style="cyan", no_wrap=True)
    if answer.contact is None:
        table.add_column("contact", justify="right")
        table.add_column("object")
    table.add_column("caption" if answer.contact is None else "text")
    for place, one in enumerate(answer.found, start=1):
        cells = [str(place), f"{one.cosine:.3f}", "━" * round(_BAR * max(0.0, one.cosine))]
        if answer.contact is None:
            cells += [str(one.contact), one.object or ""]
        table.add_row(*cells, one.what, style="bold green" if one.own else None)
    to.print(table, markup=False)


def _heading(answer: RetrievalMatches) -> str:
    if answer.contact is None:
        return f"“{answer.asked}”: the nearest of {answer.among} contacts ({answer.about})"
    return (
        f"contact {answer.contact} ({answer.about}) is: {answer.asked}\n"
        f"its own words are number {answer.rank} of {answer.among} texts"
    )


_STYLE = (
    "body{font:15px/1.4 sans-serif;max-width:70em;margin:2em auto;padding:0 1em;color:#222}"
    "h1{font-size:1.3em}.cards{display:flex;flex-wrap:wrap;gap:1em}figure{margin:0;width:224px}"
    "img{width:224px;border-radius:4px}.bar{height:5px;background:#2a78b8;border-radius:2px}"
    "li{margin:.4em 0}.own{font-weight:bold;color:#1a7a35}small{color:#666}"
)


def write_page(folder: Path, answers: Sequence[RetrievalMatches], path: Path) -> None:
    """Write what was found as one HTML page that needs nothing else.

    Args:
        folder: The data set, for pictures.
        answers: What was found.
        path: The page, overwritten.

    Raises:
        UsageError: It can't be written.
        TouchError: The data are damaged.
    """
    parts = [
        "<!doctype html><html lang=en><meta charset=utf-8>"
        "<meta name=viewport content='width=device-width, initial-scale=1'>"
        f"<title>Touch and language</title><style>{_STYLE}</style>"
    ]
    for answer in answers:
        data = ContactDataset(folder, split=answer.split)
        heading = "<br>".join(html.escape(line) for line in _heading(answer).splitlines())
        parts.append(f"<h1>{heading}</h1>")
        if answer.contact is not None:
            parts.append(_image(data, answer.contact, answer.asked))
            parts += ["<ol>", *(f"<li{_own(one)}>{_words(one)}" for one in answer.found), "</ol>"]
            continue
        parts.append("<div class=cards>")
        for one in answer.found:
            image = _image(data, one.contact or 0, one.what)
            bar = f"<div class=bar style='width:{100 * max(0.0, one.cosine):.0f}%'></div>"
            named = f"<small>contact {one.contact}, {html.escape(one.object or '')}</small>"
            parts.append(
                f"<figure>{image}{bar}<figcaption>{_words(one)}<br>{named}</figcaption></figure>"
            )
        parts.append("</div>")
    try:
        write_atomically(path, "\n".join(parts) + "\n")
    except OSError as error:
        raise UsageError(f"the page can't be written to {path}: {error.strerror}") from None


def _own(one: Likeness) -> str:
    return " class=own" if one.own else ""


def _words(one: Likeness) -> str:
    return f"{one.cosine:.3f} {html.escape(one.what)}"


def _image(data: ContactDataset, index: int, alt: str) -> str:
    drawn = small_picture(data, index, _PICTURE_PX)
    return f'<img alt="{html.escape(alt)}" src="data:image/webp;base64,{drawn}">'
