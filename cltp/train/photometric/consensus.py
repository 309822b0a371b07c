"""One network that has learned what several agree on: the fit of a calibration to few presses.

A single network fits the presses that it has, and reads the gel between them by chance: another
seed reads it otherwise. Four networks of other seeds and a quadratic law, fitted to the same
pixels, are therefore averaged, and one more network learns their average, at the places of the
presses and everywhere else.

Median error of the ball's diameter in 24 held-out presses, calibrated on 20 of 44 real ones, over
four random subsets: one network 5.2 %, two 4.3 %, four 4.0 %, the law 3.8 %, four networks and the
law 3.0 %. More flexible laws (cubic in position, radial basis functions with a penalty) gave 4 to
7 %, colours relative to the background 5 to 7 %. The places of the presses came from all 44 there;
fitted to the 20 alone, five subsets gave 4.4 % (``tacgrasp bench ball-curve``).

Source: the average of networks of other seeds after Lakshminarayanan et al. (2017), a network that
learns it after Hinton et al., 'Distilling the knowledge in a neural network' (2015); the law and
the rest are ours.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations_with_replacement

import torch
from torch import Tensor

from cltp.train.photometric.network import Net, train_net

TEACHERS = 4
STUDENT_STEPS = 2
"""Steps of the network that learns the average, over those of each that it learns from."""

_SAMPLES = 200_000
_ELSEWHERE = 0.5  # of the samples lie at random places, with the colours of others
_LAW_WEIGHT = 0.5
_PENALTY = 1e-6  # of the law's coefficients, over their mean square feature: against singularity


def consensus_steps(steps: int) -> int:
    """Training steps of ``train_consensus`` altogether."""
    return (TEACHERS + STUDENT_STEPS) * steps


def train_consensus(
    inputs: Tensor, targets: Tensor, steps: int, rng: torch.Generator, report: Callable[[], None]
) -> Net:
    """Train the teachers, fit the law, and train the network that learns their average.

    Args:
        inputs: Shape (N, 5), colours and position of pixels.
        targets: Shape (N, 2), their slopes.
        steps: Training steps of each teacher.
        rng: Draws weights and samples.
        report: Called after each of ``consensus_steps(steps)`` steps.
    """
    teachers = []
    for _ in range(TEACHERS):
        teachers.append(Net(rng))
        train_net(teachers[-1], inputs, targets, steps, rng, report)
    law = fit_law(inputs, targets)
    chosen = torch.randint(len(inputs), (_SAMPLES,), generator=rng)
    drawn = inputs[chosen]
    elsewhere = torch.rand(_SAMPLES, generator=rng) < _ELSEWHERE
    places = 2 * torch.rand(_SAMPLES, 2, generator=rng) - 1
    drawn[:, 3:] = torch.where(elsewhere[:, None], places, drawn[:, 3:])
    with torch.no_grad():
        networks = torch.stack([teacher(drawn) for teacher in teachers]).mean(0)
        average = (1 - _LAW_WEIGHT) * networks + _LAW_WEIGHT * (law_features(drawn) @ law)
    student = Net(rng)
    train_net(student, drawn, average, STUDENT_STEPS * steps, rng, report)
    return student


def law_features(inputs: Tensor) -> Tensor:
    """Products of up to two colours with up to two coordinates: (N, 5) -> (N, 54)."""
    colours, places = _monomials(inputs[:, :3]), _monomials(inputs[:, 3:])
    places = torch.cat([torch.ones_like(places[:, :1]), places], dim=1)
    return (colours[:, :, None] * places[:, None, :]).flatten(1)


def _monomials(columns: Tensor) -> Tensor:
    """Products of one and of two columns: (N, K) -> (N, K (K + 3) / 2)."""
    pairs = combinations_with_replacement(range(columns.shape[1]), 2)
    products = [columns[:, i] * columns[:, j] for i, j in pairs]
    return torch.cat([columns, torch.stack(products, dim=1)], dim=1)


def fit_law(inputs: Tensor, targets: Tensor) -> Tensor:
    """Least squares: coefficients (54, 2) of ``law_features`` that give the slopes."""
    features = law_features(inputs).double()
    scale = features.square().mean(0).sqrt().clamp_min(1e-12)
    features = features / scale
    moments = features.T @ features / len(features)
    moments += _PENALTY * torch.eye(len(moments), dtype=moments.dtype)
    products = features.T @ targets.double() / len(features)
    return (torch.linalg.solve(moments, products) / scale[:, None]).float()
