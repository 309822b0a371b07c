"""Extraction: a table of sentences, and properties of any text."""

import string

import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies.extraction import extract
from primitives import Primitive
from tests.policies.extraction.adversarial import ADVERSARIAL
from tests.policies.extraction.sentences import (
    ACTIONS,
    AMBIGUOUS,
    NOTHING,
    REFUSED,
    SUCCESS,
    TABLE,
)


def words_of(text):
    return text.split()


JUNK_WORDS = words_of(
    "contact berry bottom left right upper corner deep pad gel mm force depth area table centre "
    "finger is at the of with moderate small pressed 0.3 12 N ( ) , ; slight very tiny "
    "medium large centered middle-left bottom-center cut edge sphere ellipsoid smooth ridged "
    "object newton light firm soft high low too much deepest tilted slipping gripper grasp normal"
)
GRAMMAR_WORDS = words_of(
    "not stable secure move down up the grasp is if or and but , . ? : ; no force increase reduce "
    "<none> move_down <move_up> instead of rather than without avoid before after to be more less "
    "a grip until once was will n't - ( ) it gripper please should remains hold reset again still"
)
VOCABULARY = [w for text, _, _ in TABLE for w in text.split()] + " ".join(ADVERSARIAL).split()
JUNK = st.lists(st.sampled_from(JUNK_WORDS), max_size=12).map(" ".join)
AFFIRMED = st.sampled_from([t for t in SUCCESS if t.startswith(("The grasp is s", "The grip is"))])


@pytest.mark.parametrize(("text", "action", "success"), TABLE)
def test_a_sentence_is_read_as_a_person_would(text, action, success):
    extraction = extract(text)
    assert (extraction.action, extraction.success, extraction.ambiguous) == (
        action,
        success,
        False,
    ), extraction.reason


@pytest.mark.parametrize("text", AMBIGUOUS)
def test_two_different_requests_are_ambiguous_and_neither_action_nor_success(text):
    extraction = extract(text)
    assert extraction.ambiguous, extraction.reason
    assert extraction.action is None
    assert not extraction.success


@pytest.mark.parametrize(
    "text",
    [
        "Action: <move_up>. Do not move up.",
        "Increase the force. No, do not increase the force.",
        "Never move left. Move left.",
    ],
)
def test_a_text_that_asks_for_what_it_forbids_is_ambiguous(text):
    extraction = extract(text)
    assert extraction.ambiguous, extraction.reason
    assert extraction.action is None
    assert not extraction.success


@pytest.mark.parametrize("text", REFUSED)
def test_a_sentence_that_is_not_clearly_read_is_refused(text):
    extraction = extract(text)
    assert (extraction.action, extraction.success) == (None, False), extraction.reason


@pytest.mark.parametrize("text", ADVERSARIAL)
def test_a_text_made_to_mislead_neither_moves_nor_declares_anything(text):
    extraction = extract(text)
    assert (extraction.action, extraction.success) == (None, False), extraction.reason


@pytest.mark.parametrize(
    ("text", "action", "success"),
    [
        ("please move the gripper downward", Primitive.MOVE_DOWN, False),
        ("increase force", Primitive.INCREASE_FORCE, False),
        ("Move up.", Primitive.MOVE_UP, False),
        ("instead of moving left, move right", Primitive.MOVE_RIGHT, False),
        ("- reduce the force", Primitive.DECREASE_FORCE, False),
        ("Action`move_up`", Primitive.MOVE_UP, False),
        ("STABLE", None, True),
        ("Secure, reliable hold.", None, True),
        ("it's_stable", None, True),
    ],
)
def test_plain_words_are_still_read(text, action, success):
    extraction = extract(text)
    assert (extraction.action, extraction.success) == (action, success), extraction.reason


def test_the_tables_are_as_long_as_a_reader_of_this_weight_needs():
    assert len(TABLE) + len(AMBIGUOUS) + len(REFUSED) >= 400
    assert len(ADVERSARIAL) >= 100
    for texts in ([text for text, _, _ in TABLE], AMBIGUOUS, REFUSED, ADVERSARIAL):
        assert len(set(texts)) == len(texts)


@given(st.text())
def test_any_text_is_read_without_an_error(text):
    extraction = extract(text)
    assert not (extraction.ambiguous and (extraction.success or extraction.action is not None))
    assert extraction.reason


