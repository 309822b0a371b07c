"""A step under the contract: its target, objections of what is felt, decisions that go beyond.

Where the contract names the kind of object, the target is the part of the force band that this
object needs, as its size and stiffness are felt (``policies.needs``).

Not here: making a contract (``policies.contract``), keeping its limit (``primitives.force_guard``).
"""

from __future__ import annotations

import math
from dataclasses import replace

from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from policies.force_terms import FIRMEST, MANNER_NAMES
from policies.goal import Goal
from policies.needs import NEEDS, FeltNeed, TouchedObject
from policies.observation import Observation
from primitives import Primitive
from primitives.contract import DEFAULT_AREA, DEFAULT_DEPTH_MM, Band, Contract
from primitives.sense import Interval

PLACE_MARGIN_MM, DEPTH_FACTOR, AREA_FACTOR = 1.0, 1.3, 1.5
"""How far a measured state may lie outside its band before a declared success counts as beyond the
contract: the spread of the direct measurement on noisy contacts."""

CLEARLY = 1.65
"""Factor by which a felt force must lie outside the band before a decision goes against it. Source:
the largest error of a felt force in 160 simulated contacts on the pad, 1.7."""


_BY_FIRM_MANNER = tuple(f"{MANNER_NAMES[+1, strong]}: " for strong in (False, True))

TARGET_FACTOR = 1.1
"""Ends of a target over its middle, up and down. Our choice: twice what a felt force varies from
frame to frame, and a third of the way from the least force to the bruise of the ripest berry."""


class TargetTracker:
    """Follows what is felt of the object, and tells the target of each step of an episode."""

    def __init__(self) -> None:
        self._needs = ""
        self._object: TouchedObject | None = None

    def contract_at(
        self, contract: Contract, observation: Observation, reach_n: float | None = None
    ) -> tuple[Contract, str]:
        """The contract of a step, and what was felt of the object in words.

        The words are empty, and the contract as it is, where it names no kind of object, or nothing
        is felt. Without a kind, a band that a firm manner has moved yields to what the limit lets
        through.

        Args:
            contract: The contract.
            observation: What is felt.
            reach_n: Largest felt force that commands within the limit surely make [N]; None where
                that is not known.
        """
        if contract.needs not in NEEDS:
            return _within_reach(contract, reach_n)
        if self._object is None or contract.needs != self._needs:
            self._needs, self._object = contract.needs, TouchedObject(NEEDS[contract.needs])
        state = contact_state(observation.cloud, in_contact=observation.in_contact)
        need = self._object.feel(observation, is_whole=not state.cut)
        if need is None:
            return contract, ""
        return replace(contract, force_n=needed(contract, need, reach_n)), need.text


def _within_reach(contract: Contract, reach_n: float | None) -> tuple[Contract, str]:
    """The contract with as firm a band as the limit lets through, but for ``FIRMEST`` of it."""
    band, origin = contract.terms.force_n, contract.origins.get("force_n", "")
    if reach_n is None or not origin.startswith(_BY_FIRM_MANNER):
        return contract, ""
    low = min(band.low, max(reach_n / TARGET_FACTOR, FIRMEST * contract.terms.limit_n))
    if low == band.low:
        return contract, ""
    words = f"as firm as the limit of {contract.terms.limit_n:.3g} N lets through"
    return replace(contract, force_n=Band(low=low, high=band.high)), words


def needed(contract: Contract, need: FeltNeed, reach_n: float | None = None) -> Band:
    """The part of the contract's force band that an object needs [N].

    Where all of the band lies below or above what is needed, its nearest end. Where the limit lets
    no command reach so far, less, but no less than what surely holds.

    Raises:
        LimitError: The contract is refused.
    """
    band, lean = contract.terms.force_n, contract.lean
    middle = contract.scale * need.least_n ** (1 - lean) * need.most_n**lean
    middle = min(middle, max(need.least_n, need.most_n) / TARGET_FACTOR)
    if reach_n is not None:
        middle = min(middle, max(need.least_n, reach_n / TARGET_FACTOR))
    middle = min(
        max(middle, band.low * math.sqrt(TARGET_FACTOR)), band.high / math.sqrt(TARGET_FACTOR)
    )
    low, high = max(band.low, middle / TARGET_FACTOR), min(band.high, middle * TARGET_FACTOR)
    return Band(low=min(low, high), high=max(low, high))


def target_of(contract: Contract) -> Goal:
    """Target bands of a step: those of the contract.

    Raises:
        LimitError: The contract is refused.
    """
    return Goal(
        force_n=contract.terms.force_n,
        depth_mm=contract.depth_mm,
        area_fraction=contract.area_fraction,
        x_mm=contract.x_mm,
        y_mm=contract.y_mm,
    )


