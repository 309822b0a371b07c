"""The meaning of a question: what kind of answer it wants, and its truth in any scene.

A meaning knows no wording. Its truth is an expression over a scene's names; several ones are
separated by semicolons, as in the files of questions. Not here: words of the answer
(``tacgrasp.lessons.dialogue.answers``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.quantities import QUANTITIES


class AnswerKind(StrEnum):
    """Kind of an answer."""

    NUMBER = "number"
    YES_NO = "yes_no"
    CHOICE = "choice"
    TEXT = "text"
    UNKNOWABLE = "unknowable"
    OFF_TOPIC = "off_topic"


class Length(StrEnum):
    """How long an answer is asked to be."""

    FREE = ""
    WORD = "word"
    SENTENCE = "sentence"


@dataclass(frozen=True, slots=True, kw_only=True)
class Amount:
    """A number is asked for.

    Attributes:
        quantity: Name in ``QUANTITIES``.
        unit: Unit of the answer.
        less: What is taken from it: a number of the question, with the factor to its own unit
            ('100 / 1000'); '' for the quantity itself.
        of: A mass of the question that is meant in place of the given one ('60 g'); '' for none.
        length: How long the answer is to be.
        step: What the answer is rounded to a multiple of, in its unit; 0 for its usual digits.
    """

    quantity: str
    unit: str
    less: str = ""
    of: str = ""
    length: Length = Length.FREE
    step: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """Yes or no is asked for.

    Attributes:
        condition: Expression that is true for yes.
        shows: Facts that the answer names, by their names in ``FACTS``.
        needed_n: Expression of the force that is needed [N]; '' where none is.
        length: How long the answer is to be.
        test: The condition in the words of a query; '' where none has it
            (``tacgrasp.lessons.dialogue.conditions.check_of``).
        denied: Whether the question asks if the test is not so.
    """

    condition: str
    shows: tuple[str, ...]
    needed_n: str = ""
    length: Length = Length.FREE
    test: str = ""
    denied: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Calculated:
    """A number, a yes or no, or a choice that follows from several quantities and numbers.

    Attributes:
        truth: Its expression; one between quoted words is a choice.
        unit: Unit of a number, '' of a ratio; None for a yes or no, or a choice.
        step: What a number is rounded to a multiple of, in its unit; 0 for its usual digits.
    """

    truth: str
    unit: str | None
    step: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Which:
    """A word is asked for.

    Attributes:
        name: Name of a scene whose value is a word.
        is_open: Whether no words to choose from are offered.
        length: How long the answer is to be.
        offered: Words of the name to choose from, where another one is to be called none of them;
            empty where any word is as good.
    """

    name: str
    is_open: bool = False
    length: Length = Length.FREE
    offered: tuple[str, ...] = ()


Part = Amount | Check | Calculated | Which
"""What can be asked together with others."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Several:
    """Several things are asked for at once.

    Attributes:
        parts: Each of them.
    """

    parts: tuple[Part, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Why:
    """The reason of advice, or of an answer.

    Attributes:
        shows: Facts behind a yes or no; empty for the reason of the advice.
        with_action: Whether the advice itself is asked for too.
    """

    shows: tuple[str, ...] = ()
    with_action: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """A description of the whole contact."""

    length: Length = Length.FREE


@dataclass(frozen=True, slots=True, kw_only=True)
class Unknowable:
    """Something that touch can't know.

    Attributes:
        subject: What it is, with its article ('its price').
    """

    subject: str
    length: Length = Length.FREE


@dataclass(frozen=True, slots=True, kw_only=True)
class OffTopic:
    """Nothing about the contact."""


Meaning = Part | Several | Why | Description | Unknowable | OffTopic

FACTS: Mapping[str, str] = {
    **{name: quantity.truth for name, quantity in QUANTITIES.items()},
    "shape": "shape",
    "texture": "texture",
    "depth_word": "depth",
    "area_word": "area",
    "position": "position",
    "contact": "contact",
    "cut": "wholeness",
    "cut_sides": "cut_sides",
    "force_band": "force_band",
}
"""Facts that an answer may name, with their truths."""


MASS_UNITS: Mapping[str, float] = {"g": 1.0, "kg": 1000.0}


def grams_of(mass: str) -> str:
    """A mass of a question in grams: '60 g' and '0.06 kg' are '60'.

    Raises:
        ValueError: Its unit is none of a mass.
    """
    number, _, unit = mass.partition(" ")
    if unit not in MASS_UNITS:
        raise ValueError(f"there is no mass in {unit}")
    return f"{float(number) * MASS_UNITS[unit]:.6g}"


def kind_of(meaning: Meaning) -> AnswerKind:
    """The kind of answer that a question wants."""
    match meaning:
        case Amount():
            return AnswerKind.NUMBER
        case Check():
            return AnswerKind.YES_NO
        case Calculated(truth=truth, unit=unit):
            if unit is not None:
                return AnswerKind.NUMBER
            return AnswerKind.CHOICE if Expression(truth).choices else AnswerKind.YES_NO
        case Which(is_open=is_open):
            return AnswerKind.TEXT if is_open else AnswerKind.CHOICE
        case Several() | Why() | Description():
            return AnswerKind.TEXT
        case Unknowable():
            return AnswerKind.UNKNOWABLE
    return AnswerKind.OFF_TOPIC


def truth_of(meaning: Meaning) -> str:
    """Truth of a question, as in a file of questions; '' where touch knows none."""
    match meaning:
        case Amount(quantity=quantity, less=less, of=of):
            truth = QUANTITIES[quantity].truth
            if of:
                truth = truth.replace("mass_g", grams_of(of))
            return f"{truth} - {less}" if less else truth
        case Check(condition=condition):
            return condition
        case Calculated(truth=truth):
            return truth
        case Which(name=name):
            return name
        case Several(parts=parts):
            return "; ".join(truth_of(part) for part in parts)
        case Why(shows=shows, with_action=with_action):
            reasons = [FACTS[fact] for fact in shows] or ["reason"]
            return "; ".join(["action", *reasons] if with_action else reasons)
        case Description():
            return "depth; position; area"
    return ""


def names_of(meaning: Meaning) -> tuple[str, ...]:
    """Names of a scene that the answer needs."""
    parts = [part for part in truth_of(meaning).split(";") if part]
    return tuple(dict.fromkeys(name for part in parts for name in Expression(part).names))
