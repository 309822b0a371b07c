"""What people call the classes of a contact, word by word, and what may stand beside.

Not here: wordings of whole questions (``tacgrasp.lessons.dialogue.families.classes.words``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.clauses.word_sets import words_of

_SHAPES: Mapping[str, str] = {
    "disc": r"(?:flat |round |circular )*dis[ck]s?|dis[ck][ -]shaped|coins?",
    "sphere": r"spheres?|(?:round )?balls?|globes?|orbs?|spherical|ball[ -]shaped|domes?|"
    r"round(?: thing| one)?",
    "ellipsoid": r"ellipsoids?|ovals?|ellipses?|egg[ -]shaped?|ellipsoidal|elliptical|ovoids?",
    "cuboid": r"cuboids?|box(?:es)?|cubes?|blocks?|bricks?|rectang(?:le|ular)|boxy",
    "triangle": r"triang(?:les?|ular)|three[ -]sided",
    "hexagon": r"hexagon(?:s|al)?|hex|six[ -]sided",
    "peak": r"peaks?|cones?|pyramids?|spikes?|conical|cone[ -]shaped|pointed tips?|pyramidal",
    "plane": r"planes?|planar|flat (?:plane|surface|face)|flat",
    "cylinder": r"cylinders?|rods?|cylindrical|round bars?|tubes?|rod[ -]shaped",
    "ring": r"rings?|hoops?|tor(?:us|i)|annul(?:us|ar)|ring[ -]shaped|doughnuts?|donuts?",
    "crescent": r"crescents?|half moons?|sickles?|crescent[ -]shaped",
    "edge": r"edges?(?! of the pad)",
    "corner": r"corners?",
    "line": r"(?:straight |thin )?lines?(?! of)",
    "cross": r"cross(?:es)?|plus signs?|cruciform|cross[ -]shaped",
    "stripes": r"stripes?|parallel (?:bars|lines)",
    "dots": r"dots?|several bumps",
    "wave": r"waves?|wavy",
    "hole": r"holes?|cavit(?:y|ies)",
}
_TEXTURES: Mapping[str, str] = {
    "smooth": r"smooth(?:ly)?|sleek|slick",
    "rough": r"rough|coarse|grainy|gritty|scratchy",
    "ridged": r"ridged|ribbed|grooved|ridges",
    "bumpy": r"bumpy|knobbly|lumpy|pimply",
    "woven": r"woven|cloth[ -]like|fabric[ -]like|weave",
}
_DEPTHS: Mapping[str, str] = {
    "very deep": r"(?:very|extremely|really) deep(?:ly)?",
    "slight": r"slight(?:ly)?|shallow(?:ly)?",
    "moderate": r"moderate(?:ly)?(?: deep(?:ly)?)?",
    "deep": r"deep(?:ly)?",
}
_AREAS: Mapping[str, str] = {
    "tiny": r"tiny|very small", "very large": r"very (?:large|big)|huge",
    "small": r"small", "medium": r"medium(?: sized)?", "large": r"large|big",
}  # fmt: skip
_PLACES: Mapping[str, str] = {
    "centered": r"(?:well |nicely |dead |properly )?(?:centered|central)|"
    r"(?:in|at) the (?:very |dead |exact )?(?:middle|center)(?: of the (?:pad|gel|sensor))?|"
    r"dead center",
}


@dataclass(frozen=True, slots=True)
class ClassNames:
    """Names of the classes of one dimension.

    Attributes:
        dimension: The dimension.
        words: Each name as a pattern, with its class; names of more words stand first.
        known: Words that may stand beside.
        may_be_bare: Whether a name says enough alone: 'smooth', but not 'edge'.
    """

    dimension: str
    words: tuple[tuple[re.Pattern[str], str], ...]
    known: frozenset[str]
    may_be_bare: bool = True


def _names(
    dimension: str, table: Mapping[str, str], known: str, *, may_be_bare: bool = True
) -> ClassNames:
    words = tuple((re.compile(rf"\b(?:{said})\b"), name) for name, said in table.items())
    beside = words_of(f"{known} or nor either neither felt feel feels feeling")
    return ClassNames(dimension, words, beside, may_be_bare)


NAMED = (
    _names(
        "texture", _TEXTURES,
        "surface texture finish skin touch outside face relief pattern surfaced textured contact "
        "touched pressed grain to",
    ),
    _names("position", _PLACES, "contact patch pad gel sensor placed located position spot touch"),
    _names(
        "depth", _DEPTHS,
        "press pressed pressing indentation indent indented dent dented penetration depth sunk "
        "pushed "
        "contact gel pad imprint impression",
    ),
    _names(
        "area", _AREAS, "area contact patch footprint coverage spot imprint print covered touched",
        may_be_bare=False,
    ),
    _names(
        "shape", _SHAPES,
        "shape shaped form figure outline kind sort thing geometry gripped gripping held holding "
        "touched touching pressed pressing grip grasp something what have facing face contact "
        "local "
        "profile",
        may_be_bare=False,
    ),
)  # fmt: skip
"""Names of each dimension; textures first, of which one word says enough."""


def is_class_named(words: str) -> bool:
    """Whether a word of some plain words names a class: 'is the red one round'."""
    return any(
        pattern.fullmatch(word)
        for word in words.split()
        for names in NAMED
        for pattern, _ in names.words
    )
