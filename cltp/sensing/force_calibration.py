"""A unit's force calibration: known loads on its pad, and the factor that they give.

The factor makes newtons of nominal newtons (``cltp.tactile.force_scale``). The file is small JSON,
read strictly: another version, sensor or unit, an unknown field, or a factor that is not that of
its loads is refused, never repaired.

Not here: putting loads on a pad (``tacgrasp.bringup.force_loads``).
"""

from __future__ import annotations

import datetime
import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from itertools import pairwise
from pathlib import Path
from typing import Any

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError
from cltp.tactile.force_scale import MAX_FACTOR, ForceScale

VERSION = 1
KIND = "tacgrasp-force-calibration"

MIN_LOADS = 3
MAX_LOADS = 50
MIN_RANGE = 3.0
"""Least ratio of the largest to the smallest load: less can't tell a factor from an offset."""
MAX_LOAD_N = 100.0
MAX_SPREAD = 0.30
"""Largest relative residual. Above it the pad is dirty, the sensor drifts, or it is another one."""
MAX_AGE_DAYS = 180.0
"""Largest age [days] unless a rig's file says otherwise: gels stiffen and wear. Our choice."""

ADVICE = "calibrate: tacgrasp calibrate force"
_MAX_BYTES = 100_000  # ours has 1 kB


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceLoad:
    """One load on the pad.

    Attributes:
        load_n: Known force [N].
        read_n: Force read from the gel's heights [nominal N].
    """

    load_n: float
    read_n: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceCalibration:
    """The fit of one unit, made by ``fit_force``.

    Attributes:
        sensor: Name of the sensor's model.
        unit: Name of the unit in its rig's file.
        date: Day of the measurement, ISO 8601.
        loads: Loads and what was read, rising.
        factor: Newtons per nominal newton.
        spread: Relative residual: standard deviation of ln F around the fit.
        source: Origin of the loads.
    """

    sensor: str
    unit: str
    date: str
    loads: tuple[ForceLoad, ...]
    factor: float
    spread: float
    source: str

    @property
    def residuals(self) -> tuple[float, ...]:
        """Fitted over known load less 1, of each load."""
        return tuple(self.factor * load.read_n / load.load_n - 1 for load in self.loads)

    @property
    def scale(self) -> ForceScale:
        """What a cloud of this unit carries."""
        source = f"{self.unit}, {self.date}"
        return ForceScale(factor=self.factor, spread=self.spread, source=source)

    def age_days(self, today: datetime.date) -> int:
        return (today - datetime.date.fromisoformat(self.date)).days


def fit_force(
    loads: Sequence[ForceLoad], *, sensor: str, unit: str, date: datetime.date, source: str = ""
) -> ForceCalibration:
    """Fit the factor by least squares of ln F: every load counts by its relative error.

    Raises:
        TouchError: Too few loads, out of order, not positive, without range, read forces that do
            not rise with them or fit no factor.
    """
    _check_loads(loads)
    logs = [math.log(load.load_n / load.read_n) for load in loads]
    mean = sum(logs) / len(logs)
    factor = math.exp(mean)
    spread = math.sqrt(sum((each - mean) ** 2 for each in logs) / (len(logs) - 1))
    if spread > MAX_SPREAD:
        worst = max(zip(logs, loads, strict=True), key=lambda pair: abs(pair[0] - mean))[1]
        raise TouchError(
            f"the loads leave a residual of {spread:.0%}, at most {MAX_SPREAD:.0%} is a fit (worst "
            f"at {worst.load_n:g} N); clean the pad, check that the rig's file names this sensor, "
            "and repeat"
        )
    if not 1 / MAX_FACTOR <= factor <= MAX_FACTOR:
        raise TouchError(
            f"the loads are {factor:.3g} times what is read, expected {1 / MAX_FACTOR:g} to "
            f"{MAX_FACTOR:g}; check that loads are in newtons and that the rig's file names this "
            "sensor"
        )
    return ForceCalibration(
        sensor=sensor,
        unit=unit,
        date=date.isoformat(),
        loads=tuple(loads),
        factor=factor,
        spread=spread,
        source=source,
    )


def check_load_values(loads_n: Sequence[float]) -> None:
    """Check known loads [N] before any of them is put on the pad.

    Raises:
        TouchError: Too few or too many, not positive, out of order, or without range.
    """
    listed = " ".join(f"{load:g}" for load in loads_n) or "none"
    if not MIN_LOADS <= len(loads_n) <= MAX_LOADS:
        raise TouchError(
            f"a force calibration needs {MIN_LOADS} to {MAX_LOADS} loads, got {len(loads_n)} "
            f"({listed}); give more, like 0.5 1 2 5"
        )
    if not all(0 < load <= MAX_LOAD_N for load in loads_n):
        raise TouchError(
            f"loads are above 0 N and at most {MAX_LOAD_N:g} N, got {listed}; give newtons "
            "(100 g weigh 0.981 N)"
        )
    if any(b <= a for a, b in pairwise(loads_n)):
        raise TouchError(
            f"loads must rise, got {listed}; give each once, the smallest first: a gel "
            "remembers a larger one"
        )
    if loads_n[-1] < MIN_RANGE * loads_n[0]:
        raise TouchError(
            f"the largest load must be {MIN_RANGE:g} times the smallest or more, got {listed}; "
            "spread them, like 0.5 1 2 5"
        )


