"""A few labelled contacts without mechanics, for tests of what is done with data sets."""

import numpy as np

from cltp.data.contact import Contact, Gel, Split
from cltp.data.dataset_writer import DatasetWriter
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import Shape, Texture
from sim.tcl3d.labels import label

MINI = SENSORS["gelsight_mini"]
ROWS, COLUMNS = 48, 64
X, Y = np.meshgrid(*grid_axes_mm(MINI, ROWS, COLUMNS))


def cap_contact(number, **changes):
    """A cap pressed somewhere; two loads of a series are next to each other."""
    series = number // 2
    rng = np.random.default_rng(series)
    x_mm, y_mm, radius_mm = rng.uniform(-8, 8), rng.uniform(-6, 6), rng.uniform(1.5, 5)
    depth_mm = rng.uniform(0.1, 0.6) * (1 + number % 2)
    squared = ((X - x_mm) ** 2 + (Y - y_mm) ** 2) / radius_mm**2
    heights = (depth_mm * np.exp(-squared)).astype(np.float32)
    state = label(
        height_mm=heights,
        pressure_kpa=(heights * (squared < 1)).astype(np.float32),
        touching=squared < 1,
        force_n=float(heights.sum() / 50),
        sensor=MINI,
        shape=list(Shape)[series % len(Shape)],
        texture=list(Texture)[series % len(Texture)],
    )
    known = {
        "height_mm": heights,
        "sensor": MINI,
        "state": state,
        "object": f"thing-{series % 3}",
        "series": series,
        "split": Split.TEST if series % 5 == 4 else Split.TRAIN,
        "gel": Gel(thickness_mm=3.6, young_mpa=0.145, poisson=0.495),
        "seed": 3,
    }
    return Contact(**{**known, **changes})


def write_samples(folder, contacts):
    with DatasetWriter(folder, shard_size=8, about={"contacts": str(len(contacts))}) as writer:
        for contact in contacts:
            writer.add(contact)
    return folder
