"""Noun phrases that mean a quantity, a number, or something calculated of these.

    the upper edge of the band                  band_high_n
    half of the limit                           0.5 * limit_n
    the force minus the object's weight         force_n - 0.00980665 * mass_g
    the difference between x and 2 mm           abs(x_mm - 2)

Not here: questions (``tacgrasp.lessons.dialogue.calculations.calculated``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from tacgrasp.lessons.dialogue.calculations.quantity_names import (
    NAMED,
    THING,
    UNIT,
    WEIGHT,
    unit_of,
)
from tacgrasp.lessons.dialogue.conditions import ABOUT, number_text
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS

PLAIN, UNSAID = "ratio", "unsaid"
"""Dimensions of a ratio, and of a number without a unit, which has that of what stands beside."""

MOST_WORDS = 24
"""Longest term [words]: a longer one is a sentence."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Term:
    """A noun phrase's meaning.

    Attributes:
        expression: Its value (``tacgrasp.lessons.dialogue.expression``), in mm, N, percent, mm²,
            g or N/mm².
        dimension: What it measures: that of a unit, ``PLAIN`` or ``UNSAID``.
        words: The phrase in plain words.
        is_sum: Whether the expression needs brackets beside another operator.
        is_weight: Whether grams were called a weight, which has newtons too.
        unit: Symbol of the unit of a bare number with one; ''.
    """

    expression: str
    dimension: str
    words: str
    is_sum: bool = False
    is_weight: bool = False
    unit: str = ""

    @property
    def factor(self) -> str:
        """The expression as it stands beside another operator."""
        return f"({self.expression})" if self.is_sum else self.expression

    @property
    def divisor(self) -> str:
        """The expression as it stands behind a bar."""
        is_single = re.fullmatch(r"[\w.]+|\w+\([^()]*\)", self.expression) is not None
        return self.expression if is_single else f"({self.expression})"

    @property
    def has_quantity(self) -> bool:
        """Whether it has more than numbers."""
        return re.search(r"[a-z]{2}", self.expression) is not None


def is_near(value: str, middle: Term, *, denied: bool, share: float = ABOUT) -> str:
    """The condition that a value is another one within a share of it, or that it is not.

    Args:
        value: Expression of the value.
        middle: The other one.
        denied: Whether it is not to be near.
        share: How far off it may be, as a fraction.
    """
    number = Expression(middle.expression).evaluate({}).value
    away = f"{share:g} * {middle.factor}"
    if isinstance(number, int | float):
        away = number_text(share * abs(number))
    near = f"abs({value} - {middle.factor}) <= {away}"
    return f"not ({near})" if denied else near


_MULTIPLES: Mapping[str, str] = {
    r"(?:one )?half|half of|half ?way(?: (?:mark|point|line))?(?: (?:to|towards?|up to))?": "0.5",
    r"twice|double|two times": "2",
    r"thrice|triple|three times": "3",
    r"four times|quadruple": "4",
    r"(?:a |one )?third": "1 / 3",
    r"two thirds": "2 / 3",
    r"(?:a |one )?quarter": "0.25",
    r"three quarters": "0.75",
    r"(?:a |one )?fifth": "0.2",
    r"(?:a |one )?tenth": "0.1",
}
_ARTICLE = re.compile(
    r"(?:(?:the|my|our|your|its|this|that|an?|current|currently|present|presently|actual|measured|"
    r"applied|exerted|felt|momentary|real|whole|total|overall|existing|latest|exact|full|size of|"
    r"value of|amount of|level of|figure for|reading of|contact's|object's|of) )+(?=\S)"
)
_TRAILING = re.compile(
    r"(?: (?:from here|right now|just now|now|at (?:this|the present) moment|currently|presently|"
    r"at present|at the moment|here|"
    r"instead|today|itself|as felt|as measured|in size|value|figure|reading|"
    r"on (?:the )?(?:pad|gel)|(?<=\w )(?:mark|line|threshold)|"
    r"(?<!what )(?:that )?(?:you|we|i)(?: are| am)? "
    r"(?:feel|have|read|see|press|apply|measur|us|squeez|exert|gripp?|hold|pinch|clamp)(?:e|"
    r"ing)?(?: (?:with|now|there|here|on it|it|it with))*|(?:that )?(?:the (?:gel|pad|skin)|it) "
    r"(?:can|could|may|will) (?:take|go|do|bear|give|squish|stand|offer|be pressed(?: in)?)|"
    r"(?:that )?(?:they|you|we|i|he|she) (?:set|gave|told|allowed|agreed on)(?: (?:you|me|us|"
    r"it))?))+$"
)
_NUMBER = re.compile(
    rf"(?:(?:depth|force|area|mass|load|grip|weight|squeeze|clamp) of (?:an? )?)?(#\d+)(?: "
    rf"({UNIT})(?: (?:of )?(?:mass|load|force|grip|squeeze|deep|depth|indentation|travel|{THING})|"
    rf"(?: \w+)? (?:range|scale|travel|stroke|span))?| force)?"
)
_MASS_OF = re.compile(
    r"(#\d+ (?:g|grams?|kg|kilos?|kilograms?)) "
    r"(?!(?:more|less|extra|over|under|above|below|short|per|to|at|is|are|and|of|for|with|in|on|by|"
    r"from|as|or|but|we|i|you|it|the|a|an|before|without|then|if|when|would|will|can|could|does|do|"
    r"that|this|away|off|now|here|total|each|be|has|have|than|through|up|down|what|how|"
    r"\w+(?:er|ed|ly|ing))$)[a-z]+"
)
"""A mass with whatever has it: 'a 20 g nut'."""

