import numpy as np
import pytest

from cltp.tactile.sensors import SENSORS, sensor_named
from cltp.tactile.states import Shape, Texture, area_word, depth_word, position_word
from sim.independent.contacts import SHALLOW_MM, make_contact
from sim.independent.faces import TRIANGLES, triangle_angles

MINI = sensor_named("gelsight_mini")


@pytest.fixture(scope="module")
def contacts():
    return [make_contact(seed, MINI) for seed in range(4 * len(Shape))]


def test_every_shape_comes_as_often(contacts):
    shapes = [contact.state.shape for contact in contacts]
    assert all(shapes.count(shape) == 4 for shape in Shape)


def test_every_texture_comes(contacts):
    assert {contact.state.texture for contact in contacts} == set(Texture)


def test_the_same_seed_gives_the_same_bytes_and_another_one_others():
    first, again, other = (make_contact(seed, MINI) for seed in (16, 16, 35))
    assert first.height_mm.tobytes() == again.height_mm.tobytes()
    assert first.state == again.state
    assert first.height_mm.tobytes() != other.height_mm.tobytes()


def test_words_follow_from_the_numbers_and_the_depth_from_the_heights(contacts):
    for contact in contacts:
        state = contact.state
        assert state.depth_mm == pytest.approx(contact.height_mm.max())
        assert state.depth_mm == pytest.approx(contact.approach_mm, abs=1e-4)
        assert state.depth is depth_word(state.depth_mm)
        assert state.area is area_word(state.area_fraction)
        assert state.position is position_word(state.x_mm, state.y_mm, MINI)


def test_small_shallow_and_cut_contacts_are_what_they_are_called(contacts):
    kinds = {"small", "shallow", "cut", "ordinary"}
    assert {contact.object.rsplit(", ", 1)[1] for contact in contacts} == kinds
    for contact in contacts:
        if contact.object.endswith("small"):
            assert contact.state.area_fraction <= 0.05
        if contact.object.endswith("cut"):
            assert contact.state.cut
    shallow = [c for c in contacts if c.object.endswith("shallow") and c.state.depth_mm < 0.15]
    assert shallow
    assert min(c.state.depth_mm for c in contacts) >= SHALLOW_MM[0]


@pytest.mark.parametrize("kind", TRIANGLES)
def test_triangles_have_the_angles_of_their_kind(kind):
    rng = np.random.default_rng(0)
    for _ in range(50):
        angles = triangle_angles(kind, rng)
        degrees = sorted(np.degrees([*angles, np.pi - sum(angles)]))
        assert degrees[0] > 14
        assert (degrees[2] > 100) == (kind == "obtuse")
        assert (degrees[0] < 30) == (kind == "slender" or (kind == "obtuse" and degrees[0] < 30))


def test_points_are_square_on_every_sensor():
    for sensor in SENSORS.values():
        rows, columns = make_contact(2, sensor).height_mm.shape
        assert sensor.height_mm / rows == pytest.approx(sensor.width_mm / columns)


def test_a_negative_seed_is_refused():
    with pytest.raises(ValueError, match="0 or more"):
        make_contact(-1, MINI)
