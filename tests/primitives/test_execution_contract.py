"""Primitives under a contract: no course of them presses beyond the limit."""

from itertools import count

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from primitives import LimitError, Primitive
from primitives.contract import Contract
from primitives.devices import Pose
from primitives.execution import AT_LIMIT, INCREASE_FACTOR, Executor, PadAxes
from primitives.limits import Limits
from primitives.sense import ContactSense, Interval
from tests.fakes.contracts import STRAWBERRY, contract, refused_contract
from tests.fakes.hidden_gain import HiddenGainGripper

LIMITS = Limits(
    max_step_mm=4.0,
    workspace_low_m=(0.2, -0.3, 0.05),
    workspace_high_m=(0.6, 0.3, 0.5),
    max_travel_mm=200.0,
    min_force_n=0.1,
    max_force_n=30.0,
    max_speed_m_s=0.1,
)
START = Pose(position_m=np.array([0.4, 0.0, 0.2]), rotvec_rad=np.array([np.pi, 0, 0]))
MAX_GAIN = 2.0
SOFT_MM, HARD_MM = 0.9, 0.2
BERRY = contract(0.95, 1.9, 2.375)
HARD = contract(3.6, 7.2, 9.0, soft=STRAWBERRY)


class Arm:
    """Goes where it is told."""

    def __init__(self) -> None:
        self.at = START

    def pose(self) -> Pose:
        return self.at

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        self.at = pose
        return pose

    def stop(self) -> None: ...

    def disconnect(self) -> None: ...


class Touching:
    """An executor on a gripper with a hidden gain, and what is felt of it."""

    def __init__(
        self,
        held: Contract | None,
        *,
        gain: float = 1.0,
        softness_mm: float = HARD_MM,
        spread: float = 1.35,
        bias: float = 1.0,
        sees: bool = True,
        first_force_n: float = 1.0,
    ) -> None:
        self.gripper = HiddenGainGripper(gain, softness_mm=softness_mm)
        self.spread, self.bias = spread, bias
        sense = ContactSense(
            take_reference=lambda: None,
            in_contact=lambda: self.gripper.true_n > 0.1,
            felt_force=self.felt,
        )
        ticks = count()
        self.executor = Executor(
            Arm(),
            self.gripper,
            LIMITS,
            clear_mm=5.0,
            move_step_mm=3.0,
            first_force_n=first_force_n,
            start_pose=START,
            pad_axes=PadAxes(x_tcp=(0, 1, 0), y_tcp=(0, 0, -1)),
            clock=lambda: float(next(ticks)),
            sense=sense if sees else None,
            contract=held,
            max_gain=MAX_GAIN,
        )

    def felt(self) -> Interval | None:
        return self.gripper.felt(self.spread, self.bias) if self.gripper.true_n > 0 else None

    def feel(self) -> bool | None:
        return self.executor.feel(self.felt())

    def raise_force(self, times: int) -> list[float]:
        """Commands of this many increases, each felt before the next [N]."""
        sent = []
        for _ in range(times):
            self.feel()
            sent.append(self.executor.execute(Primitive.INCREASE_FORCE).force_n)
        return sent


actions = st.tuples(st.sampled_from(list(Primitive)), st.none() | st.floats(0.05, 60.0))


@settings(max_examples=60)
@given(
    held=st.sampled_from([BERRY, HARD, contract(0.3, 0.45, 0.495), contract(4.0, 6.0, 7.5)]),
    gain=st.floats(0.5, MAX_GAIN),
    softness_mm=st.floats(0.1, 1.3),
    spread=st.floats(1.05, 1.6),
    side=st.floats(-1.0, 1.0),
    sees=st.booleans(),
    first_force_n=st.floats(0.1, 8.0),
    course=st.lists(actions, max_size=15),
)
def test_no_course_of_primitives_and_replayed_forces_presses_beyond_the_limit(
    held, gain, softness_mm, spread, side, sees, first_force_n, course
):
    rig = Touching(
        held,
        gain=gain,
        softness_mm=softness_mm,
        spread=spread,
        bias=spread**side,
        sees=sees,
        first_force_n=first_force_n,
    )
    rig.executor.grasp()
    for primitive, force_n in course:
        if sees:
            rig.feel()
        try:
            executed = rig.executor.execute(primitive, force_n)
        except LimitError:  # out of travel or workspace, or a force that is none
            continue
        assert executed.force_n == pytest.approx(rig.gripper.state().force_n or executed.force_n)
        assert rig.gripper.peak_n <= held.terms.limit_n * (1 + 1e-6)


