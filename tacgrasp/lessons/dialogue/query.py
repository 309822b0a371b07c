"""Queries: the meaning of a question in a small formal language, which the language model writes.

    amount depth µm.                    a number in a unit
    word shape.                         a word; 'choice shape' where some were offered
    check depth > #1 µm.                yes or no (``tacgrasp.lessons.dialogue.conditions``)
    check not force within.             denied
    amount depth mm; word shape.        several at once
    check force #1 +- #2 N.             a number with its tolerance
    check force about #1 N.             a number without one
    amount depth - #1 mm.               how much more than a number
    amount needed #1 g N.               the force that surely holds a mass; 'needed N' the given one
    amount half force N.                a multiple; 'twice', 'thrice'
    check twice force over.             a multiple judged as the force is
    check half depth > #1 mm.           a multiple against a number
    why step.                           the reason of the advice; 'why both' with the advice,
                                        'why force' the force behind an answer, 'why felt' all
                                        numbers behind it
    because mass, holds.                the facts behind an answer, other ones; no model writes it
    calculate 0.5 * limit_n in N.       a number by an expression; 'in 1' a ratio
    calculate force_n > 0.5 * limit_n.  yes or no, or a choice, so; no model writes these
    amount depth mm to 0.1.             a number that is rounded; no model writes it
    describe.
    unknown price.                      touch can't know it
    other.                              it is not about touch

A query ends with '.', ' in a word.' or ' in a sentence.'. It has no digits of the question: ``#1``
is the question's first number. So no number is ever copied wrongly, and all queries of one part
are few enough to be listed (``query_grammar``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from cltp.llm.constrained.grammar import Grammar, Option, TextChoice
from cltp.tactile.states import CLASSES
from policies.instructions.quantities.numerals import in_digits
from tacgrasp.lessons.dialogue.conditions import (
    FATES,
    GIVEN,
    MEASURED,
    ORDERED,
    SIGNS,
    STATES,
    check_of,
    number_text,
    taken,
)
from tacgrasp.lessons.dialogue.meaning import (
    FACTS,
    MASS_UNITS,
    Amount,
    Calculated,
    Check,
    Description,
    Length,
    Meaning,
    OffTopic,
    Part,
    Several,
    Unknowable,
    Which,
    Why,
)
from tacgrasp.lessons.dialogue.plain_words import plain_text
from tacgrasp.lessons.dialogue.plainer import with_plain_numbers
from tacgrasp.lessons.dialogue.quantities import TIMES, UNITS, can_be_in
from tacgrasp.lessons.dialogue.subjects import RULED_SUBJECTS, SUBJECTS
from tacgrasp.lessons.dialogue.written_units import with_counted_parts

MOST_NUMBERS = 4
"""Most numbers of a question that a query can name."""

NEEDED_IN = ("N", "mN")
"""Units of the force that a mass needs."""

AMOUNTS: Mapping[str, tuple[str, ...]] = {
    "depth": ("mm", "µm", "cm"),
    "x": ("mm", "µm"),
    "y": ("mm", "µm"),
    "leftward": ("mm", "µm"),
    "tipward": ("mm", "µm"),
    "larger_offset": ("mm", "µm"),
    "distance": ("mm", "µm"),
    "offset_x": ("mm", "µm"),
    "offset_y": ("mm", "µm"),
    "area": ("%", "mm²"),
    "force": ("N", "mN", "g", "cN"),
    "band_low": ("N", "mN", "g", "cN"),
    "band_high": ("N", "mN", "g", "cN"),
    "limit": ("N", "mN", "g", "cN"),
    "headroom": ("N", "mN", "g", "cN"),
    "used": ("%",),
    "needed": NEEDED_IN,
    "lacking": ("N", "mN"),
    "excess": ("N", "mN"),
    "to_low": ("N", "mN"),
    "to_high": ("N", "mN"),
    "mass": ("g", "kg"),
    "holds": ("g", "kg"),
    "free_area": ("%",),
    "band_middle": ("N", "mN"),
    "off_middle": ("N", "mN"),
    "band_width": ("N", "mN"),
    "band_to_limit": ("N", "mN"),
    "spare": ("g",),
    **{f"{times} force": ("N", "mN", "g") for times in TIMES},
    **{f"{times} depth": ("mm", "µm") for times in TIMES},
    **{f"{times} holds": ("g",) for times in TIMES},
}
"""Units in which the language model asks for a quantity; others
(``tacgrasp.lessons.dialogue.quantities.can_be_in``) are told by the question's words alone."""

LESSENED: Mapping[str, tuple[str, ...]] = {
    "depth": ("mm", "µm"),
    "force": ("N", "mN", "g", "cN"),
}
"""Units of what a number of the question may be taken from."""

