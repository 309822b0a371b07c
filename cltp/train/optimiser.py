"""What a stage of training steps with: AdamW, or Muon for the matrices of its layers.

Muon takes the step of the steepest descent in the spectral norm: a matrix's averaged gradient with
all its singular values made one (Jordan et al. 2024, https://kellerjordan.github.io/posts/muon;
as large as AdamW's step: Liu et al. 2025, https://arxiv.org/abs/2502.16982). The iteration is
torch's; here are which parameters it moves, and kernels as matrices.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import torch
from torch import Tensor, nn

from cltp.train.recipes import Schedule

_BETAS = (0.9, 0.98)


class Optimiser:
    """Steps all trainable parameters of a model.

    Args:
        model: The model, on its device.
        schedule: Which optimiser, learning rate and weight decay.
    """

    def __init__(self, model: nn.Module, schedule: Schedule) -> None:
        layers = list(_layer_weights(model)) if schedule.optimiser == "muon" else []
        taken = set(map(id, layers))
        others = [p for p in model.parameters() if p.requires_grad and id(p) not in taken]
        matrices = [p for p in others if p.ndim > 1]
        vectors = [p for p in others if p.ndim <= 1]
        decays = ((matrices, schedule.weight_decay), (vectors, 0.0))
        groups = [{"params": params, "weight_decay": decay} for params, decay in decays if params]
        self._all: list[torch.optim.Optimizer] = []
        if groups:
            self._all.append(torch.optim.AdamW(groups, lr=schedule.learning_rate, betas=_BETAS))
        self._kernels = [(p, nn.Parameter(p.detach().flatten(1))) for p in layers]
        if layers:
            self._all.append(
                torch.optim.Muon(
                    [flat for _, flat in self._kernels],
                    lr=schedule.learning_rate,
                    weight_decay=schedule.weight_decay,
                    adjust_lr_fn="match_rms_adamw",
                )
            )

    def step(self, rate: float) -> None:
        """Move all parameters by their gradients, at learning rate ``rate``."""
        with torch.no_grad():
            for kernel, flat in self._kernels:
                flat.copy_(kernel.flatten(1))
                flat.grad = None if kernel.grad is None else kernel.grad.flatten(1)
            for optimiser in self._all:
                for group in optimiser.param_groups:
                    group["lr"] = rate
                optimiser.step()
            for kernel, flat in self._kernels:
                kernel.copy_(flat.view_as(kernel))

    def state(self) -> list[dict[str, Any]]:
        """What a checkpoint keeps."""
        return [optimiser.state_dict() for optimiser in self._all]

    def restore(self, state: list[dict[str, Any]]) -> None:
        """Go on from what ``state`` returned."""
        for optimiser, kept in zip(self._all, state, strict=True):
            optimiser.load_state_dict(kept)


def _layer_weights(model: nn.Module) -> Iterator[Tensor]:
    """The matrices between features: not what is looked up, and not what reads the result out."""
    for name, module in model.named_modules():
        is_layer = isinstance(module, nn.Linear | nn.Conv2d) and module.weight.requires_grad
        if is_layer and not name.endswith("heads.out"):
            yield module.weight
