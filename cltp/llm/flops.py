"""Floating-point operations of the model's parts, by formula: a lower bound for their durations.

A product of an (m, k) with a (k, n) matrix is 2 m k n operations. Products, convolutions and
attention are counted; norms, activations and additions are left out, so that the bound is never too
high.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor, nn

from cltp.encoder.encoder import TactileEncoder, TransformerBlock
from cltp.llm.reading_tokens import NUM_READINGS
from cltp.llm.tac3d_llm import Projector
from cltp.tactile.cloud import NUM_POINTS


def encoder_operations(encoder: TactileEncoder) -> int:
    """Operations of E_T on one cloud: those of its layers, and 4 T² C for attention in a block."""
    total = 0

    def count(layer: nn.Module, _: Any, out: Tensor) -> None:
        nonlocal total
        if isinstance(layer, nn.Conv2d):
            size = layer.kernel_size
            total += 2 * out.numel() * layer.in_channels * size[0] * size[1]
        elif isinstance(layer, nn.Linear):
            total += 2 * out.numel() * layer.in_features
        elif isinstance(layer, TransformerBlock):
            _, length, dim = out.shape
            total += 4 * length * length * dim

    counted = (nn.Conv2d, nn.Linear, TransformerBlock)
    hooks = [m.register_forward_hook(count) for m in encoder.modules() if isinstance(m, counted)]
    try:
        with torch.no_grad():
            encoder(torch.zeros(1, NUM_POINTS, 3, device=next(encoder.parameters()).device))
    finally:
        for hook in hooks:
            hook.remove()
    return total


def projector_operations(projector: Projector, num_tokens: int) -> int:
    """Operations of the MLPs on one cloud's tokens and pooled tokens, and of the readings' tokens.

    Args:
        projector: The projector.
        num_tokens: Number of the encoder's tokens: the groups and the class token.
    """
    dim = projector.lm_dim
    readings = projector.readings
    once = [readings.words, *readings.numbers]
    once += [layer for layer in projector.pooled if isinstance(layer, nn.Linear)]
    inputs = sum(layer.in_features * layer.out_features for layer in once)
    outputs = NUM_READINGS * dim * dim
    return 2 * (num_tokens * (projector.encoder_dim * dim + dim * dim) + inputs + outputs)


def prefill_operations(config: Any, num_tokens: int) -> int:
    """Operations of a Qwen2 on its inputs, with the logits of the last position alone.

    Args:
        config: transformers' ``Qwen2Config``.
        num_tokens: Number of tokens of touch and prompt. Position t attends to t others.
    """
    attended = num_tokens * (num_tokens + 1) // 2
    logits = 2 * config.vocab_size * config.hidden_size
    return num_tokens * _matrices(config) + attended * _attention(config) + logits


def generate_operations(config: Any, num_before: int, num_tokens: int) -> int:
    """Operations of ``num_tokens`` further single tokens after ``num_before`` positions."""
    each = _matrices(config) + 2 * config.vocab_size * config.hidden_size
    attended = sum(range(num_before + 1, num_before + num_tokens + 1))
    return num_tokens * each + attended * _attention(config)


def _matrices(config: Any) -> int:
    """Operations of the layers' matrices on one token."""
    dim, inner = config.hidden_size, config.intermediate_size
    size = getattr(config, "head_dim", None) or dim // config.num_attention_heads
    query, key = config.num_attention_heads * size, config.num_key_value_heads * size
    weights = dim * (query + 2 * key) + query * dim + 3 * dim * inner
    return 2 * int(config.num_hidden_layers) * weights


def _attention(config: Any) -> int:
    """Operations of one token's attention to one position: a product each for score and value."""
    size = getattr(config, "head_dim", None) or config.hidden_size // config.num_attention_heads
    return 4 * int(config.num_hidden_layers) * config.num_attention_heads * size