WORDS = (*CLASSES, "force_band", "action", "side_x", "side_y", "worse_axis", "wholeness")
"""Names of a scene whose value is a word that can be asked for."""

RULED_WORDS = ("cut_sides",)
"""Others, which rules alone ask for (``tacgrasp.lessons.dialogue.rules``)."""

NEARED = ("depth", "force")
"""Quantities that are compared with a number and its tolerance."""

_REASONS: Mapping[str, Why] = {
    "step": Why(),
    "both": Why(with_action=True),
    "force": Why(shows=("force_band",)),
    "limit": Why(shows=("force", "limit")),
    "slip": Why(shows=("force", "holds")),
    "shape": Why(shows=("shape",)),
    "texture": Why(shows=("texture",)),
    "depth": Why(shows=("depth",)),
    "position": Why(shows=("position",)),
    "cut": Why(shows=("cut",)),
    "felt": Why(shows=("depth", "area", "force")),
}
_LENGTHS = {Length.FREE: "", Length.WORD: " in a word", Length.SENTENCE: " in a sentence"}
_ORDINALS = ("first", "second", "third")
_SHARES = {
    "half": 50, "one half": 50, "a half": 50, "third": 33.3, "a third": 33.3, "one third": 33.3,
    "two thirds": 66.7, "a quarter": 25, "one quarter": 25, "three quarters": 75, "a fifth": 20,
    "one fifth": 20, "a tenth": 10, "one tenth": 10,
}  # fmt: skip
_SHARE = re.compile(
    rf"\b({'|'.join(sorted(_SHARES, key=len, reverse=True))})\b"
    r"(?= (?:of )?(?:(?:the|this|our|its|my|that) (?:\w+ )?"
    r"(?:pad|gel|sensor|surface|fingertip|skin|limit|ceiling)|(?:of )?(?:\w+ )?limit)\b)"
)
_SINGLE = re.compile(
    r"\b(?:an?|one)(?: (?:single|full|whole|entire|good))? (?=(?:milli|micro|kilo|mm\b))"
)
_MULTIPLES = {
    re.compile(pattern): word
    for pattern, word in {
        r"(?<![\d.,])(?:two|2) times\b": "twice",
        r"(?<![\d.,])(?:three|3) times\b": "thrice",
        r"\bmultiplied by (?:two|2)\b": "doubled",
        r"\bmultiplied by (?:three|3)\b": "tripled",
        r"\bdivided by (?:two|2)\b": "halved",
        r"\b(?:one|1) half of\b": "half of",
    }.items()
}
"""Multiples that are no numbers of a question."""

_ONE_WORD = re.compile(r"\bone(?=[- ](?:\w+ )?(?:word|sentence|question)\b)")
_MM = re.compile(r"\bmm\b(?!²|\^)")
_NUMBER = re.compile(r"(?<= )-?\d\S*")
_REFERENCE = re.compile(r"#(\d)")
_NEEDED = re.compile(rf"needed #(\d) ({'|'.join(MASS_UNITS)}) (\S+)")
_ROUNDED = re.compile(r"((?:amount|calculate) .+) to (\S+)")
_LESSENED = re.compile(r"(\w+) - #(\d) (\S+)")


class LostNumberError(ValueError):
    """A number of a meaning is not among those of its question."""


class AskedText(NamedTuple):
    """A question as the language model reads it.

    Attributes:
        words: Its plain words, with '#' for each number.
        numbers: Its numbers, in their order.
    """

    words: str
    numbers: tuple[float, ...]


def asked_text(question: str, before: str = "") -> AskedText:
    """A question in plain words, behind the one before it where that is needed.

    Numbers in words are numbers too: 'half a newton', 'a third of the pad'. Multiples are not:
    'three times' is 'thrice'.
    """
    question = with_plain_numbers(question)
    lowered = with_counted_parts(_ONE_WORD.sub("a", question.lower()))
    lowered = _SHARE.sub(lambda match: f"{_SHARES[match[1]]} percent", lowered)
    for multiple, word in _MULTIPLES.items():
        lowered = multiple.sub(word, lowered)
    lowered = _MM.sub("millimetre", lowered)
    plain = plain_text(_SINGLE.sub("1 ", in_digits(lowered)))
    words = " ".join(plain.words)
    if before:
        words = f"{asked_text(before).words} ? {words}"
    return AskedText(words, tuple(plain.numbers[place] for place in sorted(plain.numbers)))


