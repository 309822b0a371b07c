"""Forces that are named without being asked for, and those that are forbidden from a bound on."""

import pytest

from policies.contract import read_contract
from policies.instructions.other_forces import without_other_forces
from tests.fakes.contracts import terms
from tests.policies.instructions.test_quantities import forces

USUAL = read_contract("hold it", terms(), {})


def band_of(text):
    found = read_contract(text, terms(), {})
    assert not found.refused
    return found.force_n, found.limit_n


@pytest.mark.parametrize(
    "text",
    [
        "do not use 2 N or more",
        "never use 2 N or more",
        "don't apply 2 newtons or above",
        "avoid 2 N and above",
        "no force of 2 N or more, please",
        "2 N or more is forbidden",
        "2 N and above is not allowed",
        "You must not reach 2 N or higher",
        "hold it, but without 2 N or more",
    ],
)
def test_what_is_forbidden_from_a_force_on_ends_below_it(text):
    force_n, limit_n = band_of(text)
    assert force_n.high < 2.0
    assert limit_n < 2.0


@pytest.mark.parametrize("text", ["not 1 N or less", "never go to 1 N or below"])
def test_what_is_forbidden_up_to_a_force_begins_above_it(text):
    assert band_of(text)[0].low >= 1.0


@pytest.mark.parametrize("text", ["hold it with 2 N or more", "do not hesitate to use 2 N or more"])
def test_what_is_asked_from_a_force_on_begins_there(text):
    assert band_of(text)[0].low >= 2.0


@pytest.mark.parametrize(
    "text",
    [
        "You may go over 2 N if you need to",
        "feel free to exceed 2 N",
        "it is fine if it goes above 2 N",
        "you can go beyond 2 N",
        "you are allowed to use more than 1 N",
    ],
)
def test_what_is_allowed_is_not_asked_for(text):
    assert band_of(text) == (USUAL.force_n, USUAL.limit_n)


def test_what_is_denied_to_a_person_bounds():
    assert band_of("you may not go over 2 N")[1] < 2.0
    assert band_of("you may go over 2 N but never above 3 N")[1] < 3.0


@pytest.mark.parametrize(
    "text",
    [
        "Grasp the strawberry. The egg needs 3 N.",
        "pick the berry, not the egg which needs 4 N",
        "pick the berry; the limit on the egg is 1 N",
        "for eggs the limit is 1 N. pick the berry",
        "pick the berry; the egg must not get more than 1 N",
        "the other robot's limit is 1 N, pick the berry",
        "the other one needs 3 N, pick this one",
    ],
)
def test_the_force_of_another_object_is_not_this_ones(text):
    assert band_of(text) == (USUAL.force_n, USUAL.limit_n)


@pytest.mark.parametrize(
    "text",
    [
        "the limit on the egg is 1 N",
        "pick the egg, the limit on the egg is 1 N",
        "pick this one, the limit on the egg is 1 N",
        "the limit for fruit is 1 N, pick the berry",
        "pick the berry out of the box with at most 1 N",
        "pick the berry for the box, at most 1 N",
        "treat the berry like an egg; the limit on the egg is 1 N",
    ],
)
def test_a_bound_that_may_be_of_this_object_counts(text):
    assert forces(text) == [("most", 1.0)]


@pytest.mark.parametrize(
    "text",
    [
        "the egg needs 3 N",
        "pick up the berry, the strawberry needs 3 N",
        "pick this one up, the egg needs 3 N",
        "hold the thing, the object needs 3 N",
    ],
)
def test_the_force_of_the_only_object_is_meant(text):
    assert without_other_forces(text) == text
    assert forces(text)


@pytest.mark.parametrize(
    "text",
    [
        "hold it with three times its weight",
        "use twice its weight",
        "squeeze with 2x the berry's weight",
    ],
)
def test_a_multiple_of_a_weight_is_refused(text):
    assert "multiple of a weight" in read_contract(text, terms(), {}).refused


def test_whether_a_force_would_do_is_a_question():
    assert "no request" in read_contract("Would 3 N be ok?", terms(), {}).refused


@pytest.mark.parametrize(
    "text",
    [
        "Don´t go over 0.9 N",
        "Don‘t go over 0.9 N",
        'DON"T GO OVER 0.9 N',
        "don;t go over 0.9 N",
        "don t exceed 0.9 N",
        "do nt go over 0.9 N",
        "can t be more than 0.9 N",
        "It shouldn t exceed 0.9 N",
        "Not 1 mN above 0.9 N",
        "Can't you go below 0.9 N?",
        "Stay away from 0.9 N",
        "0.9 N should be avoided",
        "any force except 0.9 N",
        "⩽ 0.9 N",
    ],
)
def test_a_bound_is_kept_however_its_denial_is_typed(text):
    force_n, limit_n = band_of(text)
    assert force_n.high < 0.9
    assert limit_n < 0.9


@pytest.mark.parametrize(
    "text",
    [
        "Exceed 0.9 N and it dies",
        "Only a fool exceeds 0.9 N",
        "Beware of exceeding 0.9 N",
        "Careful: above 0.9 N",
        "More than 0.9 N is asking for trouble",
        "nicht more than 0.9 N",
        "1 N or more would ruin it, so go easy",
        "Bob uses at least 2 N",
        "Apples are picked with at least 2 N",
        "The lid needs 4 N",
        "2 N with a safety margin of 50 %",
    ],
)
def test_a_force_that_may_be_a_warning_is_no_wish(text):
    assert read_contract(text, terms(), {}).refused


@pytest.mark.parametrize(
    "text",
    [
        "hold it with more than 1 N",
        "at least 1 N please",
        "grip it firmly, above 1 N",
        "Grip the rubber plug with 1 N or more.",
        "The strawberry needs at least 1 N",
        "It's wet from the rinse, so use no less than 1 N, okay?",
    ],
)
def test_a_plain_wish_for_more_is_heard(text):
    assert band_of(text)[0].low >= 1.0


@pytest.mark.parametrize(
    ("text", "middle_n"),
    [
        ("use 1/4 of the 2 N", 0.5),
        ("½ of 2 N", 1.0),
        ("2/3 of 0.9 N", 0.6),
        ("Reduce the grip force from 2.5 newtons to half a newton", 0.5),
        ("Change 2 N to 0.4 N", 0.4),
    ],
)
def test_a_share_or_a_lowered_force_is_worked_out(text, middle_n):
    force_n, _ = band_of(text)
    assert (force_n.low + force_n.high) / 2 == pytest.approx(middle_n, rel=0.02)


def test_a_bound_of_a_share_bounds_the_share():
    assert band_of("at most ½ of 2 N")[1] < 1.0


def test_neither_bound_is_lost_behind_nothing():
    force_n, limit_n = band_of("Nothing under 0.3 or over 0.8 N")
    assert force_n.low == pytest.approx(0.3)
    assert limit_n < 0.8
