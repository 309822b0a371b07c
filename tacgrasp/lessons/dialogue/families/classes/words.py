"""What people call the classes of a contact: nouns, adjectives and places, as patterns.

Each table goes from a class to what it is called. Not here: the questions
(``tacgrasp.lessons.dialogue.families.classes.asked``).
"""

from __future__ import annotations

from collections.abc import Mapping

from cltp.tactile.states import CLASSES

Words = Mapping[str, str]
"""From a class to the pattern of its names."""

SHAPE_NOUNS: Words = {
    "sphere": (
        "(a sphere|a ball|a ball|a round ball|something spherical|"
        "a spherical (shape|surface|thing|cap))"
    ),
    "ellipsoid": "(an ellipsoid|an oval|an ellipse|an egg shape|an ellipsoidal (shape|thing))",
    "cuboid": "(a cuboid|a box|a box|a cube|a block|a rectangle|a cuboid block|a box shape)",
    "triangle": "(a triangle|a triangular (shape|thing|face))",
    "hexagon": "(a hexagon|a hexagonal (shape|thing|face))",
    "disc": "(a disc|a disk|a round disc|a flat disc|a circular disc|a flat circle)",
    "peak": (
        "(a peak|a sharp peak|a cone|a point|a pyramid|a spike|a pointed tip|a sharp tip|"
        "a pyramid tip)"
    ),
    "plane": "(a plane|a flat plane|a flat surface|a flat face|a wide flat surface)",
    "cylinder": "(a cylinder|a rod|a rod|a round bar|the side of a cylinder|a cylindrical shape)",
    "ring": "(a ring|a hoop|a torus|a ring shape|an annulus)",
    "crescent": "(a crescent|a half moon|a sickle shape|a crescent shape)",
    "edge": "(an edge|a straight edge|a sharp edge|the edge of something)",
    "corner": "(a corner|a sharp corner|the corner of (something|a box|a cube))",
    "line": "(a line|a straight line|a thin line|a narrow bar|a thin bar)",
    "cross": "(a cross|a plus sign|two crossing bars|a cross shape)",
    "stripes": "(stripes|parallel stripes|parallel bars|parallel lines|several stripes)",
    "dots": "(dots|several dots|a group of dots|a pattern of dots|separate dots)",
    "wave": "(a wave|a wave shape|a wavy surface|waves)",
    "hole": "(a hole|a flat surface with a hole|a cavity|a hole in a surface)",
}
"""With their articles: 'it is ...', 'it feels like ...'."""

SHAPE_ADJECTIVES: Words = {
    "sphere": "(spherical|round|ball-shaped|round like a ball|ball-like|sphere-shaped)",
    "ellipsoid": "(ellipsoidal|oval|egg-shaped|elliptical)",
    "cuboid": "(cuboid|rectangular|box-shaped|boxy|brick-shaped|block-shaped)",
    "triangle": "(triangular|three-sided|triangle-shaped)",
    "hexagon": "(hexagonal|six-sided|hexagon-shaped)",
    "disc": "(disc-shaped|disk-shaped|disc-like|coin-shaped)",
    "peak": "(conical|cone-shaped|spiky)",
    "plane": "(planar|flat|flat|completely flat)",
    "cylinder": "(cylindrical|rod-shaped|rod-like|cylinder-shaped)",
    "ring": "(ring-shaped|annular|ring-like|doughnut-shaped)",
    "crescent": "(crescent-shaped|sickle-shaped|moon-shaped)",
    "line": "(line-shaped|line-like)",
    "cross": "(cross-shaped|cruciform|cross-like)",
    "wave": "(wavy|wave-shaped|wave-like)",
}
"""Of the shapes that have one."""

