"""The table of rated captions beside the paper's (appendix C), with answers to questions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.pages import PageSection, PageTable
from tacgrasp.pretraining.report.paper_numbers import PAPER_RATINGS
from tacgrasp.pretraining.report.store import (
    CAPTIONS,
    EVERY_NUMBER,
    EXACT_HEIGHTS,
    MOST_FREQUENT,
    SHUFFLED,
    TITLES,
    WORDS_ALONE,
    Groups,
    Result,
    means,
)

ROWS: Mapping[str, str] = {
    "cltp": "Tac3D-LLM",
    EVERY_NUMBER: TITLES[EVERY_NUMBER],
    WORDS_ALONE: TITLES[WORDS_ALONE],
    "point_bert": "PointBERT-LLM",
    "point_mae": "PointMAE-LLM",
    MOST_FREQUENT: TITLES[MOST_FREQUENT],
    SHUFFLED: TITLES[SHUFFLED],
    EXACT_HEIGHTS: TITLES[EXACT_HEIGHTS],
}
"""Rows that always stand there, by the method that pre-trained the encoder."""

PERCENTAGES = (*CLASSES, "numbers", "ranges", "malformed", "questions", "unseen_wordings")


def caption_section(groups: Groups) -> PageSection:
    """Our ratings, the paper's beside them, and '–' where nothing was measured."""
    measured: dict[str, list[Sequence[Result]]] = {}
    for (table, method, _, _), same in groups.items():
        if table == CAPTIONS:
            measured.setdefault(method, []).append(same)
    others = [method for method in measured if method not in ROWS]
    rows = []
    for method in (*ROWS, *others):
        title, paper = ROWS.get(method, f"{TITLES[method]}-LLM"), PAPER_RATINGS.get(method)
        found = [_row(title, paper, same) for same in measured.get(method, ())]
        rows += found or [_row(title, paper, ())]
    head = ["", "rating by rule", "rating by judge", "the paper's, by GPT-4"]
    head += ["numbers said", *(name.replace("_", " ") for name in PERCENTAGES)]
    return PageSection(
        title="Table C: captions, rated 1 to 5 (appendix C)",
        text=[
            "Rating by rule: 1 + 4 × the fraction of right ones among the five words and every "
            "number that is said; a number is right within 10 %, or 0.05 mm of depth, 0.5 mm of "
            "place, 0.1 N of force where that is more; 1 for a text that is no caption. An "
            "interval in the place of a number counts neither way: beside it stand the captions "
            "with every number, and the words alone. Numbers said are the mean of a caption, of "
            "five; of ranges, the percentage with the truth. The rest is in % right, but for "
            "malformed captions; – where nothing was measured."
        ],
        table=PageTable(head=[*head, "language model", "contacts"], rows=rows),
        note="Contacts: the split contact_noisy. PointBERT-LLM and PointMAE-LLM are trained by "
        "`tacgrasp train llm --encoder` behind those encoders, frozen, with state heads fitted on "
        "them. 'Of data …' are language models that learned from another data set than this one. "
        "Most frequent caption: the training split's, with its median numbers. Exact heights: what "
        "an observer says who sees every height under the same errors of a unit, knows where the "
        "contact is, and believes the heights; shape and texture are given. Questions: in "
        "wordings of the grammar, and in wordings that were kept out of training.",
    )


def _row(title: str, paper: float | None, same: Sequence[Result]) -> list[str]:
    values = means(same) if same else {}
    judges = sorted({result.judge for result in same} - {""})
    judged = _number(values.get("judge"), 2)
    cells = [
        title,
        _number(values.get("rating"), 2),
        f"{judged} ({', '.join(judges)})" if judges else judged,
        _number(paper, 2),
        _number(values.get("numbers_said"), 1),
        *(_number(values.get(name), 1) for name in PERCENTAGES),
    ]
    if not same:
        return [*cells, "not measured" if title not in _TRIVIAL else "–", "–"]
    return [*cells, same[0].variant or "–", str(same[0].contacts)]


_TRIVIAL = [
    TITLES[name] for name in (MOST_FREQUENT, SHUFFLED, EXACT_HEIGHTS, EVERY_NUMBER, WORDS_ALONE)
]


def _number(value: float | None, digits: int) -> str:
    return "–" if value is None else f"{value:.{digits}f}"
