"""What one clause says: a closed list of patterns, each matched against the whole clause.

A clause that no pattern matches is not read, however much of it is known: a made-up action is worse
than asking the policy again. The patterns cover action tokens, plain requests ('please move the
gripper downward'), their negations, and the success descriptors said of the grasp.

In a pattern every word is followed by a space, so that patterns can be joined by ``+``.
"""

from __future__ import annotations

import re
from enum import Enum, auto
from functools import lru_cache
from itertools import chain
from typing import NamedTuple

from cltp.tactile.states import CLASSES
from policies.extraction.clauses import INSTEAD, NEGATIONS, NONE_TOKEN, PURPOSE, Clause
from primitives import Primitive

DESCRIPTORS = ("stable", "appropriate", "secure", "reliable")
"""Words that declare success. Source: paper, Algorithm 1, keyword set K."""

OPPOSITES = tuple(f"{prefix}{word}" for prefix in ("un", "in") for word in DESCRIPTORS)

MAX_WORDS = 30
"""Words of a clause; a longer one is not read. Our choice: those of D_t have at most 18."""


class Kind(Enum):
    """What a clause does."""

    ASKS = auto()
    FORBIDS = auto()
    TURNS = auto()  # a direction alone, which goes on with the move before it
    DECLARES = auto()  # the grasp is good
    ADDS = auto()  # a descriptor alone, said of what stands before it
    DENIES = auto()  # the grasp is not good
    DESCRIBES = auto()  # something else that is known
    UNKNOWN = auto()


class Reading(NamedTuple):
    """What a clause does, and which actions it asks for or forbids (two: 'to the bottom left')."""

    kind: Kind
    actions: frozenset[Primitive] = frozenset()


def _any(*patterns: str) -> str:
    return f"(?:{'|'.join(patterns)})"


def _words(phrases: str) -> str:
    """One of several phrases, which are written with commas between them."""
    return _any(*(f"{phrase} " for phrase in phrases.split(", ")))


def _optional(pattern: str) -> str:
    return f"(?:{pattern})?"


def _many(*patterns: str) -> str:
    return f"{_any(*patterns)}*"


# Things, amounts, and what stands in front of a request.
_THE = _optional(_words("the, this, its, your"))
_HAND = _THE + _words("gripper, hand, finger, fingers, arm, robot, tool")
_GRASP = _words("grasp, grip, hold, contact")
_GRIP = _any("it ", _THE + _words("grasp, grip, hold, gripper, fingers"))
_OBJECT = _any("it ", _THE + _words("object, item, berry, strawberry, fruit, egg, peg, tomato"))
_KIND = _optional(_words("gripping, grip, grasping, grasp, clamping, normal, contact"))
_FORCE = _THE + _KIND + _words("force, pressure")
_MUST = _words("should, must, needs to, has to")
_LITTLE = _any(
    _words("slightly, gently, slowly, carefully, further, again, now, please, instead"),
    _words("a little, a bit, a step, one step, by a step, by one step"),
    r"(?:by )?\d\S* (?:mm|cm) ",
)
_WHICH = _optional(_words("next, best, right, appropriate, recommended, final"))
_STEP = _words("action, step, move, decision, answer, advice, recommendation")
_OPENING = _many(
    _LITTLE,
    _words("next, therefore, thus, hence, simply, yes, ok, okay, let us"),
    _optional("i ") + _words("suggest, recommend, advise") + _optional("to "),
    _words("you, we, i") + _words("should, must, need to, have to"),
    _HAND + _MUST,
    _words("it is, it would be") + _words("best to, better to, necessary to, appropriate to"),
    _words("the, my") + _WHICH + _STEP + "is " + _optional("to "),
)
_LABEL = _any(_optional("the ") + _WHICH + _STEP, "i repeat ", "next ")