BARE_SHAPES: Words = {word: word for word in CLASSES["shape"]} | {
    "sphere": "(sphere|ball|ball)",
    "ellipsoid": "(ellipsoid|oval|ellipse)",
    "cuboid": "(cuboid|box|block|cube)",
    "disc": "(disc|disk)",
    "peak": "(peak|cone|spike)",
    "cylinder": "(cylinder|rod|rod)",
    "wave": "(wave|waves)",
}
"""Without articles, as people say who are short of time."""

SHAPES_OF_MANY: Words = {
    "stripes": "(stripes|bars|parallel bars|parallel lines)",
    "dots": "(dots|small dots|separate dots)",
}
"""'Are these ...'."""

TEXTURES: Words = {
    "smooth": "(smooth|smooth|smooth|sleek)",
    "rough": "(rough|rough|rough|coarse|grainy|gritty)",
    "ridged": "(ridged|ridged|ribbed|grooved)",
    "bumpy": "(bumpy|bumpy|knobbly|lumpy)",
    "woven": "(woven|woven|cloth-like|fabric-like)",
}
"""'It is ...', 'a ... surface'."""

TEXTURE_LIKENESSES: Words = {
    "smooth": "(like glass|as smooth as glass|like something smooth)",
    "rough": "(like sandpaper|as rough as sandpaper|like something rough)",
    "ridged": "(like it has ridges|like corduroy|like something ridged)",
    "bumpy": "(like it has bumps|like something bumpy)",
    "woven": "(like cloth|like fabric|like a weave|like something woven)",
}
"""'It feels ...'."""

RELIEFS: Words = {
    "rough": "(roughness|rough spots|a rough surface|a rough texture)",
    "ridged": "(ridges|ridges|grooves|ribs|fine ridges|a ridged surface)",
    "bumpy": "(bumps|bumps|little bumps|small bumps|knobs|a bumpy surface)",
    "woven": "(a weave|a weave pattern|a woven pattern|a woven surface|woven threads)",
    "smooth": "(a smooth surface|a smooth skin|a smooth finish)",
}
"""'It has ...'."""

RELIEFS_OF_MANY: Words = {
    "rough": "(rough spots|rough patches|coarse grains)",
    "ridged": "(ridges|ridges|grooves|ribs|fine ridges|parallel ridges)",
    "bumpy": "(bumps|bumps|little bumps|small bumps|knobs)",
    "woven": "(woven threads|crossing threads|woven fibres)",
}
"""'There are ...', 'any ...'."""

DEPTHS: Words = {
    "slight": "(slight|slight|shallow|only slight|just slight)",
    "moderate": "(moderate|moderate|moderately deep|of moderate depth|medium deep)",
    "deep": "(deep|deep|a deep one)",
    "very deep": "(very deep|very deep|extremely deep)",
}
"""'It is ...'."""

DENTS: Words = {
    "slight": "(a|only a|just a) (slight|shallow)",
    "moderate": "a (moderate|moderately deep)",
    "deep": "a deep",
    "very deep": "a very deep",
}
"""'It is ... dent'."""

DEEPLY: Words = {
    "slight": "(slightly|only slightly|just slightly|a little|just a little|only a little)",
    "moderate": "(moderately|moderately deep|moderately deeply)",
    "deep": "(deeply|deep)",
    "very deep": "(very deeply|very deep)",
}
"""'It is pressed in ...'."""

BARELY: Words = {
    "slight": "(slightly|barely|hardly|only slightly|just barely|only just)",
    "moderate": "moderately",
    "deep": "deeply",
    "very deep": "(very deeply|extremely deeply)",
}
"""'It is ... pressed in'."""

PLAIN_DEPTHS: Words = {
    "slight": "(slight|shallow)",
    "moderate": "moderate",
    "deep": "deep",
    "very deep": "very deep",
}
"""To choose from."""

AREAS: Words = {
    "tiny": "(tiny|tiny|very small)",
    "small": "(small|small|rather small)",
    "medium": "(medium|medium|medium-sized|of medium size)",
    "large": "(large|large|big)",
    "very large": "(very large|very large|very big|huge)",
}
"""'The patch is ...'."""

