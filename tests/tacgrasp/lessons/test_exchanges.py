import dataclasses
import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cltp.tactile.states import (
    ContactState,
    Shape,
    Side,
    Texture,
)
from cltp.texts.captions import caption
from policies.extraction import extract
from policies.teacher import LESSON_MOVE_STEP_MM, teacher
from tacgrasp.lessons.exchanges import BLIND, TouchLessons, advice_reply, meaning_exchange
from tacgrasp.lessons.heldout_instructions import PARAPHRASES
from tacgrasp.lessons.instruction_words import LEVELS as LEVEL_WORDS
from tacgrasp.lessons.instruction_words import Firmness
from tacgrasp.lessons.instructions import (
    LEVELS,
    draw_instruction,
    draw_instruction_near,
    goal_of_force,
    in_newtons,
    in_words,
    task_goals,
)
from tacgrasp.lessons.questions import HELD_OUT, QUESTIONS, answer
from tests.fakes import question_scenes

SMOOTH_BALL = {"shape": Shape.SPHERE, "texture": Texture.SMOOTH}


def contact(
    depth_mm: float = 0.4,
    x_mm: float = 0.0,
    y_mm: float = 0.0,
    area_fraction: float = 0.12,
    force_n: float = 1.5,
    cut: frozenset[Side] = frozenset(),
) -> ContactState:
    return question_scenes.contact(
        depth_mm, x_mm, y_mm, area_fraction, force_n, cut=cut, **SMOOTH_BALL
    )


NOTHING = ContactState(
    depth_mm=0.0, x_mm=0.0, y_mm=0.0, area_fraction=0.0, force_n=0.0, depth=None, position=None,
    area=None,
)  # fmt: skip


@given(
    st.builds(
        contact,
        depth_mm=st.floats(0.05, 1.4),
        x_mm=st.floats(-9, 9),
        y_mm=st.floats(-7, 7),
        area_fraction=st.floats(0.001, 0.9),
        force_n=st.floats(0.02, 12),
        cut=st.frozensets(st.sampled_from(list(Side))),
    )
    | st.just(NOTHING),
    st.floats(0.4, 8),
)
def test_extraction_reads_the_advice_of_the_teacher_in_every_reply(
    state: ContactState, force_n: float
) -> None:
    goal = goal_of_force(force_n / 1.4, force_n * 1.4)
    advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
    found = extract(advice_reply(state, goal))
    assert found.action == advice.action
    assert found.success == advice.success
    assert not found.ambiguous


def test_a_reply_has_the_contact_the_goal_the_action_and_the_reason() -> None:
    said = advice_reply(contact(force_n=3.0), goal_of_force(1.1, 2.3))
    assert said == (
        "smooth sphere, moderate 0.40 mm, centered x +0.0 y +0.0, medium 12 %, 3.00 N. "
        "Goal 1.10 - 2.30 N. Action: <decrease_force>. That is too firm."
    )


def test_the_same_contact_is_advised_otherwise_for_another_goal() -> None:
    band = task_goals()["strawberry"].force_n
    state = contact(depth_mm=0.12, force_n=(band.low * band.high) ** 0.5)
    assert "<none>" in advice_reply(state, task_goals()["strawberry"])
    assert "<increase_force>" in advice_reply(state, task_goals()["peg"])
    assert "<decrease_force>" in advice_reply(state, task_goals()["cherry_tomato"])


def test_a_goal_at_a_task_is_that_task() -> None:
    for goal in task_goals().values():
        between = goal_of_force(goal.force_n.low, goal.force_n.high)
        assert between.depth_mm.high == pytest.approx(goal.depth_mm.high)
        assert between.area_fraction.high == pytest.approx(goal.area_fraction.high)


def test_instructions_in_newtons_mean_what_they_say() -> None:
    rng = np.random.default_rng(0)
    for _ in range(200):
        drawn = in_newtons(2.0, rng)
        assert 2.0 in drawn.goal.force_n
        numbers = [float(w) for w in drawn.text.replace("-", " ").split() if w[0].isdigit()]
        if len(numbers) == 2:
            assert numbers == [drawn.goal.force_n.low, drawn.goal.force_n.high]
        else:
            assert numbers[0] in drawn.goal.force_n


def test_every_form_of_a_wording_tells_the_level() -> None:
    rng = np.random.default_rng(4)
    for level, words in LEVEL_WORDS.items():
        telling = [str(part) for field in dataclasses.fields(words)
                   for part in getattr(words, field.name)]  # fmt: skip
        for _ in range(300):
            text = in_words(level, rng).text.lower()
            assert any(part.lower() in text for part in telling), text


def test_no_words_tell_two_levels() -> None:
    for field in dataclasses.fields(Firmness):
        parts = [part for words in LEVEL_WORDS.values() for part in getattr(words, field.name)]
        assert len(parts) == len(set(parts)), field.name


def test_a_question_for_the_meaning_is_answered_by_the_goals_force() -> None:
    exchange = meaning_exchange(np.random.default_rng(3))
    low, high = (float(w) for w in exchange.reply.split()[1:4:2])
    assert 0 < low < high


def test_drawing_repeats_with_its_seed_and_covers_all_levels() -> None:
    one = [draw_instruction(np.random.default_rng(s)).text for s in range(30)]
    assert one == [draw_instruction(np.random.default_rng(s)).text for s in range(30)]
    rng = np.random.default_rng(0)
    goals = {draw_instruction_near(contact(force_n=f), rng).goal.force_n
             for f in np.geomspace(0.3, 10, 200)}  # fmt: skip
    assert {goal.force_n for goal in task_goals().values()} <= goals


def test_paraphrases_and_held_out_questions_are_never_trained_on() -> None:
    assert set(PARAPHRASES) == set(LEVELS)
    rng = np.random.default_rng(1)
    drawn = {
        in_words(level, rng).text.lower().rstrip(".!") for level in LEVELS for _ in range(3000)
    }
    held = {text.lower().rstrip(".!") for text in itertools.chain(*PARAPHRASES.values())}
    assert not drawn & held
    for slot, wordings in HELD_OUT.items():
        assert not set(wordings) & set(QUESTIONS[slot])


def test_answers_name_the_slot_and_its_number() -> None:
    state = contact(depth_mm=0.7, force_n=1.25)
    assert answer("depth", state) == "Pressed deep, 0.70 mm."
    assert answer("force", state) == "About 1.25 N."
    assert answer("shape", state) == "A sphere."
    assert answer("shape", NOTHING) == "Nothing touches the pad."


def test_lessons_describe_advise_and_read_instructions_and_the_blind_ones_hide_them() -> None:
    state = contact()
    seeing = TouchLessons().mixed(state, state, np.random.default_rng(0))
    blind = TouchLessons(blind=True).mixed(state, state, np.random.default_rng(0))
    assert [e.reply for e in seeing[:4]] == [e.reply for e in blind]
    assert all(e.reply.startswith("Goal ") for e in seeing[4:])
    assert [e.prompt for e in blind[1:]] == [BLIND] * 3
    assert seeing[0].prompt == blind[0].prompt
    described = TouchLessons().captions(state, np.random.default_rng(0))[0].reply
    assert described.startswith(caption(state))
