"""Questions of two parts that no grammar has whole: each part is read by itself.

Not here: parts that the grammar and the rules read (``tacgrasp.lessons.joined_questions``).
"""

from __future__ import annotations

import re
from collections.abc import Callable

from tacgrasp.lessons.dialogue.meaning import Several
from tacgrasp.lessons.dialogue.query import asked_text, query_of
from tacgrasp.lessons.joined_questions import JOINT, REQUEST, joinable, together
from tacgrasp.lessons.read_question import ReadQuestion

PARTS_FROM = 0.4
"""Confidence from which two questions, each read by itself, are preferred to what the model makes
of both together. Our choice, by questions that are not the kept-out ones."""

ADDED_FROM = 0.5
"""Confidence from which a part is added to one that the grammar knows. Our choice."""

MOST_DIVIDED = 3
"""Most places where a question is divided in two. Our choice: a pasted page would take seconds."""

Reader = Callable[[str], ReadQuestion | None]

_HALF_SAID = re.compile(r"\b(?:between|both|from)\b[^,;?.]*$", re.I)
"""What 'and' goes on with: 'between the limit', 'from the middle'."""


def divided(question: str, whole: ReadQuestion, known: Reader, read: Reader) -> ReadQuestion | None:
    """What two questions ask that are joined in one, each read by itself; None where one is not.

    They are preferred to a model's several parts, and to one part where the grammar knows another.
    A comma alone may stand before an addition: 'the force, in plain newtons'.

    Args:
        question: The question.
        whole: What a model makes of all of it.
        known: Reads a part by the grammar.
        read: Reads a part that the grammar lacks, which takes longer.
    """
    question = REQUEST.sub("", question, count=1)
    num_parts = len(whole.meaning.parts) if isinstance(whole.meaning, Several) else 1
    joints = [
        joint
        for joint in JOINT.finditer(question)
        if joint[0].strip() != "," and not _HALF_SAID.search(question[: joint.start()])
    ]
    best: ReadQuestion | None = None
    for joint in joints[:MOST_DIVIDED]:
        texts = [
            text for text in (question[: joint.start()], question[joint.end() :]) if text.strip()
        ]
        found = [known(text) for text in texts]
        if num_parts == 1 and not any(found):
            continue
        either = (part or read(text) for part, text in zip(found, texts, strict=True))
        told = [part for part in either if part is not None and joinable(part.meaning)]
        sure = [part.confidence for part in told]
        least = PARTS_FROM if num_parts > 1 else ADDED_FROM
        if (
            len(told) < 2
            or min(sure) < least
            or (best is not None and min(sure) <= best.confidence)
        ):
            continue
        parts = [one for part in told for one in joinable(part.meaning)]
        try:
            query = query_of(meaning := together(parts), asked_text(question).numbers)
        except ValueError:  # more parts than a query has, or a number that is no number of it
            continue
        joined = ReadQuestion(query, meaning, min(sure))
        if _asks_more(joined, whole) if num_parts == 1 else len(parts) <= num_parts:
            best = joined
    return best


def _asks_more(joined: ReadQuestion, read: ReadQuestion) -> bool:
    """Whether a reading has all parts of another one, and more."""
    parts, fewer = (set(each.query.rstrip(".").split("; ")) for each in (joined, read))
    return fewer < parts
