"""Slips in questions to be learned: which there are, and that none changes what is asked."""

import numpy as np

from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.slips import FIXED, made_up, slipped, thing_names

SENTENCE = "is the grip on the screwdriver not firmer than # newtons or # grams today"


def variants(sentence, num=3000):
    rng = np.random.default_rng(0)
    return [slipped(sentence, rng) for _ in range(num)]


def test_most_questions_keep_their_words_and_some_do_not():
    unchanged = sum(text == SENTENCE for text in variants(SENTENCE))
    assert 0.6 < unchanged / 3000 < 0.85


def test_numbers_and_denials_stay_in_their_order_and_beside_their_neighbours():
    for text in variants(SENTENCE):
        words = text.split()
        assert [word for word in words if word in FIXED] == ["not", "#", "#"], text
        assert all(words[at + 1] for at, word in enumerate(words) if word == "#")
    rng = np.random.default_rng(1)
    exchanged = {slipped("alpha beta # gamma", rng) for _ in range(400)}
    assert not [text for text in exchanged if "# beta" in text or "gamma #" in text]


def test_words_are_left_out_misspelled_joined_exchanged_and_renamed():
    texts = variants("what shape has the screwdriver in the gripper")
    assert any("what shape has screwdriver in gripper" in text for text in texts)
    assert any("gripper" not in text and "screwdriver" in text for text in texts)
    assert any("inthe" in text or "shapehas" in text for text in texts)
    assert any(text.startswith("shape what") for text in texts)
    assert any(
        "screwdriver" not in text and text.startswith("what shape has the ") for text in texts
    )


def test_a_made_up_name_is_one_plain_word():
    rng = np.random.default_rng(3)
    names = {made_up(rng) for _ in range(200)}
    assert len(names) > 150
    assert all(plain_words(name) == (name,) for name in names if name not in {"u", "si", "od"})


def test_things_whose_names_mean_something_are_not_renamed():
    names = thing_names()
    assert {"screwdriver", "teapot"} <= names
    assert not {"ring", "ball", "force", "press", "newton", "red", "left", "not"} & names


def test_in_a_long_question_a_word_may_be_unknown_but_no_unit():
    words = ["how", "hard", "are", "the", "two", "jaws", "pressing", "upon", "it"]
    known, replaced = set(words), 0
    rng = np.random.default_rng(4)
    for _ in range(2000):
        texts = slipped(" ".join(words), rng).split()
        replaced += len(texts) == len(words) and sum(text not in known for text in texts) == 1
    assert replaced > 40
    rng = np.random.default_rng(5)
    units = [slipped("a b c d e # mm f", rng).split() for _ in range(2000)]
    assert all(text[text.index("#") + 1] == "mm" for text in units if text[-1] != "#")
