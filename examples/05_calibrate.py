"""Calibrate the forces of one unit's gel by known loads, save the calibration, use it.

    python examples/05_calibrate.py

Here the simulator puts the loads. A real unit needs a person who puts weights on the pad:
tacgrasp calibrate force --rig my_rig.yaml.
"""

import datetime
import tempfile
from dataclasses import replace
from pathlib import Path

from cltp.sensing.force_calibration import (
    fit_force,
    load_force_calibration,
    save_force_calibration,
)
from sim.gel.layer import gel_of
from sim.grasp.rig import build
from tacgrasp.bringup.force_loads import WorldLoads, measure_loads

SENSOR, LOADS_N = "gelsight_mini", (0.5, 1.0, 2.0, 5.0)

# a unit whose gel is stiffer than its model's nominal one: its forces read too low
gel = gel_of(SENSOR)
gel = replace(gel, young_mpa=1.4 * gel.young_mpa)
rig = build("egg", 4, start_offset_mm=(0.0, 0.0), gel=gel)

loads = measure_loads(
    rig.sensor, WorldLoads(rig), LOADS_N, report=print, keep=lambda readings: None
)
calibration = fit_force(
    loads, sensor=SENSOR, unit="my-pad", date=datetime.date.today(), source="the simulated world"
)
path = Path(tempfile.mkdtemp(), "force_my-pad.json")
save_force_calibration(path, calibration)
again = load_force_calibration(path)
print(f"{again.factor:.3f} N for each nominal newton, ± {again.spread:.0%}, in {path}")
print(f"in the rig's file, under hardware.sensor: force_calibration: {path.name}")
