"""Families about words that are offered, or that have an order: 'is it a ball or a box'.

Not here: what the words are called (``tacgrasp.lessons.dialogue.families.classes.words``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.families.classes import words
from tacgrasp.lessons.dialogue.families.classes.checked import (
    DENT,
    OBJECT,
    PATCH,
    PLACED,
    SURFACE,
    any_of,
    asked,
)
from tacgrasp.lessons.dialogue.meaning import Which
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    Steerer,
    length_of,
)
from tacgrasp.lessons.dialogue.patterns.phrases import check_pattern
from tacgrasp.lessons.dialogue.scene import AskedScene


def _which(name: str, *, is_open: bool) -> Callable[[Bindings, Numbers], Which]:
    return lambda bindings, _: Which(name=name, is_open=is_open, length=length_of(bindings))


def _one_of(kind: str) -> str:
    """Two or more words of a kind to choose from."""
    first, second, third = (f"{{{kind}{place}}}" for place in "123")
    return (
        f"({first} or {second}|{first} or {second}|{first} or {second}|{first} , or {second}|"
        f"either {first} or {second}|{first} or rather {second}|{first} , {second} or {third}|"
        f"{first} or {second} or {third})"
    )


def _offered(
    name: str,
    kinds: Mapping[str, words.Words],
    questions: str,
    bare: str,
    question: str,
) -> QuestionFamily:
    """Words to choose from; the answer is the true one, offered or not.

    Args:
        name: Name of a scene whose value is a word.
        kinds: Tables of words by the names that ``questions`` and ``bare`` have for them.
        questions: Questions with words to choose from.
        bare: Such words alone.
        question: What stands before or after such words alone, as a question.
    """
    return QuestionFamily(
        name=f"{name}_or",
        pattern=(
            f"{{lead}} ( {questions} | {questions} | {bare} | ({question}) (:|,) {bare} | (which "
            f"is it :|which of them :|"
            f"choose between|decide between|choose :|what fits better ,|which fits better ,|"
            f"pick one :|what would you say ,|would you say|your choice :) {bare} "
            f"| {bare} , (which [one] is it|which [one]|what is it|what would you say|what do you "
            f"think|"
            f"what fits better|which is right|which do you feel) ) {{tail}} [, {{length}}]"
        ),
        build=_which(name, is_open=False),
        slots={f"{kind}{n}": table for kind, table in kinds.items() for n in (1, 2, 3)},
        steer=_different_words(kinds),
    )


_ELSE = (
    "(or something else|or something different|or neither|or none of these|or another one|or other|"
    "or one of your other (words|classes|shapes)|or which else|or what else)"
)
_THEN = (
    "(then say what|then name it|say which then|name it then|if neither , (name|say|give) (it|the right "
    "(one|word))|if (not|neither|none) , what then|correct me if [it is] (neither|none)|correct me if "
    "neither (fits|is right)|or tell me what it is|if it is neither , say what it is)"
)


def _or_else(name: str, kinds: Mapping[str, words.Words]) -> QuestionFamily:
    """Words to choose from, with a way out."""
    bare = " | ".join(_one_of(kind) for kind in kinds)
    return QuestionFamily(
        name=f"{name}_or_else",
        pattern=(
            f"{{lead}} ( ([is it|which one is it :|do we have|would you say|do I have] ({bare})) "
            f"(, {_ELSE} [(,|?) {_THEN}]|(,|?) {_THEN}) ) {{tail}} [, {{length}}]"
        ),
        build=_which(name, is_open=name in ("shape", "texture")),
        slots={f"{kind}{n}": table for kind, table in kinds.items() for n in (1, 2, 3)},
        steer=_different_words(kinds),
    )


def _different_words(kinds: Mapping[str, words.Words]) -> Steerer:
    """Different words, so that no question reads 'a ball or a ball'."""

    def steer(_: AskedScene, __: bool, rng: np.random.Generator) -> Mapping[str, str]:
        given: dict[str, str] = {}
        for kind, table in kinds.items():
            chosen = rng.permutation(list(table))
            given |= {f"{kind}{place}": str(chosen[place - 1]) for place in (1, 2, 3)}
        return given

    return steer


def _ranks(phrases: Mapping[str, str], table: words.Words) -> dict[str, str]:
    """Phrases of a rank, by the condition without its name: '>= deep'.

    Nothing is less than the least word, nor more than the greatest.
    """
    names = list(table)
    parts = {">": names[:-1], "<": names[1:], ">=": names[1:], "<=": names[:-1]}
    return {
        f"{sign} {word}": phrases[sign].replace("WORD", table[word])
        for sign, some in parts.items()
        for word in some
    }


def _ranked(name: str, ranks: Mapping[str, str], subject: str, direct: str) -> QuestionFamily:
    """Comparisons with a word that has an order."""

    def steer(scene: AskedScene, is_yes: bool, rng: np.random.Generator) -> Mapping[str, str]:
        if scene.values()[name] is None:
            return {}
        fitting = [
            rank
            for rank in ranks
            if Expression(check_of(f"{name} {rank}").condition).evaluate(scene.values()).value
            is is_yes
        ]
        return {"rank": fitting[rng.integers(len(fitting))]} if fitting else {}

    return QuestionFamily(
        name=f"{name}_ranked",
        pattern=any_of(check_pattern(subject, "{rank}"), asked(direct)),
        build=lambda bindings, _: check_of(
            f"{name} {bindings['rank']}", length=length_of(bindings)
        ),
        slots={"rank": dict(ranks)},
        steer=steer,
    )


_DEPTH_RANKS = _ranks(
    {
        ">": "(more than WORD|deeper than WORD|beyond WORD)",
        "<": "(less than WORD|not yet WORD|not even WORD|short of WORD)",
        ">=": "(at least WORD|WORD or more|WORD or deeper|no less than WORD|already WORD)",
        "<=": "(at most WORD|no more than WORD|no deeper than WORD|WORD at most)",
    },
    words.PLAIN_DEPTHS,
)
_AREA_RANKS = _ranks(
    {
        ">": "(more than WORD|larger than WORD|bigger than WORD)",
        "<": "(less than WORD|smaller than WORD|not even WORD)",
        ">=": "(at least WORD|WORD or more|WORD or larger|no less than WORD|already WORD)",
        "<=": "(at most WORD|no more than WORD|no larger than WORD|WORD or smaller|WORD at most)",
    },
    words.PLAIN_AREAS,
)

_SHAPE_OFFER = (
    f"(is ({OBJECT})|{{ask}} whether {{thing}} is) [rather|more] ({_one_of('noun')}|"
    f"{_one_of('noun')}|"
    f"{_one_of('adjective')})|is it ({_one_of('noun')}|{_one_of('noun')}|{_one_of('adjective')})|"
    "is it more (of {noun1} or {noun2}|like {noun1} or like {noun2}|like {noun1} or {noun2})|"
    "is {thing} (shaped like|more like) {noun1} or {noun2}|is it {noun1} or is it {noun2}|"
    f"(do you feel|are we touching|are you touching|are we holding|are we gripping|do we have|"
    f"are you feeling|would you say it is|do you think it is) {_one_of('noun')}|"
    f"does {{thing}} (feel|look) [more] (like {_one_of('noun')}|like {{noun1}} or like {{noun2}}|"
    f"{_one_of('adjective')})|would you call {{thing}} {_one_of('noun')}|"
    f"({{whether}}|[{{believe}}]) it is either {{noun1}} or {{noun2}} , which [one] [is it]|"
    f"{{ask}} (if|whether) (it is|we are touching|you feel) {_one_of('noun')}|"
    f"is the (shape|form) (more {{adjective1}} or {{adjective2}}|{_one_of('adjective')})"
)
_SHAPE_BARE = f"({_one_of('bare')}|{_one_of('bare')}|{_one_of('noun')}|{_one_of('adjective')})"
_TEXTURE_OFFER = (
    f"(is ({SURFACE})|{{ask}} (if|whether) ({{thing}}|the surface) is) [rather|more] "
    f"{_one_of('word')}|"
    f"is it {_one_of('word')}|is it {{word1}} or is it {{word2}}|"
    f"does ({SURFACE}) feel [rather|more] {_one_of('word')}|does it feel {_one_of('word')}|"
    f"(do you feel|are we touching|are you touching|is it|does it have) a "
    "({word1} or a {word2}|{word1} or {word2}) (surface|texture|skin)|"
    f"would you call ({{thing}}|the surface) {_one_of('word')}|"
    f"{{ask}} (if|whether) {{thing}} feels {_one_of('word')}|"
    f"are there {{relief1}} or {{relief2}}|do you feel {{relief1}} or {{relief2}}|"
    "({whether}|[{believe}]) it is either {word1} or {word2} , which [one] [is it]"
)
_DEPTH_OFFER = (
    f"(is ({DENT})|{{ask}} (if|whether) ({DENT}) is) [rather|more] {_one_of('word')}|"
    f"is it {_one_of('word')}|is it {{word1}} or is it {{word2}}|"
    "is (it|this|that) (a {word1} or a {word2}|a {word1} or {word2}) (dent|press|contact|"
    "indentation)|"
    f"would you call (it|the dent|the press|the depth) {_one_of('word')}|"
    "is it slight , moderate , deep or very deep|does (it|{body}) press in {deeply1} or {deeply2}|"
    "is {thing} (pressed|pushed) in {deeply1} or {deeply2}|"
    "({whether}|[{believe}]) it is either {word1} or {word2} , which [one] [is it]"
)
_AREA_OFFER = (
    f"(is ({PATCH})|{{ask}} (if|whether) ({PATCH}) is) [rather|more] {_one_of('word')}|"
    "is (it|this|that) (a {word1} or a {word2}|a {word1} or {word2}) (patch|area|contact|"
    "footprint)|"
    "does {thing} (touch|cover) (a {word1} or a {word2}|a {word1} or {word2}) (patch|area)|"
    f"would you call (the area|the patch|the contact area|the footprint) {_one_of('word')}|"
    "is the (area|contact|patch) tiny , small , medium , large or very large|"
    f"(how large|how big) is the (contact|area|patch|footprint) [:|,] {_one_of('word')}|is the "
    f"area {_one_of('word')}|"
    f"(what about the area|the area|contact area|the contact patch) [:|,] {_one_of('word')}|"
    "({whether}|[{believe}]) the area is either {word1} or {word2} , which [one] [is it]"
)
_CORNERS = (
    "(top|upper) or (bottom|lower) , left or right [corner|side]|top or bottom and left or right|"
    "(left or right , and top or bottom|left or right , top or bottom)"
)
_PLACE_OFFER = (
    f"(is|is|is) ({PLACED}) ({_one_of('place')}|{_CORNERS})|is it ({_one_of('place')}|{_CORNERS})|"
    f"{{ask}} (if|whether) ({PLACED}) is {_one_of('place')}|"
    f"does {{thing}} (lie|sit|touch|press) {_one_of('place')}|"
    f"did (we|you) (touch|catch|hit) {{thing}} {_one_of('place')}|"
    f"(does {{thing}} touch|are we touching|is it touching) {_one_of('spot')}|"
    "is it {place1} or is it {place2}|{place1} or {place2}|"
    "is ({thing}|the contact|the grip) centered or (off center|off to a side|off to one side|"
    "aside)|"
    "is ({thing}|the contact) in the (middle|center) or (in a corner|at an edge|in one of the "
    "corners|"
    "towards a side)|centered or off center|(middle|center) or corner|"
    "({whether}|[{believe}]) it is either {place1} or {place2} , which [one] [is it]"
)

FAMILIES: tuple[QuestionFamily, ...] = (
    _or_else(
        "shape",
        {
            "noun": words.SHAPE_NOUNS,
            "adjective": words.SHAPE_ADJECTIVES,
            "bare": words.BARE_SHAPES,
        },
    ),
    _or_else("texture", {"word": words.TEXTURES}),
    _or_else("position", {"place": words.PLACES, "bare": words.BARE_SPOTS}),
    _ranked(
        "depth",
        _DEPTH_RANKS,
        DENT,
        "{rank} [{tag}]|would you call it {rank}|"
        "does the (depth|dent|press) count as {rank}|is the depth class {rank}",
    ),
    _ranked(
        "area",
        _AREA_RANKS,
        PATCH,
        "would you call the (area|patch) {rank}|"
        "does the (area|patch) count as {rank}|is the area class {rank}",
    ),
    _offered(
        "shape",
        {
            "noun": words.SHAPE_NOUNS,
            "adjective": words.SHAPE_ADJECTIVES,
            "bare": words.BARE_SHAPES,
        },
        _SHAPE_OFFER,
        _SHAPE_BARE,
        "what is it|what shape is it|which shape|what shape|which shape do you feel|shape|the "
        "shape|"
        "what are we touching|what do you feel",
    ),
    _offered(
        "texture",
        {"word": words.TEXTURES, "relief": words.RELIEFS_OF_MANY},
        _TEXTURE_OFFER,
        _one_of("word"),
        "what is it|how is the surface|what texture is it|which texture|texture|surface|the "
        "surface|"
        "how does it feel|how does the surface feel|what is the surface like",
    ),
    _offered(
        "depth",
        {"word": words.PLAIN_DEPTHS, "deeply": words.DEEPLY},
        _DEPTH_OFFER,
        _one_of("word"),
        "how deep is it|how deep|what depth|depth|the depth|the dent|which depth|how is the press",
    ),
    _offered(
        "area",
        {"word": words.PLAIN_AREAS},
        _AREA_OFFER,
        "(contact|area|contact area|footprint|patch) {word1} or {word2}",
        "which|what is it",
    ),
    _offered(
        "position",
        {"place": words.PLACES, "spot": words.SPOTS, "bare": words.BARE_SPOTS},
        _PLACE_OFFER,
        f"({_one_of('bare')}|{_one_of('bare')}|{_one_of('spot')}|{_CORNERS})",
        "where is it|where|where is the contact|in which corner|which part|which corner|position|"
        "the position|where do you feel it",
    ),
)
