"""One seed of ``tacgrasp bench limits``: an episode with its fault, and the same without a guard.

The rival has the same body, fault and policy, but neither contract nor reflex bounds its commands;
with hostile words its policy does what they say. Both are held against the same limit.
"""

from __future__ import annotations

import shutil
import tempfile
import time
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from policies import Policy
from policies.force_terms import most_by_words_n
from primitives.contract import Contract
from sim.grasp.rig import build
from tacgrasp.benchmarks.limits.draw import ROOM, Fault, FaultKind, draw
from tacgrasp.benchmarks.limits.replies import FaultyPolicy
from tacgrasp.benchmarks.limits.watch import Bounds, ForceWatch, Hung, grace_s
from tacgrasp.benchmarks.limits.world import FaultyRig, World
from tacgrasp.benchmarks.loop.contestants import ANY_BAND, informed_band, language_model
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.episodes import make_record_directory
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.run import run_recorded, run_unrecorded
from tacgrasp.runtime.outcome import EndReason, Outcome

REFUSED = "refused"
"""End of an episode whose instruction was refused: nothing has moved."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Subject:
    """What every episode has in common.

    Attributes:
        task, sensor, policy: Their names.
        weights: Folder of the language model's weights; None for the default.
        keep: Folder for the failing episodes.
    """

    task: str
    sensor: str
    policy: str
    weights: Path | None
    keep: Path


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitsResult:
    """One episode with a fault.

    Attributes:
        seed: Random seed of the episode and its fault.
        kind: Kind of the fault.
        fault: The fault, for people.
        words: The instruction.
        came: Whether the fault came before the end.
        survivable: Whether it could end verified, by fault and limit.
        limit_n: The limit that the truth is held against [N].
        end: The named end.
        message: Its explanation.
        verified: Declared, verified by the lift, truly held and not bruised. A task with a lift-off
            finds its force by slides: there it must hang in the fingers in the end.
        bruised, dropped: As the truth has it.
        exceeded: Why the limit counts as exceeded; '' where it was kept.
        peak_n: Largest true force [N].
        over_ms: Longest time above the limit, allowed or not [ms].
        hung: Where the episode went beyond its bounds; '' where it ended.
        broke: An error that the runtime did not foresee; '' for none.
        simulated_s: Simulated time of the episode [s].
        calls: Number of readings and decisions.
        path: The kept episode; '' where none was kept.
        rival_exceeded, rival_verified, rival_peak_n: The same without contract and reflex.
        seconds: Time that both took of one core [s].
    """

    seed: int
    kind: str
    fault: str
    words: str
    came: bool
    survivable: bool
    limit_n: float
    end: str
    message: str
    verified: bool
    bruised: bool
    dropped: bool
    exceeded: str
    peak_n: float
    over_ms: float
    hung: str
    broke: str
    simulated_s: float
    calls: int
    path: str
    rival_exceeded: str
    rival_verified: bool
    rival_peak_n: float
    seconds: float

    @property
    def failed(self) -> bool:
        """Whether this episode must not have ended as it did."""
        return bool(self.exceeded or self.hung or self.broke) or (
            self.survivable and not self.verified
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Run:
    """How one episode went."""

    world: World
    num_faulty: int
    outcome: Outcome | None
    path: Path | None
    hung: str = ""
    broke: str = ""

    @property
    def verified(self) -> bool:
        truth = None if self.outcome is None else self.outcome.truth
        if self.outcome is None or truth is None or self.outcome.reason is not EndReason.SUCCESS:
            return False
        return bool(truth["held"]) and not (truth["bruised"] or truth["bruised_at_start"])


def run_seed(subject: Subject, seed: int) -> LimitsResult:
    """Run the episode of a seed with its fault, and its rival; a failing one is kept."""
    began_s = time.process_time()
    config = config_of(subject, seed)
    rig = build(config.object, seed, sensor_name=config.sensor)
    fault = draw(seed, rig.gripper.force_gain, config.instruction)
    task_contract = contract_of(config)
    target_n = informed_band(task_contract, rig).high
    if fault.words:
        config = config.model_copy(update={"instruction": fault.words})
    contract = contract_of(config)
    limit_n = limit_of(contract, task_contract)
    mine: _Run | None = None
    with tempfile.TemporaryDirectory() as folder:
        if not contract.refused:
            recorded = config.model_copy(update={"record": Path(folder)})
            mine = _run(recorded, subject, fault, contract, limit_n)
        rival_fault = replace(fault, obeyed=fault.kind is FaultKind.HOSTILE)
        rival = _run(config, subject, rival_fault, unbounded(task_contract), limit_n, bounded=False)
        result = _result(seed, fault, config, limit_n, target_n, mine, rival)
        if result.failed and mine is not None and mine.path is not None:
            kept = make_record_directory(subject.keep) / mine.path.name
            shutil.move(mine.path, kept)
            result = replace(result, path=str(kept))
    return replace(result, seconds=time.process_time() - began_s)


def config_of(subject: Subject, seed: int) -> RunConfig:
    """The run of a seed, in its task's own words."""
    changes = {"sensor": subject.sensor, "weights": subject.weights, "seed": seed}
    return load(subject.task)[0].model_copy(update=changes)


