"""A unit's slip calibration: its noise in a hold at rest, and the threshold that it leaves.

The threshold is that of the sensor's model, or, where the unit's own hold and unload came above it,
the largest score of these and a margin. The file is small JSON, read strictly.

Not here: the hold (``tacgrasp.bringup.slip_hold``).
"""

from __future__ import annotations

import datetime
import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError
from cltp.tactile.shear.contact_shear import ShearWatch
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.slip import SlipJudge, noise_of, slip_model

VERSION = 1
KIND = "tacgrasp-slip-calibration"

MARGIN = 0.5
"""Log odds above the largest score of a hold without slip. Our choice."""

MAX_RAISE = 6.0
"""Most that a threshold may stand above the model's. Our choice: more is a broken sensor, or an
object that moved."""

MAX_AGE_DAYS = 180.0
"""Largest age [days]; as of force calibrations, since gels wear. Our choice."""

ADVICE = "calibrate: tacgrasp calibrate slip"
_MAX_BYTES = 10_000


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipCalibration:
    """What a hold without slip tells of a unit.

    Attributes:
        sensor: Name of the sensor's model.
        unit: Name of the unit.
        date: Day of the measurement, ISO 8601.
        num_frames: Frames of hold and unload.
        along_mm, depth_mm: Noise of a point along the gel and into it, from frame to frame [mm].
        largest_score: Largest log odds of a slip, where there was none.
        threshold: Log odds from which a contact of this unit counts as slipping.

    Raises:
        TouchError: A number is not finite or out of range.
    """

    sensor: str
    unit: str
    date: str
    num_frames: int
    along_mm: float
    depth_mm: float
    largest_score: float
    threshold: float

    def __post_init__(self) -> None:
        numbers = (self.along_mm, self.depth_mm, self.largest_score, self.threshold)
        is_sound = all(map(math.isfinite, numbers)) and min(self.along_mm, self.depth_mm) >= 0
        if not (is_sound and self.num_frames > 0 and self.threshold >= self.largest_score):
            raise TouchError(
                "a slip calibration needs finite numbers, noise of 0 or more, and a threshold "
                f"above the largest score; got {self}"
            )


def calibrate_slip(
    hold: Sequence[ShearField], unload: Sequence[ShearField], *, sensor: str, unit: str, date: str
) -> SlipCalibration:
    """The calibration from the frames of a hold at rest and of the unload after it.

    Raises:
        TouchError: Too few frames, nothing is touched, or scores as of a slip.
    """
    model = slip_model(sensor)
    along_mm, depth_mm = noise_of(hold)
    watch = ShearWatch(hold[0].sensor, along_mm, depth_mm)
    cues = [watch.see(field) for field in [*hold, *unload]]
    judge = SlipJudge(model, hold[0].sensor.frame_hz, threshold=0.0)
    scores = [judge.see(each.values) for each in cues if each is not None]
    if not scores:
        raise TouchError("nothing was touched during the hold; put an object between the fingers")
    largest = max(scores)
    if largest > model.threshold + MAX_RAISE:
        raise TouchError(
            f"the hold scored up to {largest:.1f}, a slip begins at {model.threshold:.1f}: the "
            "object moved, or points of the sensor are wrong; hold it still and repeat"
        )
    return SlipCalibration(
        sensor=sensor,
        unit=unit,
        date=date,
        num_frames=len(cues),
        along_mm=along_mm,
        depth_mm=depth_mm,
        largest_score=largest,
        threshold=max(model.threshold, largest + MARGIN),
    )


def save_slip_calibration(path: Path, calibration: SlipCalibration) -> None:
    """Write a calibration as JSON, whole or not at all.

    Raises:
        OSError: The file can't be written.
    """
    record = {"kind": KIND, "version": VERSION, **asdict(calibration)}
    write_atomically(path, json.dumps(record, indent=2) + "\n")


def load_slip_calibration(path: Path, sensor: str | None) -> SlipCalibration:
    """Read the calibration of a sensor; None takes that of any.

    Raises:
        TouchError: Missing, damaged, of another kind or version, of another sensor, without a date,
            or with a threshold that no calibration gives.
    """
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise TouchError(f"{path} is too large for a slip calibration")
        record = json.loads(path.read_bytes().decode("utf-8"))
    except OSError as error:
        raise TouchError(f"no slip calibration at {path}: {error.strerror}; {ADVICE}") from None
    except (ValueError, RecursionError):
        raise TouchError(f"{path} is damaged; {ADVICE}") from None
    if not isinstance(record, dict) or record.pop("kind", None) != KIND:
        raise TouchError(f"{path} is no slip calibration: expected JSON of kind {KIND}; {ADVICE}")
    version, names = record.pop("version", None), {field.name for field in fields(SlipCalibration)}
    if version != VERSION or record.keys() != names:
        raise TouchError(f"{path} is of another version ({version!r}) or changed; {ADVICE}")
    for name in names:
        is_text = name in ("sensor", "unit", "date")
        kinds = (str,) if is_text else (int,) if name == "num_frames" else (int, float)
        if not isinstance(record[name], kinds) or isinstance(record[name], bool):
            raise TouchError(f"{path}: {name} is {record[name]!r}; {ADVICE}")
    if sensor is not None and record["sensor"] != sensor:
        raise TouchError(f"{path} is of {record['sensor']}, this sensor is {sensor}; {ADVICE}")
    try:
        datetime.date.fromisoformat(record["date"])
    except ValueError:
        raise TouchError(f"{path}: date is {record['date'][:40]!r}; {ADVICE}") from None
    found = SlipCalibration(**record)
    most = slip_model(found.sensor).threshold + MAX_RAISE + MARGIN
    if found.threshold > most:
        raise TouchError(
            f"{path}: threshold is {found.threshold:g}, at most {most:g} is one of {found.sensor}; "
            f"{ADVICE}"
        )
    return found


def load_unit_slip(
    path: Path, *, sensor: str | None, unit: str, today: datetime.date
) -> SlipCalibration:
    """Read the calibration of a unit, and refuse another one's, an old one and one of the future.

    Args:
        path: Its file.
        sensor: Name of the sensor's model; None takes any.
        unit: Name of the unit.
        today: Present day.

    Raises:
        TouchError: As ``load_slip_calibration``, or one of these.
    """
    found = load_slip_calibration(path, sensor)
    if found.unit != unit:
        raise TouchError(f"{path} is of unit {found.unit!r}, this one is {unit!r}; {ADVICE}")
    age_days = (today - datetime.date.fromisoformat(found.date)).days
    if not 0 <= age_days <= MAX_AGE_DAYS:
        raise TouchError(
            f"{path} is {age_days} days old, expected 0 to {MAX_AGE_DAYS:g}: {ADVICE}; if it is "
            "new, set the clock"
        )
    return found
