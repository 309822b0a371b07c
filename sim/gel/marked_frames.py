"""Frames of a camera behind a gel with dots: a sheared, pressed surface under coloured lamps.

Three lamps light the gel from its sides, so that a slope changes its colour; dots are dark, and
move with the surface. A crude picture: enough for what finds and follows dots, with errors that a
real camera has.

Not here: what the dots of a sensor should measure (``sim.gel.shear.sensed``), the reading of frames
(``cltp.sensing``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.sensing.frames import Frame
from cltp.sensing.photometric import COLOUR_SCALE, GradientNet
from cltp.tactile.cloud import FloatArray, grid_axes_mm, heights_at
from cltp.tactile.sensors import SensorSpec

LEVELS = (78.0, 95.0, 105.0)
"""Mean levels of red, green and blue of the untouched gel: those of the GelSight Mini whose ball
presses we have."""

FALL_OFF = (0.6, 0.2, 0.4)
"""Change of each lamp's light from one side to the other, over its mean. There, about."""

LEVELS_PER_SLOPE = 100.0
"""Change of a lamp's colour with the slope towards it. Our choice: a ball changes colours by 30
levels there."""

NOISE_LEVELS = 2.0
"""Standard deviation of a pixel from frame to frame: 1.5 to 2.5 levels there."""

ALBEDO = 0.15
"""Light that a dot gives back, over the gel's. Assumed."""

EDGE_PX = 0.7
"""Width over which a dot's edge is blurred [px]. Assumed."""

LAMPS = tuple((math.cos(a), math.sin(a)) for a in (0.0, 2 * math.pi / 3, 4 * math.pi / 3))
"""Directions from which red, green and blue come, (x, y) gel frame."""


def lamps_net() -> GradientNet:
    """The photometric network that tells slopes from these lamps' colours, without any error."""
    lamps = LEVELS_PER_SLOPE * np.array(LAMPS) * (1.0, -1.0)  # a frame's rows go down
    shapes = {"w1": (5, 1), "b1": (1,), "w2": (1, 1), "b2": (1,), "w3": (1, 6)}
    back = COLOUR_SCALE * np.linalg.pinv(lamps).ravel()
    return GradientNet(
        **{name: np.zeros(shape, np.float32) for name, shape in shapes.items()},
        b3=back.astype(np.float32),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MarkedGel:
    """One unit of a gel with dots.

    Attributes:
        sensor: Its model, with a ``shear_grid`` of dots.
        dots_mm: Shape (N, 2): the dots on the untouched gel, row by row, gel frame [mm].
        radius_mm: Radius of a dot [mm].
        noise_levels: Standard deviation of a pixel from frame to frame.
    """

    sensor: SensorSpec
    dots_mm: FloatArray
    radius_mm: float
    noise_levels: float = NOISE_LEVELS

    @classmethod
    def draw(cls, sensor: SensorSpec, rng: np.random.Generator) -> MarkedGel:
        """Draw a unit: dots of 0.2 to 0.4 mm radius, in a lattice that is not quite the nominal.

        Ranges are assumed: pitch within 4 %, offset 0.3 mm, turn 0.02, each dot 0.03 mm.
        """
        rows, columns = sensor.shear_grid or (0, 0)
        x, y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(sensor, rows, columns)))
        scale, turn = rng.uniform(0.96, 1.0), rng.uniform(-0.02, 0.02)
        offset = rng.uniform(-0.3, 0.3, 2)
        dots = scale * np.stack([x - turn * y, y + turn * x], axis=1) + offset
        return cls(
            sensor=sensor,
            dots_mm=dots + rng.normal(0.0, 0.03, dots.shape),
            radius_mm=rng.uniform(0.2, 0.4),
        )

    def moved_mm(self, along_mm: NDArray[np.floating]) -> FloatArray:
        """Displacement of each dot (N, 2) in a field (2, H, W) over the sensing area [mm]."""
        x, y = self.dots_mm.T
        return np.stack([heights_at(each, x, y, self.sensor) for each in along_mm], axis=1)

    def frame(
        self,
        height_mm: NDArray[np.floating],
        along_mm: NDArray[np.floating],
        rng: np.random.Generator,
    ) -> Frame:
        """The camera's picture of a pressed and sheared gel, (rows, columns, 3) uint8.

        Args:
            height_mm: Indentation, (rows, columns) [mm].
            along_mm: Displacement along the gel, (2, rows, columns): x and y, gel frame [mm].
            rng: Draws the noise of the pixels.
        """
        spec = self.sensor
        down, right = np.gradient(np.asarray(height_mm, dtype=np.float64), spec.mm_per_px)
        u, v = np.meshgrid(np.linspace(-1, 1, spec.columns), np.linspace(-1, 1, spec.rows))
        dark = self.dots_over(np.asarray(along_mm, dtype=np.float64))
        image = np.empty((spec.rows, spec.columns, 3))
        for colour, (x, y) in enumerate(LAMPS):
            light = LEVELS[colour] * (1 + FALL_OFF[colour] * (x * u - y * v))
            light = light + LEVELS_PER_SLOPE * (x * right - y * down)
            image[:, :, colour] = np.clip(light, 20.0, 255.0) * (1 - (1 - ALBEDO) * dark)
        image += rng.normal(0.0, self.noise_levels, image.shape)
        return np.clip(np.rint(image), 0, 255).astype(np.uint8)

    def dots_over(self, along_mm: FloatArray) -> FloatArray:
        """Fraction of each pixel that is a dot, (rows, columns)."""
        spec = self.sensor
        x, y = np.meshgrid(*grid_axes_mm(spec, spec.rows, spec.columns))
        at_x, at_y = x, y
        for _ in range(4):  # the point of the untouched gel that is seen here
            moved = [heights_at(each, at_x, at_y, spec) for each in along_mm]
            at_x, at_y = x - moved[0], y - moved[1]
        dark = np.zeros(at_x.shape)
        for dot_x, dot_y in self.dots_mm:
            near = (np.abs(at_x - dot_x) < 2 * self.radius_mm) & (
                np.abs(at_y - dot_y) < 2 * self.radius_mm
            )
            inside_px = (
                self.radius_mm - np.hypot(at_x[near] - dot_x, at_y[near] - dot_y)
            ) / spec.mm_per_px
            dark[near] = np.maximum(dark[near], 1 / (1 + np.exp(-inside_px / (EDGE_PX / 2))))
        return dark
