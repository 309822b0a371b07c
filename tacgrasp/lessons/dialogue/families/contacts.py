"""Families about the contact itself: whether there is one, whether it is whole, where, and all of it.

Here too: what is asked several at once, and what follows another question.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.families.goals import DEPTH_QUESTIONS
from tacgrasp.lessons.dialogue.families.phrases import check_pattern
from tacgrasp.lessons.dialogue.meaning import Amount, Check, Description, Several, Which
from tacgrasp.lessons.dialogue.scene import AskedScene

PARTS: Mapping[str, Amount | Which] = {
    "depth": Amount(quantity="depth", unit="mm"),
    "depth_um": Amount(quantity="depth", unit="µm"),
    "force": Amount(quantity="force", unit="N"),
    "area": Amount(quantity="area", unit="%"),
    "shape": Which(name="shape"),
    "texture": Which(name="texture"),
    "position": Which(name="position"),
}
"""What may be asked several at once."""

_NOUNS = {
    "depth": "the (depth|indentation)",
    "force": "the (force|grip force|load)",
    "area": "the (area|contact area|footprint)",
    "shape": "the (shape|form)",
    "texture": "the (texture|surface)",
    "position": "the (position|place|location)",
}
_QUESTIONS = {
    "depth": "how deep (is it|is {thing}|is {thing} pressed in)",
    "force": "how hard (is it|is {thing} held|is {thing} pressed)",
    "area": "how large is the (contact|footprint|area)",
    "shape": "what shape (is it|is {thing}|does it have)",
    "texture": "what texture (does it have|is {thing})",
    "position": "where is ({touch}|{body})",
}


def _condition(*slots: str) -> Callable[[Bindings, Numbers], Check]:
    def build(bindings: Bindings, _: Numbers) -> Check:
        name = next(bindings[slot] for slot in slots if slot in bindings)
        return check_of(name, length=length_of(bindings))

    return build


def _several(bindings: Bindings, _: Numbers) -> Several:
    named = [bindings[slot] for slot in ("first", "second", "third") if slot in bindings]
    return Several(parts=tuple(PARTS[name] for name in dict.fromkeys(named)))


def _follow(bindings: Bindings, _: Numbers) -> Amount | Which:
    return PARTS[bindings["part"]]


def _different(
    _: AskedScene,
    __: bool,
    rng: np.random.Generator,
) -> Mapping[str, str]:
    """Different parts for the slots of a question for several."""
    names = rng.permutation(list(_NOUNS))
    return {"first": str(names[0]), "second": str(names[1]), "third": str(names[2])}


FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="contact",
        pattern=(
            "{lead} ( is (anything|something|an object|any object) (touching|pressing|pressing on|"
            "in contact with) {pad} {tail} [, {length}] {touched} ? "
            "| (does|do) (anything|something|an object) touch {pad} {touched} {tail} ? "
            "| is there (anything|something|an object|a contact|any contact|contact) {where} "
            "{touched} {tail} [, {length}] ? "
            "| do you (feel|sense|touch|notice|have) (anything|something|an object|a contact|contact) "
            "{touched} {tail} ? | are you (touching|feeling|in contact with) (anything|something) "
            "{touched} {tail} ? | {whether} (something|anything|an object) (touches|is touching) "
            "{pad} {touched} {tail} [?] | is {pad} (touched|in contact|pressed|loaded) {touched} "
            "{tail} ? | is {pad} (empty|free|clear|untouched|unloaded) {empty} {tail} [, {length}] ? "
            "| {whether} {pad} is (empty|free|clear|untouched) {empty} {tail} [?] "
            "| (did|have) (we|I) (miss|missed) {thing} {empty} {tail} ? "
            "| is (nothing|no object) (touching|on|in contact with) {pad} {empty} {tail} ? "
            "| (do|did) (we|the fingers) (touch|hold|reach|catch) {thing} {touched} {tail} ? )"
        ),
        build=_condition("touched", "empty"),
        slots={
            "pad": "(the pad|the gel|the sensor|you|the finger|the fingertip sensor)",
            "where": "(on|at|against) {pad}",
            "touched": {"touched": ""},
            "empty": {"empty": ""},
        },
    ),
    QuestionFamily(
        name="cut",
        pattern=(
            "{lead} ( (is|was) {touch} cut [off] [by the edge [of the pad]] {cut} {tail} [, {length}] ? "
            "| does {touch} (run|reach|go|extend) (over|beyond|across) the edge [of the pad] {cut} "
            "{tail} [, {length}] ? | does the edge [of the pad] cut {touch} [off] {cut} {tail} ? "
            "| is (part|any|some|a part) of {touch} (off|outside|beyond) the (pad|sensor|gel) {cut} "
            "{tail} ? | {whether} {touch} (is cut off|runs over the edge|reaches beyond the pad) "
            "{cut} {tail} [?] | is (the whole contact|all of {touch}|{touch} wholly|{touch} entirely) "
            "(on|inside|within) the (pad|sensor|gel) {whole} {tail} [, {length}] ? "
            "| {whether} (the whole contact|all of {touch}) is on the (pad|sensor|gel) {whole} {tail} "
            "[?] | does (the whole contact|all of {touch}) (fit|lie) on the (pad|sensor|gel) {whole} "
            "{tail} ? )"
        ),
        build=_condition("cut", "whole"),
        slots={"cut": {"cut": ""}, "whole": {"whole": ""}},
    ),
    QuestionFamily(
        name="side",
        pattern=check_pattern(
            "{thing}|{touch}|the contact point",
            "{side}",
            "does {thing} (lie|sit|press|touch) {side}|did we (touch|catch|hit) {thing} {side}",
        ),
        build=_condition("side"),
        slots={
            "side": {
                "left": "(left of the (center|middle)|on the left [side|half]|in the left half|"
                "to the left)",
                "right": "(right of the (center|middle)|on the right [side|half]|in the right half|"
                "to the right)",
                "top": "(above the (center|middle)|in the (upper|top) half|towards the palm|"
                "on the palm side)",
                "bottom": "(below the (center|middle)|in the (lower|bottom) half|"
                "towards the fingertip|on the fingertip side)",
            }
        },
    ),
    QuestionFamily(
        name="side_or",
        pattern=(
            "{lead} ( is ({thing}|{touch}) {pair} {tail} [, {length}] ? "
            "| {ask} whether ({thing}|{touch}) is {pair} {tail} [?] "
            "| on which (side|half) [of the pad] is ({thing}|{touch}) , {pair} {tail} ? "
            "| {pair} {tail} ? | (does|did) {thing} (lie|land|sit|come down) {pair} {tail} ? )"
        ),
        build=lambda bindings, _: Which(name=bindings["pair"], length=length_of(bindings)),
        slots={
            "pair": {
                "side_x": "(left or right [of the (center|middle)]|on the left or on the right|"
                "more to the left or to the right|in the left or in the right half)",
                "side_y": "(towards the palm or towards the fingertip|"
                "closer to the palm or to the fingertip|above or below the (center|middle)|"
                "in the upper or in the lower half)",
            }
        },
    ),
    QuestionFamily(
        name="compare",
        pattern=(
            "{lead} ( is (the (offset|miss|error) of ({touch}|{body})|{thing}) (larger|greater|"
            "further out|worse) {axes} {tail} [, {length}] ? | {whether} the (offset|miss|error) "
            "[of {body}] is (larger|greater|worse) {axes} {tail} [?] "
            "| is ({thing}|{touch}) (further off center|more off center|further out|worse placed) "
            "{axes} {tail} ? )"
        ),
        build=_condition("axes"),
        slots={
            "axes": {
                "wider": "(horizontally than vertically|along x than along y|in x than in y|"
                "sideways than lengthwise)",
                "higher": "(vertically than horizontally|along y than along x|in y than in x|"
                "lengthwise than sideways)",
            }
        },
    ),
    QuestionFamily(
        name="describe",
        pattern=(
            "{lead} ( (describe|report|explain|summarise|characterise|sum up|picture) (the contact|"
            "the touch|what you feel|what touches the (pad|gel)|this contact|this touch|{thing}|"
            "the whole contact|everything you feel|how {thing} touches the pad) {tail} [, {length}] "
            "| what do you feel {tail} [, {length}] ? | what can you (feel|tell|say) [about "
            "(the contact|{thing})] {tail} [, {length}] ? | {ask} what you feel {tail} [, {length}] [?] "
            "| (tell me|say something|say more|talk) about (the contact|{thing}|what you feel) {tail} "
            "[, {length}] | {want} (a|the) (description|summary|report) of (the contact|the touch|"
            "{thing}|what you feel) {tail} [?] | what is the contact like {tail} ? "
            "| what (touches|is touching|presses on) the (pad|gel|sensor) {tail} ? "
            "| how does the contact [with {body}] feel {tail} ? | all you know about {touch} [, please] )"
        ),
        build=lambda bindings, _: Description(length=length_of(bindings)),
    ),
    QuestionFamily(
        name="several",
        pattern=(
            "{lead} ( {want} {first} and {second} {tail} [?] "
            "| {want} {first} , {second} and {third} {tail} [?] "
            "| {first} and {second} [, please] [?] | {first} , {second} and {third} [, please] [?] "
            "| what are {first} and {second} {tail} ? | both {first} and {second} {tail} [, please] )"
        ),
        build=_several,
        slots={"first": _NOUNS, "second": _NOUNS, "third": _NOUNS},
        steer=_different,
    ),
    QuestionFamily(
        name="two_questions",
        pattern=(
            "{lead} ( {first} , and {second} {tail} ? | {first} ? and {second} {tail} ? "
            "| {first} and {second} {tail} ? | {first} ? {second} {tail} ? "
            "| first , {first} ? second , {second} {tail} ? )"
        ),
        build=_several,
        slots={"first": _QUESTIONS, "second": _QUESTIONS},
        steer=_different,
    ),
    QuestionFamily(
        name="follow",
        pattern=(
            "[ok,|okay,|good,|thanks,|right,|I see,|understood,|well,|alright,|great,|hm,|so,|fine,] "
            "( and {part} {tail} ? | what about {part} {tail} ? | how about {part} {tail} ? "
            "| and what about {part} {tail} ? | and what is {part} {tail} ? | now {part} {tail} [?] "
            "| then {part} {tail} [?] | also {part} {tail} [?] | {part} as well {tail} [?] "
            "| the same for {part} {tail} [?] | and then {part} {tail} [?] "
            "| next , {part} {tail} [?] | could you add {part} {tail} ? | {part} next {tail} [, please] )"
        ),
        build=_follow,
        slots={"part": _NOUNS},
        before=(*DEPTH_QUESTIONS, "Is anything touching the pad?", "What shape is it?"),
    ),
    QuestionFamily(
        name="follow_unit",
        pattern=(
            "[ok,|okay,|good,|thanks,|right,|I see,|understood,|well,|alright,|great,|hm,|so,|fine,] "
            "( [and] in {part} {tail} ? | [and] what is that in {part} {tail} ? | how much is (that|it) "
            "in {part} {tail} ? | (convert|turn) (that|it) (to|into) {part} {tail} [, please] "
            "| and how many {part} is that {tail} ? | give (me that|that|it) in {part} {tail} "
            "| that in {part} {tail} [, please] [?] | (can|could) I have (that|it) in {part} {tail} ? "
            "| make that {part} {tail} | once more in {part} {tail} [?] | i prefer {part} {tail} "
            "| the same in {part} {tail} [?] | (say|put) it in {part} {tail} [, please] )"
        ),
        build=_follow,
        slots={"part": {"depth_um": "(microns|micrometres|µm)", "depth": "(mm|millimetres)"}},
        before=DEPTH_QUESTIONS,
    ),
)
