"""Indenters: rigid shapes, posed on the pad as height fields.

``gap_mm`` turns an indenter in the plane, shifts, tilts and textures it.

Not here: the surfaces (``sim.starter.surfaces``), bodies that a gripper holds
(``sim.grasp.bodies``), pressing (``sim.starter.contacts``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM
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
    degrees, textured = _TRAITS[shape]
    return Indenter(
        shape=shape,
        behind_mm=SURFACES[shape](rng),
        max_tilt_rad=math.radians(degrees),
        textured=textured,
    )


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


# Largest tilt [°], and whether the surface can carry a texture. A flat face tilted by more than a
# few degrees touches as an edge; a plane must still touch with 80 % of the sensing area.
_TRAITS: dict[Shape, tuple[float, bool]] = {
    Shape.SPHERE: (0, True),  # a tilted ball is a ball elsewhere
    Shape.ELLIPSOID: (0, True),
    Shape.CUBOID: (2, True),
    Shape.TRIANGLE: (2, True),
    Shape.HEXAGON: (2, True),
    Shape.DISC: (2, True),
    Shape.PEAK: (15, False),
    Shape.PLANE: (0.25, True),
    Shape.CYLINDER: (2, True),
    Shape.RING: (2, False),
    Shape.CRESCENT: (2, False),
    Shape.EDGE: (3, False),
    Shape.CORNER: (15, False),
    Shape.LINE: (2, False),
    Shape.CROSS: (2, False),
    Shape.STRIPES: (2, False),
    Shape.DOTS: (1, False),
    Shape.WAVE: (1, True),
    Shape.HOLE: (1.5, True),
}
