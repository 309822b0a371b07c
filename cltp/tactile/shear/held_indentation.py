"""How far a held contact has grown and moved since it was at rest, without the gel's slow drift.

Heights drift within a hold: by as much as a light contact is deep, in four seconds. Drift is broad,
a contact is not, so that a smooth surface through the change of the points far around the contact
is taken from all of them: where a contact grows into, its growth would be taken for drift. What a
sensor feels in one frame is then the force before, times the growth.
An object that creeps, by so little in each frame that no frame shows it, has moved in the end.

Not here: the force of a contact at rest (``cltp.tactile.measure``), the cues of slip in single
frames (``cltp.tactile.shear.contact_shear``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.contact_shape import BODY_LEVEL, ContactShape, above_level, grid_of
from cltp.tactile.shear.contact_shear import HEIGHT_MEMORY
from cltp.tactile.shear.field import ShearField

CONTACT = 0.1
"""Fraction of the depth from which a point belongs to the contact or its rim. Our choice."""

FAR_REACH = 2.7
"""Distance from a contact's middle, in its ellipse, from which points tell the drift; a sphere's
contact ends at 1.2. Our choice: of 2.2 to 3.0 on simulated contacts whose force doubled or tripled,
the one with the least error. A force that is eight times as large has a contact twice as wide."""

MIN_AROUND, MIN_LEVEL = 60, 12
"""Fewest points around a contact that tell a curved drift, ten for each of its numbers, and a tilt.
With fewer, none is taken away."""

_GROWTH_POWERS = {"gelsight_mini_markers": 1.09}
"""Power of the growth of the volume that is that of the force, where the contact has grown; 1 for
other sensors. Source: simulated contacts of four kinds of bodies whose force became 1.3 to 3 times
as large; ``tacgrasp bench growth`` prints it fitted anew, and the residual."""

MEAN_FRAMES = 10
"""Frames of a force that has changed after which the place is that of the mean. Our choice: those
that the mean of heights remembers."""


class HeldIndentation:
    """Follows the indentation of one hold.

    Args:
        quiet: Frames of the contact at rest, of one sensor, one at least.
        noise_mm: Standard deviation of a point's height in one frame [mm].

    Attributes:
        growth: Force over that at rest, as the volume tells it, in the mean of frames since the
            force last changed; None where nothing was indented at rest.
        way_mm: How far its middle has moved along the pad since the force last changed [mm]; 0
            while that is not known.
        spread_mm: Standard deviation of the way that noise alone makes [mm].
        place_mm: Its middle, (x, y), gel frame [mm]; None where nothing is indented.
    """

    def __init__(self, quiet: Sequence[ShearField], noise_mm: float = 0.0) -> None:
        sensor = quiet[0].sensor
        self._grid, self._noise_mm, self._power = grid_of(sensor), noise_mm, growth_power(sensor)
        total, counts = np.zeros(self._grid.count), np.zeros(self._grid.count)
        for each in quiet:
            cells = self._grid.cells_of(each.positions_mm)
            total[cells] += each.displacement_mm[:, 2]
            counts[cells] += 1.0
        self._rest_mm = total / np.maximum(counts, 1.0)
        self._height_mm, self._count = self._rest_mm.copy(), float(len(quiet))
        self._around = self._far_around()
        self._fit = self._surface_fit()
        self._rest_volume, self._from_mm = self._measured(self._rest_mm)
        self.place_mm = self._from_mm
        self.growth = 1.0 if self._rest_volume > 0 else None
        self._newest_mm = self._rest_mm
        self.way_mm = self.spread_mm = 0.0

    @property
    def newest_growth(self) -> float | None:
        """``growth`` in the newest frame alone; not every frame is asked for it."""
        if self._rest_volume <= 0:
            return None
        change = self._newest_mm - self._rest_mm
        return self._growth(self._measured(self._newest_mm - self._drift(change))[0])

    def renew(self) -> None:
        """Begin mean and way anew: the force is about to change."""
        self._count, self._from_mm, self.way_mm = 0.0, None, 0.0

    def see(self, field: ShearField) -> None:
        """Take another frame."""
        self._count += 1.0
        cells = self._grid.cells_of(field.positions_mm)
        weight = max(HEIGHT_MEMORY, 1.0 / self._count)
        self._height_mm[cells] += weight * (field.displacement_mm[:, 2] - self._height_mm[cells])
        self._newest_mm = self._height_mm.copy()
        self._newest_mm[cells] = field.displacement_mm[:, 2]
        change = self._height_mm - self._rest_mm
        volume, place_mm = self._measured(self._height_mm - self._drift(change))
        self.place_mm = place_mm
        if self._rest_volume > 0:
            self.growth = self._growth(volume)
        if self._from_mm is not None and place_mm is not None:
            self.way_mm = math.dist(self._from_mm, place_mm)
            self.spread_mm = self._spread(place_mm, volume)
        elif self._count >= MEAN_FRAMES:
            self._from_mm = place_mm

    def _growth(self, volume: float) -> float:
        """Force over that at rest under which a volume is indented."""
        growth = volume / self._rest_volume
        return growth**self._power if growth > 1 else growth

    def _spread(self, place_mm: tuple[float, float], volume: float) -> float:
        """Standard deviation of the difference of two places, of means over ``MEAN_FRAMES``."""
        x, y = self._grid.x - place_mm[0], self._grid.y - place_mm[1]
        arm_mm2 = float((x * x + y * y)[self._inside].sum())
        of_mean_mm = self._noise_mm / math.sqrt(MEAN_FRAMES)
        return of_mean_mm * math.sqrt(2.0 * arm_mm2) / volume

    def _measured(self, height_mm: FloatArray) -> tuple[float, tuple[float, float] | None]:
        """Sum of the heights above a fraction of the depth [mm], and their middle (x, y) [mm].

        0 and None where nothing is indented.
        """
        height, depth_mm = above_level(height_mm)
        body = np.clip(height - BODY_LEVEL * max(depth_mm, 0.0), 0.0, None)
        total = float(body.sum())
        if depth_mm <= 0 or total <= 0:
            return 0.0, None
        self._inside = body > 0
        return total, (float(body @ self._grid.x) / total, float(body @ self._grid.y) / total)

    def _far_around(self) -> NDArray[np.bool_]:
        """The points, (N,), that belong to no contact, now or once it has grown."""
        around = self._rest_mm < CONTACT * float(np.sort(self._rest_mm)[-3:].mean())
        shape = ContactShape.of(self._rest_mm, self._grid)
        return around if shape is None else around & (shape.reach > FAR_REACH)

    def _surface_fit(self) -> FloatArray | None:
        """From changes around the contact to a smooth surface, (N, points); None if too few."""
        count = int(self._around.sum())
        if count < MIN_LEVEL:
            return None
        x, y = self._grid.x / self._grid.half[0], self._grid.y / self._grid.half[1]
        parts = [np.ones_like(x), x, y]
        if count >= MIN_AROUND:
            parts += [x * x, x * y, y * y]
        surface = np.stack(parts, axis=1)
        return np.asarray(surface @ np.linalg.pinv(surface[self._around]))

    def _drift(self, change: FloatArray) -> FloatArray:
        """The smooth surface through the change around the contact; 0 with too little around it."""
        if self._fit is None:
            return np.zeros_like(change)
        return np.asarray(self._fit @ change[self._around])


def growth_power(sensor: SensorSpec) -> float:
    """Power of the growth of the indented volume of a sensor that is the growth of the force."""
    return _GROWTH_POWERS.get(sensor.name, 1.0)
