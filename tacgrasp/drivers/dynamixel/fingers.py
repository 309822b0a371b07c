"""Fingers on one or two Dynamixel servos: opening in metres, grip in milliamperes.

Goals are clamped to the fingers' travel here, because current-based position control ignores the
servo's position limits. A grip is a goal beyond the object with a limited current: the fingers stop
at the object and press with that current.

Not here: newtons (``gripper.DynamixelGripper``).
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping, Sequence

from primitives.errors import RobotError
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.kept_grip import mean_width_m, read_kept_ma, widths_m
from tacgrasp.drivers.dynamixel.poller import PollSample, ServoPoller
from tacgrasp.drivers.dynamixel.servo_state import ServoCommand, ServoSample
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings, ServoSettings
from tacgrasp.drivers.dynamixel.startup_checks import startup_findings
from tacgrasp.drivers.serial_ports import adapter_serial

_AT_GOAL_TICKS = 5
"""Distance at which a servo has reached its goal: gears have play, small errors give no force."""

_REST_VELOCITY, _REST_TICKS = 1, 1
_CURRENT_TOLERANCE, _CURRENT_TOLERANCE_UNITS = 0.25, 6
"""Noise of the measured current of a pressing servo: fraction of the set current, and units."""

_log = logging.getLogger(__name__)


class ServoFingers:
    """Connected fingers; made by ``connect_fingers``.

    Attributes:
        settings: The gripper's section of the rig's file.
        unit_ma: Current of one register unit [mA].
        adapter: Serial number of the USB adapter; empty if the adapter has none.
        bus: Their bus, used by the poller's thread alone.
        poller: The thread that polls the servos.
        sent: The last command on the wire, in the servos' words; empty before the first.
        kept_ma: Current of a grip that an earlier run left [mA]; None without one.
    """

    def __init__(
        self,
        bus: Bus,
        settings: DynamixelSettings,
        commanded: Mapping[int, ServoCommand],
        *,
        kept_ma: float | None = None,
    ) -> None:
        self.settings, self.bus, self.kept_ma = settings, bus, kept_ma
        self.poller = ServoPoller(bus, settings, commanded)
        self.unit_ma = reg.MODELS[settings.model].unit_ma
        self.adapter = adapter_serial(bus.path)
        self.sent = ""
        self._connected = True
        self._num_stops = 0

    def width_m(self) -> float:
        """Read the opening between the fingers [m].

        Raises:
            RobotError: A servo does not reply or is not as it was commanded, or the gripper has a
                fault or is disconnected.
        """
        self._check_connected()
        return self._width_m([servo.position for servo in self.poller.read_now().servos])

    def squeeze(self, current_ma: float) -> float:
        """Close with a current until the fingers rest; returns the opening [m].

        Raises:
            RobotError: The current is beyond ``max_current_ma`` (nothing is sent), the fingers do
                not come to rest in time, or the gripper has a fault.
        """
        units = self._units(current_ma)
        goals = [servo.closed_ticks for servo in self.settings.servos]
        number = self._send(units, goals)

        def presses(servo: int, sample: ServoSample) -> bool:
            tolerance = max(_CURRENT_TOLERANCE_UNITS, _CURRENT_TOLERANCE * units)
            at_goal = abs(sample.position - goals[servo]) <= _AT_GOAL_TICKS
            return at_goal or abs(abs(sample.current) - units) <= tolerance

        return self._settled(number, presses, f"to press with {current_ma:.0f} mA")

    def press(self, current_ma: float) -> float:
        """Press closed fingers with another current, and return at once.

        Returns:
            Opening at the last poll [m].

        Raises:
            RobotError: The current is beyond ``max_current_ma`` (nothing is sent), the servos do
                not confirm the command, or the gripper has a fault.
        """
        self._send(self._units(current_ma), [servo.closed_ticks for servo in self.settings.servos])
        return self._width_m([servo.position for servo in self.poller.next_sample(0).servos])

    def _units(self, current_ma: float) -> int:
        """A current in units of the register."""
        if not 0 < current_ma <= self.settings.max_current_ma:
            raise RobotError(
                f"a current must lie in (0, {self.settings.max_current_ma:g}] mA, got "
                f"{current_ma:g}"
            )
        return max(1, round(current_ma / self.unit_ma))

    def open_to(self, width_m: float) -> float:
        """Open to a width within the travel, or a little beyond it; returns the width [m].

        Fingers that rest wider than asked are open: play and friction of the linkage may hold them
        there. Fingers that rest narrower are not.

        Raises:
            RobotError: They do not get there in time, or the gripper has a fault.
        """
        servos = self.settings.servos
        goals = [self._ticks(servo, width_m) for servo in servos]
        number = self._send(max(1, round(self.settings.open_current_ma / self.unit_ma)), goals)
        opens_up = [servo.open_ticks > servo.closed_ticks for servo in servos]

        def is_open(servo: int, sample: ServoSample) -> bool:
            beyond = sample.position - goals[servo]
            return (beyond if opens_up[servo] else -beyond) >= -_AT_GOAL_TICKS

        return self._settled(number, is_open, f"to open to {1000 * width_m:.1f} mm")

    def freeze(self) -> None:
        """Stop moving fingers at their present position; a grip at rest stays as it is.

        Raises:
            RobotError: The gripper has a fault.
        """

        def stay(bus: Bus) -> None:
            for servo in self.settings.servos:
                motion = bus.read(servo.id, 128, 8).data
                velocity = int.from_bytes(motion[:4], "little", signed=True)
                if abs(velocity) > _REST_VELOCITY:
                    bus.write(servo.id, reg.GOAL_POSITION, motion[4:])
                    position = int.from_bytes(motion[4:], "little", signed=True)
                    self.poller.expect(servo.id, goal_position=position)
                    self.sent = "goal position: where it is"
                    self._num_stops += 1

        self._call(stay)

    def disconnect(self) -> None:
        """Free the port; the servos keep their torque and goals. Idempotent, never raises.

        The bus watchdog is switched off, because the servo's behaviour in this mode after a trip is
        not documented.
        """
        if not self._connected:
            return
        self._connected = False

        def switch_watchdog_off(bus: Bus) -> None:
            for servo in self.settings.servos:
                bus.write(servo.id, reg.WATCHDOG, b"\0")
                self.poller.expect(servo.id, watchdog=0)

        try:
            self.poller.call(switch_watchdog_off, despite_fault=True)
        except RobotError as error:
            _log.warning("the gripper's bus watchdog could not be switched off: %s", error)
        self.poller.close()
        self.bus.close()

    def _call(self, job: Callable[[Bus], list[int] | None]) -> list[int]:
        self._check_connected()
        return self.poller.call(job) or []

    def _check_connected(self) -> None:
        if not self._connected:
            raise RobotError("the gripper is disconnected")

    def _send(self, units: int, goals: Sequence[int]) -> int:
        """Write current, speed and goal at once; returns the number of the last sample before."""
        data = {
            servo.id: (
                units.to_bytes(2, "little")
                + bytes(8)  # goal velocity and profile acceleration: 0
                + self._profile_velocity(servo).to_bytes(4, "little")
                + goal.to_bytes(4, "little", signed=True)
            )
            for servo, goal in zip(self.settings.servos, goals, strict=True)
        }

        positions = ", ".join(map(str, goals))
        self.sent = (
            f"goal current {units} ({units * self.unit_ma:.0f} mA), goal position {positions} ticks"
        )

        def write(bus: Bus) -> list[int]:
            bus.write_all(reg.GOAL_CURRENT, data)
            for servo, goal in zip(self.settings.servos, goals, strict=True):
                self.poller.expect(servo.id, goal_current=units, goal_position=goal)
            return [self.poller.num_polls]

        return self._call(write)[0]

    def _settled(
        self,
        number: int,
        is_done: Callable[[int, ServoSample], bool],
        purpose: str,
    ) -> float:
        """Wait until all servos are at rest and done, ``settle_polls`` samples in a row.

        Args:
            number: Number of the last sample before the command.
            is_done: Whether a servo, by its place in the settings, has done what was asked.
            purpose: What was asked, for the message.
        """
        deadline_s = time.monotonic() + self.settings.settle_timeout_s
        num_still, previous, num_stops = 0, None, self._num_stops
        while num_still < self.settings.settle_polls:
            if self._num_stops != num_stops:
                raise RobotError("the fingers were stopped on their way")
            if time.monotonic() > deadline_s:
                raise RobotError(
                    f"the fingers did not come to rest {purpose} within "
                    f"{self.settings.settle_timeout_s:g} s; is the linkage free, and the speed "
                    "(speed_mm_s) reached?"
                )
            sample = self.poller.next_sample(number)
            at_rest = previous is not None and _at_rest(previous, sample)
            done = all(is_done(index, servo) for index, servo in enumerate(sample.servos))
            num_still = num_still + 1 if at_rest and done else 0
            previous, number = sample, sample.number
        positions = [servo.position for servo in sample.servos]
        self._check_skew(positions)
        return self._width_m(positions)

    def _check_skew(self, positions: Sequence[int]) -> None:
        widths = [1000 * width for width in widths_m(self.settings, positions)]
        if max(widths) - min(widths) > self.settings.max_skew_mm:
            texts = " and ".join(f"{width:.1f}" for width in widths)
            raise RobotError(
                f"the two fingers stand at {texts} mm: one is blocked or has slipped on its servo "
                f"(max_skew_mm is {self.settings.max_skew_mm:g})"
            )

    def _width_m(self, positions: Sequence[int]) -> float:
        return mean_width_m(self.settings, positions)

    def _ticks(self, servo: ServoSettings, width_m: float) -> int:
        low, high = self.settings.closed_width_mm, self.settings.open_width_mm
        fraction = min(1.0, max(0.0, (1000 * width_m - low) / (high - low)))
        return round(servo.closed_ticks + fraction * (servo.open_ticks - servo.closed_ticks))

    def _profile_velocity(self, servo: ServoSettings) -> int:
        """Profile velocity, in register units, that moves the fingers with ``speed_mm_s``."""
        travel_mm = self.settings.open_width_mm - self.settings.closed_width_mm
        ticks_s = self.settings.speed_mm_s * abs(servo.open_ticks - servo.closed_ticks) / travel_mm
        return max(1, round(ticks_s / reg.VELOCITY_TICKS_S))


def _at_rest(previous: PollSample, sample: PollSample) -> bool:
    return all(
        not servo.moving
        and abs(servo.velocity) <= _REST_VELOCITY
        and abs(servo.position - before.position) <= _REST_TICKS
        for before, servo in zip(previous.servos, sample.servos, strict=True)
    )


def connect_fingers(settings: DynamixelSettings) -> ServoFingers:
    """Open the port, check the servos, and let them hold their positions; nothing moves.

    Servos with torque on (a grip kept by an earlier run) stay as they are.

    Raises:
        RobotError: The port can't be opened, or a check fails; the message gives the remedy.
    """
    bus = Bus(settings)
    bus.open()
    try:
        failed = [finding for finding in startup_findings(bus, settings) if not finding.ok]
        if failed:
            first = failed[0]
            more = f" (and {len(failed) - 1} more; see tacgrasp doctor)" if failed[1:] else ""
            raise RobotError(f"the gripper's {first.name}: {first.detail}; {first.advice}{more}")
        kept_ma = read_kept_ma(bus, settings)
        commanded = {servo.id: _hold(bus, settings, servo) for servo in settings.servos}
    except BaseException:
        bus.close()
        raise
    return ServoFingers(bus, settings, commanded, kept_ma=kept_ma)


def _hold(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> ServoCommand:
    """Switch torque on without a jump, and set the bus watchdog; returns what the servo holds.

    A grip kept by an earlier run has goals of that run, which are read.
    """
    bus.write(servo.id, reg.WATCHDOG, b"\0")  # clears a watchdog that tripped in an earlier run
    if not bus.read_number(servo.id, reg.TORQUE, 1):
        position = bus.read(servo.id, reg.PRESENT_POSITION, 4).data
        units = max(1, round(settings.open_current_ma / reg.MODELS[settings.model].unit_ma))
        bus.write(servo.id, reg.GOAL_CURRENT, units.to_bytes(2, "little"))
        bus.write(servo.id, reg.GOAL_POSITION, position)
        bus.write(servo.id, reg.TORQUE, b"\1")
    watchdog = round(settings.bus_watchdog_ms / 1000 / reg.WATCHDOG_UNIT_S)
    bus.write(servo.id, reg.WATCHDOG, bytes([watchdog]))
    return ServoCommand(
        torque=1,
        mode=reg.CURRENT_BASED_POSITION,
        watchdog=watchdog,
        goal_current=bus.read_number(servo.id, reg.GOAL_CURRENT, 2, signed=True),
        goal_position=bus.read_number(servo.id, reg.GOAL_POSITION, 4, signed=True),
    )
