"""Exchanges to be learned: balance, prompts, and replies that are true."""

import itertools
import re
from collections import Counter

import numpy as np
import pytest

from cltp.texts.exchange_packing import Exchange
from tacgrasp.lessons.dialogue.answer_reading import read_answer
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.facts import NOTHING_TOUCHES
from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.meaning import AnswerKind, Check, kind_of
from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.question_draws import (
    KIND_WEIGHTS,
    draw_question,
    draw_scene,
    families_by_kind,
    question_exchange,
    question_prompt,
    question_samples,
    spelled,
)
from tests.fakes.question_scenes import FREE, HELD, UNTOUCHED, contact, random_states

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
            answers[answer(question.meaning, scene, rng).value] += 1
    for kind, weight in KIND_WEIGHTS.items():
        assert abs(kinds[kind] / num - weight) < 0.05
    assert sum(KIND_WEIGHTS.values()) == pytest.approx(1.0)
    assert len(families) >= 0.95 * len(FAMILIES)
    decided = answers[True] + answers[False]
    assert abs(answers[True] / decided - 0.5) < 0.08
    assert sum(len(each) for each in families_by_kind().values()) == len(FAMILIES)


def test_the_prompt_tells_what_is_given():
    assert question_prompt("How deep?", HELD) == (
        "Goal 0.62 - 0.95 N, limit 1.30 N, mass 25 g. How deep?"
    )
    before = Exchange(prompt="How deep?", reply="0.19 mm.")
    assert question_prompt("And the force?", FREE, before) == "How deep? 0.19 mm. And the force?"


def test_exchanges_follow_from_the_seed():
    first, second, other = (
        list(itertools.islice(question_samples(STATES, seed), 20)) for seed in (3, 3, 4)
    )
    assert first == second
    assert first != other


def test_numbers_and_advice_are_those_of_what_is_told():
    told = contact(force_n=5.0, depth_mm=0.44)
    forces, advice = set(), set()
    for seed in range(600):
        reply = read_answer(question_exchange(told, np.random.default_rng(seed)).reply)
        forces |= {n.value for n in reply.numbers if n.dimension == "force" and n.value > 4.9}
        advice |= set(reply.words("reason"))
    assert 5.0 in forces
    assert {"held too lightly", "within the goal"} & advice


def test_a_follow_up_brings_the_exchange_before_it():
    prompts = [each.prompt for each in itertools.islice(question_samples(STATES, 8), 400)]
    # a question, its answer, and the one that follows
    assert any(re.search(r"\? .+[.] (And|Why) ", prompt) for prompt in prompts)


def test_where_nothing_touches_every_answer_about_the_contact_says_so():
    rng = np.random.default_rng(9)
    replies = Counter()
    for _ in range(200):
        question = draw_question(UNTOUCHED, rng)
        if kind_of(question.meaning) is AnswerKind.NUMBER:
            replies[answer(question.meaning, UNTOUCHED, rng).text] += 1
    assert replies[NOTHING_TOUCHES] > 0.5 * sum(replies.values())


def test_spelling_leaves_the_plain_words_as_they_are():
    rng = np.random.default_rng(0)
    for text in ("What is the depth in µm, please?", "Is it not above 0.3 mm?", "It is the force."):
        variants = {spelled(text, rng) for _ in range(300)}
        assert len(variants) > 2
        assert {plain_words(variant) for variant in variants} == {plain_words(text)}
