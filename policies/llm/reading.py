"""Reads the contact out of D_t: its words, each perhaps beside a rival, and its numbers.

Not here: the action (``policies.extraction``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from cltp.tactile.states import CLASSES, Side
from cltp.texts.captions import alternatives
from policies.llm.text import NOTHING, OR


@dataclass(frozen=True, slots=True, kw_only=True)
class SaidContact:
    """The contact of a D_t.

    Attributes:
        words: Words of each dimension that is named; the second of two is the rival of the first.
        numbers: Ends of each of ``cltp.tactile.states.NUMBERS``, twice the same where it is said
            as one value: lengths in mm, the area as a fraction, the force in N. Empty without
            contact.
        cut: Sides that cut the contact off.
    """

    words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    numbers: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    cut: frozenset[Side] = frozenset()

    @property
    def is_doubtful(self) -> bool:
        """Whether a word stands beside a rival, or a number is an interval."""
        has_rival = any(len(words) > 1 for words in self.words.values())
        return has_rival or any(low < high for low, high in self.numbers.values())


def read_contact(text: str) -> SaidContact | None:
    """The contact that a D_t begins with; None where it begins otherwise."""
    if text.startswith(NOTHING):
        return SaidContact()
    match = _CONTACT.match(text)
    if match is None:
        return None
    said = {name: match[name] for name in CLASSES}
    numbers = {name: _ends(match[name]) for name in _NUMBERS}
    low, high = numbers["area_fraction"]
    numbers["area_fraction"] = (low / 100, high / 100)
    return SaidContact(
        words={name: tuple(part.split(OR)) for name, part in said.items() if part is not None},
        numbers=numbers,
        cut=frozenset(Side(side) for side in (match["cut"] or "").split()),
    )


def _ends(text: str) -> tuple[float, float]:
    low, _, high = text.partition("-") if text[0] not in "+-" else (text, "", "")
    return float(low), float(high or low)


def _word(name: str) -> str:
    word = f"(?:{alternatives(CLASSES[name])})"
    return rf"(?P<{name}>{word}(?:{OR}{word})?)"


def _number(name: str) -> str:
    value = r"\d+(?:\.\d+)?"
    return rf"(?P<{name}>{value}(?:-{value})?)"


_NUMBERS = ("depth_mm", "x_mm", "y_mm", "area_fraction", "force_n")
_PLACE = r"x (?P<x_mm>[+-]\d+\.\d) y (?P<y_mm>[+-]\d+\.\d)"
_SIDE = alternatives(Side)
_CONTACT = re.compile(
    rf"(?:object|{_word('texture')}(?: |(?=,)))?(?:{_word('shape')})?, "
    rf"{_word('depth')} {_number('depth_mm')} mm, {_word('position')} {_PLACE}, "
    rf"{_word('area')} {_number('area_fraction')} %, {_number('force_n')} N"
    rf"(?:, cut (?P<cut>(?:{_SIDE})(?: (?:{_SIDE}))*))?\.",
    re.ASCII,
)
