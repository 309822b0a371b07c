"""Words for shapes and textures: those of the classes, their synonyms, and those that are no class.

    sphere, ball, dome       the class 'sphere'
    circle                   'disc' or 'ring'
    star, pentagon           no class: nothing that is felt is called so

Not here: what the grammar calls the classes (``tacgrasp.lessons.dialogue.families.classes.words``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from tacgrasp.lessons.dialogue.families.classes import words
from tacgrasp.lessons.dialogue.patterns.pattern import (
    Chain,
    Literal,
    Node,
    OneOf,
    compile_pattern,
)
from tacgrasp.lessons.dialogue.plain_words import plain_words


class Named(NamedTuple):
    """What a word for a shape or a texture names.

    Attributes:
        dimension: 'shape' or 'texture'.
        classes: Classes that a person would call so, or the word itself where none is.
    """

    dimension: str
    classes: tuple[str, ...]


_OTHER_SHAPES: Mapping[str, str] = {
    "sphere": "orb|dome|domed|hemisphere|half sphere|half ball|spherical cap|rounded cap",
    "ellipsoid": "egg like|oval cap|oval shape|spheroid|elongated dome",
    "cuboid": "square|squared|squarish|cube|cubic|cubical|rectangular block|oblong|"
    "square shaped|cube shaped|rectangle shaped|square block|square face|square end",
    "triangle": "triangular block|triangular prism|three sided shape",
    "hexagon": "hexagonal block|hex|six sided shape|hex shape",
    "disc": "flat round end|round flat face|flat round face|disk shape|disc shape",
    "peak": "cone|cone tip|tip of a cone|pyramid|pyramidal|pyramid tip|pyramid shaped|spike|"
    "pointy|pointed|pointy tip|pointed shape|conical tip|cone shape|pyramid shape|"
    "tip of a pyramid|spiked",
    "plane": "flat plate|level surface|flat sheet",
    "cylinder": "tubular|round rod|cylinder shape|side of a rod|rod shape|tube shaped",
    "ring": "torus|toroid|toroidal|doughnut shape|donut shape|donut shaped|donut|doughnut|"
    "annular shape|round rim|torus shaped",
    "crescent": "moon shape|half ring|crescent moon|arc|part of a ring",
    "line": "thin ridge|single line|narrow line",
    "cross": "plus shape|plus shaped|x shape|x shaped|crossed bars",
    "wave": "ripple|ripples|rippled|undulating|undulation|undulations|waviness",
    "hole": "hollow|socket|recess",
}
"""Beside the grammar's words, as plain words without an article."""

_OTHER_TEXTURES: Mapping[str, str] = {
    "smooth": "polished|glassy|silky|slick|mirror like|satin",
    "rough": "coarse|grainy|gritty|sandy|sandpapery|scratchy|grained|granular|coarse grained|"
    "roughened|abrasive",
    "ridged": "striped|stripy|stripey|lined|furrowed|fluted|corrugated|ribbed|grooved|"
    "finely grooved|ridge|groove|rib|ribbing|fluting|furrows|corrugations|corrugation",
    "bumpy": "dotted|pimpled|pimply|pebbled|pebbly|nubby|studded|knobby|knobbed|"
    "nubbly|dimpled|pimples|nubs|studs|bump|knob|nodules|polka dotted",
    "woven": "cross ribbed|knitted|knit|meshed|mesh|cross hatched|crosshatched|checkered|"
    "chequered|checkerboard|weave|grid like|gridded|latticed",
}

