import torch
from torch.utils.flop_counter import FlopCounterMode
from transformers import Qwen2Config, Qwen2ForCausalLM

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.llm.flops import (
    encoder_operations,
    generate_operations,
    prefill_operations,
    projector_operations,
)
from cltp.llm.tac3d_llm import Projector


def config() -> Qwen2Config:
    return Qwen2Config(
        vocab_size=100,
        hidden_size=8,
        intermediate_size=12,
        num_hidden_layers=2,
        num_attention_heads=2,
        num_key_value_heads=2,
    )


def test_one_position_costs_what_a_hand_counts() -> None:
    # A layer: q, k, v and out are four 8 × 8, gate, up and down three 8 × 12; its attention to one
    # position is two products of 8. The head is 8 × 100.
    layer = 2 * (4 * 64 + 3 * 96) + 2 * 2 * 8
    assert prefill_operations(config(), 1) == 2 * layer + 2 * 8 * 100
    assert generate_operations(config(), 0, 1) == prefill_operations(config(), 1)


def test_single_tokens_cost_more_than_the_same_at_once_by_their_logits() -> None:
    before, more = 7, 5
    apart = generate_operations(config(), before, more)
    together = prefill_operations(config(), before + more) - prefill_operations(config(), before)
    assert apart - together == more * 2 * 8 * 100


def test_the_matrices_of_a_qwen2_are_all_counted() -> None:
    lm = Qwen2ForCausalLM(config())
    weights = sum(p.numel() for p in lm.model.layers.parameters() if p.ndim == 2)
    assert prefill_operations(config(), 1) == 2 * weights + 2 * 4 * 8 + 2 * 8 * 100


def test_the_projector_is_two_products_for_each_token_and_as_many_for_each_reading() -> None:
    words = 19 + 5 + 4 + 9 + 5 + 1 + 4
    readings = words * 5 + 5 * 27 * 5 + 6 * 5 * 5
    pooled = 2 * 3 * 256 + 256 * 4 * 5
    assert projector_operations(Projector(3, 5), 7) == 7 * 2 * (3 * 5 + 5 * 5) + 2 * (
        readings + pooled
    )


def test_the_encoder_agrees_with_torchs_own_counter() -> None:
    encoder = TactileEncoder(PRESETS["tiny"])
    with FlopCounterMode(display=False) as counter, torch.no_grad():
        encoder(torch.zeros(1, 1024, 3))
    counted = encoder_operations(encoder)
    attention = PRESETS["tiny"].depth * 4 * 65**2 * PRESETS["tiny"].dim
    assert counter.get_total_flops() in (counted, counted - attention)
