"""Train the models of a contact's reserve on simulated grips (``cltp.tactile.shear.reserve``).

Grips are simulated once and kept in a folder; seeds that are there already are not simulated again.
Each is then seen by several noisy units. Seeds from ``FIRST_SEED`` on are for this alone;
benchmarks begin at 1,000,000.

Not here: the grips (``sim.grasp.drawn.grips``), the cues (``cltp.tactile.shear.contact_shear``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console

from cltp.atomic_write import replacing
from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.shear.contact_shape import grid_of
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from cltp.tactile.shear.reserve import (
    MEAN_S,
    QUANTILES,
    ReserveModel,
    mean_cues,
    mean_field,
    num_frames,
    write_reserve_model,
)
from sim.grasp.drawn.grips import drawn_grips
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.console import count_progress
from tacgrasp.training.slip_loads import SENSORS

FIRST_SEED = 5000

STANDS, MOST = -0.1, 1.3
"""Reserve that is learned of a contact that slides, and the largest one. Our choice: a sliding
contact does not show how much more load there is."""

HIDDEN, EPOCHS, BATCH, RATE, DECAY, JITTER = 48, 40, 256, 3e-3, 3e-3, 0.03
"""Width of both hidden layers, epochs, batch, learning rate (cosine), weight decay, noise on the
standardised cues. Our choice, by bodies that were held out."""

HELD_OUT = 5
"""Every so many-th body is held out and tells the errors."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReserveRequest:
    """What is trained.

    Attributes:
        bodies: Number of bodies, one seed each.
        units: Noisy units of each sensor that see a grip.
        out: Folder of the models.
        grips: Folder of the simulated grips, which are kept there.
        workers: Number of processes that simulate; None for one a core.
        seed: Random seed of the noise and the weights.
    """

    bodies: int
    units: int
    out: Path
    grips: Path
    workers: int | None = None
    seed: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class ReserveErrors:
    """Errors of a model on bodies that were held out.

    Attributes:
        grips: Number of grips, each seen by some units.
        middle: Mean size of the median's error, of the logarithm.
        below: Fraction of the true values below the low quantile.
    """

    grips: int
    middle: float
    below: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeenGrips:
    """Cues (N, NUM_OF_RESERVE) of one sensor, reserves (N,), numbers of the bodies (N,)."""

    cues: FloatArray
    reserve: FloatArray
    body: NDArray[np.int64]


def train(request: ReserveRequest, console: Console) -> dict[str, ReserveErrors]:
    """Simulate what is missing, train, write the models; their errors by sensor.

    Raises:
        TouchError: Too few bodies are held at all, or a file of grips is damaged.
        OSError: A file can't be read or written.
    """
    request.grips.mkdir(parents=True, exist_ok=True)
    seeds = range(FIRST_SEED, FIRST_SEED + request.bodies)
    paths = [_path(request.grips, seed) for seed in seeds]
    missing = [seed for seed, path in zip(seeds, paths, strict=True) if not path.is_file()]
    with worker_pool(request.workers) as pool, count_progress(console) as progress:
        done = pool.map(partial(write_grips, request.grips), missing)
        for _ in progress.track(done, len(missing), description="bodies"):
            pass
    errors = {}
    for name in SENSORS:
        model, errors[name] = fit(_seen(request, name, paths), request.seed)
        write_reserve_model(request.out / f"reserve_{name}.npz", model)
    return errors


def write_grips(folder: Path, seed: int) -> None:
    """Simulate the grips of a body, and write their mean fields and reserves."""
    sensors = [sensor_named(name) for name in SENSORS]
    grips = list(drawn_grips(seed))
    arrays: dict[str, NDArray[np.float32]] = {
        sensor.name: np.array(
            [
                np.mean([each.displacement_mm for each in grip.fields(sensor, MEAN_S)], axis=0)
                for grip in grips
            ],
            dtype=np.float32,
        )
        for sensor in sensors
    }
    reserves = [math.log(grip.reserve) if grip.hangs else STANDS for grip in grips]
    arrays["reserve"] = np.clip(reserves, STANDS, MOST).astype(np.float32)
    with replacing(_path(folder, seed)) as part, part.open("wb") as file:
        np.savez(file, **arrays)  # type: ignore[arg-type]


def _path(folder: Path, seed: int) -> Path:
    return folder / f"body_{seed}.npz"


