"""A simulated episode: the devices around one drawn body, and the truth of their world.

Benchmarks and records read the truth from ``SimRig.truth``; a policy never does.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cltp.sensing.force_calibration import ForceCalibration
from cltp.tactile.noise_levels import NoiseLevels
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear.noise import ShearUnit
from primitives.devices import Pose
from primitives.errors import RobotError
from sim.gel.layer import GelMaterial, gel_of
from sim.grasp.bodies import OBJECTS, Body, Range, draw_body
from sim.grasp.devices import (
    PAD_X_IN_TCP,
    PAD_Y_IN_TCP,
    START_POSE,
    SimArm,
    SimClock,
    SimGripper,
    SimSensor,
)
from sim.grasp.fingers import FlatFingers
from sim.grasp.force_calibration import SCATTER, drawn_force_calibration
from sim.grasp.mesh_bodies import ScannedObject, body_from_mesh
from sim.grasp.pad_shear import PadShear
from sim.grasp.turned_pad import (
    TURNED_PAD_X_IN_TCP,
    TURNED_PAD_Y_IN_TCP,
    TURNED_UP,
    UPRIGHT_UP,
    turned,
)
from sim.grasp.world import Grasp

BENCHMARK_SEED = 1_000_000
"""First seed of the benchmark. Its seeds draw from all of every range; smaller ones are for
training and tuning and draw from the 10-90 % quantiles."""

OFFSET_X_MM = Range(low=-11.0, high=11.0)
OFFSET_Y_MM = Range(low=-8.5, high=8.5)
GRIPPER_FORCE_GAIN = Range(low=0.5, high=2.0, log=True)

FINE_PART = Range(low=0.05, high=1.0, log=True)
"""Fine noise of a unit over that of ``cltp.tactile.sensor_noise``, drawn: from 0.5 µm, near the 0.2
µm of the one that was measured, to 10 µm."""

FIRST_TOUCH_N = 1.0
"""Largest commanded force until something is felt [N]: 0.5 N of the weakest gripper. A contact that
the pad's edge cuts is felt from 0.4 N on; others of stronger grippers long before."""


PROGRAMME_M_S2 = ((0.0, 2.5), (10.0, 0.0), (-10.0, 0.0))
"""Accelerations that a body must be held through, (sideways, upwards) [m/s²]: those of the
verification, ``tacgrasp.config.schema.VerifyConfig``; setting down asks for no more than lifting.
"""

