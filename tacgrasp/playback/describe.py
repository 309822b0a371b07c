"""Say what a touch is, in words and numbers: as it is measured, and as the language model says it.

Not here: reading files (``cltp.sensing.touch_files``), measuring (``cltp.tactile.measure``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.texts.captions import caption
from policies import PolicyError

if TYPE_CHECKING:
    from policies.llm import LlmPolicy

CAPTION_REQUEST = "Describe the contact."


def describe(cloud: TactileCloud) -> list[str]:
    """One line a fact.

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


def said(cloud: TactileCloud, model: LlmPolicy, instruction: str) -> list[str]:
    """What the language model says of a touch and advises on it, one line a fact.

    Raises:
        PolicyError: The instruction is none that it can have understood.
    """
    try:
        words = model.ask(cloud, CAPTION_REQUEST)
    except PolicyError as error:
        words = f"nothing: {error}"
    advice = model.decide(cloud, instruction)
    if advice.action is not None:
        asked = f"{advice.action} (confidence {advice.confidence:.2f})"
    elif advice.success:
        asked = f"nothing, the grasp is good (confidence {advice.confidence:.2f})"
    else:
        asked = f"no action: {advice.reason}"
    return [
        f"model     {words}",
        f"asked     {instruction}",
        f"says      {advice.text}",
        f"advice    {asked}",
    ]
