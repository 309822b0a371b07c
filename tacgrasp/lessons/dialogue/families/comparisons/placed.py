"""Families that compare x, y and their amounts with a number, and words that have an order."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.conditions import ORDERED, check_of
from tacgrasp.lessons.dialogue.families.comparisons.felt import compare_family
from tacgrasp.lessons.dialogue.families.comparisons.thresholds import DENIED, INVERSE
from tacgrasp.lessons.dialogue.families.comparisons.wordings import (
    MORE,
    SLOTS,
    measured_pattern,
    slots_of,
    thing_pattern,
)
from tacgrasp.lessons.dialogue.meaning import Check
from tacgrasp.lessons.dialogue.patterns.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.patterns.pattern import Slots

_FIXED = {
    "1 mm": "(one|a) millimetre",
    "2 mm": "two (millimetres|mm)",
    "3 mm": "three millimetres",
    "5 mm": "five millimetres",
    "0.5 mm": "half a millimetre",
}
_SLOTS: Slots = {
    **slots_of(("mm",), _FIXED, is_bare=True),
    "compared": MORE,
    "past": {">": "(more than|over|further than|above)", ">=": "(at least|no less than)"},
    "lie": "(lie|sit|land|come down|touch|press)",
    "lies": "(lies|sits|landed|came down|touches|presses)",
    "sideways": (
        "(off to (the|one) side|to one side|to the side|off sideways|sideways|horizontally off|"
        "off horizontally|away from the vertical midline|from the vertical midline|off in x|"
        "off along x|off in the x direction)"
    ),
    "lengthwise": (
        "(off lengthwise|lengthwise|vertically off|off vertically|off in y|off along y|"
        "away from the horizontal midline|from the horizontal midline|off in the y direction)"
    ),
    "right": (
        "(to the right|right of (the (center|middle)|center)|on the right|further right than the middle|"
        "towards the right|right of the vertical midline)"
    ),
    "palmwards": (
        "(above the (center|middle)|towards the palm|on the palm side|nearer to the palm than the middle|"
        "above the horizontal midline|up from the middle)"
    ),
}


def _axis(name: str) -> str:
    return (
        f"{name}|the {name} (coordinate|position|value|reading) [of ({{touch}}|{{body}})]|"
        f"the {name} of ({{touch}}|{{body}})|its {name} [coordinate|position]|"
        f"the (position|place) along {name}|the coordinate {name}"
    )


def _offset(axis: str, kind: str, line: str) -> str:
    return (
        f"the ({kind}) (offset|miss|error|deviation|misalignment) [of ({{touch}}|{{body}})]|"
        f"the (offset|distance) (along|in) {axis}|the distance (from|to) the {line} midline|"
        f"the absolute [value of] {axis}|the size of {axis}|the {axis} (offset|error)|"
        f"the amount of {axis}"
    )


def _offsets(where: str) -> str:
    return thing_pattern(
        f"is ({{thing}}|{{touch}}) {{now}} ({{compared}}) {{{where}}}|"
        f"(does|did) ({{thing}}|{{touch}}) {{lie}} ({{compared}}) {{{where}}}|"
        f"are we {{now}} ({{compared}}) {{{where}}}|did we (miss|hit) {{thing}} by ({{compared}}) "
        f"{{{where}}}|is the (contact|press|imprint) ({{compared}}) {{{where}}}",
        f"({{thing}}|{{touch}}) is {{now}} ({{compared}}) {{{where}}}|"
        f"({{thing}}|{{touch}}) {{lies}} ({{compared}}) {{{where}}}|we are ({{compared}}) {{{where}}}",
        f"({{compared}}) {{{where}}}",
    )


def _sided(where: str) -> str:
    return thing_pattern(
        f"is ({{thing}}|{{touch}}) {{now}} {{past}} {{amount}} {{{where}}}|"
        f"(does|did) ({{thing}}|{{touch}}) {{lie}} {{past}} {{amount}} {{{where}}}|"
        f"are we {{now}} {{past}} {{amount}} {{{where}}}|"
        f"is the (contact|press|imprint) {{past}} {{amount}} {{{where}}}",
        f"({{thing}}|{{touch}}) is {{now}} {{past}} {{amount}} {{{where}}}|"
        f"({{thing}}|{{touch}}) {{lies}} {{past}} {{amount}} {{{where}}}",
        f"{{past}} {{amount}} {{{where}}}",
    )


_RANK_SIGNS: Slots = {
    **SLOTS,
    "rank": {
        ">": "(more than|above|beyond|higher than|over)",
        "<": "(less than|below|not even|under|short of|lower than)",
        ">=": "(at least|no less than|not less than|not below|a minimum of|at a minimum)",
        "<=": "(at most|no more than|not more than|not above|not over|only up to)",
    },
    "deeper": {
        ">": "(deeper than|heavier than|stronger than|harder than)",
        "<": "(shallower than|less deep than|lighter than|weaker than|not as deep as)",
        ">=": "(at least as deep as|no shallower than)",
        "<=": "(no deeper than|not deeper than)",
    },
    "or_deeper": {
        ">=": "(or deeper|or more|or above|or beyond|or even more|or stronger|at least)",
        "<=": "(or less|or shallower|or below|or weaker|or lighter|at most|at the most)",
    },
    "larger": {
        ">": "(larger than|bigger than|greater than|wider than)",
        "<": "(smaller than|less large than|littler than|tinier than|not as large as)",
        ">=": "(at least as large as|no smaller than|not smaller than)",
        "<=": "(no larger than|not larger than|no bigger than|at most as large as)",
    },
    "or_larger": {
        ">=": "(or larger|or bigger|or more|or greater|or above|or wider|at least)",
        "<=": "(or smaller|or less|or below|or even smaller|at most|at the most)",
    },
}


def _ranked(name: str, nouns: str, compared: str, or_more: str) -> QuestionFamily:
    words = "{word}"
    predicate = f"{{rank}} {words}|{{rank}} {words}|{{{compared}}} {words}|{words} {{{or_more}}}"

    def build(bindings: Bindings, _: Numbers) -> Check:
        sign = next(value for value in bindings.values() if value in INVERSE)
        sign = INVERSE[sign] if DENIED in bindings.values() else sign
        return check_of(f"{name} {sign} {bindings['word']}", length=length_of(bindings))

    return QuestionFamily(
        name=f"{name}_rank",
        pattern=(
            f"{{lead}} ( (is|is|isn't|was) ({nouns}) {{now}} ({predicate}) [{{or_not}}] "
            f"| (is|is) ({nouns}) {{now}} ({predicate}) [{{or_not}}] "
            f"| (does|did) ({nouns}) (count|qualify|rate|class) as ({predicate}) [{{or_not}}] "
            f"| (can|could|would) (we|you|I) (call|rate|class|describe as) ({nouns}) ({predicate}) "
            f"[{{or_not}}] "
            f"| {{claim}} ({nouns}) (is|was) {{now}} ({predicate}) [{{or_not}}|{{tag}}] "
            f"| ({nouns}) {{now}} ({predicate}) [{{or_not}}|{{tag}}] "
            f"| ({nouns}) , is it ({predicate}) [{{or_not}}] "
            f"| is ({nouns}) {{not}} ({{undenied}} {words}) [{{sure}}] "
            f"| {{claim}} ({nouns}) is {{never}} ({{undenied}} {words}) [{{sure}}] "
            f"| {{false}} {{denied}} ({nouns}) is ({{undenied}} {words}) ) {{tail}} [, {{length}}]"
        ),
        build=build,
        slots={
            **_RANK_SIGNS,
            "word": {word: word for word in ORDERED[name]},
            "undenied": (
                "({rank_plain}|{deeper_plain})"
                if name == "depth"
                else "({rank_plain}|{larger_plain})"
            ),
            "rank_plain": {">": "(more than|above)", "<": "(less than|below)", ">=": "at least"},
            "deeper_plain": {">": "deeper than", "<": "shallower than"},
            "larger_plain": {">": "(larger|bigger) than", "<": "smaller than"},
        },
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    compare_family("x_above", "x", "mm", measured_pattern(_axis("x")), _SLOTS, is_signed=True),
    compare_family("y_above", "y", "mm", measured_pattern(_axis("y")), _SLOTS, is_signed=True),
    compare_family("right_by", "x", "mm", _sided("right"), _SLOTS),
    compare_family("palmwards_by", "y", "mm", _sided("palmwards"), _SLOTS),
    compare_family(
        "offset_x_above",
        "offset_x",
        "mm",
        measured_pattern(_offset("x", "horizontal|sideways|lateral", "vertical")),
        _SLOTS,
    ),
    compare_family(
        "offset_y_above",
        "offset_y",
        "mm",
        measured_pattern(_offset("y", "vertical|lengthwise", "horizontal")),
        _SLOTS,
    ),
    compare_family("sideways_by", "offset_x", "mm", _offsets("sideways"), _SLOTS),
    compare_family("lengthwise_by", "offset_y", "mm", _offsets("lengthwise"), _SLOTS),
    _ranked(
        "depth",
        "the (press|depth|indentation|contact|dent|penetration)|it|the pressing|"
        "the depth (class|level|word|category) [of {touch}]|depth|the depth of {touch}",
        "deeper",
        "or_deeper",
    ),
    _ranked(
        "area",
        "the (contact area|area|footprint|patch|contact patch|touched area|imprint)|"
        "the area (class|level|word|category) [of {touch}]|area|the area of {touch}|the print",
        "larger",
        "or_larger",
    ),
)
