"""The words of D_t, in this order: contact with its numbers, target, action, reason.

    smooth sphere or ellipsoid, slight 0.12-0.21 mm, centered x +0.4 y -1.1, tiny 2.1 %, 0.43 N.
    Goal 0.42 - 0.51 N. Action: <none>. The grasp is stable.

It is short, since every token costs time in the loop. The action comes before the reason, so that
the softmax of its token is the model's own confidence and not an echo of the reason. A word that is
in doubt stands beside its rival, a number in doubt is an interval.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from cltp.tactile.states import ContactState, Side
from cltp.texts.captions import caption
from policies.speech import REASON_WORDINGS, SUCCESS_WORDINGS
from policies.teacher import Advice
from primitives.contract import Band

NOTHING = "Nothing touches."

REQUEST = "What next?"

CAPTION_REQUEST = "Describe the contact."

OR = " or "
"""Between a word and its rival."""

DOUBTFUL: Mapping[str, float] = {"depth_mm": 0.1, "area_fraction": 0.03, "force_n": 0.2}
"""Narrowest interval that is said, in the number's unit. Our choice: below it no action changes.
Places are said without one: beyond a step's length the word for them is in doubt too."""

DOUBTFUL_RATIO = 1.6
"""High over low end of the narrowest interval that is said."""


TOLERANCE_RATIO = 0.1
TOLERANCE: Mapping[str, float] = {
    "depth_mm": 0.05,
    "x_mm": 0.5,
    "y_mm": 0.5,
    "area_fraction": 0.0,
    "force_n": 0.1,
}
"""How far a number of a caption may be off, as a fraction of it or, where that is more, in its
unit. By these ``tacgrasp.training.captions.rating`` counts numbers."""

KNOWN_RATIO = 1.28
"""Half of a 90 % interval over the tolerance, up to which a caption says a number and not the
interval: of a normal error four in five are then within the tolerance."""


def step_request(force_n: Band, limit_n: float) -> str:
    """What the model is asked in a step, for the target and the limit of its contract [N]."""
    return f"Goal {force_n.low:.2f} - {force_n.high:.2f} N, limit {limit_n:.2f} N. {REQUEST}"


def goal_text(force_n: Band) -> str:
    """The target in D_t [N]."""
    return f"Goal {force_n.low:.2f} - {force_n.high:.2f} N."


def percent(area_fraction: float) -> str:
    """A fraction of the sensing area [%], to two figures or so."""
    value = 100 * area_fraction
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


def number_text(name: str, value: float) -> str:
    """A number of ``cltp.tactile.states.NUMBERS`` as D_t writes it, without its unit."""
    if name in ("x_mm", "y_mm"):
        return f"{value:+.1f}"
    return percent(value) if name == "area_fraction" else f"{value:.2f}"


def said_number(name: str, value: float, low: float, high: float) -> str:
    """A number, or the interval around it where that is too wide to name one value."""
    least = DOUBTFUL.get(name)
    if least is None or high - low < least or high < DOUBTFUL_RATIO * low:
        return number_text(name, value)
    return _interval_text(name, low, high)


def _interval_text(name: str, low: float, high: float) -> str:
    """An interval, or the one number that both of its ends are written as."""
    ends = dict.fromkeys(number_text(name, end) for end in (low, high))
    return "-".join(ends)


def tolerance_of(name: str, value: float) -> float:
    """How far a number of a caption may be off its true value, in its unit."""
    return max(TOLERANCE_RATIO * abs(value), TOLERANCE[name])


def said_numbers(state: ContactState, ends: Mapping[str, tuple[float, float]]) -> dict[str, str]:
    """Every number of a state as D_t writes it.

    Args:
        state: The numbers.
        ends: Interval of those that have one.
    """
    values = {
        name: float(getattr(state, name))
        for name in ("depth_mm", "x_mm", "y_mm", "area_fraction", "force_n")
    }
    return {
        name: said_number(name, value, *ends.get(name, (value, value)))
        for name, value in values.items()
    }


def caption_numbers(state: ContactState, ends: Mapping[str, tuple[float, float]]) -> dict[str, str]:
    """Every number of a state as captions write it: the interval of what is known less well.

    Places are said without one, as in D_t.

    Args:
        state: The numbers.
        ends: Interval of those that have one.
    """
    said = said_numbers(state, {})
    for name, (low, high) in ends.items():
        known = 2 * KNOWN_RATIO * tolerance_of(name, getattr(state, name))
        if name in DOUBTFUL and high - low > known:
            said[name] = _interval_text(name, low, high)
    return said


def contact_text(
    state: ContactState,
    numbers: Mapping[str, str] | None = None,
    rivals: Mapping[str, str] | None = None,
) -> str:
    """First part of D_t: the five words, each beside its number, the force, and the cut sides.

    Args:
        state: The contact.
        numbers: Its numbers as text; as they are, where none are given.
        rivals: A second word for those that are in doubt, by dimension.
    """
    if not state.in_contact:
        return NOTHING
    said = numbers or said_numbers(state, {})
    rivals = rivals or {}
    words = {
        name: f"{word}{OR}{rivals[name]}" if name in rivals else str(word)
        for name in ("texture", "shape", "depth", "position", "area")
        if (word := getattr(state, name)) is not None
    }
    nouns = " ".join(words[name] for name in ("texture", "shape") if name in words) or "object"
    return (
        f"{nouns}, {words['depth']} {said['depth_mm']} mm, {words['position']} "
        f"x {said['x_mm']} y {said['y_mm']}, {words['area']} {said['area_fraction']} %, "
        f"{said['force_n']} N{cut_text(state.cut)}."
    )


def caption_text(
    state: ContactState,
    rivals: Mapping[str, str] | None = None,
    ends: Mapping[str, tuple[float, float]] | None = None,
) -> str:
    """The paper's caption with numbers behind it: depth [mm], force [N], area [%], x and y [mm].

    Args:
        state: The contact.
        rivals: A second word for those that are in doubt, by dimension.
        ends: Interval of the numbers that have one; those that are not well known are said so.
    """
    if not state.in_contact:
        return f"{caption(state, rivals)} 0.00 mm, 0.00 N."
    said = caption_numbers(state, ends or {})
    return (
        f"{caption(state, rivals)} "
        f"{said['depth_mm']} mm, {said['force_n']} N, {said['area_fraction']} %, "
        f"x {said['x_mm']}, y {said['y_mm']}{cut_text(state.cut)}."
    )


def cut_text(cut: Iterable[Side]) -> str:
    """The sides of the pad that cut a contact off; '' for none."""
    sides = " ".join(sorted(cut))
    return f", cut {sides}" if sides else ""


def advice_text(advice: Advice) -> str:
    """Last part of D_t: the action and the reason; ``policies.extraction`` reads both back."""
    action = f"<{advice.action}>" if advice.action is not None else "<none>"
    reason = SUCCESS_WORDINGS[0] if advice.success else REASON_WORDINGS[advice.reason][0]
    return f"Action: {action}. {reason}"
