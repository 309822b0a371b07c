"""Print what ``tacgrasp eval`` found, and write its figures into the model card.

Not here: measuring (``tacgrasp.training.evaluate``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from cltp.tactile.states import CLASSES, MEASURABLE
from tacgrasp.base.errors import UsageError

CARD = "README.md"
HEADING = "## Scores"


def show(found: Mapping[str, Any], to: Console) -> None:
    """Print every table."""
    captions = found["captions"]
    slots = Table(title=f"captions: share right, {captions['contacts']} unseen contacts, noisy")
    _columns(slots, "", *CLASSES)
    for who in ("llm", "heads", "ceiling"):
        slots.add_row(who, *(_percent(captions[who][slot]) for slot in CLASSES))
    slots.add_row("zero-shot", *(_percent(found["zero_shot"][slot]) for slot in CLASSES))
    to.print(slots)
    to.print(
        f"ceiling: computed directly from the same 1024 points ({', '.join(MEASURABLE)}); "
        "zero-shot: CLTP, nearest prompt"
    )
    errors = Table(title="numbers: median error")
    _columns(errors, "", "depth mm", "position mm", "area % of field", "force %")
    for who, numbers in found["numbers"].items():
        places = (3, 2, 1, 0)
        values = zip(numbers.values(), places, strict=True)
        errors.add_row(who, *("-" if v is None else f"{v:.{p}f}" for v, p in values))
    to.print(errors)
    answers = Table(title=f"answers: share right, {found['answers']['contacts']} unseen contacts")
    _columns(answers, "wordings", *found["answers"]["held_out"])
    for name in ("held_out", "trained"):
        row = found["answers"][name].values()
        answers.add_row(name.replace("_", " "), *map(_percent, row))
    to.print(answers)
    _show_pairs(found["instruction_pairs"], to)
    _show_paraphrases(found["paraphrases"], to)
    clip = found["clip_retrieval"]
    to.print(
        f"CLIP retrieval among {clip['among']:.0f}: image to text "
        f"{_percent(clip['image_to_text'])}, text to image {_percent(clip['text_to_image'])}, "
        f"chance {_percent(clip['chance'])}"
    )


def _show_pairs(kinds: Mapping[str, Any], to: Console) -> None:
    for kind, pairs in kinds.items():
        table = Table(title=f"{pairs['pairs']} instruction pairs, {kind} contacts: share right")
        _columns(table, "", "right", "both right", *(f"{a} ({n})" for a, n in
                 pairs["answers"].items()))  # fmt: skip
        for who, right in pairs["right"].items():
            by_answer = (pairs["right_by_answer"][who].get(a) for a in pairs["answers"])
            table.add_row(
                who, _percent(right), _percent(pairs["both_right"][who]), *map(_percent, by_answer)
            )
        to.print(table)
    to.print("rules: the teacher on the measured state; clear: noise does not decide the answer")


def _show_paraphrases(kinds: Mapping[str, Any], to: Console) -> None:
    for kind, found in kinds.items():
        table = Table(
            title=f"{found['wordings']} paraphrases, {found['cases']} {kind} contacts: share right"
        )
        _columns(table, "", "right", "naming an object", "naming none")
        for who in found["right"]:
            kept = (found[k][who] for k in ("right", "naming_an_object", "naming_no_object"))
            table.add_row(who, *map(_percent, kept))
        to.print(table)


def card_scores(found: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """The figures of a model card, by name."""
    for who in ("llm", "heads", "ceiling"):
        for slot, value in found["captions"][who].items():
            yield f"captions, {who}, {slot}", value
    for slot, value in found["zero_shot"].items():
        yield f"zero-shot, {slot}", value
    for who, errors in found["numbers"].items():
        for name, value in errors.items():
            yield f"median error, {who}, {name}", value
    for slot, value in found["answers"]["held_out"].items():
        yield f"answers to held-out wordings, {slot}", value
    for kind in ("clear", "any"):
        for who, value in found["instruction_pairs"][kind]["right"].items():
            yield f"instruction pairs, {kind} contacts, {who}", value
        for part in ("right", "naming_an_object", "naming_no_object"):
            value = found["paraphrases"][kind][part]["llm"]
            yield f"paraphrases, {kind} contacts, {part.replace('_', ' ')}", value
    for name in ("image_to_text", "text_to_image"):
        yield f"CLIP retrieval, {name.replace('_', ' ')}", found["clip_retrieval"][name]


def write_scores(weights: Path, found: Mapping[str, Any]) -> None:
    """Put the scores into the model card of a folder, in place of those that it has.

    Raises:
        UsageError: There is no card, or it can't be written.
    """
    card = weights / CARD
    try:
        above = card.read_text(encoding="utf-8").split(HEADING)[0].rstrip()
        checksum = found["data_checksum"]
        lines = [above, "", HEADING, "", f"By `tacgrasp eval`, data {checksum}.", ""]
        lines += ["| | |", "|---|---|"]
        lines += [f"| {name} | {value:.4g} |" for name, value in card_scores(found)
                  if value is not None]  # fmt: skip
        card.write_text("\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise UsageError(f"the model card {card} can't be written: {error.strerror}") from None


def _columns(table: Table, *names: str) -> None:
    for number, name in enumerate(names):
        table.add_column(name, justify="right" if number else "left")


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{100 * value:.1f} %"
