"""A sensor's photometric calibration: one small safetensors file with a record of its origin.

Loading is strict: another version, another sensor or a missing number is refused, never repaired.

Not here: making one (``cltp.train.photometric``), using one (``cltp.sensing.photometric``).
"""

from __future__ import annotations

import datetime
import hashlib
import json
import math
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file

from cltp.atomic_write import replacing
from cltp.errors import TouchError
from cltp.sensing.photometric import GradientNet
from cltp.tactile.sensors import SensorSpec

VERSION = 2
_WITHOUT_BRIGHTENING = 1
"""The version before light grew with depth: its files are read with none."""

_KEY = "tacgrasp_calibration"
_MAX_BYTES = 1_000_000  # ours has 8 kB; a file far beyond that is something else

SHIPPED_SHA256 = {
    "gelsight_mini": "22195a618ee7f0a3d3931814cce7de4c8a4b612768976a0baefc18a88ba9b6e8",
}
"""SHA-256 of the shipped calibrations: a damaged one would give wrong heights in silence."""

WITHOUT_DOTS = {"gelsight_mini_markers": "gelsight_mini"}
"""Sensors whose gel has dots, and those of the same camera and lamps without: their calibrations
are the same."""


def calibrated_as(sensor: SensorSpec) -> str:
    """Name of the sensor whose calibrations fit this one: its own, or that without dots."""
    return WITHOUT_DOTS.get(sensor.name, sensor.name)


@dataclass(frozen=True, slots=True, kw_only=True)
class Calibration:
    """A trained network and its origin.

    Attributes:
        net: The network.
        sensor: Name of the sensor's model.
        unit: Name that the person who calibrated the unit gave it.
        date: Day of the calibration, ISO 8601.
        ball_diameter_mm: Diameter of the pressed ball [mm].
        num_frames: Presses in the training.
        residual: Misfit of the slopes under the ball, root mean square [mm per mm].
        seed: Random seed of the training.
        source: Origin of the frames.

    Raises:
        TouchError: A value is out of its range.
    """

    net: GradientNet
    sensor: str
    unit: str
    date: str
    ball_diameter_mm: float
    num_frames: int
    residual: float
    seed: int
    source: str

    def __post_init__(self) -> None:
        try:
            datetime.date.fromisoformat(self.date)
        except (TypeError, ValueError):
            raise TouchError(
                f"calibration: date must be like 2026-01-31, got {self.date!r}"
            ) from None
        if not (0 < self.ball_diameter_mm < math.inf and 0 <= self.residual < math.inf):
            raise TouchError(
                "calibration: ball_diameter_mm must be > 0 and residual >= 0, both finite; got "
                f"{self.ball_diameter_mm} and {self.residual}"
            )
        if self.num_frames < 1:
            raise TouchError(f"calibration: num_frames must be >= 1, got {self.num_frames}")

    def age_days(self, today: datetime.date) -> int:
        return (today - datetime.date.fromisoformat(self.date)).days


def default_calibration(sensor: SensorSpec) -> Path:
    """File of the shipped calibration of a sensor's model: another unit's, so heights are rough.

    Raises:
        TouchError: None ships for this model, or the file is not the one that shipped.
    """
    name = calibrated_as(sensor)
    path = Path(__file__).parent / "calibrations" / f"{name}.safetensors"
    if name not in SHIPPED_SHA256 or not path.is_file():
        raise TouchError(f"no calibration ships for {sensor.name}; make one and give its file")
    if hashlib.sha256(path.read_bytes()).hexdigest() != SHIPPED_SHA256[name]:
        raise TouchError(f"{path} is damaged: it is not the file that shipped; install again")
    return path


def save_calibration(path: Path, calibration: Calibration) -> None:
    """Write a calibration, whole or not at all.

    Raises:
        OSError: The file can't be written.
    """
    record = {f.name: getattr(calibration, f.name) for f in fields(calibration) if f.name != "net"}
    metadata = {_KEY: json.dumps({"version": VERSION, **record}, sort_keys=True)}
    with replacing(path) as part:
        save_file(asdict(calibration.net), part, metadata=metadata)


def load_calibration(path: Path, sensor: SensorSpec, unit: str | None = None) -> Calibration:
    """Read a calibration for a model of sensor and, unless it is None, a ``unit``.

    Raises:
        TouchError: Missing, damaged, not a calibration, of another version, sensor or unit.
    """
    if not path.is_file():
        raise TouchError(
            f"calibration {path} does not exist; make it: tacgrasp calibrate gelsight-mini"
        )
    if path.stat().st_size > _MAX_BYTES:
        raise TouchError(f"calibration {path} is too large to be one: {path.stat().st_size} bytes")
    try:
        with safe_open(path, framework="np") as file:
            text = (file.metadata() or {}).get(_KEY)
            arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
    except (SafetensorError, OSError, TypeError) as error:
        raise TouchError(f"calibration {path} is damaged or no calibration: {error}") from None
    try:
        return _calibration(text, arrays, sensor, unit)
    except TouchError as error:
        raise TouchError(f"{path}: {error}") from None


def _calibration(
    text: str | None, arrays: dict[str, object], sensor: SensorSpec, unit: str | None
) -> Calibration:
    try:
        record = json.loads(text or "null")
    except ValueError:
        record = None
    if not isinstance(record, dict):
        raise TouchError("safetensors, but not a calibration: it lacks our record")
    version = record.pop("version", None)
    if version not in (VERSION, _WITHOUT_BRIGHTENING):
        raise TouchError(
            f"calibration of version {version}, expected {VERSION} or {_WITHOUT_BRIGHTENING}; "
            "calibrate anew with this version of tacgrasp"
        )
    types = {f.name: f.type for f in fields(Calibration) if f.name != "net"}
    if record.keys() != types.keys():
        raise TouchError(f"calibration: expected fields {sorted(types)}, got {sorted(record)}")
    for name, kind in types.items():
        value = record[name]
        if type(value).__name__ != kind and not (kind == "float" and type(value) is int):
            raise TouchError(f"calibration: {name} must be {kind}, got {value!r}")
    if record["sensor"] != calibrated_as(sensor):
        raise TouchError(
            f"calibration of a {record['sensor']}, expected {sensor.name}; name the right file"
        )
    if unit is not None and record["unit"] != unit:
        raise TouchError(
            f"calibration of unit {record['unit']!r}, expected {unit!r}; calibrate this unit"
        )
    names = {f.name for f in fields(GradientNet)}
    if version == _WITHOUT_BRIGHTENING:
        names.remove("brightening")
    if arrays.keys() != names:
        raise TouchError(f"calibration: expected arrays {sorted(names)}, got {sorted(arrays)}")
    return Calibration(net=GradientNet(**arrays), **record)  # type: ignore[arg-type]
