"""Describe a contact in words and numbers: as measured, and in the language model's words.

Not here: reading files (``cltp.sensing.touch_files``), measuring (``cltp.tactile.measure``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.partial_pad import is_partial, partial_text
from cltp.tactile.contact.places_apart import apart_text
from cltp.tactile.contact.raised_pad import is_raised, raised_text
from cltp.tactile.contact.single_cloud import (
    is_lowered,
    is_touched,
    lowered_text,
    unseen_mm,
)
from cltp.tactile.measure import contact_state
from cltp.tactile.states import DIMENSIONS, NO_CONTACT_STATE, NUMBERS, ContactState
from cltp.texts.captions import caption
from policies import Observation

if TYPE_CHECKING:
    from cltp.encoder.reader import Number, TouchReader
    from policies.llm.policy import LlmPolicy
    from primitives.contract import Contract

NO_CONTACT = "nothing touches the gel"
"""Less deep than ``unseen_mm`` a press may be drift, which a single cloud can't tell from it, and a
wide, flat press shows no slope to be known by."""

NO_INTERVALS = "no_intervals"
"""Flag of numbers that were measured directly, without weights."""

UNCALIBRATED_FORCE = "uncalibrated_force"
"""Flag of a force on a unit without a force calibration."""

RAISED = "raised"
"""Flag of a pad that is raised all over (``cltp.encoder.reader.Flag``)."""

FORCES_DIFFER = "forces_differ"
"""Flag of a contact whose force is another one by the gel's shape than by the model."""

APART = "apart"
"""Flag of a contact that stands out in places that lie apart, and may be two."""

DIFFERS, DIFFERS_N = 1.5, 0.5
"""Factor, and force besides [N], by which a directly measured force lies outside of the model's
interval where the two exclude each other. Our choice: its own error of a single contact is -26 to
+35 %, and drift beside a light one is some tenths of a newton."""

PARTIAL = "partial"
"""Flag of a pad that is measured in part (``cltp.encoder.reader.Flag``)."""

LOWERED = "lowered"
"""Flag of a cloud that has lost its zero (``cltp.tactile.contact.single_cloud``)."""


def make_reader(weights: Path) -> TouchReader | None:
    """What reads clouds by the encoder of some weights; None where they give no intervals.

    Raises:
        TouchError: The weights can't be used.
    """
    from cltp.checkpoints.tac3d_llm import load_encoder  # torch, which measuring does without
    from cltp.encoder.reader import TouchReader

    encoder, heads = load_encoder(weights / "encoder")
    return TouchReader(encoder, heads) if heads.has_intervals else None


def cloud_flags(cloud: TactileCloud) -> list[str]:
    """Flags of a contact that its cloud gives without a reader."""
    return zero_flags(cloud) + ([] if cloud.force_scale.is_calibrated else [UNCALIBRATED_FORCE])


def contact_flags(cloud: TactileCloud, read: ContactState) -> list[str]:
    """Flags of a contact beside what is read of it."""
    return [APART] if apart_text(cloud, read.shape) else []


def zero_flags(cloud: TactileCloud) -> list[str]:
    """Flags of a cloud that is partial or has lost its zero, touched or not."""
    return [PARTIAL] * is_partial(cloud) + [LOWERED] * is_lowered(cloud)


def touches(cloud: TactileCloud, in_contact: bool | None = None) -> bool:
    """Whether something touches the gel.

    Args:
        cloud: The cloud.
        in_contact: What a test against the gel with open fingers has shown, which knows its drift
            (``tacgrasp.rig.gel_sense``); None tests the cloud alone, in which a soft press may be
            drift.

    Raises:
        TouchError: The cloud is tested, and its z has the wrong sign.
    """
    return is_touched(cloud) if in_contact is None else in_contact


