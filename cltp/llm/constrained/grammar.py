"""A grammar as data: a sequence of literals, choices between texts, and numbers in a range.

Every part of a reply except a literal has a name, and a reply has no name twice. Parts begin where
the tokenizer never joins two characters (``cltp.texts.tokenizer.PIECES``): at a space, or between
letters, digits and other signs. So the tokens of the parts are those of the whole reply.

Not here: tokens (``cltp.llm.constrained.tokens``), decoding (``cltp.llm.constrained.decode``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

_NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?")
_UNSIGNED = re.compile(r"\d+(?:\.\d+)?")
_INTERVAL = re.compile(rf"({_NUMBER.pattern})(?:-({_UNSIGNED.pattern}))?")


@dataclass(frozen=True, slots=True, eq=False)
class Verbatim:
    """A text that is always said.

    Attributes:
        text: The text.
    """

    text: str


@dataclass(frozen=True, slots=True, eq=False)
class Option:
    """One of the texts of a choice.

    Attributes:
        value: What it stands for.
        text: What is said.
        rival: What is said of it after another option that is in doubt, such as ' or rough'; ''
            where it is no rival.
        then: What follows this option alone, before what follows the choice.
    """

    value: str
    text: str
    rival: str = ""
    then: tuple[Part, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class TextChoice:
    """One of several texts, none of which is the beginning of another.

    Attributes:
        name: Name of the part.
        options: At least one.
    """

    name: str
    options: tuple[Option, ...]


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class NumberRange:
    """A number as text, or an interval such as ' 0.25-0.41', with what stands behind it.

    Attributes:
        name: Name of the part.
        texts: Every number that may be said, as text, in ascending order.
        after: Literal behind it, such as ' mm'; it begins with neither a digit nor '-'. It may be
            empty where no number begins another one and there are no intervals.
        interval: Whether two ascending numbers may be said in its place.
    """

    name: str
    texts: tuple[str, ...]
    after: str
    interval: bool = False
    _order: dict[str, int] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_order", {text: i for i, text in enumerate(self.texts)})

    def place(self, text: str) -> int | None:
        """Index of a number among ``texts``; None where it may not be said."""
        return self._order.get(text)


Part: TypeAlias = Verbatim | TextChoice | NumberRange
Grammar: TypeAlias = tuple[Part, ...]


class Segment(NamedTuple):
    """Piece of a reply that one part of a grammar allows.

    Attributes:
        name: Name of the part; '' for a literal.
        text: The piece.
        value: Value of the option, or the number or interval without space; '' for a literal.
        rival: Value of the rival; '' without one.
    """

    name: str
    text: str
    value: str = ""
    rival: str = ""


def match(grammar: Grammar, text: str) -> tuple[list[Segment], bool]:
    """Split a reply into the parts of a grammar.

    Returns:
        The segments, and whether they are the whole reply. Otherwise as much of its beginning as
        the grammar allows.
    """
    longest: list[Segment] = []
    reach = -1
    # (parts that remain, end of the text so far, segments so far), the next one to try last
    pending: list[tuple[Grammar, int, list[Segment]]] = [(grammar, 0, [])]
    while pending:
        parts, at, segments = pending.pop()
        if not parts:
            if at == len(text):
                return segments, True
            continue
        for segment, then in _ways(parts[0], text, at):
            end = at + len(segment.text)
            found = [*segments, segment]
            if end > reach:
                longest, reach = found, end
            pending.append(((*then, *parts[1:]), end, found))
    return longest, False


def _ways(part: Part, text: str, at: int) -> Iterator[tuple[Segment, Grammar]]:
    """Segments of a text from ``at`` on that a part allows, each with what must follow it."""
    if isinstance(part, Verbatim):
        if text.startswith(part.text, at):
            yield Segment("", part.text), ()
    elif isinstance(part, NumberRange):
        yield from _number_ways(part, text, at)
    else:
        for option in part.options:
            if not text.startswith(option.text, at):
                continue
            yield Segment(part.name, option.text, option.value), option.then
            if not option.rival:
                continue
            for other in part.options:
                both = option.text + other.rival
                if other.rival and other is not option and text.startswith(both, at):
                    yield Segment(part.name, both, option.value, other.value), option.then


def _number_ways(part: NumberRange, text: str, at: int) -> Iterator[tuple[Segment, Grammar]]:
    found = _NUMBER.match(text, at + 1) if text.startswith(" ", at) else None
    low = part.place(found[0]) if found else None
    if found is None or low is None:
        return
    end = found.end()
    if text.startswith("-", end) and part.interval:
        second = _UNSIGNED.match(text, end + 1)
        high = part.place(second[0]) if second else None
        if second is None or high is None or high <= low:
            return
        end = second.end()
    value = text[at + 1 : end]
    yield Segment(part.name, text[at:end], value), (Verbatim(part.after),)


def allows_number(part: NumberRange, text: str) -> bool:
    """Whether a text, such as '0.31' or '0.25-0.41', may be said in the place of a number."""
    return any(segment.value == text for segment, _ in _number_ways(part, f" {text}", 0))


def nearest_number(part: NumberRange, text: str) -> str | None:
    """The number or interval nearest to a text that may be said; None where that is none."""
    if allows_number(part, text):
        return text
    ends = _INTERVAL.fullmatch(text)
    if ends is None or float(ends[2] or ends[1]) < float(ends[1]):
        return None
    low, high = (_nearest(part, end) for end in (ends[1], ends[2] or ends[1]))
    return f"{low}-{high}" if part.interval and low != high else low


def _nearest(part: NumberRange, text: str) -> str:
    if part.place(text) is not None:
        return text
    return min(part.texts, key=lambda each: abs(float(each) - float(text)))
