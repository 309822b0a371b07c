"""The numbers of a text, read once: forces, changes, lengths, and what can't be read.

Read are newtons with prefixes, grams, kilograms, pounds and ounces of force, in digits and in words,
with tolerances, ranges, factors on the task's force, and lengths with what they bound. Not here: manner.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from policies.instructions.english.number_pattern import NumberPattern
from policies.instructions.quantities.bounds import with_bounds_at_forces, with_plain_bounds
from policies.instructions.quantities.elisions import (
    bare_number,
    left_over,
    unsaid_force,
    written_out,
)
from policies.instructions.quantities.factors import denied_factor, read_delta, read_factor
from policies.instructions.quantities.force import WORKED_OUT, Force
from policies.instructions.quantities.force_units import NUMBER, ONE_FORCE, UNIT, number
from policies.instructions.quantities.forces import read_forces
from policies.instructions.quantities.masses import Masses, without_masses
from policies.instructions.quantities.numerals import in_digits
from policies.instructions.quantities.places import (
    AREA,
    place_words,
    read_lengths,
    without_slip_bound,
)
from policies.instructions.quantities.tolerances import with_plain_tolerances, without_lone
from policies.instructions.quantities.unknown_units import (
    open_force,
    undecided_force,
    unknown_force,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantities:
    """What a text says in numbers.

    Attributes:
        forces: Forces in their order; the ends of a range are a least and a most.
        stated: Forces that are named beside them, and not asked for.
        is_worked_out: Whether a force was worked out from others that the text names, or had to be.
        delta_n: Force to add to the task's ('half a newton more'); None where none is named [N].
        factor: Factor on the task's force ('half as hard'); None where none is named.
        factor_words: The words that name it.
        slip_mm, depth_mm: Largest slip, and depth, that are named [mm]; None where none is.
        area_fraction: Part of the pad in contact that is named; None where none is.
        pressure: Words of a pressure that is named in place of a force; '' for none.
        unitless: A number that stands where a force would, without a unit; '' for none.
        unread: Why a number that stands where a force would is none that can be read ('1 Nm');
            '' for none.
        percentage: A percentage or tolerance of nothing, where a force would stand; '' for none.
        place: Words about the place on the pad, which are not read; '' for none.
        denied: Words of a force that is not to be used, where no other one is named; '' for none.
        masses: Masses that are said of objects; they are no forces.
        rest: The plain text with each quantity and its relation replaced by ``MARK``.
    """

    forces: tuple[Force, ...] = ()
    stated: tuple[Force, ...] = ()
    is_worked_out: bool = False
    delta_n: float | None = None
    factor: float | None = None
    factor_words: str = ""
    slip_mm: float | None = None
    depth_mm: float | None = None
    area_fraction: float | None = None
    pressure: str = ""
    unitless: str = ""
    unread: str = ""
    percentage: str = ""
    place: str = ""
    denied: str = ""
    masses: Masses = field(default_factory=Masses)
    rest: str = ""


_FILLER = r"(?:um+|uh+|er+m?|hmm+|like|say|well|oh|let us say|let me say|i would say|you know|i guess|i do not know|i think|i suppose|whatever)"
_FILLED = NumberPattern(
    rf"\b(?P<bound>at (?:the )?(?:very |absolute )?(?:most|least)|(?:no|not) (?:more|less|harder|higher) than)"
    rf"(?: ?[,:;] ?|\.{{2,3}} ?| )(?:{_FILLER}[ ,]+)*(?={NUMBER})|"
    rf"\b(?P<bare>(?:more|less|harder|higher) than|over|above|below|under|exceed(?:ing)?|up to),? (?:{_FILLER}[ ,]+)+(?={NUMBER})"
)
"""'At most, say, 0.8 N', 'do not use more than, um, 1 N'."""
_INTERJECTED = NumberPattern(
    rf"({NUMBER}(?:\s*-?\s*(?:{UNIT}))?) (?:(?:no|nope|nah|wait|oh|er+|uh+|um+) )*(?:no|nope|nah) (?:(?:wait|oh|er+|uh+|um+|make (?:it|that)|just|only) )*(?={NUMBER}\s*-?\s*(?:{UNIT})\b)"
)
"""'2 N no 1 N', as it is spoken."""
_ELLIPSIS = NumberPattern(
    rf"\b(?:not|no) (?:an?|1|one|a single) (millinewton|newton|gram|mn|n|gf) (more|less)(?: than)? ({NUMBER})(?!\s*(?:{UNIT})\b)"
)
_CHAIN = NumberPattern(
    rf"({NUMBER})\s*(?:{UNIT})?\s*<=?\s*(?:f|force|it|x|grip)\s*<=?\s*({NUMBER})\s*((?:{UNIT})\b)"
)
_PAIR = NumberPattern(rf"[\[(]\s*({NUMBER})\s*[,;]\s+({NUMBER})\s*[\])]\s*((?:{UNIT})\b)")
_PRESSURE = NumberPattern(
    rf"(?:{NUMBER})\s*(?:[kmh]?pa\b|(?:kilo|mega|milli|hecto)?pascals?|m?bars?\b|psi\b|mm\s?hg|atm\b|"
    r"n ?(?:/|per) ?(?:square )?[cm]m)"
)
_PERCENT_OF_NOTHING = NumberPattern(
    rf"\b(?:with|at|use|using|apply|to|(?:give|make|set|put|turn|run) it|go|only|just) ({NUMBER}\s*(?:%|percent|per cent))(?=\s*(?:$|[.,;!]| please| and| force\b))"
)


_ONE_THIRD = NumberPattern(rf"\b(?:one|1) (?=0\.\d+\s*(?:{UNIT})\b)")
"""'One third newton', in digits."""
_SPELLINGS = (
    (NumberPattern(rf"({NUMBER}) ?, ?(?=(?:{UNIT})\b)"), r"\1 "),
    (NumberPattern(r"(?<=\d)['\u00a0\u202f ](?=\d{3}\b(?! ?mm))"), ""),  # 1 400 mN
    (NumberPattern(rf"({NUMBER})\s?-?ish\b"), r"\1"),
    (NumberPattern(rf"({NUMBER}) ?\(((?:{UNIT}))\)"), r"\1 \2"),
    (NumberPattern(rf"(\d)\.\s*(?=(?:{UNIT})\b)"), r"\1 "),  # '5. N'
    (NumberPattern(rf"(?<![\d.,])0 ?[.,] ?(?=\d{{1,3}}\s*-?\s*(?:{UNIT})\b)"), "0."),  # '0. 8 N'
)


def _plain_bound(match: re.Match[str]) -> str:
    """A bound beside its number; one that stands behind a force bounds that one instead."""
    if re.search(rf"{ONE_FORCE}[ ,]*$", match.string[: match.start()]):
        return match[0]
    return f"{match['bound'] or match['bare']} "


def read_quantities(text: str) -> Quantities:
    """Read the numbers of a plain text (``policies.instructions.english.text.plain``)."""
    text = _FILLED.sub(_plain_bound, with_bounds_at_forces(in_digits(text)))
    text = _ONE_THIRD.sub("", text)
    text = _INTERJECTED.sub(r"\1, no wait, ", text)
    text = _ELLIPSIS.sub(r"no \2 than \3 \1", text)
    text, masses = without_masses(text)
    for pattern, plainly in _SPELLINGS:
        text = pattern.sub(plainly, text)
    left_open = open_force(text)
    text, unsure = text.replace(WORKED_OUT, "→"), ""
    is_worked_out = False
    if re.search(r"\d", text):
        from policies.instructions.quantities import calculations

        text, before = calculations.worked_out(calculations.with_shares(text)), text
        is_worked_out = text != before
        unsure = calculations.unsure_change(text)
    worked = text
    text, lone = without_lone(with_plain_tolerances(text))
    text = _CHAIN.sub(r"between \1 and \2 \3", text)
    text = with_plain_bounds(text)
    text = _PAIR.sub(r"between \1 and \2 \3", text)
    plainly, unread = text, unknown_force(text)
    text, unitless = written_out(text)
    pressure = _PRESSURE.search(text)
    slip_mm, depth_mm = read_lengths(text)
    text = without_slip_bound(text)
    area = AREA.search(text)
    delta_n, text = read_delta(text)
    forces, dropped, denied, text = read_forces(text)
    unread = left_open or unread or undecided_force(plainly, is_bounded=bool(forces))
    before_factor = text
    factor, factor_words, text = read_factor(text)
    unitless = unitless or (left_over(text) if forces else unsaid_force(text))
    if forces and all(force.kind == "least" for force in forces):
        unitless = unitless or bare_number(text)
    if factor is not None and not forces:
        denied = denied or denied_factor(before_factor, factor, factor_words)
    if unsure and any(force.kind == "value" for force in forces):
        unread = unread or f"{unsure!r} changes a force that it names; say the one that is meant"
    if {"least", "most"} <= {force.kind for force in forces}:
        from policies.instructions.quantities import calculations

        if changed := calculations.change_of_range(worked):
            is_worked_out = True
            unread = (
                unread or f"{changed!r} changes a range; say both ends of the one that is meant"
            )
    is_alone = factor is None and area is None
    percentage = _PERCENT_OF_NOTHING.search(text) if is_alone else None
    return Quantities(
        forces=tuple(forces),
        stated=tuple(dropped),
        is_worked_out=is_worked_out,
        delta_n=delta_n,
        factor=factor,
        factor_words=factor_words,
        slip_mm=slip_mm,
        depth_mm=depth_mm,
        area_fraction=None if area is None else number(area["a"]) / 100,
        pressure="" if pressure is None else pressure[0],
        unitless=unitless,
        unread=unread,
        percentage=lone if percentage is None else percentage[1],
        place=place_words(text),
        denied=denied,
        masses=masses,
        rest=text,
    )
