"""Calibrate a sensor on presses of a ball of known diameter: from frames to ``GradientNet``.

If profiles of the gel are given, position and depth of every press are fitted to its colours
(``cltp.train.photometric.places``), and ``cltp.train.photometric.consensus`` learns the slopes of
all of the gel. Without profiles it learns those of the bare sphere, where the gel follows it, at
the place where its circle was found: the surroundings of a contact are then not learned, and
heights drift (``tacgrasp bench balls``, with ``--bare-sphere`` and without). Deterministic for a
seed on one machine.

Not here: the file (``cltp.sensing.calibration``), how many presses are enough (``tacgrasp bench
ball-curve``).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import torch
from numpy.typing import NDArray
from scipy import ndimage

from cltp.errors import TouchError
from cltp.sensing.ball_presses import (
    BallPress,
    PressShape,
    ProfileTable,
    SphericalCap,
    find_press,
    heights_of,
    slopes_of,
)
from cltp.sensing.frames import Frame, check_frame
from cltp.sensing.photometric import (
    GradientNet,
    colour_change,
    position_inputs,
    without_brightening,
)
from cltp.tactile.sensors import SensorSpec
from cltp.train.photometric.consensus import GelPixels, Pixels, consensus_steps, train_consensus
from cltp.train.photometric.places import TURNS, fit_brightening, fit_places, light_of

BRIGHTENED = 0.4
"""Part of the fitted growth of the light that is taken out of colours. Without it deep presses of a
ball measure smaller than shallow ones, with all of it every press measures larger. Our choice, by
the presses left out of 16 random calibrations on 20 of 44 real ones."""

MIN_PRESSES = 5
"""Fewer presses can't cover the sensing area; our choice."""

_NEAR_MM = 3.5  # distance from a press that holds ball, bulge and a rim
_NEAR_SAMPLES, _FAR_SAMPLES = 3000, 1500  # pixels of a frame; the far ones keep the gel flat
_SMOOTH_PX = 1.0  # of the colours that are learned from: noise in them makes slopes too flat

