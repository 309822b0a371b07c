"""Which questions are refused before the model is asked."""

import pytest

from cltp.texts.tokenizer import Words
from policies import PolicyError
from policies.llm.question_check import MAX_WORDS, check_question


@pytest.fixture(scope="module")
def words() -> Words:
    taught = "How deep is the contact? It is pressed 0.3 mm. Is the surface rough?"
    return Words.train([taught] * 20, size=400)


@pytest.mark.parametrize(
    "question",
    [
        "How deep is the contact?",
        "What is the capital of Mozambique?",
        "Whose cuckoo clock chimes?",
        "hows the weather",
        "is it rough",
        "Is 0.5 N ok for 30 g?",
        "Torque?",
        "Is x positive?",
        "2<F<3?",
    ],
)
def test_plain_english_with_rare_words_is_for_the_model_to_answer(
    question: str, words: Words
) -> None:
    check_question(question, words)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("", "in words is needed"),
        ("1 2 3 ?", "in words is needed"),
        ("deep " * (MAX_WORDS + 1), "has 121 words, at most 120"),
        ("Wie tief ist der Gegenstand eingedrückt?", "0 of 6 words"),
        ("Quelle est la profondeur du contact ?", "ask in plain English"),
        ("¿Qué profundidad tiene?", "ask in plain English"),
        ("Quanto è profondo?", "ask in plain English"),
        ("Hoe diep is het ingedrukt?", "ask in plain English"),
        ("接触有多深?", "ask in plain English"),
        ("Насколько глубоко?", "ask in plain English"),
    ],
)
def test_what_can_not_be_read_is_refused(question: str, expected: str, words: Words) -> None:
    with pytest.raises(PolicyError) as error:
        check_question(question, words)
    assert expected in str(error.value)


def test_a_stock_checkpoint_may_know_any_language() -> None:
    check_question("Wie tief ist es?", None)
