"""Text to tokens: a byte-level BPE of our own sentences, with one token for each action.

Numbers are encoded digit by digit: ' -3.42' is ' -3', '.4' and '2'. Any text can be encoded, and
decoded again: words outside the vocabulary become several tokens, if need be one for each byte, so
that no word is unknown. BPE is our choice, since each token of a reply costs time in the loop:
WordPiece and Unigram of the same size need more tokens for our sentences, and are not faster.

A folder with a tokenizer has the three files that transformers reads, and
``AutoTokenizer.from_pretrained`` gives the same tokens:

    tokenizer.json             everything: ``Words`` reads this one alone
    tokenizer_config.json      the class that takes tokenizer.json as it is; names of control tokens
    special_tokens_map.json    those names once more, for older versions of transformers
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Sequence
from itertools import chain
from pathlib import Path

from tokenizers import AddedToken, Regex, Tokenizer, decoders, models, pre_tokenizers, trainers

from cltp.atomic_write import write_atomically
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
SETTINGS_FILE = "tokenizer_config.json"
NAMES_FILE = "special_tokens_map.json"

_NAMES = {"pad_token": PAD, "bos_token": BOS, "eos_token": EOS}
_SETTINGS = {
    **_NAMES,
    "additional_special_tokens": [USER, REPLY],
    "clean_up_tokenization_spaces": False,
    "tokenizer_class": "PreTrainedTokenizerFast",
}
"""transformers' settings. Its other classes replace parts of tokenizer.json by their own."""

PIECES = r" ?[+-]?\d|\.\d| ?\p{L}+| ?[^\s\p{L}\p{N}]+|\s+"
"""Units that no token crosses: one digit with its sign and space or with the point before it, a
word, a run of other signs."""

_BEFORE_ACTION = r"(?<=\S)(?=(?:" + "|".join(ACTIONS) + "))"
"""Where the space goes that an action's token has swallowed."""

WHOLE_REPEATS = 50
"""How often a word that must be one token counts in training. Our choice: above the words that few
texts have, far below those of every sentence."""

LONGEST_PROMPT = 96
"""Most tokens of a prompt."""


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
        tokenizer.decoder = _decoder()  # that of earlier layouts forgets the space before an action

    @classmethod
    def train(cls, texts: Iterable[str], size: int = 1024, whole: Sequence[str] = ()) -> Words:
        """Learn a vocabulary of at most ``size`` tokens from texts. Deterministic.

        Args:
            texts: What is read and said.
            size: Largest number of tokens.
            whole: Words of letters that become one token each behind a space, however rare they
                are in the texts.

        Raises:
            TouchError: ``size`` is too small for the words of ``whole``.
        """
        tokenizer = Tokenizer(models.BPE())
        tokenizer.pre_tokenizer = pre_tokenizers.Sequence(
            [
                pre_tokenizers.Split(Regex(PIECES), behavior="isolated"),
                pre_tokenizers.ByteLevel(add_prefix_space=False, use_regex=False),
            ]
        )
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
        spaced = [f" {word}" for word in whole] * WHOLE_REPEATS
        tokenizer.train_from_iterator(chain(pieces, spaced, texts), trainer)
        words = cls(_in_todays_layout(tokenizer))
        split = [word for word in whole if not words.has_token(word)]
        if split:
            raise TouchError(
                f"{len(split)} of {len(whole)} words that must be one token are several in a "
                f"vocabulary of {size}, as is {split[0]!r:.40}; give a larger size, or words of "
                "letters alone"
            )
        return words

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
        """Write the three files of a tokenizer into a folder.

        A tokenizer of an earlier layout is written in today's, with the same tokens.
        """
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / FILE, _in_todays_layout(self._tokenizer).to_str(pretty=True))
        for name, content in ((SETTINGS_FILE, _SETTINGS), (NAMES_FILE, _NAMES)):
            write_atomically(folder / name, json.dumps(content, indent=2) + "\n")

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

    def encode_marked(self, text: str) -> tuple[list[int], list[bool]]:
        """Tokens of a reply, and which of them name an action."""
        ids = self.encode(text)
        return ids, [i in self.actions for i in ids]

    def prompt_ids(self, text: str) -> list[int]:
        """Tokens before a reply: ``<user> prompt <reply>``.

        Of a prompt with more than ``LONGEST_PROMPT`` tokens, beginning and end remain, half each.
        """
        ids = self.encode(text, trusted=False)
        if len(ids) > LONGEST_PROMPT:
            ids = ids[: LONGEST_PROMPT // 2] + ids[-LONGEST_PROMPT // 2 :]
        return [self.user, *ids, self.reply]

    def has_token(self, word: str) -> bool:
        """Whether a word is a single token, as words that were common in training are."""
        return len(self.encode(f" {word}", trusted=False)) == 1

    def decode(self, ids: Sequence[int]) -> str:
        """Text of tokens: actions are spelled out after a space, control tokens are left out."""
        control = {self.pad, self.bos, self.eos, self.user, self.reply}
        spoken = [i for i in ids if i not in control]
        return str(self._tokenizer.decode(spoken, skip_special_tokens=False))

    def fingerprint(self) -> str:
        """SHA-256 of the vocabulary; weights store that of the tokenizer of their training."""
        vocabulary = sorted(self._tokenizer.get_vocab().items(), key=lambda item: item[1])
        return hashlib.sha256(json.dumps(vocabulary).encode()).hexdigest()


def _decoder() -> decoders.Decoder:
    """Bytes to text, with a space before each action that follows a word."""
    return decoders.Sequence([decoders.ByteLevel(), decoders.Replace(Regex(_BEFORE_ACTION), " ")])


def _in_todays_layout(tokenizer: Tokenizer) -> Tokenizer:
    """The same tokens with today's decoder, and with actions as content.

    Training makes every token of its own special, and transformers leaves special tokens out of a
    decoded text.
    """
    content = json.loads(tokenizer.to_str())
    for token in content["added_tokens"]:
        token["special"] = token["content"] not in ACTIONS
    tokenizer = Tokenizer.from_str(json.dumps(content))
    tokenizer.decoder = _decoder()
    return tokenizer


def names_our_tokens(folder: Path) -> bool:
    """Whether transformers' settings in a folder are those of ``Words``, not of a stock model."""
    try:
        settings = json.loads((Path(folder) / SETTINGS_FILE).read_text(encoding="utf-8"))
        return all(settings.get(name) == value for name, value in _SETTINGS.items())
    except (OSError, ValueError, AttributeError, RecursionError):
        return False
