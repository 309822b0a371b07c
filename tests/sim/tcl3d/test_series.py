"""Series of TCL3D: alike in any company, as many as announced, splits that don't mix."""

import math
from collections import Counter

import numpy as np
import pytest

from cltp.data.contact import Split, pack_heights
from cltp.tactile.sensors import SENSORS
from sim.objects.catalogue import CATALOGUE, UNSEEN, object_named
from sim.objects.ray_casting import frame_at, random_surface_point, support_point
from sim.tcl3d import series as tcl3d
from sim.tcl3d.poses import CONE_DEG, draw_pose, surface_pose

GEL = SENSORS["gelsight_mini"]


def test_the_numbers_of_the_paper_come_out():
    numbers = tcl3d.series_numbers(tcl3d.ALL_CONTACTS)
    assert len(set(numbers)) == len(numbers)
    main = [n for n in numbers if n < tcl3d.GELSTEREO_FIRST]
    assert sum(map(tcl3d.num_loads, main)) == 50_860
    assert sum(map(tcl3d.num_loads, numbers)) == 50_860 + 1_450 + 115
    counts = Counter(n % len(CATALOGUE) for n in main)
    assert len(counts) == 117
    assert all(400 <= 4 * count <= 500 for count in counts.values())


def test_no_split_shares_a_series_and_unseen_objects_stay_unseen():
    requests = [tcl3d.series_request(0, number) for number in range(3000)]
    for request in requests:
        assert (request.obj.name in UNSEEN) == (request.split is Split.OBJECT)
        assert (request.gel in tcl3d.OTHER_GELS) == (request.split is Split.PHYSICS)
    assert not set(tcl3d.GELS) & set(tcl3d.OTHER_GELS)
    shares = Counter(request.split for request in requests)
    assert shares[Split.TRAIN] > 0.6 * 3000
    assert min(shares[s] for s in (Split.TEST, Split.VALIDATION, Split.PHYSICS)) > 0.02 * 3000
    assert tcl3d.series_request(0, tcl3d.GELSTEREO_FIRST).sensor.name == "gelstereo"
    assert tcl3d.series_request(0, tcl3d.GELSIGHT_FIRST).split is Split.GELSIGHT


def test_a_series_is_the_same_whatever_is_made_beside_it():
    single = tcl3d.make_series(1, 21)
    tcl3d.make_series(1, 40)
    tcl3d.make_series(2, 21)
    again = tcl3d.make_series(1, 21)
    assert [pack_heights(c.height_mm) for c in single] == [pack_heights(c.height_mm) for c in again]
    assert [c.state for c in single] == [c.state for c in again]
    assert [c.unsure for c in single] == [c.unsure for c in again]


def test_the_elements_of_every_sensor_s_grid_are_squares_of_a_fifth_of_a_millimetre():
    assert tcl3d.grid_over(GEL) == (tcl3d.ROWS, tcl3d.COLUMNS)
    for sensor in SENSORS.values():
        rows, columns = tcl3d.grid_over(sensor)
        assert sensor.width_mm / columns == pytest.approx(sensor.height_mm / rows, rel=1e-3)
        assert sensor.width_mm / columns == pytest.approx(0.203, abs=0.002)


def test_force_and_depth_rise_along_a_series():
    contacts = tcl3d.make_series(0, 20)
    assert len(contacts) == tcl3d.LOADS
    depths = [contact.state.depth_mm for contact in contacts]
    forces = [contact.state.force_n for contact in contacts]
    assert depths == sorted(depths)
    assert forces == sorted(forces)
    assert len({contact.state.depth for contact in contacts}) == 4
    assert all(c.peak_kpa and c.approach_mm and c.approach_mm > 0 for c in contacts)


def test_large_objects_are_approached_within_15_degrees_of_where_they_are_met():
    obj = object_named("marble_25")
    rng = np.random.default_rng(0)
    steepest = 0.0
    for _ in range(20):
        contact = random_surface_point(obj, rng)
        assert np.linalg.norm(contact.point) == pytest.approx(12.5, abs=0.01)
        assert contact.normal @ contact.point == pytest.approx(12.5, abs=0.01)
        pose = surface_pose(obj, contact, rng, GEL, 0.2, textured=False)
        angle = math.degrees(math.acos(min(1.0, pose.object_from_pad[:, 2] @ contact.normal)))
        assert angle <= CONE_DEG + 1e-6
        steepest = max(steepest, angle)
    assert steepest > 8


def test_a_pose_is_a_rotation():
    rng = np.random.default_rng(1)
    for name in ("cracker_box", "peg_hexagon_9", "cone_30", "banana"):
        turn = draw_pose(object_named(name), rng, GEL, 0.2).object_from_pad
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-9)
        assert np.linalg.det(turn) == pytest.approx(1)


def test_a_flat_face_hardly_leans():
    obj = object_named("cracker_box")
    rng = np.random.default_rng(2)
    flat = [pose for pose in (draw_pose(obj, rng, GEL, 0.1) for _ in range(30)) if pose.flat]
    assert flat
    for pose in flat:
        assert np.abs(pose.object_from_pad[:, 2]).max() > math.cos(math.radians(1))


def test_what_is_turned_at_random_touches_with_its_lowest_point():
    obj = object_named("peg_square_8")
    towards = np.array([1.0, 1.0, 1.0]) / math.sqrt(3)
    contact = support_point(obj, towards)
    np.testing.assert_allclose(contact.point, [4, 4, 0], atol=0.25)  # its fillet is 0.25 mm
    np.testing.assert_allclose(frame_at(towards)[:, 2], towards)


@pytest.mark.slow
def test_no_class_is_rare_in_a_sample():
    contacts = [c for number in range(351) for c in tcl3d.make_series(4, number)]
    for slot, classes in (
        ("shape", 19),
        ("texture", 5),
        ("depth", 4),
        ("position", 9),
        ("area", 5),
    ):
        counts = Counter(getattr(contact.state, slot) for contact in contacts)
        assert len(counts) == classes
        assert min(counts.values()) > 0.01 * len(contacts), (slot, counts)
    assert sum(bool(c.unsure) for c in contacts) < 0.12 * len(contacts)
