"""The seven action primitives of Algorithm 1 (paper, appendix B)."""

from __future__ import annotations

from enum import StrEnum


class Primitive(StrEnum):
    """The actions that a policy can ask for; the value is the identifier in D_t.

    A move names the direction of the gripper in the gel frame. It goes towards the contact, which
    brings the contact to the pad's centre; 'down' is towards the fingertip.
    """

    MOVE_UP = "move_up"
    MOVE_DOWN = "move_down"
    MOVE_LEFT = "move_left"
    MOVE_RIGHT = "move_right"
    INCREASE_FORCE = "increase_force"
    DECREASE_FORCE = "decrease_force"
    RESET = "reset"


PAD_DIRECTION: dict[Primitive, tuple[float, float]] = {
    Primitive.MOVE_UP: (0.0, 1.0),
    Primitive.MOVE_DOWN: (0.0, -1.0),
    Primitive.MOVE_LEFT: (-1.0, 0.0),
    Primitive.MOVE_RIGHT: (1.0, 0.0),
}
"""Unit vectors (x, y) of the four moves in the gel frame."""
