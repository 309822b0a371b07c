"""The network of ``cltp.sensing.photometric.GradientNet`` in torch, and its training."""

from __future__ import annotations

import math
from collections.abc import Callable

import torch
from torch import Tensor, nn

from cltp.processor import torch_threads
from cltp.sensing.photometric import GradientNet

HIDDEN = 32

_BATCH = 1024
_RATE = 1e-2


class Net(nn.Module):
    """``GradientNet`` in torch; ``rng`` draws its weights."""

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
        """Inputs (N, 5), colours and position -> slopes (N, 2)."""
        hidden = torch.relu(self.second(torch.relu(self.first(inputs))))
        return (self.last(hidden).view(-1, 2, 3) * inputs[:, None, :3]).sum(-1)

    def numpy(self) -> GradientNet:
        """The network as it is used."""
        arrays = {}
        for number, layer in enumerate((self.first, self.second, self.last), start=1):
            arrays[f"w{number}"] = layer.weight.T.detach().numpy()
            arrays[f"b{number}"] = layer.bias.detach().numpy()
        return GradientNet(**arrays)


@torch_threads()
def train_net(
    model: Net,
    inputs: Tensor,
    targets: Tensor,
    steps: int,
    rng: torch.Generator,
    report: Callable[[], None],
) -> None:
    """Train on inputs (N, 5) and slopes (N, 2): Adam with one cycle of its rate.

    ``rng`` draws the samples; ``report`` is called after each step.
    """
    if steps < 1:
        return
    optimizer = torch.optim.AdamW(model.parameters(), lr=_RATE, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, _RATE, total_steps=max(steps, 2))
    for _ in range(steps):
        chosen = torch.randint(len(inputs), (_BATCH,), generator=rng)
        loss = (model(inputs[chosen]) - targets[chosen]).square().mean()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        schedule.step()
        report()
