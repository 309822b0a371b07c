"""Errors of a sensor on its shear field: of the unit, and new in every frame.

No sensor here measures forces on its points: a field that was read has none.

Not here: errors of heights (``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from cltp.errors import TouchError
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField

MIN_POINTS = 4
"""Fewest points of a field that is read. Our choice: as many as motion and strain need."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearSpread:
    """How the units of a model of sensor differ.

    Attributes:
        along_mm, depth_mm: Range of the standard deviation of a point's displacement along the
            surface and into the gel, new in every frame, log-uniform [mm].
        scale: Largest error of the factor on displacements.
        loss: Largest fraction of the points that a frame misses.
        step_mm: Step in which displacements are given; 0 for any [mm].
    """

    along_mm: tuple[float, float]
    depth_mm: tuple[float, float]
    scale: float
    loss: float
    step_mm: float


SPREADS: dict[str, ShearSpread] = {
    # Along: 0.05 to 0.1 px of 0.0634 mm; 0.1 px is what the makers of TacFlex state for their
    # markers, the half is assumed for dots that are several pixels wide. Depth: from 0.5 µm to the
    # 10 µm of the heights' fine noise. Loss: Marknet (arXiv 2211.13428) finds 93.9 % of the markers
    # in contact. Scale: assumed, since a pixel is smaller where the gel is pressed.
    "gelsight_mini_markers": ShearSpread(
        along_mm=(0.0032, 0.0063), depth_mm=(0.0005, 0.010), scale=0.03, loss=0.06, step_mm=0.0
    ),
    # Assumed, since no array in particular is meant: up to a tenth of the 0.2 mm by which a held
    # berry shears a gel, and down to a hundredth; whole counts [µm]; a dead taxel still sends.
    "taxels": ShearSpread(
        along_mm=(0.002, 0.020), depth_mm=(0.002, 0.020), scale=0.10, loss=0.0, step_mm=0.001
    ),
}
"""By the names of ``cltp.tactile.sensors.SENSORS``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearUnit:
    """Errors of one unit; without arguments, those of a perfect one.

    Attributes:
        along_mm, depth_mm: Standard deviations of a frame, as in ``ShearSpread`` [mm].
        scale: Factor on displacements.
        loss: Probability that a frame misses a point.
        step_mm: As in ``ShearSpread``.
    """

    along_mm: float = 0.0
    depth_mm: float = 0.0
    scale: float = 1.0
    loss: float = 0.0
    step_mm: float = 0.0

    @classmethod
    def draw(cls, rng: np.random.Generator, sensor: SensorSpec, level: float = 1.0) -> ShearUnit:
        """Draw a unit.

        Args:
            rng: Source of the draws.
            sensor: A sensor that measures shear.
            level: Factor on all errors but the step; 0 is a perfect unit.

        Raises:
            TouchError: The sensor measures no shear, or the level is negative or not finite.
        """
        spread = SPREADS.get(sensor.name)
        if spread is None:
            names = ", ".join(sorted(SPREADS))
            raise TouchError(f"no noise of shear known for {sensor.name!r}; known: {names}")
        if not 0 <= level < math.inf:
            raise TouchError(f"noise of shear needs a level of 0 or more, got {level}")
        along, depth = (
            math.exp(rng.uniform(math.log(low), math.log(high)))
            for low, high in (spread.along_mm, spread.depth_mm)
        )
        return cls(
            along_mm=level * along,
            depth_mm=level * depth,
            scale=max(0.05, 1.0 + level * rng.uniform(-spread.scale, spread.scale)),
            loss=min(0.9, level * rng.uniform(0.0, spread.loss)),
            step_mm=spread.step_mm,
        )

    def apply(self, field: ShearField, rng: np.random.Generator, *, frames: int = 1) -> ShearField:
        """A true field as this unit reads it: displacements alone, of the points that it finds.

        Args:
            field: The true field.
            rng: Draws the errors of the frame.
            frames: Frames that the reading is the mean of.

        Raises:
            TouchError: Fewer points than ``MIN_POINTS`` were found.
        """
        found = rng.random(len(field.positions_mm)) >= self.loss
        if found.sum() < MIN_POINTS:
            raise TouchError(
                f"{int(found.sum())} of {len(found)} points of {field.sensor.name} were found; at "
                f"least {MIN_POINTS} are needed: read again"
            )
        deviation = np.array([self.along_mm, self.along_mm, self.depth_mm]) / math.sqrt(frames)
        moved = self.scale * field.displacement_mm[found].astype(np.float64)
        moved += deviation * rng.standard_normal(moved.shape)
        if self.step_mm > 0:
            moved = self.step_mm * np.rint(moved / self.step_mm)
        return dataclasses.replace(
            field,
            positions_mm=field.positions_mm[found],
            displacement_mm=moved.astype(np.float32),
            force_n=None,
        )