# The seven actions.
_DIRECTIONS = {
    Primitive.MOVE_UP: _words("up, upward, upwards, top"),
    Primitive.MOVE_DOWN: _words("down, downward, downwards, bottom"),
    Primitive.MOVE_LEFT: _words("left, leftward, leftwards"),
    Primitive.MOVE_RIGHT: _words("right, rightward, rightwards"),
}
_TO = _optional(_words("to, to the, toward, toward the, towards, towards the"))
_WAY = _TO + _any(*_DIRECTIONS.values())
_TURN = _WAY + _many(_WAY) + _optional("side ") + _optional("of the pad ") + _many(_LITTLE)
_MOVE = (
    _words("move, shift, go, slide, step, nudge, be moved, be shifted")
    + _many(_HAND, _THE + _words("grasp, grip"), "it ", "only ", _LITTLE)
    + _TURN
)
_SQUEEZE = _words("squeeze, grip, hold, press, grasp") + _optional(_OBJECT) + _many(_LITTLE)
_APPLY = _optional(_words("apply, use, exert")) + _many(_LITTLE)
_NEEDED = _optional(_words("is needed, is required, is necessary"))
_FORCE_MUST = _any(_FORCE, _THE + _words("grip, grasp")) + _MUST
_REQUESTS = {
    Primitive.MOVE_UP: "raise " + _HAND,
    Primitive.MOVE_DOWN: "lower " + _HAND,
    Primitive.INCREASE_FORCE: _any(
        _words("increase, raise, boost, strengthen") + _FORCE,
        _any("tighten " + _optional(_GRIP), "strengthen " + _GRIP, "increase it "),
        _APPLY + _words("more, additional, greater") + _FORCE + _NEEDED,
        _FORCE_MUST + _words("increase, go up, be increased, be raised, be firmer, be higher"),
        _SQUEEZE + _words("harder, tighter, firmer, more firmly, more tightly, more strongly"),
    ),
    Primitive.DECREASE_FORCE: _any(
        _words("decrease, reduce, lower, lessen") + _FORCE,
        _any("loosen " + _optional(_GRIP), "relax " + _GRIP, "decrease it ", "reduce it "),
        _APPLY + "less " + _FORCE + _NEEDED,
        _FORCE_MUST + _words("decrease, go down, be decreased, be reduced, be looser, be lower"),
        _SQUEEZE + _words("softer, looser, less hard, less firmly, less tightly, more gently"),
    ),
    Primitive.RESET: _any(
        _words("reset, regrasp, restart, start over") + _optional(_any(_OBJECT, _GRIP)),
        _words("start again, grasp again, grip again, try again"),
    ),
}
_NAMED = _optional(_LABEL + _optional("is ")) + _optional(
    _words("i choose, choose, do, perform, perform a, execute")
)
_ASKS = {
    primitive: re.compile(
        _any(_OPENING + _REQUESTS.get(primitive, primitive), f"{_NAMED}{primitive} ")
        + _many(_LITTLE)
    )
    for primitive in Primitive
}
_MOVES, _TURNS = re.compile(_OPENING + _MOVE), re.compile(_optional("only ") + _TURN)
_FORBIDS = re.compile(
    _OPENING
    + _any(
        _words("do not, never, not, avoid, stop, no need to, it is not necessary to"),
        "there is no " + _words("need to, reason to"),
        _any(_words("you, we"), _HAND) + _words("must not, should not, need not"),
    )
)
_SUGGESTS = re.compile(r"\b(?:suggest|recommend|advise|avoid|stop) ")
_GERUNDS = {
    "moving": "move", "shifting": "shift", "going": "go", "sliding": "slide", "starting": "start",
    "raising": "raise", "lowering": "lower", "increasing": "increase", "decreasing": "decrease",
    "reducing": "reduce", "tightening": "tighten", "loosening": "loosen", "applying": "apply",
}  # fmt: skip
MENTIONS_VERDICT = re.compile("|".join(DESCRIPTORS))
MENTIONS_ACTION = re.compile(
    r"\b(?:mov|shift|slid|nudg|go\b|going|turn|bring|rais|lower|increas|decreas|reduc|eas[ei]|squeez"
    r"|tighten|loosen|strengthen|relax|reset|regr[ai]|restart|retry|again\b|start\w* over"
    r"|(?:more|less|additional|greater|lower|higher) (?:\w+ )?(?:force|pressure|\w+ly)\b"
    r"|harder|softer|tighter|looser|firmer|gentler)"
)
"""What may have to do with an action, however it is put: a sentence that is not read is doubted."""

# The verdict, and what else is known.
_IS = _words("is, are, feels, remains")
_VERY = _many(_words("now, very, perfectly, fully, completely, sufficiently, still"))
_GOOD = _words(", ".join(DESCRIPTORS))
_BAD = _words(", ".join(OPPOSITES))
_YES = _optional(_words("yes, done, now, okay, ok"))
_SUBJECT = _any(
    _THE + _optional("current ") + _GRASP + _optional(_words("of, on") + _OBJECT),
    _words("it, this, everything"),
)
NAMES_GRASP = re.compile(_SUBJECT + _any(_IS, "$"))
"""Begins a description of the grasp, so that 'and stable' goes on with it."""