_NO_SHAPES = (
    r"(?:(?:five|six|seven|eight|four|\#) pointed )?stars?(?: shaped?)?|star like|hearts?|heart "
    r"shaped?|pentagons?|pentagonal|five sided|heptagons?|octagons?|octagonal|eight sided|"
    r"decagons?|nonagons?|polygons?|rhombus|rhombuses|rhombic|rhomboid|diamond(?: shaped?)?|"
    r"lozenges?|trapez(?:oid|ium)s?|trapezoidal|parallelograms?|kite(?: shaped?)?|"
    r"arrow(?: shaped?)?|arrowhead|spirals?|helix|helical|zigzags?|zig zag|chevrons?|"
    r"tetrahedr(?:on|al)|octahedr(?:on|al)|dodecahedr(?:on|al)|icosahedr(?:on|al)|prism|wedge|"
    r"saddle shaped?|teardrops?|(?:tear )?drop shaped?|crown shaped?|clover(?:leaf)?|flower "
    r"shaped?|semicircles?|"
    r"semicircular|half circle|quarter circle|gear shaped?|cogwheel|(?:[a-w]|z) shaped?|"
    r"bowl shaped?|cup shaped?|frustum|horseshoe(?: shaped?)?|figure eight|infinity sign|"
    r"mushroom shaped?|hourglass(?: shaped?)?|bow tie|fork shaped?|hook shaped?|stair shaped?|"
    r"staircase|quadrilateral|concave"
)
_NO_TEXTURES = (
    r"scaly|wrinkled|wrinkly|wrinkles|cracked|cracks|porous|pores|pitted|pockmarked|"
    r"checker plate|honeycomb(?:ed)?|feathery|flaky|jagged|serrated|barbed|thorny|"
    r"zigzagged|swirly|swirls|spiky all over|creased|crinkled|crumpled"
)
_SEVERAL: Mapping[str, tuple[Named, ...]] = {
    "circle": (Named("shape", ("disc", "ring")),),
    "circular": (Named("shape", ("disc", "ring", "sphere")),),
    "flat circle": (Named("shape", ("disc",)),),
    "stripe": (Named("texture", ("ridged",)), Named("shape", ("stripes",))),
    "stripes": (Named("texture", ("ridged",)), Named("shape", ("stripes",))),
    "lines": (Named("texture", ("ridged",)), Named("shape", ("stripes",))),
    "dot": (Named("texture", ("bumpy",)), Named("shape", ("dots",))),
    "dots": (Named("texture", ("bumpy",)), Named("shape", ("dots",))),
    "polka dots": (Named("texture", ("bumpy",)), Named("shape", ("dots",))),
}
"""What several classes, or a texture and a shape, may be called."""

_NOUN = re.compile(
    r"\b(?:sphere|ball|dome|ellipsoid|oval|ellipse|cuboid|box|cube|block|square|rectangle|triangle|"
    r"hexagon|disc|disk|cone|peak|spike|pyramid|cylinder|rod|ring|hoop|crescent|edge|corner|cross|"
    r"wave|hole|ridge|groove|bump)$"
)
"""Words that have a plural."""

_ARTICLE = re.compile(r"^(?:an?|the) ")
_FOREIGN = tuple(
    (dimension, re.compile(pattern))
    for dimension, pattern in (("shape", _NO_SHAPES), ("texture", _NO_TEXTURES))
)


def named(word: str) -> tuple[Named, ...]:
    """What some plain words without an article name; nothing where they name no such thing."""
    if known := _known().get(word):
        return known
    for dimension, pattern in _FOREIGN:
        if pattern.fullmatch(word):
            return (Named(dimension, (word.removesuffix(" shaped").removesuffix(" shape"),)),)
    return ()


@lru_cache(maxsize=1)
def words_pattern() -> re.Pattern[str]:
    """Words that ``named`` knows, the longest first, with their article; group 1 is the word."""
    known = "|".join(map(re.escape, sorted(_known(), key=len, reverse=True)))
    return re.compile(
        rf"\b(?:(?:an?|the|no|any|some) )?({known}|{_NO_SHAPES}|{_NO_TEXTURES})(?![\w'])"
    )


def is_of_the_grammar(word: str) -> bool:
    """Whether the grammar itself has some plain words as a name of a class."""
    return word in _of_the_grammar()


@lru_cache(maxsize=1)
def _of_the_grammar() -> Mapping[str, tuple[Named, ...]]:
    tables = (
        ("shape", words.SHAPE_NOUNS),
        ("shape", words.SHAPE_ADJECTIVES),
        ("shape", words.BARE_SHAPES),
        ("shape", words.SHAPES_OF_MANY),
        ("texture", words.TEXTURES),
        ("texture", words.RELIEFS),
        ("texture", words.RELIEFS_OF_MANY),
    )
    found: dict[str, tuple[Named, ...]] = {}
    for dimension, table in tables:
        for each, pattern in table.items():
            for said in _expanded(compile_pattern(pattern, {}, {})):
                plain = _ARTICLE.sub("", " ".join(plain_words(said)))
                found.setdefault(plain, (Named(dimension, (each,)),))
    return found


@lru_cache(maxsize=1)
def _known() -> Mapping[str, tuple[Named, ...]]:
    added = {
        said: (Named(dimension, (each,)),)
        for dimension, table in (("shape", _OTHER_SHAPES), ("texture", _OTHER_TEXTURES))
        for each, listed in table.items()
        for said in listed.split("|")
    }
    known = {**added, **_of_the_grammar()}
    plurals = {
        f"{said}{'es' if said[-1] in 'xs' else 's'}": names
        for said, names in known.items()
        if _NOUN.search(said)
    }
    return {**plurals, **known, **_SEVERAL}


def _expanded(node: Node) -> Iterator[str]:
    """All texts that a pattern without slots produces."""
    match node:
        case Literal(text):
            yield text
        case Chain(parts):
            for each in product(*(tuple(_expanded(part)) for part in parts)):
                yield " ".join(filter(None, each))
        case OneOf(parts, optional):
            if optional:
                yield ""
            for part in parts:
                yield from _expanded(part)
