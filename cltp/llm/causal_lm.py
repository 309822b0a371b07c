"""Causal language models of the Qwen family: our small one, or any local checkpoint directory.

``Language`` is the part of them that Tac3D-LLM needs: inputs as embeddings, tokens of the
checkpoint's own tokenizer, and the eight actions as sequences of tokens. Our tokenizer has one
token for each action; a stock one spells them (``cltp.texts.stock_tokenizer``).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import torch
from torch import Tensor

from cltp.encoder.strict_loading import load_strictly
from cltp.errors import TouchError
from cltp.texts.stock_tokenizer import StockTokenizer
from cltp.texts.tokenizer import SETTINGS_FILE, Words, names_our_tokens

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
        lm: A Qwen2, Qwen2.5-VL or Qwen3 of transformers, or a ``cltp.llm.stored_lm.StoredLm``.
        words: Our tokenizer; None for a stock checkpoint.
        stock: The checkpoint's own tokenizer; None for ours.

    Raises:
        TouchError: Not one tokenizer, or one with more tokens than the model embeds.
    """

    def __init__(
        self, lm: Any, *, words: Words | None = None, stock: StockTokenizer | None = None
    ) -> None:
        tokens = words if stock is None else stock
        if tokens is None or (words is None) == (stock is None):
            raise TouchError("a language model needs one tokenizer: ours or its own")
        self.lm, self.words, self.stock, self.tokens = lm, words, stock, tokens
        rows = int(lm.get_input_embeddings().weight.shape[0])
        if stock is not None and stock.highest >= rows:
            raise TouchError(
                f"the tokenizer has {stock.highest + 1} tokens, the language model {rows}: they "
                "don't belong together; take both from one folder"
            )

    @property
    def dim(self) -> int:
        """Width of the input embeddings."""
        return int(self.lm.get_input_embeddings().weight.shape[1])

    @property
    def end(self) -> int:
        """The token that ends a reply."""
        return self.tokens.eos

    @property
    def begin(self) -> list[int]:
        """Tokens before the touch; a stock checkpoint's turn of a person begins with some."""
        return [] if self.stock is None else self.stock.begin

    def actions(self) -> list[list[int]]:
        """Tokens of the eight actions as they follow ``CUE``."""
        if self.words is not None:
            return [[number] for number in self.words.actions]
        return self.tokens.actions  # type: ignore[return-value]  # a stock one has lists

    def prompt(self, text: str) -> list[int]:
        """Tokens between the touch and the reply."""
        return self.tokens.prompt_ids(text)

    def encode(self, text: str) -> list[int]:
        """Tokens of a part of a reply."""
        return self.tokens.encode(text)

    def decode(self, ids: Sequence[int]) -> str:
        return self.tokens.decode(ids)

    def embed(self, ids: Sequence[int]) -> Tensor:
        """Input embeddings of tokens, shape (T, D)."""
        table: Tensor = self.lm.get_input_embeddings().weight
        return table[torch.tensor(list(ids), dtype=torch.long, device=table.device)]


def load_language(folder: Path, dtype: torch.dtype = torch.float32) -> Language:
    """Read a language model's directory in transformers' layout, with our tokenizer or its own.

    Args:
        folder: A Qwen2, Qwen2.5 (which is a Qwen2), Qwen2.5-VL or Qwen3, or one of ours.
        dtype: Precision of its weights in memory.

    Raises:
        TouchError: Missing, damaged, another architecture, without a tokenizer, or weights that
            don't fit strictly.
    """
    import transformers

    kinds: dict[str, Any] = {
        "qwen2": transformers.Qwen2ForCausalLM,
        "seed_oss": transformers.SeedOssForCausalLM,  # how ours is stored (cltp.llm.stored_lm)
        "qwen2_5_vl": transformers.Qwen2_5_VLForConditionalGeneration,
        "qwen3": transformers.Qwen3ForCausalLM,
    }
    folder = Path(folder)
    if not folder.is_dir():
        raise TouchError(
            f"no language model could be read from {folder}: it is not a directory; name one that "
            "transformers' save_pretrained wrote"
        )
    try:
        config = transformers.AutoConfig.from_pretrained(folder, local_files_only=True)
        kind = type(config).model_type  # transformers 4's object may give its text model's instead
    except Exception as error:  # transformers raises errors of many kinds for a bad configuration
        reason = str(error).splitlines()[0] if str(error) else repr(error)
        raise TouchError(f"no language model could be read from {folder}: {reason}") from error
    if kind not in kinds:
        raise TouchError(f"{folder} holds a {kind} model; Tac3D-LLM takes {' or '.join(kinds)}")
    words, stock = None, None
    try:
        words = Words.load(folder)
    except TouchError:
        if (folder / SETTINGS_FILE).exists() and names_our_tokens(folder):
            raise
        stock = StockTokenizer.load(folder)
    lm = load_strictly(kinds[kind], folder, "language model", dtype=dtype).eval()
    return Language(lm, words=words, stock=stock)
