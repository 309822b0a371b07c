"""Families about words, checked and denied: shape, texture, depth, area and place.

Not here: what the words are called (``tacgrasp.lessons.dialogue.families.classes.words``), words that
are offered (``class_offers``), open questions (``classes``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.classes import words
from tacgrasp.lessons.dialogue.meaning import Check
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    Steerer,
    length_of,
)
from tacgrasp.lessons.dialogue.patterns.phrases import (
    check_pattern,
    denied_pattern,
)
from tacgrasp.lessons.dialogue.scene import AskedScene

_PAD = "(pad|gel|sensor|finger|fingertip)"
SURFACE = (
    "the (surface|texture|skin|finish|outside) [of {body}]|{thing}|{thing}|"
    "the (touched|pressed) (surface|side|part)|what (we|you) (feel|are touching)"
)
OBJECT = (
    "{thing}|{thing}|the (shape|form) [of {body}]|the [contact] (shape|geometry)|"
    f"the (thing|object) (on|against) the {_PAD}|what (we|you) (feel|are touching)|"
    f"what (touches|is touching) the {_PAD}"
)
DENT = (
    "it|the (press|depth|indentation|contact|touch|dent|imprint|penetration)|"
    "the (contact|press) depth|the (dent|indentation) in the gel|the dent that {thing} makes"
)
PATCH = (
    "the (contact area|area|footprint|contact|patch|imprint|contact patch|contact spot)|"
    "the (touched|covered) (area|part|patch)|the (area|footprint) of the (contact|touch)"
)
PLACED = "{thing}|{touch}|the (contact point|touch point|pressed spot)|the (grip|press) on {body}"


def _checked(name: str, slots: Mapping[str, words.Words]) -> Callable[[Bindings, Numbers], Check]:
    """A check of the word that a slot has bound."""
    return lambda bindings, _: check_of(
        f"{name} {next(bindings[slot] for slot in slots if slot in bindings)}",
        length=length_of(bindings),
    )


def _denied(name: str, slots: Mapping[str, words.Words]) -> Callable[[Bindings, Numbers], Check]:
    return lambda bindings, _: check_of(
        f"{name} {next(bindings[slot] for slot in slots if slot in bindings)}",
        denied=True,
        length=length_of(bindings),
    )


def _steered(name: str, slots: Mapping[str, words.Words], *, denied: bool) -> Steerer:
    """The scene's own word for a yes, another one for a no; the other way round when denied."""

    def steer(scene: AskedScene, is_yes: bool, rng: np.random.Generator) -> Mapping[str, str]:
        word = scene.values()[name]
        if word is None:
            return {}
        others = [other for other in CLASSES[name] if other != word]
        chosen = str(word) if is_yes != denied else others[rng.integers(len(others))]
        return dict.fromkeys(slots, chosen)

    return steer


def _checks(
    name: str,
    slots: Mapping[str, words.Words],
    subject: str,
    predicate: str,
    direct: str,
    said: str,
) -> QuestionFamily:
    """Questions whether a word is so.

    Args:
        name: Name of a scene whose value is a word.
        slots: Tables of its words.
        subject: What is spoken of.
        predicate: What comes after 'is'.
        direct: Other questions, without their question mark.
        said: Other statements, to be confirmed.
    """
    return QuestionFamily(
        name=f"{name}_is",
        pattern=any_of(
            check_pattern(subject, predicate), asked(direct), asked(direct), asked(_said(said))
        ),
        build=_checked(name, slots),
        slots=slots,
        steer=_steered(name, slots, denied=False),
    )


def _denials(
    name: str, slots: Mapping[str, words.Words], subject: str, predicate: str, direct: str
) -> QuestionFamily:
    return QuestionFamily(
        name=f"not_{name}_is",
        pattern=any_of(denied_pattern(subject, predicate), asked(direct)),
        build=_denied(name, slots),
        slots=slots,
        steer=_steered(name, slots, denied=True),
    )


_BUT_IT_IS = "(, is it|, does it|, or is it|, or does it|, or is it after all)"


