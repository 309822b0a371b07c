"""Reading replies in the grammar back: exactly what ``policies.llm.grammar`` allows, no more.

Not here: reading an action out of any text (``policies.extraction``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from cltp.llm.constrained.grammar import Grammar, Segment, match
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import DIMENSIONS, NUMBERS, Side
from policies.errors import PolicyError
from policies.llm.grammar import (
    ACTION,
    ALL_NOUNS,
    CUT,
    NOTHING_TOUCHES,
    REASON,
    caption_grammar,
    step_grammar,
)
from policies.teacher import Advice, Reason
from primitives import Primitive
from primitives.contract import Band

_GOAL = re.compile(r" Goal (\d+\.\d\d) - (\d+\.\d\d) N\. ")
_INTERVAL = re.compile(r"([+-]?[\d.]+)(?:-([\d.]+))?")


@dataclass(frozen=True, slots=True, kw_only=True)
class ParsedReply:
    """What a reply says.

    Attributes:
        in_contact: Whether anything touches. The next four are empty where nothing does.
        words: Words of the contact by dimension (``cltp.tactile.states.DIMENSIONS``).
        rivals: The second word of those that are in doubt.
        numbers: Low and high end of each number (``cltp.tactile.states.NUMBERS``) in its unit [mm,
            N, fraction]; equal where one value is said.
        cut: Sides of the pad that cut the contact off.
        goal: Target that D_t names [N]; None in a caption.
        advice: Action and reason; None in a caption.
    """

    in_contact: bool
    words: Mapping[str, str]
    rivals: Mapping[str, str]
    numbers: Mapping[str, tuple[float, float]]
    cut: frozenset[Side]
    goal: Band | None
    advice: Advice | None


def parse_reply(text: str, sensor: SensorSpec | None = None) -> ParsedReply:
    """Read D_t.

    Args:
        text: A text that ``step_grammar`` allows, for some goal and without barred actions.
        sensor: The sensor whose range numbers must keep; None for any.

    Raises:
        PolicyError: It is no such text.
    """
    goals = _GOAL.findall(text)
    if len(goals) != 1:
        raise PolicyError(f"expected D_t with one goal such as 'Goal 0.42 - 0.51 N.', got {text!r}")
    try:
        goal = Band(low=float(goals[0][0]), high=float(goals[0][1]))
    except ValueError as error:
        raise PolicyError(f"D_t names a goal that is none: {error}") from error
    segments = _whole([step_grammar(sensor, goal, nouns=nouns) for nouns in ALL_NOUNS], text)
    return _parsed(segments, goal)


def parse_caption_reply(text: str, sensor: SensorSpec | None = None) -> ParsedReply:
    """Read a caption with its numbers.

    Args:
        text: A text that ``caption_grammar`` allows.
        sensor: The sensor whose range numbers must keep; None for any.

    Raises:
        PolicyError: It is no such text.
    """
    return _parsed(_whole([caption_grammar(sensor, nouns) for nouns in ALL_NOUNS], text), None)


def _whole(grammars: list[Grammar], text: str) -> dict[str, Segment]:
    """Segments of a reply by the names of their parts, under the first grammar that allows it."""
    reached: list[str] = []
    for grammar in grammars:
        segments, is_whole = match(grammar, text)
        if is_whole:
            return {segment.name: segment for segment in segments if segment.name}
        reached.append("".join(segment.text for segment in segments))
    at = len(max(reached, key=len))
    raise PolicyError(
        f"the reply leaves its grammar after {at} characters, at {text[at : at + 30]!r}"
    )


def _parsed(segments: Mapping[str, Segment], goal: Band | None) -> ParsedReply:
    words = {name: segments[name] for name in DIMENSIONS if name in segments}
    in_contact = all(segment.value != NOTHING_TOUCHES for segment in segments.values())
    if not in_contact:
        words = {}
    advice = None
    if ACTION in segments:
        name, reason = segments[ACTION].value.strip("<>"), Reason[segments[REASON].value]
        action = None if name == "none" else Primitive(name)
        advice = Advice(action=action, success=reason is Reason.GOOD, reason=reason)
    return ParsedReply(
        in_contact=in_contact,
        words={name: segment.value for name, segment in words.items()},
        rivals={name: segment.rival for name, segment in words.items() if segment.rival},
        numbers={name: _ends(name, segments[name].value) for name in NUMBERS if name in segments},
        cut=frozenset(Side(side) for side in segments[CUT].value.split())
        if CUT in segments
        else frozenset(),
        goal=goal,
        advice=advice,
    )


def _ends(name: str, text: str) -> tuple[float, float]:
    """Low and high end of a number or interval in its unit."""
    found = _INTERVAL.fullmatch(text)
    if found is None:
        raise ValueError(f"{text!r} is no number")
    scale = 0.01 if name == "area_fraction" else 1.0
    low = scale * float(found[1])
    return low, scale * float(found[2]) if found[2] else low
