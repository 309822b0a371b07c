"""A small classifier of short texts, which knows words by their letters.

A word is the mean of the embeddings of its runs of three to five letters and of itself, hashed
into a table (as in Bojanowski et al., Enriching Word Vectors with Subword Information, 2017): a
misspelled or unknown word lies near those that it shares letters with. Transformer layers over the
words, and the mean and the largest of their outputs, give a logit for each class.

Not here: its file (``cltp.checkpoints.stored_classifier``), what the classes are, and how it is
trained (``tacgrasp.training.query_classifier``).
"""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import torch
from torch import Tensor, nn

LONGEST_WORD = 40
"""Letters of a word that count: more than any has; what is pasted may have more."""

_RUNS = (3, 4, 5)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClassifierConfig:
    """What a classifier is made of.

    Attributes:
        classes: Names of the classes.
        rows: Rows of the table that runs of letters are hashed into.
        dim: Width of a word.
        layers: Number of transformer layers.
        heads: Number of their heads.
        longest: Words of a text that count.
    """

    classes: tuple[str, ...]
    rows: int = 16_384
    dim: int = 128
    layers: int = 2
    heads: int = 4
    longest: int = 48


class WordBatch(NamedTuple):
    """Words of B texts, N altogether and at most L in one.

    Attributes:
        runs: Rows of the table, of all words one after another.
        begins: Shape (N,): where the runs of each word begin.
        text: Shape (N,): the text of each word.
        place: Shape (N,): its place in the text.
        lengths: Shape (B,): words of each text.
        hidden: Shape (N,), bool: which words are not to be seen; None where all are.
    """

    runs: Tensor
    begins: Tensor
    text: Tensor
    place: Tensor
    lengths: Tensor
    hidden: Tensor | None = None


@lru_cache(maxsize=65_536)
def _runs_of(word: str, rows: int) -> tuple[int, ...]:
    marked = f"<{word[:LONGEST_WORD]}>"
    runs = [marked[at : at + n] for n in _RUNS for at in range(len(marked) - n + 1)]
    return tuple(zlib.crc32(run.encode()) % rows for run in (marked, *runs))


class TextClassifier(nn.Module):
    """Words to logits of classes.

    Args:
        config: Its sizes and classes.
    """

    def __init__(self, config: ClassifierConfig) -> None:
        super().__init__()
        self.config, dim = config, config.dim
        self.table = nn.EmbeddingBag(config.rows, dim, mode="mean")
        nn.init.normal_(self.table.weight, std=0.05)
        self.step: Tensor
        self.register_buffer("step", torch.ones(config.rows, 1))  # of a table stored in 8 bits
        self.places = nn.Parameter(torch.randn(config.longest, dim) * 0.02)
        self.unseen = nn.Parameter(torch.randn(dim) * 0.02)
        self.word_norm, self.norm = nn.LayerNorm(dim), nn.LayerNorm(dim)
        layer = nn.TransformerEncoderLayer(
            dim, config.heads, 2 * dim, activation="gelu", batch_first=True, norm_first=True
        )
        self.layers = nn.TransformerEncoder(layer, config.layers, enable_nested_tensor=False)
        self.logits = nn.Linear(2 * dim, len(config.classes))

    def batch(self, texts: Sequence[Sequence[str]], hidden: Tensor | None = None) -> WordBatch:
        """Prepare texts, each at least one word.

        Args:
            texts: Words of each text.
            hidden: Which words are not to be seen, of all texts one after another.
        """
        runs: list[int] = []
        begins, text, place, lengths = [], [], [], []
        for number, words in enumerate(texts):
            kept = words[: self.config.longest]
            lengths.append(len(kept))
            for at, word in enumerate(kept):
                begins.append(len(runs))
                runs += _runs_of(word, self.config.rows)
                text.append(number)
                place.append(at)
        return WordBatch(
            runs=torch.tensor(runs),
            begins=torch.tensor(begins),
            text=torch.tensor(text),
            place=torch.tensor(place),
            lengths=torch.tensor(lengths),
            hidden=hidden,
        )

    def forward(self, batch: WordBatch) -> Tensor:
        """Logits of the classes, shape (B, number of classes)."""
        words = self.table(batch.runs, batch.begins)
        if batch.hidden is not None:
            words = torch.where(batch.hidden[:, None], self.unseen, words)
        longest = int(batch.lengths.max())
        rows = words.new_zeros(len(batch.lengths), longest, self.config.dim)
        rows = rows.index_put((batch.text, batch.place), self.word_norm(words))
        is_past = torch.arange(longest)[None] >= batch.lengths[:, None]
        out = self.layers(rows + self.places[:longest], src_key_padding_mask=is_past)
        out = self.norm(out)
        mean = out.masked_fill(is_past[..., None], 0.0).sum(1) / batch.lengths[:, None]
        largest = out.masked_fill(is_past[..., None], -1e4).amax(1)
        logits: Tensor = self.logits(torch.cat([mean, largest], dim=1))
        return logits

    @torch.inference_mode()
    def log_probabilities(self, words: Sequence[str]) -> Tensor:
        """Log-probabilities of the classes for a text, shape (number of classes,)."""
        return torch.log_softmax(self(self.batch([words or ("",)]))[0], dim=-1)
