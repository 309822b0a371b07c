"""Scripted demos with a fixed start and a known course.

Each shows one behaviour of the loop on the simulated rig, with a noise-free sensor and a gripper
that exerts exactly the commanded force. One of them is the paper's own example.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from primitives import Primitive
from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import load
from tacgrasp.config.schema import GoalConfig
from tacgrasp.episodes import StepRecord
from tacgrasp.policy_factory import make_policy
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import EndReason, Observer, Outcome


@dataclass(frozen=True, slots=True, kw_only=True)
class Demo:
    """One scripted demo.

    Attributes:
        summary: The behaviour that it shows, in a line.
        offset_mm: Position of the object on the pad at the start [mm, gel frame].
        force_n: True force of the first grasp [N].
        actions: Expected actions, in order.
        end: Expected end.
        policy: Name of the policy.
        seed: Random seed of the berry.
    """

    summary: str
    offset_mm: tuple[float, float]
    force_n: float
    actions: tuple[Primitive, ...]
    end: EndReason
    policy: str = "rules"
    seed: int = 8


GOAL = GoalConfig(
    force_n=(0.9, 2.4),
    depth_mm=(0.1, 0.6),
    area_share=(0.05, 0.22),
    x_mm=(-3.0, 3.0),
    y_mm=(-3.0, 3.0),
)
"""Goal of the demos, so that tuning a task does not change them. Its band of the area is narrow: a
contact cut by the pad's edge is inside, the whole contact at the same force is too firm."""

DEMOS: dict[str, Demo] = {
    "paper": Demo(
        summary="bottom-center -> move_down; centred but too firm -> decrease_force; stable",
        offset_mm=(0.0, -5.2),
        force_n=1.5,
        actions=(Primitive.MOVE_DOWN, Primitive.DECREASE_FORCE),
        end=EndReason.SUCCESS,
    ),
    "gentle": Demo(
        summary="centred but held too lightly -> increase_force twice; stable",
        offset_mm=(0.0, 0.0),
        force_n=0.45,
        actions=(Primitive.INCREASE_FORCE, Primitive.INCREASE_FORCE),
        end=EndReason.SUCCESS,
    ),
    "missed": Demo(
        summary="the fingers close beside it, nothing is felt -> reset; the second one ends it",
        offset_mm=(45.0, 0.0),
        force_n=1.0,
        actions=(Primitive.RESET,),
        end=EndReason.CONTACT_LOST,
    ),
    "slips": Demo(
        summary="a policy that doesn't feel calls a light grip secure; lifting shows otherwise",
        offset_mm=(0.0, 0.0),
        force_n=0.22,
        actions=(),
        end=EndReason.UNVERIFIED,
        policy="fixed_force",
    ),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class DemoResult:
    """Result of a demo.

    Attributes:
        outcome: Outcome of its episode.
        path: File of its episode.
        actions: Executed actions.
        as_scripted: Whether actions and end were those of the script.
    """

    outcome: Outcome
    path: Path
    actions: tuple[Primitive, ...]
    as_scripted: bool


def play(name: str, record: Path, observers: Sequence[Observer] = ()) -> DemoResult:
    """Play one demo and compare it with its script.

    Raises:
        UsageError: No such demo.
        EpisodeError: The record can't be created.
    """
    if name not in DEMOS:
        raise UsageError(f"unknown demo {name!r}; known: {', '.join(DEMOS)}")
    demo = DEMOS[name]
    changes = {"record": record, "seed": demo.seed, "policy": demo.policy, "goal": GOAL}
    config = load("strawberry")[0].model_copy(update=changes)
    rig = build(
        config.object,
        demo.seed,
        start_offset_mm=demo.offset_mm,
        first_force_n=demo.force_n,
        gripper_force_gain=1.0,
        noise_level=0.0,
    )
    actions: list[Primitive] = []

    def collect(step: StepRecord) -> None:
        if step.executed is not None and step.executed.primitive is not None:
            actions.append(step.executed.primitive)

    try:
        outcome, path = run_recorded(
            rig, make_policy(config.policy, config), config, [collect, *observers]
        )
    finally:
        rig.disconnect()
    as_scripted = tuple(actions) == demo.actions and outcome.reason is demo.end
    return DemoResult(outcome=outcome, path=path, actions=tuple(actions), as_scripted=as_scripted)
