"""One force that a text names: a value, a most or a least."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

MARK = "#"
"""Stands for a quantity in the rest of a text."""

WORKED_OUT = "⇒"
"""Before a force that stands in place of the values before it."""

Kind = Literal["value", "most", "least"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Force:
    """One force that a text names.

    Attributes:
        kind: A value to hold with, the most, or the least.
        value_n: The force [N].
        words: The words that name it.
        is_told: Whether it is what an earlier grip told: a most of this kind raises no limit.
        within_n: Lowest and highest force of a stated tolerance [N]; None where none is stated.
    """

    kind: Kind
    value_n: float
    words: str
    is_told: bool = False
    within_n: tuple[float, float] | None = None


NO_OTHER_FORCE = r"(?! (?:with|at|under|below|from|using|on|above|over|beyond)(?: (?:only|just|about|around|roughly|a force of))* (?:\.?\d|#))"
"""Behind an outcome: one that has a force of its own is none of the force before it, as in 'under 1 N,
but it slipped with 0.3 N'."""

AS_BEFORE = r"\b(?:same|again|also|too|as (?:before|yesterday|last time|usual)|like (?:yesterday|last time|before)|repeat|still)\b"
"""What asks for a force of another day once more."""
