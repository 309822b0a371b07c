"""Presses of a ball of 6 mm into our elastic layer, seen under three lamps."""

import numpy as np
import pytest
from PIL import Image

from cltp.sensing.ball_presses import BallPress, slopes_of
from cltp.tactile.sensors import SENSORS
from tacgrasp.bringup.ball_profiles import ball_profiles

SENSOR = SENSORS["gelsight_mini"]
BACKGROUND = np.full((240, 320, 3), 120, dtype=np.uint8)
LAMPS = np.array([[80.0, 0.0], [-35.0, 60.0], [-45.0, -70.0]])


@pytest.fixture(scope="session")
def profiles():
    return ball_profiles("gelsight_mini", 6.0)


@pytest.fixture(scope="session")
def folder(profiles, tmp_path_factory):
    """Twelve presses and their background, each a file."""
    path = tmp_path_factory.mktemp("balls")
    row, column = (a.ravel().astype(float) for a in np.mgrid[0:240, 0:320])
    rng = np.random.default_rng(0)
    for index in range(12):
        press = BallPress(
            column=rng.uniform(60, 260), row=rng.uniform(60, 180), depth_mm=rng.uniform(0.5, 1)
        )
        slopes = slopes_of(press, profiles, column, row, SENSOR.mm_per_px)
        change = (slopes @ LAMPS.T).reshape(240, 320, 3)
        frame = (BACKGROUND + np.rint(change)).clip(0, 255).astype(np.uint8)
        Image.fromarray(frame).save(path / f"ball_{index}.png")
    Image.fromarray(BACKGROUND).save(path / "background.png")
    return path
