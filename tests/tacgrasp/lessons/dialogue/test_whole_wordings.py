"""Wordings that were written whole: each is understood as its query says."""

from collections import Counter
from importlib import resources

import numpy as np

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.families.catalogue import understand
from tacgrasp.lessons.dialogue.meaning import Check
from tacgrasp.lessons.dialogue.query import asked_text, query_of, read_query
from tacgrasp.lessons.dialogue.whole_wordings import (
    drawn_whole,
    understand_whole,
    whole_wordings,
)


def test_every_query_is_one_and_has_the_numbers_of_its_wording():
    for each in whole_wordings():
        for words, query in each.variants():
            numbers = [1.0] * words.split().count("#")
            assert read_query(query, numbers) is not None, (words, query)


def test_no_wording_stands_twice():
    counts = Counter(words for each in whole_wordings() for words, _ in each.variants())
    assert not [words for words, times in counts.items() if times > 1]


def test_every_wording_is_read_as_its_query():
    file = resources.files("tacgrasp.lessons.dialogue") / "whole_wordings.tsv"
    lines = [line.split("\t") for line in file.read_text(encoding="utf-8").splitlines()]
    assert len(lines) > 3000
    for query, text in lines:
        meaning = understand_whole(text)
        assert meaning == read_query(f"{query}.", asked_text(text).numbers), (query, text)
    assert understand_whole("what is it that the thing's surface likes") is None


def test_words_of_a_dimension_stand_for_each_other():
    neutral = next(each for each in whole_wordings() if each.dimension == "shape")
    variants = dict(neutral.variants())
    assert len(variants) == len(CLASSES["shape"])
    for words, query in variants.items():
        meaning = understand_whole(words)
        assert isinstance(meaning, Check)
        assert query_of(meaning) == query
    assert not [words for words in variants if " a ellipsoid" in words or " a edge" in words]


def test_families_are_asked_first_and_whole_wordings_follow_nothing():
    assert understand("are we choking it") is not None
    assert understand("are we choking it", before="How deep is it?") is None


def test_rare_queries_are_drawn_too():
    rng = np.random.default_rng(0)
    drawn = Counter(drawn_whole(rng)[1] for _ in range(4000))
    kinds = Counter(query.split()[0] for query in drawn.elements())
    assert {"amount", "check", "word", "choice", "why", "unknown", "other.", "describe."} <= set(
        kinds
    )
    assert len(drawn) > 300
