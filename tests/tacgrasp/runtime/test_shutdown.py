"""What the record calls held."""

import pytest

from sim.grasp.rig import build
from tacgrasp.config.schema import VerifyConfig
from tacgrasp.runtime.shutdown import read_truth

AT_ONCE, SLOWLY = VerifyConfig(), VerifyConfig(lift_off_mm=1.0)


@pytest.mark.parametrize(
    ("slip_mm", "verify", "is_held"),
    [(0.0, AT_ONCE, True), (2.5, AT_ONCE, False), (0.0, SLOWLY, True), (2.5, SLOWLY, True)],
)
def test_a_slide_is_part_of_a_slow_lift_off_alone(
    slip_mm: float, verify: VerifyConfig, is_held: bool
) -> None:
    rig = build("strawberry", 5)
    rig.gripper.grip(1.0)
    rig.grasp.slip_mm = slip_mm
    truth = read_truth(rig, verify)
    assert truth is not None
    assert truth["held"] is is_held
    assert truth["slipped"] is (slip_mm > 1)


@pytest.mark.parametrize("verify", [AT_ONCE, SLOWLY])
def test_open_fingers_and_dropped_bodies_hold_nothing(verify: VerifyConfig) -> None:
    rig = build("strawberry", 5)
    facts = read_truth(rig, verify)
    rig.gripper.grip(1.0)
    rig.grasp.dropped = True
    dropped = read_truth(rig, verify)
    assert facts is not None and dropped is not None
    assert not facts["held"] and not dropped["held"]
