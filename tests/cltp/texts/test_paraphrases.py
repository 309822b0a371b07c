"""Paraphrases, prompts and questions: drawn from a seed alone, true, and read back."""

import dataclasses
import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cltp import TouchError
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import (
    CLASSES,
    DIMENSIONS,
    NO_CONTACT_STATE,
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Side,
    Texture,
    position_word,
)
from cltp.texts.captions import Slots, slots_of
from cltp.texts.paraphrases import (
    NOTHING,
    PARAPHRASES,
    PROMPTS,
    paraphrase,
    prompts,
    read_paraphrase,
    synonym_prompt,
    text_seed,
    unseen_prompts,
)
from cltp.texts.question_answers import UNTOUCHED, question_answers

MINI = SENSORS["gelsight_mini"]
DISC = ContactState(
    depth_mm=0.5, x_mm=0, y_mm=0, area_fraction=0.05, force_n=1, depth=Depth.MODERATE,
    position=Position.CENTERED, area=Area.SMALL, shape=Shape.DISC, texture=Texture.ROUGH,
)  # fmt: skip
STATES = st.builds(
    ContactState,
    depth_mm=st.floats(0.05, 2),
    x_mm=st.floats(-10, 10),
    y_mm=st.floats(-7, 7),
    area_fraction=st.floats(0.001, 1),
    force_n=st.one_of(st.floats(0.01, 20), st.just(float("nan"))),
    depth=st.sampled_from(Depth),
    position=st.sampled_from(Position),
    area=st.sampled_from(Area),
    cut=st.frozensets(st.sampled_from(Side)),
    shape=st.one_of(st.none(), st.sampled_from(Shape)),
    texture=st.one_of(st.none(), st.sampled_from(Texture)),
)


@given(STATES, st.integers(0, 2**32))
def test_every_paraphrase_reads_back_exactly_and_is_the_same_again(state, seed):
    text = paraphrase(state, seed)
    assert read_paraphrase(text) == slots_of(state)
    assert paraphrase(state, seed) == text
    assert " a a" not in text
    assert " a e" not in text


def test_no_two_words_of_a_dimension_are_worded_alike_and_all_are_drawn():
    texts = {
        paraphrase(dataclasses.replace(DISC, shape=shape, depth=depth), seed)
        for shape, depth, seed in itertools.product(Shape, Depth, range(60))
    }
    assert {read_paraphrase(text).shape for text in texts} == set(Shape)
    assert len(texts) > 19 * 4 * 30
    starts = [PARAPHRASES[i].split("{")[0] for i in (1, 3, 5)]
    assert all(any(text.startswith(start) for text in texts) for start in starts)


def test_no_contact_has_wordings_of_its_own():
    assert {paraphrase(NO_CONTACT_STATE, seed) for seed in range(50)} == set(NOTHING)
    assert read_paraphrase("Nothing touches the gel.") == Slots()


@pytest.mark.parametrize("text", ["", "a cat", "a rough ball is pressed", "a smooth sphere object"])
def test_other_sentences_are_refused(text):
    with pytest.raises(TouchError, match="PARAPHRASES"):
        read_paraphrase(text)


def test_a_depth_without_a_position_can_t_be_worded():
    broken = dataclasses.replace(DISC, position=None, area=None)
    with pytest.raises(TouchError, match="position"):
        paraphrase(broken, 0)


def test_every_class_has_prompts_the_papers_first_and_none_of_two_classes_agree():
    sizes = {"shape": 19, "texture": 5, "depth": 4, "position": 9, "area": 5}
    assert list(PROMPTS) == list(CLASSES)
    assert {name: len(words) for name, words in CLASSES.items()} == sizes
    assert prompts("shape", "sphere")[0] == "This is a sphere."
    assert prompts("shape", "edge")[0] == "This is an edge."
    assert prompts("depth", "very deep")[0] == "Contact is very deep."
    assert prompts("position", "top-left")[0] == "Contact at top-left."
    every = [text for slot in PROMPTS for word in CLASSES[slot] for text in prompts(slot, word)]
    assert len(set(every)) == len(every) == 3 * (19 + 5 + 4 + 9 + 5)
    assert not any(" a a" in text or " a e" in text or "{" in text for text in every)