_HOLDING = r"(?:hold|keep|carry|lift|bear|support|secure)"
_SURE = r"(?:surely|safely|certainly|definitely|reliably|for sure|for certain)"
_NEEDED = re.compile(
    r"(?:(?:the |that )?(?:(?:least|minimum|smallest|lowest) )?(?:force|grip|squeeze)(?: (?:that|"
    r"which))?|what) (?:"
    rf"(?P<a>.+?) (?:needs?|requires?|takes|demands|calls for|asks for)(?: to be (?:{_SURE} "
    rf")?held)?|"
    rf"(?:would |will )?(?:(?:be )?(?:sure|certain|enough) to |{_SURE} )?{_HOLDING}s? (?P<b>.+?)|"
    rf"(?:is |would be )?(?:needed|required|necessary) (?:to (?:{_SURE} )?{_HOLDING}|for|by) "
    rf"(?P<c>.+?))"
    rf"(?: {_SURE})?"
)
"""The force that surely holds a mass: 'the grip that 60 g need'."""

_BODY = re.compile(
    rf"(?:(?:the|this|that|our|its|my) )?(?:(?:told|stated|held|lifted|gripped) )?{THING}|it|them"
)
"""What is held, whose mass a force holds."""

_SUCH = re.compile(
    rf"(#\d+) (?:of (?:these|them|those)(?: {THING}s?)?|such {THING}s?|(?:pieces|objects|items|"
    rf"copies|things|"
    r"parts) (?:like|identical to|just like) (?:this|it)(?: one)?)(?: together| combined|"
    r" in total)?"
)
"""Several objects like the one that is held."""

_SCALE = re.compile(
    rf"(?:scale|range|span|interval) (?:(?:of|from|running from|going from) )?(?P<low>#\d+)"
    rf"(?: (?:{UNIT}))? (?:to |through |up to )?(?P<high>.+)|"
    rf"(?P<first>#\d+)(?: (?:{UNIT}))? (?:to )?(?P<last>#\d+ (?:{UNIT})) (?:scale|range|span)"
)
"""A scale that begins at nothing, which is as long as its upper end."""


_OPERATIONS: Sequence[tuple[str, re.Pattern[str]]] = tuple(
    (name, re.compile(pattern))
    for name, pattern in (
        (
            "between",
            r"(?:difference|gap|distance|spread|room|headroom|margin) between (.+) and (.+)",
        ),
        ("between", r"difference (?:of|from) (.+) (?:and|to|from) (.+)"),
        ("plus", r"sum of (.+) and (.+)"),
        (
            "sum",
            r"(.+) (minus|less|reduced by|lowered by|plus|increased by|raised by) (.+)",
        ),
        ("plus", r"(.+) and (.+) (?:together|combined|added|taken together)"),
        ("ratio", r"(?:ratio|quotient) (?:of|between) (.+) (?:to|and) (.+)"),
        ("ratio", r"(.+) divided by (.+)"),
        ("times", r"(.+) (?:times|multiplied by|multiplied with) (.+)"),
        ("mean", r"(?:mean|average|midpoint) (?:of|between) (.+) and (.+)"),
        ("min", r"(?:smaller|lesser|lower|least) (?:one )?of (.+) and (.+)"),
        ("max", r"(?:larger|greater|higher|bigger|most) (?:one )?of (.+) and (.+)"),
        ("more", r"(.+) (?:more|above|over|higher|deeper|greater)(?: than)? (.+)"),
        ("less", r"(.+) (?:less|below|under|lower|short of|shallower)(?: than)? (.+)"),
    )
)
_PERCENT_OF = re.compile(r"(#\d+) percent (?:of )?(.+)")
_TIMES = re.compile(r"(#\d+) (?:times|fold) (.+)")
_PARTS_OF = re.compile(r"(#\d+) (thirds|quarters|fifths|eighths|tenths) of (.+)")
_PARTS = {"thirds": 3, "quarters": 4, "fifths": 5, "eighths": 8, "tenths": 10}
_MULTIPLE = re.compile(rf"({'|'.join(_MULTIPLES)}) (?:of |as \w+ as )?(.+)")
_MADE = {"doubled": "2", "halved": "0.5", "tripled": "3", "quartered": "0.25", "quadrupled": "4"}
_MADE_SO = re.compile(rf"(?:({'|'.join(_MADE)}) (.+)|(.+) ({'|'.join(_MADE)}))")
_MINUS = re.compile(r"(?:minus|negative) (.+)")
_SO_OFTEN = re.compile(r"(.+) times (#\d+)")


