"""Describe the contact in a scan of a gel: a cloud or height map in mm, in words and numbers.

    python examples/04_describe_a_scan.py [scan.ply]

Without a file, one of a pressed ball is made. The same on the command line: tacgrasp describe FILE.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

from cltp.sensing.touch_files import read_cloud
from cltp.tactile.cloud import cloud_from_heights, grid_axes_mm
from cltp.tactile.contact.single_cloud import is_touched
from cltp.tactile.sensors import sensor_named
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.playback.describe import describe, describe_by_model
from tacgrasp.policy_factory import load_llm

SENSOR = sensor_named("gelsight_mini")


def made_scan(path: Path) -> Path:
    """A cloud as text, x y z in mm a line: z is the indentation, positive into the gel."""
    x, y = np.meshgrid(*grid_axes_mm(SENSOR, 60, 80))
    heights_mm = np.clip(0.45 - ((x + 4) ** 2 + (y - 3) ** 2) / 30, 0, None)
    np.savetxt(path, cloud_from_heights(heights_mm, SENSOR).points_mm, fmt="%.4f")
    return path


path = Path(sys.argv[1]) if len(sys.argv) > 1 else made_scan(Path(tempfile.mkdtemp(), "scan.xyz"))
cloud = read_cloud(path, SENSOR)
for line in describe(cloud):
    print(line)
if is_touched(cloud):
    contract = contract_of(*load("strawberry"))  # the task's instruction, as a force band
    for line in describe_by_model(cloud, load_llm(), contract):
        print(line)
