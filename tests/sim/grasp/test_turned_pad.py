"""A sensor mounted a quarter turn: the same world, in turned coordinates."""

import math

import numpy as np
import pytest

from cltp.tactile.sensors import SENSORS
from primitives.devices import Pose
from sim.gel.layer import gel_of
from sim.grasp.bodies import draw_body
from sim.grasp.devices import START_POSE
from sim.grasp.fingers import FlatFingers
from sim.grasp.rig import build
from sim.grasp.turned_pad import (
    TURNED_PAD_X_IN_TCP,
    TURNED_PAD_Y_IN_TCP,
    TURNED_UP,
    turned,
)

SQUARE = SENSORS["gelstereo"]


def test_the_turned_body_lies_where_the_turned_axes_say():
    body = draw_body("strawberry", np.random.default_rng(3))
    x, y = np.array([2.1]), np.array([4.5])  # in the world: right and up
    on_turned_pad = turned(body).gap_on(y, -x)  # up is +x, right is -y
    assert on_turned_pad[0, 0] == pytest.approx(body.gap_on(x, y)[0, 0], abs=1e-9)
    assert turned(body).com_mm == (body.com_mm[1], -body.com_mm[0])


def test_a_square_pad_resists_the_same_load_however_it_is_mounted():
    body = draw_body("strawberry", np.random.default_rng(3))
    gel = gel_of("gelstereo")
    upright = FlatFingers(body, SQUARE, gel)
    mounted = FlatFingers(turned(body), SQUARE, gel, TURNED_UP)
    accelerations = [(0.0, 2.5), (3.0, 0.0), (-3.0, 0.0)]
    least = upright.slip_minimum_n(accelerations)
    assert mounted.slip_minimum_n(accelerations) == pytest.approx(least, rel=0.02)


def test_lifting_a_body_on_a_turned_pad_loads_its_friction():
    rig = build(
        "strawberry", 3, start_offset_mm=(0, 0), gripper_force_gain=1, noise_level=0, is_turned=True
    )
    assert (rig.pad_x_in_tcp, rig.pad_y_in_tcp) == (TURNED_PAD_X_IN_TCP, TURNED_PAD_Y_IN_TCP)
    rig.gripper.grip(0.02)  # far too little
    position = START_POSE.position_m + np.array([0, 0, 0.05])
    rig.arm.move_to(Pose(position_m=position, rotvec_rad=START_POSE.rotvec_rad))
    assert rig.truth().slipped


def test_moving_towards_the_contact_centres_it_on_a_turned_pad():
    rig = build("strawberry", 3, start_offset_mm=(5.0, -4.0), noise_level=0, is_turned=True)
    # the pad's +x is up, its -y is right
    position = START_POSE.position_m + np.array([0.004, 0, 0.005])
    rig.arm.move_to(Pose(position_m=position, rotvec_rad=START_POSE.rotvec_rad))
    assert rig.truth().offset_mm == pytest.approx((0.0, 0.0), abs=1e-9)
    assert math.isclose(rig.truth().force_n, 0.0)