StepReport = Callable[[int, int], None]
"""Receives the step and the number of steps."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainedPhotometric:
    """A calibrated network.

    Attributes:
        net: The network.
        presses: Presses of the frames used, in their order.
        rejected: Index of each frame that was left out, with the reason.
        residual: Misfit of the slopes within ``_NEAR_MM``, root mean square [mm per mm].
    """

    net: GradientNet
    presses: tuple[BallPress, ...]
    rejected: dict[int, str]
    residual: float


def train_gradients(
    frames: Sequence[Frame],
    background: Frame,
    sensor: SensorSpec,
    diameter_mm: float,
    *,
    profiles: ProfileTable | None = None,
    seed: int = 0,
    steps: int = 1000,
    report: StepReport = lambda step, steps: None,
) -> TrainedPhotometric:
    """Train the network on presses of a ball.

    Args:
        frames: One press each, (rows, columns, 3) uint8.
        background: The untouched gel.
        sensor: Sensor of the frames.
        diameter_mm: Diameter of the ball [mm].
        profiles: Profiles of this gel around this ball; None learns from the bare sphere alone.
        seed: Seed of weights and samples.
        steps: Training steps of each network.
        report: Receives the progress.

    Raises:
        TouchError: The ball can't have this diameter, a frame is no frame of this sensor, or
            fewer than ``MIN_PRESSES`` show a ball.
    """
    if not 1.0 <= diameter_mm <= 100.0:
        raise TouchError(f"expected a ball of 1 to 100 mm, got {diameter_mm} mm")
    background = check_frame(background, sensor, "the background")
    used, presses, rejected = find_presses(frames, background, sensor, diameter_mm)
    changes = [colour_change(frames[i], background) for i in used]
    torch_rng, rng = torch.Generator().manual_seed(seed), np.random.default_rng(seed)
    total, done = consensus_steps(steps) + (0 if profiles is None else TURNS), 0

    def step_is_done() -> None:
        nonlocal done
        done += 1
        report(done, total)

    shape: PressShape = SphericalCap(diameter_mm=diameter_mm)
    brightening = 0.0
    if profiles is not None:
        shape = profiles
        presses = fit_places(changes, presses, profiles, background, sensor, step_is_done)
        brightening = BRIGHTENED * fit_brightening(changes, presses, profiles, background, sensor)
        changes = [
            without_brightening(change, _depths(press, profiles, sensor), brightening)
            for change, press in zip(changes, presses, strict=True)
        ]
    gel = GelPixels(
        places=torch.from_numpy(position_inputs(sensor)),
        brightness=torch.from_numpy(light_of(background).mean(axis=1).astype(np.float32)),
    )
    pixels = _pixels(changes, presses, shape, sensor, rng)
    model = train_consensus(pixels, gel, steps, torch_rng, step_is_done)
    near = _pixels(changes, presses, shape, sensor, rng, far=0)
    with torch.no_grad():
        slopes = model(torch.cat([near.colours, gel.places[near.index]], dim=1))
        residual = math.sqrt(float((slopes - near.slopes).square().mean()))
    net = replace(model.numpy(), brightening=np.array([brightening], dtype=np.float32))
    return TrainedPhotometric(net=net, presses=tuple(presses), rejected=rejected, residual=residual)


def _every_pixel(sensor: SensorSpec) -> NDArray[np.float64]:
    """Row and column of each pixel, (2, rows × columns)."""
    return np.indices((sensor.rows, sensor.columns)).reshape(2, -1).astype(np.float64)


def _depths(press: BallPress, profiles: ProfileTable, sensor: SensorSpec) -> NDArray[np.float32]:
    """Depth of the gel at each pixel, from the middle height of the frame on, (N,) [mm]."""
    row, column = _every_pixel(sensor)
    height = heights_of(press, profiles, column, row, sensor.mm_per_px)
    return (height - np.median(height)).astype(np.float32)


def find_presses(
    frames: Sequence[Frame], background: Frame, sensor: SensorSpec, diameter_mm: float
) -> tuple[list[int], list[BallPress], dict[int, str]]:
    """The frames that show a ball, and why the others do not; arguments as ``train_gradients``.

    Returns:
        Index of each frame with a ball; its press; the reason by the index of each other frame.

    Raises:
        TouchError: A frame is no frame of this sensor, or fewer than ``MIN_PRESSES`` show a ball.
    """
    used, presses, rejected = [], [], {}
    for index, frame in enumerate(frames):
        check_frame(frame, sensor, f"frame {index}")
        try:
            presses.append(find_press(frame, background, sensor, diameter_mm))
            used.append(index)
        except TouchError as error:
            rejected[index] = str(error)
    if len(presses) < MIN_PRESSES:
        reason = f"; the first left out: {next(iter(rejected.values()))}" if rejected else ""
        raise TouchError(
            f"a ball was found in {len(presses)} of {len(frames)} frames, expected at least "
            f"{MIN_PRESSES}, spread over the sensing area{reason}"
        )
    return used, presses, rejected


def _pixels(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    shape: PressShape,
    sensor: SensorSpec,
    rng: np.random.Generator,
    far: int = _FAR_SAMPLES,
) -> Pixels:
    """Pixels of all frames whose slope is known."""
    row, column = _every_pixel(sensor)
    parts = []
    for change, press in zip(changes, presses, strict=True):
        slopes = slopes_of(press, shape, column, row, sensor.mm_per_px)
        has_slope = np.isfinite(slopes).all(axis=1)
        r = np.hypot(column - press.column, row - press.row) * sensor.mm_per_px
        chosen = np.concatenate(
            [
                rng.permutation(np.flatnonzero(has_slope & (r < _NEAR_MM)))[:_NEAR_SAMPLES],
                rng.permutation(np.flatnonzero(has_slope & (r >= _NEAR_MM)))[:far],
            ]
        )
        picture = change.reshape(sensor.rows, sensor.columns, 3)
        smooth = ndimage.gaussian_filter(picture, (_SMOOTH_PX, _SMOOTH_PX, 0)).reshape(-1, 3)
        parts.append(
            Pixels(
                colours=torch.from_numpy(change[chosen]),
                smooth=torch.from_numpy(smooth[chosen]),
                slopes=torch.from_numpy(slopes[chosen].astype(np.float32)),
                index=torch.from_numpy(chosen),
            )
        )
    return Pixels(
        colours=torch.cat([part.colours for part in parts]),
        smooth=torch.cat([part.smooth for part in parts]),
        slopes=torch.cat([part.slopes for part in parts]),
        index=torch.cat([part.index for part in parts]),
    )
