"""Series of TCL3D made from object to caption at any resolution, each stage timed."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from unittest.mock import patch

import numpy as np
import torch
from torch import Tensor

from cltp.texts.captions import caption, numeric_caption
from sim.gel.compliance import Spectrum
from sim.gel.fine.fine import FineLayer
from sim.gel.fine.single import Convolution
from sim.gel.layer import ElasticLayer, Press
from sim.tcl3d import series as tcl3d
from sim.tcl3d.series import Scene, SeriesRequest, draw_scene, series_request

ROWS, COLUMNS = 240, 320
SEED = 0
STAGES = ("geometry", "solve", "labels", "caption")


@dataclass(frozen=True, slots=True, kw_only=True)
class StageTimes:
    """Durations of one process that made contacts.

    Attributes:
        contacts: Number of contacts.
        begin_s, end_s: On the machine's monotonic clock, which all processes share [s].
        stage_s: Processor time of each of ``STAGES``; other processes don't lengthen it [s].
        transforms: Number of convolutions by size: non-empty rows, padded rows, padded columns.
    """

    contacts: int
    begin_s: float
    end_s: float
    stage_s: dict[str, float]
    transforms: dict[tuple[int, int, int], int]


@contextmanager
def resolution(rows: int, columns: int) -> Iterator[None]:
    """Run the data set's own code on a grid of another size."""
    with patch.object(tcl3d, "ROWS", rows), patch.object(tcl3d, "COLUMNS", columns):
        yield


@contextmanager
def _counted(transforms: dict[tuple[int, int, int], int]) -> Iterator[None]:
    """Count convolutions by their sizes, those of batches and those of single contacts."""
    apply_batch, apply_one = Spectrum.apply, Convolution.apply

    def count(size: tuple[int, int, int], num: int) -> None:
        transforms[size] = transforms.get(size, 0) + num

    def counting(self: Spectrum, pressure_mpa: Tensor) -> Tensor:
        count((self.size[0], *self.padded), len(pressure_mpa))
        return apply_batch(self, pressure_mpa)

    def counting_one(self: Convolution, field: Tensor) -> Tensor:
        count((field.shape[0], *self.padded), 1)
        return apply_one(self, field)

    with (
        patch.object(Spectrum, "apply", counting),
        patch.object(Convolution, "apply", counting_one),
    ):
        yield


def scene_of(number: int, device: str) -> tuple[SeriesRequest, Scene, list[float]]:
    """A series, the scene over the pad, and the approaches of its presses [mm]."""
    request = series_request(SEED, number)
    rng = np.random.default_rng([SEED, number, 1])
    return request, *draw_scene(request, rng, device)


def solve(request: SeriesRequest, scene: Scene, approach: list[float], device: str) -> Press:
    """Press a series at the resolution of its scene."""
    gap = torch.from_numpy(scene.gap_mm.astype(np.float32)).to(device)
    layer = ElasticLayer(
        request.gel,
        rows=gap.shape[0],
        columns=gap.shape[1],
        pitch_mm=request.sensor.width_mm / gap.shape[1],
        body_modulus_mpa=request.obj.modulus_mpa,
        device=device,
    )
    with torch.inference_mode():
        press = FineLayer(layer).press_to_depth(
            gap.expand(len(approach), -1, -1), torch.tensor(approach)
        )
        if device != "cpu":
            torch.cuda.synchronize()
    return press


def make(
    numbers: list[int], device: str = "cpu", grid: tuple[int, int] = (ROWS, COLUMNS)
) -> StageTimes:
    """Make series of contacts from object to caption, one after the other, and time each stage."""
    stage_s = dict.fromkeys(STAGES, 0.0)
    transforms: dict[tuple[int, int, int], int] = {}
    contacts, begin = 0, time.monotonic()
    with resolution(*grid), _counted(transforms):
        for number in numbers:
            times = [time.process_time()]
            request, scene, approach = scene_of(number, device)
            times.append(time.process_time())
            press = solve(request, scene, approach, device)
            times.append(time.process_time())
            labelled = tcl3d.label_scene(SEED, request, scene, press)
            times.append(time.process_time())
            for contact in labelled:
                caption(contact.state)
                numeric_caption(contact.state, contact.sensor)
            times.append(time.process_time())
            contacts += len(labelled)
            for stage, begun, ended in zip(STAGES, times, times[1:], strict=False):
                stage_s[stage] += ended - begun
    return StageTimes(
        contacts=contacts,
        begin_s=begin,
        end_s=time.monotonic(),
        stage_s=stage_s,
        transforms=transforms,
    )