def _check_loads(loads: Sequence[ForceLoad]) -> None:
    check_load_values([load.load_n for load in loads])
    for load in loads:
        if not (math.isfinite(load.read_n) and load.read_n > 0):
            raise TouchError(
                f"at {load.load_n:g} N the sensor reads {load.read_n:g} N, expected more than 0; "
                "put the load on the middle of the pad and repeat"
            )
    for before, after in pairwise(loads):
        if after.read_n <= before.read_n:
            raise TouchError(
                f"the read force must rise with the load, but it is {before.read_n:.3g} N at "
                f"{before.load_n:g} N and {after.read_n:.3g} N at {after.load_n:g} N; seat the "
                "weights anew and repeat"
            )


def save_force_calibration(path: Path, calibration: ForceCalibration) -> None:
    """Write a calibration as JSON, whole or not at all.

    Raises:
        OSError: The file can't be written.
    """
    record = {"kind": KIND, "version": VERSION, **asdict(calibration)}
    write_atomically(path, json.dumps(record, indent=2) + "\n")


def load_force_calibration(path: Path) -> ForceCalibration:
    """Read a calibration.

    Raises:
        TouchError: Missing, damaged, of another kind or version, or changed by hand.
    """
    if not path.is_file():
        raise TouchError(f"no force calibration at {path}; {ADVICE}")
    if path.stat().st_size > _MAX_BYTES:
        raise TouchError(
            f"{path} is too large for a force calibration: {path.stat().st_size} bytes"
        )
    try:
        return _parsed(path.read_bytes())
    except OSError as error:
        raise TouchError(f"force calibration {path} can't be read: {error.strerror}") from None
    except TouchError as error:
        raise TouchError(f"{path} is no force calibration: {error}; {ADVICE}") from None


def _parsed(data: bytes) -> ForceCalibration:
    try:
        record = json.loads(data.decode("utf-8"), object_pairs_hook=_once, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise TouchError(f"damaged ({' '.join(str(error).split())[:120]})") from None
    if not isinstance(record, dict) or record.pop("kind", None) != KIND:
        raise TouchError(f"expected JSON of kind {KIND}")
    version = record.pop("version", None)
    if version != VERSION:
        raise TouchError(f"version {version!r}, expected {VERSION}")
    loads = record.get("loads")
    if not isinstance(loads, list) or len(loads) > MAX_LOADS:
        raise TouchError(f"loads must be a list of at most {MAX_LOADS}")
    record["loads"] = tuple(ForceLoad(**_checked(load, ForceLoad)) for load in loads)
    found = ForceCalibration(**_checked(record, ForceCalibration))
    fitted = fit_force(
        found.loads,
        sensor=found.sensor,
        unit=found.unit,
        date=_date(found.date),
        source=found.source,
    )
    for name in ("factor", "spread"):
        if not math.isclose(getattr(found, name), getattr(fitted, name), abs_tol=1e-6):
            raise TouchError(
                f"its {name} is {getattr(found, name):g}, its loads give "
                f"{getattr(fitted, name):g}: it was changed by hand"
            )
    return fitted


def _checked(record: Any, kind: type) -> dict[str, Any]:
    """Fields of a JSON object, each once and of the dataclass's type."""
    types = {"float": float, "str": str}
    expected = [field.name for field in fields(kind)]
    if not isinstance(record, dict) or sorted(record) != sorted(expected):
        raise TouchError(f"expected the fields {', '.join(expected)}")
    for field in fields(kind):
        value, wanted = record[field.name], types.get(str(field.type))
        if wanted is float and type(value) is int:
            record[field.name] = value = float(value)
        if wanted is not None and type(value) is not wanted:
            raise TouchError(f"{field.name} must be {field.type}, got {str(value)[:40]!r}")
    return record


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    record = dict(pairs)
    if len(record) < len(pairs):
        raise ValueError("a field stands twice")
    return record


def _refuse(text: str) -> None:
    raise ValueError(f"{text} is no number")


def _date(text: str) -> datetime.date:
    try:
        return datetime.date.fromisoformat(text)
    except ValueError:
        raise TouchError(f"date must be like 2026-01-31, got {text[:40]!r}") from None


def force_refusal(
    calibration: ForceCalibration,
    *,
    sensor: str,
    unit: str,
    today: datetime.date,
    max_age_days: float = MAX_AGE_DAYS,
) -> str:
    """Reason to refuse a calibration for this unit and day; empty for none."""
    for name, calibrated, connected in (
        ("sensor", calibration.sensor, sensor),
        ("unit", calibration.unit, unit),
    ):
        if calibrated != connected:
            return (
                f"the force calibration is of another {name}: of {calibrated}, this one is "
                f"{connected}; name its own file, or {ADVICE}"
            )
    age_days = calibration.age_days(today)
    if age_days < 0:
        return (
            f"the force calibration is dated {calibration.date}, after today ({today}); check "
            "this computer's clock"
        )
    if age_days > max_age_days:
        return (
            f"the force calibration is {age_days} days old, at most {max_age_days:g} are allowed; "
            f"make a new one: tacgrasp calibrate force"
        )
    return ""