@given(st.lists(st.sampled_from(["\n", *GRAMMAR_WORDS]), max_size=25).map(" ".join))
def test_any_row_of_the_grammars_own_words_is_read_without_an_error(text):
    extraction = extract(text)
    assert not (extraction.ambiguous and (extraction.success or extraction.action is not None))


@given(st.lists(st.sampled_from(VOCABULARY), max_size=20), st.sampled_from([" ", "_", "'", "\n"]))
def test_any_shuffled_vocabulary_is_read_without_an_error(words, joint):
    extraction = extract(joint.join(words))
    assert not (extraction.ambiguous and (extraction.success or extraction.action is not None))
    assert extraction.reason


@pytest.mark.parametrize("text", ["", "\x00", "\ud800", "<" * 5000, "not " * 3000, "move " * 3000])
def test_strange_and_long_texts_declare_and_ask_nothing(text):
    extraction = extract(text)
    assert (extraction.action, extraction.success) == (None, False)


@given(JUNK)
def test_words_about_a_contact_never_make_an_action_or_a_success(text):
    extraction = extract(text)
    assert (extraction.action, extraction.success) == (None, False)


@given(
    st.sampled_from(list(Primitive)),
    st.sampled_from(["{}", "Action: {}", "Action: <{}>.", "I choose {}.", "`{}`", "Next, {}!"]),
    st.data(),
)
def test_an_identifier_is_found_in_any_case(primitive, template, data):
    flips = data.draw(st.lists(st.booleans(), min_size=40, max_size=40))
    text = template.format(primitive)
    text = "".join(c.upper() if f else c for c, f in zip(text, flips + [False] * 40, strict=False))
    assert extract(text).action is primitive


@given(st.sampled_from([t for t in TABLE if t[0].isascii()]), st.randoms(use_true_random=False))
def test_case_changes_nothing(row, random):
    text, action, success = row
    swapped = "".join(random.choice((c.lower(), c.upper())) for c in text)
    extraction = extract(swapped)
    assert (extraction.action, extraction.success) == (action, success)


@given(
    AFFIRMED,
    st.sampled_from(
        [" is not ", " isn't ", " is never ", " is no longer ", " is hardly ", " cannot be called "]
    ),
)
def test_a_negation_takes_success_away(text, negated):
    assert extract(text).success
    assert not extract(text.replace(" is ", negated, 1)).success


@given(
    AFFIRMED,
    st.sampled_from(
        [" will be ", " should be ", " might be ", " would be ", " was ", " must become "]
    ),
)
def test_another_tense_or_mood_takes_success_away(text, mood):
    assert not extract(text.replace(" is ", mood, 1)).success


@given(AFFIRMED, st.sampled_from(["I doubt that ", "If ", "It is not true that ", "Unless "]))
def test_a_doubt_in_front_takes_success_away(text, front):
    assert not extract(front + text[0].lower() + text[1:]).success


@given(
    st.sampled_from([a for a in ACTIONS if a[0].split()[0] in ("move", "Squeeze", "Loosen", "Go")]),
    st.sampled_from(
        ["Do not {}", "Don’t {}", "Never {}", "There is no need to {}", "You must not {}"]
    ),
)
def test_a_prohibition_takes_the_action_away(row, prohibition):
    text, action, _ = row
    assert extract(text).action is action
    assert extract(prohibition.format(text[0].lower() + text[1:])).action is None


@given(st.sampled_from(NOTHING), st.sampled_from(string.whitespace))
def test_space_around_a_text_changes_nothing(text, space):
    extraction = extract(space * 3 + text + space)
    assert (extraction.action, extraction.success) == (None, False)


def test_a_text_that_never_ends_is_not_read():
    assert extract("The grasp is stable. " * 10).success
    extraction = extract("The grasp is stable. " * 1000)
    assert not extraction.success
    assert "21000 characters" in extraction.reason


@pytest.mark.parametrize("action", list(Primitive))
def test_none_beside_an_action_is_ambiguous(action):
    assert extract(f"<none> <{action}>").ambiguous


def test_the_reason_says_what_was_read():
    assert extract("Do not move up, move down.").reason == (
        "asks for move_down; declares no success; 'do not move up' is forbidden"
    )
    assert extract("The grasp is not secure.").reason == (
        "asks for no action; no success: 'the grasp is not secure' denies it"
    )
