"""A parser under test by mutated input: how a case is made, who reads it, what it may raise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random


@dataclass(frozen=True, slots=True, kw_only=True)
class FuzzTarget:
    """One parser.

    Attributes:
        name: Name on the command line (``make fuzz PARSER=name``).
        make_case: Draws one mutated input from a seeded generator.
        read: Gives it to the parser in this process; must return within a second.
        documented: Errors that the parser may raise; any other is a finding.
    """

    name: str
    make_case: Callable[[Random], bytes]
    read: Callable[[bytes], object]
    documented: tuple[type[Exception], ...]
