"""Advice on a contact, given a numeric goal: the one rule behind all decisions.

The policy ``rules`` follows it in the loop, and the lessons of the language model put it into many
wordings. Pure functions of ``ContactState`` and ``Goal``; no torch. Not here: how the advice is
worded (``policies.speech``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from cltp.tactile.states import ContactState, Side
from policies.goal import Goal
from primitives import Primitive
from primitives.contract import DEFAULT_AREA, DEFAULT_DEPTH_MM, Band
from primitives.execution import INCREASE_FACTOR

LESSON_MOVE_STEP_MM = 3.0
"""Length of a move [mm] in the lessons of the language model, and the default of every run.
Source: the design."""

DEPTH_EXPONENT = 2.0 / 3.0
"""Indentation grows with the force to this power. Source: Hertz; in a bonded gel it grows less."""

PLACE_MM: Mapping[str, float] = {"x_mm": 4.0, "y_mm": 3.0}
"""Half widths of the place of a good grasp in lessons [mm]. Source: the tasks."""

SLIVER_FRACTION = 0.004
"""Fraction of the sensing area below which a contact cut by the edge is out of reach of one step.

Our choice: 0.4 % of a GelSight Mini is 1.2 mm², four of 1024 points. A lightly pressed berry whose
centre is one step outside the pad covers about that much.
"""


class Reason(StrEnum):
    """The rule that decided an advice."""

    NO_CONTACT = "no contact"
    OVER_THE_EDGE = "the contact lies over the pad's edge, beyond one step"
    TOO_FIRM = "pressed too firmly"
    OFF_CENTER = "off centre"
    CUT = "cut off by the pad's edge"
    TOO_LIGHT = "held too lightly"
    BAND_TOO_NARROW = "no step fits between the limits of the goal"
    GOOD = "within the goal"


@dataclass(frozen=True, slots=True, kw_only=True)
class Advice:
    """What to do about one contact.

    Attributes:
        action: Primitive to carry out; None on success, and when no primitive would help.
        success: Whether the contact lies within the goal.
        reason: The rule that decided.
    """

    action: Primitive | None
    success: bool
    reason: Reason


def teacher(state: ContactState, goal: Goal, *, move_step_mm: float) -> Advice:
    """Advise on one contact.

    The first rule that applies decides:

    1. No contact: ``reset``.
    2. A sliver at the edge (``SLIVER_FRACTION``): ``reset``; a step would not bring it back.
    3. Too firm (force, depth or area above its band): ``decrease_force``. This comes before
       any move, since a move grasps again with the same force and would bruise again.
    4. Off centre: a move towards the contact, along the axis whose excess is the larger part of
       its band; or towards the one side that cuts the contact off. Only where a step of
       ``move_step_mm`` brings it nearer, so that two moves never undo each other.
    5. Too light (force, depth or area below its band): ``increase_force``, if force × 1.5, or the
       middle of the band where that is less, and the depth that Hertz then expects, stay below
       their upper limits.
    6. Nothing that would help (a band narrower than a step of its action): no action and no
       success. The loop holds, asks again, and ends safely.
    7. Otherwise success.

    Args:
        state: The contact; depth in mm, position in mm in the gel frame, force in N.
        goal: Bands in the same units.
        move_step_mm: Length of one move [mm]; only used to see whether a move would help.

    Source: paper, section 5.3 and figure 'Tac3D-LLM Application' (bottom-center: move down;
    centred but too firm: reduce); the order and the limits are ours.
    """
    if not state.in_contact:
        return _advise(Primitive.RESET, Reason.NO_CONTACT)
    if state.cut and state.area_fraction < SLIVER_FRACTION:
        return _advise(Primitive.RESET, Reason.OVER_THE_EDGE)
    quantities = (
        (state.force_n, goal.force_n),
        (state.depth_mm, goal.depth_mm),
        (state.area_fraction, goal.area_fraction),
    )
    if any(value > band.high for value, band in quantities):
        return _advise(Primitive.DECREASE_FORCE, Reason.TOO_FIRM)
    move = _move_to_center(state, goal, move_step_mm)
    if move is not None:
        return move
    if any(value < band.low for value, band in quantities):
        factor = INCREASE_FACTOR
        if 0 < state.force_n < goal.force_n.low:  # the executor goes no further than into the band
            factor = min(factor, max(goal.force_n.low, goal.force_n.middle) / state.force_n)
        next_force_n = state.force_n * factor
        next_depth_mm = state.depth_mm * factor**DEPTH_EXPONENT
        if next_force_n <= goal.force_n.high and next_depth_mm <= goal.depth_mm.high:
            return _advise(Primitive.INCREASE_FORCE, Reason.TOO_LIGHT)
        return _advise(None, Reason.BAND_TOO_NARROW)
    if state.x_mm not in goal.x_mm or state.y_mm not in goal.y_mm:
        return _advise(None, Reason.BAND_TOO_NARROW)
    return Advice(action=None, success=True, reason=Reason.GOOD)


def force_goal(force_n: Band) -> Goal:
    """Goal of the lessons for a target of the force [N]; depth and area follow from it."""
    x, y = (Band(low=-half, high=half) for half in PLACE_MM.values())
    return Goal(
        force_n=force_n, depth_mm=DEFAULT_DEPTH_MM, area_fraction=DEFAULT_AREA, x_mm=x, y_mm=y
    )


def _advise(action: Primitive | None, reason: Reason) -> Advice:
    return Advice(action=action, success=False, reason=reason)


def _move_to_center(state: ContactState, goal: Goal, move_step_mm: float) -> Advice | None:
    axes = (
        (state.x_mm, goal.x_mm, Primitive.MOVE_LEFT, Primitive.MOVE_RIGHT, Side.LEFT, Side.RIGHT),
        (state.y_mm, goal.y_mm, Primitive.MOVE_DOWN, Primitive.MOVE_UP, Side.BOTTOM, Side.TOP),
    )
    outside: list[tuple[float, Primitive]] = []
    for value, band, lower, higher, _, _ in axes:
        excess = _excess(value, band)
        step = move_step_mm if value > band.high else -move_step_mm
        if excess > 0 and _excess(value - step, band) < excess:  # the contact moves the other way
            half_width = max((band.high - band.low) / 2, 1e-6)
            outside.append((excess / half_width, higher if value > band.high else lower))
    if outside:
        return _advise(max(outside, key=lambda item: item[0])[1], Reason.OFF_CENTER)
    for value, band, lower, higher, low_side, high_side in axes:
        if len({low_side, high_side} & state.cut) != 1:
            continue  # whole along this axis, or too large for the pad
        side, action, sign = (
            (low_side, lower, -1) if low_side in state.cut else (high_side, higher, 1)
        )
        middle = (band.low + band.high) / 2
        moved = value - sign * move_step_mm
        if side in state.cut and moved in band and abs(moved - middle) < abs(value - middle):
            return _advise(action, Reason.CUT)
    return None


def _excess(value: float, band: Band) -> float:
    """Distance from the band, in its unit; 0 inside."""
    return max(band.low - value, value - band.high, 0.0)
