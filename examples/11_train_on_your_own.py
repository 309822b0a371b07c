"""Train the shipped weights on contacts of your own sensor: what they read before and after.

    python examples/11_train_on_your_own.py [--frames FOLDER] [--contacts 460] [--ours 4000]

FOLDER has frames of a GelSight Mini that presses a ball, and background.png. The other contacts are
simulated, and felt by a sensor that the weights have not met: a soft skin on the gel, and a
calibration that is off. Yours would come from your bench. Ours are mixed in against forgetting.
"""

import argparse
import csv
import shutil
import sys
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter

from cltp.data.dataset import ContactDataset
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.sensors import sensor_named
from tacgrasp.__main__ import main

MINI = sensor_named("gelsight_mini")
NAMES = ("shape", "texture", "depth", "position", "area")
UNIT = NoiseUnit(depth_scale=0.75, gain_x=1.3, gain_y=0.8, drift_mm=0.01, fine_mm=0.005)


def tacgrasp(*argv):
    """One command, as on the command line."""
    print("$ tacgrasp", *argv, flush=True)
    if code := main(list(map(str, argv))):
        sys.exit(code)


def felt_by_another_sensor(source, folder, rng):
    """Rows of the table of labels; the files of heights lie in the folder."""
    data = ContactDataset(source)
    for index in np.flatnonzero(data.column("sensor") == MINI.name):
        contact = data.contact(int(index))
        skin_px = 0.3 / (MINI.width_mm / contact.height_mm.shape[1])
        heights = UNIT.apply(gaussian_filter(contact.height_mm, skin_px), MINI, rng)
        if not contact.state.in_contact or heights.max() < max(0.2, -heights.min()):
            continue
        np.save(folder / f"{index}.npy", heights)
        words = {name: getattr(contact.state, name) for name in NAMES}
        yield {"file": f"{index}.npy", "series": contact.series, **words}


parser = argparse.ArgumentParser()
parser.add_argument("--frames", type=Path)
for name, value in {"contacts": 460, "ours": 4000, "steps": 400, "joint-steps": 300}.items():
    parser.add_argument(f"--{name}", type=int, default=value)
flags = parser.parse_args()

folder, labels, more = Path("measured"), Path("labels.csv"), ["--held-out", 0.2]
if folder.exists():
    sys.exit("measured exists, of an earlier run; delete measured, mine, trained and weights")
folder.mkdir()
made = ["data", "generate", "--set", "full", "--workers", 1]
tacgrasp(*made, "--contacts", 2 * flags.contacts, "--seed", 7, "--out", "simulated")
felt = felt_by_another_sensor(Path("simulated"), folder, np.random.default_rng(0))
rows = [row for row, _ in zip(felt, range(flags.contacts), strict=False)]
if flags.frames is not None:
    more += ["--background", flags.frames / "background.png"]
    for number, frame in enumerate(sorted(flags.frames.glob("ball*.png")), 10**6):
        shutil.copy(frame, folder)
        rows.append({"file": frame.name, "shape": "sphere", "texture": "smooth", "series": number})
with labels.open("w", newline="") as file:
    writer = csv.DictWriter(file, ("file", "series", *NAMES))
    writer.writeheader()
    writer.writerows(rows)

tacgrasp("data", "import", folder, "--labels", labels, "--out", "mine", *more)
tacgrasp(*made, "--contacts", flags.ours, "--out", "ours")
both, start = ["--data", "ours", "--also", "mine"], ["--start", "shipped"]
tacgrasp("train", "cltp", *both, *start, "--out", "trained", "--steps", flags.steps)
start += ["--methods", "trained", "--joint-steps", flags.joint_steps]
tacgrasp("train", "llm", *both, *start, "--out", "weights")
tacgrasp("eval", "own", *both, "--weights", "weights", "--json", "own.json")
