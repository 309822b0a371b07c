"""The contract of a tactile sensor, run on the drivers without their hardware."""

import numpy as np
import pytest
from PIL import Image

from sim.emulators.taxels.array import TaxelEmulator
from sim.emulators.taxels.ball import PressedBall
from tacgrasp.drivers.gelsight.connect import connect_gelsight
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.drivers.recorded.sensor import connect_recorded
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.taxels.connect import connect_taxels
from tacgrasp.drivers.taxels.settings import TaxelSettings
from tacgrasp.testing import SensorContract


class TiltedGel:
    """An untouched gel with a tilt of 0.3 mm and 5 µm of noise; a ``HeightSource``."""

    def __init__(self, rows, columns):
        self._tilt_mm = np.linspace(-0.15, 0.15, columns) * np.ones((rows, 1))
        self._rng = np.random.default_rng(0)

    def height_mm(self):
        noise_mm = self._rng.normal(0, 0.005, self._tilt_mm.shape)
        return (self._tilt_mm + noise_mm).astype(np.float32)


class TestTaxelArrayOnAPty(SensorContract):
    @staticmethod
    def connected(source, link):
        emulator = TaxelEmulator(source, link=link)
        array = connect_taxels(TaxelSettings(port=emulator.port, read_timeout_s=2.0))
        yield array
        array.disconnect()
        emulator.close()

    @pytest.fixture
    def sensor(self, tmp_path):
        yield from self.connected(PressedBall(75, 100), tmp_path / "array")

    @pytest.fixture
    def untouched_sensor(self, tmp_path):
        yield from self.connected(TiltedGel(75, 100), tmp_path / "untouched")


@pytest.fixture(scope="module")
def images(tmp_path_factory):
    """Four noisy frames of an untouched gel, and one without noise."""
    folder = tmp_path_factory.mktemp("images")
    rng = np.random.default_rng(0)
    grey = np.full((240, 320, 3), 110, dtype=np.uint8)
    Image.fromarray(grey).save(folder / "background.png")
    for number in range(4):
        noise = rng.integers(-2, 3, grey.shape)
        Image.fromarray((grey + noise).astype(np.uint8)).save(folder / f"frame_{number}.png")
    return folder


class TestGelSightImagesOneARead(SensorContract):
    @pytest.fixture
    def sensor(self, images):
        return connect_gelsight(
            GelSightSettings(images=images, background=images / "background.png", unit="any")
        )


class TestGelSightImagesLikeACamera(SensorContract):
    @pytest.fixture
    def sensor(self, images):
        gelsight = connect_gelsight(
            GelSightSettings(
                images=images,
                background=images / "background.png",
                unit="any",
                play_hz=30,
                repeat=True,
                read_timeout_s=2.0,
            )
        )
        yield gelsight
        gelsight.disconnect()


class TestRecordedFrames(SensorContract):
    @pytest.fixture
    def sensor(self, images):
        return connect_recorded(RecordedSettings(path=images))
