"""Fingers on one or two Dynamixel servos: width in metres, grip in milliamperes.

Goals are clamped to the fingers' travel here, since current-based position control ignores the
servo's position limits. A grip is a goal beyond the object with a limited current: the fingers stop
where they meet it and press with that current.

Not here: newtons (``dynamixel.DynamixelGripper``).
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from primitives.errors import RobotError
from tacgrasp.drivers.dynamixel import registers as at
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import Counts
from tacgrasp.drivers.dynamixel.poller import OnFault, Sample, ServoSample, Watch
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings, ServoSettings
from tacgrasp.drivers.dynamixel.startup_checks import start_findings
from tacgrasp.drivers.serial_ports import adapter_serial

_AT_GOAL_TICKS = 5
"""So near to a goal a servo has arrived: gears have play, and small errors stay without force."""

_STILL_VELOCITY, _STILL_TICKS = 1, 1
_SAME_CURRENT_SHARE, _SAME_CURRENT_UNITS = 0.25, 6
"""How near the measured current of a servo that presses is to the one that was set; it is noisy."""

_log = logging.getLogger(__name__)


class Hand:
    """Connected fingers; made by ``connect_hand``.

    Attributes:
        settings: What the rig's file says.
        unit_ma: One unit of current [mA].
        adapter: Serial number of the USB adapter; empty when it tells none.
        sent: What was last put on the wire, in the servos' words; empty before.
    """

    def __init__(
        self, bus: Bus, watch: Watch, settings: DynamixelSettings, clock: Callable[[], float]
    ) -> None:
        self.settings, self._bus, self._watch, self._clock = settings, bus, watch, clock
        self.unit_ma = at.MODELS[settings.model].unit_ma
        self.adapter = adapter_serial(bus.path)
        self.sent = ""
        self._connected = True
        self._stops = 0

    @property
    def watch(self) -> Watch:
        """The thread that polls the servos."""
        return self._watch

    @property
    def transients(self) -> Counts:
        """Faults of the bus that were survived."""
        return replace(self._bus.counts)

    def hurry_while(self, moving: Callable[[], bool]) -> None:
        """Be patient with a servo that is slow to answer, unless ``moving`` says yes."""
        self._bus.hurried = moving

    def width_m(self) -> float:
        """Opening between the fingers, read now [m].

        Raises:
            RobotError: A servo does not tell, or the gripper has a fault or is disconnected.
        """

        def positions(bus: Bus) -> list[int]:
            return [
                bus.read_number(servo.id, at.PRESENT_POSITION, 4, signed=True)
                for servo in self.settings.servos
            ]

        return self._width_m(self._call(positions))

    def squeeze(self, current_ma: float) -> float:
        """Close with a current until the fingers rest; returns the opening [m].

        Raises:
            RobotError: The current is beyond ``max_current_ma`` (nothing is sent), the fingers do
                not come to rest in time, or the gripper has a fault.
        """
        if not 0 < current_ma <= self.settings.max_current_ma:
            raise RobotError(
                f"a current must lie in (0, {self.settings.max_current_ma:g}] mA, got "
                f"{current_ma:g}"
            )
        units = max(1, round(current_ma / self.unit_ma))
        goals = [servo.closed_ticks for servo in self.settings.servos]
        after = self._send(units, goals)

        def pressing(servo: ServoSample, goal: int) -> bool:
            near = max(_SAME_CURRENT_UNITS, _SAME_CURRENT_SHARE * units)
            at_goal = abs(servo.position - goal) <= _AT_GOAL_TICKS
            return at_goal or abs(abs(servo.current) - units) <= near

        return self._settled(after, goals, pressing, f"to press with {current_ma:.0f} mA")

    def open_to(self, width_m: float) -> float:
        """Open, or close without pressing hard, to a width within the travel; returns it [m].

        Raises:
            RobotError: They do not get there in time, or the gripper has a fault.
        """
        goals = [self._ticks(servo, width_m) for servo in self.settings.servos]
        after = self._send(max(1, round(self.settings.open_current_ma / self.unit_ma)), goals)

        def there(servo: ServoSample, goal: int) -> bool:
            return abs(servo.position - goal) <= _AT_GOAL_TICKS

        return self._settled(after, goals, there, f"to open to {1000 * width_m:.1f} mm")

    def freeze(self) -> None:
        """Stop where the fingers are, if they are on their way; a grip at rest is left alone.

        Raises:
            RobotError: The gripper has a fault.
        """

        def stay(bus: Bus) -> None:
            for servo in self.settings.servos:
                moving = bus.read(servo.id, 128, 8).data
                velocity = int.from_bytes(moving[:4], "little", signed=True)
                if abs(velocity) > _STILL_VELOCITY:
                    bus.write(servo.id, at.GOAL_POSITION, moving[4:])
                    self.sent = "goal position: where it is"
                    self._stops += 1

        self._call(stay)

    def disconnect(self) -> None:
        """Free the port; the servos keep their torque and goals. Idempotent, never raises.

        The bus watchdog is switched off: what a servo does in this mode when it trips is not known.
        """
        if not self._connected:
            return
        self._connected = False

        def unwatch(bus: Bus) -> None:
            for servo in self.settings.servos:
                bus.write(servo.id, at.WATCHDOG, b"\0")

        try:
            self._watch.call(unwatch, despite_fault=True)
        except RobotError as error:
            _log.warning("the gripper's bus watchdog could not be switched off: %s", error)
        self._watch.close()
        self._bus.close()

    def _call(self, job: Callable[[Bus], list[int] | None]) -> list[int]:
        if not self._connected:
            raise RobotError("the gripper is disconnected")
        return self._watch.call(job) or []

    def _send(self, units: int, goals: Sequence[int]) -> int:
        """Write current, speed and goal in one go; returns the number of the sample before."""
        data = {
            servo.id: (
                units.to_bytes(2, "little")
                + bytes(8)  # goal velocity and profile acceleration: 0
                + self._profile(servo).to_bytes(4, "little")
                + goal.to_bytes(4, "little", signed=True)
            )
            for servo, goal in zip(self.settings.servos, goals, strict=True)
        }

        self.sent = (
            f"goal current {units} ({units * self.unit_ma:.0f} mA), goal position "
            f"{', '.join(map(str, goals))} ticks"
        )

        def write(bus: Bus) -> list[int]:
            bus.write_all(at.GOAL_CURRENT, data)
            return [self._watch.num_samples]

        return self._call(write)[0]

    def _settled(
        self,
        after: int,
        goals: Sequence[int],
        done: Callable[[ServoSample, int], bool],
        what: str,
    ) -> float:
        """Wait until all servos rest and are done, ``settle_polls`` times in a row."""
        deadline_s = self._clock() + self.settings.settle_timeout_s
        still, before, stops = 0, None, self._stops
        while still < self.settings.settle_polls:
            if self._stops != stops:
                raise RobotError("the fingers were stopped on their way")
            if self._clock() > deadline_s:
                raise RobotError(
                    f"the fingers did not come to rest {what} within "
                    f"{self.settings.settle_timeout_s:g} s; is the linkage free, and the speed "
                    "(speed_mm_s) reached?"
                )
            sample = self._watch.next_sample(after)
            rest = before is not None and _at_rest(before, sample)
            good = all(done(s, goal) for s, goal in zip(sample.servos, goals, strict=True))
            still = still + 1 if rest and good else 0
            before, after = sample, sample.number
        positions = [servo.position for servo in sample.servos]
        self._check_skew(positions)
        return self._width_m(positions)

    def _check_skew(self, positions: Sequence[int]) -> None:
        widths = [1000 * self._servo_width_m(s, p) for s, p in self._with(positions)]
        if max(widths) - min(widths) > self.settings.max_skew_mm:
            told = " and ".join(f"{width:.1f}" for width in widths)
            raise RobotError(
                f"the two fingers stand at {told} mm: one is blocked or has slipped on its servo "
                f"(max_skew_mm is {self.settings.max_skew_mm:g})"
            )

    def _with(self, positions: Sequence[int]) -> Sequence[tuple[ServoSettings, int]]:
        return list(zip(self.settings.servos, positions, strict=True))

    def _width_m(self, positions: Sequence[int]) -> float:
        widths = [self._servo_width_m(s, p) for s, p in self._with(positions)]
        return max(0.0, sum(widths) / len(widths))

    def _servo_width_m(self, servo: ServoSettings, ticks: int) -> float:
        share = (ticks - servo.closed_ticks) / (servo.open_ticks - servo.closed_ticks)
        low, high = self.settings.closed_width_mm, self.settings.open_width_mm
        return 1e-3 * (low + share * (high - low))

    def _ticks(self, servo: ServoSettings, width_m: float) -> int:
        low, high = self.settings.closed_width_mm, self.settings.open_width_mm
        share = min(1.0, max(0.0, (1000 * width_m - low) / (high - low)))
        return round(servo.closed_ticks + share * (servo.open_ticks - servo.closed_ticks))

    def _profile(self, servo: ServoSettings) -> int:
        """Profile velocity that moves the fingers with ``speed_mm_s``."""
        travel_mm = self.settings.open_width_mm - self.settings.closed_width_mm
        ticks_s = self.settings.speed_mm_s * abs(servo.open_ticks - servo.closed_ticks) / travel_mm
        return max(1, round(ticks_s / at.VELOCITY_TICKS_S))


def _at_rest(before: Sample, now: Sample) -> bool:
    return all(
        not servo.moving
        and abs(servo.velocity) <= _STILL_VELOCITY
        and abs(servo.position - then.position) <= _STILL_TICKS
        for then, servo in zip(before.servos, now.servos, strict=True)
    )


def connect_hand(
    settings: DynamixelSettings,
    *,
    on_fault: OnFault | None = None,
    clock: Callable[[], float] = time.monotonic,
) -> Hand:
    """Open the port, check the servos, and let them hold where they are; nothing moves.

    Servos that hold already (a grip that an earlier run has kept) are left as they are.

    Args:
        settings: What the rig's file says.
        on_fault: Called once from the I/O thread when the gripper fails; it must be quick.
        clock: Monotonic [s].

    Raises:
        RobotError: The port can't be had, or a check refuses; the message says how to mend it.
    """
    bus = Bus(settings, clock)
    bus.open()
    try:
        wrong = [finding for finding in start_findings(bus, settings) if not finding.ok]
        if wrong:
            first = wrong[0]
            more = f" (and {len(wrong) - 1} more; see tacgrasp doctor)" if wrong[1:] else ""
            raise RobotError(f"the gripper's {first.name}: {first.found}; {first.advice}{more}")
        for servo in settings.servos:
            _hold(bus, settings, servo)
    except BaseException:
        bus.close()
        raise
    bus.hurried = lambda: True  # from here on the arm may move, as far as this driver knows
    return Hand(bus, Watch(bus, settings, on_fault, clock), settings, clock)


def _hold(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> None:
    """Torque on without a jump, and the bus watchdog set."""
    bus.write(servo.id, at.WATCHDOG, b"\0")  # clears one that an earlier run has let trip
    if not bus.read_number(servo.id, at.TORQUE, 1):
        here = bus.read(servo.id, at.PRESENT_POSITION, 4).data
        units = max(1, round(settings.open_current_ma / at.MODELS[settings.model].unit_ma))
        bus.write(servo.id, at.GOAL_CURRENT, units.to_bytes(2, "little"))
        bus.write(servo.id, at.GOAL_POSITION, here)
        bus.write(servo.id, at.TORQUE, b"\1")
    watchdog = round(settings.bus_watchdog_ms / 1000 / at.WATCHDOG_UNIT_S)
    bus.write(servo.id, at.WATCHDOG, bytes([watchdog]))
