"""Calibrate a sensor on presses of a ball of known diameter: from frames to ``GradientNet``.

The network first learns the slopes of the bare sphere, where the gel follows it. If profiles of the
gel are given, position and depth of every press are then fitted to the network's slopes, and it
learns all of the gel; both are done twice. From the sphere alone, the surroundings of a contact
would not be learned, and heights would drift (``tacgrasp bench balls``, with ``--bare-sphere`` and
without). Deterministic for a seed on one machine.

Not here: the file (``cltp.sensing.calibration``).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from cltp.errors import TouchError
from cltp.sensing.ball_presses import (
    BallPress,
    PressShape,
    ProfileTable,
    SphericalCap,
    find_press,
    fit_press,
    slopes_of,
)
from cltp.sensing.frames import Frame, check_frame
from cltp.sensing.photometric import GradientNet, Photometer, colour_change, position_inputs
from cltp.tactile.sensors import SensorSpec
from cltp.torch_threads import torch_threads

HIDDEN = 32
MIN_PRESSES = 5
"""Fewer presses can't cover the sensing area; our choice."""

_NEAR_MM = 3.5  # distance from a press that holds ball, bulge and a rim
_NEAR_SAMPLES, _FAR_SAMPLES = 3000, 1500  # pixels of a frame; the far ones keep the gel flat
_BATCH = 4096
_RATE = 1e-2

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
    steps: tuple[int, int, int] = (600, 300, 700),
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
        steps: Training steps on the sphere, and on the gel before and after the second fit.
        report: Receives the progress.

    Raises:
        TouchError: The ball can't have this diameter, a frame is no frame of this sensor, or
            fewer than ``MIN_PRESSES`` show a ball.
    """
    if not 1.0 <= diameter_mm <= 100.0:
        raise TouchError(f"expected a ball of 1 to 100 mm, got {diameter_mm} mm")
    background = check_frame(background, sensor, "the background")
    used, presses, rejected = _find_all(frames, background, sensor, diameter_mm)
    changes = [colour_change(frames[i], background) for i in used]
    torch_rng = torch.Generator().manual_seed(seed)
    model, rng = _Net(torch_rng), np.random.default_rng(seed)
    total = sum(steps) if profiles is not None else steps[0] + steps[2]
    done = 0

    def train(shape: PressShape, count: int) -> None:
        nonlocal done
        inputs, targets = _samples(changes, presses, shape, sensor, rng)
        _train(model, inputs, targets, count, torch_rng, lambda k: report(done + k, total))
        done += count

    shape: PressShape = SphericalCap(diameter_mm=diameter_mm)
    if profiles is None:
        train(shape, total)
    else:
        train(shape, steps[0])
        shape = profiles
        for count in steps[1:]:
            photometer = Photometer(model.numpy(), background, sensor)
            slopes = [photometer.gradients(frames[i]) for i in used]
            mm_per_px, deepest_mm = sensor.mm_per_px, float(profiles.depths_mm[-1])
            presses = [
                fit_press(press, *gradients, profiles, mm_per_px=mm_per_px, max_depth_mm=deepest_mm)
                for press, gradients in zip(presses, slopes, strict=True)
            ]
            train(shape, count)
    inputs, targets = _samples(changes, presses, shape, sensor, rng, far=0)
    with torch.no_grad():
        residual = math.sqrt(float((model(inputs) - targets).square().mean()))
    return TrainedPhotometric(
        net=model.numpy(), presses=tuple(presses), rejected=rejected, residual=residual
    )


def _find_all(
    frames: Sequence[Frame], background: Frame, sensor: SensorSpec, diameter_mm: float
) -> tuple[list[int], list[BallPress], dict[int, str]]:
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


class _Net(nn.Module):
    """``GradientNet`` in torch."""

    def __init__(self, rng: torch.Generator) -> None:
        super().__init__()
        self.first = nn.Linear(5, HIDDEN)
        self.second = nn.Linear(HIDDEN, HIDDEN)
        self.last = nn.Linear(HIDDEN, 6)
        with torch.no_grad():
            for layer in (self.first, self.second, self.last):
                bound = 1 / math.sqrt(layer.in_features)
                layer.weight.uniform_(-bound, bound, generator=rng)
                layer.bias.uniform_(-bound, bound, generator=rng)

    def forward(self, inputs: Tensor) -> Tensor:
        """Inputs (N, 5) -> slopes (N, 2)."""
        hidden = torch.relu(self.second(torch.relu(self.first(inputs))))
        return (self.last(hidden).view(-1, 2, 3) * inputs[:, None, :3]).sum(-1)

    def numpy(self) -> GradientNet:
        arrays = {}
        for number, layer in enumerate((self.first, self.second, self.last), start=1):
            arrays[f"w{number}"] = layer.weight.T.detach().numpy()
            arrays[f"b{number}"] = layer.bias.detach().numpy()
        return GradientNet(**arrays)


def _samples(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    shape: PressShape,
    sensor: SensorSpec,
    rng: np.random.Generator,
    far: int = _FAR_SAMPLES,
) -> tuple[Tensor, Tensor]:
    """Pixels of all frames whose slope is known: inputs (N, 5), slopes (N, 2)."""
    positions = position_inputs(sensor)
    row, column = (a.ravel().astype(float) for a in np.mgrid[0 : sensor.rows, 0 : sensor.columns])
    inputs, targets = [], []
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
        inputs.append(np.concatenate([change[chosen], positions[chosen]], axis=1))
        targets.append(slopes[chosen].astype(np.float32))
    return torch.from_numpy(np.concatenate(inputs)), torch.from_numpy(np.concatenate(targets))


@torch_threads()
def _train(
    model: _Net,
    inputs: Tensor,
    targets: Tensor,
    steps: int,
    rng: torch.Generator,
    report: Callable[[int], None],
) -> None:
    """Adam with one cycle of its rate."""
    if steps < 1:
        return
    optimizer = torch.optim.AdamW(model.parameters(), lr=_RATE, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, _RATE, total_steps=max(steps, 2))
    for step in range(steps):
        chosen = torch.randint(len(inputs), (_BATCH,), generator=rng)
        loss = (model(inputs[chosen]) - targets[chosen]).square().mean()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        schedule.step()
        report(step + 1)
