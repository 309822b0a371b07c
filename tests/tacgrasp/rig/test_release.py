"""A gripper is opened on every way out of a block, and a failure to open is told."""

import os
import signal

import pytest

from cltp import TouchError
from primitives import RobotError
from primitives.errors import TorqueOffError
from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.rig.release import FREE_BY_HAND, let_go, opened_afterwards


def fails():
    raise RobotError("the servo is gone")


@pytest.mark.parametrize(
    "error",
    [None, KeyboardInterrupt(), TouchError("no frame"), UsageError("input ended"), ValueError("x")],
)
def test_a_closed_gripper_is_opened_whatever_ends_the_block(error):
    rig = build("egg", 5, start_offset_mm=(0, 0))
    raised = None
    try:
        with opened_afterwards(lambda: let_go(rig.gripper, 0.01)):
            rig.gripper.grip(1.0)
            if error is not None:
                raise error
    except BaseException as left:
        raised = left
    assert raised is error
    assert rig.truth().force_n == 0.0
    assert not rig.gripper.state().closed


def test_an_open_gripper_does_not_move():
    rig = build("egg", 5, start_offset_mm=(0, 0))
    before_m = rig.gripper.state().width_m
    let_go(rig.gripper, 0.01)
    assert rig.gripper.state().width_m == before_m


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (None, "the gripper could not be opened: the servo is gone"),
        (KeyboardInterrupt(), "stopped by the operator; the gripper could not be opened: the"),
        (KeyboardInterrupt("stopped by SIGTERM"), "stopped by SIGTERM; the gripper could not be"),
        (TouchError("no frame"), "no frame; the gripper could not be opened: the servo is gone"),
        (RobotError("the servo is gone"), "the servo is gone; the gripper could not be opened; w"),
    ],
)
def test_a_gripper_that_does_not_open_is_told_with_what_frees_it(error, told):
    with pytest.raises(RobotError) as raised, opened_afterwards(fails):
        if error is not None:
            raise error
    assert str(raised.value).startswith(told)
    assert str(raised.value).endswith(FREE_BY_HAND)


def test_of_a_gripper_without_torque_nothing_may_still_be_held():
    def limp():
        raise TorqueOffError("servo 1 has restarted")

    with pytest.raises(RobotError) as raised, opened_afterwards(limp):
        raise RobotError("servo 1 has restarted")
    assert str(raised.value) == (
        "servo 1 has restarted; the gripper has no torque and holds nothing"
    )


def test_a_bug_stays_a_bug_and_has_the_line_beside_it():
    with pytest.raises(ValueError, match="a bug") as raised, opened_afterwards(fails):
        raise ValueError("a bug")
    (note,) = raised.value.__notes__
    assert "the gripper could not be opened" in note


def test_ctrl_c_waits_until_the_gripper_is_open():
    done = []

    def open_up():
        os.kill(os.getpid(), signal.SIGINT)
        done.append("open")

    with pytest.raises(KeyboardInterrupt), opened_afterwards(open_up):
        pass
    assert done == ["open"]


def test_a_second_ctrl_c_does_not_hide_that_the_gripper_holds():
    def open_up():
        os.kill(os.getpid(), signal.SIGINT)
        fails()

    with pytest.raises(RobotError, match="could not be opened"), opened_afterwards(open_up):
        raise KeyboardInterrupt