def describe(cloud: TactileCloud, in_contact: bool | None = None) -> list[str]:
    """Measured facts of a contact, a line each; ``in_contact`` as for ``touches``.

    Raises:
        TouchError: The cloud can't be measured, or its z has the wrong sign.
    """
    sensor, mark = cloud.sensor, cloud.force_scale.mark or "calibrated"
    is_in_contact = touches(cloud, in_contact)
    state = contact_state(cloud, in_contact=is_in_contact)
    lines = [
        f"sensor    {sensor.name}, {sensor.width_mm:.1f} × {sensor.height_mm:.1f} mm",
        f"points    {len(cloud.points_mm)}",
    ]
    if is_raised(cloud):
        return [*lines, f"contact   unreadable: {raised_text(cloud)}"]
    if is_partial(cloud):
        if not state.in_contact:
            return [*lines, f"contact   unknown: {partial_text(cloud)}"]
        lines.append(f"pad       don't act on this: {partial_text(cloud)}")
    if is_lowered(cloud):
        lines.append(f"zero      don't act on this: {lowered_text(cloud)}")
    if state.depth is None or state.position is None or state.area is None:
        return [*lines, f"contact   {_unmeasured(cloud, is_in_contact)}"]
    return [
        *lines,
        f"position  {state.position} ({state.x_mm:+.2f}, {state.y_mm:+.2f} mm)",
        f"depth     {state.depth} ({state.depth_mm:.2f} mm)",
        f"area      {state.area} ({state.area_fraction:.1%}, "
        f"{state.area_fraction * sensor.area_mm2:.0f} mm²)",
        f"force     about {state.force_n:.2f} N (an estimate from the gel's shape, {mark})",
        f"cut       {', '.join(sorted(state.cut)) or 'no'}",
        f"caption   {caption(state)}",
    ]


def _unmeasured(cloud: TactileCloud, is_in_contact: bool) -> str:
    """Why there are no numbers of a contact."""
    if is_in_contact:
        return "something presses the most of the pad; it can't be measured directly"
    if is_lowered(cloud):
        return "unknown: nothing stands out, but the zero is lost"
    return (
        f"none: {NO_CONTACT} deeper than {unseen_mm(cloud):.2f} mm "
        "(a wide and flat press shows less, and may be deeper)"
    )


def describe_in_numbers(
    cloud: TactileCloud, reader: TouchReader | None, in_contact: bool | None = None
) -> dict[str, Any]:
    """The same for programs: words, numbers with their intervals, and warnings.

    Args:
        cloud: The cloud.
        reader: Reads it by weights; None measures it directly, without shape, texture, intervals.
        in_contact: As for ``touches``.

    Raises:
        TouchError: The cloud can't be measured, or its z has the wrong sign.

    Of a pad that is raised all over, or where nothing stands out of one that is measured in part or
    has lost its zero, ``contact`` is None, and nothing is read but the flag.
    """
    if is_raised(cloud):
        return _in_numbers(cloud, None, NO_CONTACT_STATE, flags=[RAISED])
    is_in_contact = touches(cloud, in_contact)
    if is_partial(cloud) and not is_in_contact:
        return _in_numbers(cloud, None, NO_CONTACT_STATE, flags=zero_flags(cloud))
    state, flags = contact_state(cloud, in_contact=is_in_contact), []
    numbers: dict[str, dict[str, float | None]] = {}
    confidence: dict[str, float] = {}
    if is_in_contact and reader is not None:
        reading = reader.read(cloud)
        flags = [flag.value for flag in reading.flags]
        state = reading.state if reading.state.in_contact else state
        numbers = {
            name: {"value": number.value, "lo": number.low, "hi": number.high}
            for name, number in reading.numbers.items()
        }
        confidence = dict(reading.confidence)
        if reading.state.in_contact and differing(
            contact_state(cloud, in_contact=True), reading.numbers
        ):
            flags.append(FORCES_DIFFER)
        flags += contact_flags(cloud, reading.state)
    elif is_in_contact:
        flags = [NO_INTERVALS]
        numbers = {
            name: {"value": getattr(state, name), "lo": None, "hi": None} for name in NUMBERS
        }
    flags += cloud_flags(cloud) if is_in_contact else zero_flags(cloud)
    flags = list(dict.fromkeys(flags))
    contact = None if LOWERED in flags and not is_in_contact else is_in_contact
    return _in_numbers(cloud, contact, state, numbers=numbers, confidence=confidence, flags=flags)


