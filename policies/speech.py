"""Words for a contact and for the advice on it: D_t of the teacher.

``policies.extraction`` reads every wording back to the same action and verdict (tested over all of
them). Not here: what to advise (``policies.teacher``), and the short D_t that the language model
learns (``tacgrasp.lessons.exchanges``).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cltp.tactile.states import ContactState
from policies.teacher import Advice, Reason
from primitives import Primitive

CONTACT_WORDINGS: tuple[str, ...] = (
    "The contact is {depth} ({depth_mm} mm) at the {position} ({x}, {y} mm), its area is {area} "
    "({share} % of the pad), the force is about {force} N.",
    "I feel a {depth} contact in the {position} of the pad: {depth_mm} mm deep, {area} area "
    "({share} %), about {force} N, centre at ({x}, {y}) mm.",
    "Pressed {depth} in {position} with {area} contact area: {depth_mm} mm, {share} % of the "
    "field, {force} N, at x {x} mm and y {y} mm.",
    "At ({x}, {y}) mm, in the {position}, the gel is pressed {depth_mm} mm, which is {depth}; the "
    "contact area is {area} with {share} % and the force {force} N.",
    "Contact: {position}, {depth}, {area} area. Depth {depth_mm} mm, share {share} %, force "
    "{force} N, centre {x} mm across and {y} mm along.",
    "The object touches the {position} of the pad with {force} N; depth {depth_mm} mm ({depth}), "
    "area {share} % ({area}), at ({x}, {y}) mm.",
)
NO_CONTACT_WORDINGS: tuple[str, ...] = (
    "There is no contact: 0.00 mm, 0.0 N.",
    "Nothing touches the pad.",
    "The gel is flat, nothing is pressed into it.",
    "I feel no contact.",
    "The pad is empty.",
)
REASON_WORDINGS: dict[Reason, tuple[str, ...]] = {
    Reason.NO_CONTACT: (
        "The object was missed.",
        "The fingers closed on air.",
        "The grasp missed.",
    ),
    Reason.OVER_THE_EDGE: (
        "Only a sliver of the contact is on the pad.",
        "The contact lies over the edge, beyond one step.",
        "Most of it is beyond the pad.",
    ),
    Reason.TOO_FIRM: (
        "That is too firm.",
        "It is pressed too firmly.",
        "This is more than the goal.",
    ),
    Reason.OFF_CENTER: (
        "It is off centre.",
        "The contact is too far out.",
        "It is badly centred.",
    ),
    Reason.CUT: (
        "The edge cuts it off.",
        "Part of it lies beyond the edge.",
        "The pad ends inside it.",
    ),
    Reason.TOO_LIGHT: (
        "That is too light.",
        "It is held too loosely.",
        "This is less than the goal.",
    ),
    Reason.BAND_TOO_NARROW: (
        "No step fits between the limits of the goal: hold and ask for a wider goal.",
        "Every step would overshoot, so hold still.",
        "The goal is narrower than a step, holding.",
        "It is outside the goal and any step would pass beyond it.",
    ),
    Reason.GOOD: (
        "It lies within the goal.",
        "All is within the limits.",
        "It is well centred.",
    ),
}


def _move_wordings(way: str, adverb: str, side: str, other: str) -> tuple[str, ...]:
    return (
        f"Move the gripper {adverb}.",
        f"Please shift the gripper {way}.",
        f"The gripper should move {way}.",
        f"The hand needs to go {way}, towards the contact.",
        f"So the next step is to move {way}.",
        f"I suggest moving the fingers slightly {adverb}.",
        f"Move a step {way}, to bring the contact to the middle.",
        f"Go {way}, not {other}.",
        f"Shift the grasp towards the {side}.",
        f"Do not move {other}; move {way}.",
        f"It is best to move the gripper a little {way}.",
        f"Next: move_{way}.",
    )


ACTION_WORDINGS: dict[Primitive, tuple[str, ...]] = {
    Primitive.MOVE_UP: _move_wordings("up", "upward", "top", "down"),
    Primitive.MOVE_DOWN: _move_wordings("down", "downward", "bottom", "up"),
    Primitive.MOVE_LEFT: _move_wordings("left", "to the left", "left", "right"),
    Primitive.MOVE_RIGHT: _move_wordings("right", "to the right", "right", "left"),
    Primitive.INCREASE_FORCE: (
        "Increase the gripping force.",
        "Grip more firmly.",
        "Tighten the grip a little.",
        "More force is needed.",
        "The force should be increased.",
        "Squeeze slightly harder.",
        "Raise the force by one step.",
        "Please apply more force.",
        "I suggest increasing the force.",
        "Hold it more tightly.",
        "Do not loosen the grip; strengthen it: increase_force.",
        "Next: increase_force.",
    ),
    Primitive.DECREASE_FORCE: (
        "Decrease the gripping force.",
        "Slightly reduce the gripping force.",
        "Loosen the grip a little.",
        "Less force is needed.",
        "The force should be reduced.",
        "Squeeze less hard.",
        "Lower the force by one step.",
        "Please apply less force.",
        "I suggest reducing the force.",
        "Hold it more gently.",
        "Do not tighten the grip; relax the grip.",
        "Next: decrease_force.",
    ),
    Primitive.RESET: (
        "Reset the grasp.",
        "Start over.",
        "Open and grasp again.",
        "Regrasp the object.",
        "The gripper should reset.",
        "Go back to the start and grasp again.",
        "I suggest starting over.",
        "Release it and try again.",
        "It is best to re-grasp.",
        "Next: reset.",
    ),
}
SUCCESS_WORDINGS: tuple[str, ...] = (
    "The grasp is stable.",
    "The grasp is stable, no further action is needed.",
    "The grip is secure and nothing has to change.",
    "This is a stable grasp.",
    "The grasp is reliable, so hold it like this.",
    "The hold on the object is secure.",
    "The gripping force and the contact are appropriate.",
    "The grasp is appropriate: no adjustment is required.",
    "Nothing needs to be done, the grasp is secure.",
    "The contact is centred, and the grip is reliable.",
    "Stable: there is no need to move.",
    "The grasp feels stable and secure.",
)


def speak(state: ContactState, advice: Advice, rng: np.random.Generator | None = None) -> str:
    """Describe the contact and word the advice on it.

    Args:
        state: State of the contact.
        advice: The teacher's advice.
        rng: Generator that draws the wordings; None takes the first of each.

    Returns:
        Two or three sentences; ``extract`` reads ``advice.action`` and ``advice.success`` in them.
    """
    parts = [describe(state, rng), _pick(REASON_WORDINGS[advice.reason], rng)]
    if advice.success:
        parts.append(_pick(SUCCESS_WORDINGS, rng))
    elif advice.action is not None:
        parts.append(_pick(ACTION_WORDINGS[advice.action], rng))
    return " ".join(parts)


def describe(state: ContactState, rng: np.random.Generator | None = None) -> str:
    """Describe the contact alone, in words and numbers [mm, %, N]."""
    if state.depth is None or state.position is None or state.area is None:
        return _pick(NO_CONTACT_WORDINGS, rng)
    return _pick(CONTACT_WORDINGS, rng).format(
        depth=state.depth,
        position=state.position,
        area=state.area,
        depth_mm=f"{state.depth_mm:.2f}",
        x=f"{state.x_mm:+.1f}",
        y=f"{state.y_mm:+.1f}",
        share=f"{100 * state.area_fraction:.0f}",
        force=f"{state.force_n:.1f}",
    )


def _pick(wordings: Sequence[str], rng: np.random.Generator | None) -> str:
    return wordings[0 if rng is None else int(rng.integers(len(wordings)))]
