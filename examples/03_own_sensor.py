"""A sensor of one's own: four methods that give clouds; contact and force are then felt with it.

    python examples/03_own_sensor.py

To use it in a rig's file, give it ``check_alive``, ``expect_untouched`` and ``counts`` too, and an
entry point ``tacgrasp.sensors``: see examples/plugin.
"""

import time

import numpy as np

from cltp import TouchError
from cltp.tactile.cloud import Stamp, TactileCloud, cloud_of_pixels, grid_axes_mm
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec, sensor_named
from tacgrasp.rig.gel_sense import GelSense


class BallSensor:
    """A pretended GelSight Mini with a ball over its gel; ``press_mm`` pushes the ball in."""

    def __init__(self) -> None:
        self.press_mm = 0.0
        self._rng = np.random.default_rng(0)
        self._reference_mm = np.zeros((48, 64))
        self._is_connected = True

    @property
    def spec(self) -> SensorSpec:
        """Size and name of the sensor; a new one goes into cltp/tactile/sensors.py."""
        return sensor_named("gelsight_mini")

    def read(self, frames: int = 1) -> TactileCloud:
        """The mean of new frames; a real driver never returns an old one."""
        mean_mm = np.mean([self._frame_mm() for _ in range(frames)], axis=0)
        stamp = Stamp(monotonic_s=time.monotonic(), wall_s=time.time())
        return cloud_of_pixels(mean_mm - self._reference_mm, self.spec, stamp=stamp)

    def take_reference(self) -> None:
        """Take the gel as it is as untouched: later frames are relative to it."""
        self._reference_mm = np.mean([self._frame_mm() for _ in range(5)], axis=0)

    def disconnect(self) -> None:
        """Free the device; reading afterwards is an error."""
        self._is_connected = False

    def _frame_mm(self) -> np.ndarray:
        """Heights of the gel [mm], row 0 at the top, with a tilt and 3 µm of noise."""
        if not self._is_connected:
            raise TouchError("the sensor is disconnected")
        x, y = np.meshgrid(*grid_axes_mm(self.spec, 48, 64))
        ball_mm = np.clip(self.press_mm - ((x - 3) ** 2 + (y + 2) ** 2) / (2 * 8.0), 0, None)
        return ball_mm + 0.01 * x / 10 + self._rng.normal(0, 0.003, x.shape)


sensor = BallSensor()
sense = GelSense(sensor)
sense.take_reference()
for press_mm in (0.0, 0.05, 0.2, 0.4):
    sensor.press_mm = press_mm
    cloud = sensor.read()
    state = contact_state(cloud, in_contact=sense.in_contact(cloud))
    felt = sense.felt_force(cloud)
    if felt is None:
        print(f"pressed {press_mm:.2f} mm: nothing touches the gel")
        continue
    print(
        f"pressed {press_mm:.2f} mm: at ({state.x_mm:+.1f}, {state.y_mm:+.1f}) mm, "
        f"{state.depth_mm:.2f} mm deep, {felt.low:.1f} to {felt.high:.1f} N ({state.position})"
    )