MOST_DRAWS = 1000
"""Bodies of one seed after which the draw is given up."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Truth:
    """True state of a simulated world, for records and benchmarks.

    Attributes:
        held: The body, lifted or not, is between the fingers and has slipped less than 1 mm.
        slipped: It slid (or turned, at the patch) by 1 mm or more.
        slip_mm: Its slip [mm].
        dropped: It is no longer between the fingers.
        bruised_at_start: The first grip exceeded its pressure limit.
        bruised: A later action exceeded it.
        peak_force_n: Largest true force so far [N].
        peak_kpa: Largest (averaged) pressure so far [kPa].
        force_n: True force now [N], 0 when nothing is held.
        offset_mm: Position of the body's origin on the pad [mm, gel frame].
        gripper_force_gain: Ratio of true to commanded force.
        mass_g, friction, young_mpa, bruise_n: Properties of the body.
    """

    held: bool
    slipped: bool
    slip_mm: float
    dropped: bool
    bruised_at_start: bool
    bruised: bool
    peak_force_n: float
    peak_kpa: float
    force_n: float
    offset_mm: tuple[float, float]
    gripper_force_gain: float
    mass_g: float
    friction: float
    young_mpa: float
    bruise_n: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SimRig:
    """The devices of one simulated episode, and its start.

    Attributes:
        arm, gripper, sensor, clock: The devices, at the start pose, open.
        grasp: The world behind them; for the oracle and the benchmark only.
        start_pose: Pose of the first grasp.
        force_calibration: The sensor's, drawn.
        first_force_n: Largest commanded force until something is felt [N].
        force_step_n: Least change of the commanded force [N]; the simulated gripper makes any.
        pad_x_in_tcp, pad_y_in_tcp: The pad's axes in the TCP frame, unit vectors.
    """

    arm: SimArm
    gripper: SimGripper
    sensor: SimSensor
    clock: SimClock
    grasp: Grasp
    start_pose: Pose
    force_calibration: ForceCalibration
    first_force_n: float
    force_step_n: float = 0.0
    pad_x_in_tcp: tuple[float, float, float] = PAD_X_IN_TCP
    pad_y_in_tcp: tuple[float, float, float] = PAD_Y_IN_TCP

    def truth(self) -> Truth:
        """True state of the world, never for a policy."""
        grasp, body = self.grasp, self.grasp.fingers.body
        return Truth(
            held=grasp.patch is not None and not grasp.slipped and not grasp.dropped,
            slipped=grasp.slipped,
            slip_mm=grasp.slip_mm,
            dropped=grasp.dropped,
            bruised_at_start=grasp.bruised_at_start,
            bruised=grasp.bruised,
            peak_force_n=grasp.peak_force_n,
            peak_kpa=grasp.peak_kpa,
            force_n=grasp.patch.force_n if grasp.patch else 0.0,
            offset_mm=grasp.offset_mm,
            gripper_force_gain=self.gripper.force_gain,
            mass_g=1000 * body.mass_kg,
            friction=body.friction,
            young_mpa=body.young_mpa,
            bruise_n=body.bruise_n,
        )

    def expect_untouched(self) -> None:
        """Nothing to check: a simulated gel is untouched until the first grasp."""

    def commands(self) -> tuple[()]:
        """No commands: the simulated devices log none."""
        return ()

    def disconnect(self) -> None:
        for device in (self.arm, self.gripper, self.sensor):
            device.disconnect()


def draw_holdable(name: str, rng: np.random.Generator, tails: float = 0.0) -> tuple[Body, int]:
    """Draw a body of a known kind, anew while it bruises at too little more than it slips at.

    Of most kinds the first one passes; a fruit whose own bruise force is drawn may not.

    Args:
        name: A key of ``sim.grasp.bodies.OBJECTS``.
        rng: Random generator.
        tails: As for ``sim.grasp.bodies.draw_body``.

    Returns:
        The body, and how many were drawn before it.

    Raises:
        ValueError: Unknown kind, or none of many could be held.
    """
    for num_redrawn in range(MOST_DRAWS):
        body = draw_body(name, rng, tails)
        least = OBJECTS[name].bruise_over_own_slip
        if least <= 0 or body.bruise_n >= least * slip_minimum_n(body):
            return body, num_redrawn
    raise ValueError(f"none of {MOST_DRAWS} drawn bodies of kind {name!r} could be held")


def slip_minimum_n(body: Body) -> float:
    """Least true force that holds a centred body through the whole programme [N]."""
    name = "gelsight_mini"  # the gels of all sensors are the same
    fingers = FlatFingers(body, sensor_named(name), gel_of(name))
    return fingers.slip_minimum_n(PROGRAMME_M_S2)


def world_of(seed: int) -> tuple[np.random.Generator, float]:
    """Random generator that draws a seed's body and what follows, and ``draw_body``'s ``tails``."""
    return np.random.default_rng([seed, 0]), 0.0 if seed >= BENCHMARK_SEED else 0.1


def build(
    object_name: str,
    seed: int,
    *,
    mesh: ScannedObject | None = None,
    sensor_name: str = "gelsight_mini",
    start_offset_mm: tuple[float, float] | None = None,
    first_force_n: float | None = None,
    gripper_force_gain: float | None = None,
    noise_level: float | NoiseLevels = 1.0,
    gel: GelMaterial | None = None,
    is_turned: bool = False,
) -> SimRig:
    """Draw an episode: a body, its position on the pad, a gripper force gain, a sensor unit.

    Args:
        object_name: A key of ``sim.grasp.bodies.OBJECTS``.
        seed: Random seed of the body, its position, the gripper and the sensor; below
        ``BENCHMARK_SEED`` from the 10-90 % quantiles.
        mesh: Grasp this mesh instead of the drawn body, with the drawn body's friction and, where
            the mesh has none of its own, its stiffness and bruise force.
        sensor_name: A key of ``cltp.tactile.sensors.SENSORS``.
        start_offset_mm: Position of the body on the pad at the start, instead of the draw [mm].
        first_force_n: Largest commanded force until something is felt, instead of
            ``FIRST_TOUCH_N`` [N].
        gripper_force_gain: Ratio of true to commanded force, instead of the draw.
        noise_level: 1 is the noise of units as they differ, 0 a perfect one; or a level for each
            error, taken as it is.
        gel: Gel of both fingers; None for the sensor's nominal one. Its force calibration is drawn
            around its own stiffness.
        is_turned: Whether the sensor is mounted a quarter turn (``sim.grasp.turned_pad``). The
            position of the body is drawn on the pad as ever.

    Raises:
        RobotError: The object is unknown.
        TouchError: The sensor is unknown, or the mesh can't be grasped.
    """
    if object_name not in OBJECTS:
        raise RobotError(f"unknown object {object_name!r}; known: {', '.join(OBJECTS)}")
    (world_rng, tails), sensor_rng = world_of(seed), np.random.default_rng([seed, 1])
    sensor = sensor_named(sensor_name)
    body, _ = draw_holdable(object_name, world_rng, tails)
    if mesh is not None:
        pad_mm = (sensor.width_mm, sensor.height_mm)
        body = body_from_mesh(mesh, body, pad_mm[::-1] if is_turned else pad_mm)
    u = tails + (1 - 2 * tails) * world_rng.random(4)
    offset = start_offset_mm or (OFFSET_X_MM.quantile(u[0]), OFFSET_Y_MM.quantile(u[1]))
    force_gain = gripper_force_gain or GRIPPER_FORCE_GAIN.quantile(u[2])
    up = TURNED_UP if is_turned else UPRIGHT_UP
    body = turned(body) if is_turned else body
    fingers = FlatFingers(body, sensor, gel or gel_of(sensor_name), up)
    measures_shear = sensor.shear_grid is not None
    pad_shear = PadShear(fingers) if measures_shear else None
    grasp = Grasp(fingers=fingers, body_xy_mm=offset, shear=pad_shear)
    clock = SimClock()
    clock.attach(grasp)
    levels = NoiseLevels.of(noise_level)
    if not isinstance(noise_level, NoiseLevels):
        part = FINE_PART.quantile(np.random.default_rng([seed, 7]).random())
        levels = replace(levels, fine=part * levels.fine)
    noise = NoiseUnit.draw(sensor_rng, levels, spread=spread_of(sensor))
    shear_unit = None
    if measures_shear:
        shear_rng, level = np.random.default_rng([seed, 8]), NoiseLevels.of(noise_level).fine
        shear_unit = ShearUnit.draw(shear_rng, sensor, level)
    calibration = drawn_force_calibration(
        sensor_name, seed, gel=gel, scatter=0.0 if levels == NoiseLevels.of(0) else SCATTER
    )
    pad_x = TURNED_PAD_X_IN_TCP if is_turned else PAD_X_IN_TCP
    pad_y = TURNED_PAD_Y_IN_TCP if is_turned else PAD_Y_IN_TCP
    return SimRig(
        arm=SimArm(grasp, clock, pad_x, pad_y),
        gripper=SimGripper(grasp, clock, force_gain),
        sensor=SimSensor(
            grasp,
            clock,
            sensor,
            noise,
            seed,
            drift_level=levels.drift,
            force_scale=calibration.scale,
            shear_unit=shear_unit,
        ),
        clock=clock,
        grasp=grasp,
        start_pose=START_POSE,
        force_calibration=calibration,
        first_force_n=first_force_n or FIRST_TOUCH_N,
        pad_x_in_tcp=pad_x,
        pad_y_in_tcp=pad_y,
    )
