"""What the record calls held, and the end with devices that fail in their own ways."""

import os
import signal
from types import SimpleNamespace

import pytest

from cltp.tactile.cloud import Stamp
from primitives import RobotError
from primitives.devices import GripperState
from sim.grasp.rig import build
from tacgrasp.config.layers import load
from tacgrasp.config.schema import VerifyConfig
from tacgrasp.runtime.outcome import EndOfEpisode, EndReason
from tacgrasp.runtime.shutdown import Ending, close, read_truth

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


class Devices:
    """Arm and gripper that note their calls; some of which raise.

    Args:
        errors: What a call raises, by its name.
        interrupted: Call during which the operator presses Ctrl-C.
    """

    def __init__(self, errors, interrupted=""):
        self.calls, self._errors, self._interrupted = [], errors, interrupted
        self.arm = SimpleNamespace(stop=lambda: self._call("arm.stop"))
        self.gripper = SimpleNamespace(
            stop=lambda: self._call("gripper.stop"),
            state=lambda: GripperState(width_m=0.03, force_n=1.0, closed=True),
            open_by=lambda _: self._call("open_by"),
        )
        self.clock = SimpleNamespace(stamp=lambda: Stamp(monotonic_s=1.0, wall_s=1.0))
        self.commands = tuple

    def truth(self):
        self._call("truth")

    def _call(self, name):
        self.calls.append(name)
        if name == self._interrupted:
            os.kill(os.getpid(), signal.SIGINT)
        if name in self._errors:
            raise self._errors[name]


def ended(rig, ends):
    steps = SimpleNamespace(
        record_cut_short=lambda *_: None,
        may_hang=False,
        num_actions=7,
        num_steps=8,
        elapsed_s=3.0,
        peak_felt_n=None,
        force_mark="",
        force_residual=None,
        gain=None,
    )
    return Ending(
        rig=rig,
        config=load("strawberry")[0],
        recorder=SimpleNamespace(finish=ends.append),
        steps=steps,
        end=EndOfEpisode(EndReason.TIMEOUT, "180 s"),
        last_step=None,
        verification=None,
    )


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("arm.stop", "the arm could not be stopped: OSError: unplugged"),
        ("gripper.stop", "the gripper could not be stopped: OSError: unplugged"),
        ("open_by", "the gripper could not be opened: OSError: unplugged"),
        ("truth", ""),
    ],
)
def test_whatever_a_device_raises_the_others_are_made_safe_and_the_record_ends(name, told):
    rig, ends = Devices({name: OSError("unplugged")}), []
    outcome = close(ended(rig, ends))
    assert rig.calls == ["truth", "arm.stop", "gripper.stop", "open_by"]
    assert outcome.reason is (EndReason.FAULT if told else EndReason.TIMEOUT)
    assert told in outcome.message
    assert [(end.reason, end.message) for end in ends] == [(outcome.reason, outcome.message)]


def test_an_interrupt_while_the_gripper_opens_does_not_hide_how_it_ended(caplog):
    ends = []
    rig = Devices({"open_by": RobotError("the fingers are stuck")}, interrupted="open_by")
    with pytest.raises(KeyboardInterrupt):
        close(ended(rig, ends))
    assert "the gripper could not be opened: the fingers are stuck" in caplog.text
    assert ends[0].reason == "fault"


def test_a_step_that_can_t_be_recorded_does_not_keep_the_record_from_its_end():
    def unplugged(*_):
        raise RobotError("the arm is unplugged")

    rig, ends = Devices({}), []
    ending = ended(rig, ends)
    ending.steps.record_cut_short = unplugged
    outcome = close(ending)
    assert outcome.message == "180 s; the arm is unplugged"
    assert [(end.reason, end.message) for end in ends] == [("fault", outcome.message)]
