"""Rows of a batch gathered from several processes, with gradients going back to them.

Without a process group, or with one process alone, everything is returned as it is. Not here: the
start of the processes (``cltp.train.distributed``).
"""

from __future__ import annotations

from typing import Any

import torch
import torch.distributed as dist
from torch import Tensor


def num_processes() -> int:
    """Number of processes that share a batch; 1 without a process group."""
    return dist.get_world_size() if dist.is_available() and dist.is_initialized() else 1


def gathered(rows: Tensor) -> Tensor:
    """Rows of all processes, those of process 0 first.

    When every process computes one and the same loss of the whole batch from this, the gradient
    that reaches a process's own rows is their sum over the processes: the mean of the parameters'
    gradients over the processes (``averaged_gradients``) is then that of one process alone.

    Args:
        rows: Shape (B, ...), with the same B in every process.

    Returns:
        Shape (processes · B, ...).
    """
    if num_processes() == 1:
        return rows
    if rows.requires_grad:
        gathered_rows: Tensor = _Gather.apply(rows)
        return gathered_rows
    return _all(rows)


def averaged_gradients(parameters: list[torch.nn.Parameter]) -> None:
    """Replace the gradients of parameters by their mean over all processes, in one message.

    Every process must have gradients for the same parameters.
    """
    if num_processes() == 1:
        return
    gradients = [p.grad for p in parameters if p.grad is not None]
    flat = torch.cat([g.flatten() for g in gradients])
    dist.all_reduce(flat)
    flat /= num_processes()
    for gradient, part in zip(gradients, flat.split([g.numel() for g in gradients]), strict=True):
        gradient.copy_(part.view_as(gradient))


def _all(rows: Tensor) -> Tensor:
    parts = [torch.empty_like(rows) for _ in range(num_processes())]
    dist.all_gather(parts, rows.contiguous())
    return torch.cat(parts)


class _Gather(torch.autograd.Function):
    """Forwards all rows; backwards the sum over processes of the gradients of this one's rows."""

    @staticmethod
    def forward(ctx: Any, rows: Tensor) -> Tensor:
        ctx.size = len(rows)
        return _all(rows)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> Tensor:
        total = gradients[0].contiguous().clone()
        dist.all_reduce(total)
        first = dist.get_rank() * ctx.size
        return total[first : first + ctx.size]