def _seen(request: ReserveRequest, name: str, paths: list[Path]) -> SeenGrips:
    """All grips as noisy units of a sensor see them."""
    sensor, cues, reserves, bodies = sensor_named(name), [], [], []
    for body, path in enumerate(paths):
        rng = np.random.default_rng([request.seed, body, 33])
        try:
            with np.load(path, allow_pickle=False) as held:
                fields, truth = held[name], held["reserve"]
        except (EOFError, BadZipFile, ValueError, KeyError) as error:
            raise TouchError(f"{path} holds no grips: {error}; delete it") from None
        for moved_mm, reserve in zip(fields, truth, strict=True):
            for _ in range(request.units):
                each = _seen_by(ShearUnit.draw(rng, sensor), sensor, moved_mm, rng)
                if each is not None:
                    cues.append(each)
                    reserves.append(float(reserve))
                    bodies.append(body)
    return SeenGrips(cues=np.array(cues), reserve=np.array(reserves), body=np.array(bodies))


def _seen_by(
    unit: ShearUnit, sensor: SensorSpec, moved_mm: NDArray[np.float32], rng: np.random.Generator
) -> FloatArray | None:
    """Cues of a grip as one unit sees it; None where that shows no contact."""
    grid = grid_of(sensor)
    positions_mm = np.stack([grid.x, grid.y], axis=1).astype(np.float32)
    true = ShearField(sensor=sensor, positions_mm=positions_mm, displacement_mm=moved_mm)
    frames = [unit.apply(true, rng) for _ in range(num_frames(sensor))]
    return mean_cues(mean_field(frames), (unit.along_mm, unit.depth_mm))


def fit(seen: SeenGrips, seed: int) -> tuple[ReserveModel, ReserveErrors]:
    """Train on most bodies by the loss of quantiles; the others tell the errors.

    Raises:
        TouchError: No grip is left to learn from, or to measure with.
    """
    is_held_out = seen.body % HELD_OUT == 0
    if is_held_out.all() or not is_held_out.any():
        raise TouchError(f"training needs bodies that are held, got {len(seen.reserve)} grips")
    cues, reserve = seen.cues[~is_held_out], seen.reserve[~is_held_out]
    mean, spread = cues.mean(axis=0), cues.std(axis=0) + 1e-6
    layers = _layers((cues - mean) / spread, reserve, seed)
    model = ReserveModel(mean=mean, spread=spread, layers=layers)
    read = np.array([model.of_cues(each) for each in seen.cues[is_held_out]])
    truth = seen.reserve[is_held_out]
    errors = ReserveErrors(
        grips=len(truth),
        middle=float(np.abs(read[:, 1] - truth).mean()),
        below=float((truth < read[:, 0]).mean()),
    )
    return model, errors


def _layers(
    cues: FloatArray, reserve: FloatArray, seed: int
) -> tuple[tuple[FloatArray, FloatArray], ...]:
    """Weights of a network that tells ``QUANTILES``."""
    torch.manual_seed(seed)
    num_cues, tanh = cues.shape[1], torch.nn.Tanh()
    linear = [torch.nn.Linear(num_cues, HIDDEN), torch.nn.Linear(HIDDEN, HIDDEN)]
    linear.append(torch.nn.Linear(HIDDEN, len(QUANTILES)))
    network = torch.nn.Sequential(linear[0], tanh, linear[1], tanh, linear[2])
    x, y = torch.from_numpy(cues).float(), torch.from_numpy(reserve).float()
    quantiles = torch.tensor(QUANTILES)
    optimiser = torch.optim.AdamW(network.parameters(), RATE, weight_decay=DECAY)
    for epoch in range(EPOCHS):
        for group in optimiser.param_groups:
            group["lr"] = RATE * 0.5 * (1 + math.cos(math.pi * epoch / EPOCHS)) + 1e-5
        for rows in torch.randperm(len(x)).split(BATCH):
            optimiser.zero_grad()
            missed = y[rows, None] - network(x[rows] + JITTER * torch.randn(len(rows), num_cues))
            torch.maximum(quantiles * missed, (quantiles - 1) * missed).mean().backward()
            optimiser.step()
    return tuple(
        (each.weight.detach().double().numpy(), each.bias.detach().double().numpy())
        for each in linear
    )
