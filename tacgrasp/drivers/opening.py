"""Whether a gripper is open, as it must be before a sensor takes its gel as untouched.

A gripper may still hold what an earlier run gripped. What presses on the gel then would be taken
for the untouched gel, and only the rest of a force would be felt. A gripper that holds is not
opened here, since what it holds would fall.
"""

from __future__ import annotations

from primitives.devices import Gripper
from primitives.errors import RobotError

LEAST_OPEN_M = 0.005
"""Least opening at the start of a run [m]. Our choice: more than ``primitives.clear_mm`` (2 mm), by
which fingers open that have closed on nothing; so narrow, they would go down onto the object. How
much wider they stand is the bench's own affair."""

BY_JOG = "tacgrasp jog (key o; --open needs the gripper alone)"
"""How a person opens a gripper."""

OPEN_IT = f"open it until it is wide enough: {BY_JOG}"

UNTOUCHED = "what presses on the gel would be taken for the untouched gel"
"""What would go wrong with a gripper that still grips, where the sensor is read."""


def opening_problem(width_m: float, grip: str, risk: str = UNTOUCHED) -> str:
    """Why a gripper is not open; empty if it is.

    Args:
        width_m: Opening between the fingers [m].
        grip: How hard it grips, for people; empty if it does not.
        risk: What would go wrong if it still grips.
    """
    width_mm = 1000 * width_m
    if grip:
        return (
            f"the gripper is not open: it still grips, with {grip} and {width_mm:.1f} mm between "
            f"the fingers; {risk}. Support what it holds, then {OPEN_IT}"
        )
    if width_m < LEAST_OPEN_M:
        return (
            f"the gripper is not open: {width_mm:.1f} mm between the fingers, at least "
            f"{1000 * LEAST_OPEN_M:g} mm are needed; {OPEN_IT}"
        )
    return ""


def check_open(gripper: Gripper) -> None:
    """Refuse a gripper that is not open.

    Raises:
        RobotError: It grips, or its fingers are almost closed; or it has failed.
    """
    state = gripper.state()
    grip = f"{state.force_n:.2f} N commanded" if state.closed else ""
    if problem := opening_problem(state.width_m, grip):
        raise RobotError(f"{problem}; nothing moved")
