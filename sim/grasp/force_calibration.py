"""The force calibration that a simulated sensor carries, drawn from the rig's seed.

Each known load is read with a scatter, and ``fit_force`` makes the calibration of them, as on a
bench. Not here: the scale's use (``cltp.tactile.measure``).
"""

from __future__ import annotations

import datetime

import numpy as np

from cltp.gel.compliance import GelMaterial
from cltp.sensing.force_calibration import ForceCalibration, ForceLoad, fit_force
from sim.gel.force_factor import force_factor

LOADS_N = (0.5, 1.0, 2.0, 5.0)

SCATTER = 0.05
"""Standard deviation of ln F of each reading. Our choice: weights seated by hand, a gel that
drifts."""

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
    factor = 1.0 if gel is None else force_factor(gel, sensor_name)
    rng = np.random.default_rng([seed, _PART])
    noise = np.exp(scatter * rng.standard_normal(len(LOADS_N)))
    readings = np.array(LOADS_N) / factor * noise
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
