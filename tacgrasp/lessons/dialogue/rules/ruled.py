"""The meaning of a question that a rule reads."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.query import asked_text, read_query
from tacgrasp.lessons.dialogue.rules.edges import edge_query
from tacgrasp.lessons.dialogue.rules.loads import load_query
from tacgrasp.lessons.dialogue.rules.others import other_query
from tacgrasp.lessons.dialogue.written_units import numbers_in_units


def ruled(question: str) -> Meaning | None:
    """What a question of one clause means by a rule; None where none reads it.

    Args:
        question: The question, as ``tacgrasp.lessons.dialogue.plainer`` leaves it.
    """
    asked = asked_text(question)
    query = load_query(asked.words) or edge_query(asked.words) or other_query(asked.words)
    if not query:
        return None
    numbers = numbers_in_units(query, asked.words, asked.numbers)
    return None if numbers is None else read_query(query, numbers)
