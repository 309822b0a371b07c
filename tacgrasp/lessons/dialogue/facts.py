"""Words of answers: what is true of a scene, in short and as a clause.

Not here: whole answers (``tacgrasp.lessons.dialogue.answers``).
"""

from __future__ import annotations

from collections.abc import Mapping

from cltp.tactile.states import Shape, Side
from cltp.texts.captions import with_article
from policies.teacher import Reason
from primitives import Primitive
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import FACTS
from tacgrasp.lessons.dialogue.quantities import QUANTITIES, amount_text
from tacgrasp.lessons.dialogue.scene import HOLD, LIFT, AskedScene

NOTHING_TOUCHES = "Nothing touches the pad."
ACTIONS: Mapping[str, str] = {
    Primitive.MOVE_UP: "move up",
    Primitive.MOVE_DOWN: "move down",
    Primitive.MOVE_LEFT: "move left",
    Primitive.MOVE_RIGHT: "move right",
    Primitive.INCREASE_FORCE: "increase the force",
    Primitive.DECREASE_FORCE: "decrease the force",
    Primitive.RESET: "reset and grasp again",
    LIFT: "lift it",
    HOLD: "hold still",
}
"""Wording of each value of ``action``."""

REASONS: Mapping[str, str] = {
    Reason.NO_CONTACT: "nothing touches the pad",
    Reason.OVER_THE_EDGE: "only a sliver of it is on the pad",
    Reason.TOO_FIRM: "it is pressed too firmly",
    Reason.OFF_CENTER: "it is off center",
    Reason.CUT: "the edge of the pad cuts it",
    Reason.TOO_LIGHT: "it is held too lightly",
    Reason.BAND_TOO_NARROW: "no step fits the goal",
    Reason.GOOD: "it lies within the goal",
}
"""Wording of each value of ``reason``."""

UNMEASURED: Mapping[str, str] = {
    "band_low_n": "no force band is given",
    "band_high_n": "no force band is given",
    "limit_n": "no limit is given",
    "force_band": "no force band is given",
    "action": "no force band is given",
    "reason": "no force band is given",
    "mass_g": "no mass is given",
}
"""What is missing where a name has no value; other names are not felt."""

UNTOUCHED_NAMES = {*UNMEASURED, "contact", "gram_n", "pad_width_mm", "pad_height_mm"}
"""Names that have a meaning where nothing touches."""

FACT_OF: Mapping[str, str] = {
    **{
        quantity.truth: name
        for name, quantity in QUANTITIES.items()
        if quantity.truth.isidentifier()
    },
    "contact": "contact",
    "wholeness": "cut",
    "force_band": "force_band",
    "shape": "shape",
    "texture": "texture",
    "depth": "depth_word",
    "area": "area_word",
    "position": "position",
    "area_percent": "area",
    **{f"cut_{side}": "cut_sides" for side in Side},
}
"""The fact that tells each name of a scene, of those that have one of their own."""

_WORDS: Mapping[str, Mapping[str, str]] = {
    "side_x": {"left": "left of the middle", "right": "right of the middle"},
    "side_y": {"fingertip": "nearer to the fingertip", "palm": "nearer to the palm"},
    "force_band": {
        "below": "below the band",
        "within": "within the band",
        "above": "above the band",
    },
    "wholeness": {"cut": "the edge cuts it", "whole": "the whole of it is on the pad"},
    "worse_axis": {"horizontal": "the horizontal one", "vertical": "the vertical one"},
}


def fact(name: str, scene: AskedScene, unit: str = "") -> tuple[str, str]:
    """A fact of ``FACTS`` in short, and as a clause: '0.19 mm', 'the depth is 0.19 mm'.

    A quantity is told in ``unit``; '' for its own.
    """
    value = Expression(FACTS[name]).evaluate(scene.values()).value
    if name in QUANTITIES and isinstance(value, float):
        text = amount_text(name, value, unit or QUANTITIES[name].unit, scene)
        short = f"{name} {text}" if name in "xy" else text
        return short, f"{QUANTITIES[name].name} is {text}"
    word = str(value)
    match name:
        case "shape":
            verb = "these are" if is_plural(word) else "it is"
            return shape_noun(word), f"{verb} {shape_noun(word)}"
        case "texture":
            return word, f"the surface is {word}"
        case "depth_word":
            return word, f"the press is {word}"
        case "area_word":
            return word, f"the contact area is {word}"
        case "position":
            spot = place(word)
            return spot, f"it is {spot}"
        case "force_band":
            force = fact("force", scene)[0]
            clause = f"{force} is {_WORDS['force_band'][word]}"
            return clause, clause
        case "cut_sides":
            edges = "the edge of the pad" if word == "none" else f"the {word} edge"
            verb = "does not cut" if word == "none" else "cuts"
            clause = f"{edges.replace('edge', 'edges') if ' and ' in word else edges} "
            clause += f"{'cut' if ' and ' in word else verb} it"
            return clause, clause
        case "contact":
            touched = "something touches the pad" if value else "nothing touches the pad"
            return touched, touched
    clause = _WORDS["wholeness"][word]
    return clause, clause


def truth_in_words(truth: Expression, unit: str, scene: AskedScene) -> str:
    """The truth of a question in words, in ``unit`` where it is a number.

    It knows no wording of the question: an answer that a perfect reader of the file would give.
    """
    value = truth.evaluate(scene.values()).value
    if value is None:
        untouched = not scene.state.in_contact and not set(truth.names) <= UNTOUCHED_NAMES
        return NOTHING_TOUCHES.rstrip(".") if untouched else "I can't say"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return _worded(truth.text, value)
    return f"{value:.4f} {unit}".rstrip()


def _worded(name: str, word: str) -> str:
    """A word of a scene's name as answers have it."""
    tables = {"action": ACTIONS, "reason": REASONS, **_WORDS}
    return tables[name][word] if name in tables else word


def named(name: str, word: str, scene: AskedScene) -> tuple[str, str]:
    """A word of a name in short and as a clause."""
    facts = {"depth": "depth_word", "area": "area_word"}
    if name in ("shape", "texture", "position", *facts):
        return fact(facts.get(name, name), scene)
    if name == "action":
        clause = f"{ACTIONS[word]}: {REASONS[str(scene.values()['reason'])]}"
        return ACTIONS[word], clause
    if name == "cut_sides":
        return fact(name, scene)
    phrase = _WORDS[name][word]
    return phrase, phrase if name == "wholeness" else f"it is {phrase}"


def shape_noun(word: str) -> str:
    """A shape with its article: 'an edge', 'stripes'."""
    return word if is_plural(word) else with_article(word)


def is_plural(shape: str) -> bool:
    """Whether a shape is several things."""
    return shape in (Shape.STRIPES, Shape.DOTS)


def place(word: str) -> str:
    """A position as it stands in a sentence."""
    return word if word == "centered" else f"in the {word}"


def capital(text: str) -> str:
    """A text with a capital; the names of the axes stay small."""
    return text if text[:2] in ("x ", "y ") else f"{text[:1].upper()}{text[1:]}"
