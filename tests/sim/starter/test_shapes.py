"""Indenters and textures: sizes by hand, limits of the vocabulary."""

import math

import numpy as np
import pytest

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import Shape, Texture
from sim.gel.gap import NO_BODY_MM
from sim.grasp.bodies import draw_body
from sim.starter.outlines import arc, circle, convex, rectangle, segment
from sim.starter.series import curvature_ratio
from sim.starter.shapes import Indenter, IndenterPose, draw_indenter, gap_mm, relief_mm

MINI = sensor_named("gelsight_mini")
X, Y = np.meshgrid(*grid_axes_mm(MINI, 75, 100))
PITCH = MINI.width_mm / 100


def at(*points):
    u, v = np.array(points, dtype=float).T
    return u, v


def test_outlines_measure_distances_that_a_ruler_would():
    assert rectangle(*at((0, 0), (3, 0), (5, 6)), 2, 3).tolist() == [-2, 1, math.hypot(3, 3)]
    assert circle(*at((3, 4)), 2).tolist() == [3]
    assert segment(*at((0, 1), (5, 4), (-3, -4)), (0, 0), (2, 0)).tolist() == [1, 5, 5]
    square = [(1, -1), (1, 1), (-1, 1), (-1, -1)]
    assert convex(*at((0, 0), (3, 0)), square).tolist() == [-1, 2]
    half_circle = arc(*at((2, 0), (0, 3), (-2, 2)), 2, math.pi / 2)
    assert half_circle == pytest.approx([0, 1, 2])


@pytest.mark.parametrize("shape", list(Shape))
def test_every_shape_has_a_tip_and_nothing_before_it(shape):
    for seed in range(10):
        rng = np.random.default_rng(seed)
        indenter = draw_indenter(shape, rng)
        pose = IndenterPose(x_mm=3.0, y_mm=-2.0, turn_rad=rng.uniform(0, 6))
        gap = gap_mm(indenter, pose, X, Y)
        assert gap.shape == X.shape
        assert np.isfinite(gap).all()
        assert gap.min() == 0


def test_the_same_seed_draws_the_same_indenter():
    first, again, other = (
        draw_indenter(Shape.DOTS, np.random.default_rng(seed)).behind_mm(X, Y) for seed in (1, 1, 2)
    )
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def along_and_across(shape, seed, step=0.05):
    behind = draw_indenter(shape, np.random.default_rng(seed)).behind_mm
    return behind(*at((step, 0), (0, step)))


@pytest.mark.parametrize("seed", range(40))
def test_spheres_and_ellipsoids_differ_by_the_ratio_of_their_curvatures(seed):
    # behind = curvature * step² / 2 near the tip
    for shape, low, high in ((Shape.SPHERE, 1, 1.4), (Shape.ELLIPSOID, 1.4, 4.01)):
        along, across = along_and_across(shape, seed)
        ratio = max(along, across) / min(along, across)
        assert low - 1e-6 <= ratio < high


@pytest.mark.parametrize("seed", range(20))
def test_bars_are_at_most_a_millimetre_and_a_half_wide(seed):
    v = np.linspace(-2, 2, 401)
    behind = draw_indenter(Shape.LINE, np.random.default_rng(seed)).behind_mm
    wide = (behind(np.zeros_like(v), v) < NO_BODY_MM).sum() * 0.01
    assert 0.4 <= wide <= 1.51


@pytest.mark.parametrize("seed", range(20))
def test_peaks_have_half_angles_between_20_and_60_degrees(seed):
    behind = draw_indenter(Shape.PEAK, np.random.default_rng(seed)).behind_mm
    r, step = 3.0, 0.01
    inner, outer = behind(*at((r, 0), (r + step, 0)))
    half_angle = math.degrees(math.atan2(step, outer - inner))
    assert 19.9 <= half_angle <= 60.5


def test_a_pose_turns_shifts_and_tilts():
    bar = Indenter(
        shape=Shape.LINE,
        behind_mm=lambda u, v: np.where((np.abs(u) < 3) & (np.abs(v) < 0.5), 0.0, NO_BODY_MM),
        max_tilt_rad=0.0,
        textured=False,
    )
    upright = gap_mm(bar, IndenterPose(x_mm=5, y_mm=1, turn_rad=math.pi / 2), X, Y)
    covered = upright < NO_BODY_MM
    assert X[covered].mean() == pytest.approx(5, abs=PITCH)
    assert Y[covered].mean() == pytest.approx(1, abs=PITCH)
    assert np.ptp(Y[covered]) == pytest.approx(6, abs=2 * PITCH)
    assert np.ptp(X[covered]) == pytest.approx(1, abs=2 * PITCH)
    tilted = gap_mm(bar, IndenterPose(x_mm=0, y_mm=0, slope_x=0.1), X, Y)
    covered = tilted < NO_BODY_MM
    assert tilted[covered].max() == pytest.approx(0.1 * 6, abs=0.1 * 2 * PITCH)
    assert X.ravel()[tilted.argmin()] == pytest.approx(-3, abs=PITCH)


def test_an_indenter_beside_the_pad_is_refused_by_name():
    disc = draw_indenter(Shape.DISC, np.random.default_rng(0))
    with pytest.raises(ValueError, match=r"disc at \(40.0, 0.0\) mm"):
        gap_mm(disc, IndenterPose(x_mm=40, y_mm=0), X, Y)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("texture", list(Texture))
def test_textures_have_the_heights_of_the_vocabulary(texture, seed):
    relief = relief_mm(texture, np.random.default_rng(seed), X, Y, MINI)
    assert relief.shape == X.shape
    if texture is Texture.SMOOTH:
        assert np.ptp(relief) == 0
    elif texture is Texture.ROUGH:
        assert 0.024 <= relief.std() <= 0.085
    else:
        assert 0.04 <= np.ptp(relief) <= 0.2


def variation(relief, angle, pitch=0.05):
    """Mean square slope along a direction."""
    gy, gx = np.gradient(relief, -pitch, pitch)
    return float(((gx * math.cos(angle) + gy * math.sin(angle)) ** 2).mean())


def test_ridges_run_in_one_direction_and_weaves_in_two():
    x, y = np.meshgrid(np.arange(200) * 0.05, -np.arange(200) * 0.05)
    angles = np.linspace(0, math.pi, 90, endpoint=False)
    for texture, smallest in ((Texture.RIDGED, 0.01), (Texture.WOVEN, 0.9)):
        relief = relief_mm(texture, np.random.default_rng(3), x, y, MINI)
        slopes = np.array([variation(relief, angle) for angle in angles])
        quarter = np.roll(slopes, 45)[slopes.argmax()]
        assert quarter / slopes.max() == pytest.approx(
            smallest, abs=0.35 if smallest > 0.5 else 0.02
        )


def test_curvature_of_a_body_is_found_through_its_achenes():
    # A peg is straight along its axis; an egg 1.22-1.38 times as long as wide has a ratio of
    # curvatures of about that squared.
    assert curvature_ratio(draw_body("peg", np.random.default_rng(0))) > 20
    egg = curvature_ratio(draw_body("egg", np.random.default_rng(0)))
    assert 1.3 < egg < 2.1
    for seed in range(3):
        berry = draw_body("strawberry", np.random.default_rng(seed))
        assert 1.0 <= curvature_ratio(berry) < 3.0
