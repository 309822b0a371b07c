"""What to do about a contact, given a goal in numbers: the rule that all advice comes from.

``rules`` asks it in the loop; the language model's advice data are its answers in many wordings.
Pure functions of ``ContactState`` and ``Goal``; no torch. Not here: how the advice is worded
(``policies.speech``).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from cltp.tactile.states import ContactState, Side
from policies.goal import Band, Goal
from primitives import Primitive
from primitives.execution import INCREASE_FACTOR

LESSON_MOVE_STEP_MM = 3.0
"""Length of a move [mm] in the lessons of the language model, and the default of every run.
Source: the design."""

DEPTH_EXPONENT = 2.0 / 3.0
"""Indentation grows as force to this power. Source: Hertz; a bonded gel grows less."""

SLIVER_SHARE = 0.004
"""A contact that the edge cuts and that shows less of the field than this lies beyond one step.

Our choice: 0.4 % of a GelSight Mini is 1.2 mm², four of 1024 points. A berry whose centre is one
step outside the pad and that is pressed lightly shows about that much.
"""


class Why(StrEnum):
    """The reason behind an advice."""

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
        action: The primitive to carry out; None for success, and when nothing would help.
        success: The contact lies within the goal.
        why: The reason.
    """

    action: Primitive | None
    success: bool
    why: Why


def teacher(state: ContactState, goal: Goal, *, move_step_mm: float) -> Advice:
    """Advise on one contact.

    The first that applies decides, in this order:

    1. No contact: ``reset``.
    2. A sliver at the edge (``SLIVER_SHARE``): ``reset``; a step would not bring it back.
    3. Too firm (force, depth or area above its band): ``decrease_force``. Before any move, since a
       move grasps again with the same force and would bruise again.
    4. Off centre: a move towards the contact, along the axis whose excess is the larger part of
       its band; or towards the one side that cuts the contact off. Only where a step of
       ``move_step_mm`` brings it nearer, so that two moves never undo each other.
    5. Too light (force, depth or area below its band): ``increase_force``, if force × 1.5, and the
       depth that Hertz then expects, stay below their upper limits.
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
        return _advise(Primitive.RESET, Why.NO_CONTACT)
    if state.cut and state.area_fraction < SLIVER_SHARE:
        return _advise(Primitive.RESET, Why.OVER_THE_EDGE)
    quantities = (
        (state.force_n, goal.force_n),
        (state.depth_mm, goal.depth_mm),
        (state.area_fraction, goal.area_fraction),
    )
    if any(value > band.high for value, band in quantities):
        return _advise(Primitive.DECREASE_FORCE, Why.TOO_FIRM)
    move = _move_to_center(state, goal, move_step_mm)
    if move is not None:
        return move
    if any(value < band.low for value, band in quantities):
        force_then = state.force_n * INCREASE_FACTOR
        depth_then = state.depth_mm * INCREASE_FACTOR**DEPTH_EXPONENT
        if force_then <= goal.force_n.high and depth_then <= goal.depth_mm.high:
            return _advise(Primitive.INCREASE_FORCE, Why.TOO_LIGHT)
        return _advise(None, Why.BAND_TOO_NARROW)
    if state.x_mm not in goal.x_mm or state.y_mm not in goal.y_mm:
        return _advise(None, Why.BAND_TOO_NARROW)
    return Advice(action=None, success=True, why=Why.GOOD)


def _advise(action: Primitive | None, why: Why) -> Advice:
    return Advice(action=action, success=False, why=why)


def _move_to_center(state: ContactState, goal: Goal, move_step_mm: float) -> Advice | None:
    axes = (
        (state.x_mm, goal.x_mm, Primitive.MOVE_LEFT, Primitive.MOVE_RIGHT, Side.LEFT, Side.RIGHT),
        (state.y_mm, goal.y_mm, Primitive.MOVE_DOWN, Primitive.MOVE_UP, Side.BOTTOM, Side.TOP),
    )
    outside: list[tuple[float, Primitive]] = []
    for value, band, lower, higher, _, _ in axes:
        excess = _excess(value, band)
        step = move_step_mm if value > band.high else -move_step_mm
        if excess > 0 and _excess(value - step, band) < excess:  # the contact comes to meet us
            half_width = max((band.high - band.low) / 2, 1e-6)
            outside.append((excess / half_width, higher if value > band.high else lower))
    if outside:
        return _advise(max(outside, key=lambda item: item[0])[1], Why.OFF_CENTER)
    for value, band, lower, higher, low_side, high_side in axes:
        if len({low_side, high_side} & state.cut) != 1:
            continue  # whole along this axis, or too large for the pad
        side, action, sign = (
            (low_side, lower, -1) if low_side in state.cut else (high_side, higher, 1)
        )
        middle = (band.low + band.high) / 2
        then = value - sign * move_step_mm
        if side in state.cut and then in band and abs(then - middle) < abs(value - middle):
            return _advise(action, Why.CUT)
    return None


def _excess(value: float, band: Band) -> float:
    """How far outside the band, in its unit; 0 inside."""
    return max(band.low - value, value - band.high, 0.0)
