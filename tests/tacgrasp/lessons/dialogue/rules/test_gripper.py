"""What touch can't know of the gripper and its moves."""

import pytest

from tacgrasp.lessons.dialogue.rules.elsewhere import of_gripper, of_outcome
from tacgrasp.lessons.understanding import understood_by_grammar


@pytest.mark.parametrize(
    ("question", "subject"),
    [
        ("Left finger or right finger?", "finger"),
        ("Is that the right or the left jaw?", "finger"),
        ("Which of your two fingers is this?", "finger"),
        ("Do I ask the first gripper finger or the second one?", "finger"),
        ("I wonder which arm is pressing.", "finger"),
        ("Is the reading from the left-hand sensor or the right-hand one?", "finger"),
        ("How wide are the jaws opened?", "opening"),
        ("What is the gap between your fingers?", "opening"),
        ("Please tell me the gripper's aperture.", "opening"),
        ("What would happen if I opened the gripper by 1 mm?", "outcome"),
        ("Suppose the jaws closed 300 microns further, how deep would it be?", "outcome"),
        ("If you release it now, does it drop?", "outcome"),
        ("Would it stay put if the operator tilted the wrist?", "outcome"),
        ("And what if somebody bumps it?", "outcome"),
        ("What will change once the robot turns it upside down?", "outcome"),
        ("What happens if the air supply fails?", "outcome"),
    ],
)
def test_fingers_openings_and_moves_are_not_felt(question, subject):
    assert understood_by_grammar(question).query == f"unknown {subject}."


@pytest.mark.parametrize(
    "question",
    [
        "Is it on the left or the right side of the finger?",
        "Is it nearer to the upper or the lower edge of the sensor?",
        "Left or right?",
        "Palm or fingertip?",
        "If I dropped the force to 0.5 N, would it slip?",
        "If I let go of 0.2 N, are we in the band?",
        "If I closed the gripper until 2 N are felt, would we be in the band?",
        "Should I open the gripper?",
        "When I let go by half, what will the remaining squeeze be in newtons?",
    ],
)
def test_sides_and_supposed_forces_are_no_matter_of_the_gripper(question):
    assert of_gripper(question) is None


@pytest.mark.parametrize(
    "question", ["What happens if I add 0.2 N?", "What will happen when I lift it?", "What now?"]
)
def test_what_is_calculated_or_advised_is_no_outcome(question):
    assert of_outcome(question) is None
