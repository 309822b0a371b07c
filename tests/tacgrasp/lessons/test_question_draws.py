"""Exchanges to be learned: balance, prompts, and replies that are true."""

from collections import Counter

import numpy as np
import pytest

from tacgrasp.lessons import question_draws
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.facts import NOTHING_TOUCHES
from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.meaning import AnswerKind, Check, kind_of
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.lessons.question_draws import (
    KIND_WEIGHTS,
    draw_question,
    draw_scene,
    families_by_kind,
    query_exchange,
    slipped,
    spelled,
)
from tests.fakes.question_scenes import UNTOUCHED, random_states

STATES = random_states(50)


def test_questions_are_balanced_over_kinds_families_and_answers():
    rng = np.random.default_rng(1)
    kinds, families, answers = Counter(), Counter(), Counter()
    num = 1500
    for number in range(num):
        scene = draw_scene(STATES[number % len(STATES)], rng)
        question = draw_question(scene, rng)
        kinds[kind_of(question.meaning)] += 1
        families[question.family] += 1
        if isinstance(question.meaning, Check):
            answers[answer(question.meaning, scene).value] += 1
    for kind, weight in KIND_WEIGHTS.items():
        assert abs(kinds[kind] / num - weight) < 0.05
    assert sum(KIND_WEIGHTS.values()) == pytest.approx(1.0)
    assert len(families) >= 0.95 * len(FAMILIES)
    decided = answers[True] + answers[False]
    assert abs(answers[True] / decided - 0.5) < 0.08
    assert sum(len(each) for each in families_by_kind().values()) == len(FAMILIES)


def test_exchanges_follow_from_the_seed():
    first, second, other = (
        [query_exchange(rng) for _ in range(20)] for rng in map(np.random.default_rng, (3, 3, 4))
    )
    assert first == second
    assert first != other


def test_a_learned_question_is_plain_words_and_its_reply_a_query():
    rng = np.random.default_rng(2)
    for _ in range(400):
        exchange = query_exchange(rng)
        numbers = [1.0] * exchange.prompt.split().count("#")
        assert read_query(exchange.reply, numbers) is not None, exchange
        assert exchange.prompt == exchange.prompt.lower()


def test_questions_of_any_families_are_asked_together(monkeypatch):
    monkeypatch.setattr(question_draws, "WHOLE", 0.0)
    monkeypatch.setattr(question_draws, "TOGETHER", 1.0)
    rng = np.random.default_rng(5)
    counts, kinds = Counter(), set()
    for _ in range(200):
        exchange = query_exchange(rng)
        parts = exchange.reply.removesuffix(".").split("; ")
        assert len(set(parts)) == len(parts)
        counts[len(parts)] += 1
        kinds |= {part.split()[0] for part in parts}
    assert set(counts) == {2, 3} and counts[2] > counts[3]
    assert kinds == {"amount", "check", "word", "choice"}


def test_slips_leave_numbers_and_short_words():
    rng = np.random.default_rng(0)
    variants = {slipped("is the force not above # newtons", rng) for _ in range(500)}
    assert len(variants) > 10
    assert all({"#", "not"} <= set(variant.split()) for variant in variants)


def test_where_nothing_touches_every_answer_about_the_contact_says_so():
    rng = np.random.default_rng(9)
    replies = Counter()
    for _ in range(200):
        question = draw_question(UNTOUCHED, rng)
        if kind_of(question.meaning) is AnswerKind.NUMBER:
            replies[answer(question.meaning, UNTOUCHED).text] += 1
    assert replies[NOTHING_TOUCHES] > 0.5 * sum(replies.values())


def test_spelling_leaves_the_plain_words_as_they_are():
    rng = np.random.default_rng(0)
    for text in ("What is the depth in µm, please?", "Is it not above 0.3 mm?", "It is the force."):
        variants = {spelled(text, rng) for _ in range(300)}
        assert len(variants) > 2
        assert {plain_words(variant) for variant in variants} == {plain_words(text)}


def test_a_question_whose_number_is_read_otherwise_is_drawn_anew(monkeypatch):
    texts = iter(["Is this one and three tenths of a newton?", "Is it three tenths of a newton?"])
    meaning = check_of("force >= 0.3 N")
    question_draws.families_by_kind()  # draws wordings of its own, once
    monkeypatch.setattr(question_draws, "_wording", lambda *_: (next(texts), meaning))
    monkeypatch.setattr(question_draws, "TOGETHER", 0.0)
    exchange = query_exchange(np.random.default_rng(0))
    assert exchange.reply == "check force >= #1 N."
    assert next(texts, None) is None
