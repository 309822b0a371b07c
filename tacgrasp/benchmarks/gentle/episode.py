"""One episode of ``tacgrasp bench gentle``: the loop, then lift, shake, hold and set down.

Everything is judged by the truth of the world, from the first touch to the fruit set down.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from primitives.devices import GripperState
from sim.grasp.devices import SimGripper
from sim.grasp.rig import SimRig, build, draw_holdable, world_of
from sim.grasp.world import Grasp
from tacgrasp.benchmarks.gentle.arms import BlankedPolicy, GentleArm
from tacgrasp.benchmarks.loop.contestants import Contestant, enter
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes.record import StepPhase, StepRecord
from tacgrasp.loop import run_episode
from tacgrasp.rig.factory import make_executor
from tacgrasp.runtime.steps import NoRecorder
from tacgrasp.runtime.verify import accelerations, verify_by_lifting


@dataclass(frozen=True, slots=True, kw_only=True)
class FruitFacts:
    """The fruit of a seed; units are in the names.

    Attributes:
        slip_minimum_n: Least true force that holds it through the whole programme.
        num_redrawn: Fruit drawn before it that bruise too soon.
    """

    mass_g: float
    size_mm: float
    young_mpa: float
    friction: float
    bruise_n: float
    slip_minimum_n: float
    num_redrawn: int


@dataclass(frozen=True, slots=True, kw_only=True)
class GentleResult:
    """One episode of one arm, with the truth.

    Attributes:
        seed: Random seed of the episode.
        instruction: The words.
        force_n: The one force of a swept arm; None for others.
        reason, message: The named end, and its explanation.
        declared: Whether the policy declared success.
        verified_by_touch: What the verification said; None when nothing was lifted.
        held: It truly hung in the fingers at the end of the hold.
        dropped: No longer between the fingers.
        bruised: Bruised at any time, from the first touch on.
        slip_mm: How far it slipped [mm].
        num_actions: Actions after the first grasp.
        peak_n: Largest true force [N].
        slip_minimum_n: Least true force that holds it through the programme, centred [N].
        commanded_mean_n: Mean over time of the command while the fingers are closed [N].
        measured_mean_n, measured_max_n: Mean and largest of all felt forces, of steps and of the
            reflex's frames [N]; None where nothing was felt.
        simulated_s: Simulated time with closed fingers [s].
        seconds: Time that the episode took of one core [s].
    """

    seed: int
    instruction: str
    force_n: float | None
    reason: str
    message: str
    declared: bool
    verified_by_touch: bool | None
    held: bool
    dropped: bool
    bruised: bool
    slip_mm: float
    num_actions: int
    peak_n: float
    slip_minimum_n: float
    commanded_mean_n: float | None
    measured_mean_n: float | None
    measured_max_n: float | None
    simulated_s: float
    seconds: float

    @property
    def verified(self) -> bool:
        """Declared, truly lifted and held, never bruised and never dropped."""
        return self.declared and self.held and not self.bruised and not self.dropped


class TimedGripper(SimGripper):
    """A simulated gripper that knows the mean of its commands over time."""

    def __init__(self, gripper: SimGripper, rig: SimRig) -> None:
        super().__init__(rig.grasp, rig.clock, gripper.force_gain)
        self._since_s = self.closed_s = self._newton_s = 0.0

    @property
    def mean_n(self) -> float | None:
        """Mean command while the fingers were closed [N]; None where they never were."""
        self._count()
        return self._newton_s / self.closed_s if self.closed_s > 0 else None

    def _count(self) -> None:
        now_s = self._clock.simulated_s
        if self._state.closed:
            self.closed_s += now_s - self._since_s
            self._newton_s += self._state.force_n * (now_s - self._since_s)
        self._since_s = now_s

    def grip(self, force_n: float) -> GripperState:
        self._count()
        was_closed = self._state.closed
        state = super().grip(force_n)
        if not was_closed:  # the fingers were still moving
            self._since_s = self._clock.simulated_s
        return state

    def adjust(self, force_n: float) -> GripperState:
        self._count()
        return super().adjust(force_n)

    def open_by(self, clear_m: float) -> GripperState:
        self._count()
        return super().open_by(clear_m)


class Listener:
    """Hears the steps of an episode: every felt force, and whether the fruit hung after the hold.

    Args:
        grasp: The world.
    """

    def __init__(self, grasp: Grasp) -> None:
        self._grasp = grasp
        self.felt_n: list[float] = []
        self.hung = False

    def hear(self, record: StepRecord) -> None:
        """Take the felt forces of a step."""
        if record.phase is StepPhase.VERIFY_AFTER:
            self.hung = self._grasp.hangs
        if record.felt_force_n is not None:
            self.felt_n.append(record.felt_force_n.value)
        if record.reflex is not None:
            self.felt_n += record.reflex.felt_n[record.reflex.felt_n > 0].tolist()


def draw_fruit(config: RunConfig, seed: int) -> FruitFacts:
    """The fruit of a seed, the same for every arm."""
    rng, tails = world_of(seed)
    body, num_redrawn = draw_holdable(config.object, rng, tails)
    fingers = build(config.object, seed, sensor_name=config.sensor).grasp.fingers
    return FruitFacts(
        mass_g=1000 * body.mass_kg,
        size_mm=body.thickness_mm,
        young_mpa=body.young_mpa,
        friction=body.friction,
        bruise_n=body.bruise_n,
        slip_minimum_n=fingers.slip_minimum_n(accelerations(config.verify)),
        num_redrawn=num_redrawn,
    )


def run_seed(
    config: RunConfig, arm: GentleArm, forces_n: Sequence[float | None], seed: int
) -> list[GentleResult]:
    """Run an arm on a seed's fruit, once with each force of its sweep."""
    changes: dict[str, Any] = {
        "seed": seed,
        "instruction": arm.instruction(config.instruction, seed),
        "reflex": arm.has_reflex,
        "on_failure": "hold",  # a release is no drop
    }
    config = config.model_copy(update=changes)
    fingers = build(config.object, seed, sensor_name=config.sensor).grasp.fingers
    slip_minimum_n = fingers.slip_minimum_n(accelerations(config.verify))
    return [_run_one(config, arm, force_n, slip_minimum_n) for force_n in forces_n]


