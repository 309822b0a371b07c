"""The slip network in torch, and how its weights are learned from sequences of cues.

Not here: what is a slip and what a frame weighs (``tacgrasp.training.slip``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from cltp.tactile.cloud import FloatArray
from cltp.tactile.shear.contact_shear import MIRROR_ORDER, MIRROR_SIGNS, NUM_VALUES
from cltp.tactile.shear.slip import LARGEST_CUE, Layer

HIDDEN, EPOCHS, BATCH, RATE, DECAY, JITTER, DROPPED = 48, 25, 64, 3e-3, 3e-3, 0.03, 0.2
"""Width of the network, epochs, batch of loads, learning rate (cosine), weight decay, noise on the
standardised cues, fraction of the units left out. Our choice, by loads that were held out."""

TEAM = 3
"""Networks that are trained from different weights, and whose odds are averaged. Our choice."""

LARGEST_GRADIENT = 1.0

CALLS = 2.0
"""Weight of what is called of a load, over that of what its frames are taken for. Our choice: of
none, half, 2 and 5 the best on loads that were held out."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lesson:
    """A load as the network sees it.

    Attributes:
        cues: Shape (T, NUM_VALUES), standardised.
        slips: Shape (T,), 1 in frames of a slip, else 0.
        weight: Shape (T,), of each frame in the loss.
        held: Shape (T,), 1 as long as enough has always stuck: no frame may be called.
        due: Shape (T,), 1 in frames of which one must be called; all 0 without a slip.
    """

    cues: FloatArray
    slips: FloatArray
    weight: FloatArray
    held: FloatArray
    due: FloatArray


def learn(lessons: Sequence[Lesson], seed: int) -> dict[str, Layer]:
    """Layers of a network that gives the mean odds of ``TEAM`` networks, by name."""
    return joined([_learn_one(lessons, TEAM * seed + k) for k in range(TEAM)])


def joined(parts: Sequence[dict[str, Layer]]) -> dict[str, Layer]:
    """One network that is several side by side, and gives the mean of their odds."""
    weights, biases = (np.concatenate([each["enter"][k] for each in parts]) for k in (0, 1))
    layers = {"enter": (weights, biases)}
    for name in ("take", "keep"):
        gates = [[np.split(array, 3) for array in each[name]] for each in parts]
        beside = [_diagonal([weights[k] for weights, _ in gates]) for k in range(3)]
        below = [biases[k] for k in range(3) for _, biases in gates]
        layers[name] = np.concatenate(beside), np.concatenate(below)
    leave = np.concatenate([each["leave"][0] for each in parts], axis=1) / len(parts)
    layers["leave"] = leave, np.mean([each["leave"][1] for each in parts], axis=0)
    return layers


def _diagonal(blocks: Sequence[FloatArray]) -> FloatArray:
    """Square blocks of one size along the diagonal, zeros elsewhere."""
    count, size = len(blocks), len(blocks[0])
    whole = np.zeros((count, size, count, size))
    for k, block in enumerate(blocks):
        whole[k, :, k] = block
    return whole.reshape(count * size, count * size)


def _learn_one(lessons: Sequence[Lesson], seed: int) -> dict[str, Layer]:
    """Layers of one network that tells the slips.

    The loss is the cross-entropy of frames and, since one wrong frame makes a false alarm and one
    right frame a catch, that of the largest odds while a load is held, and while a call is due.
    """
    torch.manual_seed(seed)
    network = _Network()
    optimiser = torch.optim.AdamW(network.parameters(), RATE, weight_decay=DECAY)
    order = sorted(range(len(lessons)), key=lambda k: len(lessons[k].slips))
    parts = [order[k : k + BATCH] for k in range(0, len(order), BATCH)]
    batches = [_batch([lessons[k] for k in part]) for part in parts]
    order_mirrored, signs = torch.from_numpy(MIRROR_ORDER), torch.from_numpy(MIRROR_SIGNS).float()
    num_steps = EPOCHS * len(batches)
    for step in range(num_steps):
        if step % len(batches) == 0:
            shuffled = torch.randperm(len(batches)).tolist()
        cues, *told = batches[shuffled[step % len(batches)]]
        for group in optimiser.param_groups:
            group["lr"] = RATE * 0.5 * (1 + math.cos(math.pi * step / num_steps)) + 1e-5
        is_mirrored = torch.rand(len(cues), 1, 1) < 0.5
        drawn = torch.where(is_mirrored, cues[..., order_mirrored] * signs, cues)
        drawn = drawn + JITTER * torch.randn_like(cues)
        optimiser.zero_grad()
        _loss(network(drawn), *told).backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), LARGEST_GRADIENT)
        optimiser.step()
    return network.layers()