def _tagged(
    name: str, slots: Mapping[str, words.Words], subject: str, predicate: str, verb: str = ""
) -> QuestionFamily:
    """Denied statements with a question behind them, which asks whether it is so."""
    others = f"| ({subject}) (does not|doesn't) {verb} {_BUT_IT_IS}" if verb else ""
    return QuestionFamily(
        name=f"{name}_tagged",
        pattern=(
            f"{{lead}} [{{believe}}] ( ({subject}) (is not|isn't|is never|was not) ({predicate}) "
            f"{_BUT_IT_IS} {others} | not ({predicate}) , is it ) {{tail}}"
        ),
        build=_checked(name, slots),
        slots=slots,
        steer=_steered(name, slots, denied=False),
    )


def any_of(*patterns: str) -> str:
    """One of some patterns."""
    return " | ".join(patterns)


def asked(questions: str) -> str:
    """Questions with what may stand before and after them."""
    return f"{{lead}} ( {questions} ) {{tail}} [, {{length}}]"


def _said(clause: str) -> str:
    """A statement to be confirmed, or after 'whether'."""
    return f"({{whether}}|[{{believe}}]) ({clause}) [{{tag}}]"


_SHAPE_SLOTS = {
    "shape": words.SHAPE_NOUNS,
    "shaped": words.SHAPE_ADJECTIVES,
    "bare": words.BARE_SHAPES,
    "many": words.SHAPES_OF_MANY,
}
_TEXTURE_SLOTS = {
    "texture": words.TEXTURES,
    "likeness": words.TEXTURE_LIKENESSES,
    "relief": words.RELIEFS,
    "reliefs": words.RELIEFS_OF_MANY,
}
_DEPTH_SLOTS = {
    "depth": words.DEPTHS,
    "dent": words.DENTS,
    "deeply": words.DEEPLY,
    "barely": words.BARELY,
}
_AREA_SLOTS = {"area": words.AREAS, "patch": words.PATCHES}
_PLACE_SLOTS = {"position": words.PLACES, "spot": words.SPOTS, "bare": words.BARE_SPOTS}

_NO_PLACE_SLOTS = {**_PLACE_SLOTS, "aside": words.ASIDE, "missed": words.MISSED}

_BY_LIST = (
    "((in the sense of|by|going by|according to|in terms of) your (word list|list of words|own scale|"
    "scale|classes|own words|classification))"
)
_DENT_NOUN = "(dent|press|indentation|imprint|touch|contact|impression|indent)"
_PATCH_NOUN = "(patch|area|spot|footprint|contact|contact area|contact patch|imprint)"

