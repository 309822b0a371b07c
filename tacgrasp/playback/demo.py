"""Scripted demos with a fixed start and a known course.

Each shows one behaviour of the loop on the simulated rig, with a gripper that exerts exactly the
commanded force. The sensor is free of noise, but where nothing is touched: there it has a real
one's noise. One of them is the paper's own example.
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
from tacgrasp.config.terms import contract_of
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
        actions: Expected actions, in order.
        end: Expected end.
        policy: Name of the policy.
        blind_force_n: Close with this force at once, without feeling [N]; None approaches.
        noise_level: Noise of the sensor and its drift; 1 is the measured sensor, 0 a perfect one.
        seed: Random seed of the object.
        task: Task whose own goal is kept; '' is a strawberry under ``GOAL``.
    """

    summary: str
    offset_mm: tuple[float, float]
    actions: tuple[Primitive, ...]
    end: EndReason
    policy: str = "rules"
    blind_force_n: float | None = None
    noise_level: float = 0.0
    seed: int = 4
    task: str = ""


GOAL = GoalConfig(
    force_n=(1.0, 2.4),
    limit_n=2.9,
    depth_mm=(0.1, 0.6),
    area_share=(0.05, 0.3),
    x_mm=(-3.0, 3.0),
    y_mm=(-3.0, 3.0),
)
"""Goal of the demos without a task, so that tuning a task does not change them."""

_RISE = Primitive.INCREASE_FORCE

_FROM_FIRST_TOUCH = (_RISE,) * 2
"""From the first touch, at a third of the goal, to twice that, and on to the goal."""

DEMOS: dict[str, Demo] = {
    "paper": Demo(
        summary="bottom-center -> move_down; centred but too light -> increase_force; stable",
        offset_mm=(0.0, -4.0),
        actions=(Primitive.MOVE_DOWN, *_FROM_FIRST_TOUCH),
        end=EndReason.SUCCESS,
    ),
    "gentle": Demo(
        summary="closes until something is felt, then increase_force twice; stable",
        offset_mm=(0.0, 0.0),
        actions=_FROM_FIRST_TOUCH,
        end=EndReason.SUCCESS,
    ),
    "missed": Demo(
        summary="the fingers close beside it, nothing is felt -> reset; the second one ends it",
        offset_mm=(45.0, 0.0),
        actions=(Primitive.RESET,),
        end=EndReason.CONTACT_LOST,
        policy="llm",
        noise_level=1.0,
    ),
    "missed-rules": Demo(
        summary="the same with the policy rules",
        offset_mm=(45.0, 0.0),
        actions=(Primitive.RESET,),
        end=EndReason.CONTACT_LOST,
        noise_level=1.0,
    ),
    "slips": Demo(
        summary="a policy that doesn't feel calls a light grip secure; lifting shows otherwise",
        offset_mm=(0.0, 0.0),
        actions=(),
        end=EndReason.UNVERIFIED,
        policy="fixed_force",
        blind_force_n=0.22,
    ),
    "strawberry": Demo(
        summary="a small, ripe berry: what it needs is felt, and 0.35 N hold it",
        offset_mm=(0.0, -5.2),
        actions=(Primitive.MOVE_DOWN, *(_RISE,) * 2),
        end=EndReason.SUCCESS,
        seed=3,
        task="strawberry",
    ),
    "firm-strawberry": Demo(
        summary="a large, firm berry under the same task: 1.8 N",
        offset_mm=(5.0, 0.0),
        actions=(Primitive.MOVE_RIGHT, *(_RISE,) * 5),
        end=EndReason.SUCCESS,
        seed=4,
        task="strawberry",
    ),
    "cherry_tomato": Demo(
        summary="a cherry tomato, off centre to the right",
        offset_mm=(6.0, 0.0),
        actions=(Primitive.MOVE_RIGHT, *(_RISE,) * 2),
        end=EndReason.SUCCESS,
        task="cherry_tomato",
    ),
    "egg": Demo(
        summary="an egg: small steps until it is known to be hard, then more",
        offset_mm=(0.0, 0.0),
        actions=(_RISE,) * 7,
        end=EndReason.SUCCESS,
        task="egg",
    ),
    "peg": Demo(
        summary="a peg, held firmly",
        offset_mm=(0.0, 0.0),
        actions=(_RISE,) * 6,
        end=EndReason.SUCCESS,
        task="peg",
    ),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class DemoResult:
    """Result of a demo.

    Attributes:
        outcome: Outcome of its episode.
        path: File of its episode.
        actions: Executed actions.
        config: Its run.
        as_scripted: Whether actions and end were those of the script.
    """

    outcome: Outcome
    path: Path
    actions: tuple[Primitive, ...]
    config: RunConfig
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
    changes = {"record": record, "seed": demo.seed, "policy": demo.policy}
    changes |= {} if demo.task else {"goal": GOAL}
    config = load(demo.task or "strawberry")[0].model_copy(update=changes)
    rig = build(
        config.object,
        demo.seed,
        start_offset_mm=demo.offset_mm,
        first_force_n=demo.blind_force_n,
        gripper_force_gain=1.0,
        noise_level=demo.noise_level,
    )
    actions: list[Primitive] = []

    def collect(step: StepRecord) -> None:
        if step.executed is not None and step.executed.primitive is not None:
            actions.append(step.executed.primitive)

    try:
        outcome, path = run_recorded(
            rig,
            make_policy(config.policy, config),
            config,
            contract_of(config),
            [collect, *observers],
            feel=demo.blind_force_n is None,
        )
    finally:
        rig.disconnect()
    as_scripted = tuple(actions) == demo.actions and outcome.reason is demo.end
    return DemoResult(
        outcome=outcome,
        path=path,
        actions=tuple(actions),
        config=config,
        as_scripted=as_scripted,
    )
