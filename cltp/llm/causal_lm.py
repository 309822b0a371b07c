"""Causal language models of the Qwen2 family: our small one, or any local checkpoint directory.

``Language`` is the part of them that Tac3D-LLM needs: inputs as embeddings, tokens of the
checkpoint's own tokenizer, and the eight actions as sequences of tokens. Our tokenizer has one
token for each action; a stock one spells them.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import torch
from torch import Tensor

from cltp.encoder.strict_loading import load_strictly
from cltp.errors import TouchError
from cltp.texts.exchange_packing import prompt_ids
from cltp.texts.tokenizer import ACTIONS, SETTINGS_FILE, Words, names_our_tokens

if TYPE_CHECKING:  # its import takes seconds: only where it is needed
    from transformers import Qwen2ForCausalLM

CUE = "Action:"
"""The text before the action in every D_t."""


def small_lm(words: Words, *, dim: int = 192, layers: int = 4) -> Qwen2ForCausalLM:
    """A Qwen2 with random weights: 2 M parameters by default.

    Args:
        words: Its tokenizer; input and output embeddings are shared.
        dim: Hidden width, a multiple of 48.
        layers: Number of layers.
    """
    from transformers import Qwen2Config, Qwen2ForCausalLM

    config = Qwen2Config(
        vocab_size=len(words),
        hidden_size=dim,
        intermediate_size=8 * dim // 3,
        num_hidden_layers=layers,
        num_attention_heads=4,
        num_key_value_heads=4,
        max_position_embeddings=512,
        tie_word_embeddings=True,
        rope_parameters={"rope_type": "default", "rope_theta": 10_000.0},
        bos_token_id=words.bos,
        eos_token_id=words.eos,
        pad_token_id=words.pad,
    )
    return Qwen2ForCausalLM(config)


class Language:
    """A causal language model with its tokenizer.

    Args:
        lm: A Qwen2 or Qwen2.5-VL of transformers, or a ``cltp.llm.stored_lm.StoredLm``.
        words: Our tokenizer; None for a stock checkpoint.
        stock: The checkpoint's own tokenizer; None for ours.
    """

    def __init__(self, lm: Any, *, words: Words | None = None, stock: Any = None) -> None:
        if (words is None) == (stock is None):
            raise TouchError("a language model needs one tokenizer: ours or its own")
        self.lm, self.words, self._stock = lm, words, stock

    @property
    def dim(self) -> int:
        """Width of the input embeddings."""
        return int(self.lm.get_input_embeddings().weight.shape[1])

    @property
    def end(self) -> int:
        """The token that ends a reply."""
        return self.words.eos if self.words else int(self._stock.eos_token_id)

    def actions(self) -> list[list[int]]:
        """Tokens of the eight actions as they follow ``CUE``."""
        if self.words:
            return [[number] for number in self.words.actions]
        return [self._stock_ids(" " + action.strip("<>")) for action in ACTIONS]

    def prompt(self, text: str) -> list[int]:
        """Tokens between the touch and the reply."""
        if self.words:
            return prompt_ids(self.words, text)
        return self._stock_ids(f"{text}\n<|im_end|>\n<|im_start|>assistant\n")

    def encode(self, text: str) -> list[int]:
        """Tokens of a part of a reply."""
        return self.words.encode(text) if self.words else self._stock_ids(text)

    def decode(self, ids: Sequence[int]) -> str:
        if self.words:
            return self.words.decode(ids)
        return str(self._stock.decode(ids, skip_special_tokens=True))

    def embed(self, ids: Sequence[int]) -> Tensor:
        """Input embeddings of tokens, shape (T, D)."""
        table: Tensor = self.lm.get_input_embeddings().weight
        return table[torch.tensor(list(ids), device=table.device)]

    def _stock_ids(self, text: str) -> list[int]:
        return [int(i) for i in self._stock(text, add_special_tokens=False)["input_ids"]]


def load_language(folder: Path) -> Language:
    """Read a Qwen2 or Qwen2.5-VL directory in transformers' layout, with our tokenizer or its own.

    Raises:
        TouchError: Missing, damaged, another architecture, or weights that don't fit strictly.
    """
    import transformers

    kinds: dict[str, Any] = {
        "qwen2": transformers.Qwen2ForCausalLM,
        "seed_oss": transformers.SeedOssForCausalLM,  # how ours is stored (cltp.llm.stored_lm)
        "qwen2_5_vl": transformers.Qwen2_5_VLForConditionalGeneration,
    }
    try:
        kind = transformers.AutoConfig.from_pretrained(folder, local_files_only=True).model_type
    except (OSError, ValueError) as error:
        raise TouchError(f"no language model could be read from {folder}: {error}") from error
    if kind not in kinds:
        raise TouchError(f"{folder} holds a {kind} model; Tac3D-LLM takes {' or '.join(kinds)}")
    lm = load_strictly(kinds[kind], folder, "language model").eval()
    try:
        return Language(lm, words=Words.load(folder))
    except TouchError:
        if not (Path(folder) / SETTINGS_FILE).exists() or names_our_tokens(folder):
            raise
    try:
        stock = transformers.AutoTokenizer.from_pretrained(folder, local_files_only=True)
        return Language(lm, stock=stock)
    except (OSError, ValueError) as error:
        raise TouchError(f"no tokenizer could be read from {folder}: {error}") from error
