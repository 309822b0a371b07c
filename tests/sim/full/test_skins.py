"""Skins: drawn anew for each series, within the limits of the textures, and shown by the press."""

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import Texture
from sim.full.drawn.surface import Draws
from sim.full.scene import pad_grid
from sim.full.skins import RELIEF_OF_DEPTH, draw_skin

SENSOR = sensor_named("gelsight_mini")
GRID = pad_grid(SENSOR)


def skins(count, lightest_mm=0.3, **options):
    for seed in range(count):
        draws = Draws(np.random.default_rng(seed), lightest_mm=lightest_mm, small=False, scale=1.0)
        yield draw_skin(draws, GRID, SENSOR, **{"textured": True, **options})


def test_every_texture_occurs_and_no_two_skins_are_alike():
    drawn = list(skins(120))
    assert {skin.texture for skin in drawn} == set(Texture)
    textured = [skin for skin in drawn if skin.texture is not Texture.SMOOTH]
    assert len({skin.behind_mm.tobytes() for skin in textured}) == len(textured)


def test_a_relief_keeps_to_the_limits_of_its_class():
    for skin in skins(120):
        relief, pitch = skin.behind_mm, skin.pitch_mm
        if skin.texture is Texture.ROUGH:
            assert 0.025 < relief.std() < 0.085
            assert 0.3 <= pitch <= 0.6
        elif skin.texture is not Texture.SMOOTH:
            assert relief.min() >= -1e-9
            assert 0.045 < np.ptp(relief) <= 0.2 + 1e-9 or skin.texture is Texture.WOVEN
            low, high = (1.0, 3.0) if skin.texture is Texture.BUMPY else (0.6, 1.5)
            assert low <= pitch <= high


@pytest.mark.parametrize("lightest_mm", [0.08, 0.12, 0.2])
def test_a_light_press_meets_a_low_relief(lightest_mm):
    drawn = list(skins(60, lightest_mm))
    assert max(np.ptp(skin.behind_mm) for skin in drawn if skin.texture is not Texture.ROUGH) <= (
        RELIEF_OF_DEPTH * lightest_mm + 1e-9
    )


def test_a_press_too_light_for_any_relief_meets_smooth_surface():
    assert {skin.texture for skin in skins(20, 0.04)} == {Texture.SMOOTH}
    assert {skin.texture for skin in skins(20, textured=False)} == {Texture.SMOOTH}