def softened(contract: Contract) -> Contract:
    """The contract held to the terms of soft objects, after what is felt has objected.

    The lower of both limits stays.
    """
    soft = contract.soft
    if soft is None:
        return contract
    words = f"what is felt is soft: held to {soft.force_n.low:.2f}-{soft.force_n.high:.2f} N"
    origins = {**contract.origins, "force_n": "what is felt"}
    limit_n = contract.terms.limit_n
    if soft.limit_n < limit_n:
        limit_n, origins["limit_n"] = soft.limit_n, "what is felt"
    return replace(
        contract,
        force_n=soft.force_n,
        limit_n=limit_n,
        needs=soft.needs,
        depth_mm=DEFAULT_DEPTH_MM,
        area_fraction=DEFAULT_AREA,
        origins=origins,
        assumed=(*contract.assumed, words),
        soft=None,
    )


def refuted(
    contract: Contract, felt: Interval | None, state: ContactState | None = None
) -> dict[Primitive | None, str]:
    """Decisions that go against what is clearly felt, with the reason of each; None is success.

    Args:
        contract: The contract of the step.
        felt: Force that is felt; None where that is not known.
        state: What is measured of the contact; None where that shall not count.

    Raises:
        LimitError: The contract is refused.
    """
    reasons = _against_force(contract, felt)
    if state is not None and None not in reasons and (outside := _outside(contract, state)):
        reasons[None] = outside
    return reasons


def pressed_too_far(contract: Contract, felt: Interval | None, state: ContactState) -> str:
    """Why a contact is too deep or too large for a contract although its force is in the band.

    A move would grasp again as firmly, so that less force alone can help. '' where it is not so.

    Args:
        contract: The contract of the step.
        felt: Force that is felt; None where the measured one counts.
        state: What is measured of the contact.

    Raises:
        LimitError: The contract is refused.
    """
    force_n = state.force_n if felt is None else felt.value
    if not state.in_contact or force_n not in contract.terms.force_n:
        return ""
    most_mm, most = contract.depth_mm.high, contract.area_fraction.high
    if state.depth_mm > DEPTH_FACTOR * most_mm:
        return f"the contact is {state.depth_mm:.2f} mm deep, the contract has {most_mm:.2f} mm"
    if state.area_fraction > AREA_FACTOR * most:
        part, most_part = 100 * state.area_fraction, 100 * most
        return f"the contact takes {part:.0f} % of the pad, the contract has {most_part:.0f} %"
    return ""


def _against_force(contract: Contract, felt: Interval | None) -> dict[Primitive | None, str]:
    """The part of ``refuted`` that the felt force tells."""
    if felt is None:
        return {}
    band = contract.terms.force_n
    is_above, is_below = felt.value / CLEARLY > band.high, felt.value * CLEARLY < band.low
    reasons: dict[Primitive | None, str] = {}
    if is_above:
        above = f"{felt.value:.2f} N is felt, above {band.high:.2f} N"
        reasons[Primitive.INCREASE_FORCE] = f"more force, but {above}"
    if is_below:
        below = f"{felt.value:.2f} N is felt, below {band.low:.2f} N"
        reasons[Primitive.DECREASE_FORCE] = f"less force, but {below}"
    if is_above or is_below:
        wanted = f"{band.low:.2f}-{band.high:.2f} N"
        reasons[None] = f"success, but {felt.value:.2f} N is felt, not {wanted}"
    return reasons


def beyond(
    contract: Contract,
    action: Primitive | None,
    *,
    success: bool,
    felt: Interval | None,
    state: ContactState | None,
) -> str:
    """Why a decision goes beyond the contract; '' where it keeps it.

    A decision is beyond when it goes against what is clearly felt: success outside the bands, more
    force above the band, less below it.
    """
    if action is None and not success:
        return ""
    return refuted(contract, felt, state).get(action, "")


def _outside(contract: Contract, state: ContactState) -> str:
    """The first band, with its margin, that a measured state lies outside of."""
    margin = PLACE_MARGIN_MM
    depth, area = contract.depth_mm, contract.area_fraction
    checks = (
        ("x", "mm", state.x_mm, contract.x_mm.low - margin, contract.x_mm.high + margin),
        ("y", "mm", state.y_mm, contract.y_mm.low - margin, contract.y_mm.high + margin),
        ("depth", "mm", state.depth_mm, depth.low / DEPTH_FACTOR, depth.high * DEPTH_FACTOR),
        ("area", "", state.area_fraction, area.low / AREA_FACTOR, area.high * AREA_FACTOR),
    )  # fmt: skip
    for name, unit, value, low, high in checks:
        if not low <= value <= high:
            return f"success, but the {name} is {value:.2f} {unit}, outside the contract"
    return ""
