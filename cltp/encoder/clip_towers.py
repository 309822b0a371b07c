"""The frozen, pre-aligned towers E_L and E_I: any CLIP in transformers' format, or our small one.

Not here: the alignment of the small one (``cltp.train.clip``).
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import torch
from tokenizers import Tokenizer
from torch import Tensor, nn

from cltp.encoder.render import IMAGE_PX
from cltp.encoder.strict_loading import load_strictly
from cltp.errors import TouchError
from cltp.texts.tokenizer import Words

if TYPE_CHECKING:  # its import takes seconds: only where it is needed
    from transformers import CLIPModel

TEXT_LENGTH = 40
"""Longest text of the small CLIP, in tokens; captions of contact states take about 25."""


def small_clip(words: Words, *, dim: int = 128, layers: int = 2) -> CLIPModel:
    """A CLIP with random weights; 1 M parameters by default."""
    from transformers import CLIPConfig, CLIPModel

    tower = {
        "hidden_size": dim,
        "intermediate_size": 3 * dim,
        "num_hidden_layers": layers,
        "num_attention_heads": max(1, dim // 32),
        "projection_dim": dim,
    }
    config = CLIPConfig(
        text_config={
            **tower,
            "vocab_size": len(words),
            "max_position_embeddings": TEXT_LENGTH,
            "bos_token_id": words.bos,
            "eos_token_id": words.eos,
            "pad_token_id": words.pad,
        },
        vision_config={**tower, "image_size": IMAGE_PX, "patch_size": 8},
        projection_dim=dim,
    )
    return CLIPModel(config)


class Tokens(Protocol):
    """A tokenizer as the tower of language needs it."""

    pad: int
    bos: int
    eos: int

    def encode(self, text: str) -> list[int]:
        """Tokens of a text, without start and end."""
        ...

    def fingerprint(self) -> str:
        """SHA-256 of the whole tokenizer."""
        ...


class StockTokens:
    """The tokenizer of a stock CLIP checkpoint: ``tokenizer.json`` as its makers wrote it.

    Args:
        folder: Folder of the checkpoint.
        config: Configuration of its text tower, which has the numbers of start and end.

    Raises:
        TouchError: The file is missing or damaged.
    """

    def __init__(self, folder: Path, config: Any) -> None:
        path = Path(folder) / "tokenizer.json"
        try:
            self._tokenizer = Tokenizer.from_file(str(path))
        except Exception as error:  # the library raises bare Exception for anything it can't read
            raise TouchError(f"no tokenizer could be read from {path}: {error}") from error
        # Old configurations have 0 and 2, which are letters: the vocabulary comes first.
        first, last = (self._tokenizer.token_to_id(token) for token in STOCK_ENDS)
        self.bos = int(config.bos_token_id if first is None else first)
        self.eos = int(config.eos_token_id if last is None else last)
        self.pad = self.eos
        self.has_ends = first is not None and last is not None

    def encode(self, text: str) -> list[int]:
        return list(self._tokenizer.encode(text, add_special_tokens=False).ids)

    def fingerprint(self) -> str:
        return hashlib.sha256(self._tokenizer.to_str().encode()).hexdigest()


STOCK_ENDS = ("<|startoftext|>", "<|endoftext|>")


class Towers(nn.Module):
    """E_L and E_I of a CLIP, frozen; they take texts and pixels.

    Args:
        clip: The model.
        words: Its tokenizer.
    """

    def __init__(self, clip: CLIPModel, words: Tokens) -> None:
        super().__init__()
        self.clip = clip.eval().requires_grad_(False)
        self.words = words

    @property
    def feature_dim(self) -> int:
        return int(self.clip.config.projection_dim)

    @torch.no_grad()
    def texts(self, texts: Sequence[str]) -> Tensor:
        """Features of texts, shape (B, F), normalised."""
        return text_features(self.clip, self.words, texts)

    @torch.no_grad()
    def images(self, pixels: Tensor) -> Tensor:
        """Features of images (B, 3, 64, 64), shape (B, F), normalised."""
        return image_features(self.clip, pixels)


def text_features(clip: CLIPModel, words: Tokens, texts: Sequence[str]) -> Tensor:
    """E_L: features of texts, shape (B, F), normalised.

    The feature of a text is that of its last token. transformers does so too, except where the last
    token has the number 2, as ours does: for old checkpoints it then takes the token of the largest
    number, somewhere inside the text, where causal attention has not seen the rest.
    """
    longest = clip.text_model.embeddings.position_embedding.num_embeddings
    rows = [[words.bos, *words.encode(text)[: longest - 2], words.eos] for text in texts]
    width = max(len(row) for row in rows)
    ids = torch.tensor([row + [words.pad] * (width - len(row)) for row in rows])
    mask = torch.tensor([[1] * len(row) + [0] * (width - len(row)) for row in rows])
    output = clip.text_model(input_ids=ids.to(clip.device), attention_mask=mask.to(clip.device))
    ends = mask.sum(dim=1).to(clip.device) - 1
    last = output.last_hidden_state[torch.arange(len(rows), device=clip.device), ends]
    return torch.nn.functional.normalize(clip.text_projection(last), dim=-1)


def image_features(clip: CLIPModel, pixels: Tensor) -> Tensor:
    """E_I: features of images, shape (B, F), normalised."""
    size = int(clip.vision_model.embeddings.image_size)
    if pixels.shape[-1] != size:
        pixels = torch.nn.functional.interpolate(pixels, (size, size), mode="bilinear")
    output = clip.get_image_features(pixel_values=(pixels.to(clip.device) - 0.5) / 0.25)
    return torch.nn.functional.normalize(output.pooler_output, dim=-1)


def load_towers(folder: Path) -> Towers:
    """Towers of a local CLIP directory in transformers' layout, frozen.

    Raises:
        TouchError: The directory, its weights or its tokenizer are missing or don't fit.
    """
    from transformers import CLIPModel

    clip = load_strictly(CLIPModel, folder, "CLIP")
    try:
        return Towers(clip, Words.load(folder))
    except TouchError:
        stock = StockTokens(folder, clip.config.text_config)
        if stock.has_ends:
            return Towers(clip, stock)
        raise
