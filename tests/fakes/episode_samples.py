"""Episodes made by hand for the tests of recording, reading and recovery."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from cltp.tactile.cloud import Stamp, TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.tactile.sensors import sensor_named
from policies.policy import Decision
from primitives.devices import GripperState, Pose
from primitives.execution import Executed
from primitives.primitive import Primitive
from tacgrasp.episodes import EpisodeEnd, EpisodeHeader, EpisodeWriter, StepPhase, StepRecord
from tacgrasp.episodes.codec import to_json

SENSOR = sensor_named("gelsight_mini")


def stamp(at_s: float) -> Stamp:
    return Stamp(monotonic_s=1000.0 + at_s / 3, wall_s=1.8e9 + at_s / 3)


def header(seed: int | None = 7) -> EpisodeHeader:
    return EpisodeHeader(
        task="strawberry",
        instruction="hold the 'berry' – gently",
        policy="rules",
        seed=seed,
        sensor=SENSOR,
        config_yaml="task: strawberry\nloop:\n  max_steps: 12\n",
        versions={"tacgrasp": "0.1.0", "numpy": np.__version__},
        stamp=stamp(0),
    )


def press(x_mm: float, y_mm: float, depth_mm: float, *, seed: int = 0) -> TactileCloud:
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(*grid_axes_mm(SENSOR, 60, 80))
    heights = np.maximum(depth_mm - ((x - x_mm) ** 2 + (y - y_mm) ** 2) / 30, 0)
    heights += rng.normal(0, 0.01, heights.shape)
    return cloud_from_heights(heights, SENSOR, rng=rng, stamp=stamp(seed))


def executed(primitive: Primitive | None) -> Executed:
    return Executed(
        primitive=primitive,
        asked="3 mm",
        sent="2.5 mm, (0.00, 0.00, -2.50) mm in the base frame",
        reached=Pose(position_m=np.array([0.1, 0.2, 1 / 7]), rotvec_rad=np.array([0, np.pi, 0])),
        force_n=0.1 + 0.2,
        width_m=0.03,
        clamped=("a step of 3 mm was cut to 2.5 mm",),
        opened=True,
        travel_mm=7.5,
        dry_run=False,
        started_s=1000.25,
        ended_s=1000.75,
    )


def step_record(
    index: int,
    *,
    phase: StepPhase = StepPhase.LOOP,
    action: Primitive | None = Primitive.MOVE_DOWN,
    step_ms: float = 12.5,
) -> StepRecord:
    decision = Decision(
        text=f"Touch {index}: the contact is at the bottom-center, I will move_down.",
        action=action,
        success=action is None,
        reason="names move_down",
        confidence=1 / 3,
        stage_ms={"measure": 0.1, "say": 1 / 7},
    )
    return StepRecord(
        index=index,
        phase=phase,
        cloud=press(5.0 - index, -4.0, 0.4, seed=index),
        decision=decision if phase == StepPhase.LOOP else None,
        executed=None if action is None or phase != StepPhase.LOOP else executed(action),
        tcp_pose=Pose(position_m=np.array([0.1, 1 / 3, 0.2]), rotvec_rad=np.array([0, np.pi, 0])),
        gripper=GripperState(width_m=0.03, force_n=1 / 3, closed=True),
        stamp=stamp(index + 0.5),
        step_ms=step_ms,
    )


def end() -> EpisodeEnd:
    return EpisodeEnd(
        reason="success",
        declared_success=True,
        verified_success=True,
        message="Grasp completed successfully",
        stamp=stamp(20),
        truth={"held": True, "bruised": False, "slip_mm": 0.1, "count": 3, "why": None},
    )


def record(path: Path, steps: Sequence[StepRecord], *, with_end: bool = True) -> list[int]:
    """Record ``steps``; returns the size of the file after the header and after each step [bytes].

    A process killed at any moment leaves a file of a size between two of these.
    """
    sizes = []
    with EpisodeWriter(path, header()) as writer:
        sizes.append(path.stat().st_size)
        for step in steps:
            writer.write_step(step)
            sizes.append(path.stat().st_size)
        if with_end:
            writer.finish(end())
    return sizes


def same(a: object, b: object) -> bool:
    """Whether two records are equal to the last bit (arrays and signed zeros included)."""
    return exact_text(a) == exact_text(b)


def exact_text(record: object) -> str:
    """A record as a text that differs where a bit does."""
    return json.dumps(to_json(record))
