"""The tokenizer of a language model that others trained, for our exchanges.

Actions have no tokens of their own there: they are spelled. A reply is cut into the pieces of our
own tokenizer first, and each piece is encoded by itself. So the parts of a grammar, which begin
where pieces do, have the same tokens alone as in the whole reply that was learned
(``cltp.llm.constrained``). What a person types is encoded as the model knows it, and never as a
control token.

Not here: our own tokenizer (``cltp.texts.tokenizer``).
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

from tokenizers import Regex, pre_tokenizers

from cltp.errors import TouchError
from cltp.texts.tokenizer import ACTIONS, PIECES

USER_BEGIN, USER_END = "<|im_start|>user\n", "<|im_end|>\n<|im_start|>assistant\n"
"""What stands before the touch and behind the prompt. Source: Qwen's chat template."""

LONGEST_PROMPT = 256
"""Most tokens of a prompt; of a longer one, beginning and end remain, half each."""

TOKENIZER_FILES = ("tokenizer.json", "vocab.json", "tokenizer.model")
"""Files of which a folder with a tokenizer has one."""

SAMPLE = (
    "smooth sphere or ellipsoid, slight 0.12-0.21 mm, centered x +0.4 y -1.1, tiny 2.1 %, 0.43 N. "
    "Goal 0.42 - 0.51 N. Action: <move_down>. It is off centre."
)
"""A reply that every tokenizer must be able to spell."""

_CUT = rf" ?(?:{'|'.join(ACTIONS)})|{PIECES}"


class StockTokenizer:
    """Encodes prompts and replies by a tokenizer of transformers.

    Args:
        tokenizer: A fast tokenizer of transformers.
        source: Where it is from, for errors.

    Raises:
        TouchError: It has no token that ends a reply, or can't spell a reply.
    """

    def __init__(self, tokenizer: Any, source: str = "the tokenizer") -> None:
        self._tokenizer = tokenizer
        self._cut = pre_tokenizers.Split(Regex(_CUT), behavior="isolated")
        self._piece = lru_cache(65_536)(self._encoded)
        if tokenizer.eos_token_id is None:
            raise TouchError(f"{source} names no eos_token, so that no reply could end; add one")
        self.eos = int(tokenizer.eos_token_id)
        self.pad = int(self.eos if tokenizer.pad_token_id is None else tokenizer.pad_token_id)
        if self.decode(self.encode(SAMPLE)) != SAMPLE:
            raise TouchError(
                f"{source} can't spell a reply: {SAMPLE!r} becomes "
                f"{self.decode(self.encode(SAMPLE))!r:.120}; take a model whose tokenizer is a "
                "byte-level one, as those of Qwen are"
            )
        self.begin = self._control(USER_BEGIN)
        self._end = self._control(USER_END)

    @classmethod
    def load(cls, folder: Path) -> StockTokenizer:
        """Read the tokenizer of a folder in transformers' layout.

        Raises:
            TouchError: It has none, or one that can't be used.
        """
        import transformers  # its import takes seconds

        if not any((folder / name).is_file() for name in TOKENIZER_FILES):
            raise TouchError(
                f"{folder} has no tokenizer ({', '.join(TOKENIZER_FILES)}); save it beside the "
                "model by transformers' tokenizer.save_pretrained"
            )
        try:
            tokenizer = transformers.AutoTokenizer.from_pretrained(folder, local_files_only=True)
        except Exception as error:  # transformers raises errors of many kinds for damaged files
            reason = str(error).splitlines()[0] if str(error) else repr(error)
            raise TouchError(f"no tokenizer could be read from {folder}: {reason}") from error
        return cls(tokenizer, f"the tokenizer in {folder}")

    def save(self, folder: Path) -> None:
        """Write it into a folder, as transformers does."""
        self._tokenizer.save_pretrained(folder)

    @property
    def highest(self) -> int:
        """The highest number of a token."""
        return max(self._tokenizer.get_vocab().values())

    @property
    def actions(self) -> list[list[int]]:
        """Tokens of each of ``ACTIONS`` behind a word."""
        return [self.encode(f" {action}") for action in ACTIONS]

    def prompt_ids(self, text: str) -> list[int]:
        """Tokens between the touch and the reply."""
        ids = self._encoded(text)
        if len(ids) > LONGEST_PROMPT:
            ids = ids[: LONGEST_PROMPT // 2] + ids[-LONGEST_PROMPT // 2 :]
        return [*ids, *self._end]

    def encode(self, text: str) -> list[int]:
        """Tokens of a reply, or of a part of one."""
        return self.encode_marked(text)[0]

    def encode_marked(self, text: str) -> tuple[list[int], list[bool]]:
        """Tokens of a reply, and which of them spell an action."""
        ids: list[int] = []
        marks: list[bool] = []
        for piece, _ in self._cut.pre_tokenize_str(text):
            part = self._piece(piece)
            ids += part
            marks += [piece.strip() in ACTIONS] * len(part)
        return ids, marks

    def decode(self, ids: Sequence[int]) -> str:
        """Text of tokens, without control tokens."""
        text = self._tokenizer.decode(
            list(ids), skip_special_tokens=True, clean_up_tokenization_spaces=False
        )
        return str(text)

    def fingerprint(self) -> str:
        """SHA-256 of the vocabulary, as ``cltp.texts.tokenizer.Words.fingerprint``."""
        vocabulary = sorted(self._tokenizer.get_vocab().items(), key=lambda item: item[1])
        return hashlib.sha256(json.dumps(vocabulary).encode()).hexdigest()

    def _encoded(self, text: str) -> list[int]:
        """Tokens of plain text; a control token that is spelled out in it stays text."""
        encoded = self._tokenizer(text, add_special_tokens=False, split_special_tokens=True)
        return [int(i) for i in encoded["input_ids"]]

    def _control(self, text: str) -> list[int]:
        """Tokens of a text of our own, in which control tokens are meant."""
        return [int(i) for i in self._tokenizer(text, add_special_tokens=False)["input_ids"]]
