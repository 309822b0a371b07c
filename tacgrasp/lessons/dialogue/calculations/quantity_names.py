"""Names of quantities and units in plain words, as patterns.

Not here: what is made of them (``tacgrasp.lessons.dialogue.calculations.terms``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tacgrasp.lessons.dialogue.written_units import SPELLED

_THING = (
    r"(?:object|thing|berry|strawberry|fruit|item|part|piece|egg|tomato|peg|load|body|specimen|"
    r"sample|product|article|workpiece|good|goods)"
)
_OF_THING = rf"(?: of (?:the |this |that |our )?{_THING})"
_BAND_NAME = (
    r"(?:(?:target|wanted|goal|force|desired|requested|required|agreed|intended|set|permitted|"
    r"allowed|given|specified|aimed at|asked for) )*(?:band|range|window|corridor|interval|goal|"
    r"target)"
)
_LOW = r"(?:lower|lowest|low|bottom|minimum|least|min)"
_HIGH = r"(?:upper|highest|high|top|maximum|most|max)"
_END = r"(?:end|edge|bound|boundary|border|limit|side|rim|value|force|threshold|point|mark|part)"
_MIDDLE = r"(?:middle|midpoint|mid point|center|mid|mean|average)"
_ON = (
    r"(?: (?:on|against|at|in|onto|upon|of) (?:the )?(?:pad|gel|sensor|object|contact|finger|grip|"
    r"skin))?"
)


def _ends(which: str) -> str:
    """Names of one end of the band."""
    return (
        rf"{which}(?: {_END})? (?:of|in) (?:the |our )?{_BAND_NAME}|"
        rf"{_BAND_NAME}(?:'s)? {which}(?: {_END})?|{which} {_BAND_NAME} {_END}|"
        rf"{which} (?:wanted|requested|desired|required) force|{which} force (?:wanted|requested)"
    )


_NAMED: Mapping[str, tuple[str, str]] = {
    rf"(?:normal |contact |grip |gripping |grasp |pressing |squeezing |pinch |clamping )*(?:force|"
    rf"squeeze|push|pressure|grip|pinch|press){_ON}|(?:grip|force) strength|"
    r"(?:force |what )?(?:that )?(?:you|we) (?:feel|press|apply|measure)(?: with)?|force felt": (
        "force_n", "force",
    ),
    r"(?:force |permitted |allowed |permissible |hard |upper |safety |maximum |"
    r"never exceed )*(?:limit|ceiling|cap)(?: force)?|"
    r"(?:permitted|allowed|permissible) (?:maximum|max)(?: force)?|"
    r"maximum (?:permitted|allowed|permissible) force|maximum force (?:permitted|allowed)|"
    r"never exceed (?:force|value|line)": (
        "limit_n", "force",
    ),
    _ends(_LOW): ("band_low_n", "force"),
    _ends(_HIGH): ("band_high_n", "force"),
    rf"{_MIDDLE} of (?:the |our )?{_BAND_NAME}|{_BAND_NAME}(?:'s)? {_MIDDLE}": (
        "(band_low_n + band_high_n) / 2", "force",
    ),
    rf"(?:width|span|breadth) of (?:the |our )?{_BAND_NAME}|{_BAND_NAME}(?:'s)? (?:width|span)": (
        "band_high_n - band_low_n", "force",
    ),
    rf"(?:maximum |peak |contact |indentation |penetration |imprint |greatest |deepest )*(?:depth|"
    rf"indentation|dent|penetration|imprint)(?: of (?:the )?(?:contact|dent|press|"
    rf"indentation|imprint|{_THING}))?": ("depth_mm", "length"),
    r"(?:contact |touched |covered |pressed |touching )*(?:area|patch|footprint|"
    r"coverage)(?: (?:size|percentage|share))?(?: of (?:the )?contact)?|"
    r"(?:touched|covered|pressed) (?:share|part|portion|fraction|percentage)(?: of (?:the )?pad)?|"
    r"(?:share|part|portion|fraction|percentage) of (?:the )?pad (?:that is )?"
    r"(?:touched|covered|pressed)": ("area_percent", "fraction"),
    r"(?:free|untouched|uncovered) (?:part|share|portion|area|rest)(?: of (?:the )?pad)?": (
        "100 - area_percent", "fraction",
    ),
    r"x(?: (?:offset|coordinate|value|position|component|displacement))?|(?:horizontal|sideways|"
    r"lateral) (?:offset|position|displacement|coordinate)|contact's x": ("x_mm", "length"),
    r"y(?: (?:offset|coordinate|value|position|component|displacement))?|(?:vertical|lengthwise) "
    r"(?:offset|position|displacement|coordinate)|contact's y": ("y_mm", "length"),
    rf"(?:radial )?(?:distance|offset)(?: of (?:the )?(?:contact|{_THING}))? (?:from|to) "
    r"(?:the )?(?:pad )?(?:middle|center)(?: of (?:the )?pad)?": ("hypot(x_mm, y_mm)", "length"),
    rf"(?:stated |told )?mass{_OF_THING}?|{_THING}(?:'s)?(?: own)? mass": ("mass_g", "mass"),
    r"(?:payload|carrying capacity|holding capacity|heaviest load|load it holds)": (
        "holds_g", "mass",
    ),
    r"(?:whole |full |entire )?(?:pad|sensing area)|(?:full|complete|total) coverage": (
        "100", "fraction",
    ),
    r"(?:needed|required|necessary) force|force (?:that is )?(?:needed|required)(?: to hold it)?": (
        "gram_n * mass_g", "force",
    ),
}  # fmt: skip
NAMED = [(re.compile(pattern), *meant) for pattern, meant in _NAMED.items()]
"""Names of a quantity without its article, its expression, and the dimension of its unit."""

WEIGHT = re.compile(rf"(?:own )?weight{_OF_THING}?|{_THING}(?:'s)?(?: own)? weight")
"""Names of the mass that are asked for in newtons too."""

_BAND = re.compile(rf"(?:(?:the|our|this|whole|entire) )*{_BAND_NAME}")

_UNIT_WORDS: Mapping[str, str] = {**SPELLED, r"percentage points?|points?": "%"}
UNIT = "|".join(_UNIT_WORDS)
"""Words of the units that a calculation may be in."""


def is_band(words: str) -> bool:
    """Whether a noun phrase is the band itself, whose nearer end counts above and below it."""
    return _BAND.fullmatch(words) is not None


def unit_of(words: str) -> str:
    """The unit that plain words name."""
    return next(unit for said, unit in _UNIT_WORDS.items() if re.fullmatch(said, words))
