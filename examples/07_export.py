"""Export an episode: a table for a spreadsheet, and every cloud for numpy.

    python examples/07_export.py [episode.mcap]

Without a file, an episode is run first. The file itself is MCAP: other tools open it too.
"""

import csv
import sys
from pathlib import Path

import numpy as np

from tacgrasp import api
from tacgrasp.episodes import read_episode


def recorded() -> Path:
    """An episode of the rules."""
    run = api.configure("strawberry", policy="rules", seed=6)
    with api.connect(run) as rig:
        return api.run_episode(run, rig, api.make_policy(run)).path


def row(step, began_s):
    """One step as a row of the table."""
    felt, action = step.felt_force_n, step.decision.action if step.decision else None
    return {
        "step": step.index,
        "t_s": round(step.stamp.monotonic_s - began_s, 3),
        "phase": step.phase.value,
        "in_contact": step.in_contact,
        "felt_n": "" if felt is None else round(felt.value, 3),
        "commanded_n": round(step.gripper.force_n, 3),
        "width_mm": round(1000 * step.gripper.width_m, 3),
        "action": action.value if action else "",
        "text": step.decision.text if step.decision else "",
    }


path = Path(sys.argv[1]) if len(sys.argv) > 1 else recorded()
episode = read_episode(path)
began_s = episode.steps[0].stamp.monotonic_s
rows = [row(step, began_s) for step in episode.steps]
table, clouds = Path(f"{path.stem}.csv"), Path(f"{path.stem}.npz")
with table.open("w", newline="", encoding="utf-8") as file:
    writer = csv.DictWriter(file, rows[0])
    writer.writeheader()
    writer.writerows(rows)
np.savez_compressed(
    clouds, **{f"step_{step.index:03d}": step.cloud.points_mm for step in episode.steps}
)
with np.load(clouds) as stored:
    points = sum(len(stored[name]) for name in stored.files)
    print(f"{table}: {len(rows)} rows; {clouds}: {len(stored.files)} clouds, {points} points [mm]")
