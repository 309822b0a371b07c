"""The tokens of a grammar's parts, as tries, under one tokenizer; each is made once."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import lru_cache
from weakref import WeakKeyDictionary

from cltp.errors import TouchError
from cltp.llm.constrained.grammar import NumberRange

MAX_TEXTS = 4096
"""Texts whose tokens are kept: far more than a grammar has; goals come and go."""

_PIECE = re.compile(r" ?[+-]?\d|\.\d")
"""Pieces of a number that no token crosses, as in ``cltp.texts.tokenizer.PIECES``."""


class Node:
    """A place in a trie.

    Attributes:
        children: Places after each token that may follow.
        inside: Indices of the texts that lie here or beyond.
        ended: Index of the text that ends here; None where none does.
        most: The largest of ``inside``.
    """

    __slots__ = ("children", "ended", "inside", "most")

    def __init__(self) -> None:
        self.children: dict[int, Node] = {}
        self.inside: list[int] = []
        self.ended: int | None = None
        self.most = -1

    def add(self, index: int, tokens: Sequence[int]) -> None:
        """Let a text of these tokens end below this place."""
        node = self
        for token in tokens:
            node = node.children.setdefault(token, Node())
            node.inside.append(index)
            node.most = max(node.most, index)
        node.ended = index


class TextTokens:
    """Tokens of texts, kept.

    Args:
        encode: Gives the tokens of a text.
    """

    def __init__(self, encode: Callable[[str], list[int]]) -> None:
        self._encode = encode
        self.of = lru_cache(MAX_TEXTS)(lambda text: tuple(encode(text)))
        self.trie = lru_cache(MAX_TEXTS)(self._trie)
        self._numbers: WeakKeyDictionary[NumberRange, tuple[Node, Node]] = WeakKeyDictionary()

    def _trie(self, texts: tuple[str, ...]) -> Node:
        """A trie of the texts of a choice.

        Raises:
            TouchError: The tokens of one are the beginning of those of another.
        """
        root = Node()
        for index, text in enumerate(texts):
            root.add(index, self.of(text))
        pending = [root]
        while pending:
            node = pending.pop()
            if node.children and node.ended is not None:
                raise TouchError(f"{texts[node.ended]!r} begins another text of the same choice")
            pending += node.children.values()
        return root

    def number(self, part: NumberRange) -> tuple[Node, Node]:
        """Tries of a number's texts after a space, and after '-' as the end of an interval."""
        if part not in self._numbers:
            first = Node()
            for index, text in enumerate(part.texts):
                first.add(index, self._pieces(f" {text}"))
            self._numbers[part] = first, self._behind_dash(first) if part.interval else Node()
        return self._numbers[part]

    def _behind_dash(self, first: Node) -> Node:
        """The same numbers after '-': other tokens up to the first digit, the same ones beyond."""
        second = Node()
        for digit in "0123456789":
            below: Node | None = first
            for token in self.of(f" {digit}"):
                below = below.children.get(token) if below is not None else None
            if below is None:
                continue
            *path, last = self.of(f"-{digit}")
            node = second
            for token in path:
                node = node.children.setdefault(token, Node())
                node.most = max(node.most, below.most)
            node.children[last] = below
        return second

    def _pieces(self, number: str) -> list[int]:
        return [token for piece in _PIECE.findall(number) for token in self.of(piece)]
