"""Families about words: shape, texture, depth, area and place, open, offered and checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    Steerer,
    length_of,
)
from tacgrasp.lessons.dialogue.families.phrases import (
    amount_pattern,
    check_pattern,
    denied_pattern,
)
from tacgrasp.lessons.dialogue.meaning import Check, Which
from tacgrasp.lessons.dialogue.scene import AskedScene

SHAPES = {
    word: (word if word in ("dots", "stripes") else f"{'an' if word[0] in 'aeiou' else 'a'} {word}")
    for word in CLASSES["shape"]
}
SHAPES |= {
    "sphere": "(a sphere|a ball|spherical|a spherical thing)",
    "ellipsoid": "(an ellipsoid|ellipsoidal|an ellipsoidal thing)",
    "cuboid": "(a cuboid|a box|a cuboid block)",
    "cylinder": "(a cylinder|cylindrical|a rod)",
    "triangle": "(a triangle|triangular)",
    "hexagon": "(a hexagon|hexagonal)",
    "disc": "(a disc|a round disc)",
    "peak": "(a peak|a sharp peak)",
    "plane": "(a plane|a flat plane)",
}
TEXTURES = {word: word for word in CLASSES["texture"]}
DEPTHS = {word: word for word in CLASSES["depth"]}
AREAS = {word: word for word in CLASSES["area"]}
PLACES = {
    word: (
        "(in the (center|middle)|centered|well centered)"
        if word == "centered"
        else f"(in|at) the {word.replace('-', ' ')} (part|cell|field)"
        if word.startswith("middle")
        else f"(in|at) the {word.replace('-', ' ')} [of the pad|corner|cell]"
    )
    for word in CLASSES["position"]
}


def _which(name: str, *, is_open: bool) -> Callable[[Bindings, Numbers], Which]:
    return lambda bindings, _: Which(name=name, is_open=is_open, length=length_of(bindings))


def _checked(name: str, *, denied: bool) -> Callable[[Bindings, Numbers], Check]:
    return lambda bindings, _: check_of(
        f"{name} {bindings[name]}", denied=denied, length=length_of(bindings)
    )


def _steered(name: str, *, denied: bool) -> Steerer:
    """The scene's own word for a yes, another one for a no; the other way round when denied."""

    def steer(scene: AskedScene, is_yes: bool, rng: np.random.Generator) -> Mapping[str, str]:
        word = scene.values()[name]
        if word is None:
            return {}
        others = [other for other in CLASSES[name] if other != word]
        return {name: str(word) if is_yes != denied else others[rng.integers(len(others))]}

    return steer


def _open(name: str, subject: str, direct: str, indirect: str, noun: str) -> QuestionFamily:
    return QuestionFamily(
        name=name,
        pattern=amount_pattern(direct, indirect, noun, ""),
        build=_which(subject, is_open=subject in ("shape", "texture")),
    )


def _checks(
    name: str,
    words: dict[str, str],
    subject: str,
    predicate: str,
    *,
    denied: bool = False,
) -> QuestionFamily:
    pattern = denied_pattern if denied else check_pattern
    return QuestionFamily(
        name=f"not_{name}_is" if denied else f"{name}_is",
        pattern=pattern(subject, predicate),
        build=_checked(name, denied=denied),
        slots={name: words},
        steer=_steered(name, denied=denied),
    )


def _offered(name: str, words: Mapping[str, str], subject: str, verb: str = "is") -> QuestionFamily:
    """Two or more words to choose from; the answer is the true one, offered or not."""
    one = f"({'|'.join(dict.fromkeys(words.values()))})"
    return QuestionFamily(
        name=f"{name}_or",
        pattern=(
            f"{{lead}} ( ({verb} ({subject})|{{ask}} whether ({subject}) {verb}) [rather|more] {one} "
            f"or {one} "
            f"| (which is it :|choose between|is it more|would you rather say|what fits better ,|)"
            f"{one} [, {one}] (or|and) {one} | would you call ({subject}) {one} or {one} ) "
            f"{{tail}} [, {{length}}]"
        ),
        build=_which(name, is_open=False),
    )


_SURFACE = "the (surface|texture|skin|finish) [of {body}]|{body}"
_OBJECT = "{thing}|the (shape|contact|form) [of {body}]"
_PLACED = "{thing}|{touch}"

