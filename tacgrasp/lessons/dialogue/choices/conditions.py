"""What choices hang on: a term against another one, the band.

Not here: which question asks for which (``tacgrasp.lessons.dialogue.choices.choosing``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual
from tacgrasp.lessons.dialogue.calculations.terms import Term, alike
from tacgrasp.lessons.dialogue.choices.rest import RestOfQuestion
from tacgrasp.lessons.dialogue.choices.scales import Offer
from tacgrasp.lessons.dialogue.conditions import IN_BAND
from tacgrasp.lessons.dialogue.expression import Expression

NEITHER = "neither"
"""The answer where none of the alternatives holds."""

_HOLDS = Term(expression="holds_g", dimension="mass", words="it")
_FREE = Term(expression="100 - area_percent", dimension="fraction", words="it", is_sum=True)
_GIVEN = ("limit_n", "band_low_n", "band_high_n", "mass_g")


def choice_of(*cases: tuple[str | None, str]) -> str | None:
    """A choice as an expression, of words with their conditions; the last one's is not needed.

    None where two of the words are the same, or one is missing.
    """
    words = [word for word, _ in cases]
    if None in words or len(set(words)) < len(words):
        return None
    told = "".join(f"{word!r} if {condition} else " for word, condition in cases[:-1])
    return f"{told}{words[-1]!r}"


def band_part(below: str | None, within: str | None, above: str | None) -> str | None:
    """Where the force lies against the band, by the words for it; one may have no word."""
    parts = (
        (below, "force_n < band_low_n"),
        (above, "force_n > band_high_n"),
        (within, IN_BAND),
    )
    cases = [(word, condition) for word, condition in parts if word is not None]
    if len(cases) < 2:
        return None
    return choice_of(*cases) if len(cases) == 3 else choice_of(*cases, (NEITHER, ""))


def compared_to(asked: AskedWords, offer: Offer, rest: RestOfQuestion) -> tuple[Term, Term] | None:
    """What is compared with what; None where that is not clear."""
    numbers = _different([term for term in rest.terms if not term.has_quantity])
    named = [term for term in rest.terms if term.has_quantity]
    if not rest.terms and rest.cues >= {"half", "area"}:
        numbers = [Term(expression="50", dimension="fraction", words="half")]
    if len(numbers) == 1 and len(named) < 2:
        return with_cues(asked, named[0] if named else None, numbers[0], rest)
    if numbers or not named or len(named) > 2:
        return None
    given = [term for term in named if any(name in term.expression for name in _GIVEN)]
    if len(named) == 1:
        return with_cues(asked, None, given[0], rest) if given else None
    if len(given) != 1:
        return None
    subject = next(term for term in named if term is not given[0])
    return alike(subject, given[0])


def _different(numbers: Sequence[Term]) -> list[Term]:
    """Numbers, each value once: 5 % of the pad is 5 %."""
    first = {
        (Expression(term.expression).evaluate({}).value, term.dimension): term
        for term in reversed(numbers)
    }
    return list(first.values())


def with_cues(
    asked: AskedWords, subject: Term | None, other: Term, rest: RestOfQuestion
) -> tuple[Term, Term] | None:
    """A subject beside another term; without one it is what the cues tell."""
    if subject is None:
        subject = _felt(other, rest)
    if subject is None or subject.expression == other.expression:
        return None
    return alike(_sideways(subject, rest), other)


def _felt(other: Term, rest: RestOfQuestion) -> Term | None:
    """What is felt in the dimension of a term, by the cues of the question."""
    cues = rest.cues - {"place", "half", "larger", "smaller"}
    match other.dimension:
        case "length" if cues <= {"offset", "x", "y", "middle", "area"} and cues & {
            "offset", "x", "y", "middle",
        }:  # fmt: skip
            return Term(expression="hypot(x_mm, y_mm)", dimension="length", words="it")
        case "length" if cues <= {"depth", "force", "area"}:
            return usual("length")
        case "force" if cues <= {"force", "depth", "area", "holds", "band"}:
            return usual("force")
        case "fraction" | "area" if cues <= {"area", "force"}:
            return usual("fraction")
        case "mass" if "mass" in cues and cues <= {"mass"}:
            return usual("mass")
        case "mass" if "holds" in cues and cues <= {"holds", "force"}:
            return _HOLDS
        case "mass" if cues == {"force"}:
            return usual("force")
        case "mass" if not cues:
            return usual("mass")
    return None


def _sideways(subject: Term, rest: RestOfQuestion) -> Term:
    """A distance from the middle along one axis, where the question names one."""
    sides = [name for name in "xy" if name in rest.cues]
    if subject.expression != "hypot(x_mm, y_mm)" or len(sides) != 1:
        return subject
    return replace(subject, expression=f"abs({sides[0]}_mm)")