class TermReader:
    """Reads terms of one question.

    Args:
        numbers: The question's numbers, which its plain words name #1, #2, ...
    """

    def __init__(self, numbers: Sequence[float]) -> None:
        self._numbers = tuple(numbers)

    def read(self, words: str) -> Term | None:
        """The meaning of a noun phrase in plain words; None where it has none."""
        return _read(_TRAILING.sub("", words.strip()), self._numbers)


@lru_cache(maxsize=4096)
def _read(words: str, numbers: tuple[float, ...]) -> Term | None:
    if not words or words.count(" ") >= MOST_WORDS:
        return None
    for reader in (_number, _quantity, _scale, _operation, _multiple):
        if found := reader(words, numbers):
            return found
    bare = _ARTICLE.sub("", words, count=1) if _ARTICLE.match(words) else words
    return _read(bare, numbers) if bare != words else None


def _number(words: str, numbers: tuple[float, ...]) -> Term | None:
    mass = _MASS_OF.fullmatch(words)
    if (found := _NUMBER.fullmatch(mass[1] if mass else words)) is None:
        return None
    number = numbers[int(found[1][1:]) - 1]
    if found[2] is None:
        return Term(expression=number_text(number), dimension=UNSAID, words=words)
    unit = UNITS[unit_of(found[2])]
    return Term(
        expression=number_text(number * unit.size),
        dimension=unit.dimension,
        words=words,
        unit=unit.symbol,
    )


def _quantity(words: str, numbers: tuple[float, ...]) -> Term | None:
    if count := _SUCH.fullmatch(words):
        times = number_text(numbers[int(count[1][1:]) - 1])
        return Term(expression=f"{times} * mass_g", dimension="mass", words=words)
    if needed := _NEEDED.fullmatch(words):
        load = next(filter(None, needed.groups()))
        mass = "mass_g" if _BODY.fullmatch(load) else ""
        if not mass and (term := _read(load, numbers)) and term.dimension == "mass":
            mass = term.factor
        if mass and mass != "holds_g":
            return Term(expression=f"gram_n * {mass}", dimension="force", words=words)
    if WEIGHT.fullmatch(words):
        return Term(expression="mass_g", dimension="mass", words=words, is_weight=True)
    for pattern, expression, dimension in NAMED:
        if pattern.fullmatch(words):
            is_sum = re.search(r" [-+] ", re.sub(r"\(.*?\)", "", expression)) is not None
            return Term(expression=expression, dimension=dimension, words=words, is_sum=is_sum)
    return None


def _scale(words: str, numbers: tuple[float, ...]) -> Term | None:
    found = _SCALE.fullmatch(words)
    if found is None or numbers[int((found["low"] or found["first"])[1:]) - 1] != 0:
        return None
    return _read(found["high"] or found["last"], numbers)


def _operation(words: str, numbers: tuple[float, ...]) -> Term | None:
    for name, pattern in _OPERATIONS:
        if (found := pattern.fullmatch(words)) is None:
            continue
        first, *sign, second = found.groups()
        if name == "sum":
            is_minus = sign[0] in ("minus", "less", "reduced by", "lowered by")
            name = "minus" if is_minus else "plus"
        a, b = (_read(_TRAILING.sub("", part), numbers) for part in (first, second))
        if a and b and (made := _made(name, a, b, words)):
            return made
    return None


