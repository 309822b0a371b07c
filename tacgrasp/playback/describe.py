"""Describe a contact in words and numbers: as measured, and in the language model's words.

Not here: reading files (``cltp.sensing.touch_files``), measuring (``cltp.tactile.measure``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.texts.captions import caption
from policies import Observation, PolicyError

if TYPE_CHECKING:
    from policies.llm import LlmPolicy

CAPTION_REQUEST = "Describe the contact."


def describe(cloud: TactileCloud) -> list[str]:
    """Measured facts of a contact, a line each.

    Raises:
        TouchError: The cloud can't be measured.
    """
    sensor = cloud.sensor
    state = contact_state(cloud)
    lines = [
        f"sensor    {sensor.name}, {sensor.width_mm:.1f} × {sensor.height_mm:.1f} mm",
        f"points    {len(cloud.points_mm)}",
    ]
    if state.depth is None or state.position is None or state.area is None:
        return [*lines, "contact   none: nothing touches the gel"]
    return [
        *lines,
        f"position  {state.position} ({state.x_mm:+.2f}, {state.y_mm:+.2f} mm)",
        f"depth     {state.depth} ({state.depth_mm:.2f} mm)",
        f"area      {state.area} ({state.area_fraction:.1%}, "
        f"{state.area_fraction * sensor.area_mm2:.0f} mm²)",
        f"force     about {state.force_n:.2f} N (an estimate from the gel's shape)",
        f"cut       {', '.join(sorted(state.cut)) or 'no'}",
        f"caption   {caption(state)}",
    ]


def describe_by_model(cloud: TactileCloud, model: LlmPolicy, instruction: str) -> list[str]:
    """Description and advice of the language model, a line each.

    Raises:
        PolicyError: The model can't understand the instruction.
    """
    try:
        description = model.ask(cloud, CAPTION_REQUEST)
    except PolicyError as error:
        description = f"nothing: {error}"
    decision = model.decide(Observation(cloud=cloud), instruction)
    if decision.action is not None:
        advice = f"{decision.action} (confidence {decision.confidence:.2f})"
    elif decision.success:
        advice = f"nothing, the grasp is good (confidence {decision.confidence:.2f})"
    else:
        advice = f"no action: {decision.reason}"
    return [
        f"model     {description}",
        f"asked     {instruction}",
        f"says      {decision.text}",
        f"advice    {advice}",
    ]