_SHAPE_PREDICATE = (
    "{shape}|{shape}|{shape}|{shaped}|like {shape}|shaped like {shape}|in the shape of {shape}"
)
_SHAPE_DIRECT = (
    "does {thing} (feel|look|seem) (like {shape}|{shaped})|does it (feel|look) like {shape}|"
    "does {thing} have the (shape|form) of {shape}|has {thing} the shape of {shape}|"
    f"do (you|we) (feel|sense|detect|have|recognise) {{shape}} [there|on the {_PAD}]|"
    f"is there {{shape}} (on|against|in|pressed into|touching|under) the {_PAD}|is there {{shape}}|"
    "are (we|you) (touching|holding|gripping|feeling|pressing) {shape}|"
    f"is {{shape}} (touching|pressing on|pressed into|on) the {_PAD}|"
    "(did (we|you) (touch|hit|catch|grip)|have (we|you) (touched|caught|hit)) {shape}|"
    f"does {{shape}} (touch|press on) the {_PAD}|would you (say|call) (it|this|that) [is] "
    f"{{shape}}|"
    "(could|might|can) (it|this|that) be {shape}|(is|was) that {shape} (I feel|we feel|we hit)|"
    "{shape} [{tag}]|{shape} , or not|is {thing} {shape} or not|{bare} [{tag}]|{bare}|"
    "{shaped} [{tag}]|is it {shaped} where it touches|is it {bare} shaped|is the (contact|object) {bare}-shaped|"
    "are (these|they|those) {many}|do (you|we) feel {many}|are there {many} [on the pad]|any {many}"
)
_SHAPE_SAID = (
    "{thing} (feels like|looks like|has the shape of|resembles|seems to be|must be) {shape}|"
    "(we are|you are) (touching|holding|gripping|feeling) {shape}|there is {shape} on the pad|"
    "you (feel|have|hold) {shape}|the shape is that of {shape}"
)
_SHAPE_DENIED = (
    "is {thing} (something other than|anything but|anything other than) {shape}|"
    "(can|could|may) (we|I|you) (rule out|exclude) {shape}|so not {shape}|so it is no {bare}|"
    "(not {shape}|no {bare}) (, right|, is that right|, am I right)|"
    "is it (certainly|definitely|really|surely) not {shape}|is it no {bare}|"
    "({whether}|[{believe}]) {thing} (does not|doesn't) (feel|look) like {shape} [{tag}]|"
    "({whether}|[{believe}]) {thing} is (no {bare}|not at all {shaped}) [{tag}]"
)
_TEXTURE_PREDICATE = (
    "{texture}|{texture}|{texture}|(rather|quite|fairly|pretty) {texture}|{texture} to the touch|"
    "{texture} all over"
)
_TEXTURE_DIRECT = (
    f"does ({SURFACE}) feel ({{texture}}|{{texture}}|{{likeness}}) [to you|to the touch]|"
    "does it feel ({texture}|{likeness})|does {thing} have (a {texture} (surface|skin|finish)|"
    "{relief})|"
    "has {thing} (a {texture} (surface|skin)|{relief})|has {thing} got {relief}|"
    "is it a {texture} (surface|texture|finish|one)|is {thing} {texture} on the (surface|outside)|"
    "(do|can) (you|we) (feel|sense|detect) ({relief}|[any] {reliefs}) [on {thing}|there|on the "
    "surface]|"
    "are there [any] {reliefs} [on ({thing}|the surface)]|any {reliefs} [there|on the surface]|"
    "is the (texture|surface|skin) {texture} or not|"
    "would you call (it|{body}|the surface) {texture}|are we touching a {texture} (surface|thing)|"
    "a {texture} (surface|texture|skin|finish) [{tag}]|{texture} [{tag}]|{texture}|"
    "{texture} surface|feels ({texture}|{likeness}) [{tag}]|{texture} to the touch [{tag}]|how "
    "about {reliefs}"
)
_TEXTURE_SAID = (
    "({thing}|the surface) feels ({texture}|{likeness})|there are {reliefs}|"
    "{thing} has (a {texture} (surface|skin)|{relief})|it is a {texture} surface|"
    "you feel {relief}|we are touching a {texture} (surface|thing)|the texture seems {texture}"
)
_TEXTURE_DENIED = (
    f"is ({SURFACE}) (anything but|something other than|other than) {{texture}}|"
    "(can|could|may) (we|I|you) (rule out|exclude) {relief}|are there no {reliefs} [on ({thing}|"
    "the surface)]|"
    "so not {texture}|not {texture} (, right|, is that right|, am I right)|not {texture}|"
    "({thing}|the surface) is not {texture} at all|no {reliefs}|no {reliefs} , right|"
    "is it (certainly|definitely|surely) not {texture}|is ({thing}|the surface) free of {reliefs}|"
    "({whether}|[{believe}]) ({thing}|the surface) (does not|doesn't) feel {texture} [{tag}]|"
    "({whether}|[{believe}]) there are no {reliefs} [{tag}]|"
    "({whether}|[{believe}]) {thing} has no {reliefs} [{tag}]"
)
_DEPTH_DIRECT = (
    f"[is it|is that|is this] [a] {{depth}} {_DENT_NOUN} , {_BY_LIST}|"
    f"is (it|this|that) {{dent}} {_DENT_NOUN}|{{dent}} {_DENT_NOUN} [{{tag}}]|{{dent}} "
    f"{_DENT_NOUN}|"
    f"is there {{dent}} {_DENT_NOUN}|do (we|you) (have|feel|see) {{dent}} {_DENT_NOUN}|"
    f"does {{thing}} (make|leave) {{dent}} {_DENT_NOUN}|"
    "is {thing} (pressed|pushed|sunk|squeezed|pressing) (in|into the (gel|pad|skin)) {deeply}|"
    "is {thing} {barely} (pressed|pushed|sunk) (in|into the (gel|pad|skin))|"
    "does {thing} (press|sink|dig|push|bite|go|dent) in {deeply}|"
    "does {thing} (press|sink|dig|push|bite) {deeply} into the (gel|pad|skin)|"
    "does {thing} dent the (gel|pad|skin) {deeply}|"
    "is the (gel|pad|skin) (dented|indented|pressed in|pushed in|deformed) {deeply}|"
    "is the (gel|pad|skin) {barely} (dented|indented|pressed in|pushed in)|"
    "has {thing} sunk in {deeply}|did {thing} sink in {deeply}|did we press {thing} in {deeply}|"
    "would you (call|rate) (it|the depth|the dent|this) [as] {depth}|{depth} [{tag}]|{depth}|"
    "is the depth {depth} or not|does (it|the depth) count as {depth}|is the depth class {depth}"
)
_DEPTH_SAID = (
    f"(it|this|that) is {{dent}} {_DENT_NOUN}|there is {{dent}} {_DENT_NOUN}|"
    "{thing} is (pressed|pushed|sunk) in {deeply}|{thing} (presses|sinks|digs|goes) in {deeply}|"
    "the gel is (dented|indented|pressed in) {deeply}"
)
_DEPTH_DENIED = (
    "is (it|the depth|the press|the dent) (anything but|something other than|other than) {depth}|"
    f"not {{dent}} {_DENT_NOUN} [, right]|is (it|this) not {{dent}} {_DENT_NOUN}|"
    "not {depth} (, right|, is that right|, am I right)|not {depth}|so not {depth}|"
    "is {thing} not (pressed|pushed|sunk) in {deeply}|"
    f"({{whether}}|[{{believe}}]) it is not {{dent}} {_DENT_NOUN} [{{tag}}]|"
    "({whether}|[{believe}]) {thing} is not (pressed|pushed) in {deeply} [{tag}]|"
    "({whether}|[{believe}]) the depth is (anything but|other than) {depth} [{tag}]"
)
_AREA_DIRECT = (
    f"[is it|is that|is this] [a] {{area}} {_PATCH_NOUN} , {_BY_LIST}|"
    f"is (it|this|that) {{patch}} {_PATCH_NOUN}|{{patch}} {_PATCH_NOUN} [{{tag}}]|"
    f"{{patch}} {_PATCH_NOUN}|is there {{patch}} {_PATCH_NOUN}|"
    f"do (we|you) (have|feel|see|get) {{patch}} {_PATCH_NOUN}|does {{thing}} (make|have|leave) "
    f"{{patch}} {_PATCH_NOUN}|does {{thing}} (touch|cover|press on) {{patch}} (patch|area|part|"
    f"spot) "
    f"[of the {_PAD}]|is {{patch}} (patch|area|part) [of the {_PAD}] (touched|covered|in contact)|"
    f"(are|do) we (touching|touch) {{patch}} (patch|area|spot)|is the contact {{area}} in area|"
    "would you (call|rate) (the area|the contact area|the patch|the footprint) [as] {area}|"
    "is the (area|patch) {area} or not|does the area count as {area}|is the area class {area}|"
    "{area} (area|contact|patch|footprint|contact area) [{tag}]|"
    "is the (size|extent) of the (contact|contact patch|footprint|imprint) {area}|"
    "is the contact {area} in size"
)
_AREA_SAID = (
    f"(it|this|that) is {{patch}} {_PATCH_NOUN}|there is {{patch}} {_PATCH_NOUN}|"
    f"{{thing}} (touches|covers) {{patch}} (patch|area|part) of the {_PAD}|"
    f"we have {{patch}} {_PATCH_NOUN}"
)
_AREA_DENIED = (
    "is (the area|the contact area|the patch|the footprint) (anything but|other than) {area}|"
    "so (the area|the patch|the contact) is not {area}|"
    "({whether}|[{believe}]) it is not a {area} (patch|area|contact|footprint) [{tag}]|"
    "is it not a {area} (patch|area|contact|footprint)|"
    "not a {area} (patch|area|contact|footprint) [, right|, is that right]|"
    "({whether}|[{believe}]) the area is (anything but|other than) {area} [{tag}]"
)
_PLACE_PREDICATE = (
    "{position}|{position}|{position}|(located|placed|sitting|touching) ((in|at) {spot}|{position})"
)
_PLACE_DIRECT = (
    "does {thing} (lie|sit|rest|touch|press|land|push) {position}|"
    "(did|does) {thing} (touch|hit|land on|press on|press against|cover) {spot}|"
    "is {thing} (touching|pressing|pressing on|pressing against|on) {spot}|"
    "is {spot} (touched|pressed|in contact|being touched|being pressed|loaded)|"
    "did (we|you|the fingers) (touch|hit|grab|catch|grip) {thing} {position}|"
    "(have (we|you) got|do (we|you) (hold|grip)) {thing} {position}|are we {position}|"
    "do (you|we) (feel|sense|touch|have) (it|{thing}|something|a contact|the contact) {position}|"
    "is there (a contact|contact|a touch|a press|something|pressure) {position}|"
    "is the (position|location|place|contact point) {spot}|is the [contact] position {bare}|"
    "is {spot} where (it|{thing}) (is|touches)|is (something|anything) (touching|pressing) {spot}|"
    "{position} [{tag}]|{bare} [{tag}]|{bare}|{spot} [{tag}]|is {thing} {position} or not|"
    "are we (touching|pressing) {spot}|did we (hit|touch) {spot}"
)
_PLACE_SAID = (
    "{thing} (lies|sits|rests|touches|presses|landed) {position}|"
    "{thing} (touches|is touching|presses on|hits) {spot}|the contact [point] is {position}|"
    "we (hit|touched|are touching) {spot}|the position is {spot}|we (hold|grip) {thing} {position}|"
    "{spot} is (touched|pressed)|you feel {thing} {position}"
)
_PLACE_DENIED = (
    "is {thing} {aside}|is the (contact|grip|touch) {aside}|are we {aside}|{aside} [{tag}]|{aside}|"
    "(does|did) {thing} (lie|sit|touch|land|press) {aside}|do we hold {thing} {aside}|"
    "did (we|you) miss {missed}|have (we|you) missed {missed}|is {thing} outside {missed}|"
    "is ({thing}|the contact) (somewhere other than|anywhere but|elsewhere than) {position}|"
    "not {position} (, right|, is that right|, am I right)|not {position}|not {spot}|"
    "({whether}|[{believe}]) ({thing}|the contact|the grip) is {aside} [{tag}]|"
    "({whether}|[{believe}]) {thing} (does not|doesn't) (lie|sit|touch|press) {position} [{tag}]|"
    "({whether}|[{believe}]) we (missed|have missed) {missed} [{tag}]|"
    "({whether}|[{believe}]) {spot} is not touched [{tag}]"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    _checks("shape", _SHAPE_SLOTS, OBJECT, _SHAPE_PREDICATE, _SHAPE_DIRECT, _SHAPE_SAID),
    _checks("texture", _TEXTURE_SLOTS, SURFACE, _TEXTURE_PREDICATE, _TEXTURE_DIRECT, _TEXTURE_SAID),
    _checks("depth", _DEPTH_SLOTS, DENT, "{depth}", _DEPTH_DIRECT, _DEPTH_SAID),
    _checks("area", _AREA_SLOTS, PATCH, "{area}", _AREA_DIRECT, _AREA_SAID),
    _checks("position", _PLACE_SLOTS, PLACED, _PLACE_PREDICATE, _PLACE_DIRECT, _PLACE_SAID),
    _denials(
        "shape",
        _SHAPE_SLOTS,
        OBJECT,
        "{shape}|{shape}|{shaped}|shaped like {shape}",
        _SHAPE_DENIED,
    ),
    _tagged(
        "shape",
        _SHAPE_SLOTS,
        OBJECT,
        "{shape}|{shape}|{shaped}|shaped like {shape}",
        "(feel|look) (like {shape}|{shaped})",
    ),
    _tagged(
        "texture",
        _TEXTURE_SLOTS,
        SURFACE,
        "{texture}|a {texture} (surface|texture|one|finish)",
        "feel {texture}",
    ),
    _tagged("depth", _DEPTH_SLOTS, DENT, "{depth}|{dent} (dent|press|one)"),
    _tagged("area", _AREA_SLOTS, PATCH, "{area}|{patch} (patch|area|one)"),
    _tagged("position", _PLACE_SLOTS, PLACED, "{position}", "(sit|lie) {position}"),
    _denials("texture", _TEXTURE_SLOTS, SURFACE, "{texture}", _TEXTURE_DENIED),
    _denials("depth", _DEPTH_SLOTS, DENT, "{depth}", _DEPTH_DENIED),
    _denials("area", _AREA_SLOTS, PATCH, "{area}", _AREA_DENIED),
    _denials("position", _NO_PLACE_SLOTS, PLACED, "{position}", _PLACE_DENIED),
)
