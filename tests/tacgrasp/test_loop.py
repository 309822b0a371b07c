"""The loop: every named end, what is moved and what is not, and the robot safe on every path."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from cltp import TouchError
from cltp.sensing.frames import jpeg_of
from policies import PolicyError
from primitives import LimitError, Primitive, RobotError
from primitives.errors import TorqueOffError
from primitives.execution import APPROACH_FACTOR, APPROACH_STEP_N
from tacgrasp.episodes import StepPhase, StepRecord
from tacgrasp.runtime.outcome import EndReason
from tacgrasp.runtime.steps import NO_CONTACT_DECISION
from tacgrasp.runtime.verify import not_lifted, verify_by_lifting
from tests.fakes.contracts import contract
from tests.fakes.loop_fakes import (
    BOTH,
    DOWN,
    GOOD,
    LIGHT,
    NOTHING,
    RESET,
    TWO,
    FakeRig,
    ListRecorder,
    Scripted,
    config,
    play,
    slips,
    with_end,
)


def test_a_declared_and_verified_grasp_is_a_success_and_is_held() -> None:
    outcome, rig, recorder = play(Scripted(DOWN, LIGHT, GOOD))
    assert outcome.reason is EndReason.SUCCESS
    assert (outcome.declared, outcome.verified, outcome.num_actions) == (True, True, 2)
    assert [step.executed is not None for step in recorder.steps] == [True, True, False]
    assert rig.gripper.current.closed
    assert recorder.ends[0].reason == "success"


def test_a_text_that_only_declares_success_moves_nothing() -> None:
    _, rig, _ = play(Scripted(GOOD))
    assert rig.moves == 0
    assert rig.calls.count("gripper.grip") == 1  # the first grasp


def test_a_text_with_success_and_action_acts_and_must_declare_again() -> None:
    outcome, rig, recorder = play(Scripted(BOTH, GOOD))
    assert rig.moves == 1
    assert len(recorder.steps) == 2
    assert outcome.reason is EndReason.SUCCESS


def test_a_declared_success_that_the_lift_denies_is_unverified_and_released() -> None:
    outcome, rig, _ = play(Scripted(GOOD), verify=slips)
    assert outcome.reason is EndReason.UNVERIFIED
    assert (outcome.declared, outcome.verified) == (True, False)
    assert not rig.gripper.current.closed


@pytest.mark.parametrize("text", [NOTHING, TWO])
def test_no_action_or_two_holds_still_asks_again_and_ends_with_no_action(text: str) -> None:
    policy = Scripted(text)
    outcome, rig, recorder = play(policy, settings=config(max_asks=3))
    assert outcome.reason is EndReason.NO_ACTION
    assert policy.num_asks == 3
    assert rig.moves == 0
    assert [step.decision is not None for step in recorder.steps] == [True] * 3


def test_asks_in_vain_are_counted_in_a_row_only() -> None:
    outcome, _, _ = play(Scripted(NOTHING, DOWN, NOTHING, GOOD), settings=config(max_asks=2))
    assert outcome.reason is EndReason.SUCCESS


def test_as_many_actions_as_the_task_allows_end_with_max_steps() -> None:
    outcome, rig, recorder = play(Scripted(DOWN, LIGHT, DOWN, LIGHT), settings=config(max_steps=3))
    assert outcome.reason is EndReason.MAX_STEPS
    assert outcome.num_actions == 3
    assert rig.moves == 2
    assert recorder.steps[-1].executed is None


def test_time_ends_with_timeout() -> None:
    rig = FakeRig(lambda name, _: rig.clock.sleep(10) if name == "arm.move_to" else None)
    outcome, _, _ = play(Scripted(DOWN), rig=rig, settings=config(timeout_s=25))
    assert outcome.reason is EndReason.TIMEOUT
    assert outcome.num_actions == 3  # over at 10, 20 and 30 s


def executed_primitives(recorder: ListRecorder) -> list[Primitive | None]:
    return [step.executed.primitive if step.executed else None for step in recorder.steps]


def missing(*empty_closings: int) -> FakeRig:
    """A rig whose closings with these numbers, from 0, are on nothing."""
    rig = FakeRig()

    def is_missed() -> bool:
        return rig.calls.count("sensor.take_reference") - 1 in empty_closings

    rig.sensor.is_missed = is_missed
    return rig


def test_a_closing_on_nothing_is_followed_by_the_runtimes_own_reset() -> None:
    policy = Scripted(GOOD)
    outcome, _, recorder = play(policy, rig=missing(0))
    assert executed_primitives(recorder)[:2] == [Primitive.RESET, None]
    assert recorder.steps[0].decision is NO_CONTACT_DECISION
    assert policy.num_asks == 1  # not about nothing
    assert outcome.reason is EndReason.SUCCESS


def test_without_contact_no_text_adds_force_moves_or_declares_success() -> None:
    for text in (GOOD, DOWN, LIGHT):
        policy = Scripted(text)
        outcome, rig, recorder = play(policy, rig=missing(*range(9)))
        assert outcome.reason is EndReason.CONTACT_LOST
        assert executed_primitives(recorder) == [Primitive.RESET, None]
        assert policy.num_asks == 0
        assert rig.gripper.current.force_n <= rig.first_force_n


def test_fingers_that_closed_on_nothing_end_as_wide_as_they_began() -> None:
    rig = missing(*range(9))
    began_m = rig.gripper.current.width_m
    outcome, _, _ = play(Scripted(GOOD), rig=rig)
    assert (outcome.reason, outcome.safe_state) == (
        EndReason.CONTACT_LOST,
        "the gripper has released",
    )
    assert rig.gripper.current.width_m == pytest.approx(began_m)


def test_contact_in_between_lets_the_runtime_reset_again() -> None:
    outcome, _, recorder = play(Scripted(DOWN, GOOD), rig=missing(0, 2))
    reset, down = Primitive.RESET, Primitive.MOVE_DOWN
    assert executed_primitives(recorder)[:4] == [reset, down, reset, None]
    assert outcome.reason is EndReason.SUCCESS


def test_a_policys_own_resets_do_not_count_and_are_bounded_like_all_actions() -> None:
    outcome, _, recorder = play(Scripted(RESET), settings=config(max_steps=4))
    assert outcome.reason is EndReason.MAX_STEPS
    assert executed_primitives(recorder) == [*[Primitive.RESET] * 4, None]


def test_the_first_grasp_rises_until_something_is_felt() -> None:
    _, rig, _ = play(Scripted(GOOD))
    least_n = config().gripper.min_force_n
    assert rig.gripper.forces_n == [least_n]  # felt at the first step
    _, rig, _ = play(Scripted(GOOD), rig=missing(*range(9)))
    steps_n = approach_n(least_n, rig.first_force_n)
    assert rig.gripper.forces_n == pytest.approx([*steps_n, *steps_n])  # and the runtime's reset
    assert all(1 < b / a <= 1 + 1 / 3 + 1e-9 for a, b in pairwise(steps_n))


def approach_n(least_n: float, top_n: float) -> list[float]:
    """Forces of an approach in which nothing is felt [N]."""
    steps_n = [least_n]
    while steps_n[-1] < top_n:
        rise_n = max(APPROACH_STEP_N, (APPROACH_FACTOR - 1) * steps_n[-1])
        steps_n.append(min(steps_n[-1] + rise_n, top_n))
    return steps_n


def test_travel_beyond_the_limit_ends_with_limit_and_nothing_more_is_sent() -> None:
    settings = config(max_steps=100)
    arm = settings.arm.model_copy(update={"max_travel_mm": 10.0})
    outcome, rig, _ = play(Scripted(DOWN), settings=settings.model_copy(update={"arm": arm}))
    assert outcome.reason is EndReason.LIMIT
    assert rig.moves == 3  # 9 mm; the fourth would make it 12


def test_asking_for_more_force_than_allowed_ends_with_limit() -> None:
    settings = config(max_steps=100)
    gripper = settings.gripper.model_copy(update={"max_force_n": 2.0})
    settings = settings.model_copy(update={"gripper": gripper})
    outcome, rig, _ = play(Scripted(LIGHT), settings=settings, contract=contract(50.0, 60.0, 100.0))
    assert outcome.reason is EndReason.LIMIT
    approach = approach_n(settings.gripper.min_force_n, rig.first_force_n)
    assert rig.gripper.forces_n == pytest.approx([*approach, 2.0])


def test_a_change_that_the_goal_leaves_no_room_for_is_no_action() -> None:
    settings = config(max_asks=2)
    felt, _, _ = play(Scripted("I don't know."), settings=settings)
    assert felt.peak_felt_n is not None
    tight = contract(felt.peak_felt_n / 2, felt.peak_felt_n, 100.0)
    outcome, _, recorder = play(Scripted(LIGHT), settings=settings, contract=tight)
    assert outcome.reason is EndReason.NO_ACTION
    sent = [step.executed.sent_nothing for step in recorder.steps if step.executed is not None]
    assert sent[-2:] == [True, True]


def failing(device_call: str, error: Exception, times: int) -> Callable[[str, int], None]:
    remaining = [times]

    def before(name: str, _: int) -> None:
        if name == device_call and remaining[0] > 0:
            remaining[0] -= 1
            raise error

    return before


def test_a_sensor_that_comes_back_is_survived_and_noted() -> None:
    rig = FakeRig(failing("sensor.read", TouchError("no fresh frame"), 2))
    outcome, _, recorder = play(Scripted(GOOD), rig=rig, settings=config(max_faults=3))
    assert outcome.reason is EndReason.SUCCESS
    assert "no fresh frame" in recorder.steps[0].note


def test_a_sensor_that_stays_away_ends_with_fault_and_nothing_moves() -> None:
    rig = FakeRig(failing("sensor.read", TouchError("unplugged"), 99))
    outcome, _, recorder = play(Scripted(DOWN), rig=rig, settings=config(max_faults=3))
    assert outcome.reason is EndReason.FAULT
    assert "unplugged" in outcome.message
    assert rig.calls.count("sensor.read") == 3
    assert rig.moves == 0
    assert not rig.gripper.current.closed
    assert recorder.ends[0].reason == "fault"


def test_a_policy_that_fails_is_asked_again_then_ends_with_fault() -> None:
    broken = PolicyError("no such weights")
    assert play(Scripted(broken, GOOD))[0].reason is EndReason.SUCCESS
    policy = Scripted(broken)
    outcome, rig, _ = play(policy, settings=config(max_faults=2))
    assert outcome.reason is EndReason.FAULT
    assert policy.num_asks == 2
    assert rig.moves == 0


def test_a_recorder_that_fails_stops_the_robot_and_ends_with_fault() -> None:
    outcome, rig, recorder = play(Scripted(DOWN), recorder=ListRecorder(full_at=1))
    assert outcome.reason is EndReason.FAULT
    assert "disk is full" in outcome.message
    assert len(recorder.steps) == 1
    assert "arm.stop" in rig.calls
    assert not rig.gripper.current.closed


def test_a_recorder_that_refuses_the_end_makes_a_success_a_fault() -> None:
    recorder = ListRecorder(full_at=1)
    outcome, _, _ = play(Scripted(GOOD), recorder=recorder)
    assert outcome.reason is EndReason.FAULT
    assert recorder.ends == []


def test_a_bug_makes_the_robot_safe_ends_the_record_and_is_raised() -> None:
    rig, recorder = FakeRig(), ListRecorder()

    def bug(_: StepRecord) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        play(Scripted(DOWN), rig=rig, recorder=recorder, observers=[bug])
    assert "arm.stop" in rig.calls
    assert not rig.gripper.current.closed
    assert recorder.ends[0].reason == "fault"


@pytest.mark.parametrize("on_failure", ["hold", "release"])
@pytest.mark.parametrize(
    ("policy", "reason"),
    [
        (Scripted(NOTHING), EndReason.NO_ACTION),
        (Scripted(RESET), EndReason.MAX_STEPS),
        (Scripted(PolicyError("broken")), EndReason.FAULT),
    ],
)
def test_a_failed_episode_leaves_the_gripper_as_the_task_says(
    policy: Scripted, reason: EndReason, on_failure: str
) -> None:
    settings = with_end(config(), on_success="hold", on_failure=on_failure)
    outcome, rig, _ = play(policy, settings=settings)
    assert outcome.reason is reason
    assert rig.gripper.current.closed is (on_failure == "hold")


@pytest.mark.parametrize("on_success", ["hold", "release"])
def test_a_success_leaves_the_gripper_as_the_task_says(on_success: str) -> None:
    settings = with_end(config(), on_success=on_success, on_failure="release")
    _, rig, _ = play(Scripted(GOOD), settings=settings)
    assert rig.gripper.current.closed is (on_success == "hold")


SCRIPT = (DOWN, LIGHT, RESET, GOOD)


def device_calls() -> list[str]:
    outcome, rig, _ = play(Scripted(*SCRIPT), verify=verify_by_lifting)
    assert outcome.reason is EndReason.SUCCESS
    return rig.calls


CALLS = device_calls()
CLOSING = len(CALLS) - CALLS[::-1].index("arm.stop") - 1
"""Index of the first call that makes safe."""

MOVES = [index for index, name in enumerate(CALLS) if name == "arm.move_to"]
LIFT = MOVES[play(Scripted(*SCRIPT))[1].moves]
"""Index of the first call that lifts."""


@pytest.mark.parametrize("index", range(len(CALLS)))
def test_ctrl_c_in_any_device_call_leaves_the_robot_safe_and_the_episode_ended(index: int) -> None:
    def interrupt(name: str, number: int) -> None:
        if number == index:
            raise KeyboardInterrupt

    rig = FakeRig(interrupt)
    outcome, _, recorder = play(Scripted(*SCRIPT), rig=rig, verify=verify_by_lifting)
    after = rig.calls[index + 1 :]
    if index < CLOSING:
        assert outcome.reason is EndReason.OPERATOR
        assert "arm.stop" in after
        assert "arm.move_to" not in after
        # the strawberry's on_failure is release, but in the air it would fall
        assert rig.gripper.current.closed is (index >= LIFT)
    else:
        assert CALLS[index] in after  # a step of making safe is taken up again
    assert len(recorder.ends) == 1


@pytest.mark.parametrize("index", range(CLOSING))
@pytest.mark.parametrize("error", [RobotError("link lost"), LimitError("refused")])
def test_a_robot_error_in_any_device_call_stops_the_arm_and_ends_the_episode(
    index: int, error: RobotError
) -> None:
    def fail(name: str, number: int) -> None:
        if number == index:
            raise error

    rig = FakeRig(fail)
    outcome, _, recorder = play(Scripted(*SCRIPT), rig=rig, verify=verify_by_lifting)
    expected = EndReason.LIMIT if isinstance(error, LimitError) else EndReason.FAULT
    assert outcome.reason is expected
    assert str(error) in outcome.message
    after = rig.calls[index + 1 :]
    assert "arm.stop" in after
    assert len(recorder.ends) == 1


@pytest.mark.parametrize("error", [KeyboardInterrupt(), RobotError("protective stop")])
@pytest.mark.parametrize("move", range(len(MOVES)))
def test_what_may_hang_in_the_air_is_held_and_it_is_said_how_to_let_go(
    move: int, error: BaseException
) -> None:
    def fail(name: str, number: int) -> None:
        if number == MOVES[move]:
            raise error

    rig = FakeRig(fail)
    outcome, _, _ = play(Scripted(*SCRIPT), rig=rig, verify=verify_by_lifting)
    is_lifted = MOVES[move] >= LIFT
    assert rig.gripper.current.closed is is_lifted
    assert ("hang in the air" in outcome.safe_state) is is_lifted
    assert ("tacgrasp jog --open" in outcome.safe_state) is is_lifted


def test_what_is_back_where_it_stood_is_let_go_as_the_task_says() -> None:
    rig = FakeRig()
    rig.sensor.is_missed = lambda: rig.moves > 0  # nothing is felt any more as it is lifted
    outcome, _, _ = play(Scripted(GOOD), rig=rig, verify=verify_by_lifting)
    assert (outcome.reason, outcome.safe_state) == (
        EndReason.UNVERIFIED,
        "the gripper has released",
    )
    assert rig.arm.pose() == rig.start_pose


@pytest.mark.parametrize("on_failure", ["hold", "release"])
@pytest.mark.parametrize("error", [TorqueOffError("it has let go"), RobotError("it is gone")])
def test_a_gripper_that_fails_in_the_lift_may_hold_unless_its_torque_is_off(
    error: RobotError, on_failure: str
) -> None:
    def fail(name: str, number: int) -> None:
        if rig.moves and name == "gripper.state":
            raise error

    rig = FakeRig(fail)
    settings = with_end(config(), on_success="hold", on_failure=on_failure)
    outcome, _, _ = play(Scripted(GOOD), rig=rig, verify=verify_by_lifting, settings=settings)
    assert outcome.reason is EndReason.FAULT
    assert outcome.message.startswith(str(error))
    if isinstance(error, TorqueOffError):
        assert outcome.safe_state == "the gripper has no torque and holds nothing"
    elif on_failure == "hold":
        assert outcome.safe_state == "the gripper keeps its grip"
    else:
        assert "what it grips may still be held" in outcome.safe_state


def test_what_was_said_before_a_fault_is_recorded() -> None:
    rig = FakeRig(failing("arm.move_to", RobotError("protective stop"), 1))
    _, _, recorder = play(Scripted(DOWN), rig=rig)
    assert recorder.steps[-1].decision is not None
    assert recorder.steps[-1].decision.text == DOWN
    assert "protective stop" in recorder.steps[-1].note


def test_a_gripper_that_will_not_release_is_a_fault_even_after_ctrl_c() -> None:
    def before(name: str, number: int) -> None:
        if name == "sensor.read" and rig.gripper.current.closed:
            raise KeyboardInterrupt
        if name == "gripper.open_by":
            raise RobotError("bus dead")

    rig = FakeRig(before)
    outcome, _, _ = play(Scripted(DOWN), rig=rig)
    assert outcome.reason is EndReason.FAULT
    assert "could not be opened: bus dead" in outcome.message
    assert "stopped by the operator" in outcome.message
    assert "support it, then switch the gripper's power off" in outcome.message


def test_a_gripper_whose_own_fault_keeps_it_from_releasing_says_why_once() -> None:
    def before(name: str, number: int) -> None:
        if name in ("gripper.grip", "gripper.open_by", "gripper.state"):
            raise RobotError("servo 1 is gone")

    outcome, _, _ = play(Scripted(DOWN), rig=FakeRig(before))
    assert outcome.reason is EndReason.FAULT
    assert outcome.message.count("servo 1 is gone") == 1
    assert "the gripper could not be opened; what it grips may still be held" in outcome.message


def test_the_verification_records_a_touch_before_and_after_the_lift() -> None:
    _, _, recorder = play(Scripted(GOOD), verify=verify_by_lifting)
    phases = [step.phase for step in recorder.steps]
    assert phases == [StepPhase.LOOP, StepPhase.VERIFY_BEFORE, StepPhase.VERIFY_AFTER]
    lifted = recorder.steps[-1].tcp_pose.position_m - recorder.steps[0].tcp_pose.position_m
    assert lifted[2] == pytest.approx(config().verify.lift_mm / 1000)
    assert abs(lifted[:2]).max() < 1e-9


def test_observers_are_told_every_step_after_it_is_recorded() -> None:
    recorder = ListRecorder()
    notified: list[tuple[int, int]] = []
    play(
        Scripted(DOWN, GOOD),
        recorder=recorder,
        observers=[lambda record: notified.append((record.index, len(recorder.steps)))],
    )
    assert notified == [(0, 1), (1, 2)]


@pytest.mark.parametrize("text", [DOWN, LIGHT, GOOD])
def test_a_dry_run_decides_once_sends_nothing_and_is_no_success(text: str) -> None:
    settings = config().model_copy(update={"dry_run": True})
    outcome, rig, recorder = play(Scripted(text), settings=settings, verify=not_lifted)
    assert set(rig.calls) <= {"sensor.read", "arm.pose", "gripper.state"}
    assert outcome.reason is EndReason.DRY_RUN
    assert outcome.num_actions == 0
    assert len(recorder.steps) == 1


def test_every_step_records_the_frame_of_a_sensor_with_a_camera() -> None:
    rig = FakeRig()
    frame = np.full((240, 320, 3), 100, dtype=np.uint8)
    rig.sensor.last_frame = lambda: frame  # type: ignore[attr-defined]
    _, _, recorder = play(Scripted(DOWN, GOOD), rig=rig)
    assert len(recorder.steps) > 1
    assert all(record.camera_jpeg == jpeg_of(frame) for record in recorder.steps)
    _, _, recorder = play(Scripted(DOWN, GOOD))
    assert all(record.camera_jpeg is None for record in recorder.steps)
