"""Questions of two parts, each read by itself."""

import pytest

from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.lessons.divided_questions import divided
from tacgrasp.lessons.read_question import ReadQuestion


def read_as(query: str, confidence: float = 1.0) -> ReadQuestion:
    meaning = read_query(query)
    assert meaning is not None
    return ReadQuestion(query, meaning, confidence)


PARTS = {
    "how far has it sunk in": read_as("amount depth mm.", 0.6),
    "what form does it have?": read_as("word shape.", 0.7),
    "is it round": read_as("check shape sphere."),
    "what else?": read_as("word texture.", 0.6),
    "of what sort": read_as("word shape.", 0.2),
}


def known(part: str) -> ReadQuestion | None:
    """A part by the grammar, which is sure of it."""
    read = PARTS.get(part)
    return read if read is not None and read.confidence == 1.0 else None


WRONG = read_as("amount area %; amount area mm².", 0.9)


def test_two_parts_that_are_read_are_preferred_to_what_a_model_makes_of_both() -> None:
    read = divided("how far has it sunk in, and what form does it have?", WRONG, known, PARTS.get)
    assert read is not None
    assert (read.query, read.confidence) == ("amount depth mm; word shape.", 0.6)


def test_a_part_that_the_grammar_knows_is_not_lost() -> None:
    whole = read_as("word texture.", 0.8)
    read = divided("is it round, and what else?", whole, known, PARTS.get)
    assert read is not None
    assert read.query == "check shape sphere; word texture."


@pytest.mark.parametrize(
    ("question", "whole"),
    [
        ("how far has it sunk in, and of what sort", WRONG),  # a part is unsure
        ("how far has it sunk in, and when?", WRONG),  # a part is not read
        ("how far has it sunk in, and what form does it have?", read_as("word shape.", 0.9)),
        ("is it round, what form does it have?", WRONG),  # a comma alone
        ("what lies between is it round and what else?", WRONG),
    ],
)
def test_what_is_no_two_questions_stays_whole(question: str, whole: ReadQuestion) -> None:
    assert divided(question, whole, known, PARTS.get) is None