def test_a_first_grasp_without_touch_keeps_to_the_bound_that_the_rig_states():
    rig = Touching(BERRY, sees=False, first_force_n=8.0)
    executed = rig.executor.grasp()
    assert rig.gripper.commands_n == pytest.approx([2.375 / MAX_GAIN])
    assert executed.force_n == pytest.approx(2.375 / MAX_GAIN)
    assert any("contract's limit of 2.38 N" in note for note in executed.clamped)


@pytest.mark.parametrize("primitive", [Primitive.MOVE_UP, Primitive.RESET])
def test_a_replayed_force_beyond_the_limit_is_lowered_and_said_so(primitive):
    rig = Touching(BERRY, sees=False)
    rig.executor.grasp(0.5)
    executed = rig.executor.execute(primitive, 20.0)
    assert rig.gripper.peak_n == pytest.approx(2.375 / MAX_GAIN)
    assert any("lowered to 1.19 N" in note for note in executed.clamped)


def test_an_increase_at_the_contracts_limit_sends_nothing_and_says_so():
    rig = Touching(BERRY, sees=False)
    rig.executor.grasp(1.1)
    raised = rig.executor.execute(Primitive.INCREASE_FORCE)
    assert raised.force_n == pytest.approx(2.375 / MAX_GAIN)
    assert AT_LIMIT not in raised.clamped
    again = rig.executor.execute(Primitive.INCREASE_FORCE)
    assert again.sent == "nothing"
    assert AT_LIMIT in again.clamped
    assert any("a smaller gripper.max_force_gain" in note for note in again.clamped)


def test_what_is_felt_lets_a_weak_gripper_reach_the_band():
    rig = Touching(BERRY, gain=0.5, spread=1.2)
    rig.executor.grasp()
    rig.raise_force(8)
    assert rig.gripper.true_n in BERRY.terms.force_n
    assert rig.executor.gain is not None
    assert rig.executor.gain.value == pytest.approx(0.5)


def test_under_a_contract_for_hard_things_the_force_rises_in_small_steps_until_it_is_told():
    rig = Touching(HARD)
    rig.executor.grasp()
    before = rig.executor.force_n
    while rig.feel() is None:
        sent = rig.executor.execute(Primitive.INCREASE_FORCE).force_n
        assert sent <= before * INCREASE_FACTOR * (1 + 1e-9)
        assert rig.gripper.true_n <= STRAWBERRY.force_n.high
        before = sent
    assert rig.feel() is False
    rig.raise_force(6)
    assert rig.gripper.true_n in HARD.terms.force_n


@given(gain=st.floats(0.5, MAX_GAIN), softness_mm=st.floats(0.5, 1.3))
def test_a_soft_contact_is_told_before_it_is_pressed_beyond_the_band_of_soft_things(
    gain, softness_mm
):
    rig = Touching(HARD, gain=gain, softness_mm=softness_mm, spread=1.25)
    rig.executor.grasp()
    for _ in range(12):
        if rig.feel() is not None:
            break
        rig.executor.execute(Primitive.INCREASE_FORCE)
    assert rig.feel() is True
    assert rig.gripper.peak_n <= STRAWBERRY.force_n.high * (1 + 1e-6)


def test_before_it_is_told_no_command_presses_beyond_the_band_of_soft_things():
    rig = Touching(HARD, softness_mm=SOFT_MM)
    rig.executor.grasp(8.0)
    assert rig.gripper.peak_n == pytest.approx(STRAWBERRY.force_n.high / MAX_GAIN)


def test_openings_at_two_places_of_an_object_are_not_compared():
    rig = Touching(HARD)
    rig.executor.grasp(0.3)
    rig.feel()
    rig.gripper.rest_mm -= 5.0  # it is thinner there
    rig.executor.execute(Primitive.MOVE_UP, 0.9)
    assert rig.feel() is None


def test_after_an_objection_the_new_contract_bounds_and_aims():
    rig = Touching(HARD, softness_mm=SOFT_MM, spread=1.2)
    rig.executor.grasp()
    rig.raise_force(4)
    rig.executor.keep(contract(0.95, 1.9, 2.375))
    rig.raise_force(5)
    assert rig.gripper.true_n in STRAWBERRY.force_n
    assert rig.feel() is None  # nothing objects twice


def test_a_configuration_that_insists_is_not_objected_to():
    rig = Touching(contract(3.6, 7.2, 9.0), softness_mm=SOFT_MM)
    rig.executor.grasp()
    rig.raise_force(8)
    assert rig.feel() is None
    assert rig.gripper.true_n in HARD.terms.force_n


def test_a_refused_contract_makes_no_executor():
    with pytest.raises(LimitError, match="refused: it asks to let go"):
        Touching(refused_contract())


def test_a_baseline_without_a_contract_has_the_grippers_own_limits_alone():
    rig = Touching(None, sees=False)
    rig.executor.grasp(25.0)
    assert rig.gripper.commands_n == [25.0]
