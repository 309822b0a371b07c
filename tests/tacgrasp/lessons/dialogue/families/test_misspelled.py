import pytest

from tacgrasp.lessons.dialogue.families.misspelled import respelled


@pytest.mark.parametrize(
    ("question", "meant"),
    [
        ("what is the dpeth", "what is the depth"),
        ("is ther a contcat", "is there a contact"),
        ("How fr is it from the midle?", "how fr is it from the middle?"),
        ("Is it ruogh?", "is it rough?"),
    ],
)
def test_a_slip_in_a_word_that_matters_is_set_right(question, meant):
    assert respelled(question) == meant


@pytest.mark.parametrize(
    "question",
    [
        "Is there a grid on the ship?",
        "Was it made in Finnish woods?",
        "Is it among the nine kiwis?",
        "Subtract the halved limit from 5 N.",
        "What's the Depth?",
        "",
    ],
)
def test_other_words_stay(question):
    assert respelled(question) == question
