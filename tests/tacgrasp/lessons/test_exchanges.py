from typing import Any

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
from cltp.texts.told import ToldContact
from policies.extraction import extract
from policies.llm.parse import parse_reply
from policies.teacher import LESSON_MOVE_STEP_MM, force_goal, teacher
from primitives.contract import Band
from tacgrasp.lessons.exchanges import (
    BLIND,
    TouchLessons,
    advice_reply,
    draw_target,
    known_words,
)
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


def told(state: ContactState, **doubts: Any) -> ToldContact:
    return ToldContact(state=state, **doubts)


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
    band = Band(low=force_n / 1.4, high=force_n * 1.4)
    advice = teacher(state, force_goal(band), move_step_mm=LESSON_MOVE_STEP_MM)
    found = extract(advice_reply(told(state), band))
    assert found.action == advice.action
    assert found.success == advice.success
    assert not found.ambiguous


def test_a_reply_has_the_contact_the_goal_the_action_and_the_reason() -> None:
    said = advice_reply(told(contact(force_n=3.0)), Band(low=1.1, high=2.3))
    assert said == (
        "smooth sphere, moderate 0.40 mm, centered x +0.0 y +0.0, medium 12 %, 3.00 N. "
        "Goal 1.10 - 2.30 N. Action: <decrease_force>. That is too firm."
    )


def test_a_reply_names_rivals_and_intervals_where_there_is_doubt() -> None:
    ends = {"depth_mm": (0.31, 0.52), "force_n": (2.9, 3.1)}
    felt = told(contact(force_n=3.0), ends=ends, rivals={"shape": "ellipsoid"})
    said = advice_reply(felt, Band(low=1.1, high=2.3))
    assert said.startswith("smooth sphere or ellipsoid, moderate 0.31-0.52 mm, centered")
    assert "3.00 N. Goal" in said  # too narrow to be said
    parsed = parse_reply(said)
    assert (parsed.rivals["shape"], parsed.numbers["depth_mm"]) == ("ellipsoid", (0.31, 0.52))


def test_the_same_contact_is_advised_otherwise_for_another_goal() -> None:
    felt = told(contact(depth_mm=0.12, force_n=1.5))
    assert "<none>" in advice_reply(felt, Band(low=1.2, high=1.8))
    assert "<increase_force>" in advice_reply(felt, Band(low=2.5, high=4.0))
    assert "<decrease_force>" in advice_reply(felt, Band(low=0.5, high=0.9))


@given(st.floats(0.0, 20.0), st.integers(0, 2**32 - 1))
def test_every_target_is_a_band_below_its_limit(force_n: float, seed: int) -> None:
    band, limit_n = draw_target(force_n, np.random.default_rng(seed))
    assert 0 < band.low <= band.high <= limit_n


def test_lessons_describe_and_advise_and_the_blind_ones_hide_the_goal() -> None:
    felt = told(contact())
    lessons = {blind: TouchLessons(blind=blind, num_advice=2) for blind in (False, True)}
    seeing, blind = (lessons[b].mixed(felt, np.random.default_rng(0)) for b in (False, True))
    assert [e.reply for e in seeing] == [e.reply for e in blind]
    assert [e.prompt for e in blind[-2:]] == [BLIND] * 2
    assert all(e.prompt.startswith("Goal ") for e in seeing[-2:])
    described = TouchLessons().captions(felt, np.random.default_rng(0))[0].reply
    assert described.startswith(caption(felt.state))


def test_words_that_questions_are_about_are_words_of_letters() -> None:
    words = known_words()
    assert {"strawberry", "aardvark"} <= set(words)
    assert len(words) > 3000
    assert all(word.isalpha() for word in words)
