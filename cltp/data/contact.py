"""One labelled contact of a data set, and the packing of its height map into bytes.

Not here: files of contacts (``cltp.data.dataset``), noise (``cltp.tactile.sensor_noise``): stored
heights are clean.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.cloud import checked_heights
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import ContactState

UNIT_MM = 0.001
"""Step of a stored height [mm]. Our choice: a tenth of the finest noise of a real sensor."""

LARGEST_MM = 32.7
"""Largest height that 16 bits of ``UNIT_MM`` hold [mm]."""

_ZSTD = pa.Codec("zstd", compression_level=3)


class Split(StrEnum):
    """Use of a contact: training, validation, or a test of one kind."""

    TRAIN = "train"
    VALIDATION = "validation"
    TEST = "test"  # other contacts of the same objects, under the same gels: the paper's
    OBJECT = "object"  # objects that are not in training
    PHYSICS = "physics"  # gels that are not in training
    GELSTEREO = "gelstereo"  # like the paper's GelStereo contacts
    GELSIGHT = "gelsight"  # like the paper's GelSight contacts


@dataclass(frozen=True, slots=True, kw_only=True)
class Gel:
    """Properties of the gel that was pressed.

    Attributes:
        thickness_mm: Thickness [mm].
        young_mpa: Young's modulus [MPa].
        poisson: Poisson's ratio.

    Raises:
        TouchError: A value is not finite or not positive.
    """

    thickness_mm: float
    young_mpa: float
    poisson: float

    def __post_init__(self) -> None:
        for name in ("thickness_mm", "young_mpa", "poisson"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise TouchError(f"gel: {name} must be positive, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Contact:
    """A labelled contact.

    Attributes:
        height_mm: Shape (H, W), float32, read-only; indentation without noise over the whole
            sensing area [mm], row 0 = top, 0 = the undeformed gel.
        sensor: Model of the sensor.
        state: The truth in numbers and words; shape and texture None if not named.
        object: Name of the object; splits are made by object or by series, never by contact.
        series: Contacts of one object in one pose share a series: presses of growing depth.
        split: Use of the contact.
        gel: The gel that was pressed; None for a real contact.
        seed: Random seed that reproduces the contact; 0 for a real contact.
        unsure: Dimensions so near another class that a careful person might choose that one; None
            if this was not determined.
        measured: Columns without a given label, which were measured from the noisy heights; only
            imported contacts have such.
        approach_mm: Path of the undeformed body into the undeformed gel [mm].
        peak_kpa: Largest pressure [kPa].
        force_factor: Force of this gel over that of the sensor's nominal gel at equal indentation;
            None for a real contact.

    Raises:
        TouchError: Heights of a wrong shape, not finite, or beyond ``LARGEST_MM``; negative series.
    """

    height_mm: NDArray[np.float32]
    sensor: SensorSpec
    state: ContactState
    object: str
    series: int
    split: Split
    gel: Gel | None = None
    seed: int = 0
    unsure: frozenset[str] | None = None
    approach_mm: float | None = None
    peak_kpa: float | None = None
    force_factor: float | None = None
    measured: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        heights = checked_heights(self.height_mm).astype(np.float32)
        if np.abs(heights).max() > LARGEST_MM:
            raise TouchError(f"heights beyond ±{LARGEST_MM} mm can't be stored; are they in µm?")
        if self.force_factor is not None and not 0 < self.force_factor < math.inf:
            raise TouchError(f"force_factor must be positive, got {self.force_factor}")
        if self.series < 0:
            raise TouchError(f"series must not be negative, got {self.series}")
        heights.setflags(write=False)
        object.__setattr__(self, "height_mm", heights)


def pack_heights(height_mm: NDArray[np.float32]) -> bytes:
    """Compress heights [mm] to bytes: steps of ``UNIT_MM``, differences, byte planes, zstd."""
    steps = np.rint(height_mm / np.float32(UNIT_MM)).astype(np.int16)
    steps[:, 1:] -= steps[:, :-1].copy()  # may wrap around, and wraps back when it is read
    steps[1:] -= steps[:-1].copy()
    planes = np.ascontiguousarray(steps).view(np.uint8).reshape(-1, 2).T
    return bytes(_ZSTD.compress(np.ascontiguousarray(planes).tobytes(), asbytes=True))


def unpack_heights(packed: bytes | memoryview, rows: int, columns: int) -> NDArray[np.float32]:
    """Heights [mm], shape (rows, columns), from the bytes of ``pack_heights``.

    Raises:
        TouchError: The bytes are damaged.
    """
    size = 2 * rows * columns
    try:
        raw = _ZSTD.decompress(bytes(packed), decompressed_size=size, asbytes=True)
    except (OSError, pa.ArrowException) as error:
        raise TouchError(f"a stored height map is damaged: {error}") from error
    if len(raw) != size:
        raise TouchError(f"a stored height map has {len(raw)} bytes where {size} were expected")
    planes = np.frombuffer(raw, dtype=np.uint8).reshape(2, -1)
    steps = np.ascontiguousarray(planes.T).view(np.int16).reshape(rows, columns)
    steps = np.cumsum(steps, axis=0, dtype=np.int16)
    steps = np.cumsum(steps, axis=1, dtype=np.int16)
    return steps.astype(np.float32) * np.float32(UNIT_MM)
