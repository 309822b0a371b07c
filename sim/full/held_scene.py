"""Scenes of bodies that a gripper holds: berries, tomatoes, eggs and pegs, at a grasp's forces."""

from __future__ import annotations

import math

import numpy as np

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.states import Shape, Texture
from sim.full.requests import FullRequest
from sim.full.scene import PressScene
from sim.grasp.bodies import Body, Range, draw_body
from sim.grasp.turned_pad import turned
from sim.tcl3d.contact_geometry import Mask, ShapeLabel, border_fraction
from sim.tcl3d.labelled_press import Naming
from sim.tcl3d.poses import position_within
from sim.tcl3d.series import grid_over

REACH = np.array([0.59, 0.62])
"""Largest distance of a body's nearest point from the pad's centre, over its width and height."""

FORCE_N: dict[str, Range] = {
    "strawberry": Range(low=0.05, high=7.0, log=True),
    "cherry_tomato": Range(low=0.05, high=4.0, log=True),
    "egg": Range(low=0.1, high=12.0, log=True),
    "peg": Range(low=0.15, high=18.0, log=True),
}
"""True forces: from a first touch, which is felt at about 0.1 N, to several times the goal."""

TAILS = 0.1
"""Fraction left out at either end of every range of a body: the ends are for benchmarks."""

TURNED_FRACTION = 0.3
"""Fraction of the bodies that a sensor mounted a quarter turn presses."""

ELLIPSOID_RATIO = 1.4
"""Ratio of curvatures from which a cap is an ellipsoid (``cltp.tactile.states.Shape``)."""

_RATIO_UNSURE = (0.93, 1.07)  # factors about the ratio between which sphere and ellipsoid are alike
_CUT = 0.36  # part of the outline at the pad's border from which the shape is unsure
_ACHENES_MM = 3.0  # width of a contact from which achenes show


def held_scene(request: FullRequest, rng: np.random.Generator) -> PressScene:
    """Draw the scene of a body in a gripper."""
    kind, sensor = request.choice.kind, request.sensor
    body = draw_body(kind, rng, TAILS)
    if rng.random() < TURNED_FRACTION:
        body = turned(body)
    x, y = grid_axes_mm(sensor, *grid_over(sensor))
    reach = REACH * [sensor.width_mm, sensor.height_mm]
    while True:
        x_mm, y_mm = position_within(rng, reach).tolist()
        gap = body.gap_on(x - x_mm, y - y_mm)
        if gap.min() < body.thickness_mm / 2:  # else the fingers miss it
            break
    fractions = np.sort(rng.random(len(request.depths_mm)))
    ratio = curvature_ratio(body)
    shape = Shape.ELLIPSOID if ratio >= ELLIPSOID_RATIO else Shape.SPHERE
    low, high = _RATIO_UNSURE
    is_sure = not low * ELLIPSOID_RATIO < ratio < high * ELLIPSOID_RATIO
    if kind == "peg":
        shape, is_sure = Shape.CYLINDER, True
    pitch_mm = sensor.width_mm / gap.shape[1]
    has_achenes = kind == "strawberry"

    def name(touching: Mask, closed: Mask, depth_mm: float) -> Naming:
        width_mm = float(np.sqrt(np.count_nonzero(closed))) * pitch_mm
        return Naming(
            shape=ShapeLabel(shape, is_sure and border_fraction(closed) < _CUT),
            texture=Texture.BUMPY if has_achenes else Texture.SMOOTH,
            is_texture_sure=not has_achenes or width_mm > _ACHENES_MM,
        )

    return PressScene(
        gap_mm=gap - gap.min(),
        loads=tuple(FORCE_N[kind].quantile(u) for u in fractions),
        modulus_mpa=body.modulus_mpa,
        by_force=True,
        name=name,
    )


def curvature_ratio(body: Body, radius_mm: float = 4.0) -> float:
    """Larger over smaller principal curvature of a body, from a quadric fitted about its origin.

    A radius of 4 mm averages over achenes and stays within the contact.
    """
    axis = np.linspace(-radius_mm, radius_mm, 17)
    gap = body.gap_on(axis, -axis)
    x, y = np.meshgrid(axis, -axis)
    mask = (np.hypot(x, y) <= radius_mm) & (gap < body.thickness_mm / 2)
    x, y, z = x[mask], y[mask], gap[mask]
    terms = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)], axis=1)
    a, b, c, *_ = np.linalg.lstsq(terms, z, rcond=None)[0]
    low, high = np.linalg.eigvalsh([[2 * a, b], [b, 2 * c]])
    return math.inf if low <= 0 else float(high / low)
