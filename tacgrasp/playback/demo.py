"""Scripted demos: how the fingers meet the object is set, and what must follow is known.

They show single behaviours of the loop on the simulated rig, with a noise-free sensor and a gripper
that gives the force that it is asked for; the paper's own example is one of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from primitives import Primitive
from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import load
from tacgrasp.config.schema import GoalConfig, RunConfig
from tacgrasp.episodes import TickRecord
from tacgrasp.policy_factory import make_policy
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import EndReason, Observer, Outcome


@dataclass(frozen=True, slots=True, kw_only=True)
class Demo:
    """One script.

    Attributes:
        what: What it shows, in a line.
        offset_mm: Where the object lies on the pad at first [mm, gel frame].
        force_n: True force of the first grasp [N].
        actions: What must be done, in order.
        end: How it must end.
        policy: Who decides.
        seed: Draws the berry.
    """

    what: str
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
"""The demos' own, so that tuning a task does not change what they show. Its area is narrow: a patch
that is cut by the pad's edge passes, the whole one at the same force is too firm."""

MOVE_STEP_MM = 5.0
"""From the pad's lower edge to its centre in one move, as the paper's example goes."""

DEMOS: dict[str, Demo] = {
    "paper": Demo(
        what="bottom-center -> move_down; centred but too firm -> decrease_force; stable",
        offset_mm=(0.0, -5.2),
        force_n=1.5,
        actions=(Primitive.MOVE_DOWN, Primitive.DECREASE_FORCE),
        end=EndReason.SUCCESS,
    ),
    "gentle": Demo(
        what="centred but held too lightly -> increase_force twice; stable",
        offset_mm=(0.0, 0.0),
        force_n=0.45,
        actions=(Primitive.INCREASE_FORCE, Primitive.INCREASE_FORCE),
        end=EndReason.SUCCESS,
    ),
    "missed": Demo(
        what="the fingers close beside it, nothing is felt -> reset; the second one ends it",
        offset_mm=(45.0, 0.0),
        force_n=1.0,
        actions=(Primitive.RESET,),
        end=EndReason.CONTACT_LOST,
    ),
    "slips": Demo(
        what="a policy that doesn't feel calls a light grip secure; lifting shows otherwise",
        offset_mm=(0.0, 0.0),
        force_n=0.22,
        actions=(),
        end=EndReason.UNVERIFIED,
        policy="fixed_force",
    ),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """What came of a demo.

    Attributes:
        outcome: How it ended.
        path: Its episode.
        actions: What was done.
        as_told: Whether actions and end were those of the script.
    """

    outcome: Outcome
    path: Path
    actions: tuple[Primitive, ...]
    as_told: bool


def play(name: str, record: Path, observers: Sequence[Observer] = ()) -> Shown:
    """Play one demo and compare with its script.

    Raises:
        UsageError: No such demo.
        EpisodeError: The record can't be begun.
    """
    if name not in DEMOS:
        raise UsageError(f"unknown demo {name!r}; known: {', '.join(DEMOS)}")
    demo = DEMOS[name]
    config = _config(demo, record)
    rig = build(
        config.object,
        demo.seed,
        start_offset_mm=demo.offset_mm,
        first_force_n=demo.force_n,
        gripper_factor=1.0,
        noise_level=0.0,
    )
    actions: list[Primitive] = []

    def collect(turn: TickRecord) -> None:
        if turn.executed is not None and turn.executed.primitive is not None:
            actions.append(turn.executed.primitive)

    try:
        outcome, path = run_recorded(
            rig, make_policy(config.policy, config), config, [collect, *observers]
        )
    finally:
        rig.disconnect()
    as_told = tuple(actions) == demo.actions and outcome.reason is demo.end
    return Shown(outcome=outcome, path=path, actions=tuple(actions), as_told=as_told)


def _config(demo: Demo, record: Path) -> RunConfig:
    config, _ = load("strawberry")
    return config.model_copy(
        update={
            "record": record,
            "seed": demo.seed,
            "policy": demo.policy,
            "goal": GOAL,
            "primitives": config.primitives.model_copy(update={"move_step_mm": MOVE_STEP_MM}),
        }
    )
