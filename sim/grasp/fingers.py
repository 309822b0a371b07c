"""Contact and friction of a body between two flat fingers: pressure, and the load that it resists.

Each grip takes one contact solve (``sim.gel.layer``); the static friction of both patches limits
the load. The body's motion over time is in ``sim.grasp.world``.

World and pad share axes: x right, y up (towards the palm), gravity along -y; on a turned pad
(``sim.grasp.turned_pad``) gravity is along -x. Both fingers carry
the same gel, one of them the camera. The pad ends with the sensing area: the part of a patch beyond
it carries nothing, so that the rest carries all of the force, at a higher pressure.

Sources: limit surface and maximum dissipation after Goyal, Ruina and
Papadopoulos (1991), 'Planar sliding with dry friction'; contact in ``sim.gel.layer``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import torch

from cltp.processor import torch_threads
from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, GelMaterial
from sim.gel.shear.coarse import CoarseShear
from sim.grasp.bodies import Body

GRAVITY_M_S2 = 9.81

COLUMNS = 80
"""Columns of the grid over the sensing area: elements of 0.254 mm on a GelSight Mini."""

BRUISE_RADIUS_MM = 1.5
"""Pressure is averaged over a disc of this radius before it is compared with the bruise limit.

Our choice: flesh yields over millimetres, not at the tip of an achene or at the sharp edge of the
pad, where the pressure of linear elasticity is unbounded and would depend on the grid.
"""

_TOLERANCE = 1e-3  # of the solver: heights within about 1 µm of the converged ones
LENGTH_MM = 5.0
"""Turns a rotation into a displacement, and a moment into a force."""

_BLOCK = 2


def grid_of(sensor: SensorSpec) -> tuple[int, int]:
    """Rows and columns of the grid over the sensing area, whose elements are as good as square.

    The rows are whole blocks (``_BLOCK``): 60 × 80 on a GelSight Mini, 80 × 80 on a square pad.
    """
    blocks = round(COLUMNS / _BLOCK * sensor.height_mm / sensor.width_mm)
    return max(1, blocks) * _BLOCK, COLUMNS


def _motions(count: int = 500) -> FloatArray:
    """Unit planar motions (x, y, rotation × length), spread evenly over half of the sphere.

    Friction dissipates the same in their opposites, the other half. Shape (count, 3).
    """
    i = np.arange(count) + 0.5
    z = 1 - i / count
    angle = i * math.pi * (3 - math.sqrt(5))
    rim = np.sqrt(1 - z**2)
    return np.stack([rim * np.cos(angle), rim * np.sin(angle), z], axis=1)


_MOTIONS = _motions()


def _neighbours(motion: FloatArray, spread: float) -> FloatArray:
    """Unit motions in a 5 × 5 grid of steps ``spread`` about one. Shape (25, 3)."""
    least = int(np.argmin(np.abs(motion)))
    u, v = motion[(least + 1) % 3], motion[(least + 2) % 3]
    first = np.zeros(3)  # the vector product with the axis that is farthest from the motion
    first[(least + 1) % 3], first[(least + 2) % 3] = v, -u
    first /= np.linalg.norm(first)
    second = np.array(
        [
            motion[1] * first[2] - motion[2] * first[1],
            motion[2] * first[0] - motion[0] * first[2],
            motion[0] * first[1] - motion[1] * first[0],
        ]
    )
    steps = spread * np.arange(-2, 3)
    neighbours = motion + steps[:, None, None] * first + steps[:, None] * second
    neighbours = neighbours.reshape(-1, 3)
    return np.asarray(neighbours / np.linalg.norm(neighbours, axis=1, keepdims=True))


@dataclass(frozen=True, slots=True, kw_only=True)
class Patch:
    """A body pressed between the fingers, as one of them touches it.

    Attributes:
        force_n: True normal force [N].
        offset_mm: The body's origin on the pad [mm, gel frame].
        height_mm: Shape (rows, columns) of ``grid_of``, surface of the gel over the sensing area
            [mm].
        pressure_kpa: Same shape.
        peak_kpa: Largest pressure, averaged as ``BRUISE_RADIUS_MM`` says.
        depth_mm: Approach of the body [mm].
    """

    force_n: float
    offset_mm: tuple[float, float]
    height_mm: FloatArray
    pressure_kpa: FloatArray
    peak_kpa: float
    depth_mm: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance:
    """Whether two patches hold a body against a load.

    Attributes:
        margin: Largest factor on the load that friction resists; below 1 the body slides.
        motion: Shape (3,), the motion (x, y [mm], rotation [rad] × 5 mm) in which it would slide.
        excess_n: Load less friction along that motion [N].
        patch_speed: Root mean square speed of the patch in that motion, per unit speed.
    """

    margin: float
    motion: FloatArray
    excess_n: float
    patch_speed: float


@dataclass(slots=True, kw_only=True)
class _Friction:
    """Loaded blocks of a patch about the centre of mass, and their dissipation in ``_MOTIONS``.

    What it resists is kept for each load, (acceleration, share): a held body is asked the same at
    every frame.
    """

    patch: Patch
    force: FloatArray
    x: FloatArray
    y: FloatArray
    push: FloatArray
    dissipated: FloatArray = field(default_factory=lambda: np.zeros(0))
    resisted: dict[tuple[tuple[float, float], float], Resistance] = field(default_factory=dict)

    def slide(self, motions: FloatArray) -> FloatArray:
        """Sum over the blocks of force times sliding speed, for each motion."""
        return np.asarray(np.sqrt(self._squared_speed(motions)) @ self.force)

    def patch_speed(self, motion: FloatArray) -> float:
        """Root mean square speed of the patch in a motion."""
        square = self._squared_speed(motion[None])[0]
        return float(np.sqrt(square @ self.force / self.force.sum()))

    def _squared_speed(self, motions: FloatArray) -> FloatArray:
        spin = motions[:, 2:] / LENGTH_MM
        return np.asarray(
            (motions[:, :1] - spin * self.y) ** 2 + (motions[:, 1:2] + spin * self.x) ** 2
        )


def _find_worst(
    motions: FloatArray, dissipated: FloatArray, load: FloatArray
) -> tuple[float, FloatArray, float]:
    """Margin, motion and excess [N] of the motion, of either sign, with the smallest margin."""
    power = motions @ load
    margins = dissipated / np.maximum(np.abs(power), 1e-12)
    index = int(np.argmin(margins))
    forwards = 1.0 if power[index] >= 0 else -1.0
    excess_n = float(abs(power[index]) - dissipated[index])
    return float(margins[index]), forwards * motions[index], excess_n


class FlatFingers:
    """Solves contact and friction of one body between the two fingers of a sensor's gripper."""

    def __init__(
        self,
        body: Body,
        sensor: SensorSpec,
        material: GelMaterial,
        up: tuple[float, float] = (0.0, 1.0),
    ) -> None:
        self.body, self.up, self.material = body, up, material
        self.sensor = sensor
        self._pitch_mm = sensor.width_mm / COLUMNS
        rows, columns = grid_of(sensor)
        self._x_mm, self._y_mm = grid_axes_mm(sensor, rows, columns)
        self._layer = ElasticLayer(
            material,
            rows=rows,
            columns=columns,
            pitch_mm=self._pitch_mm,
            body_modulus_mpa=body.modulus_mpa,
        )
        self._disc = _disc(BRUISE_RADIUS_MM / self._pitch_mm)
        self._bruise_kpa: float | None = None
        self._friction: _Friction | None = None

    @cached_property
    def shear(self) -> CoarseShear:
        """Friction of gel and body with memory, point by point; made when first asked for."""
        flesh = None
        if math.isfinite(self.body.young_mpa):
            flesh = GelMaterial(
                thickness_mm=math.inf, young_mpa=self.body.young_mpa, poisson=self.body.poisson
            )
        return CoarseShear(self._layer, friction=self.body.friction, body=flesh)

    @property
    def bruise_kpa(self) -> float:
        """Pressure that bruises the body: that of its bruise force at the pad's centre [kPa]."""
        if self._bruise_kpa is None:
            self._bruise_kpa = self.press((0.0, 0.0), self.body.bruise_n).peak_kpa
        return self._bruise_kpa

    def slip_minimum_n(self, accelerations_m_s2: Sequence[tuple[float, float]]) -> float:
        """Smallest true force [N] that holds the body, centred, through all accelerations.

        Accelerations are (sideways, upwards), whichever way the pad is mounted [m/s²].
        Interpolated between eight forces from 0.04 to 16 N, where it nearly is a power law.
        """
        forces = np.geomspace(0.04, 16, 8)
        patches = self.press_many([(0.0, 0.0)] * len(forces), forces.tolist())
        margins = [
            min(self.resistance(patch, self._on_pad(each)).margin for each in accelerations_m_s2)
            for patch in patches
        ]
        return float(np.exp(np.interp(0.0, np.log(margins), np.log(forces))))

    def _on_pad(self, sideways_and_up: tuple[float, float]) -> tuple[float, float]:
        """Components along the pad's x and y."""
        (sideways, upwards), (up_x, up_y) = sideways_and_up, self.up
        return sideways * up_y + upwards * up_x, upwards * up_y - sideways * up_x

    def gap_mm(self, offset_mm: tuple[float, float]) -> FloatArray:
        """Gap between pad and body, over the pad [mm]."""
        return self.body.gap_on(self._x_mm - offset_mm[0], self._y_mm - offset_mm[1])

    def reaches(self, offset_mm: tuple[float, float]) -> bool:
        """Whether closing fingers would touch the body at all."""
        return bool(self.gap_mm(offset_mm).min() < min(self.body.thickness_mm / 2, NO_BODY_MM))

    def press(self, offset_mm: tuple[float, float], force_n: float) -> Patch:
        """Patch of a body at ``offset_mm`` pressed with ``force_n`` [N]."""
        return self.press_many([offset_mm], [force_n])[0]

    @torch_threads()
    def press_many(
        self, offsets_mm: list[tuple[float, float]], forces_n: list[float]
    ) -> list[Patch]:
        """Like ``press`` for several positions and forces in one batch."""
        gaps = np.stack([self.gap_mm(offset) for offset in offsets_mm])
        gaps -= gaps.min(axis=(1, 2), keepdims=True)
        with torch.inference_mode():
            pressed = self._layer.press_to_force(
                torch.as_tensor(gaps, dtype=torch.float32),
                torch.as_tensor(forces_n, dtype=torch.float32),
                tol=_TOLERANCE,
            )
        heights = pressed.height_mm.double().numpy()
        pressures = pressed.pressure_kpa.double().numpy()
        return [
            Patch(
                force_n=force,
                offset_mm=offset,
                height_mm=heights[i],
                pressure_kpa=pressures[i],
                peak_kpa=self._peak_kpa(pressures[i]),
                depth_mm=float(pressed.depth_mm[i]),
            )
            for i, (offset, force) in enumerate(zip(offsets_mm, forces_n, strict=True))
        ]

    def _peak_kpa(self, pressure_kpa: FloatArray) -> float:
        field_ = torch.as_tensor(pressure_kpa)[None, None]
        mean = torch.nn.functional.conv2d(field_, self._disc, padding=self._disc.shape[-1] // 2)
        return float(mean.max())

    def give_mm(self, patch: Patch) -> float:
        """How far gel and flesh give way along the pad under the weight, without any slip [mm].

        Half of the weight moves a circular contact of radius a by Q S / 8a, S = Σ (2 − ν) / G:
        Mindlin's stuck contact of half-spaces (Johnson, Contact Mechanics, 7.2). A gel as thin as
        the contact is wide gives way less.
        """
        area_mm2 = float((patch.pressure_kpa > 0).sum()) * self._pitch_mm**2
        gel, body = self.material, self.body
        compliance = (2 - gel.poisson) * 2 * (1 + gel.poisson) / gel.young_mpa
        compliance += (2 - body.poisson) * 2 * (1 + body.poisson) / body.young_mpa
        half_weight_n = body.mass_kg * GRAVITY_M_S2 / 2
        return half_weight_n * compliance / (8 * math.sqrt(area_mm2 / math.pi))

    def resistance(
        self, patch: Patch, acceleration_m_s2: tuple[float, float], share: float = 1.0
    ) -> Resistance:
        """Whether the patch holds the body while the fingers accelerate.

        The load on either patch is half of weight and inertia, plus the push of slanted pressure: a
        body cut by the pad's edge is squeezed outwards. Motions are taken about the centre of
        mass, so that an off-centre patch must carry the moment by torsion.

        Args:
            patch: Patch of the held body.
            acceleration_m_s2: Acceleration of the fingers along the pad's (x, y).
            share: Fraction of the weight that the fingers carry; a support carries the rest.
        """
        friction = self._friction_of(patch)
        known = friction.resisted.get((acceleration_m_s2, share))
        if known is not None:
            return known
        load = self.load_on(patch, acceleration_m_s2, share)
        margin, motion, excess_n = _find_worst(_MOTIONS, friction.dissipated, load)
        for spread in (0.06, 0.015):  # half the distance of neighbours, then a quarter of that
            near = _neighbours(motion, spread)
            dissipated = self.body.friction * friction.slide(near)
            margin, motion, excess_n = _find_worst(near, dissipated, load)
        speed = friction.patch_speed(motion)
        found = Resistance(margin=margin, motion=motion, excess_n=excess_n, patch_speed=speed)
        friction.resisted[acceleration_m_s2, share] = found
        return found

    def load_on(
        self, patch: Patch, acceleration_m_s2: tuple[float, float], share: float = 1.0
    ) -> FloatArray:
        """Load of one patch: half of weight and inertia, and the push of slanted pressure.

        Arguments are those of ``resistance``.

        Returns:
            Shape (3,) [N]: force on the body along x and y, and moment about its centre of mass
            over ``LENGTH_MM``.
        """
        half_mass = self.body.mass_kg / 2
        load = self.push_on(patch)
        for axis in (0, 1):
            weight = share * GRAVITY_M_S2 * self.up[axis]
            load[axis] -= half_mass * (weight + acceleration_m_s2[axis])
        return load

    def push_on(self, patch: Patch) -> FloatArray:
        """Outward push of a patch's slanted pressure on the body, as ``load_on`` gives it."""
        return self._friction_of(patch).push.copy()

    def _friction_of(self, patch: Patch) -> _Friction:
        """Dissipation of a patch in every motion; cached for the last patch."""
        if self._friction is None or self._friction.patch is not patch:
            force, x, y, push_x, push_y = self._loaded_blocks(patch)
            moment = float((x * push_y - y * push_x).sum()) / LENGTH_MM
            push = np.array([push_x.sum(), push_y.sum(), moment])
            friction = _Friction(patch=patch, force=force, x=x, y=y, push=push)
            friction.dissipated = self.body.friction * friction.slide(_MOTIONS)
            self._friction = friction
        return self._friction

    def _loaded_blocks(self, patch: Patch) -> tuple[FloatArray, ...]:
        """Loaded blocks: force [N], position about the centre of mass [mm], outward push [N].

        Blocks of ``_BLOCK``² elements (0.5 mm) carry the friction of their elements; the moment
        that this leaves out is that of an element about its block's centre, below 0.3 mm.
        """
        force = patch.pressure_kpa * 1e-3 * self._pitch_mm**2
        slope_y, slope_x = np.gradient(patch.height_mm, -self._pitch_mm, self._pitch_mm)
        blocks = [
            _in_blocks(grid)
            for grid in (
                force,
                force * self._x_mm,
                force * self._y_mm[:, None],
                force * slope_x,
                force * slope_y,
            )
        ]
        loaded = blocks[0] > 0
        total, moment_x, moment_y, push_x, push_y = (block[loaded] for block in blocks)
        com_x = patch.offset_mm[0] + self.body.com_mm[0]
        com_y = patch.offset_mm[1] + self.body.com_mm[1]
        return total, moment_x / total - com_x, moment_y / total - com_y, push_x, push_y

    def inertia_kg(self, motion: FloatArray) -> float:
        """Half of the body's mass as seen along a unit motion (one patch carries half) [kg]."""
        gyration = self.body.gyration_mm / LENGTH_MM
        fraction = motion[0] ** 2 + motion[1] ** 2 + (gyration * motion[2]) ** 2
        return float(self.body.mass_kg / 2 * fraction)


def _in_blocks(field_: FloatArray) -> FloatArray:
    rows, columns = (size // _BLOCK for size in field_.shape)
    return np.asarray(field_.reshape(rows, _BLOCK, columns, _BLOCK).sum(axis=(1, 3)))


def _disc(radius_px: float) -> torch.Tensor:
    reach = math.ceil(radius_px)
    rows, columns = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    inside = (rows**2 + columns**2 <= radius_px**2).astype(np.float64)
    return torch.as_tensor(inside / inside.sum())[None, None]
