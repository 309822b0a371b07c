"""Small random language models of the classes that others publish, as transformers saves them."""

from pathlib import Path

import torch
import transformers
from tokenizers import Tokenizer, models, pre_tokenizers, trainers
from tokenizers.decoders import ByteLevel as ByteLevelDecoder
from transformers import (
    PreTrainedTokenizerFast,
    Qwen2_5_VLConfig,
    Qwen2_5_VLForConditionalGeneration,
    Qwen2Config,
    Qwen2ForCausalLM,
    Qwen3Config,
    Qwen3ForCausalLM,
)

KINDS = ("qwen2", "qwen2_5_vl", "qwen3")
"""Qwen2.5 is a Qwen2 to transformers."""

TEXTS = [
    "smooth sphere, slight 0.21 mm, centered x +0.4 y -1.1, tiny 2.1 %, 0.43 N. Goal 1.0 - 2.0 N.",
    "Action: <move_down>. It is off centre. Move the gripper down. What next? How deep is it?",
] * 5


def save_tokenizer(folder: Path) -> None:
    """A small byte-level BPE with the control tokens of Qwen."""
    tokenizer = Tokenizer(models.BPE())
    tokenizer.pre_tokenizer = pre_tokenizers.ByteLevel(add_prefix_space=False)
    tokenizer.decoder = ByteLevelDecoder()
    trainer = trainers.BpeTrainer(
        vocab_size=320,
        special_tokens=["<|endoftext|>", "<|im_start|>", "<|im_end|>"],
        initial_alphabet=pre_tokenizers.ByteLevel.alphabet(),
        show_progress=False,
    )
    tokenizer.train_from_iterator(TEXTS, trainer)
    fast = PreTrainedTokenizerFast(
        tokenizer_object=tokenizer, eos_token="<|im_end|>", pad_token="<|endoftext|>"
    )
    fast.save_pretrained(folder)


def save_stock_lm(folder: Path, kind: str, *, seed: int = 0) -> Path:
    """A model of a kind out of ``KINDS`` with its tokenizer, two layers of width 32."""
    sizes = {
        "vocab_size": 336,
        "hidden_size": 32,
        "intermediate_size": 48,
        "num_hidden_layers": 2,
        "num_attention_heads": 2,
        "num_key_value_heads": 1,
        "max_position_embeddings": 1024,
        "bos_token_id": 0,
        "eos_token_id": 2,
        "initializer_range": 0.2,  # so that its answers depend on what it is asked
    }
    torch.manual_seed(seed)
    if kind == "qwen2":
        model = Qwen2ForCausalLM(Qwen2Config(**sizes, tie_word_embeddings=True))
    elif kind == "qwen3":
        model = Qwen3ForCausalLM(Qwen3Config(**sizes, head_dim=16))
    else:
        rope = {"rope_type": "default", "mrope_section": [2, 3, 3], "rope_theta": 10_000.0}
        vision = {
            "depth": 1,
            "hidden_size": 32,
            "intermediate_size": 32,
            "num_heads": 2,
            "out_hidden_size": 32,
            "fullatt_block_indexes": [0],
        }
        name = "rope_scaling" if transformers.__version__.startswith("4.") else "rope_parameters"
        config = Qwen2_5_VLConfig(text_config={**sizes, name: rope}, vision_config=vision)
        model = Qwen2_5_VLForConditionalGeneration(config)
    model.save_pretrained(folder)
    save_tokenizer(folder)
    return folder
