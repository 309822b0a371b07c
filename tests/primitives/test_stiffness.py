"""Soft or hard, from the openings under two commanded forces."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from primitives.sense import Interval
from primitives.stiffness import LEAST_N, SOFT_MM, StiffnessReader
from tests.fakes.hidden_gain import HiddenGainGripper

EXACT = Interval(value=1.0, low=1.0, high=1.0)


def told(gripper: HiddenGainGripper, *commands_n: float, known: bool = True) -> bool | None:
    """What the openings under these commands tell."""
    reader = StiffnessReader()
    gain = Interval(value=gripper.gain, low=gripper.gain, high=gripper.gain) if known else None
    for command_n in commands_n:
        reader.feel(command_n, gripper.grip(command_n).width_m, gain)
    return reader.is_soft


@given(
    softness_mm=st.floats(0.1, 1.5),
    gain=st.floats(0.5, 2.0),
    low_n=st.floats(0.3, 1.0),
    factor=st.floats(3.0, 4.0),
)
def test_a_contact_is_soft_when_it_gives_way_further_than_the_bound(
    softness_mm, gain, low_n, factor
):
    assume(abs(softness_mm - SOFT_MM) > 1e-3)
    gripper = HiddenGainGripper(gain, softness_mm=softness_mm)
    expected = softness_mm > SOFT_MM
    assert told(gripper, low_n / gain, factor * low_n / gain) is expected


@pytest.mark.parametrize(
    ("name", "softness_mm", "is_soft"),
    [("peg", 0.13, False), ("egg", 0.21, False), ("tomato", 0.47, True), ("berry", 1.15, True)],
)
def test_the_kinds_of_objects_are_told_apart(name, softness_mm, is_soft):
    assert told(HiddenGainGripper(softness_mm=softness_mm), 0.3, 0.5, 1.0) is is_soft


def test_one_force_forces_too_close_or_too_light_and_no_reading_tell_nothing():
    gripper = HiddenGainGripper(softness_mm=1.0)
    assert told(gripper, 1.0) is None
    assert told(gripper, 1.0, 1.05) is None
    assert told(gripper, 0.5 * LEAST_N, 0.9 * LEAST_N) is None
    assert told(gripper, 0.5, 2.0, known=False) is None


def test_the_order_of_the_forces_does_not_matter():
    gripper = HiddenGainGripper(softness_mm=1.0)
    assert told(gripper, 2.0, 0.5) is True


def test_openings_of_another_contact_are_not_compared():
    reader = StiffnessReader()
    reader.feel(0.5, 0.030, EXACT)
    reader.new_contact()
    reader.feel(2.0, 0.020, EXACT)  # another place, narrower
    assert reader.is_soft is None


def test_what_was_told_of_the_object_outlives_an_opening():
    reader = StiffnessReader()
    reader.feel(0.5, 0.030, EXACT)
    reader.feel(2.0, 0.0299, EXACT)
    assert reader.is_soft is False
    reader.new_contact()
    assert reader.is_soft is False


def test_forces_known_before_the_gain_count_once_it_is_known():
    reader = StiffnessReader()
    gripper = HiddenGainGripper(softness_mm=1.0)
    reader.feel(0.5, gripper.grip(0.5).width_m, None)
    reader.feel(2.0, gripper.grip(2.0).width_m, EXACT)
    assert reader.is_soft is True
