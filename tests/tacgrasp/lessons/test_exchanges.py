import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from cltp.tactile.states import (
    ContactState,
    Shape,
    Side,
    Texture,
)
from cltp.texts.captions import caption
from policies.contract_steps import target_of
from policies.extraction import extract
from policies.goal import Goal
from policies.teacher import LESSON_MOVE_STEP_MM, teacher
from tacgrasp.lessons.dialogue.scene import band_contract
from tacgrasp.lessons.exchanges import BLIND, TouchLessons, advice_reply
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


def goal_of(low_n: float, high_n: float) -> Goal:
    return target_of(band_contract(low_n, high_n))


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
    goal = goal_of(force_n / 1.4, force_n * 1.4)
    advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
    found = extract(advice_reply(state, goal))
    assert found.action == advice.action
    assert found.success == advice.success
    assert not found.ambiguous


def test_a_reply_has_the_contact_the_goal_the_action_and_the_reason() -> None:
    said = advice_reply(contact(force_n=3.0), goal_of(1.1, 2.3))
    assert said == (
        "smooth sphere, moderate 0.40 mm, centered x +0.0 y +0.0, medium 12 %, 3.00 N. "
        "Goal 1.10 - 2.30 N. Action: <decrease_force>. That is too firm."
    )


def test_the_same_contact_is_advised_otherwise_for_another_goal() -> None:
    state = contact(depth_mm=0.12, force_n=1.5)
    assert "<none>" in advice_reply(state, goal_of(1.2, 1.8))
    assert "<increase_force>" in advice_reply(state, goal_of(2.5, 4.0))
    assert "<decrease_force>" in advice_reply(state, goal_of(0.5, 0.9))


def test_lessons_describe_and_advise_and_the_blind_ones_hide_the_goal() -> None:
    state = contact()
    seeing = TouchLessons().mixed(state, state, np.random.default_rng(0))
    blind = TouchLessons(blind=True).mixed(state, state, np.random.default_rng(0))
    assert [e.reply for e in seeing] == [e.reply for e in blind]
    assert [e.prompt for e in blind[1:]] == [BLIND] * 3
    assert all(e.prompt.startswith("Goal ") for e in seeing[1:])
    assert seeing[0].prompt == blind[0].prompt
    described = TouchLessons().captions(state, np.random.default_rng(0))[0].reply
    assert described.startswith(caption(state))
