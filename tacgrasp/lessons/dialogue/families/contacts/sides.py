"""Families about the side of the pad where the contact lies, and about which offset is larger."""

from __future__ import annotations

from collections.abc import Callable

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.meaning import Check, Which
from tacgrasp.lessons.dialogue.patterns.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.patterns.phrases import amount_pattern, check_pattern, denied_pattern


def _condition(*slots: str, denied: bool = False) -> Callable[[Bindings, Numbers], Check]:
    def build(bindings: Bindings, _: Numbers) -> Check:
        name = next(bindings[slot] for slot in slots if slot in bindings)
        return check_of(name, denied=denied, length=length_of(bindings))

    return build


def _one_of(name: str) -> Callable[[Bindings, Numbers], Which]:
    return lambda bindings, _: Which(name=name, length=length_of(bindings))


_LENGTHWISE = "(vertically|along y|in y|in the y direction|lengthwise|up and down|along the finger)"
_SIDEWAYS = (
    "(horizontally|along x|in x|in the x direction|sideways|crosswise|left and right|to the side|"
    "laterally|across the finger)"
)
_AXES = f"({_SIDEWAYS} or {_LENGTHWISE}|{_LENGTHWISE} or {_SIDEWAYS})"
_AXIS_NAMES = (
    "([in|along] x or [in|along] y|[the] x or [the] y (axis|direction|offset)|the horizontal "
    "or the "
    "vertical one|horizontal or vertical|sideways or lengthwise)"
)

