"""Threads of the fault benchmark: a move, an episode and a connection, each bounded in time.

Not here: the faults (``tacgrasp.benchmarks.faults.cases``), their injection
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
"""Time after which connecting counts as hung [s]."""

SPEED_M_S, ACCELERATION_M_S2 = 0.4, 2.5


class Move:
    """A move at full speed in a thread of its own.

    Attributes:
        error: Message of the error; '' without one.
        reached: Pose at the end; None after an error.
        ended_s: Time of the end, monotonic [s].
    """

    def __init__(self, rig: HardwareRig, target: Pose) -> None:
        """Begin the move."""
        self.error, self.ended_s = "", float("nan")
        self.reached: Pose | None = None
        self._thread = threading.Thread(target=self._run, args=(rig, target), daemon=True)
        self._thread.start()

    def wait(self, seconds: float) -> bool:
        """Wait; True when the move has ended by then."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def _run(self, rig: HardwareRig, target: Pose) -> None:
        try:
            self.reached = rig.arm.move_to(
                target, speed_m_s=SPEED_M_S, acceleration_m_s2=ACCELERATION_M_S2
            )
        except RobotError as error:
            self.error = str(error)
        finally:
            self.ended_s = time.monotonic()


class RecordedEpisode:
    """A recorded episode in a thread of its own.

    Attributes:
        message: Message to the operator at the end.
        ended_s: Time of the end, monotonic [s].
    """

    def __init__(self, rig: HardwareRig, config: RunConfig) -> None:
        """Begin the episode."""
        self.message, self.ended_s = "", float("nan")
        self._reason, self._path = "", Path()
        self._thread = threading.Thread(target=self._run, args=(rig, config), daemon=True)
        self._thread.start()

    @property
    def ended(self) -> bool:
        """The episode has ended."""
        return not self._thread.is_alive()

    def wait(self, seconds: float) -> bool:
        """Wait; True when the episode has ended by then."""
        self._thread.join(seconds)
        return self.ended

    def check(self, *, expect_fault: bool) -> str:
        """Read the recorded file: 'intact', or its problem."""
        try:
            episode = read_episode(self._path)
        except EpisodeError as error:
            return str(error)
        if not episode.complete or episode.end is None:
            return episode.problem or "it has no end"
        if episode.end.reason != self._reason or (expect_fault and self._reason != "fault"):
            return f"its end is {episode.end.reason}"
        return "intact"

    def _run(self, rig: HardwareRig, config: RunConfig) -> None:
        with suppress(RobotError, EpisodeError):
            outcome, self._path = run_recorded(rig, make_policy("rules", config), config)
            self.message, self._reason = outcome.message, outcome.reason.value
        self.ended_s = time.monotonic()


def bounded(connect: Callable[[], None]) -> tuple[str, bool]:
    """Connect; returns the error message, '' without one, and whether the call hangs."""
    errors: list[str] = []

    def run() -> None:
        try:
            connect()
        except (RobotError, TouchError) as error:
            errors.append(str(error))

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(CONNECT_S)
    return (errors[0] if errors else ""), thread.is_alive()
