"""The units behind a question's numbers, against those that a query gives them.

    Is x over 500 microns?          check x > #1 mm.       500 becomes 0.5
    Is 0.5 N enough for 30 g?       check stays #1 g.      impossible: 0.5 N is no mass

A query has not every unit for every quantity, and a reader may mistake which number is which.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS, can_be_in

SPELLED: Mapping[str, str] = {
    r"mm|millimet(?:re|er)s?": "mm",
    r"µm|um|microns?|micromet(?:re|er)s?": "µm",
    r"cm|centimet(?:re|er)s?": "cm",
    r"n|newtons?": "N",
    r"mn|millinewtons?": "mN",
    r"cn|centinewtons?": "cN",
    r"g|grams?|gf": "g",
    r"kg|kilos?|kilograms?": "kg",
    r"percent": "%",
    r"mm2|mm²|(?:square|sq) (?:mm|millimet(?:re|er)s?)": "mm²",
}
"""Units by their plain words."""

_BEHIND_NUMBER = re.compile(
    "#(?: (?:" + "|".join(f"({spelled})" for spelled in SPELLED) + r")(?![^ ]))?"
)
_NUMBER_OF_THINGS = re.compile(r"#(?P<things> (?:of (?:these|those|them)|such|identical)\b)?")
"""'Two of these', 'three such parts', which are no mass."""
_GIVEN_UNIT = re.compile(r"#(\d)(?: (?:\+-|-) #(\d))? ([^\s.;]+)")
_FOREIGN: Mapping[str, tuple[str, ...]] = {
    r"m|met(?:re|er)s?": ("m",),
    r"nm|nanomet(?:re|er)s?": ("nm",),
    r"inch(?:es)?": ("in",),
    r"thou|mils?": ("thou",),
    r"kn|kilonewtons?": ("kN",),
    r"kgf|kp|kiloponds?|(?:kilos?|kilograms?) (?:of )?force": ("kgf",),
    r"lbf|(?:pounds?|lbs?) (?:of )?force": ("lbf",),
    r"ozf|(?:ounces?|oz) (?:of )?force": ("ozf",),
    r"pounds?|lbs?": ("lb", "lbf"),
    r"ounces?|oz": ("oz", "ozf"),
    r"dyn|dynes?": ("dyn",),
    r"mg|milligrams?": ("mg",),
    r"cm²|cm #|(?:square|sq) (?:cm|centimet(?:re|er)s?)": ("cm²",),
    r"in²|(?:square|sq) inch(?:es)?": ("in²",),
    r"decimillimetres": ("dmm",),
    r"centimillimetres": ("cmm",),
    r"decinewtons": ("dN",),
}
"""Units that the language model does not ask for, with the units of answers."""

_ASKED: Mapping[str, tuple[str, ...]] = {
    **_FOREIGN,
    **{spelled: (unit,) for spelled, unit in SPELLED.items()},
}
_SAID_UNIT = "|".join(_ASKED)
_COUNTED_PARTS = re.compile(
    r"(?<![\d.] )(?<!\bto )(?<!\b(?:one|two|six|ten) )(?<!\b(?:four|five|nine) )"
    r"(?<!\b(?:three|seven|eight) )\b(?P<part>tenths|hundredths|thousandths)"
    r"(?: of (?:an? |1 )?| )(?P<unit>mm\b|millimet(?:re|er)s?\b|newtons?\b|n\b)|"
    r"\b(?:mm|millimet(?:re|er)) (?P<behind>tenths|hundredths)\b|"
    r"\b(?P<joined>tenth|hundredth)[ -](?:mm\b|millimet(?:re|er)s\b)",
    re.I,
)
_PARTS: Mapping[str, tuple[str, str]] = {
    "tenth": ("decimillimetres", "decinewtons"),
    "hundredth": ("centimillimetres", "centinewtons"),
    "thousandth": ("microns", "millinewtons"),
}
"""Words for parts of a millimetre, and of a newton, that are counted as units."""
_ASKED_UNIT = re.compile(
    rf"\b(?:in|as|how many|how much) (?:(?:plain|whole|full) )?({_SAID_UNIT})(?![^ ])"
    rf"|(?<!# )(?<![^ ])(?=\w\w)({_SAID_UNIT})$"
    rf"|\b(?:convert|translate|change|turn)\b.* (?:to|into) ({_SAID_UNIT})(?![^ ])"
    rf"|^(?=\w\w)({_SAID_UNIT})(?= (?!per\b))"
)
"""A unit that is asked for: behind 'in', 'how many' or 'convert to', or the first or last word."""

_AMOUNT = re.compile(r"amount (\w+(?: (?!- )[a-z]\w*)?)( #\d \w+)? (\S+?)(?= in a |\.|;|$)")
_OF_MASSES = re.compile(r"\b(?:slips|stays|holds|mass|spare|needed)\b")


def with_counted_parts(text: str, *, as_usual: bool = False) -> str:
    """A text with one word for each unit that is a part of one: 'in tenths of a millimetre'.

    'Three tenths of a millimetre' is a number, and 'to tenths of a millimetre' rounds one.

    Args:
        text: The text.
        as_usual: Whether the usual unit of the same dimension takes the place.
    """

    def word(match: re.Match[str]) -> str:
        is_force = (match["unit"] or "m").lower().startswith("n")
        if as_usual:
            return "newtons" if is_force else "microns"
        part = (match["part"] or match["behind"] or match["joined"]).lower().removesuffix("s")
        return _PARTS[part][is_force]

    return _COUNTED_PARTS.sub(word, text)


def numbers_in_units(query: str, words: str, numbers: Sequence[float]) -> tuple[float, ...] | None:
    """A question's numbers in the units that a query gives them.

    Args:
        query: The query (``tacgrasp.lessons.dialogue.query``).
        words: The question in plain words, '#' for each number.
        numbers: Its numbers.

    Returns:
        All numbers; None where a number has a unit of something else, or one of two units, or
        where a count of things is taken for a mass.
    """
    written = _written(words)
    are_things = [bool(match["things"]) for match in _NUMBER_OF_THINGS.finditer(words)]
    if len(written) != len(numbers):  # the question has a '#' of its own
        return tuple(numbers)
    scaled = list(numbers)
    for part in query.split("; "):
        is_mass = _OF_MASSES.search(part) is not None
        for match in _GIVEN_UNIT.finditer(part):
            *named, unit = match.groups()
            places = [int(place) - 1 for place in named if place]
            is_of_things = any(are_things[at] for at in places if at < len(are_things))
            if is_of_things and unit in UNITS and UNITS[unit].dimension == "mass":
                return None
            has = {at: written[at] for at in places if at < len(written) and written[at]}
            if unit not in UNITS or not has:
                continue
            if len({UNITS[each].dimension for each in has.values()}) > 1:
                return None
            for place, each in has.items():
                if _dimension(each, is_mass=is_mass) != _dimension(unit, is_mass=is_mass):
                    return None
                number = (
                    numbers[place] * _size(each, is_mass=is_mass) / _size(unit, is_mass=is_mass)
                )
                if scaled[place] not in (numbers[place], number):
                    return None
                scaled[place] = number
    return tuple(scaled)


def in_asked_unit(query: str, words: str) -> str:
    """A query for amounts, each in the unit that the question asks for.

    Args:
        query: The query.
        words: The question in plain words.

    Returns:
        The query; '' where it is for one amount that is not to be had in the one unit asked for.
    """
    said = [next(filter(None, match.groups())) for match in _ASKED_UNIT.finditer(words)]
    named = list(dict.fromkeys(_units_of(each) for each in said))
    amounts = list(_AMOUNT.finditer(query))
    quantities = [amount[1] for amount in amounts]
    for place, amount in reversed(list(enumerate(amounts))):
        units = [
            unit for spelled in named if (unit := _unit_for(amount[1], spelled, amount[3])) != ""
        ]
        if len(units) == len(amounts) or (len(units) == 1 == quantities.count(amount[1])):
            unit = units[place] if len(units) > 1 else units[0]
            query = f"{query[: amount.start(3)]}{unit}{query[amount.end(3) :]}"
        elif not units and len(amounts) == len(named) == 1 and ";" not in query:
            return ""
    return query


def _unit_for(quantity: str, units: Sequence[str], usual: str) -> str:
    """The first of some units in which a quantity can be given, of its own dimension if any."""
    fit = [unit for unit in units if can_be_in(quantity, unit)]
    fit.sort(key=lambda unit: UNITS[unit].dimension != UNITS[usual].dimension)
    return fit[0] if fit else ""


def _units_of(spelled: str) -> tuple[str, ...]:
    return next(units for said, units in _ASKED.items() if re.fullmatch(said, spelled))


def _written(words: str) -> list[str]:
    """The unit behind each '#'; '' where none is."""
    units = tuple(SPELLED.values())
    return [
        next((unit for unit, said in zip(units, match.groups(), strict=True) if said), "")
        for match in _BEHIND_NUMBER.finditer(words)
    ]


def _dimension(unit: str, *, is_mass: bool) -> str:
    """What a unit measures; grams are a force where nothing has a mass."""
    dimension = UNITS[unit].dimension
    return "force" if dimension == "mass" and not is_mass else dimension


def _size(unit: str, *, is_mass: bool) -> float:
    size = UNITS[unit].size
    return size * GRAVITY_N_PER_G if UNITS[unit].dimension == "mass" and not is_mass else size
