"""What a stage of training steps with: AdamW, or Muon for the matrices of its layers.

Muon takes the step of the steepest descent in the spectral norm: a matrix's averaged gradient with
all its singular values made one (Jordan et al. 2024, https://kellerjordan.github.io/posts/muon;
as large as AdamW's step: Liu et al. 2025, https://arxiv.org/abs/2502.16982). Its state is torch's;
here are which parameters it moves, kernels as matrices, and the iteration in the number format that
the processor has products for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import torch
from torch import Tensor, nn

from cltp.processor import has_bfloat16
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
                _Muon(
                    [flat for _, flat in self._kernels],
                    lr=schedule.learning_rate,
                    weight_decay=schedule.weight_decay,
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


class _Muon(torch.optim.Muon):
    """Muon as torch has it, whose own step always multiplies in bfloat16.

    On a processor without instructions for that a step of CLTP's encoder took 8 s instead of 1.
    """

    @torch.no_grad()
    def step(self, closure: Any = None) -> None:  # type: ignore[override]
        """Move the matrices by their gradients."""
        for group in self.param_groups:
            for matrix in group["params"]:
                if matrix.grad is None:
                    continue
                state = self.state[matrix]
                if "momentum_buffer" not in state:
                    state["momentum_buffer"] = torch.zeros_like(matrix.grad)
                mean = state["momentum_buffer"].lerp_(matrix.grad, 1 - group["momentum"])
                update = matrix.grad.lerp(mean, group["momentum"]) if group["nesterov"] else mean
                update = _with_equal_singular_values(update, group)
                size = 0.2 * math.sqrt(max(matrix.shape))  # that of AdamW's step
                matrix.mul_(1 - group["lr"] * group["weight_decay"])
                matrix.add_(update, alpha=-group["lr"] * size)


def _with_equal_singular_values(matrix: Tensor, group: Mapping[str, Any]) -> Tensor:
    """A matrix with singular values of 0.7 to 1.2, by a Newton-Schulz iteration."""
    a, b, c = group["ns_coefficients"]
    is_tall = matrix.shape[0] > matrix.shape[1]
    is_short = matrix.device.type != "cpu" or has_bfloat16()
    x = matrix.to(torch.bfloat16 if is_short else torch.float32)
    x = x.T if is_tall else x
    x = x / x.norm().clamp(min=group["eps"])
    for _ in range(group["ns_steps"]):
        gram = x @ x.T
        x = torch.addmm(x, torch.addmm(gram, gram, gram, beta=b, alpha=c), x, beta=a)
    return x.T if is_tall else x


def _layer_weights(model: nn.Module) -> Iterator[Tensor]:
    """The matrices between features: not what is looked up, and not what reads the result out."""
    for name, module in model.named_modules():
        is_layer = isinstance(module, nn.Linear | nn.Conv2d) and module.weight.requires_grad
        if is_layer and not name.endswith("heads.out"):
            yield module.weight
