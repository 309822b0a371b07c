"""Calibrate a sensor on presses of a ball of known diameter: from frames to ``GradientNet``.

First the slopes of the bare sphere, where the gel surely follows it. Then, if profiles of the gel
are given, place and depth of every press are fitted to what the network sees and it is trained on
all of the gel, twice: on the sphere alone, what surrounds the contact isn't learnt, and heights
drift (``tacgrasp bench balls``, with ``--bare-sphere`` and without). Deterministic for a seed on
one machine.

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
"""Fewer presses can't cover a field; our choice."""

_NEAR_MM = 3.5  # what is called near a press: ball, bulge and a rim
_NEAR_SAMPLES, _FAR_SAMPLES = 3000, 1500  # pixels a frame; the far ones keep the gel flat
_BATCH = 4096
_RATE = 1e-2

StepReport = Callable[[int, int], None]
"""Told the step and how many there are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainedPhotometric:
    """What calibrating gives.

    Attributes:
        net: The network.
        presses: Of the frames used, in their order.
        rejected: Index of each frame that was left out, and why.
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
        sensor: Whose frames they are.
        diameter_mm: Of the ball [mm].
        profiles: Of this gel around this ball; None learns from the bare sphere alone.
        seed: Of weights and samples.
        steps: Of training on the sphere, and on the gel before and after the second fit.
        report: Progress.

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
            seen = Photometer(model.numpy(), background, sensor)
            presses = [
                fit_press(
                    press,
                    *seen.gradients(frames[i]),
                    profiles,
                    mm_per_px=sensor.mm_per_px,
                    max_depth_mm=float(profiles.depths_mm[-1]),
                )
                for i, press in zip(used, presses, strict=True)
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
        why = f"; the first left out: {next(iter(rejected.values()))}" if rejected else ""
        raise TouchError(
            f"a ball was found in {len(presses)} of {len(frames)} frames, expected at least "
            f"{MIN_PRESSES}, spread over the field{why}"
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
        def of(value: Tensor) -> NDArray[np.float32]:
            return value.detach().numpy()

        return GradientNet(
            w1=of(self.first.weight.T),
            b1=of(self.first.bias),
            w2=of(self.second.weight.T),
            b2=of(self.second.bias),
            w3=of(self.last.weight.T),
            b3=of(self.last.bias),
        )


def _samples(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    shape: PressShape,
    sensor: SensorSpec,
    rng: np.random.Generator,
    far: int = _FAR_SAMPLES,
) -> tuple[Tensor, Tensor]:
    """Pixels of all frames whose slope is known: inputs (N, 5), slopes (N, 2)."""
    place = position_inputs(sensor)
    row, column = (a.ravel().astype(float) for a in np.mgrid[0 : sensor.rows, 0 : sensor.columns])
    inputs, targets = [], []
    for change, press in zip(changes, presses, strict=True):
        slopes = slopes_of(press, shape, column, row, sensor.mm_per_px)
        known = np.isfinite(slopes).all(axis=1)
        r = np.hypot(column - press.column, row - press.row) * sensor.mm_per_px
        chosen = np.concatenate(
            [
                rng.permutation(np.flatnonzero(known & (r < _NEAR_MM)))[:_NEAR_SAMPLES],
                rng.permutation(np.flatnonzero(known & (r >= _NEAR_MM)))[:far],
            ]
        )
        inputs.append(np.concatenate([change[chosen], place[chosen]], axis=1))
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
