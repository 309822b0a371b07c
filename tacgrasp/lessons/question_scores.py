"""How many answers to a file of questions are right, and what trivial answers would reach.

Every contestant answers the same questions about the same scenes:

    the asked model
    no, yes, unknowable    one text to each question
    most frequent          by family, the answer that is right in most scenes
    truth in words         the truth itself, to test the file and the scorer
    grammar                the grammar's own answers, where it has the wording

Not here: the model and the contacts (``tacgrasp.training.question_evaluation``).
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import mannwhitneyu

from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.facts import truth_in_words
from tacgrasp.lessons.dialogue.families.catalogue import understand
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.dialogue.scoring.answer_scores import AnswerScore, score_answer
from tacgrasp.lessons.dialogue.scoring.question_file import UNDECIDABLE, QuestionRow
from tacgrasp.lessons.dialogue.scoring.truth_units import unit_of

CONFIDENCE_GROUPS = 10


@dataclass(frozen=True, slots=True, kw_only=True)
class AskedQuestion:
    """A question about one contact.

    Attributes:
        row: The question.
        contact: Number of the contact.
        scene: What it is asked about.
    """

    row: QuestionRow
    contact: int
    scene: AskedScene


@dataclass(frozen=True, slots=True, kw_only=True)
class ScoredAnswer:
    """An answer to a question, with its score."""

    asked: AskedQuestion
    text: str
    score: AnswerScore


@dataclass(frozen=True, slots=True, kw_only=True)
class QuestionFigures:
    """Figures of some answers; None where there is no such question.

    Attributes:
        right: Fraction of right answers where decidable.
        right_kind: Fraction of answers of the right kind, of all.
        undecidable: Fraction of undecidable questions that are answered as such.
        decidable_n, undecidable_n: Their numbers.
        close_n: Number of questions left out, too near to their threshold.
    """

    right: float | None
    right_kind: float | None
    undecidable: float | None
    decidable_n: int
    undecidable_n: int
    close_n: int


def ask_all(
    rows: Sequence[QuestionRow], scenes: Sequence[AskedScene], per_question: int
) -> list[AskedQuestion]:
    """Every question about ``per_question`` scenes, which take turns."""
    num = min(per_question, len(scenes))
    return [
        AskedQuestion(row=row, contact=contact, scene=scenes[contact])
        for place, row in enumerate(rows)
        for contact in (((place * num) + i) % len(scenes) for i in range(num))
    ]


def answer_all(
    asked: Sequence[AskedQuestion], contestant: Callable[[AskedQuestion], str | None]
) -> list[ScoredAnswer]:
    """Score a contestant's answers; questions that it passes (None) are left out."""
    scored = []
    for one in asked:
        text = contestant(one)
        if text is not None:
            score = score_answer(text, one.row, one.scene)
            scored.append(ScoredAnswer(asked=one, text=text, score=score))
    return scored


def figures(answers: Sequence[ScoredAnswer]) -> QuestionFigures:
    """Figures of some answers."""
    counted = [each.score for each in answers if not each.score.is_close]
    decidable = [score for score in counted if score.decidable]
    undecidable = [score for score in counted if not score.decidable]
    return QuestionFigures(
        right=_mean([score.right for score in decidable]),
        right_kind=_mean([score.right_kind for score in counted]),
        undecidable=_mean([score.right for score in undecidable]),
        decidable_n=len(decidable),
        undecidable_n=len(undecidable),
        close_n=len(answers) - len(counted),
    )


def confidence_figures(
    answers: Sequence[ScoredAnswer], confidences: Sequence[float]
) -> dict[str, float | None]:
    """How far confidences are from the fraction of right answers, and whether they order them.

    Args:
        answers: The answers; those to undecidable questions and those too near to a threshold don't
            count.
        confidences: Of each answer.

    Returns:
        ``calibration_error``: mean distance of confidence and fraction right in ten groups of
        ascending confidence. ``auroc``: chance that a right answer has more confidence than a
        wrong one; None where all are right, or all wrong.
    """
    counted = [
        (confidence, each.score.right)
        for each, confidence in zip(answers, confidences, strict=True)
        if each.score.decidable and not each.score.is_close
    ]
    if not counted:
        return {"calibration_error": None, "auroc": None}
    sure, right = (np.array(column, dtype=np.float64) for column in zip(*counted, strict=True))
    groups = np.array_split(np.argsort(sure, kind="stable"), min(CONFIDENCE_GROUPS, len(sure)))
    error = sum(len(g) * abs(sure[g].mean() - right[g].mean()) for g in groups) / len(sure)
    hits, misses = sure[right == 1], sure[right == 0]
    auroc = None
    if len(hits) and len(misses):
        statistic = mannwhitneyu(hits, misses).statistic
        auroc = float(statistic / (len(hits) * len(misses)))
    return {"calibration_error": float(error), "auroc": auroc}


def figures_by_family(answers: Sequence[ScoredAnswer]) -> Mapping[str, QuestionFigures]:
    """Figures of each family, in the order of the file."""
    groups: dict[str, list[ScoredAnswer]] = defaultdict(list)
    for each in answers:
        groups[each.asked.row.family].append(each)
    return {family: figures(group) for family, group in groups.items()}


def baselines(
    asked: Sequence[AskedQuestion],
) -> Mapping[str, Callable[[AskedQuestion], str | None]]:
    """Contestants that look at no contact, and the two that know the truth."""
    frequent = _most_frequent(asked)
    return {
        "no": lambda _: "No.",
        "yes": lambda _: "Yes.",
        "unknowable": lambda _: "I can't feel that.",
        "most frequent": lambda one: frequent[one.row.family],
        "truth in words": perfect_answer,
        "grammar": grammar_answer,
    }


def perfect_answer(asked: AskedQuestion) -> str:
    """The truth itself, in words."""
    if asked.row.kind in UNDECIDABLE:
        is_topic = asked.row.kind is AnswerKind.UNKNOWABLE
        return "I can't feel that." if is_topic else "I only answer about touch."
    texts = [truth_in_words(truth, unit_of(truth), asked.scene) for truth in asked.row.truths]
    return f"{'; '.join(dict.fromkeys(texts) if len(set(texts)) == 1 else texts)}."


def grammar_answer(asked: AskedQuestion) -> str | None:
    """The grammar's own answer from the true state; None where it lacks the wording."""
    meaning = understand(asked.row.question, before=asked.row.last)
    if meaning is None:
        return None
    return answer(meaning, asked.scene).text


def _most_frequent(asked: Sequence[AskedQuestion]) -> Mapping[str, str]:
    """By family, the truth in words that is right most often; of numbers the median one."""
    texts: dict[str, list[str]] = defaultdict(list)
    for one in asked:
        texts[one.row.family].append(perfect_answer(one))
    return {
        family: _median_text(asked, family) or Counter(some).most_common(1)[0][0]
        for family, some in texts.items()
    }


def _median_text(asked: Sequence[AskedQuestion], family: str) -> str:
    """Median of a family's numbers as text; '' where it does not ask for numbers."""
    mine = [one for one in asked if one.row.family == family]
    if any(one.row.kind is not AnswerKind.NUMBER for one in mine):
        return ""
    truths = [(one.row.truths[0], one.row.truths[0].evaluate(one.scene.values())) for one in mine]
    values = [float(truth.value) for _, truth in truths if isinstance(truth.value, (int, float))]
    unit = unit_of(truths[0][0])
    return f"{float(np.median(values)):.4f} {unit}." if values else ""


def _mean(flags: Sequence[bool]) -> float | None:
    return sum(flags) / len(flags) if flags else None
