"""The force calibration that a simulated sensor carries, drawn from the rig's seed.

Each known load is read with a scatter, and ``fit_force`` makes the calibration of them, as on a
bench. Another gel than the sensor's nominal one is pressed with a ball, as the nominal one is.

Not here: the scale's use (``cltp.tactile.measure``).
"""

from __future__ import annotations

import datetime
from functools import cache

import numpy as np
import torch

from cltp.sensing.force_calibration import ForceCalibration, ForceLoad, fit_force
from cltp.tactile.measure import force_from
from cltp.tactile.sensors import sensor_named
from cltp.torch_threads import torch_threads
from sim.gel.layer import ElasticLayer, GelMaterial, gel_of
from sim.grasp.fingers import COLUMNS, ROWS, grid_axes_mm

LOADS_N = (0.5, 1.0, 2.0, 5.0)

SCATTER = 0.05
"""Standard deviation of ln F of each reading. Our choice: weights seated by hand, a gel that
drifts."""

BALL_RADIUS_MM = 7.5
"""The ball whose presses give the gel's stiffness (shared notes, 'Sensors')."""

_PART = 6  # of the rig's seed; the other parts are in ``sim.grasp.rig`` and ``.devices``


def drawn_force_calibration(
    sensor_name: str,
    seed: int,
    *,
    gel: GelMaterial | None = None,
    unit: str = "simulated",
    scatter: float = SCATTER,
) -> ForceCalibration:
    """Calibration of a simulated unit, dated today.

    Args:
        sensor_name: A key of ``cltp.tactile.sensors.SENSORS``.
        seed: Random seed of the rig.
        gel: Its gel; None for the sensor's nominal one.
        unit: Name of the unit.
        scatter: Standard deviation of ln F of each reading.
    """
    nominal = gel_of(sensor_name)
    stiffness = np.ones(len(LOADS_N))
    if gel is not None and gel != nominal:
        stiffness = np.array(_ball_readings_n(sensor_name, nominal))
        stiffness /= np.array(_ball_readings_n(sensor_name, gel))
    rng = np.random.default_rng([seed, _PART])
    noise = np.exp(scatter * rng.standard_normal(len(LOADS_N)))
    readings = np.array(LOADS_N) / stiffness * noise
    return fit_force(
        [
            ForceLoad(load_n=load, read_n=float(read))
            for load, read in zip(LOADS_N, readings, strict=True)
        ],
        sensor=sensor_name,
        unit=unit,
        date=datetime.date.today(),
        source=f"drawn with a scatter of {scatter:.0%}, seed {seed}",
    )


@cache
@torch_threads()
def _ball_readings_n(sensor_name: str, gel: GelMaterial) -> tuple[float, ...]:
    """Forces [nominal N] read where a rigid ball presses on a gel with each of ``LOADS_N``."""
    sensor = sensor_named(sensor_name)
    x_mm, y_mm = grid_axes_mm(sensor, ROWS, COLUMNS)
    squared = x_mm[None, :] ** 2 + y_mm[:, None] ** 2
    under = BALL_RADIUS_MM - np.sqrt(np.clip(BALL_RADIUS_MM**2 - squared, 0, None))
    gap = np.where(squared < BALL_RADIUS_MM**2, under, np.inf)
    layer = ElasticLayer(gel, rows=ROWS, columns=COLUMNS, pitch_mm=sensor.width_mm / COLUMNS)
    gaps = torch.from_numpy(gap)[None].expand(len(LOADS_N), -1, -1)
    heights = layer.press_to_force(gaps, torch.tensor(LOADS_N), tol=1e-3).height_mm.numpy()
    return tuple(
        force_from(each.astype(np.float64), float(each.max()), sensor.area_mm2) for each in heights
    )
