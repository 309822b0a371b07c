"""Questions how much of the pad is bare."""

import pytest

from tacgrasp.lessons.dialogue.query import asked_text
from tacgrasp.lessons.dialogue.rules.bare import bare_query


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "Over half of the sensing area remains bare, doesn't it?",
            "calculate 100 - area_percent > 50.",
        ),
        (
            "Can it be said that more of the pad lies idle than is occupied?",
            "calculate area_percent < 50.",
        ),
        ("Is there more covered pad than bare pad?", "calculate area_percent > 50."),
        ("Is most of the gel still empty?", "calculate area_percent < 50."),
        ("Does the untouched area outweigh the touched one?", "calculate area_percent < 50."),
        ("Is the pad more covered than not?", "calculate area_percent > 50."),
        ("Is the major part of the sensing face out of contact?", "calculate area_percent < 50."),
        ("Does it occupy the bigger part of the pad?", "calculate area_percent > 50."),
        ("Is a good half of your gel idle?", "calculate 100 - area_percent >= 50."),
        ("Does at least 70 % of the sensor stay clear?", "calculate 100 - area_percent >= 70."),
        (
            "Would you bet on a minority of the pad being covered or a majority?",
            "calculate 'majority' if area_percent > 50 else 'minority'.",
        ),
        (
            "Is the pad mostly bare or mostly covered?",
            "calculate 'covered' if area_percent > 50 else 'bare'.",
        ),
        ("What share of the pad sits idle?", "amount free_area %."),
    ],
)
def test_the_bare_part_is_asked_for_in_any_words(question, query):
    asked = asked_text(question)
    assert bare_query(asked.words, asked.numbers) == query


@pytest.mark.parametrize(
    "question",
    [
        "Is the pad touched or free?",
        "Is the pad empty?",
        "Is most of the limit unused?",
        "Is more than half of the band free?",
        "Is most of the pad red?",
        "How much of the pad is free after I let go?",
    ],
)
def test_others_are_not_about_the_bare_part(question):
    asked = asked_text(question)
    assert bare_query(asked.words, asked.numbers) == ""
