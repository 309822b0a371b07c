"""Text to tokens: a byte-level BPE of our own sentences, with one token for each action.

Numbers are encoded digit by digit: ' -3.42' is ' -3', '.4' and '2'. Any text can be encoded: words
outside the vocabulary become several tokens, if need be one for each byte.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Sequence
from itertools import chain
from pathlib import Path

from tokenizers import AddedToken, Regex, Tokenizer, decoders, models, pre_tokenizers, trainers

from cltp.errors import TouchError

PAD, BOS, EOS, USER, REPLY = "<pad>", "<bos>", "<eos>", "<user>", "<reply>"
CONTROL = (PAD, BOS, EOS, USER, REPLY)

ACTIONS = (
    "<move_up>",
    "<move_down>",
    "<move_left>",
    "<move_right>",
    "<increase_force>",
    "<decrease_force>",
    "<reset>",
    "<none>",
)
"""The eight choices for the action in D_t. To ``cltp`` they are words only."""

FILE = "tokenizer.json"

PIECES = r" ?[+-]?\d|\.\d| ?\p{L}+| ?[^\s\p{L}\p{N}]+|\s+"
"""Units that no token crosses: one digit with its sign and space or with the point before it, a
word, a run of other signs."""

_ACTION = re.compile(r"(?<=\S)(?=(?:" + "|".join(ACTIONS) + "))")


class Words:
    """A tokenizer.

    Args:
        tokenizer: Has all of ``CONTROL`` and ``ACTIONS`` as single tokens.

    Raises:
        TouchError: One of them is missing.
    """

    def __init__(self, tokenizer: Tokenizer) -> None:
        self._tokenizer = tokenizer
        numbers = {token: tokenizer.token_to_id(token) for token in (*CONTROL, *ACTIONS)}
        ids = {token: number for token, number in numbers.items() if number is not None}
        missing = [token for token in numbers if token not in ids]
        if missing:
            raise TouchError(
                f"the tokenizer lacks {' '.join(missing)}; it belongs to another version of weights"
            )
        self.pad, self.bos, self.eos, self.user, self.reply = (ids[t] for t in CONTROL)
        self.actions = [ids[token] for token in ACTIONS]

    @classmethod
    def train(cls, texts: Iterable[str], size: int = 1024) -> Words:
        """Learn a vocabulary of at most ``size`` tokens from texts. Deterministic."""
        tokenizer = Tokenizer(models.BPE())
        tokenizer.pre_tokenizer = pre_tokenizers.Sequence(
            [
                pre_tokenizers.Split(Regex(PIECES), behavior="isolated"),
                pre_tokenizers.ByteLevel(add_prefix_space=False, use_regex=False),
            ]
        )
        tokenizer.decoder = decoders.ByteLevel()
        trainer = trainers.BpeTrainer(
            vocab_size=size,
            min_frequency=2,
            special_tokens=[
                *(AddedToken(token, special=True) for token in CONTROL),
                # The space before an action belongs to the action's token.
                *(AddedToken(token, special=True, lstrip=True) for token in ACTIONS),
            ],
            initial_alphabet=pre_tokenizers.ByteLevel.alphabet(),
            show_progress=False,
        )
        # Pieces of numbers first, so that each becomes a token even if the texts have few.
        pieces = [f" {d} +{d} -{d}.{d}" for d in range(10)] * 1000
        tokenizer.train_from_iterator(chain(pieces, texts), trainer)
        return cls(tokenizer)

    @classmethod
    def load(cls, folder: Path) -> Words:
        """Read ``tokenizer.json`` of a folder.

        Raises:
            TouchError: It is missing, damaged, or lacks the tokens of this program.
        """
        path = Path(folder) / FILE
        try:
            return cls(Tokenizer.from_file(str(path)))
        except TouchError:
            raise
        except Exception as error:  # the library raises bare Exception for any unreadable file
            raise TouchError(f"no tokenizer could be read from {path}: {error}") from error

    def save(self, folder: Path) -> None:
        """Write ``tokenizer.json`` into a folder."""
        Path(folder).mkdir(parents=True, exist_ok=True)
        self._tokenizer.save(str(Path(folder) / FILE))

    def __len__(self) -> int:
        return self._tokenizer.get_vocab_size()

    def encode(self, text: str, *, trusted: bool = True) -> list[int]:
        """Tokens of any text.

        With ``trusted=False``, for a person's text, control tokens and actions spelled out in it
        are encoded as letters, never as the tokens themselves.
        """
        if not trusted:
            for token in (*CONTROL, *ACTIONS):
                text = text.replace(token, token.strip("<>"))
        return list(self._tokenizer.encode(text, add_special_tokens=False).ids)

    def has_token(self, word: str) -> bool:
        """Whether a word is a single token, as words that were common in training are."""
        return len(self.encode(f" {word}", trusted=False)) == 1

    def decode(self, ids: Sequence[int]) -> str:
        """Text of tokens: actions are spelled out after a space, control tokens are left out."""
        control = {self.pad, self.bos, self.eos, self.user, self.reply}
        spoken = [i for i in ids if i not in control]
        return _ACTION.sub(" ", self._tokenizer.decode(spoken, skip_special_tokens=False))

    def fingerprint(self) -> str:
        """SHA-256 of the vocabulary; weights store that of the tokenizer of their training."""
        vocabulary = sorted(self._tokenizer.get_vocab().items(), key=lambda item: item[1])
        return hashlib.sha256(json.dumps(vocabulary).encode()).hexdigest()
