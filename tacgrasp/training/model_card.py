"""Print the figures of ``tacgrasp eval``, and write them into the model card.

Not here: measuring (``tacgrasp.training.evaluate``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from cltp.atomic_write import write_atomically
from cltp.tactile.states import CLASSES, MEASURABLE
from tacgrasp.base.errors import UsageError

CARD = "README.md"
HEADING = "## Scores"


def show(figures: Mapping[str, Any], console: Console) -> None:
    """Print every table."""
    captions, answers = figures["captions"], figures["answers"]
    slots = _table(
        f"captions: % right, {captions['contacts']} unseen contacts, noisy", "", *CLASSES
    )
    for name, accuracy in _methods(captions):
        slots.add_row(name, *(_percent(accuracy[slot]) for slot in CLASSES))
    slots.add_row("zero-shot", *(_percent(figures["zero_shot"][slot]) for slot in CLASSES))
    console.print(slots)
    console.print(
        "geometric baseline: computed directly from the same 1024 points "
        f"({', '.join(MEASURABLE)}); zero-shot: CLTP, nearest prompt"
    )
    errors = _table(
        "numbers: median error", "", "depth mm", "position mm", "area % of sensing area", "force %"
    )
    for name, numbers in _methods(figures["numbers"]):
        values = zip(numbers.values(), (3, 2, 1, 0), strict=True)
        errors.add_row(name, *("-" if v is None else f"{v:.{digits}f}" for v, digits in values))
    console.print(errors)
    asked = _table(
        f"answers: % right, {answers['contacts']} unseen contacts", "wordings", *answers["held_out"]
    )
    for name in ("held_out", "trained"):
        asked.add_row(name.replace("_", " "), *map(_percent, answers[name].values()))
    console.print(asked)
    for kind, goals in figures["advice"].items():
        _show_advice(f"{goals['cases']} drawn goals, {kind} contacts: % right", goals, console)
    for kind, pairs in figures["instruction_pairs"].items():
        title = f"{pairs['pairs']} instruction pairs, {kind} contacts: % right"
        _show_advice(title, pairs, console)
    for kind, wordings in figures["paraphrases"].items():
        _show_wordings(kind, wordings, console)
    console.print(
        "rules: the teacher on the measured state; clear: noise does not decide the answer"
    )
    clip = figures["clip_retrieval"]
    console.print(
        f"CLIP retrieval among {clip['among']:.0f}: image to text "
        f"{_percent(clip['image_to_text'])}, text to image {_percent(clip['text_to_image'])}, "
        f"chance {_percent(clip['chance'])}"
    )


def _show_advice(title: str, figures: Mapping[str, Any], console: Console) -> None:
    both = figures.get("both_right")  # of pairs alone
    answers = (f"{answer} ({count})" for answer, count in figures["answers"].items())
    table = _table(title, "", "right", *(["both right"] if both else []), *answers)
    for name, right in figures["right"].items():
        by_answer = (figures["right_by_answer"][name].get(answer) for answer in figures["answers"])
        firsts = [right] if both is None else [right, both[name]]
        table.add_row(name, *map(_percent, (*firsts, *by_answer)))
    console.print(table)


def _show_wordings(kind: str, figures: Mapping[str, Any], console: Console) -> None:
    title = f"{figures['wordings']} kept-out instructions, {figures['cases']} {kind} contacts"
    table = _table(f"{title}: % right", "", "right", *figures["right_by_expect"]["llm"])
    for name, right in figures["right"].items():
        table.add_row(name, *map(_percent, (right, *figures["right_by_expect"][name].values())))
    console.print(table)


def card_scores(figures: Mapping[str, Any]) -> Iterator[tuple[str, float | None]]:
    """The figures of a model card, by name."""
    for name, accuracy in _methods(figures["captions"]):
        yield from ((f"captions, {name}, {slot}", value) for slot, value in accuracy.items())
    yield from ((f"zero-shot, {slot}", value) for slot, value in figures["zero_shot"].items())
    for name, errors in _methods(figures["numbers"]):
        yield from ((f"median error, {name}, {error}", value) for error, value in errors.items())
    for slot, value in figures["answers"]["held_out"].items():
        yield f"answers to held-out wordings, {slot}", value
    titles = {
        "advice": "drawn goals",
        "instruction_pairs": "instruction pairs",
        "paraphrases": "kept-out instructions",
    }
    for key, title in titles.items():
        for kind in ("clear", "any"):
            for name, value in figures[key][kind]["right"].items():
                yield f"{title}, {kind} contacts, {name}", value
    for name in ("image_to_text", "text_to_image"):
        yield f"CLIP retrieval, {name.replace('_', ' ')}", figures["clip_retrieval"][name]


def write_scores(weights: Path, figures: Mapping[str, Any]) -> None:
    """Write the scores into the model card of a folder, in the place of earlier ones.

    Raises:
        UsageError: There is no card, or it can't be written.
    """
    card = weights / CARD
    try:
        above = card.read_text(encoding="utf-8").split(HEADING)[0].rstrip()
        source = f"By `tacgrasp eval`, data {figures['data_checksum']}."
        lines = [above, "", HEADING, "", source, "", "| | |", "|---|---|"]
        scores = card_scores(figures)
        lines += [f"| {name} | {value:.4g} |" for name, value in scores if value is not None]
        write_atomically(card, "\n".join(lines) + "\n")
    except OSError as error:
        raise UsageError(f"the model card {card} can't be written: {error.strerror}") from None


def _methods(figures: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, float | None]]]:
    """Title and figures of the model, of the heads and of the geometric baseline."""
    for name in ("llm", "heads", "geometric_baseline"):
        yield name.replace("_", " "), figures[name]


def _table(title: str, first: str, *columns: str) -> Table:
    table = Table(title=title)
    table.add_column(first)
    for name in columns:
        table.add_column(name, justify="right")
    return table


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{100 * value:.1f} %"
