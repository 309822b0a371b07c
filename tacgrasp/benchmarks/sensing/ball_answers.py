"""What is said of one press of a known ball, by direct measurement, encoder and language model.

Not here: shares and orders over many presses (``tacgrasp.benchmarks.sensing.ball_captions``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.checkpoints.tac3d_llm import load_encoder
from cltp.encoder.heads import restored
from cltp.errors import TouchError
from cltp.sensing.ball_presses import BallPress, ProfileTable, fit_press
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CLASSES, Depth, Shape
from cltp.texts.captions import parse_caption
from policies import PolicyError
from tacgrasp.lessons.answer_scoring import numbers_said
from tacgrasp.playback.describe import CAPTION_REQUEST
from tacgrasp.policy_factory import load_llm


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """What was said of one press, and what is known of it.

    Attributes:
        name: Of the frame.
        depth_mm: Of the ball, from the radius of its circle [mm].
        fitted_mm: Of the ball, from its slopes [mm].
        x_mm, y_mm: Of the ball's centre [mm, gel frame].
        measured_mm: Depth that the direct measurement gives; 0 without contact [mm].
        off_mm: Distance of the measured place from the ball's [mm]; None without contact.
        text: The model's reply.
        shape: Named in its caption; None when it named none.
        depth: Named in its caption.
        said_mm: Depth in numbers beside the caption; None when it gave none [mm].
        heads_shape: What the encoder's heads call it.
        heads_mm: Depth of the encoder's heads [mm].
    """

    name: str
    depth_mm: float
    fitted_mm: float
    x_mm: float
    y_mm: float
    measured_mm: float
    off_mm: float | None
    text: str
    shape: Shape | None
    depth: Depth | None
    said_mm: float | None
    heads_shape: Shape
    heads_mm: float


def asker(
    weights: Path, sensor: SensorSpec, profiles: ProfileTable
) -> Callable[[str, BallPress, NDArray[np.float32]], Said]:
    """What asks a model and its encoder's heads about one press."""
    model = load_llm(weights)
    encoder, heads = load_encoder(weights / "encoder")
    encoder.eval(), heads.eval()

    @torch.inference_mode()
    def ask(name: str, press: BallPress, height_mm: NDArray[np.float32]) -> Said:
        cloud = cloud_from_heights(height_mm, sensor)
        state = contact_state(cloud)
        x_mm = (press.column - (sensor.columns - 1) / 2) * sensor.mm_per_px
        y_mm = ((sensor.rows - 1) / 2 - press.row) * sensor.mm_per_px
        try:
            text = model.ask(cloud, CAPTION_REQUEST)
        except PolicyError as error:
            text = f"nothing: {error}"
        shape, depth = _named(text)
        numbers = numbers_said(text)
        logits, values, _, _ = heads(encoder(torch.from_numpy(encoder_input(cloud))[None]).pooled)
        return Said(
            name=name,
            depth_mm=press.depth_mm,
            fitted_mm=_fitted_mm(press, height_mm, sensor, profiles),
            x_mm=x_mm,
            y_mm=y_mm,
            measured_mm=state.depth_mm,
            off_mm=(
                float(np.hypot(state.x_mm - x_mm, state.y_mm - y_mm)) if state.in_contact else None
            ),
            text=text,
            shape=shape,
            depth=depth,
            said_mm=None if numbers is None else numbers[0],
            heads_shape=Shape(CLASSES["shape"][int(logits[0].argmax())]),
            heads_mm=float(restored(values)[0, 0]),
        )

    return ask


def _fitted_mm(
    press: BallPress, height_mm: NDArray[np.float32], sensor: SensorSpec, profiles: ProfileTable
) -> float:
    down, across = (np.asarray(np.gradient(height_mm, sensor.mm_per_px, axis=a)) for a in (0, 1))
    deepest = float(profiles.depths_mm[-1])
    fitted = fit_press(
        press, across, down, profiles, mm_per_px=sensor.mm_per_px, max_depth_mm=deepest
    )
    return fitted.depth_mm


def _named(text: str) -> tuple[Shape | None, Depth | None]:
    try:
        slots = parse_caption(text.split(".")[0])
    except TouchError:
        return None, None
    return slots.shape, slots.depth
