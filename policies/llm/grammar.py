"""The grammar of D_t in one step, and that of the reply to a request for a description.

D_t is the contact, the target, the action and the reason, as ``policies.llm.text`` words them.
The target is the step's own. Numbers lie within the sensor's range, reasons belong to their action,
and barred actions can't be named.

Not here: reading such a text back (``policies.llm.parse``).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

from cltp.llm.constrained.grammar import (
    Grammar,
    NumberRange,
    Option,
    Part,
    TextChoice,
    Verbatim,
    nearest_number,
)
from cltp.tactile.sensors import SENSORS, SensorSpec
from cltp.tactile.states import CLASSES, Side
from cltp.texts.captions import NO_CONTACT, with_article
from policies.errors import PolicyError
from policies.llm.text import (
    NOTHING,
    OR,
    advice_text,
    cut_text,
    goal_text,
    number_text,
    percent,
)
from policies.teacher import Advice, Reason
from primitives import Primitive
from primitives.contract import Band

MAX_FORCE_N = 60.0
"""Highest force that D_t can name [N]. Our choice: three times what a two-finger gripper for
strawberries to pegs ever needs."""

NOUNS = ("texture", "shape")
"""Words before the first comma. A model that was taught contacts without labels of one of them
leaves it out."""

ALL_NOUNS = (NOUNS, ("shape",), ("texture",), ())

NOTHING_TOUCHES = "nothing"
"""Value of the first choice where nothing touches."""

SURE: Mapping[str, float] = dict.fromkeys(CLASSES, 0.0)
"""Thresholds of doubt that no word falls below."""

ACTION, REASON, CUT = "action", "reason", "cut"
"""Names of the choices that are no word or number of a contact."""

ADVICE_WITHOUT_CONTACT = (Advice(action=Primitive.RESET, success=False, reason=Reason.NO_CONTACT),)
_MOVES = (Primitive.MOVE_UP, Primitive.MOVE_DOWN, Primitive.MOVE_LEFT, Primitive.MOVE_RIGHT)
ADVICE_IN_CONTACT = (
    *(
        Advice(action=move, success=False, reason=reason)
        for move in _MOVES
        for reason in (Reason.OFF_CENTER, Reason.CUT)
    ),
    Advice(action=Primitive.INCREASE_FORCE, success=False, reason=Reason.TOO_LIGHT),
    Advice(action=Primitive.DECREASE_FORCE, success=False, reason=Reason.TOO_FIRM),
    Advice(action=Primitive.RESET, success=False, reason=Reason.OVER_THE_EDGE),
    Advice(action=None, success=True, reason=Reason.GOOD),
    Advice(action=None, success=False, reason=Reason.BAND_TOO_NARROW),
)
"""Everything that ``policies.teacher`` advises (tested)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ranges:
    """Ranges of the numbers [mm]: depth up to the gel, place within the sensing area."""

    gel_mm: float
    width_mm: float
    height_mm: float


def ranges_of(sensor: SensorSpec | None) -> Ranges:
    """Ranges of a sensor; None for those that hold every known sensor's."""
    sensors = list(SENSORS.values()) if sensor is None else [sensor]
    return Ranges(
        gel_mm=max(one.gel_mm for one in sensors),
        width_mm=max(one.width_mm for one in sensors),
        height_mm=max(one.height_mm for one in sensors),
    )


def step_grammar(
    sensor: SensorSpec | None,
    force_n: Band,
    barred: Iterable[str] = (),
    nouns: Sequence[str] = NOUNS,
    numbers: Mapping[str, str] | None = None,
) -> Grammar:
    """The grammar of D_t in one step.

    Args:
        sensor: The sensor; None for any.
        force_n: Target of the step [N].
        barred: Actions that must not be named, such as '<move_up>' or '<none>'.
        nouns: Which of ``NOUNS`` are said.
        numbers: Texts of numbers of a contact by ``cltp.tactile.states.NUMBERS``, which are said as
            they are, or as the nearest of the sensor's range; all others are the model's own.

    Raises:
        PolicyError: Every action is barred.
    """
    forbidden = frozenset(barred)
    goal = Verbatim(f" {goal_text(force_n)} Action:")
    in_contact, without = (
        _advice(every, forbidden) for every in (ADVICE_IN_CONTACT, ADVICE_WITHOUT_CONTACT)
    )
    if in_contact is None:
        raise PolicyError("every action is barred, so D_t can't name one; ask for a wider goal")
    words, rest = _contact(ranges_of(sensor), tuple(nouns))
    rest = _with_numbers(rest, numbers or {})
    options = [
        Option(one.value, one.text, one.rival, (*rest, goal, in_contact)) for one in words.options
    ]
    if without is not None:
        options.append(Option(NOTHING_TOUCHES, NOTHING, then=(goal, without)))
    return (TextChoice(words.name, tuple(options)),)


def _with_numbers(parts: Grammar, numbers: Mapping[str, str]) -> Grammar:
    """Parts with a literal in the place of each number that is given."""
    said: list[Part] = []
    for part in parts:
        text = None
        if isinstance(part, NumberRange) and part.name in numbers:
            text = nearest_number(part, numbers[part.name])
        if isinstance(part, NumberRange) and text is not None:
            said += [Verbatim(f" {text}"), Verbatim(part.after)]
        else:
            said.append(part)
    return tuple(said)


