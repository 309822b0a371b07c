"""The policies of ``tacgrasp bench strawberry``, each with what it is given and what it is spared.

Four of them choose one force for all bodies, and the benchmark takes their best of a sweep: their
figures say how far one goes without feeling what a body needs. ``informed`` and ``oracle`` see
parts of the truth. None of these is offered by ``tacgrasp run``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from cltp.tactile.cloud import TactileCloud
from policies import Policy, PolicyError
from policies.baselines import CenterOnlyPolicy, FixedForcePolicy, ForceOnlyPolicy
from policies.contract_steps import needed
from policies.needs import NEEDS, FeltNeed
from policies.oracle import BRUISE_RESERVE, SLIP_RESERVE, GraspTruth, OraclePolicy
from primitives.contract import Band, Contract
from primitives.sense import Interval
from sim.grasp.rig import SimRig, build
from tacgrasp.base.errors import UsageError
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.policy_factory import POLICIES, load_llm, make_policy
from tacgrasp.rig.gel_sense import GelSense

SWEEP = 15
"""Number of forces of a sweep."""

SWEPT = ("fixed_force", "true_force", "center_only")
"""Policies that choose one force for all episodes."""

NAMES = (*POLICIES, "true_force", "center_only", "force_only", "informed", "oracle")

ANY_BAND = Band(low=0.01, high=100.0)
ANYWHERE = Band(low=-100.0, high=100.0)
"""Bands of force [N] and place [mm] of a policy that the contract does not bound."""

PolicyAndForce = tuple[str, float | None]
"""A policy's name, and its force [N] where it is one of ``SWEPT``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Contestant:
    """One policy at the start of one episode.

    Attributes:
        rig: The rig.
        policy: Decides.
        contract: Contract of the episode.
        sense: Touch.
        bounded: Whether the contract bounds the commands.
        feels: Whether closings feel; else touch only verifies the grasp, as for all others.
    """

    rig: SimRig
    policy: Policy
    contract: Contract
    sense: GelSense
    bounded: bool = True
    feels: bool = True


class TrueForceSense(GelSense):
    """Contact by test, but the true force in place of the felt one."""

    def __init__(self, rig: SimRig) -> None:
        super().__init__(rig.sensor)
        self._grasp = rig.grasp

    def felt_force(self, cloud: TactileCloud) -> Interval | None:
        patch = self._grasp.patch
        if not self.in_contact(cloud) or patch is None:
            return None
        return Interval(value=patch.force_n, low=patch.force_n, high=patch.force_n)


def swept_forces_n(config: RunConfig) -> tuple[float, ...]:
    """Forces of the sweeps, in equal ratios [N]: commanded, and for ``true_force`` true ones.

    A little beyond the band of a task whose bodies need different forces (0.2 to 3 N for the
    strawberry), from half to twice the band of any other.
    """
    low, high = config.goal.force_n
    ends = (4 / 3 * low, 1.2 * high) if contract_of(config).needs else (low / 2, 2 * high)
    return tuple(float(force) for force in np.geomspace(*ends, SWEEP).round(3))


def enter(
    config: RunConfig,
    contestant: PolicyAndForce,
    slip_minimum_n: float,
    make: Callable[..., SimRig] = build,
) -> Contestant:
    """Build the rig of an episode and one policy in it.

    Args:
        config: The run.
        contestant: The policy.
        slip_minimum_n: Smallest force that holds the centred body [N], for ``oracle``.
        make: Builds the rig.
    """
    name, force_n = contestant
    if force_n is not None:
        return _one_force(config, name, force_n, make)
    rig, contract = make(config.object, config.seed, sensor_name=config.sensor), contract_of(config)
    sense: GelSense = GelSense(rig.sensor)
    if name == "oracle":  # it follows the truth, not the contract
        bruise_n = rig.grasp.fingers.body.bruise_n
        policy: Policy = OraclePolicy(_truth(rig, slip_minimum_n, bruise_n))
        contract = replace(contract, force_n=ANY_BAND, limit_n=ANY_BAND.high, soft=None, needs="")
    elif name == "informed":
        band = informed_band(contract, rig)
        sense = TrueForceSense(rig)
        policy = OraclePolicy(_truth(rig, band.low / SLIP_RESERVE, band.high / BRUISE_RESERVE))
        contract = replace(contract, force_n=band, soft=None, needs="")
    elif name == "force_only":
        policy = ForceOnlyPolicy(move_step_mm=config.primitives.move_step_mm)
        contract = replace(contract, x_mm=ANYWHERE, y_mm=ANYWHERE)
    elif name == "llm":
        policy = language_model(config.weights_folder, config.primitives.move_step_mm)
    else:
        policy = make_policy(name, config)
    return Contestant(rig=rig, policy=policy, contract=contract, sense=sense)


def _one_force(
    config: RunConfig, name: str, force_n: float, make: Callable[..., SimRig]
) -> Contestant:
    """A policy that closes with one force at once and keeps it."""
    contract = replace(
        contract_of(config), force_n=ANY_BAND, limit_n=ANY_BAND.high, soft=None, needs=""
    )
    perfect = {"gripper_force_gain": 1.0, "start_offset_mm": (0.0, 0.0)}
    rig = make(
        config.object,
        config.seed,
        sensor_name=config.sensor,
        first_force_n=force_n,
        **(perfect if name == "true_force" else {}),
    )
    if name != "center_only":
        sense = GelSense(rig.sensor)
        sense.take_reference()
        return Contestant(
            rig=rig,
            policy=FixedForcePolicy(),
            contract=replace(contract, x_mm=ANYWHERE, y_mm=ANYWHERE),
            sense=sense,
            bounded=False,
            feels=False,
        )
    return Contestant(
        rig=replace(rig, force_step_n=force_n),  # its approach is one step
        policy=CenterOnlyPolicy(move_step_mm=config.primitives.move_step_mm),
        contract=contract,
        sense=GelSense(rig.sensor),
        bounded=False,
    )


def informed_band(contract: Contract, rig: SimRig) -> Band:
    """Force band of one who knows size and stiffness, but not mass, friction and bruise force."""
    if contract.needs not in NEEDS:
        return contract.terms.force_n
    body, needs = rig.grasp.fingers.body, NEEDS[contract.needs]
    size, young = body.thickness_mm, body.young_mpa
    need = FeltNeed(
        size_mm=size,
        young_mpa=young,
        least_n=float(needs.least_n.at(size, young)),
        most_n=float(needs.most_n.at(size, young)),
    )
    return needed(contract, need)


def _truth(rig: SimRig, slip_n: float, bruise_n: float) -> Callable[[], GraspTruth]:
    grasp = rig.grasp

    def truth() -> GraspTruth:
        return GraspTruth(
            x_mm=grasp.offset_mm[0],
            y_mm=grasp.offset_mm[1],
            force_n=grasp.patch.force_n if grasp.patch else 0.0,
            slip_n=slip_n,
            bruise_n=bruise_n,
        )

    return truth


@lru_cache(maxsize=1)
def language_model(weights: Path | None, move_step_mm: float) -> Policy:
    """The policy ``llm``, read once a process: it has no memory, so episodes can share it."""
    policy = load_llm(weights)
    try:
        policy.check_move_step(move_step_mm)
    except PolicyError as error:
        raise UsageError(str(error)) from None
    return policy
