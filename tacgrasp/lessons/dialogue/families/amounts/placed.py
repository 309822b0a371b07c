"""Families that ask where something presses, in numbers: coordinates and distances."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.amounts.wordings import (
    CLOSING,
    FIND,
    GET,
    OPENING,
    UNIT_WORDS,
    AmountWording,
    Asked,
    amount_family,
    amount_slots,
)
from tacgrasp.lessons.dialogue.meaning import Amount, Several
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily

_MIDDLE = (
    "(the (center|center|middle|middle|midpoint|center point|mid point|exact center) [of {gel}]|"
    "(center|dead center))"
)
_TARGET = (
    "({thing}|{touch}|the (contact|touch) point|the (contact|imprint|touch)|"
    "the (center|middle) of the (contact|touch|imprint))"
)


def _coordinate(axis: str, way: str, sides: str) -> AmountWording:
    """Wordings for a coordinate.

    Args:
        axis: 'x' or 'y'.
        way: The adjectives of this direction.
        sides: Both directions along the axis, as adverbs.
    """
    plus = (
        "((right|up|palm side|rightward|rightwards|to the right|towards the palm) (counts as|is|being|as|counted as|counting as|"
        "taken as|counted) (plus|positive)|positive (to|towards) the right|right positive|"
        "(left|down|tip side|leftward|to the left|towards the tip) (counts as|is|being|as|counted as|counting as|taken as) (minus|negative)|"
        "a (negative|minus) number (meaning|means|for) left|minus for left)"
    )
    signed = f"({plus}|signed|with [its] sign)"
    along = (
        f"(along {axis}|along the {axis} axis|in {axis}|in the {axis} direction|on the {axis} axis|"
        f"along the {way} axis)"
    )
    name = (
        f"{axis} [coordinate|position|value|location|reading|component|place]|{way} (position|"
        f"coordinate|location)|{axis} of {{touch}}"
    )
    return AmountWording(
        asked=(
            Asked("what", f"is {axis}", f"{axis} is"),
            Asked("what", f"is the ({name}) [of {_TARGET}]", f"the ({name}) [of {_TARGET}] is"),
            Asked(f"how far ({sides})", f"is {_TARGET}|are we", f"{_TARGET} is|we are"),
            Asked(
                f"how far ({sides})",
                "does {thing} (lie|sit|touch|press|rest)|did {thing} land|did we (touch|"
                "hit) {thing}",
                "{thing} (lies|sits|touches|presses|rests|landed)|we touched {thing}",
            ),
            Asked(f"how far {along}", f"is {_TARGET}|are we", f"{_TARGET} is|we are"),
            Asked(
                "what",
                f"is the [signed] {way} (position|offset|shift|displacement|deviation|coordinate) [of {_TARGET}] "
                f"[from {_MIDDLE}|relative to {_MIDDLE}] , {plus} [,]|is the signed {way} (offset|shift|displacement|"
                f"deviation) [of {_TARGET}] [from {_MIDDLE}|relative to {_MIDDLE}]|{way} (shift|offset|displacement) "
                f"does {_TARGET} have , {plus} [,]",
                f"the [signed] {way} (position|offset|shift|displacement) [of {_TARGET}] is , {plus} [,]",
            ),
            Asked(
                f"how far ({sides}|{along}|across the pad) , {plus} [,]",
                f"is {_TARGET}|does {_TARGET} lie [from {_MIDDLE}]",
                f"{_TARGET} (is|lies) [from {_MIDDLE}]",
            ),
            Asked(
                "by how much",
                f"is {_TARGET} (off|shifted|displaced) {along} , {plus} [,]",
                f"{_TARGET} is (off|shifted|displaced) {along} , {plus} [,]",
            ),
            Asked(
                f"(at|on) (what|which) {axis} [coordinate|value|position]",
                f"is {_TARGET}|does {{thing}} (lie|sit|touch|press|rest)|do you feel {{thing}}|"
                f"are we",
                f"{_TARGET} is|{{thing}} (lies|sits|touches|presses|rests)|you feel {{thing}}|"
                f"we are",
            ),
            Asked(
                f"(what|which) {axis} [coordinate|value|position|reading]",
                f"do you (read|measure|get|have|feel|see)|does {_TARGET} have|is it|"
                f"does the sensor (show|read|give)|did you (get|measure)",
                f"you (read|measure|get|have|see)|{_TARGET} has|it is|the sensor (shows|reads)",
            ),
            Asked(
                f"where {along}",
                f"is {_TARGET}|does {{thing}} (lie|sit|touch|press)|do you feel {{thing}}",
                f"{_TARGET} is|{{thing}} (lies|sits|touches|presses)|you feel {{thing}}",
            ),
        ),
        counted=(
            Asked(
                f"how many {{unit}} ({sides}|{along})",
                f"is {_TARGET}|does {{thing}} (lie|sit)|are we",
                f"{_TARGET} is|{{thing}} (lies|sits)|we are",
            ),
        ),
        nouns=(
            f"the ({axis} [coordinate|position|value|location|reading|component]) [of {_TARGET}]|"
            f"{axis}|{axis} [coordinate|position|value] of {_TARGET}|the {way} (position|"
            f"coordinate|location) [of {_TARGET}]|the (position|coordinate|"
            f"location) [of {_TARGET}] {along}|your {axis}|its {axis} "
            f"[coordinate|position|value]|the signed {way} (offset|shift|displacement|deviation|position) [of {_TARGET}]|"
            f"the {way} (offset|shift|displacement|deviation|position) [of {_TARGET}] [relative to {_MIDDLE}|from {_MIDDLE}] , {plus} [,]|"
            "the signed offset " + along
        ),
        bare=(
            f"{axis}|{axis}|{axis} coordinate|{axis} position|{axis} value|{axis} location|"
            f"{way} (position|coordinate)|contact {axis}|{axis} of (the|this) contact|"
            f"position (along|in) {axis}|{axis} of (it|{{thing}})|coordinate {axis}|{axis} pos|"
            f"signed {way} (displacement|offset|position|shift|deviation) [, {signed}]|{way} (displacement|"
            f"offset|shift) (with [its] sign|, {signed})|{axis} , {signed}"
        ),
        terse=f"{{unit}} ({sides}|{along})|{axis} {{unit}}",
        others=(
            f"{{thing}} (is|sits|lies) at (what|which) {axis}|{axis} is (what|how much)|how (large|"
            f"big|great) is (the [value of] {axis}|{axis}) [of {_TARGET}]|{axis} equals (what|"
            f"how much)"
        ),
    )


_X = _coordinate(
    "x",
    "(horizontal|left-right|sideways|lateral)",
    "left or right|to the left or right|to the left or to the right|left or right of the middle|"
    "left or right of center|right of (the middle|the center|center)|left of (the middle|the center|center)|to the left|to the right|over to the left or right|left|right",
)
_Y = _coordinate(
    "y",
    "(vertical|up-down|lengthwise)",
    "up or down|up|down|above or below the middle|above or below center|towards the palm|"
    "towards the (fingertip|tip)|towards the palm or the (fingertip|tip)|up towards the palm|"
    "above the middle|below the middle|down towards the tip|higher or lower than the middle",
)


def _midline(line: str, sideways: str, adjective: str, extra: str) -> AmountWording:
    """Wordings for the distance from a midline.

    Args:
        line: The line, without its article.
        sideways: Adverbs of the direction across it.
        adjective: Adjectives of that direction.
        extra: More adverbs, after which no 'off' is needed.
    """
    line = f"(the|our) {line}"
    off = f"(off {_MIDDLE}|off|away from {_MIDDLE}|from {_MIDDLE}|out of {_MIDDLE}|off the mark)"
    name = f"{adjective} (distance|offset|deviation|error|displacement|miss|shift|misalignment)"
    of_middle = f"[from {_MIDDLE}|to {_MIDDLE}|of {_TARGET}]"
    return AmountWording(
        asked=(
            Asked(
                "how (far|far|close|near)",
                f"is {_TARGET} (from|to|away from) {line}|are we (from|to) {line}",
                f"{_TARGET} is (from|to|away from) {line}|we are (from|to) {line}",
            ),
            Asked(
                f"how far (from|away from|off) {line}",
                f"is {_TARGET}|are we",
                f"{_TARGET} is|we are",
            ),
            Asked(
                "how (far|much|badly)",
                f"is {_TARGET} {off} ({sideways})|are we {off} ({sideways})",
                f"{_TARGET} is {off} ({sideways})|we are {off} ({sideways})",
            ),
            Asked(
                f"how (far|much) {off} ({sideways})", f"is {_TARGET}|are we", f"{_TARGET} is|we are"
            ),
            Asked(f"how far ({extra})", f"is {_TARGET}|are we", f"{_TARGET} is|we are"),
            Asked(
                "(by how much|how far)",
                f"(did|do) we miss ({_MIDDLE} ({sideways})|{line})",
                f"we (missed|miss) ({_MIDDLE} ({sideways})|{line})",
            ),
            Asked(
                "what",
                f"is the (distance (from|to) {line}|{name} {of_middle})",
                f"the (distance (from|to) {line}|{name} {of_middle}) is",
            ),
            Asked(
                "(what|which) distance",
                f"(is|lies) {_TARGET} from {line}|is there (to|from) {line}|"
                f"does {{thing}} have (to|from) {line}",
                f"{_TARGET} (is|lies) from {line}|there is to {line}|{{thing}} has from {line}",
            ),
        ),
        counted=(
            Asked(
                "how many {unit}",
                f"(from {line}|{off} ({sideways})|{extra}) (is {_TARGET}|are we)|"
                f"is {_TARGET} (from {line}|{off} ({sideways}))|are we off ({sideways})",
                f"{_TARGET} is (from {line}|{off} ({sideways}))|we are off ({sideways})",
            ),
        ),
        nouns=(
            f"the (distance|gap|deviation|offset) [of {_TARGET}] (from|to) {line}|"
            f"the {name} {of_middle}|the distance between {_TARGET} and {line}|the (distance|"
            f"offset) from {_MIDDLE} ({sideways})|the {name}"
        ),
        bare=(
            f"distance (from|to) {line}|{name}|{name}|{adjective} (centering|centring) error|"
            f"distance from {_MIDDLE} ({sideways})|offset from {line}|{name} from {_MIDDLE}"
        ),
        terse=f"{{unit}} ({off} ({sideways})|from {line})",
        others=(
            f"no matter which side, how far ({sideways}) is {_TARGET} {off}|"
            f"by how much is {_TARGET} {off} ({sideways})|how (large|big|great) is the ({name}|"
            f"distance (from|to) {line})|{_TARGET} is how far from {line}|"
            f"({sideways}) , how far [off] is {_TARGET} {off}|({sideways}) , how far (from|"
            f"off) {_MIDDLE} (is {_TARGET}|are we)"
        ),
    )


_OFF_X = _midline(
    "(vertical (midline|center line|centerline|middle line|axis|line|mid line)|y axis|"
    "midline that runs up and down|long midline)",
    "horizontally|sideways|laterally|along x|in x|in the x direction|from side to side|to the side|"
    "to one side",
    "(horizontal|sideways|lateral|side-to-side|absolute x|unsigned x)",
    "to the side|sideways|off to the side|off to one side|to one side|out to the side|aside|"
    "off sideways|over to one side",
)
_OFF_Y = _midline(
    "(horizontal (midline|center line|centerline|middle line|axis|line|mid line)|x axis|"
    "midline that runs (across|from left to right)|cross line)",
    "vertically|lengthwise|along y|in y|in the y direction|along the finger|up or down the finger|"
    "along the length of the finger|lengthways",
    "(vertical|lengthwise|lengthways|absolute y|unsigned y|up-and-down)",
    "off lengthwise|off vertically|off along the finger|out lengthwise|off in y|"
    "out along the finger|off lengthways|off along the length of the finger",
)

_OFF = f"(off center|off {_MIDDLE}|from {_MIDDLE}|away from {_MIDDLE}|out from {_MIDDLE})"
_DISTANCE = AmountWording(
    asked=(
        Asked(
            "how far",
            f"(is|was) {_TARGET} {_OFF}|are we {_OFF}",
            f"{_TARGET} (is|was) {_OFF}|we are {_OFF}",
        ),
        Asked(f"how far {_OFF}", f"is {_TARGET}|are we", f"{_TARGET} is|we are"),
        Asked(
            f"how far {_OFF}",
            "does {thing} (lie|sit|touch|press|rest)|did (we|you) (touch|hit|grip|catch) {thing}|"
            "did {thing} land|is the (contact|touch|center of the contact)",
            "{thing} (lies|sits|touches|presses|rests)|we (touched|gripped|caught) {thing}|"
            "the (contact|touch|center of the contact) is",
        ),
        Asked(
            "how (close|near)",
            f"is {_TARGET} to {_MIDDLE}|are we to {_MIDDLE}|did we get to {_MIDDLE}",
            f"{_TARGET} is to {_MIDDLE}|we are to {_MIDDLE}",
        ),
        Asked(
            "how (badly|much|far|greatly|strongly)",
            f"is {_TARGET} (off center|decentered|off {_MIDDLE}|out of center|miscentered|"
            f"misplaced)|(did|do) we miss {_MIDDLE}|is {_TARGET} shifted from {_MIDDLE}|"
            f"are we off {_MIDDLE}",
            f"{_TARGET} is (off center|decentered|off {_MIDDLE}|out of center)|we missed {_MIDDLE}|"
            f"{_TARGET} is shifted from {_MIDDLE}|we are off {_MIDDLE}",
        ),
        Asked(
            "(what|which|at what) distance [from the center|from the middle]",
            f"is {_TARGET}|does {{thing}} (lie|sit|have)|is there (to|from) {_MIDDLE}|"
            f"do you (measure|read|get) (to|from) {_MIDDLE}",
            f"{_TARGET} is|{{thing}} (lies|sits|has)|there is to {_MIDDLE}|"
            f"you measure to {_MIDDLE}",
        ),
        Asked(
            "what",
            f"is the (distance|offset|deviation|displacement) [of {_TARGET}] (from|to) {_MIDDLE}|"
            f"is the distance between {_TARGET} and {_MIDDLE}|is the centering error",
            f"the (distance|offset|deviation|displacement) [of {_TARGET}] (from|to) {_MIDDLE} is|"
            f"the distance between {_TARGET} and {_MIDDLE} is|the centering error is",
        ),
        Asked(
            "by (how much|what distance)",
            f"(did|do) we miss {_MIDDLE}|is {_TARGET} (off|off center|away from {_MIDDLE})|(does|"
            f"did) {{thing}} miss {_MIDDLE}",
            f"we (miss|missed) {_MIDDLE}|{_TARGET} is (off center|away from {_MIDDLE})|"
            f"{{thing}} (misses|missed) {_MIDDLE}",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"{_OFF} is {_TARGET}|is {_TARGET} {_OFF}|are we {_OFF}|did we miss {_MIDDLE} by|"
            f"are (between {_TARGET} and|there to) {_MIDDLE}|is it to {_MIDDLE}",
            f"{_TARGET} is {_OFF}|we are {_OFF}|we missed {_MIDDLE} by|there are to {_MIDDLE}|"
            f"{_OFF} {_TARGET} is",
        ),
    ),
    nouns=(
        f"the (distance|offset|deviation|displacement|gap) [of {_TARGET}] (from|to) {_MIDDLE}|"
        f"the distance between {_TARGET} and {_MIDDLE}|the centering (error|offset|accuracy)|"
        "the eccentricity [of {touch}]|the radial (distance|offset|error|position)|"
        f"the (distance|offset) of the contact from {_MIDDLE}|the (off-center|center) distance|"
        f"the straight-line distance (from|to) {_MIDDLE}|the (total|overall) (offset|"
        f"distance) from {_MIDDLE}"
    ),
    bare=(
        f"distance (from|to) {_MIDDLE}|distance to center|distance from center|"
        f"offset from {_MIDDLE}|off-center distance|centering error|radial distance|radial offset|"
        f"eccentricity|center distance|center offset|offset from center|deviation from center|"
        f"distance to the middle|distance off center"
    ),
    terse=f"{{unit}} ({_OFF}|to {_MIDDLE})",
    others=(
        f"how eccentric is {_TARGET}|how misaligned is {_TARGET}|how lopsided is the (grip|contact)|"
        f"how far astray is {_TARGET}|how far did we stray from {_MIDDLE}|"
        f"how far out of true is {_TARGET}|how much did we miss the bullseye by|"
        f"how far from the bullseye (is {_TARGET}|are we)|how well (centered|placed in the middle) is {_TARGET}|{_TARGET} is how far (off|"
        f"from) {_MIDDLE}|how (large|big|great) is the (centering error|eccentricity|(distance|"
        f"offset) (from|to) {_MIDDLE})|how far out is {_TARGET}|how far from being centered is "
        f"{_TARGET}|how far would (we|I) have to (move|shift) to (center {{thing}}|be centered)|"
        f"how much distance is there to the (center|middle)|how far off center|"
        f"how long (is|would be) (a|the) [straight] line from {_MIDDLE} to ({{touch}}|the middle of the contact)|"
        f"if (I|you|we|one) drew a [straight] line from {_MIDDLE} to ({{touch}}|the contact's (middle|center)|the (middle|center) of the contact) , "
        f"how long would it be"
    ),
)

_COORDINATES = (
    "the [exact|precise|x and y|contact|touch|x y] coordinates [of {touch}|of {thing}]|(x and y|"
    "both coordinates|both x and y) [of {touch}|of {thing}|of the contact point]|"
    "the x and [the] y [of {touch}|of {thing}|coordinates|values|positions]|its coordinates|"
    "the ([contact|touch] position|contact point|location of {thing}|position of {thing}|"
    "location) in (millimetres|mm|coordinates|x and y|numbers)|the x coordinate and the y "
    "coordinate|the numerical (position|location)|the x and y (coordinate|coordinates|offsets|"
    "offset)"
)
_AT = "(at which|at what|on which) (coordinates|x and y|x and y coordinates)"
_EXACTLY = "(in (mm|millimetres|coordinates|x and y|terms of x and y|numbers)|on the x and y axes)"
_SHORT = "coordinates|xy|x y|x and y|x, y|xy position|xy coordinates|contact coordinates|both axes"

FAMILIES: tuple[QuestionFamily, ...] = (
    amount_family("position_x", "x", _X, "mm", "µm"),
    amount_family("position_y", "y", _Y, "mm", "µm"),
    amount_family("offset_x", "offset_x", _OFF_X, "mm", "µm"),
    amount_family("offset_y", "offset_y", _OFF_Y, "mm", "µm"),
    amount_family("distance", "distance", _DISTANCE, "mm", "µm"),
    QuestionFamily(
        name="coordinates",
        pattern=(
            f"{{lead}} {OPENING} ( what are ({_COORDINATES}) | {{ask}} what ({_COORDINATES}) are |"
            f" ([{{want}}]|{GET}) ({_COORDINATES}) | {_AT} (is ({{touch}}|{{thing}})|"
            f"does {{thing}} (lie|sit|touch|press)|do you feel {{thing}}) | ({{ask}}|"
            f"{FIND}) {_AT} ({{touch}}|{{thing}}) is | where [exactly] is ({{touch}}|"
            f"{{thing}}) {_EXACTLY} | ({{ask}}|{FIND}) where [exactly] ({{touch}}|"
            f"{{thing}}) is {_EXACTLY} | ({_SHORT}) [in (mm|millimetres)] | [the|"
            f"your] ({_SHORT}) ) [in {{unit}}] {CLOSING} {{tail}}"
        ),
        build=lambda *_: Several(
            parts=(Amount(quantity="x", unit="mm"), Amount(quantity="y", unit="mm"))
        ),
        slots=amount_slots({"mm": UNIT_WORDS["mm"]}),
    ),
)
