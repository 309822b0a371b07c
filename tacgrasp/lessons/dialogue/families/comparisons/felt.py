"""Families that compare depth, force, area or distance with a number, affirmed or denied."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.comparisons.thresholds import (
    BETWEEN,
    UNITS,
    one_threshold,
    test_of,
)
from tacgrasp.lessons.dialogue.families.comparisons.wordings import (
    MORE,
    NOT_MORE,
    measured_pattern,
    not_measured_pattern,
    not_thing_pattern,
    slots_of,
    thing_pattern,
)
from tacgrasp.lessons.dialogue.meaning import FACTS, Check
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Chooser,
    Numbers,
    QuestionFamily,
    length_of,
)
from tacgrasp.lessons.dialogue.patterns.pattern import Slots
from tacgrasp.lessons.dialogue.scene import AskedScene


def compare_family(
    name: str, quantity: str, unit: str, pattern: str, slots: Slots, *, is_signed: bool = False
) -> QuestionFamily:
    """A family that compares a quantity with a number.

    Args:
        name: Its name.
        quantity: Name in ``FACTS``.
        unit: Unit of a number without one.
        pattern: Its wordings.
        slots: Its slots.
        is_signed: Whether the number may be negative.
    """

    def build(bindings: Bindings, numbers: Numbers) -> Check:
        test, denied = test_of(quantity, unit, bindings, numbers)
        return check_of(test, denied=denied, length=length_of(bindings))

    truth = FACTS[quantity]
    return QuestionFamily(
        name=name,
        pattern=pattern,
        build=build,
        slots=slots,
        choose=_negative(truth) if is_signed else one_threshold(truth),
    )


def _negative(truth: str) -> Chooser:
    """Chooser of numbers that are negative where the value is."""
    draw = one_threshold(truth)

    def choose(
        scene: AskedScene, bindings: Bindings, rng: np.random.Generator
    ) -> Mapping[str, str]:
        numbers = draw(scene, bindings, rng)
        value = scene.values()[truth]
        if not isinstance(value, float) or value >= 0:
            return numbers
        low, high = f"-{numbers['t']}", f"-{numbers['u']}"
        return {"t": high, "u": low} if BETWEEN in bindings.values() else {"t": low, "u": high}

    return choose


_FIXED_LENGTHS = {
    "0.5 mm": "(half a millimetre|half a mm|half a millimeter)",
    "1 mm": "(one millimetre|one mm|a millimetre|(a|one) (full|whole|entire) millimetre)",
    "0.1 mm": "(a tenth of a millimetre|one tenth of a millimetre|a tenth of a mm)",
    "0.25 mm": "(a quarter of a millimetre|a quarter millimetre|a quarter of a mm)",
    "0.2 mm": "(a fifth of a millimetre|two tenths of a millimetre)",
    "0.3 mm": "(three tenths of a millimetre|point three millimetres)",
    "0.4 mm": "four tenths of a millimetre",
    "100 µm": "(a hundred microns|one hundred microns)",
    "200 µm": "two hundred (microns|micrometres)",
    "300 µm": "three hundred microns",
    "500 µm": "five hundred (microns|micrometres)",
}
_FIXED_FORCES = {
    "0.5 N": "half a newton",
    "1 N": "(one newton|a newton|a single newton|one N)",
    "2 N": "two (newtons|N)",
    "3 N": "three newtons",
    "4 N": "four newtons",
    "5 N": "five (newtons|N)",
    "10 N": "ten newtons",
    "0.25 N": "a quarter of a newton",
    "1.5 N": "(one and a half newtons|a newton and a half)",
    "2.5 N": "two and a half newtons",
    "100 g": "(a hundred|one hundred) grams",
    "200 g": "two hundred grams",
    "50 g": "fifty grams",
    "500 mN": "five hundred millinewtons",
}
_PAD = "[of] the [whole|entire] (pad|gel|sensor|skin|fingertip|surface)"
_FIXED_AREAS = {
    "50 %": f"(half {_PAD}|fifty percent)",
    "25 %": f"(a quarter|one quarter) {_PAD}",
    "10 %": f"((a tenth|one tenth) of the (pad|gel|sensor)|ten percent [{_PAD}])",
    "5 %": f"five percent [{_PAD}]",
    "20 %": f"((a fifth|one fifth) of the (pad|gel|sensor)|twenty percent [{_PAD}])",
    "33.3 %": f"(a|one) third {_PAD}",
    "66.7 %": f"two thirds {_PAD}",
    "75 %": f"three quarters {_PAD}",
}
_FIXED_DISTANCES = {
    "1 mm": "(one|a|a single) millimetre",
    "2 mm": "two (millimetres|mm)",
    "3 mm": "three millimetres",
    "5 mm": "five millimetres",
    "0.5 mm": "half a millimetre",
    "1.5 mm": "one and a half millimetres",
}

_DEPTH_SLOTS: Slots = {
    **slots_of(("mm", "µm", "cm"), _FIXED_LENGTHS, is_bare=True),
    "deeper": {
        ">": "(deeper than|deeper than|further in than|deeper in than|more deeply in than)",
        "<": "(shallower than|less deep than|not as deep as|less far in than)",
        ">=": "(at least as deep as|no shallower than|not shallower than|as deep as)",
        "<=": "(no deeper than|not deeper than|at most as deep as|no further in than)",
    },
    "further": {
        ">": "(further than|deeper than|farther than|deeper in than|more deeply than|past|beyond)",
        "<": "(less far than|less deep than|less deeply than|not as far as|shallower than)",
        ">=": "(as far as|at least as deep as|as deep as|at least as far as)",
        "<=": "(no further than|no deeper than|not further than|not deeper than|no farther than)",
    },
    "deeper_but": {
        BETWEEN: "deeper than {#t} [{unit}] (and|but) (less than|less deep than|shallower than|not deeper than|below) {#u} {unit}"
    },
    "or_deeper": {
        ">=": "(or deeper|or more|or further|or deeper than that|or even deeper)",
        "<=": "(or less|or shallower|or less deep|or not even that)",
    },
    "in": "(in|in|into the (gel|pad|skin|rubber|sensor|silicone))",
    "sink": (
        "(sink|go|go|press|push|dig|bite|poke|get|stick|reach|squish|penetrate|cut|come|jut|plunge)"
    ),
    "sinks": (
        "(sinks|goes|goes|presses|pushes|digs|bites|pokes|gets|sticks|reaches|penetrates|cuts|comes)"
    ),
    "sunk": "(sunk|gone|gone|pressed|dug|pushed|poked|bitten|got|penetrated|come|been pushed)",
    "pressed": "(pressed|pushed|sunk|dug|squashed|driven|squeezed|poked|forced|jammed|sitting|stuck)",
    "dent": "(dent|indent|deform|compress|squash|squish|depress|displace)",
    "dents": "(dents|indents|deforms|compresses|squashes|depresses|displaces)",
    "dented": "(dented|indented|deformed|compressed|squashed|pushed in|pressed in|depressed)",
    "gel": "(gel|pad|skin|sensor|rubber|surface|fingertip|silicone)",
}
_FORCE_SLOTS: Slots = {
    **slots_of(("N", "mN", "g", "cN"), _FIXED_FORCES, is_bare=True),
    "unit": {
        "N": UNITS["N"],
        "mN": UNITS["mN"],
        "cN": UNITS["cN"],
        "g": "(g|g|grams|grams|grams|gram|grams of force|gram-force)",
    },
    "harder": {
        ">": (
            "(harder than|harder than|more strongly than|more firmly than|stronger than|"
            "tighter than|with over|with more than)"
        ),
        "<": (
            "(softer than|less hard than|more gently than|weaker than|"
            "more softly than|not as hard as|with less than|more lightly than)"
        ),
        ">=": "(at least as hard as|as hard as|as firmly as|no softer than|no weaker than)",
        "<=": "(no harder than|not harder than|no stronger than|no tighter than|no firmer than)",
    },
    "we": "(we|we|we|you|they|the fingers|the jaws)",
    "grip": "(press|hold|grip|squeeze|push|clamp|pinch|grasp|clench|squash|press on|push on)",
    "gripping": "(pressing|holding|gripping|squeezing|pushing|clamping|pinching|grasping|squashing)",
    "gripped": "(held|pressed|squeezed|gripped|clamped|pinched|pushed|grasped|loaded|squashed|clasped)",
    "sensor": "(sensor|pad|gel|skin|finger|fingertip|gripper|reading|object|readout|jaw)",
}
_AREA_SLOTS: Slots = {
    **slots_of(("%", "mm²"), _FIXED_AREAS),
    "cover": "(cover|cover|touch|fill|occupy|take up|use|span|press on|lie on|contact)",
    "covers": "(covers|covers|touches|fills|occupies|takes up|uses|spans|presses on|contacts)",
    "covered": "(covered|covered|touched|in contact|filled|occupied|taken up|pressed|in use|used)",
}
_DISTANCE_SLOTS: Slots = {
    **slots_of(("mm",), _FIXED_DISTANCES),
    "farther": {
        ">": "(further than|farther than|further away than|more than|over)",
        "<": "(closer than|nearer than|less far than|less than|under)",
        ">=": "(at least|no closer than|no nearer than|as far as)",
        "<=": "(within|no further than|no farther than|at most|up to|not further than)",
    },
    "closer": {"<": "(closer than|nearer than)", "<=": "within"},
    "lie": "(lie|sit|land|come down|touch|rest|press|stay|fall|hit)",
    "lies": "(lies|sits|landed|came down|touches|rests|presses|hit|is placed|is located)",
    "off": (
        "((from|away from|off|out from|out of|distant from) the (center|middle|centre) "
        "[of the (pad|gel|sensor)]|off center|off centre|off-center|from center|out of the middle|"
        "from the middle|out of center|off the mark|off target)"
    ),
    "to": "(to|of|from) the (center|middle) [of the (pad|gel|sensor)]",
}

_DEPTH = (
    "the [contact|press|indentation|present|measured|maximum|penetration] depth|the depth|"
    "the indentation|the dent|the depth of ({touch}|{body}|the dent|the print)|the penetration|"
    "depth|the depth reading|its depth|the press|the dip in the {gel}|the indent|the hollow|"
    "our depth|indentation|the depth value|the dent in the {gel}|the impression"
)
_DEEP_DIRECT = (
    "is ({touch}|{thing}|the dent) {now} {deeper_but}|"
    "is ({touch}|{thing}|{thing}|the dent|the imprint|the press) {now} {deeper} {amount}|"
    "is ({touch}|{thing}|the dent) {now} ({more_than} {amount}|{amount} {or_more}) deep|"
    "is ({touch}|{thing}|the dent) {amount} (deep {or_more}|{or_deeper})|"
    "is {thing} {now} {pressed} {in} [by] ({compared}|{further} {amount})|is {thing} {now} in [by] {compared}|"
    "is {thing} {now} {pressed} [in] ({more_than} {amount} deep|{deeper} {amount})|"
    "(does|does|doesn't|did|can) {thing} {now} {sink} {in} ({further} {amount}|by {compared}|"
    "{compared})|(does|did) {thing} {sink} ({more_than} {amount} (deep|in|into the {gel})|"
    "{amount} deep {or_more}|{deeper} {amount}|{amount} {or_deeper})|"
    "has {thing} {now} {sunk} [{in}] ({further} {amount}|{deeper} {amount}|by {compared}|"
    "{more_than} {amount} deep)|(did we (press|push|poke|squeeze)|have we (pressed|pushed|poked)) "
    "{thing} ({in} by {compared}|{deeper} {amount}|{more_than} {amount} deep|{further} {amount})|"
    "(are we|is it) [now|already] {amount} [deep] (in|into the {gel}) [,] {or_more}|"
    "have we {now} (gone|got|pressed|pushed|sunk) ({deeper} {amount}|"
    "{more_than} {amount} deep)|is the {gel} {now} {dented} [by] [{body}] ({compared})|"
    "(does|did) {thing} {dent} the {gel} [by] ({compared})|is there a dent of ({compared})|"
    "is there [a] ({more_than} {amount}|{amount} {or_more}) of (depth|indentation|dent)|"
    "(did|do) (we|you) {go} {amount} (of depth|in depth|deep)|"
    "are we {now} {exceeding} {amount} (of depth|deep|in depth)|"
    "do (you|we) (measure|feel|read|see|have|get) ({compared}) of (depth|indentation)|"
    "(does|did) {thing} reach (a depth of ({compared})|down to {at_least} {amount}|{more_than} {amount} deep)|"
    "is ({more_than} {amount}) of the {gel} pushed in|is the depth by now {exceeding} {amount}"
)
_DEEP_STATEMENTS = (
    "({touch}|{thing}|the dent) is {now} ({deeper} {amount}|({more_than} {amount}|"
    "{amount} {or_more}) deep|{amount} {or_deeper})|"
    "{thing} {now} {sinks} {in} ({further} {amount}|by {compared}|{compared})|"
    "{thing} is [{pressed}] {in} [by] ({compared}|{further} {amount})|"
    "{thing} has {now} {sunk} {in} ({further} {amount}|by {compared})|"
    "we (are|have pressed|have gone|pressed) ({deeper} {amount}|{more_than} {amount} deep)|"
    "the {gel} is {dented} [by] ({compared})|{thing} {dents} the {gel} [by] ({compared})|"
    "there is a dent of ({compared})|{thing} {sinks} ({deeper} {amount}|{more_than} {amount} deep)"
)
_DEEP_BARE = (
    "{deeper} {amount}|({more_than} {amount}|{amount} {or_more}) (deep|in|of depth)|"
    "{amount} deep {or_more}|{amount} {or_deeper}|[is it] ({compared})|{amount} in {or_more}|"
    "it is ({compared})"
)
_NOT_DEEP_DIRECT = (
    "is ({touch}|{thing}) {never} (deeper than {affirm} {amount}|{not_more} {amount} deep)|"
    "(does|did) {thing} {not} {sink} {in} (further|deeper|more) than {amount} {affirm}|"
    "has {thing} {not} {sunk} {in} (further|deeper|more) than {amount} {affirm}|"
    "(does|did) {thing} {not} reach {at_least} (a depth of|down to) {amount}|"
    "(did|do) we {not} (press|push|get) {thing} deeper than {amount} {affirm}"
)
_NOT_DEEP_STATEMENTS = (
    "({touch}|{thing}) is {not} {deep}|{thing} does {not} {sink} {in} {far}|"
    "{thing} never {denied} {sinks} {in} {far}|{thing} has {not} {sunk} {in} {far}|"
    "we did {not} press {thing} {deep}|the {gel} is {not} {dented} by ({not_more} {amount})"
)
_DEEP_AFFIRMED = (
    "({touch}|{thing}) is {deep}|{thing} {sinks} {in} {far}|{thing} has {sunk} {in} {far}|"
    "the {gel} is {dented} by {not_more} {amount}"
)
_NOT_DEEP_SLOTS: Slots = {
    **_DEPTH_SLOTS,
    "deep": "({more_deep} {amount}|{not_more} {amount} deep)",
    "more_deep": {">": "deeper than", "<": "shallower than", ">=": "(as deep as|quite as deep as)"},
    "far": "{more_far} {amount}",
    "more_far": {">": "(further|deeper|more|farther) than", ">=": "(as far as|as deep as)"},
}

_FORCE = (
    "the [contact|normal|grip|gripping|felt|present|measured|total|pressing|clamping] force|"
    "the force|the load [on the (pad|sensor|finger)]|the (contact|pressing) load|the squeeze|force|the (force|load|pressure) "
    "(of|from|on) {body}|the grip|the force between the (fingers|jaws)|grip force|the push|"
    "the force reading|the pressing force|our grip|our force|the grip strength|contact force|"
    "the pressure|the pressure on {body}|its force|the force value|the press"
)
_FORCE_DIRECT = (
    "(do|do|don't|did) {we} {now} {grip} [{thing}] (with|at|by|using) ({compared})|"
    "(do|did) {we} {now} {grip} [{thing}] {harder} {amount}|"
    "are {we} {now} {gripping} [{thing}] (with ({compared})|{harder} {amount}|at ({compared}))|"
    "(have|are) we {now} (at|past|above|over|up to|beyond|) ({compared})|"
    "have {we} {now} {gone} {amount}|are we {now} {exceeding} {amount}|"
    "(did|do) {we} {go} {amount}|(does|doesn't|did) {thing} {exceed} {usual}|"
    "does {thing} (press|push|bear|lean) [on the {sensor}|back] with ({compared})|"
    "do (you|we) {now} (feel|measure|read|sense|get|see|record|register|detect) ({compared}) "
    "[of (force|load)]|is there [a force of|a load of] ({compared}) [of force] "
    "[on {thing}|on the {sensor}]|(is|are) there {now} ({compared}) (on {thing}|on the {sensor})|"
    "is {thing} {now} {gripped} (with|by|at|using) ({compared})|is {thing} {gripped} {harder} {amount}|"
    "does the {sensor} (feel|read|show|register|measure|see|carry|take|get|indicate) ({compared})|"
    "is the {sensor} {now} (reading|showing|at|feeling|carrying|seeing) ({compared})|"
    "(is there|do you feel|do you read|do you get|do we have|have you got) (anything|something|"
    "a force|any force) ({compared})|is (this|it) ({more_than} {usual}|{usual} {or_more})|"
    "are ({compared}) {now} (applied|exerted|acting|felt|measured|present) [on {thing}]|"
    "is ({compared}) {now} (applied|exerted|acting|felt|measured|being used) [on {thing}]|"
    "(is|was) it {gripped} with ({compared})"
)
_FORCE_STATEMENTS = (
    "{we} {grip} [{thing}] (with ({compared})|{harder} {amount})|"
    "we are [now|already|still] (at|) ({compared})|"
    "we are {gripping} [{thing}] (with ({compared})|{harder} {amount})|"
    "we {go} {amount}|we have {now} {gone} {amount}|it {exceeds} {usual}|"
    "you (feel|measure|read|get|see) ({compared}) [of force]|"
    "there (is|are) ({compared}) on ({thing}|the {sensor})|there is a force of ({compared})|"
    "{thing} is {gripped} (with ({compared})|{harder} {amount})|{thing} presses with ({compared})|"
    "the {sensor} (feels|reads|shows|registers|measures|carries) ({compared})|"
    "it is ({more_than} {usual}|{usual} {or_more})|({compared}) (is|are) (applied|acting|felt)"
)
_FORCE_BARE = (
    "({more_than} {usual}|{usual} {or_more})|anything ({more_than} {amount})|"
    "({compared}) of force|{harder} {amount}|({compared}) on the {sensor}|"
    "(gripping|squeezing|pressing) {harder} {amount}|{usual} {exceeded_passed}"
)
_NOT_FORCE_DIRECT = (
    "(do|did) {we} {not} {grip} [{thing}] with ({not_more} {amount})|"
    "(does|did) ({thing}|the {sensor}) {not} {not_exceed} {usual}|"
    "have {we} {never} {not_exceeded} {amount}|(do|did) we {not} {not_exceed} {amount}|"
    "is {thing} {never} {gripped} with ({not_more} {amount})|"
    "are {we} {never} {gripping} [{thing}] with ({not_more} {amount})|"
    "is it {never} ({not_more} {usual})"
)
_NOT_FORCE_STATEMENTS = (
    "{we} (do|did) {not} {grip} [{thing}] with ({not_more} {amount})|"
    "({thing}|it) does {not} {not_exceed} {usual}|it never {denied} {not_exceeds} {usual}|"
    "we have {never} {not_exceeded} {amount}|we (do|did) {not} {not_exceed} {amount}|"
    "{thing} is {never} {gripped} with ({not_more} {amount})|"
    "there is {not} ({not_more} {amount}) on ({thing}|the {sensor})|"
    "we are {never} ({not_more} {amount})"
)
_FORCE_AFFIRMED = (
    "{we} {grip} [{thing}] with ({not_more} {amount})|(it|the {sensor}) {not_exceeds} {usual}|"
    "we have {not_exceeded} {amount}|{thing} is {gripped} with ({not_more} {amount})|"
    "there is ({not_more} {amount}) on ({thing}|the {sensor})"
)

_AREA = (
    "the [contact|touched|covered|contacting|touching|measured] area|the area|the footprint|"
    "the contact patch|the area of {touch}|the imprint [of {body}]|the part in contact|"
    "area|contact area|the patch|the size of the (contact|patch|print|footprint)|"
    "the contact surface|the coverage|the covered part [of the pad]|the touched part [of the pad]|"
    "the print|the area that {thing} (covers|touches)|the area reading|coverage"
)
_AREA_DIRECT = (
    "(does|does|doesn't|did) {thing} {now} {cover} ({compared})|is {thing} {now} (covering|touching|"
    "filling|taking up|on|occupying|in contact with) ({compared})|"
    "(is|are|is) ({compared}) {now} {covered} [by {thing}]|has {thing} (got|covered|touched) "
    "({compared})|is the (pad|gel|sensor|skin) {now} ({more_than} {percent}|{percent} {or_more}) "
    "{covered}|is the (pad|gel|sensor|skin) (covered|touched|filled) (to|by) ({more_than} {percent}|{percent} {or_more})|"
    "do (you|we) (feel|have|touch|see|measure|get|use) ({compared}) [in contact|of contact|of area]|"
    "is there ({compared}) (of contact|in contact|covered|touched)|"
    "(is|are) ({compared}) in contact with {thing}|(do|does) ({compared}) touch {thing}|"
    "does the contact (take up|cover|spread over|extend over|stretch over) ({compared})"
)
_AREA_STATEMENTS = (
    "{thing} {covers} ({compared})|({compared}) (is|are) {covered} [by {thing}]|"
    "the (pad|gel|sensor|skin) is ({more_than} {percent}|{percent} {or_more}) {covered}|"
    "{thing} is (covering|touching|on|filling) ({compared})|we (touch|have|use|see) ({compared})|"
    "the contact (takes up|covers|spreads over|extends over) ({compared})"
)
_AREA_BARE = (
    "({compared}) {covered}|({more_than} {usual}|{usual} {or_more})|({compared}) of contact|"
    "({compared}) in contact|covering ({compared})"
)
_NOT_AREA_DIRECT = (
    "(does|did) {thing} {not} {cover} ({not_compared})|"
    "is {thing} {never} (covering|touching|on) ({not_compared})|"
    "is the (pad|gel|sensor|skin) {never} ({not_more} {percent}) {covered}"
)
_NOT_AREA_STATEMENTS = (
    "{thing} (does|did) {not} {cover} ({not_compared})|"
    "{thing} is {never} (covering|touching|on) ({not_compared})|"
    "the (pad|gel|sensor|skin) is {never} ({not_more} {percent}) {covered}"
)
_AREA_AFFIRMED = (
    "{thing} {covers} ({not_compared})|({not_compared}) (is|are) {covered}|"
    "the (pad|gel|sensor|skin) is ({not_more} {percent}) {covered}"
)

_DISTANCE = (
    "the (distance|offset) (from|to) the (center|middle|centre) [of the pad]|the offset|"
    "the centering (error|offset)|the distance (of {body}|between {body} and the middle)|"
    "the (miss|misalignment|eccentricity|off-center distance)|our offset|the radial offset|"
    "the offset (of|from) ({body}|center)|the position error|distance from (center|the middle)|"
    "how far {thing} is from the (center|middle)"
)
_DISTANCE_DIRECT = (
    "is ({thing}|{touch}) {now} ({compared}|{farther} {amount}) {off}|"
    "is ({thing}|{touch}) {now} {closer} {amount} {to}|is ({thing}|{touch}) {farther} {amount} {off}|"
    "(does|did) ({thing}|{touch}) {now} {lie} ({compared}|{farther} {amount}) {off}|"
    "(does|did) ({thing}|{touch}) {lie} {closer} {amount} {to}|"
    "did (we|you|I|the gripper) (miss|overshoot) the (center|middle) by ({compared})|"
    "(are|were) we {now} ({compared}) {off}|are we {now} (off|out) by ({compared})|"
    "is ({thing}|{touch}) (off|out|off center|displaced|misplaced|misaligned) by ({compared})|"
    "is {thing} centered to ({within} {amount})|is the (center|middle) ({compared}) (away|from {thing})"
)
_DISTANCE_STATEMENTS = (
    "({thing}|{touch}) is {now} ({compared}|{farther} {amount}) {off}|"
    "({thing}|{touch}) is {closer} {amount} {to}|({thing}|{touch}) {lies} ({compared}) {off}|"
    "({thing}|{touch}) {lies} {closer} {amount} {to}|we (missed|miss) the (center|middle) by "
    "({compared})|we are ({compared}) {off}|{thing} is (off|out|off center) by ({compared})"
)
_DISTANCE_BARE = "({compared}|{farther} {amount}) {off}|{closer} {amount} {to}|off by ({compared})"
_NOT_DISTANCE_DIRECT = (
    "is ({thing}|{touch}) {never} ({not_compared}) {off}|is {thing} {never} within {at_most} {amount} of the (center|middle)|"
    "(does|did) ({thing}|{touch}) {not} {lie} ({not_compared}) {off}|"
    "did we {not} miss the (center|middle) by ({not_compared})|are we {never} ({not_compared}) {off}"
)
_NOT_DISTANCE_STATEMENTS = (
    "({thing}|{touch}) is {never} ({not_compared}) {off}|"
    "{thing} is {never} within {at_most} {amount} of the (center|middle)|"
    "({thing}|{touch}) (does|did) {not} {lie} ({not_compared}) {off}|"
    "we did {not} miss the (center|middle) by ({not_compared})|we are {never} ({not_compared}) {off}"
)
_DISTANCE_AFFIRMED = (
    "({thing}|{touch}) (is|{lies}) ({not_compared}) {off}|"
    "({thing}|{touch}) is (further|farther) than {affirm} {amount} {off}|"
    "we missed the (center|middle) by ({not_compared})"
)

_PHRASES: Slots = {
    "compared": MORE,
    "not_compared": NOT_MORE,
    "exceeded_passed": {">": "(exceeded|passed)", ">=": "reached"},
    "percent": "({#t} {percent_unit}|{#t} {percent_unit})",
    "percent_unit": {"%": "(%|percent|per cent)"},
    "within": {"<=": "within"},
    "at_most": {"<=": ""},
    "affirm": {">": ""},
    "at_least": {">=": ""},
}

_UNITED: Slots = {"amount": "{united}"}
"""Amounts that tell by their unit what is compared."""

_DEPTHS: Slots = {**_NOT_DEEP_SLOTS, **_PHRASES}
_FORCES: Slots = {**_FORCE_SLOTS, **_PHRASES}
_AREAS: Slots = {**_AREA_SLOTS, **_PHRASES}
_DISTANCES: Slots = {**_DISTANCE_SLOTS, **_PHRASES}

FAMILIES: tuple[QuestionFamily, ...] = (
    compare_family("depth_above", "depth", "mm", measured_pattern(_DEPTH, is_usual=True), _DEPTHS),
    compare_family(
        "deeper_than",
        "depth",
        "mm",
        thing_pattern(_DEEP_DIRECT, _DEEP_STATEMENTS, _DEEP_BARE),
        {**_DEPTHS, **_UNITED},
    ),
    compare_family("force_above", "force", "N", measured_pattern(_FORCE, is_usual=True), _FORCES),
    compare_family(
        "pressed_with",
        "force",
        "N",
        thing_pattern(_FORCE_DIRECT, _FORCE_STATEMENTS, _FORCE_BARE),
        {**_FORCES, **_UNITED},
    ),
    compare_family("area_above", "area", "%", measured_pattern(_AREA, is_usual=True), _AREAS),
    compare_family(
        "covers", "area", "%", thing_pattern(_AREA_DIRECT, _AREA_STATEMENTS, _AREA_BARE), _AREAS
    ),
    compare_family("offset_above", "distance", "mm", measured_pattern(_DISTANCE), _DISTANCES),
    compare_family(
        "distance_above",
        "distance",
        "mm",
        thing_pattern(_DISTANCE_DIRECT, _DISTANCE_STATEMENTS, _DISTANCE_BARE),
        _DISTANCES,
    ),
    compare_family("not_deep", "depth", "mm", not_measured_pattern(_DEPTH, is_usual=True), _DEPTHS),
    compare_family(
        "not_deeper",
        "depth",
        "mm",
        not_thing_pattern(_NOT_DEEP_DIRECT, _NOT_DEEP_STATEMENTS, _DEEP_AFFIRMED),
        {**_DEPTHS, **_UNITED},
    ),
    compare_family("not_force", "force", "N", not_measured_pattern(_FORCE, is_usual=True), _FORCES),
    compare_family(
        "not_pressed_with",
        "force",
        "N",
        not_thing_pattern(_NOT_FORCE_DIRECT, _NOT_FORCE_STATEMENTS, _FORCE_AFFIRMED),
        {**_FORCES, **_UNITED},
    ),
    compare_family("not_area", "area", "%", not_measured_pattern(_AREA, is_usual=True), _AREAS),
    compare_family(
        "not_covers",
        "area",
        "%",
        not_thing_pattern(_NOT_AREA_DIRECT, _NOT_AREA_STATEMENTS, _AREA_AFFIRMED),
        _AREAS,
    ),
    compare_family(
        "not_distance",
        "distance",
        "mm",
        not_thing_pattern(_NOT_DISTANCE_DIRECT, _NOT_DISTANCE_STATEMENTS, _DISTANCE_AFFIRMED),
        _DISTANCES,
    ),
)