def differing(measured: ContactState, numbers: Mapping[str, Number]) -> str:
    """Where the force that is measured directly and that of the model exclude each other; or ''.

    The direct one is made for one contact with the pad around it: of a wide one, or of many, it
    finds a part.

    Args:
        measured: As ``contact_state`` measures it.
        numbers: As the encoder reads them (``cltp.encoder.reader.TouchReading``).
    """
    force = numbers["force_n"]
    low_n, high_n = force.low / DIFFERS - DIFFERS_N, force.high * DIFFERS + DIFFERS_N
    if low_n <= measured.force_n <= high_n:
        return ""
    return (
        f"{measured.force_n:.2f} N by the gel's shape, {force.low:.2f}-{force.high:.2f} N by the "
        "model"
    )


def _in_numbers(
    cloud: TactileCloud,
    contact: bool | None,
    state: ContactState,
    *,
    numbers: dict[str, dict[str, float | None]] | None = None,
    confidence: dict[str, float] | None = None,
    flags: list[str],
) -> dict[str, Any]:
    """The keys of ``describe_in_numbers``."""
    words = {name: getattr(state, name) for name in DIMENSIONS}
    said = caption(state)
    if contact is None:
        said = f"{_why_unknown(cloud, flags)}."
    return {
        "sensor": cloud.sensor.name,
        "points": len(cloud.points_mm),
        "contact": contact,
        "state": words | {"cut": sorted(state.cut), "caption": said},
        "numbers": numbers or {},
        "confidence": confidence or {},
        "flags": flags,
    }


def _why_unknown(cloud: TactileCloud, flags: Sequence[str]) -> str:
    """Why it is unknown whether anything touches, without a full stop."""
    if PARTIAL in flags:
        return partial_text(cloud)
    return lowered_text(cloud) if LOWERED in flags else raised_text(cloud)


def unadvised_text(cloud: TactileCloud, state: ContactState) -> str:
    """Why nothing is advised on a contact, without a full stop; '' where something is."""
    if is_partial(cloud):
        return partial_text(cloud)
    if is_lowered(cloud):
        return lowered_text(cloud)
    return apart_text(cloud, state.shape)


def describe_by_model(
    cloud: TactileCloud, model: LlmPolicy, contract: Contract, in_contact: bool | None = None
) -> list[str]:
    """Description and advice of the language model, a line each; ``in_contact`` as for ``touches``.

    Raises:
        LimitError: The contract is refused.
    """
    description = model.describe(cloud)
    decision = model.decide(Observation(cloud=cloud, in_contact=in_contact), contract)
    read = model.read(cloud)
    doubt = differing(contact_state(cloud, in_contact=True), read.numbers)
    if unadvised := unadvised_text(cloud, read.state):
        advice = f"no action: {unadvised}"
    elif decision.action is not None:
        advice = f"{decision.action} (confidence {decision.confidence:.2f})"
    elif decision.success:
        advice = f"nothing, the grasp is good (confidence {decision.confidence:.2f})"
    else:
        advice = f"no action: {decision.reason}"
    mark = cloud.force_scale.mark
    return [
        f"model     {description}",
        *([f"differs   {doubt}: don't act on either force"] if doubt else []),
        f"asked     {contract.text}",
        f"says      {decision.text}",
        f"advice    {advice}",
        *([f"forces    {mark}, in the model's texts too"] if mark else []),
    ]
