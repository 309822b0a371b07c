"""One network that has learned what several agree on: the fit of a calibration to few presses.

A single network fits the presses that it has, and reads the gel between them by chance: another
seed reads it otherwise. Four networks of other seeds and a cubic law, fitted to the same pixels,
are therefore averaged, and one more network learns their average, at the places of the presses and
everywhere else.

The law takes colours over the brightness of the untouched gel, since the light falls off to the
corners by a factor of three, and both are learned from colours without their noise, which would
make slopes too flat. The last network learns what they say of colours with it.

Source: the average of networks of other seeds after Lakshminarayanan et al. (2017), a network that
learns it after Hinton et al., 'Distilling the knowledge in a neural network' (2015); the law and
the rest are ours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations_with_replacement

import torch
from torch import Tensor

from cltp.train.photometric.network import Net, train_net

TEACHERS = 4
STUDENT_STEPS = 4
"""Steps of the network that learns the average, over those of each that it learns from."""

_SAMPLES = 200_000
_ELSEWHERE = 0.5  # of the samples lie at random places, with the colours of others
_LAW_WEIGHT = 0.5
_COLOUR_DEGREE, _PLACE_DEGREE = 3, 2
_PENALTY = 1e-6  # of the law's coefficients, over their mean square feature: against singularity


@dataclass(frozen=True, slots=True, kw_only=True)
class GelPixels:
    """What is known of each pixel without a press.

    Attributes:
        places: (P, 2), its position in [-1, 1].
        brightness: (P,), mean of the colours of the untouched gel there, without its grain.
    """

    places: Tensor
    brightness: Tensor


@dataclass(frozen=True, slots=True, kw_only=True)
class Pixels:
    """Pixels whose slope is known.

    Attributes:
        colours: (N, 3), change of colour.
        smooth: (N, 3), the same without noise.
        slopes: (N, 2), mm per mm.
        index: (N,), where in the ``GelPixels``.
    """

    colours: Tensor
    smooth: Tensor
    slopes: Tensor
    index: Tensor


def consensus_steps(steps: int) -> int:
    """Training steps of ``train_consensus`` altogether."""
    return (TEACHERS + STUDENT_STEPS) * steps


def train_consensus(
    pixels: Pixels, gel: GelPixels, steps: int, rng: torch.Generator, report: Callable[[], None]
) -> Net:
    """Train the teachers, fit the law, and train the network that learns their average.

    Args:
        pixels: What is learned from.
        gel: Every pixel of a frame.
        steps: Training steps of each teacher.
        rng: Draws weights and samples.
        report: Called after each of ``consensus_steps(steps)`` steps.
    """
    inputs = torch.cat([pixels.smooth, gel.places[pixels.index]], dim=1)
    teachers = []
    for _ in range(TEACHERS):
        teachers.append(Net(rng))
        train_net(teachers[-1], inputs, pixels.slopes, steps, rng, report)
    law = fit_law(inputs, gel.brightness[pixels.index], pixels.slopes)
    chosen = torch.randint(len(inputs), (_SAMPLES,), generator=rng)
    start = pixels.index[chosen]
    places = torch.randint(len(gel.places), (_SAMPLES,), generator=rng)
    elsewhere = torch.rand(_SAMPLES, generator=rng) < _ELSEWHERE
    index = torch.where(elsewhere, places, start)
    brightness = gel.brightness[index]
    colours = pixels.colours[chosen] * (brightness / gel.brightness[start])[:, None]
    drawn = torch.cat([colours, gel.places[index]], dim=1)
    with torch.no_grad():
        networks = torch.stack([teacher(drawn) for teacher in teachers]).mean(0)
        average = (1 - _LAW_WEIGHT) * networks
        average += _LAW_WEIGHT * (law_features(drawn, brightness) @ law)
    student = Net(rng)
    train_net(student, drawn, average, STUDENT_STEPS * steps, rng, report)
    return student


def law_features(inputs: Tensor, brightness: Tensor) -> Tensor:
    """Products of one to three colours with up to two coordinates: (N, 5), (N,) -> (N, 114)."""
    colours = _monomials(inputs[:, :3] / brightness[:, None], _COLOUR_DEGREE)
    places = _monomials(inputs[:, 3:], _PLACE_DEGREE)
    places = torch.cat([torch.ones_like(places[:, :1]), places], dim=1)
    return (colours[:, :, None] * places[:, None, :]).flatten(1)


def _monomials(columns: Tensor, degree: int) -> Tensor:
    """Products of one to ``degree`` columns: (N, K) -> (N, number of products)."""
    products = [
        columns[:, factors].prod(dim=1)
        for count in range(1, degree + 1)
        for factors in combinations_with_replacement(range(columns.shape[1]), count)
    ]
    return torch.stack(products, dim=1)


def fit_law(inputs: Tensor, brightness: Tensor, targets: Tensor) -> Tensor:
    """Least squares: coefficients (114, 2) of ``law_features`` that give the slopes (N, 2)."""
    features = law_features(inputs, brightness).double()
    scale = features.square().mean(0).sqrt().clamp_min(1e-12)
    features = features / scale
    moments = features.T @ features / len(features)
    moments += _PENALTY * torch.eye(len(moments), dtype=moments.dtype)
    products = features.T @ targets.double() / len(features)
    return (torch.linalg.solve(moments, products) / scale[:, None]).float()
