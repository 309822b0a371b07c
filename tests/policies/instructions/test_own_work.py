"""What people tell of themselves is no harm and no request; what they ask of the robot is."""

import pytest

from policies.instructions.own_work import without_bodies
from policies.instructions.reader import read_request


@pytest.mark.parametrize(
    "text",
    [
        "Pick the berry; I'm on my knees under the bench.",
        "Lift the berry, my back is killing me.",
        "I've dough up to my elbows, so please take the berry.",
        "We're cutting the other fruits, hold this berry.",
    ],
)
def test_own_bodies_and_work_are_no_harm(text: str) -> None:
    assert read_request(text).refused == ""


@pytest.mark.parametrize(
    "text",
    [
        "I want my thumb squeezed.",
        "I have my hand in the gripper, close it.",
        "I'm holding out my finger, squeeze it.",
        "Pinch his nose, my hands are full.",
        "We need to crush this berry.",
    ],
)
def test_what_is_asked_of_the_robot_stays_refused(text: str) -> None:
    assert read_request(text).refused != ""


def test_a_clause_about_the_robot_stays() -> None:
    assert "jaws" in without_bodies("i have my hand in the jaws")
    assert without_bodies("hold, i wash my hands").strip() == "hold,"