PATCHES: Words = {
    "tiny": "(a|only a|just a) (tiny|very small)",
    "small": "(a|only a|just a) small",
    "medium": "a (medium|medium-sized)",
    "large": "a (large|big)",
    "very large": "a (very large|very big|huge)",
}
"""'It is ... patch'."""

PLAIN_AREAS: Words = {
    "tiny": "tiny",
    "small": "small",
    "medium": "medium",
    "large": "(large|big)",
    "very large": "(very large|very big)",
}
"""To choose from."""

_SIDES = {"top": "(top|upper)", "bottom": "(bottom|lower)"}
_PART = "(part|cell|area|region|field|zone)"
_OF_PAD = "[of the (pad|gel|sensor|finger|fingertip|skin|tip|sensing area)]"


def _spot(word: str) -> str:
    """A place with its article. What ends in 'middle right' would be read as 'middle, right?'."""
    if word == "centered":
        return (
            f"(the center {_OF_PAD}|the middle {_OF_PAD}|the (very|dead|exact) (center|middle)|"
            f"the (central|middle) (part|cell|area|region|zone) {_OF_PAD})"
        )
    row, _, column = word.partition("-")
    if row == "middle":
        return (
            f"(the (middle|center|central) {column} {_PART} {_OF_PAD}|the {column} (middle|center)|"
            f"the middle of the {column} (side|column|edge))"
        )
    if column == "center":
        return (
            f"(the {_SIDES[row]} (center|middle) [{_PART}] {_OF_PAD}|"
            f"the middle of the {_SIDES[row]} (row|part|edge))"
        )
    return (
        f"(the {_SIDES[row]} {column} {_OF_PAD}|the {_SIDES[row]} {column} corner {_OF_PAD}|"
        f"the {_SIDES[row]} {column} {_PART} {_OF_PAD}|the {column} {_SIDES[row]} corner|"
        f"the {_SIDES[row]} {column}-hand corner)"
    )


def _bare_spot(word: str) -> str:
    if word == "centered":
        return "(center|middle|dead center|centered|central)"
    row, _, column = word.partition("-")
    if row == "middle":
        return f"middle {column} {_PART}"
    middle = "(center|middle)" if column == "center" else f"{column} [corner|part|cell]"
    return f"{_SIDES[row]} {middle}"


def _place(word: str) -> str:
    said = f"(in|in|at|on) {_spot(word)}"
    if word == "centered":
        said += (
            "|centered|well centered|central|dead center|right in the middle|dead in the middle|"
            "bang in the middle|spot on center|"
            "in the middle|in the center|properly centered|perfectly centered"
        )
    elif word.startswith("middle"):
        side = word.removeprefix("middle-")
        said += f"|on the {side} at (half|middle) height|halfway up the {side} side"
    elif word.endswith("center"):
        row = word.removesuffix("-center")
        said += f"|at the {row} in the (middle|center)|{row} (center|middle)"
    else:
        row, _, column = word.partition("-")
        up = {"top": "up", "bottom": "down"}[row]
        said += f"|at the {row} on the {column}|{up} on the {column}|{row} {column}|near the {row} {column}"
    return f"({said})"


SPOTS: Words = {word: _spot(word) for word in CLASSES["position"]}
"""'It touches ...'."""

BARE_SPOTS: Words = {word: _bare_spot(word) for word in CLASSES["position"]}
"""Without articles."""

PLACES: Words = {word: _place(word) for word in CLASSES["position"]}
"""'It is ...'."""

ASIDE: Words = {
    "centered": (
        "(off center|off-center|off the center|out of the (center|middle)|outside the (center|"
        "middle)|"
        "away from the (center|middle)|out of center|not quite centered|to one side of the middle)"
    )
}
"""What is not in the middle."""

MISSED: Words = {"centered": "the (center|middle) [of the (pad|gel|sensor)]"}
"""'We missed ...'."""
