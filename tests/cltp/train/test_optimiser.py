"""What moves the weights in training: which parameters, by how much, and on from a checkpoint."""

from __future__ import annotations

import copy
from dataclasses import replace

import pytest
import torch
from torch import Tensor, nn

from cltp.train.optimiser import Optimiser
from cltp.train.recipes import Schedule, by_muon

ADAMW = Schedule(steps=10, batch_size=4, learning_rate=1e-2)
MUON = by_muon(ADAMW)


class _Model(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        torch.manual_seed(0)
        self.stem = nn.Conv2d(3, 8, 3).to(memory_format=torch.channels_last)
        self.words = nn.Embedding(5, 8)
        self.layer = nn.Linear(8, 16)
        self.still = nn.Linear(16, 4).requires_grad_(False)

    def forward(self, pixels: Tensor) -> Tensor:
        features = self.stem(pixels).mean((2, 3)) + self.words.weight.mean(0)
        return self.still(self.layer(features))


def _learned(schedule: Schedule, steps: int = 1) -> tuple[_Model, _Model]:
    """A model before and after some steps."""
    model = _Model()
    before = copy.deepcopy(model)
    optimiser = Optimiser(model, schedule)
    pixels = torch.randn(4, 3, 6, 6, generator=torch.Generator().manual_seed(1))
    for _ in range(steps):
        model.zero_grad(set_to_none=True)
        model(pixels).square().mean().backward()
        optimiser.step(1e-2)
    return before, model


@pytest.mark.parametrize("schedule", [ADAMW, MUON], ids=["adamw", "muon"])
def test_all_that_is_trained_moves_and_nothing_else(schedule: Schedule) -> None:
    before, after = _learned(schedule)

    moved = {
        name
        for (name, old), new in zip(before.named_parameters(), after.parameters(), strict=True)
        if not torch.equal(old, new)
    }

    assert moved == {name for name, p in before.named_parameters() if p.requires_grad}


def test_muon_moves_kernels_and_matrices_by_steps_of_like_singular_values() -> None:
    schedule = replace(MUON, weight_decay=0.0)
    model = _Model()
    before = copy.deepcopy(model)
    optimiser = Optimiser(model, schedule)
    for parameter in model.parameters():
        parameter.grad = torch.randn_like(parameter)
    optimiser.step(1e-2)

    for old, new in ((before.stem, model.stem), (before.layer, model.layer)):
        step = (new.weight - old.weight).detach().flatten(1)
        # as large as a step of AdamW: 0.2 of the rate in each place, in the mean
        expected = 0.2 * 1e-2 * max(step.shape) ** 0.5
        relative = torch.linalg.svdvals(step) / expected
        assert float(relative.min()) > 0.5
        assert float(relative.max()) < 1.5


def test_muon_steps_as_torch_does_whatever_the_processor_multiplies_in() -> None:
    torch.manual_seed(2)
    model = nn.Sequential(nn.Linear(48, 16, bias=False), nn.Linear(16, 40, bias=False))
    theirs = [nn.Parameter(layer.weight.detach().clone()) for layer in model]
    ours = Optimiser(model, MUON)
    torchs = torch.optim.Muon(
        theirs, weight_decay=MUON.weight_decay, adjust_lr_fn="match_rms_adamw", lr=1e-2
    )
    for _ in range(3):
        for layer, other in zip(model, theirs, strict=True):
            layer.weight.grad = torch.randn_like(other)
            other.grad = layer.weight.grad.clone()
        ours.step(1e-2)
        torchs.step()

    for layer, other in zip(model, theirs, strict=True):
        torch.testing.assert_close(layer.weight, other, rtol=0, atol=5e-4)


def test_what_is_looked_up_is_left_to_adamw() -> None:
    words = [_learned(schedule)[1].words.weight for schedule in (ADAMW, MUON)]

    torch.testing.assert_close(*words)


@pytest.mark.parametrize("schedule", [ADAMW, MUON], ids=["adamw", "muon"])
def test_an_optimiser_goes_on_where_another_one_stopped(schedule: Schedule) -> None:
    _, whole = _learned(schedule, steps=4)
    _, model = _learned(schedule, steps=0)
    pixels = torch.randn(4, 3, 6, 6, generator=torch.Generator().manual_seed(1))
    optimiser = Optimiser(model, schedule)
    for step in range(4):
        if step == 2:
            state = copy.deepcopy(optimiser.state())
            optimiser = Optimiser(model, schedule)
            optimiser.restore(state)
        model.zero_grad(set_to_none=True)
        model(pixels).square().mean().backward()
        optimiser.step(1e-2)

    for resumed, expected in zip(model.parameters(), whole.parameters(), strict=True):
        torch.testing.assert_close(resumed, expected)