def query_of(meaning: Meaning, numbers: Sequence[float] = ()) -> str:
    """The query of a meaning.

    Args:
        meaning: What is asked.
        numbers: Numbers of the question, of which the query names those that it needs.

    Raises:
        ValueError: No query has this meaning.
        LostNumberError: A number of it is not in the question.
    """
    parts = meaning.parts if isinstance(meaning, Several) else (meaning,)
    length = getattr(meaning, "length", Length.FREE)
    query = "; ".join(_part(part, numbers) for part in parts)
    return f"{query}{_LENGTHS[length]}."


def read_query(query: str, numbers: Sequence[float] = ()) -> Meaning | None:
    """The meaning of a query; None where it names a number that the question does not have.

    A part that it has twice is answered once.

    Raises:
        ValueError: It is no query.
    """
    length = Length.FREE
    for each, ending in _LENGTHS.items():
        if ending and query.endswith(f"{ending}."):
            length, query = each, query.removesuffix(f"{ending}.") + "."
    if not query.endswith("."):
        raise ValueError(f"a query ends with a full stop, got {query!r}")
    texts = list(dict.fromkeys(query[:-1].split("; ")))
    if any(int(number) > len(numbers) for number in _REFERENCE.findall(query)):
        return None
    if len(texts) == 1:
        return _meaning(texts[0], numbers, length)
    parts = []
    for text in texts:
        part = _meaning(text, numbers, Length.FREE)
        if not isinstance(part, Part):
            raise ValueError(f"{text!r} is not asked together with others")
        parts.append(part)
    return Several(parts=tuple(parts))


@lru_cache(maxsize=8)
def query_grammar(num_numbers: int) -> Grammar:
    """Every query about a question with so many numbers."""
    joinable = list(_joinable(min(num_numbers, MOST_NUMBERS)))
    more: TextChoice | None = None
    for name in reversed(_ORDINALS[1:]):
        ends = [Option(f"{text}.", f" {text}.") for text in joinable]
        if more is not None:
            ends += [Option(f"{text};", f" {text};", then=(more,)) for text in joinable]
        more = TextChoice(name, tuple(ends))
    options = [option for text in (*joinable, *_alone()) for option in _endings(text)]
    if more is not None:
        options += [Option(f"{text};", f"{text};", then=(more,)) for text in joinable]
    return (TextChoice(_ORDINALS[0], tuple(options)),)


def _endings(text: str) -> Iterator[Option]:
    for ending in _LENGTHS.values():
        yield Option(f"{text}{ending}.", f"{text}{ending}.")


def _joinable(num_numbers: int) -> Iterator[str]:
    """Parts that can be asked together with others."""
    for quantity, units in AMOUNTS.items():
        yield from (f"amount {quantity} {unit}" for unit in units)
    yield from (f"{how} {name}" for how in ("word", "choice") for name in WORDS)
    for denial in ("", "not "):
        yield from (f"check {denial}{state}" for state in STATES)
        yield from (f"check {denial}{name} {w}" for name, words in CLASSES.items() for w in words)
        yield from (
            f"check {denial}{name} {sign} {w}"
            for name, words in ORDERED.items()
            for sign in SIGNS
            for w in words
        )
        yield from (f"check {denial}{test}" for test in _numbered(num_numbers))
    yield from (f"check {fate} {GIVEN}" for fate in FATES)
    for n in range(1, num_numbers + 1):
        yield from (f"amount needed #{n} {m} {unit}" for m in MASS_UNITS for unit in NEEDED_IN)
    for quantity, units in LESSENED.items():
        for unit in units:
            yield from (f"amount {quantity} - #{n} {unit}" for n in range(1, num_numbers + 1))


def _numbered(num_numbers: int) -> Iterator[str]:
    """Conditions with numbers of the question."""
    references = [f"#{number}" for number in range(1, num_numbers + 1)]
    for quantity, units in MEASURED.items():
        for unit in units:
            for one in references:
                yield from (f"{quantity} {sign} {one} {unit}" for sign in SIGNS)
                if quantity in NEARED:
                    yield f"{quantity} about {one} {unit}"
            for low, high in pairwise(references):
                yield f"{quantity} {low} - {high} {unit}"
                if quantity in NEARED:
                    yield f"{quantity} {low} +- {high} {unit}"
                    yield f"{quantity} {high} +- {low} {unit}"
    for one in references:
        yield from (f"{fate} {one} {unit}" for fate in FATES for unit in MASS_UNITS)


def _alone() -> Iterator[str]:
    yield from (f"why {reason}" for reason in _REASONS)
    yield from (f"unknown {name}" for name in SUBJECTS if name not in RULED_SUBJECTS)
    yield from ("describe", "other")


