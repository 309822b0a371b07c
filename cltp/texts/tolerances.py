"""Tolerances that noise puts on the numbers of a contact: the '±' of numeric captions.

Each tolerance is one standard deviation of the error of an ideal estimate from one noisy frame,
with the noise of a GelSight Mini (``MINI_SPREAD``), whatever the sensor, and everything else known.
A real estimate is worse.

The formulas are our derivation for a cap of depth d and footprint a² = area / π on a smooth drift
of standard deviation s, correlation exp(-r²/ℓ²) with ℓ uniform in 2.5-8 mm; a unit's depth scale
errs by k and its tilt by t:

- depth: the drift at the deepest point, and the scale: √(s² + (k d)²);
- position: a slope g moves the deepest point of d (1 - r²/a²) by g a² / 2d; the drift's slope has
  the variance 2 s² / ℓ², whose mean over ℓ is 2 s² / (2.5 · 8). The cloud's sampling adds to it;
- area: the footprint's edge, where the cap has the slope 2d / a, moves by s a / 2d, and the area by
  its circumference times that: relatively s / d;
- force: it follows the displaced volume, A d / 2: relatively √(k² + (2 s / d)²).

On 600 contacts of all shapes with drawn noise, 63 % of depths, 80 % of x, 66 % of areas and 75 % of
forces lay within the tolerances (68 % would be exact). An outline that is long for its area (line,
cross, ring, peak, edge) is less certain than a cap's: only a fifth of these areas did.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cltp.tactile.point_layout import LATTICE
from cltp.tactile.sensor_noise import MINI_SPREAD
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import ContactState
from cltp.texts.captions import NO_CONTACT


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerances:
    """One standard deviation of each number of a contact.

    Attributes:
        depth_mm: Depth [mm].
        position_mm: Each of x and y [mm].
        area_mm2: Area in contact [mm²].
        force_n: Normal force [N].
    """

    depth_mm: float
    position_mm: float
    area_mm2: float
    force_n: float


def tolerances(state: ContactState, sensor: SensorSpec, level: float = 1.0) -> Tolerances:
    """Tolerances of a contact, all 0 without contact; ``level`` is that of ``NoiseUnit.draw``."""
    if not state.in_contact:
        return Tolerances(depth_mm=0.0, position_mm=0.0, area_mm2=0.0, force_n=0.0)
    depth = max(state.depth_mm, 1e-3)
    drift = level * MINI_SPREAD.drift_mm
    scale = level * MINI_SPREAD.depth_scale / math.sqrt(3)  # uniform within ±
    area_mm2 = state.area_fraction * sensor.area_mm2
    slope = math.hypot(
        drift * math.sqrt(2 / math.prod(MINI_SPREAD.drift_length_mm)), level * MINI_SPREAD.tilt
    )
    sampling = sensor.width_mm / LATTICE / math.sqrt(12)
    return Tolerances(
        depth_mm=math.hypot(drift, scale * depth),
        position_mm=math.hypot(slope * area_mm2 / math.pi / (2 * depth), sampling),
        area_mm2=min(1.0, drift / depth) * area_mm2,
        force_n=min(1.0, math.hypot(scale, 2 * drift / depth)) * state.force_n,
    )


def toleranced_caption(state: ContactState, sensor: SensorSpec) -> str:
    """Word a contact in numbers with their tolerances: mm, mm² and N, gel frame.

    Source: the paper's limitations ask for numbers instead of words; the wording is ours, that of
    ``cltp.texts.captions.numeric_caption``. Unknown numbers (NaN) are left out.
    """
    if not state.in_contact:
        return NO_CONTACT
    within = tolerances(state, sensor)
    area_mm2 = state.area_fraction * sensor.area_mm2
    text = (
        f"pressed {state.depth_mm:.2f} ± {within.depth_mm:.2f} mm at x {state.x_mm:+.1f}, "
        f"y {state.y_mm:+.1f} ± {within.position_mm:.1f} mm, with {area_mm2:.1f} ± "
        f"{within.area_mm2:.1f} mm² contact area"
    )
    if math.isfinite(state.force_n):
        text += f" and {state.force_n:.2f} ± {within.force_n:.2f} N"
    return f"{text}."
