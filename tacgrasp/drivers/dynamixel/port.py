"""The serial port under the Dynamixel SDK: claimed for one program, without busy waiting.

The SDK's own port may be opened by two programs at once, waits in a busy loop, and measures
time-outs on the wall clock. This module imports the SDK: import it inside functions only.
"""

from __future__ import annotations

import time

import serial
from dynamixel_sdk import PortHandler

from tacgrasp.drivers.serial_ports import claim

_READ_S = 0.002
_WRITE_S = 1.0
_EXTRA_CHECKS = 8


class ClaimedPort(PortHandler):
    """A ``PortHandler`` that no other program can open at the same time."""

    def __init__(self, path: str, baud: int, reply_timeout_s: float, device: str) -> None:
        """Open the port.

        Raises:
            RobotError: Another program uses the port.
            OSError: The port can't be opened.
        """
        super().__init__(path)
        self._reply_timeout_ms, self._device = 1000 * reply_timeout_s, device
        self._num_extra_checks = 0
        if not self.setBaudRate(baud):
            raise OSError(f"the Dynamixel SDK can't set {baud} baud")

    def setupPort(self, cflag_baud: int) -> bool:  # noqa: N802 - the SDK's name
        """Open and claim the port; called by the SDK."""
        self.closePort()
        self.ser = serial.Serial(
            port=self.port_name, baudrate=self.baudrate, timeout=_READ_S, write_timeout=_WRITE_S
        )
        self.is_open = True
        try:
            claim(self.ser.fileno(), self.port_name, self._device)
        except BaseException:
            self.closePort()
            raise
        self.ser.reset_input_buffer()
        self.tx_time_per_byte = 10_000.0 / self.baudrate  # ms; 10 bits a byte
        return True

    def closePort(self) -> None:  # noqa: N802
        if self.ser is not None:
            self.ser.close()
        self.is_open = False

    def getCurrentTime(self) -> float:  # noqa: N802
        """Monotonic time [ms]: a change of the wall clock must not end or stretch a wait."""
        return 1000 * time.monotonic()

    def setPacketTimeout(self, packet_length: int) -> None:  # noqa: N802
        """Set the wait for a reply of so many bytes, by the settings' reply time-out."""
        self._num_extra_checks = 0
        self.setPacketTimeoutMillis(self.tx_time_per_byte * packet_length + self._reply_timeout_ms)

    def isPacketTimeout(self) -> bool:  # noqa: N802
        """Whether the wait has ended without a reply.

        On a busy computer this thread may pause for longer than the wait although the reply arrived
        in time: bytes in the buffer are read first, a few times at most.
        """
        if self.getTimeSinceStart() <= self.packet_timeout:
            return False
        if self.ser.in_waiting and self._num_extra_checks < _EXTRA_CHECKS:
            self._num_extra_checks += 1
            return False
        return True
