"""Patterns that match nothing without a digit, compiled at the first text that has one.

A third of all patterns are such, and most instructions have no number: for these they would take a
quarter of a second of every start, and find nothing.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator
from functools import cached_property

_DIGIT = re.compile(r"\d")


class NumberPattern:
    """A regular expression of which every match has a digit, in it or in a look beside it.

    Its methods are those of ``re.Pattern``.

    Args:
        pattern: The expression. That a digit is needed is not checked here, but in a test.
    """

    def __init__(self, pattern: str) -> None:
        self.pattern = pattern

    @cached_property
    def _compiled(self) -> re.Pattern[str]:
        return re.compile(self.pattern)

    def search(self, text: str, begin: int = 0, end: int = sys.maxsize) -> re.Match[str] | None:
        return self._compiled.search(text, begin, end) if _DIGIT.search(text) else None

    def match(self, text: str) -> re.Match[str] | None:
        return self._compiled.match(text) if _DIGIT.search(text) else None

    def fullmatch(self, text: str) -> re.Match[str] | None:
        return self._compiled.fullmatch(text) if _DIGIT.search(text) else None

    def finditer(self, text: str) -> Iterator[re.Match[str]]:
        return self._compiled.finditer(text) if _DIGIT.search(text) else iter(())

    def sub(self, replacement: str | Callable[[re.Match[str]], str], text: str) -> str:
        return self._compiled.sub(replacement, text) if _DIGIT.search(text) else text