def _made(name: str, a: Term, b: Term, words: str) -> Term | None:
    """What an operation makes of two terms; None where their dimensions do not fit."""
    if b.dimension == "fraction" and a.dimension != "fraction" and name in ("plus", "minus"):
        if b.has_quantity:
            return None
        sign = "+" if name == "plus" else "-"
        share = f"(1 {sign} {b.factor} / 100)"
        return Term(expression=f"{share} * {a.factor}", dimension=a.dimension, words=words)
    if name == "ratio" and b.dimension == UNSAID:
        return Term(expression=f"{a.factor} / {b.divisor}", dimension=a.dimension, words=words)
    if name == "times":
        return _product(a, b, words)
    pair = alike(a, b)
    if pair is None:
        return None
    a, b = pair
    if name in ("more", "less") and a.has_quantity:
        return None
    expression = {
        "between": f"abs({a.expression} - {b.factor})",
        "minus": f"{a.expression} - {b.factor}",
        "plus": f"{a.expression} + {b.expression}",
        "more": f"{b.expression} + {a.expression}",
        "less": f"{b.expression} - {a.factor}",
        "ratio": f"{a.factor} / {b.divisor}",
        "mean": f"({a.expression} + {b.expression}) / 2",
        "min": f"min({a.expression}, {b.expression})",
        "max": f"max({a.expression}, {b.expression})",
    }[name]
    return Term(
        expression=expression,
        dimension=PLAIN if name == "ratio" else a.dimension,
        words=words,
        is_sum=name in ("minus", "plus", "more", "less"),
    )


def _product(a: Term, b: Term, words: str) -> Term | None:
    """The volume that an area and a depth make; None of other quantities."""
    area, depth = (a, b) if b.dimension == "length" else (b, a)
    area = in_mm2(area)
    if (area.dimension, depth.dimension) != ("area", "length"):
        return None
    if not (area.has_quantity and depth.has_quantity):
        return None
    expression = f"{area.factor} * {depth.factor}"
    return Term(expression=expression, dimension="volume", words=words)


def alike(a: Term, b: Term) -> tuple[Term, Term] | None:
    """Two terms in one dimension; None where they have none in common.

    A number without a unit has that of the other, a mass beside a force is its weight, and a part
    of the pad beside square millimetres is its area.
    """
    if a.dimension == b.dimension:
        return None if a.dimension == UNSAID else (a, b)
    if a.dimension == UNSAID:
        return _beside(a, b), b
    if b.dimension == UNSAID:
        return a, _beside(b, a)
    if {a.dimension, b.dimension} == {"force", "mass"}:
        return in_newtons(a), in_newtons(b)
    if {a.dimension, b.dimension} == {"area", "fraction"}:
        return in_mm2(a), in_mm2(b)
    return None


def in_newtons(term: Term) -> Term:
    """A force as it is, and a mass as its weight."""
    if term.dimension != "mass":
        return term
    expression = f"{GRAVITY_N_PER_G:g} * {term.factor}"
    return Term(expression=expression, dimension="force", words=term.words, is_weight=True)


def in_mm2(term: Term) -> Term:
    """An area as it is, and a part of the pad as its area."""
    if term.dimension != "fraction":
        return term
    if re.fullmatch(r"(?:[\d.]+ \* )?area_percent", term.expression):
        expression = term.expression.replace("area_percent", "area_mm2")
    else:
        expression = f"pad_width_mm * pad_height_mm * {term.factor} / 100"
    return Term(expression=expression, dimension="area", words=term.words)


def _beside(number: Term, other: Term) -> Term:
    """A number without a unit in that of another one, else in that of a quantity's expression."""
    if not other.unit:
        return replace(number, dimension=other.dimension)
    expression = f"{number_text(UNITS[other.unit].size)} * {number.factor}"
    return replace(number, expression=expression, dimension=other.dimension)


def _multiple(words: str, numbers: tuple[float, ...]) -> Term | None:
    factor, rest = "", ""
    if found := _PERCENT_OF.fullmatch(words):
        factor, rest = f"{number_text(numbers[int(found[1][1:]) - 1] / 100)}", found[2]
    elif found := _PARTS_OF.fullmatch(words):
        factor = number_text(numbers[int(found[1][1:]) - 1] / _PARTS[found[2]])
        rest = found[3]
    elif found := _TIMES.fullmatch(words):
        factor, rest = number_text(numbers[int(found[1][1:]) - 1]), found[2]
    elif found := _MULTIPLE.fullmatch(words):
        said = found[1]
        factor = next(value for name, value in _MULTIPLES.items() if re.fullmatch(name, said))
        rest = found[2]
    elif found := _MADE_SO.fullmatch(words):
        factor, rest = _MADE[found[1] or found[4]], found[2] or found[3]
    elif found := _SO_OFTEN.fullmatch(words):
        factor, rest = number_text(numbers[int(found[2][1:]) - 1]), found[1]
    elif found := _MINUS.fullmatch(words):
        factor, rest = "-1", found[1]
    term = _read(rest, numbers) if rest else None
    if term is None:
        return None
    return Term(
        expression=f"{factor} * {term.factor}",
        dimension=term.dimension,
        words=words,
        is_weight=term.is_weight,
    )