def _part(meaning: Meaning, numbers: Sequence[float]) -> str:
    match meaning:
        case Amount(step=step) | Calculated(step=step) if step:
            return f"{_part(replace(meaning, step=0.0), numbers)} to {number_text(step)}"
        case Amount(quantity=quantity, unit=unit, less=less) if less and unit in LESSENED.get(
            quantity, ()
        ):
            return f"amount {quantity} {_referred(f'- {less.split()[0]}', numbers)} {unit}"
        case Amount(quantity="needed", unit=unit, of=of) if of and can_be_in("needed", unit):
            return f"amount {_referred(f'needed {of}', numbers)} {unit}"
        case Amount(quantity=quantity, unit=unit, less="") if can_be_in(quantity, unit):
            return f"amount {quantity} {unit}"
        case Which(name=name, is_open=is_open) if name in (*WORDS, *RULED_WORDS):
            return f"{'word' if is_open else 'choice'} {name}"
        case Check(test=test, denied=denied) if test:
            return f"check {'not ' if denied else ''}{_referred(test, numbers)}"
        case Calculated(truth=truth, unit=unit):
            return f"calculate {truth}" if unit is None else f"calculate {truth} in {unit or 1}"
        case Why():
            listed = next((name for name, why in _REASONS.items() if why == meaning), "")
            if listed:
                return f"why {listed}"
            if not meaning.with_action and all(name in FACTS for name in meaning.shows):
                return f"because {', '.join(meaning.shows)}"
        case Description():
            return "describe"
        case Unknowable(subject=subject):
            names = {said: name for name, said in SUBJECTS.items()}
            if subject in names:
                return f"unknown {names[subject]}"
        case OffTopic():
            return "other"
    raise ValueError(f"no query has the meaning {meaning}")


def _referred(test: str, numbers: Sequence[float]) -> str:
    """A condition with the places of its numbers in the question."""

    def place(match: re.Match[str]) -> str:
        value = float(match[0])
        for number, candidate in enumerate(numbers[:MOST_NUMBERS], start=1):
            if abs(candidate - value) <= 1e-6 * abs(value):
                return f"#{number}"
            if candidate > 0 and abs(candidate + value) <= 1e-6 * candidate:  # counted to the left
                return f"-#{number}"
        raise LostNumberError(f"{value:g} is none of the question's numbers {list(numbers)}")

    return _NUMBER.sub(place, test)


def _meaning(text: str, numbers: Sequence[float], length: Length) -> Meaning:
    if found := _ROUNDED.fullmatch(text):
        told = _meaning(found[1], numbers, length)
        if isinstance(told, Amount | Calculated):
            return replace(told, step=float(found[2]))
    kind, _, rest = text.partition(" ")
    words = rest.split()
    match kind:
        case "amount" if (lessened := _LESSENED.fullmatch(rest)) and (
            lessened[3] in LESSENED.get(lessened[1], ())
        ):
            quantity, place, unit = lessened.groups()
            less = taken(quantity, numbers[int(place) - 1], unit)
            return Amount(quantity=quantity, unit=unit, less=less, length=length)
        case "amount" if (needed := _NEEDED.fullmatch(rest)) and can_be_in("needed", needed[3]):
            of = f"{number_text(numbers[int(needed[1]) - 1])} {needed[2]}"
            return Amount(quantity="needed", unit=needed[3], of=of, length=length)
        case "amount" if len(words) > 1 and can_be_in(" ".join(words[:-1]), words[-1]):
            return Amount(quantity=" ".join(words[:-1]), unit=words[-1], length=length)
        case "word" | "choice" if rest in (*WORDS, *RULED_WORDS):
            return Which(name=rest, is_open=kind == "word", length=length)
        case "check":
            test = _REFERENCE.sub(lambda m: number_text(numbers[int(m[1]) - 1]), rest)
            test = test.replace("--", "")  # less than nothing to the left is to the right
            is_denied = test.startswith("not ")
            return check_of(test.removeprefix("not "), denied=is_denied, length=length)
        case "calculate":
            truth, _, unit = rest.rpartition(" in ")
            if truth and (unit in UNITS or unit == "1" or "/" in unit):
                return Calculated(truth=truth, unit=unit.removeprefix("1"))
            return Calculated(truth=rest, unit=None)
        case "why" if rest in _REASONS:
            return _REASONS[rest]
        case "because" if rest and all(name in FACTS for name in rest.split(", ")):
            return Why(shows=tuple(rest.split(", ")))
        case "unknown" if rest in SUBJECTS:
            return Unknowable(subject=SUBJECTS[rest], length=length)
        case "describe" if not rest:
            return Description(length=length)
        case "other" if not rest:
            return OffTopic()
    raise ValueError(f"{text!r} is no query")
