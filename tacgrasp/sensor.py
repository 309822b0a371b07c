"""The contract of a tactile sensor."""

from __future__ import annotations

from typing import Protocol

from cltp.cloud import TactileCloud
from cltp.sensors import SensorSpec


class TactileSensor(Protocol):
    """A sensor that gives clouds. Implementations: ``sim.rig.SimSensor``, the drivers."""

    @property
    def spec(self) -> SensorSpec:
        """Which sensor this is."""
        ...

    def read(self) -> TactileCloud:
        """Capture the gel now.

        The cloud is newer than the call, has 1024 stratified points and carries both clocks.

        Raises:
            TouchError: No fresh frame could be had; never answers with an old one.
        """
        ...

    def disconnect(self) -> None:
        """Free the device. Idempotent, never raises."""
        ...


class WatchedSensor(TactileSensor, Protocol):
    """A sensor that can be looked at while the arm moves, without waiting for a frame."""

    def check_alive(self) -> None:
        """Return at once when frames are coming.

        Raises:
            TouchError: They are not.
        """
        ...
