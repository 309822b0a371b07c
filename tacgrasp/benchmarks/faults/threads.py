"""What the fault benchmark runs beside itself: a move, an episode, a connection, each bounded.

Not here: the faults (``tacgrasp.benchmarks.faults.cases``), what is made of them
(``tacgrasp.benchmarks.faults.injection``).
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from cltp.errors import TouchError
from primitives.devices import Pose
from primitives.errors import RobotError
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import EpisodeError, read_episode
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.hardware import HardwareRig
from tacgrasp.run import run_recorded

CONNECT_S = 10.0
"""A connection that has not come back after so long hangs."""

SPEED_M_S, ACCELERATION_M_S2 = 0.4, 2.5


class Move:
    """A move at full speed in a thread of its own: what it came to.

    Attributes:
        told: The error; '' without one.
        reached: The pose at its end; None after an error.
        ended_s: When, monotonic.
    """

    def __init__(self, rig: HardwareRig, target: Pose) -> None:
        """Begin it."""
        self.told, self.ended_s = "", float("nan")
        self.reached: Pose | None = None
        self._thread = threading.Thread(target=self._run, args=(rig, target), daemon=True)
        self._thread.start()

    def wait(self, seconds: float) -> bool:
        """Whether it has come back within so long."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def _run(self, rig: HardwareRig, target: Pose) -> None:
        try:
            self.reached = rig.arm.move_to(
                target, speed_m_s=SPEED_M_S, acceleration_m_s2=ACCELERATION_M_S2
            )
        except RobotError as error:
            self.told = str(error)
        finally:
            self.ended_s = time.monotonic()


class RecordedEpisode:
    """A recorded episode in a thread of its own.

    Attributes:
        message: What the operator was told at its end.
        ended_s: When it ended, monotonic.
    """

    def __init__(self, rig: HardwareRig, config: RunConfig) -> None:
        """Begin it."""
        self.message, self.ended_s = "", float("nan")
        self._reason, self._path = "", Path()
        self._thread = threading.Thread(target=self._run, args=(rig, config), daemon=True)
        self._thread.start()

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        return not self._thread.is_alive()

    def wait(self, seconds: float) -> bool:
        """Whether it has ended within so long."""
        self._thread.join(seconds)
        return self.ended

    def intact(self, *, want_fault: bool) -> str:
        """'intact', or what is wrong with the file."""
        try:
            episode = read_episode(self._path)
        except EpisodeError as error:
            return str(error)
        if not episode.complete or episode.end is None:
            return episode.problem or "it has no end"
        if episode.end.reason != self._reason or (want_fault and self._reason != "fault"):
            return f"its end is {episode.end.reason}"
        return "intact"

    def _run(self, rig: HardwareRig, config: RunConfig) -> None:
        with suppress(RobotError, EpisodeError):
            outcome, self._path = run_recorded(rig, make_policy("rules", config), config)
            self.message, self._reason = outcome.message, outcome.reason.value
        self.ended_s = time.monotonic()


def bounded(connect_one: Callable[[], None]) -> tuple[str, bool]:
    """What connecting says, and whether it hangs."""
    said: list[str] = []

    def run() -> None:
        try:
            connect_one()
        except (RobotError, TouchError) as error:
            said.append(str(error))

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(CONNECT_S)
    return (said[0] if said else ""), thread.is_alive()
