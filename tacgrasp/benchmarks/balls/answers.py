"""Readings of one press of a known ball: direct measurement, encoder heads, language model."""

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
from tacgrasp.lessons.captions import read_numbers
from tacgrasp.policy_factory import load_llm


@dataclass(frozen=True, slots=True, kw_only=True)
class BallReading:
    """Readings of one press, and its geometry.

    Attributes:
        name: Name of the frame.
        depth_mm: Depth of the ball, from the radius of its circle [mm].
        fitted_mm: Depth of the ball, from its slopes [mm].
        x_mm, y_mm: Centre of the ball [mm, gel frame].
        measured_mm: Depth by direct measurement; 0 without contact [mm].
        position_error_mm: Distance of the measured position from the ball's centre [mm]; None
            without contact.
        text: Reply of the language model.
        shape: Shape in its caption; None when it named none.
        depth: Depth class in its caption.
        caption_mm: Depth in numbers beside the caption [mm]; None when it gave none.
        heads_shape: Shape by the encoder's heads.
        heads_mm: Depth by the encoder's heads [mm].
    """

    name: str
    depth_mm: float
    fitted_mm: float
    x_mm: float
    y_mm: float
    measured_mm: float
    position_error_mm: float | None
    text: str
    shape: Shape | None
    depth: Depth | None
    caption_mm: float | None
    heads_shape: Shape
    heads_mm: float


def make_reader(
    weights: Path, sensor: SensorSpec, profiles: ProfileTable
) -> Callable[[str, BallPress, NDArray[np.float32]], BallReading]:
    """A function that reads one press with a model and its encoder's heads."""
    model = load_llm(weights)
    encoder, heads = load_encoder(weights / "encoder")
    encoder.eval(), heads.eval()

    @torch.inference_mode()
    def read(name: str, press: BallPress, height_mm: NDArray[np.float32]) -> BallReading:
        cloud = cloud_from_heights(height_mm, sensor)
        state = contact_state(cloud)
        x_mm = (press.column - (sensor.columns - 1) / 2) * sensor.mm_per_px
        y_mm = ((sensor.rows - 1) / 2 - press.row) * sensor.mm_per_px
        text = model.describe(cloud, doubt=False)
        shape, depth = _caption_words(text)
        numbers = read_numbers(text)
        points = encoder_input(cloud, encoder.config.variant.layout)
        logits, values, *_ = heads(encoder(torch.from_numpy(points)[None]).pooled)
        return BallReading(
            name=name,
            depth_mm=press.depth_mm,
            fitted_mm=_fitted_mm(press, height_mm, sensor, profiles),
            x_mm=x_mm,
            y_mm=y_mm,
            measured_mm=state.depth_mm,
            position_error_mm=(
                float(np.hypot(state.x_mm - x_mm, state.y_mm - y_mm)) if state.in_contact else None
            ),
            text=text,
            shape=shape,
            depth=depth,
            caption_mm=None if numbers is None else numbers[0],
            heads_shape=Shape(CLASSES["shape"][int(logits[0].argmax())]),
            heads_mm=float(restored(values)[0, 0]),
        )

    return read


def _fitted_mm(
    press: BallPress, height_mm: NDArray[np.float32], sensor: SensorSpec, profiles: ProfileTable
) -> float:
    down, across = (np.asarray(np.gradient(height_mm, sensor.mm_per_px, axis=a)) for a in (0, 1))
    deepest = float(profiles.depths_mm[-1])
    fitted = fit_press(
        press, across, down, profiles, mm_per_px=sensor.mm_per_px, max_depth_mm=deepest
    )
    return fitted.depth_mm


def _caption_words(text: str) -> tuple[Shape | None, Depth | None]:
    try:
        slots = parse_caption(text.split(".")[0])
    except TouchError:
        return None, None
    return slots.shape, slots.depth
