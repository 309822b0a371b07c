"""Indenters: rigid shapes, posed on the pad as height fields, and the fine relief of a texture.

``gap_mm`` turns an indenter in the plane, shifts, tilts and textures it.

Not here: the surfaces (``sim.starter.surfaces``), bodies that a gripper holds
(``sim.grasp.bodies``), pressing (``sim.starter.contacts``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Shape, Texture
from sim.gel.gap import NO_BODY_MM
from sim.objects.skins import caps, grain, valley
from sim.starter.surfaces import SURFACES, Surface


@dataclass(frozen=True, slots=True, kw_only=True)
class Indenter:
    """A rigid shape to press into a gel.

    Attributes:
        shape: Its shape label.
        behind_mm: Depth of its surface behind its foremost point [mm], as a function of (u, v)
        [mm].
        max_tilt_rad: Largest tilt at which the label holds [rad].
        textured: Whether its surface is broad enough for a texture that can be felt.
    """

    shape: Shape
    behind_mm: Surface
    max_tilt_rad: float
    textured: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class IndenterPose:
    """Pose of an indenter on the pad.

    Attributes:
        x_mm, y_mm: Position of its origin [mm, gel frame].
        turn_rad: Rotation in the plane [rad].
        slope_x, slope_y: Tilt, as slope of its base over the pad.
    """

    x_mm: float
    y_mm: float
    turn_rad: float = 0.0
    slope_x: float = 0.0
    slope_y: float = 0.0


def draw_indenter(shape: Shape, rng: np.random.Generator) -> Indenter:
    """Draw an indenter of a shape."""
    draw, degrees, textured = SURFACES[shape]
    tilt_rad = math.radians(degrees)
    return Indenter(shape=shape, behind_mm=draw(rng), max_tilt_rad=tilt_rad, textured=textured)


def gap_mm(
    indenter: Indenter,
    pose: IndenterPose,
    x_mm: FloatArray,
    y_mm: FloatArray,
    relief_mm: FloatArray | float = 0.0,
) -> FloatArray:
    """Depth of an indenter's surface behind its point that is nearest to the pad.

    Args:
        indenter: The indenter.
        pose: Its pose.
        x_mm: Shape (H, W), positions on the pad [mm].
        y_mm: Same shape [mm].
        relief_mm: Relief of its texture, (H, W) [mm].

    Returns:
        Shape (H, W), least value 0 [mm]; ``NO_BODY_MM`` where there is no surface.

    Raises:
        ValueError: No part of it is over the pad.
    """
    offset_x, offset_y = x_mm - pose.x_mm, y_mm - pose.y_mm
    cos, sin = math.cos(pose.turn_rad), math.sin(pose.turn_rad)
    behind = indenter.behind_mm(offset_x * cos + offset_y * sin, offset_y * cos - offset_x * sin)
    gap = behind + pose.slope_x * offset_x + pose.slope_y * offset_y + relief_mm
    covered = behind < NO_BODY_MM
    if not covered.any():
        raise ValueError(
            f"no part of the {indenter.shape} at ({pose.x_mm:.1f}, {pose.y_mm:.1f}) mm is over "
            "the pad; place it nearer to the centre"
        )
    return np.where(covered, gap - gap[covered].min(), NO_BODY_MM)


def relief_mm(
    texture: Texture,
    rng: np.random.Generator,
    x_mm: FloatArray,
    y_mm: FloatArray,
    sensor: SensorSpec,
) -> FloatArray:
    """Depth of a textured surface behind a smooth one.

    Limits are those of the notes, beside each class of ``cltp.tactile.states.Texture``. A relief
    lies in the pad's plane; on a curved body it is projected, not wrapped, which stretches it by
    less than a tenth within a contact.

    Args:
        texture: Class of the texture.
        rng: Random generator of its parameters.
        x_mm: Shape (H, W), over the whole sensing area [mm].
        y_mm: Same shape [mm].
        sensor: The sensor whose area it is.

    Returns:
        Shape (H, W) [mm]: 0 at the tops, except ``rough``, whose mean is 0.
    """
    if texture is Texture.SMOOTH:
        return np.zeros(np.shape(x_mm))
    if texture is Texture.ROUGH:
        spread, length_mm = rng.uniform(0.03, 0.08), rng.uniform(0.3, 0.6)
        return spread * grain(x_mm.shape, sensor, length_mm, rng)
    angle = rng.uniform(0, math.pi)
    u = x_mm * math.cos(angle) + y_mm * math.sin(angle) + rng.uniform(0, 3)
    v = y_mm * math.cos(angle) - x_mm * math.sin(angle) + rng.uniform(0, 3)
    height = rng.uniform(0.05, 0.2)
    if texture is Texture.BUMPY:
        pitch = rng.uniform(1, 3)
        return height * caps(u, v, pitch, pitch * rng.uniform(0.35, 0.48))  # not quite touching
    period = rng.uniform(0.6, 1.5)
    if texture is Texture.RIDGED:
        return height * valley(u, period)
    return height * np.minimum(valley(u, period), valley(v, period * rng.uniform(0.85, 1.2)))