def caption_grammar(
    sensor: SensorSpec | None,
    nouns: Sequence[str] = NOUNS,
    numbers: Mapping[str, str] | None = None,
    cut: Collection[Side] | None = None,
) -> Grammar:
    """The grammar of a caption with its numbers, as ``policies.llm.text.caption_text`` words it.

    Args:
        sensor: The sensor; None for any.
        nouns: Which of ``NOUNS`` are said.
        numbers: As for ``step_grammar``.
        cut: The sides that are said to cut the contact off; None leaves them open.
    """
    words, rest = _caption(ranges_of(sensor), tuple(nouns))
    rest = _with_numbers(rest, numbers or {})
    if cut is not None:
        rest = (*rest[:-1], TextChoice(CUT, (_cut_by(tuple(sorted(cut))),)))
    options = [Option(one.value, one.text, one.rival, rest) for one in words.options]
    options.append(Option(NOTHING_TOUCHES, f"{NO_CONTACT} 0.00 mm, 0.00 N."))
    return (TextChoice(words.name, tuple(options)),)


class _Words(NamedTuple):
    """First words of a reply, which what follows is added to."""

    name: str
    options: tuple[Option, ...]


class _Numbers(NamedTuple):
    """Every text of each number, in ascending order."""

    depth: tuple[str, ...]
    x: tuple[str, ...]
    y: tuple[str, ...]
    area: tuple[str, ...]
    force: tuple[str, ...]


@lru_cache(16)
def _contact(ranges: Ranges, nouns: tuple[str, ...]) -> tuple[_Words, tuple[Part, ...]]:
    """First words of the contact in D_t, and the rest of it."""
    numbers = _numbers(ranges)
    first, more = _nouns(nouns, str)
    return first, (
        *more,
        Verbatim(","),
        _word("depth"),
        NumberRange("depth_mm", numbers.depth, " mm,", interval=True),
        _word("position"),
        Verbatim(" x"),
        NumberRange("x_mm", numbers.x, " y"),
        NumberRange("y_mm", numbers.y, ","),
        _word("area"),
        NumberRange("area_fraction", numbers.area, " %,", interval=True),
        NumberRange("force_n", numbers.force, " N", interval=True),
        _cut(),
    )


@lru_cache(16)
def _caption(ranges: Ranges, nouns: tuple[str, ...]) -> tuple[_Words, tuple[Part, ...]]:
    """First words of a caption, and the rest of it."""
    numbers = _numbers(ranges)
    first, more = _nouns(nouns, with_article)
    return first, (
        *more,
        Verbatim(" object, pressed" if nouns else ", pressed"),
        _word("depth"),
        Verbatim(" in"),
        _word("position"),
        Verbatim(" with"),
        _word("area"),
        Verbatim(" contact area."),
        NumberRange("depth_mm", numbers.depth, " mm,", interval=True),
        NumberRange("force_n", numbers.force, " N,", interval=True),
        NumberRange("area_fraction", numbers.area, " %, x", interval=True),
        NumberRange("x_mm", numbers.x, ", y"),
        NumberRange("y_mm", numbers.y, ""),
        _cut(),
    )


@lru_cache(16)
def _numbers(ranges: Ranges) -> _Numbers:
    x, y = (_offsets(extent / 2) for extent in (ranges.width_mm, ranges.height_mm))
    tenths, wholes = (
        [percent(i / 1000) for i in range(100)],
        [percent(i / 100) for i in range(10, 101)],
    )
    return _Numbers(
        depth=_hundredths("depth_mm", ranges.gel_mm),
        x=x,
        y=y,
        area=(*tenths, *wholes),
        force=_hundredths("force_n", MAX_FORCE_N),
    )


def _hundredths(name: str, most: float) -> tuple[str, ...]:
    return tuple(number_text(name, i / 100) for i in range(math.floor(100 * most + 1e-6) + 1))


def _offsets(most_mm: float) -> tuple[str, ...]:
    """Places along one axis, with both of '-0.0' and '+0.0', since both are written."""
    count = math.floor(10 * most_mm + 1e-6)
    below = [number_text("x_mm", -(i / 10)) for i in range(count, -1, -1)]
    return (*below, *(number_text("x_mm", i / 10) for i in range(count + 1)))


def _nouns(nouns: tuple[str, ...], begin: Callable[[str], str]) -> tuple[_Words, tuple[Part, ...]]:
    """The nouns of a contact: the first, begun by ``begin``, and the others."""
    if not nouns:
        return _Words("object", (Option("object", begin("object")),)), ()
    first = tuple(Option(word, begin(word), f"{OR}{word}") for word in CLASSES[nouns[0]])
    return _Words(nouns[0], first), tuple(_word(name) for name in nouns[1:])


def _word(name: str) -> TextChoice:
    """A word of a dimension of the contact, or two."""
    return TextChoice(name, tuple(Option(w, f" {w}", f"{OR}{w}") for w in CLASSES[name]))


def _cut() -> TextChoice:
    """The sides that cut the contact off, and the full stop."""
    names = sorted(Side)
    subsets = [sides for count in range(len(names) + 1) for sides in combinations(names, count)]
    return TextChoice(CUT, tuple(map(_cut_by, subsets)))


def _cut_by(sides: Sequence[Side]) -> Option:
    return Option(" ".join(sides), f"{cut_text(sides)}.")


@lru_cache(64)
def _advice(every: tuple[Advice, ...], barred: frozenset[str]) -> TextChoice | None:
    """The action and its reason; None where all are barred."""
    reasons: dict[str, list[Option]] = {}
    for advice in every:
        token = f"<{advice.action or 'none'}>"
        text = advice_text(advice).removeprefix(f"Action: {token}.")
        reasons.setdefault(token, []).append(Option(advice.reason.name, text))
    options = tuple(
        Option(token, f" {token}", then=(Verbatim("."), TextChoice(REASON, tuple(choices))))
        for token, choices in reasons.items()
        if token not in barred
    )
    return TextChoice(ACTION, options) if options else None
