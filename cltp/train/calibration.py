"""What is set after the training of an encoder: intervals, contradictions, and the force head.

Not here: the training (``cltp.train.alignment``).
"""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import NOISY, Augmentation, Sampler
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.force_head import NUM_INPUTS, ForceHead, force_inputs
from cltp.encoder.heads import LEAST_CONTACTS, StateHeads, Targets, targets
from cltp.tactile.measure import contact_state
from cltp.tactile.point_layout import GRID
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import NUMBERS
from cltp.train.stage import TrainingRun

CALIBRATION_CONTACTS = 4000
"""Most contacts that are read. The coverage then has a standard error of half a percent."""

CALIBRATION_VIEWS = 2
"""How often each is read, with another noise each time."""

FORCE_CONTACTS = 24_000
"""Most contacts that a force head is fitted by: 1 ms each for the pressure, 10 ms in all."""

LEAST_FORCE_CONTACTS = 2000
"""Fewest: with fewer, forces stay as the heads read them. Our choice: 7,500 weights."""

BATCH = 64

_FORCE = NUMBERS.index("force_n")


def calibrate_heads(
    run: TrainingRun, encoder: TactileEncoder, heads: StateHeads, augmentation: Augmentation | None
) -> None:
    """Calibrate the heads on the validation split, with the noise of training.

    Intervals hold nine tenths both of these contacts and of the same under ``NOISY``: training
    draws its noise from wide ranges, and most of what it draws is less than a unit's.

    Where the data has no such split, the intervals stay as they were learned.
    """
    data = ContactDataset(run.data)
    held_out = np.flatnonzero(data.column("split") == Split.VALIDATION.value)
    if not len(held_out):
        return
    layout = encoder.config.variant.layout
    chosen = np.random.default_rng([run.seed, 71]).permutation(held_out)[:CALIBRATION_CONTACTS]
    encoder.eval(), heads.eval()
    measured_mm: list[float] = []
    sampler = Sampler(data, augmentation, seed=run.seed + 1, layout=layout)
    varied = _read(encoder, sampler, chosen, measured_mm)
    sampler = Sampler(data, NOISY, seed=run.seed + 1, layout=layout)
    heads.calibrate(varied, _read(encoder, sampler, chosen))
    heads.calibrate_contradiction(*varied, torch.tensor(measured_mm))


def _read(
    encoder: TactileEncoder,
    sampler: Sampler,
    chosen: NDArray[np.int64],
    measured_mm: list[float] | None = None,
) -> tuple[Tensor, Targets]:
    """Pooled tokens (N, 2 C) and labels of contacts, in their order.

    Args:
        encoder: The encoder.
        sampler: Draws their noise.
        chosen: Their numbers.
        measured_mm: Receives their depths, measured directly, which takes longer than the encoder.
    """
    pooled, labels = [], []
    with torch.no_grad():
        drawn = np.tile(chosen, CALIBRATION_VIEWS)
        for step, first in enumerate(range(0, len(drawn), BATCH)):
            batch = sampler.batch(drawn[first : first + BATCH], step)
            pooled.append(encoder(torch.from_numpy(batch.points)).pooled)
            labels.append(targets(batch.states))
            if measured_mm is not None:
                clouds = (batch.cloud(row) for row in range(len(batch.points)))
                measured_mm += [contact_state(each, in_contact=True).depth_mm for each in clouds]
    true = Targets(*(torch.cat(parts) for parts in zip(*labels, strict=True)))
    return torch.cat(pooled), true


