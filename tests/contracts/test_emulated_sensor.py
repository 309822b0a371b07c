"""The contract of a tactile sensor, run on the drivers without their hardware."""

import pytest
from sensor_contract import SensorContract

from sim.emulators.taxels import TaxelEmulator
from sim.emulators.taxels_ball import PressedBall
from tacgrasp.drivers.taxel_settings import TaxelSettings
from tacgrasp.drivers.taxels import connect_taxels


class TestTaxelArrayOnAPty(SensorContract):
    @pytest.fixture
    def sensor(self, tmp_path):
        emulator = TaxelEmulator(PressedBall(75, 100), link=tmp_path / "array")
        array = connect_taxels(TaxelSettings(port=emulator.port, read_timeout_s=2.0))
        yield array
        array.disconnect()
        emulator.close()
