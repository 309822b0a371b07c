"""From a camera's image to the shear field of a gel with dots: how long, and how far off.

Part of ``tacgrasp bench reflex``. Frames of drawn loads are drawn as a camera would see them, on
drawn gels, and read by what reads those of a rig, with a language model that decides beside it.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cltp.sensing.frames import Frame
from cltp.sensing.marker_field import MarkerReader
from cltp.sensing.photometric import Photometer
from cltp.tactile.cloud import grid_axes_mm, heights_at
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.shear.field import ShearField
from sim.gel.marked_frames import MarkedGel, lamps_net
from sim.gel.shear.sensed import surface_mm
from sim.grasp.drawn.loads import LoadFrame, draw_load, follow
from tacgrasp.benchmarks.reflex.pace import model_beside

FRAMES = 20
"""Frames of each load. Our choice."""


class Image(NamedTuple):
    """A frame, and the field that it shows."""

    frame: Frame
    truth: ShearField


@dataclass(slots=True)
class ImageResult:
    """Readings of many images.

    Attributes:
        ms: From a frame to its field, one core [ms].
        along_um, depth_um: Errors of the displacements of points along the gel and into it [µm].
        found: Fraction of the points that were read.
    """

    ms: list[float] = field(default_factory=list)
    along_um: list[float] = field(default_factory=list)
    depth_um: list[float] = field(default_factory=list)
    found: list[float] = field(default_factory=list)


def measure_images(sensor_name: str, seeds: Sequence[int]) -> ImageResult:
    """Read the images of some seeds' loads; a seed whose pads don't reach the body has none.

    Raises:
        RuntimeError: The language model did not begin to decide.
    """
    gels = [_images(seed, sensor_named(sensor_name)) for seed in seeds]
    result = ImageResult()
    with model_beside():
        for reader, images in gels:
            _read(reader, images, result)
    return result


def _read(reader: MarkerReader, images: Sequence[Image], result: ImageResult) -> None:
    before = None
    for image in images:
        began_s = time.perf_counter()
        before = reader.follow(image.frame, before)
        found = reader.field(before, reader.coarse_heights(image.frame, before))
        result.ms.append(1e3 * (time.perf_counter() - began_s))
        known = {tuple(at): k for k, at in enumerate(image.truth.positions_mm.tolist())}
        which = [known[tuple(at)] for at in found.positions_mm.tolist()]
        error_um = 1e3 * (found.displacement_mm - image.truth.displacement_mm[which])
        result.along_um += np.abs(error_um[:, :2]).ravel().tolist()
        result.depth_um += np.abs(error_um[:, 2]).tolist()
        result.found.append(len(which) / len(image.truth.positions_mm))


def _images(seed: int, sensor: SensorSpec) -> tuple[MarkerReader, list[Image]]:
    """A drawn gel that knows its untouched frame, and images of the seed's load on it."""
    rng = np.random.default_rng([seed, 31])
    gel = MarkedGel.draw(sensor, rng)
    flat = np.zeros((sensor.rows, sensor.columns))
    background = gel.frame(flat, np.zeros((2, *flat.shape)), rng)
    reader = MarkerReader(Photometer(lamps_net(), background, sensor), background, sensor)
    drawn = draw_load(seed, sensor.name)
    try:
        frames = list(follow(drawn, quiet=1))
    except ValueError:
        return reader, []
    chosen = np.linspace(0, len(frames) - 1, FRAMES).astype(int)
    return reader, [_image(gel, frames[k], rng) for k in chosen]


def _image(gel: MarkedGel, frame: LoadFrame, rng: np.random.Generator) -> Image:
    spec = gel.sensor
    along_x, along_y, height = _maps(frame, spec)
    truth = frame.field_of(spec)
    moved = truth.displacement_mm.astype(np.float64)
    x, y = (truth.positions_mm + moved[:, :2]).T
    moved[:, 2] = heights_at(height, x, y, spec) - np.median(height)
    picture = gel.frame(height, np.stack([along_x, along_y]), rng)
    return Image(
        picture,
        ShearField(
            positions_mm=truth.positions_mm, displacement_mm=moved.astype(np.float32), sensor=spec
        ),
    )


def _maps(frame: LoadFrame, sensor: SensorSpec) -> Iterator[NDArray[np.float64]]:
    """Displacements x and y along the gel and z into it, each (rows, columns) [mm]."""
    layer = frame.state.fingers.shear.shear_layer
    moved = surface_mm(layer, frame.state.shear, frame.state.height_mm)[0]
    x, y = np.meshgrid(*grid_axes_mm(sensor, sensor.rows, sensor.columns))
    return (heights_at(each.double().numpy(), x, y, sensor) for each in moved)