def fit_force(
    run: TrainingRun,
    encoder: TactileEncoder,
    heads: StateHeads,
    augmentation: Augmentation | None,
    start: ForceHead | None = None,
) -> None:
    """Give heads with intervals a force head, after ``calibrate_heads``.

    It is fitted by contacts of the training split, whose forces heads read no better than others.
    Its intervals are learned as if units' gels were of any thickness (``even_weights``), and set on
    the validation split. An encoder that takes other points than the grid, or a data set of fewer
    than ``LEAST_FORCE_CONTACTS``, gets none.

    Args:
        run: Data, seed and progress.
        encoder: The encoder; it is not changed.
        heads: Its heads.
        augmentation: How contacts are varied.
        start: Force head of weights that were trained on. It was fitted by what their heads read,
            and is fitted anew by ``FORCE_CONTACTS``; where the data has fewer, it stays, and its
            intervals are set anew.
    """
    if encoder.config.variant.layout != GRID or not heads.has_intervals:
        return
    data = ContactDataset(run.data)
    split, rng = data.column("split"), np.random.default_rng([run.seed, 73])
    learned, held_out = (
        rng.permutation(np.flatnonzero(split == each.value))
        for each in (Split.TRAIN, Split.VALIDATION)
    )
    if start is None and len(learned) < LEAST_FORCE_CONTACTS:
        return
    stays = start is not None and len(learned) < FORCE_CONTACTS
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(run.seed)
        head = start if start is not None and stays else ForceHead()
    heads.force = None
    sampler = Sampler(data, augmentation, seed=run.seed + 2, layout=GRID)
    if not stays:
        rows = learned[:FORCE_CONTACTS]
        inputs, forces, rows = _force_samples(run, encoder, heads, sampler, rows)
        head.fit(inputs, forces, even_weights(_thicknesses(data, rows)), seed=run.seed)
    if len(held_out):
        rows = np.tile(held_out[:CALIBRATION_CONTACTS], CALIBRATION_VIEWS)
        inputs, forces, _ = _force_samples(run, encoder, heads, sampler, rows)
        if len(inputs) >= LEAST_CONTACTS:  # as ``StateHeads.calibrate``
            head.widen(inputs, forces)
    heads.force = head


def _force_samples(
    run: TrainingRun,
    encoder: TactileEncoder,
    heads: StateHeads,
    sampler: Sampler,
    rows: NDArray[np.int64],
) -> tuple[Tensor, Tensor, NDArray[np.int64]]:
    """Inputs (N, 48) of the force head, transformed forces and rows (N,) of contacts that touch."""
    inputs, forces = [torch.empty(0, NUM_INPUTS)], [torch.empty(0)]
    touching = [np.empty(0, np.int64)]
    for step, first in enumerate(range(0, len(rows), BATCH)):
        batch = sampler.batch(rows[first : first + BATCH], step)
        labels = targets(batch.states)
        touched = labels.touching > 0
        if not touched.any():
            continue
        points = torch.from_numpy(batch.points)[touched]
        with torch.no_grad():
            inputs.append(force_inputs(points, heads(encoder(points).pooled)))
        forces.append(labels.numbers[touched, _FORCE])
        touching.append(batch.index[touched.numpy()])
        run.report("force", min(len(rows), first + BATCH), len(rows), {})
    return torch.cat(inputs), torch.cat(forces), np.concatenate(touching)


def _thicknesses(data: ContactDataset, rows: NDArray[np.int64]) -> NDArray[np.float64]:
    """Thickness of the gels of contacts (N,) over that of the sensor's nominal gel.

    An unknown gel counts as nominal.
    """
    sensors = (sensor_named(name) for name in data.column("sensor")[rows])
    nominal = np.array([sensor.gel_mm for sensor in sensors])
    ratios = data.column("gel_thickness_mm")[rows] / nominal
    return np.where(np.isnan(ratios), 1.0, ratios)


def even_weights(thicknesses: NDArray[np.float64]) -> Tensor:
    """Weights (N,), 1 in the mean, under which logarithms of thicknesses (N,) are spread evenly.

    Light contacts do not show the gel's thickness. Most units have gels near the nominal one, so
    that nine tenths of all contacts can lie in their intervals and few of those on a thin gel. A
    thickness therefore counts as much as the part of the range that lies nearest to it.
    """
    values, which, counts = np.unique(thicknesses.round(3), return_inverse=True, return_counts=True)
    if len(values) == 1:
        return torch.ones(len(thicknesses))
    logs = np.log(values)
    middles = (logs[1:] + logs[:-1]) / 2
    ends = np.concatenate([[2 * logs[0] - middles[0]], middles, [2 * logs[-1] - middles[-1]]])
    weights = (np.diff(ends) / counts)[which]
    return torch.from_numpy(weights / weights.mean()).float()
