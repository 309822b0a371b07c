"""Known loads on a sensor's pad, one after another, and the force that is read of each.

Each load has a reference of its own, taken just before it without any load, so that slow drift of
the gel counts for little. Readings are nominal newtons, whatever calibration the sensor has.

Not here: the fit and its file (``cltp.sensing.force_calibration``).
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError
from cltp.sensing.force_calibration import MIN_LOADS, MIN_RANGE, ForceLoad
from cltp.tactile.measure import contact_state
from primitives.devices import Gripper
from primitives.errors import RobotError
from tacgrasp.base.errors import UsageError
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Clock, Rig, TactileSensor
from tacgrasp.rig.release import CLEAR_M, let_go, opened_afterwards

LOADS_N = (0.5, 1.0, 2.0, 5.0)
"""Loads where none are named [N]."""

NUM_FRAMES = 10
"""Frames of one reading."""

SETTLE_S = 1.0
"""Wait between a grip and its reading [s]: gels creep at first."""

G_M_S2 = 9.81

Report = Callable[[str], object]


class LoadSource(Protocol):
    """What puts loads on the pad."""

    def release(self) -> None:
        """Take every load off the pad."""

    def press(self, load_n: float) -> float:
        """Put a load on the pad; returns its true force, near ``load_n`` [N]."""

    def end(self) -> None:
        """Leave nothing that presses by itself, whatever has happened; asks nobody."""


@dataclass(frozen=True, slots=True)
class PersonLoads:
    """Weights that a person puts on the pad; ``ask`` shows a line and returns when it is done."""

    ask: Callable[[str], object]

    def release(self) -> None:
        self.ask("take everything off the pad, then press Enter: ")

    def press(self, load_n: float) -> float:
        grams = 1000 * load_n / G_M_S2
        self.ask(
            f"put {load_n:g} N ({grams:.0f} g, its holder included) on the middle of the pad, "
            "then press Enter: "
        )
        return load_n

    def end(self) -> None:
        """A weight is taken off by who put it there."""


@dataclass(frozen=True, slots=True)
class GripperLoads:
    """A gripper with a calibration of its own, which closes on an object."""

    gripper: Gripper
    clock: Clock

    def release(self) -> None:
        self.gripper.open_by(CLEAR_M)

    def press(self, load_n: float) -> float:
        force_n = self.gripper.grip(load_n).force_n
        self.clock.sleep(SETTLE_S)
        return force_n

    def end(self) -> None:
        let_go(self.gripper, CLEAR_M)


@dataclass(frozen=True, slots=True)
class WorldLoads:
    """The world of a simulated or emulated rig, which knows its true force."""

    rig: Rig

    def release(self) -> None:
        let_go(self.rig.gripper, CLEAR_M)

    def press(self, load_n: float) -> float:
        truth = self.rig.truth()
        if truth is None:
            raise RobotError("only a simulated or emulated world puts loads by itself")
        self.rig.gripper.grip(load_n / truth.gripper_force_gain)
        self.rig.clock.sleep(SETTLE_S)
        after = self.rig.truth()
        return 0.0 if after is None else after.force_n

    def end(self) -> None:
        let_go(self.rig.gripper, CLEAR_M)


def default_loads(most_n: float) -> tuple[float, ...]:
    """``LOADS_N`` up to a limit, which is then the largest; spread anew where too few are left [N].

    Args:
        most_n: The limit [N].
    """
    if most_n >= LOADS_N[-1]:
        return LOADS_N
    loads_n = (*(load_n for load_n in LOADS_N if load_n < most_n), most_n)
    if len(loads_n) >= MIN_LOADS and most_n >= MIN_RANGE * loads_n[0]:
        return loads_n
    return most_n / 4, most_n / 2, most_n


def check_within(loads_n: Sequence[float], least_n: float, most_n: float, whose: str) -> None:
    """Refuse loads that a gripper may not press with, before anything moves.

    Args:
        loads_n: Loads, rising [N].
        least_n: Smallest force [N].
        most_n: Largest force [N].
        whose: These limits in words, for the message.

    Raises:
        UsageError: A load is beyond them.
    """
    beyond = [load_n for load_n in loads_n if not least_n <= load_n <= most_n * (1 + 1e-9)]
    if not beyond:
        return
    example = default_loads(math.floor(100 * most_n) / 100)
    like = f", like --loads {_listed(example)}" if example[0] >= least_n else ""
    raise UsageError(
        f"--loads {_listed(loads_n)} goes beyond {whose}, {least_n:g} to {most_n:.4g} N (at "
        f"{_listed(beyond)}); give loads within{like}; nothing moved"
    )


def _listed(loads_n: Sequence[float]) -> str:
    return " ".join(f"{load_n:.4g}" for load_n in loads_n)


def measure_loads(
    sensor: TactileSensor,
    source: LoadSource,
    loads_n: Sequence[float],
    *,
    report: Report,
    keep: Callable[[Sequence[ForceLoad]], object],
    measured: Sequence[ForceLoad] = (),
) -> list[ForceLoad]:
    """Put every load on the pad and read it; the pad is free afterwards.

    On every other way out too, Ctrl-C among them, a gripper is opened.

    Args:
        sensor: Connected sensor.
        source: Puts the loads.
        loads_n: Loads, rising [N].
        report: Is told of each reading.
        keep: Is given all readings after each of them.
        measured: Readings of the first loads, from an interrupted measurement.

    Raises:
        TouchError: The sensor fails, nothing touches it under a load, or the pad's edge cuts the
            contact.
        RobotError: The gripper fails; the message says if it may still hold.
    """
    sense, readings = GelSense(sensor), list(measured)
    with opened_afterwards(source.end):
        for load_n in loads_n[len(readings) :]:
            source.release()
            sense.take_reference()
            true_n = source.press(load_n)
            readings.append(ForceLoad(load_n=true_n, read_n=_read_n(sense, true_n)))
            keep(readings)
            report(f"load      {true_n:.3f} N, read {readings[-1].read_n:.3f} nominal N")
        source.release()
    return readings


def _read_n(sense: GelSense, load_n: float) -> float:
    """Mean of the force in some readings [nominal N]."""
    values = []
    for _ in range(NUM_FRAMES):
        cloud = sense.read()
        state = contact_state(cloud, in_contact=sense.in_contact(cloud))
        if not state.in_contact:
            raise TouchError(
                f"nothing touches the gel under {load_n:.3g} N; put the load on the middle of the "
                "pad, or begin with a larger one"
            )
        if state.cut:
            raise TouchError(
                f"the pad's edge cuts the contact under {load_n:.3g} N ({', '.join(state.cut)}); "
                "put the load on the middle of the pad, on a smaller tip if need be"
            )
        values.append(state.force_n / cloud.force_scale.factor)
    return float(np.mean(values))


@dataclass(frozen=True, slots=True, kw_only=True)
class UnfinishedLoads:
    """Readings of a measurement that has not ended, in a file beside that of the calibration.

    Attributes:
        out: File of the calibration.
        sensor, unit: What is measured.
        loads_n: All loads of the measurement [N].
    """

    out: Path
    sensor: str
    unit: str
    loads_n: Sequence[float]

    @property
    def path(self) -> Path:
        return self.out.with_name(f"{self.out.name}.unfinished")

    def keep(self, readings: Sequence[ForceLoad]) -> None:
        """Write the readings so far, whole or not at all.

        Raises:
            UsageError: They can't be written.
        """
        record = {**self._identity(), "readings": [asdict(reading) for reading in readings]}
        try:
            write_atomically(self.path, json.dumps(record, indent=2) + "\n")
        except OSError as error:
            raise UsageError(
                f"readings can't be kept in {self.path}: {error.strerror or error}; give --out in "
                "a folder that can be written"
            ) from None

    def read(self) -> list[ForceLoad]:
        """Readings of the interrupted measurement of the same loads.

        Raises:
            UsageError: There are none, they are of another measurement, or the file is damaged.
        """
        advice = "measure anew, without --resume"
        try:
            record = json.loads(self.path.read_text(encoding="utf-8"))
            readings = record.pop("readings")
            pairs = [(float(each["load_n"]), float(each["read_n"])) for each in readings]
        except FileNotFoundError:
            raise UsageError(f"--resume: there are no readings in {self.path}; {advice}") from None
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            raise UsageError(f"--resume: {self.path} is damaged; {advice}") from None
        if record != self._identity() or len(pairs) > len(self.loads_n):
            raise UsageError(
                f"--resume: {self.path} is of another sensor, unit or other loads than these; "
                f"{advice}"
            )
        return [ForceLoad(load_n=load_n, read_n=read_n) for load_n, read_n in pairs]

    def drop(self) -> None:
        """Remove the file: the calibration is written."""
        self.path.unlink(missing_ok=True)

    def _identity(self) -> dict[str, object]:
        return {"sensor": self.sensor, "unit": self.unit, "loads_n": list(self.loads_n)}