@pytest.mark.parametrize(("slot", "word"), [("colour", "red"), ("shape", "blob")])
def test_prompts_outside_the_vocabulary_are_refused(slot, word):
    with pytest.raises(TouchError, match="no prompt"):
        prompts(slot, word)


@given(STATES, st.integers(0, 2**32))
def test_answers_are_true_and_about_known_labels_only(state, seed):
    pairs = question_answers(state, MINI, seed)
    assert pairs == question_answers(state, MINI, seed)
    about = {pair.about for pair in pairs}
    assert ("shape" in about) == (state.shape is not None)
    assert ("force" in about) == (state.force_n == state.force_n)
    for pair in pairs:
        if pair.about not in DIMENSIONS:
            continue
        word = str(getattr(state, pair.about))
        suggested = [w for w in CLASSES[pair.about] if pair.question.endswith(f" {w}?")]
        if pair.answer == "Yes.":
            assert max(suggested, key=len) == word
        else:
            assert word in pair.answer
        if pair.answer.startswith("No, "):
            assert max(suggested, key=len) != word


def test_yes_and_no_are_about_as_frequent():
    closed = [
        pair.answer
        for seed in range(100)
        for pair in question_answers(DISC, MINI, seed)
        if pair.about in DIMENSIONS and (pair.answer == "Yes." or pair.answer.startswith("No"))
    ]
    assert len(closed) == 500
    assert 200 < closed.count("Yes.") < 300


def test_an_untouched_pad_has_one_question():
    (pair,) = question_answers(NO_CONTACT_STATE, MINI, 0)
    assert pair.answer == f"No. {UNTOUCHED}"


def test_texts_are_seeded_by_what_is_stored_and_loads_of_a_series_differ():
    first = text_seed(seed=0, series=7, depth_mm=0.25)
    assert first == text_seed(seed=0, series=7, depth_mm=0.25)
    assert first != text_seed(seed=0, series=7, depth_mm=0.5)
    assert first != text_seed(seed=0, series=8, depth_mm=0.25)


def test_a_position_is_the_same_for_numbers_of_python_and_numpy():
    for x, y in itertools.product((-9.0, 0.0, 9.0), (-7.0, 0.0, 7.0)):
        assert position_word(np.float64(x), np.float64(y), MINI) is position_word(x, y, MINI)
    assert position_word(9.0, -7.0, MINI) is Position.BOTTOM_RIGHT


@pytest.mark.parametrize(("slot", "word"), [(s, w) for s, words in CLASSES.items() for w in words])
def test_unseen_prompts_name_the_class_in_no_wording_of_the_training(slot, word):
    unseen = unseen_prompts(slot, word)
    assert len(set(unseen)) == len(unseen) == 3
    assert all(word in text for text in unseen)
    frames = {text.replace(word, "") for text in unseen}
    assert not frames & {text.replace(word, "") for text in prompts(slot, word)}


def test_synonyms_stand_in_the_papers_prompt_and_are_no_word_of_the_training():
    assert synonym_prompt("shape", "sphere") == "This is a ball."
    assert synonym_prompt("position", "top-left") == "Contact in the upper left corner."
    texts = {
        slot: [synonym_prompt(slot, word) for word in names] for slot, names in CLASSES.items()
    }
    for slot, names in CLASSES.items():
        assert len(set(texts[slot])) == len(names)
        assert not set(texts[slot]) & {text for word in names for text in prompts(slot, word)}
    with pytest.raises(TouchError, match="no prompt for 'shape' 'blob'"):
        synonym_prompt("shape", "blob")