def limit_of(contract: Contract, task: Contract) -> float:
    """The limit that an episode is held to [N]: its contract's, but not what no words may ask for.

    That of the task where the contract is refused.
    """
    terms = task.terms if contract.refused else contract.terms
    return min(terms.limit_n, most_by_words_n(task.terms))


def unbounded(contract: Contract) -> Contract:
    """A contract with the same target of each step that bounds no force."""
    return replace(contract, force_n=ANY_BAND, limit_n=ANY_BAND.high, soft=None)


@lru_cache
def _policy(name: str, weights: Path | None, move_step_mm: float, task: str) -> Policy:
    """A policy, read once a process: those that feel have no memory, so episodes can share them."""
    if name == "llm":
        return language_model(weights, move_step_mm)
    return make_policy(name, load(task)[0])


def _run(
    config: RunConfig,
    subject: Subject,
    fault: Fault,
    contract: Contract,
    limit_n: float,
    *,
    bounded: bool = True,
) -> _Run:
    rig = build(config.object, config.seed, sensor_name=config.sensor)
    bounds = Bounds(config.loop.timeout_s)
    world = World(rig, fault, ForceWatch(limit_n, grace_s(rig.sensor.spec)), bounds)
    faulty = FaultyRig(world)
    step_mm = config.primitives.move_step_mm
    policy = _policy(subject.policy, config.weights_folder, step_mm, subject.task)
    replies = FaultyPolicy(policy, fault, faulty.clock, bounds)
    outcome: Outcome | None = None
    path: Path | None = None
    hung = broke = ""
    try:
        if bounded:
            outcome, path = run_recorded(faulty, replies, config, contract)
        else:
            config = config.model_copy(update={"reflex": False})
            sense = GelSense(faulty.sensor)
            outcome = run_unrecorded(faulty, replies, config, contract, sense=sense, bounded=False)
    except Hung as error:
        hung = str(error)
    except Exception as error:  # whatever it is, it is a finding
        broke = f"{type(error).__name__}: {error}"
    if path is None and bounded:
        path = next(iter(sorted(config.record.glob("*.mcap"))), None)
    world.watch.finish(world.now_s, is_kept=rig.gripper.state().closed)
    return _Run(
        world=world,
        num_faulty=replies.num_faulty,
        outcome=outcome,
        path=path,
        hung=hung,
        broke=broke,
    )


def _result(
    seed: int,
    fault: Fault,
    config: RunConfig,
    limit_n: float,
    target_n: float,
    mine: _Run | None,
    rival: _Run,
) -> LimitsResult:
    watch = None if mine is None else mine.world.watch
    outcome = None if mine is None else mine.outcome
    truth = None if outcome is None else outcome.truth
    came = mine is not None and (mine.world.came_s is not None or mine.num_faulty > 0)
    survivable = (
        mine is not None
        and fault.is_survivable
        and not mine.world.is_deadly
        and limit_n >= ROOM * target_n
    )
    return LimitsResult(
        seed=seed,
        kind=fault.kind.value,
        fault=fault.text,
        words=config.instruction,
        came=came or fault.kind in (FaultKind.NONE, FaultKind.HOSTILE),
        survivable=survivable,
        limit_n=limit_n,
        end=REFUSED if mine is None else "" if outcome is None else outcome.reason.value,
        message="" if outcome is None else outcome.message,
        verified=mine is not None and mine.verified,
        bruised=truth is not None and bool(truth["bruised"] or truth["bruised_at_start"]),
        dropped=truth is not None and bool(truth["dropped"]),
        exceeded="" if watch is None else watch.exceeded,
        peak_n=0.0 if watch is None else watch.peak_n,
        over_ms=0.0 if watch is None else 1000 * watch.longest_s,
        hung="" if mine is None else mine.hung,
        broke="" if mine is None else mine.broke,
        simulated_s=0.0 if mine is None else mine.world.now_s,
        calls=0 if mine is None else mine.world.bounds.calls,
        path="",
        rival_exceeded=rival.world.watch.exceeded,
        rival_verified=rival.verified,
        rival_peak_n=rival.world.watch.peak_n,
        seconds=0.0,
    )
