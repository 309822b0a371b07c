"""The units behind a question's numbers, against those that a query gives them.

    Is x over 500 microns?          check x > #1 mm.       500 becomes 0.5
    Is 0.5 N enough for 30 g?       check stays #1 g.      impossible: 0.5 N is no mass

A query has not every unit for every quantity, and a reader may mistake which number is which.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS

_SPELLED: Mapping[str, str] = {
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
_BEHIND_NUMBER = re.compile(
    "#(?: (?:" + "|".join(f"({spelled})" for spelled in _SPELLED) + r")(?![^ ]))?"
)
_GIVEN_UNIT = re.compile(r"#(\d)(?: (?:\+-|-) #(\d))? ([^\s.;]+)")
_ONE_AMOUNT = re.compile(r"amount ([a-z_ ]+) (\S+?)( in a \w+)?\.")
_ASKED_UNIT = re.compile(rf"\b(?:in|as|how many) ({'|'.join(_SPELLED)})(?![^ ])")
_OF_MASSES = re.compile(r"\b(?:slips|stays|holds|mass|spare|needed)\b")


def numbers_in_units(query: str, words: str, numbers: Sequence[float]) -> tuple[float, ...] | None:
    """A question's numbers in the units that a query gives them.

    Args:
        query: The query (``tacgrasp.lessons.dialogue.query``).
        words: The question in plain words, '#' for each number.
        numbers: Its numbers.

    Returns:
        All numbers; None where a number has a unit of something else, or one of two units.
    """
    written = _written(words)
    if len(written) != len(numbers):  # the question has a '#' of its own
        return tuple(numbers)
    scaled = list(numbers)
    for part in query.split("; "):
        is_mass = _OF_MASSES.search(part) is not None
        for match in _GIVEN_UNIT.finditer(part):
            *named, unit = match.groups()
            places = [int(place) - 1 for place in named if place]
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


def in_asked_unit(query: str, words: str, units_of: Mapping[str, Sequence[str]]) -> str:
    """A query for one amount, in the unit that the question asks for.

    Args:
        query: The query.
        words: The question in plain words.
        units_of: Units that each amount can be asked for in.
    """
    asked = _ONE_AMOUNT.fullmatch(query)
    named = {_unit_of(match[1]) for match in _ASKED_UNIT.finditer(words)}
    if asked is None or len(named) != 1 or not named <= set(units_of.get(asked[1], ())):
        return query
    return f"amount {asked[1]} {named.pop()}{asked[3] or ''}."


def _unit_of(spelled: str) -> str:
    return next(unit for said, unit in _SPELLED.items() if re.fullmatch(said, spelled))


def _written(words: str) -> list[str]:
    """The unit behind each '#'; '' where none is."""
    units = tuple(_SPELLED.values())
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