FAMILIES: tuple[QuestionFamily, ...] = (
    _open(
        "shape",
        "shape",
        "what shape (is {thing}|does {thing} have|do you feel|touches the pad)|"
        "which shape (is it|is {thing}|does {thing} have|do you feel)|"
        "what is the shape of {thing}|what (form|geometry) (does {thing} have|is {thing}|do you feel)|"
        "what kind of shape (is it|is {thing}|touches the (pad|gel))|how is {thing} shaped",
        "what shape {thing} (is|has)|which shape (you feel|{thing} has|touches the pad)|"
        "what the shape of {thing} is|what (form|geometry) {thing} has|how {thing} is shaped",
        "the [contact] (shape|form|geometry) [of {thing}]|the kind of shape [of {thing}]",
    ),
    _open(
        "texture",
        "texture",
        "what is the (texture|surface) [of {body}] [like]|what texture (is {thing}|does {thing} have|"
        "do you feel)|which texture (is it|is {thing}|does {thing} have|do you feel)|"
        "how does the surface [of {body}] feel|what does the surface [of {body}] feel like|"
        "what kind of (surface|texture) (is it|is {thing}|does {thing} have)|"
        "how does {thing} feel|what does {thing} feel like on the surface",
        "what the (texture|surface) [of {body}] is [like]|what texture {thing} has|"
        "which texture (you feel|{thing} has)|how the surface [of {body}] feels|"
        "what kind of (surface|texture) {thing} has",
        "the [surface] texture [of {body}]|the (surface|relief|roughness) [of {body}]|"
        "the kind of surface",
    ),
    _open(
        "depth_word",
        "depth",
        "in words, how deep is ({touch}|{body})|how would you (describe|classify|rate) the depth|"
        "which [class of] depth is (it|this)|which depth class (is it|does {touch} have)|"
        "what word describes the depth|is it slight, moderate, deep or very deep|"
        "what is the (depth class|class of the depth)",
        "in words how deep {touch} is|which depth class (it is|{touch} has)|"
        "how you would (describe|classify|rate) the depth",
        "the depth (class|word|category|level) [of {touch}]|the (class|category) of the depth|"
        "the depth in words|the depth as a word",
    ),
    _open(
        "area_word",
        "area",
        "in words, how large is the (contact|contact area|footprint)|"
        "how would you (describe|classify|rate) the [contact] area|which area class is (it|this)|"
        "is the area tiny, small, medium, large or very large|what word describes the area|"
        "what is the (area class|class of the area)",
        "in words how large the (contact|footprint) is|which area class it is|"
        "how you would (describe|classify|rate) the area",
        "the area (class|word|category|level) [of {touch}]|the (class|category) of the area|"
        "the area in words|the area as a word",
    ),
    _open(
        "position",
        "position",
        "where is ({touch}|{body})|where does {thing} touch [the pad|the gel]|"
        "where (on|in which part of) the (pad|gel|sensor) is {thing}|"
        "in which part of the (pad|gel|sensor) (is {thing}|does {thing} touch)|"
        "what is the position [of {touch}|of {body}]|where do you feel {thing}|"
        "which part of the (pad|gel|sensor) is touched|at which place is {thing}|"
        "whereabouts is {thing}|in which (cell|corner) is {thing}",
        "where ({touch}|{body}) is|where {thing} touches [the pad|the gel]|where you feel {thing}|"
        "in which part of the (pad|gel|sensor) {thing} is|what the position of {thing} is|"
        "which part of the (pad|gel|sensor) is touched",
        "the (position|place|location|whereabouts) [of ({touch}|{body})]|the contact position|"
        "the part of the pad that is touched",
    ),
    _checks("shape", SHAPES, _OBJECT, "{shape}|like {shape}|shaped like {shape}"),
    _checks("texture", TEXTURES, _SURFACE, "{texture}|rather {texture}"),
    _checks("depth", DEPTHS, "the (press|depth|indentation|contact)|the dent", "{depth}"),
    _checks("area", AREAS, "the (contact area|area|footprint|contact|patch)", "{area}"),
    _checks("position", PLACES, _PLACED, "{position}"),
    _checks("shape", SHAPES, _OBJECT, "{shape}|shaped like {shape}", denied=True),
    _checks("texture", TEXTURES, _SURFACE, "{texture}", denied=True),
    _checks(
        "depth",
        DEPTHS,
        "the (press|depth|indentation|contact|dent)",
        "{depth}",
        denied=True,
    ),
    _checks("area", AREAS, "the (contact area|area|footprint|patch)", "{area}", denied=True),
    _checks("position", PLACES, _PLACED, "{position}", denied=True),
    _offered("shape", SHAPES, _OBJECT),
    _offered("texture", TEXTURES, _SURFACE),
)