_WHERE = _optional(_words("now, enough, for now")) + _optional(
    _words("on, of, between") + _any(_OBJECT, "the fingers ")
)
_VERDICTS = {
    Kind.DECLARES: _YES
    + _any(
        _SUBJECT + _IS + _VERY + _GOOD,
        _words("this is, it is, we have, i have") + _words("a, an") + _GOOD + _GRASP,
        _optional("a ") + _GOOD + _GRASP + _optional("has been ") + _words("achieved, confirmed"),
    )
    + _WHERE,
    Kind.ADDS: _YES + _VERY + _GOOD + _optional(_GRASP) + _WHERE,
    Kind.DENIES: _SUBJECT
    + _IS
    + _any(_words("not, no longer, not yet, never") + _VERY + _GOOD, _VERY + _BAD),
}
_IDLE = _any(
    _words(f"{NONE_TOKEN}, none, hold, hold still, hold on, hold it like this, yes, ok, okay, now"),
    "no "
    + _optional(_words("further, more, other"))
    + _words("action, adjustment, adjustments, change, correction, movement")
    + _NEEDED,
    _words("nothing has, nothing needs") + _words("to change, to be done, to be changed"),
    _words("there is no need to, no need to, do not") + _words("move, act, change anything"),
    _words("there is no contact, i feel no contact, no contact, no slip, no slip is felt"),
    _words("nothing touches, nothing touches the pad"),
)
_PATTERNS = {
    Kind.DESCRIBES: re.compile(_any(_LABEL, _IDLE)),
    **{kind: re.compile(pattern) for kind, pattern in _VERDICTS.items()},
}
_CONTACT_WORDS = (
    "a an the it this is are lies to toward towards at in on of off too far with n mm %"
    " contact object berry strawberry gel pad sensor grasp grip force gripping pressure pressed"
    " held firm light high low firmly lightly loosely middle centred center centre side edge"
)
_KNOWN = frozenset(re.findall(r"[a-z%]+", " ".join((_CONTACT_WORDS, *chain(*CLASSES.values())))))
_AIM = _KNOWN.union(DESCRIPTORS, ("achieve", "bring", "make", "get", "reach"))


@lru_cache(maxsize=256)
def read(clause: Clause) -> Reading:
    """What one clause says. Most come again from step to step."""
    text, words = f"{clause.text} ", clause.text.split()
    if not 0 < len(words) <= MAX_WORDS:
        return Reading(kind=Kind.UNKNOWN)
    if clause.lead == INSTEAD or _SUGGESTS.search(text):
        text = "".join(f"{_GERUNDS.get(word, word)} " for word in words)
    for kind, pattern in _PATTERNS.items():
        if pattern.fullmatch(text):
            return Reading(kind=kind)
    prohibition = _FORBIDS.match(text)
    if prohibition or clause.lead == INSTEAD:
        forbidden = text[prohibition.end() :] if prohibition else text
        if actions := _requested(forbidden) or _directions(_TURNS, forbidden):
            return Reading(kind=Kind.FORBIDS, actions=actions)
    if actions := _requested(text):
        return Reading(kind=Kind.ASKS, actions=actions)
    if actions := _directions(_TURNS, text):
        return Reading(kind=Kind.TURNS, actions=actions)
    known = _AIM if clause.lead == PURPOSE else _KNOWN
    if all(word in known or word[0].isdigit() for word in words):
        return Reading(kind=Kind.DESCRIBES)
    return Reading(kind=Kind.UNKNOWN)


def _requested(text: str) -> frozenset[Primitive]:
    named = {primitive for primitive, pattern in _ASKS.items() if pattern.fullmatch(text)}
    return _directions(_MOVES, text).union(named)


def _directions(pattern: re.Pattern[str], text: str) -> frozenset[Primitive]:
    if not pattern.fullmatch(text):
        return frozenset()
    return frozenset(p for p, words in _DIRECTIONS.items() if re.search(rf"\b{words}", text))


def denies_verdict(text: str) -> bool:
    """Whether a descriptor stands beside a negation in a text, or its opposite stands there."""
    negated = set(NEGATIONS).union(OPPOSITES).intersection(text.split())
    return bool(negated) and MENTIONS_VERDICT.search(text) is not None
