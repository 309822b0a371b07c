"""A rig whose devices only keep a log, for the tests of the loop; any call can be made to fail."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cltp.tactile.cloud import Stamp, TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.tactile.sensors import SensorSpec, sensor_named
from policies import Decision, Observation, decision_of
from primitives.contract import Contract
from primitives.devices import GripperState, Pose
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import EpisodeEnd, EpisodeError, StepRecord
from tacgrasp.loop import run_episode
from tacgrasp.rig.factory import make_executor
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import Observer, Outcome, Verification
from tacgrasp.runtime.steps import Steps
from tests.fakes.contracts import wide_contract

SENSOR = sensor_named("gelsight_mini")
START = Pose(position_m=np.array([0.45, -0.10, 0.20]), rotvec_rad=np.array([np.pi, 0.0, 0.0]))

GOOD = "The grasp is stable."
DOWN = "It is off centre. Move the gripper downward."
LIGHT = "Too light. Increase the gripping force."
RESET = "There is no contact. Reset the grasp."
NOTHING = "The contact is round."
TWO = "Move the gripper downward and to the left."
BOTH = "The grasp is stable. Move the gripper downward."


def touch() -> TactileCloud:
    """A firm touch in the middle of the pad."""
    x, y = np.meshgrid(*grid_axes_mm(SENSOR, 60, 80))
    heights = np.maximum(0.5 - (x**2 + y**2) / 40, 0)
    return cloud_from_heights(heights, SENSOR)


class FakeClock:
    """A clock that only sleeps advance."""

    def __init__(self) -> None:
        self.now_s = 100.0

    def monotonic(self) -> float:
        return self.now_s

    def wall(self) -> float:
        return 1.8e9 + self.now_s

    def sleep(self, seconds: float) -> None:
        self.now_s += seconds

    def stamp(self) -> Stamp:
        return Stamp(monotonic_s=self.monotonic(), wall_s=self.wall())


class FakeRig:
    """Arm, gripper and sensor that log every call; ``before`` may raise in place of one."""

    def __init__(self, before: Callable[[str, int], None] | None = None) -> None:
        self.calls: list[str] = []
        self._before = before
        self.clock = FakeClock()
        self.start_pose = START
        self.first_force_n = 1.0
        self.force_step_n = 0.0
        self.arm = FakeArm(self.log_call)
        self.gripper = FakeGripper(self.log_call)
        self.sensor = FakeSensor(self.log_call, self.gripper)

    def log_call(self, name: str) -> None:
        self.calls.append(name)
        if self._before is not None:
            self._before(name, len(self.calls) - 1)

    def expect_untouched(self) -> None:
        pass

    def commands(self) -> tuple[()]:
        return ()

    def truth(self) -> None:
        return None

    def disconnect(self) -> None:
        self.calls.append("disconnect")

    @property
    def moves(self) -> int:
        return self.calls.count("arm.move_to")


class FakeArm:
    def __init__(self, log_call: Callable[[str], None]) -> None:
        self._log_call, self._pose = log_call, START

    def pose(self) -> Pose:
        self._log_call("arm.pose")
        return self._pose

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        self._log_call("arm.move_to")
        self._pose = pose
        return pose

    def stop(self) -> None:
        self._log_call("arm.stop")

    def disconnect(self) -> None:
        self._log_call("arm.disconnect")


class FakeGripper:
    def __init__(self, log_call: Callable[[str], None]) -> None:
        self._log_call = log_call
        self.current = GripperState(width_m=0.05, force_n=0.0, closed=False)
        self.forces_n: list[float] = []

    def state(self) -> GripperState:
        self._log_call("gripper.state")
        return self.current

    def grip(self, force_n: float) -> GripperState:
        self._log_call("gripper.grip")
        self.forces_n.append(force_n)
        self.current = GripperState(width_m=0.02, force_n=force_n, closed=True)
        return self.current

    def open_by(self, clear_m: float) -> GripperState:
        self._log_call("gripper.open_by")
        self.current = GripperState(width_m=0.02 + clear_m, force_n=0.0, closed=False)
        return self.current

    def stop(self) -> None:
        self._log_call("gripper.stop")

    def disconnect(self) -> None:
        self._log_call("gripper.disconnect")


class FakeSensor:
    """Sees a firm contact under closed fingers, unless ``is_missed`` says that they miss."""

    def __init__(self, log_call: Callable[[str], None], gripper: FakeGripper) -> None:
        self._log_call, self._gripper = log_call, gripper
        self.is_missed: Callable[[], bool] = lambda: False
        self._rng = np.random.default_rng(0)

    @property
    def spec(self) -> SensorSpec:
        return SENSOR

    def read(self, frames: int = 1) -> TactileCloud:
        self._log_call("sensor.read")
        if not self._gripper.current.closed or self.is_missed():
            heights = self._rng.normal(0, 0.01, (60, 80))
            return cloud_from_heights(heights, SENSOR, rng=self._rng)
        return touch()

    def take_reference(self) -> None:
        self._log_call("sensor.take_reference")

    def disconnect(self) -> None:
        self._log_call("sensor.disconnect")


class Scripted:
    """A policy that answers with these texts in order, then with the last one; raises errors."""

    name = "scripted"

    def __init__(self, *texts: str | Exception) -> None:
        self._texts, self.num_asks = texts, 0

    def start(self) -> None:
        self.num_asks = 0

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        text = self._texts[min(self.num_asks, len(self._texts) - 1)]
        self.num_asks += 1
        if isinstance(text, Exception):
            raise text
        return decision_of(text)


class ListRecorder:
    """Keeps records in a list; refuses the ``full_at``-th one like a full disk."""

    def __init__(self, full_at: int | None = None) -> None:
        self.steps: list[StepRecord] = []
        self.ends: list[EpisodeEnd] = []
        self._full_at = full_at

    def write_step(self, record: StepRecord) -> None:
        if self._full_at is not None and len(self.steps) >= self._full_at:
            raise EpisodeError("the disk is full")
        self.steps.append(record)

    def finish(self, end: EpisodeEnd) -> None:
        if self._full_at is not None and len(self.steps) >= self._full_at:
            raise EpisodeError("the file is closed")
        self.ends.append(end)


def holds(rig: Rig, steps: Steps, config: RunConfig, contract: Contract) -> Verification:
    return Verification(passed=True, message="held")


def slips(rig: Rig, steps: Steps, config: RunConfig, contract: Contract) -> Verification:
    return Verification(passed=False, message="slipped")


def config(**loop: float) -> RunConfig:
    """The strawberry's, with bounds of the loop changed."""
    loaded, _ = load("strawberry")
    return loaded.model_copy(update={"loop": loaded.loop.model_copy(update=loop)})


def play(
    policy: Scripted,
    *,
    rig: FakeRig | None = None,
    verify: Callable[[Rig, Steps, RunConfig, Contract], Verification] = holds,
    recorder: ListRecorder | None = None,
    settings: RunConfig | None = None,
    observers: Sequence[Observer] = (),
    contract: Contract | None = None,
) -> tuple[Outcome, FakeRig, ListRecorder]:
    """Run the loop on fakes; under a contract that bounds hardly anything unless one is given."""
    rig = rig or FakeRig()
    recorder = recorder or ListRecorder()
    settings = settings or config()
    sense = GelSense(rig.sensor)
    contract = contract or wide_contract()
    outcome = run_episode(
        rig,
        make_executor(rig, settings, contract, sense),
        policy,
        settings,
        contract,
        verify=verify,
        recorder=recorder,
        observers=observers,
        sense=sense,
    )
    return outcome, rig, recorder


def with_end(settings: RunConfig, *, on_success: str, on_failure: str) -> RunConfig:
    return settings.model_copy(update={"on_success": on_success, "on_failure": on_failure})