_LEFT_OR_RIGHT = (
    "(left or right [of the (center|middle)|of center]|on the left or [on] the right [side|half]|"
    "[more] to the left or [more] to the right|in the left or [in] the right half|right or left|"
    "left of the (center|middle) or right of it|closer to the left or [to] the right [edge|side]|"
    "nearer the left or the right [edge|side]|off to the left or off to the right|"
    "to the left or right [of the (center|middle)]|on the left or right [side])"
)
_TIP_OR_PALM = (
    "(towards the palm or [towards] the fingertip|(closer|nearer) to the (palm or [to] the "
    "(tip|fingertip)|(tip|fingertip) or [to] the palm)|"
    "above or below the (center|middle)|in the upper or [in] the lower half|"
    "nearer the (tip|fingertip) or the palm|nearer the palm or the (tip|fingertip)|"
    "at the top or at the bottom|in the top or [in] the bottom half|higher or lower than the "
    "(center|middle)|above the (center|middle) or below it|up or down [from the (center|middle)]|"
    "towards the fingertip or [towards] the palm|on the (palm|top) or on the (fingertip|"
    "bottom) side|"
    "near the top or near the bottom|top or bottom|proximal or distal [, (towards the palm or the tip)]|"
    "proximally or distally|palmward or tipward)"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="side",
        pattern=check_pattern(
            "{thing}|{touch}|the contact point|the (imprint|press point|center of the contact)",
            "[still|slightly|clearly|mostly|rather] {side}",
            "(does|did) ({thing}|{touch}) (lie|sit|press|touch|rest|land|bear|come down|end "
            "up) {side}|"
            "(did|do) we (touch|catch|hit|hold|grip|grab|press) {thing} {side}|"
            "(has {thing}|have we) (drifted|slid|shifted|moved|ended up) {side}|{side}|"
            "do you feel {thing} {side}|are we (touching|holding|gripping) {thing} {side}",
        ),
        build=_condition("side"),
        slots={
            "side": {
                "left": "(left of [the] (center|middle)|on the left [side|half|hand side] [of "
                "the pad]|"
                "in the left half [of the pad]|to the left [of the (center|middle)]|"
                "(off|shifted|displaced|more) to the left|near the left (side|edge)|more left "
                "than right|"
                "(closer|nearer) [to] the left (edge|side)|towards the left)",
                "right": "(right of [the] (center|middle)|on the right [side|half|hand side] "
                "[of the pad]|in the right half [of the pad]|to the right [of the (center|middle)]|"
                "(off|shifted|displaced|more) to the right|near the right (side|edge)|more "
                "right than left|"
                "(closer|nearer) [to] the right (edge|side)|towards the right)",
                "top": "(above [the] (center|middle)|in the (upper|top) half [of the pad]|"
                "towards the (palm|top)|on the (palm|upper) side|(closer|nearer) [to] the "
                "(palm|top edge)|"
                "higher than the (center|middle)|more (towards|to) the palm|"
                "(nearer|closer) [to] the palm than [to] the (tip|fingertip))",
                "bottom": "(below [the] (center|middle)|in the (lower|bottom) half [of the pad]|"
                "towards the (fingertip|tip|bottom)|on the (fingertip|lower) side|"
                "(closer|nearer) [to] the (fingertip|tip|bottom edge)|lower than the (center|"
                "middle)|"
                "more (towards|to) the (fingertip|tip)|(nearer|closer) [to] the (tip|"
                "fingertip) than [to] the palm)",
            }
        },
    ),
    QuestionFamily(
        name="side_named",
        pattern=(
            "{lead} ( {half} [of (the|our|your) (pad|gel|sensor|finger)] [{tag}] | [so|maybe|probably|is "
            "it|is that|are we on|is it on|is it in] the {half} [of (the|our|your) (pad|gel|sensor)] "
            "[{tag}] | (is|does) {thing} (on|occupy|touch|in) the {half} [of (the|our|your) (pad|gel|"
            "sensor)] ) {tail} [, {length}]"
        ),
        build=_condition("half"),
        slots={
            "half": {
                "left": "(left|left-hand) (half|side|part)",
                "right": "(right|right-hand) (half|side|part)",
                "top": "(palm|upper|palm-side) (half|side|end)",
                "bottom": "(fingertip|tip|lower) (half|side|end)",
            }
        },
    ),
    QuestionFamily(
        name="not_side",
        pattern=denied_pattern("{thing}|{touch}|the contact point", "{side}"),
        build=_condition("side", denied=True),
        slots={
            "side": {
                "left": "(left of the (center|middle)|on the left [side|half]|to the left)",
                "right": "(right of the (center|middle)|on the right [side|half]|to the right)",
                "top": "(above the (center|middle)|in the (upper|top) half|towards the palm)",
                "bottom": "(below the (center|middle)|in the (lower|bottom) half|"
                "towards the (fingertip|tip))",
            }
        },
    ),
    QuestionFamily(
        name="off_center",
        pattern=check_pattern(
            "{thing}|{touch}|the contact point",
            "off to (one|the|a) side|off [the] center|off-center|out of the (center|middle)|"
            "away from the (center|middle)|to one side|on one side",
        ),
        build=lambda bindings, _: check_of(
            "position centered", denied=True, length=length_of(bindings)
        ),
    ),
    QuestionFamily(
        name="side_or",
        pattern=(
            "{lead} ( (is|was) ({thing}|{touch}) [rather] {pair} "
            "| {ask} (whether|if) ({thing}|{touch}) is [rather] {pair} "
            "| (on|in) (which|what) (side|half) [of the pad] is ({thing}|{touch}) , {pair} "
            "| (which|what) (side|half) [of the pad] is ({thing}|{touch}) (on|in) , {pair} "
            "| which is it , {pair} | which side [of the (pad|center|middle)] , {pair} | {pair} "
            "| where is ({thing}|{touch}) , {pair} | is that {pair} "
            "| (which|what) way is ({thing}|{touch}) (off|off center|shifted|displaced) , {pair} "
            "| (does|did) ({thing}|{touch}) (lie|land|sit|come down|touch|press|end up) {pair} "
            "| would you say ({thing}|{touch}|it) is {pair} | (do|did) we (touch|hit|catch|"
            "hold) {thing} "
            "{pair} ) {tail} [, {length}]"
        ),
        build=lambda bindings, _: Which(name=bindings["pair"], length=length_of(bindings)),
        slots={"pair": {"side_x": _LEFT_OR_RIGHT, "side_y": _TIP_OR_PALM}},
    ),
    QuestionFamily(
        name="compare",
        pattern=(
            "{lead} ( is (the {miss} [of ({touch}|{body})]|{thing}) "
            "(larger|greater|further out|worse|bigger) {axes} "
            "| ({whether}|[{believe}]) the {miss} [of {body}] is (larger|greater|worse|bigger) "
            "{axes} "
            "[{tag}] | is ({thing}|{touch}) {off} {axes} "
            "| ({whether}|[{believe}]) ({thing}|{touch}) is {off} {axes} [{tag}] "
            "| {off} {axes} | are we {off} {axes} | (did|do) we miss the (center|middle) [by] "
            "more {axes} "
            "| is the {pair} | {whether} the {pair_is} ) {tail} [, {length}]"
        ),
        build=_condition("axes", "pair", "pair_is"),
        slots={
            "miss": "(offset|miss|error|displacement|centering error|deviation)",
            "off": "(further off [center]|more off [center]|further out|worse placed|more "
            "displaced|"
            "further from the (center|middle)|more off|worse centered|shifted more|off center "
            "more)",
            "axes": {
                "wider": f"{_SIDEWAYS} than {_LENGTHWISE}",
                "higher": f"{_LENGTHWISE} than {_SIDEWAYS}",
            },
            "pair": {
                "wider": "(x|horizontal|sideways) {miss} {larger} than the (y|vertical|"
                "lengthwise) [one|{miss}]",
                "higher": "(y|vertical|lengthwise) {miss} {larger} than the (x|horizontal|"
                "sideways) [one|{miss}]",
            },
            "pair_is": {
                "wider": "(x|horizontal) {miss} is {larger} than the (y|vertical) [one]",
                "higher": "(y|vertical) {miss} is {larger} than the (x|horizontal) [one]",
            },
            "larger": "(larger|greater|bigger|worse)",
        },
    ),
    QuestionFamily(
        name="worse_axis",
        pattern=amount_pattern(
            f"is ({{thing}}|{{touch}}) {{off}} {_AXES}|is the {{miss}} [of {{body}}] (larger|"
            f"greater|worse|"
            f"bigger) {_AXES}|(in|along) which (axis|direction) is ({{thing}}|{{touch}}) {{off}}|"
            f"(in|along) which (axis|direction) is the {{miss}} (larger|greater|worse|bigger|"
            f"largest)|"
            f"which {{miss}} is (larger|greater|bigger|worse) [, {_AXIS_NAMES}]|"
            f"which (axis|direction) is (worse|further off|more off) [, {_AXIS_NAMES}]|"
            f"(what|which) is (worse|larger|greater|bigger) , the (horizontal or the vertical|"
            f"x or the y) {{miss}}|"
            f"are we {{off}} {_AXES}|{{off}} {_AXES}|"
            f"(off center|offset|error|misplaced|off) [:|,] (more|mostly|mainly|rather|largely) ({_SIDEWAYS} [,] [or] [more|mostly|mainly|rather] {_LENGTHWISE}|{_LENGTHWISE} [,] [or] [more|mostly|mainly|rather] {_SIDEWAYS})|"
            f"do we (miss|lie off|have to correct) more {_AXES}|where is the {{miss}} (larger|"
            f"worse) , "
            f"{_AXIS_NAMES}|which of the (two|two offsets|axes|coordinates) is "
            "(worse|further off|larger|further from zero)",
            f"whether ({{thing}}|{{touch}}) is {{off}} {_AXES}|whether the {{miss}} is (larger|"
            f"greater|"
            f"worse|bigger) {_AXES}|(in|along) which (axis|direction) ({{thing}}|{{touch}}) is "
            f"{{off}}|"
            "which (axis|direction) is (worse|further off|more off)|which {miss} is (larger|"
            "greater|worse)",
            "the (worse|worst) (axis|direction|coordinate)|the (axis|direction) of the (larger|"
            "greater) "
            "{miss}|the (axis|direction) with the (larger|greater|bigger|worse) {miss}",
            "",
        ),
        build=_one_of("worse_axis"),
        slots={
            "miss": "(offset|miss|error|displacement|centering error|deviation)",
            "off": "(off more|most off [center]|furthest off [center]|further off [center]|"
            "more off [center]|further out|worse placed|more "
            "displaced|"
            "further from the (center|middle)|worse centered|shifted more|off center more)",
        },
    ),
)