def _loss(odds: Tensor, slips: Tensor, weight: Tensor, held: Tensor, due: Tensor) -> Tensor:
    """Loss of log odds (B, T)."""
    frames = functional.binary_cross_entropy_with_logits(odds, slips, weight, reduction="sum")
    calls = functional.softplus(_largest(odds, held)).sum()
    missed = functional.softplus(-_largest(odds, due, without=math.inf)).sum()
    count = held.amax(1).sum() + due.amax(1).sum()
    return frames / weight.sum().clamp(min=1.0) + CALLS * (calls + missed) / count.clamp(min=1.0)


def _largest(odds: Tensor, where: Tensor, without: float = -math.inf) -> Tensor:
    """Largest odds of each load where a mask is 1, (B,); a load without such is no loss."""
    largest = odds.masked_fill(where == 0, -math.inf).amax(1)
    return torch.where(where.amax(1) > 0, largest, torch.full_like(largest, without))


def standardised(cues: FloatArray, mean: FloatArray, spread: FloatArray) -> FloatArray:
    """Cues as the network takes them."""
    return np.clip((cues - mean) / spread, -LARGEST_CUE, LARGEST_CUE)


class _Network(torch.nn.Module):
    """``cltp.tactile.shear.slip.SlipModel`` over whole sequences."""

    def __init__(self) -> None:
        super().__init__()
        self.enter = torch.nn.Linear(NUM_VALUES, HIDDEN)
        self.unit = torch.nn.GRU(HIDDEN, HIDDEN, batch_first=True)
        self.leave = torch.nn.Linear(HIDDEN, 1)
        self.drop = torch.nn.Dropout(DROPPED)

    def forward(self, cues: Tensor) -> Tensor:
        """Log odds (B, T) from cues (B, T, NUM_VALUES)."""
        kept, _ = self.unit(self.drop(torch.tanh(self.enter(cues))))
        odds: Tensor = self.leave(self.drop(kept))[..., 0]
        return odds

    def layers(self) -> dict[str, Layer]:
        """Weights and biases, by the names of ``SlipModel``."""
        held = {name: each.double().numpy() for name, each in self.state_dict().items()}
        return {
            "enter": (held["enter.weight"], held["enter.bias"]),
            "take": (held["unit.weight_ih_l0"], held["unit.bias_ih_l0"]),
            "keep": (held["unit.weight_hh_l0"], held["unit.bias_hh_l0"]),
            "leave": (held["leave.weight"], held["leave.bias"]),
        }


def _batch(lessons: Sequence[Lesson]) -> list[Tensor]:
    """Cues, slips, weights and masks of some loads, filled up with frames of no weight."""
    longest = max(len(each.slips) for each in lessons)

    def filled(arrays: Sequence[FloatArray]) -> Tensor:
        whole = torch.zeros(len(arrays), longest, *arrays[0].shape[1:])
        for row, each in zip(whole, arrays, strict=True):
            row[: len(each)] = torch.from_numpy(each).float()
        return whole

    names = ("cues", "slips", "weight", "held", "due")
    return [filled([getattr(each, name) for each in lessons]) for name in names]