def _run_one(
    config: RunConfig, arm: GentleArm, force_n: float | None, slip_minimum_n: float
) -> GentleResult:
    began_s = time.process_time()

    def make(*args: Any, **values: Any) -> SimRig:
        rig = build(*args, **values)
        if not arm.has_reflex:
            rig.grasp.shear = None  # nobody looks at it
        return replace(rig, gripper=TimedGripper(rig.gripper, rig))

    entered = enter(config, (arm.policy, force_n), slip_minimum_n, make)
    if arm.is_blanked:
        entered = replace(entered, policy=BlankedPolicy(entered.policy))
    return _result(config, entered, force_n, slip_minimum_n, began_s)


def _result(
    config: RunConfig,
    entered: Contestant,
    force_n: float | None,
    slip_minimum_n: float,
    began_s: float,
) -> GentleResult:
    rig = entered.rig
    listener = Listener(rig.grasp)
    outcome = run_episode(
        rig,
        make_executor(
            rig,
            config,
            entered.contract if entered.bounded else None,
            entered.sense if entered.feels else None,
        ),
        entered.policy,
        config,
        entered.contract,
        verify=verify_by_lifting,
        recorder=NoRecorder(),
        observers=[listener.hear],
        sense=entered.sense,
    )
    truth, gripper, felt_n = rig.truth(), rig.gripper, listener.felt_n
    assert isinstance(gripper, TimedGripper)
    return GentleResult(
        seed=config.seed,
        instruction=config.instruction,
        force_n=force_n,
        reason=outcome.reason.value,
        message=outcome.message,
        declared=outcome.declared,
        verified_by_touch=outcome.verified,
        held=listener.hung,
        dropped=truth.dropped,
        bruised=truth.bruised or truth.bruised_at_start,
        slip_mm=truth.slip_mm,
        num_actions=outcome.num_actions,
        peak_n=truth.peak_force_n,
        slip_minimum_n=slip_minimum_n,
        commanded_mean_n=gripper.mean_n,
        measured_mean_n=float(np.mean(felt_n)) if felt_n else None,
        measured_max_n=max(felt_n) if felt_n else None,
        simulated_s=gripper.closed_s,
        seconds=time.process_time() - began_s,
    )
