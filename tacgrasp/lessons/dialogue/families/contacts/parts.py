"""Phrases for each part of a query, to be joined in a question.

Slots bind the part of a query that is asked ('amount force g'), so that any parts may be joined.
Not here: the sentences around them (``tacgrasp.lessons.dialogue.families.contacts.together``).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from itertools import permutations

import numpy as np

from tacgrasp.lessons.dialogue.families.classes import words
from tacgrasp.lessons.dialogue.meaning import Meaning
from tacgrasp.lessons.dialogue.patterns.family import Bindings, Numbers
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.lessons.dialogue.scene import AskedScene

PLACES = ("1", "2", "3")
"""Places of a question in which something may be asked."""

_MM = "(mm|millimetres)"
UNITS: Mapping[str, str] = {
    "mm": _MM,
    "µm": "(microns|micrometres|µm|thousandths of a millimetre)",
    "cm": "(cm|centimetres)",
    "N": "(newtons|N)",
    "mN": "(millinewtons|mN)",
    "g": "(grams|g)",
    "kg": "(kilograms|kg)",
    "%": "(percent|per cent|%)",
    "mm²": "(mm²|mm2|square millimetres|square mm)",
}
_UNNAMED = {"depth": "mm", "force": "N", "area": "%", "mass": "g", "holds": "g"}
"""Unit of an amount where the question names none; mm or N where it is not here."""

_ASKED_IN: Mapping[str, tuple[str, ...]] = {
    "depth": ("mm", "µm"),
    "force": ("N", "mN", "g"),
    "area": ("%", "mm²"),
    "x": ("mm",),
    "y": ("mm",),
    "distance": ("mm",),
    "mass": ("g", "kg"),
    "limit": ("N",),
    "headroom": ("N",),
    "band_low": ("N",),
    "band_high": ("N",),
    "holds": ("g",),
}
"""Units in which an amount is asked for."""

NOUNS: Mapping[str, str] = {
    "depth": "([the|its|your] ([contact|press|indentation] depth|indentation|penetration [depth])|"
    "the depth [of (the contact|{body})])",
    "force": "([the|its|your] ([contact|grip|normal] force|load|grip strength|squeeze)|"
    "the force [on {body}])",
    "area": "([the|its] ([contact] area|footprint|contact patch|size of the contact|covered area)|"
    "the area [of the contact])",
    "x": "([the] x [position|coordinate|value]|the horizontal (position|coordinate))",
    "y": "([the] y [position|coordinate|value]|the vertical (position|coordinate))",
    "distance": "(the|its) (distance (from|to) the (center|middle)|centering error|"
    "offset from the (center|middle))",
    "mass": "(the|its) (mass|weight) [of ({body}|it)]",
    "limit": "the [force|hard] limit",
    "headroom": "the (margin|distance|room|force left) to the limit",
    "band_low": "the (least|lowest|minimum) force wanted",
    "band_high": "the (most|highest|largest) force wanted",
    "holds": "the (payload|heaviest load this grip can hold)",
    "word shape": "([the|its] (shape|form|geometry|shape class|kind of shape|outline)|the shape "
    "[of {body}])",
    "word texture": "([the|its] (texture|surface texture|surface|roughness|texture class|surface "
    "class)|the texture [of {body}])",
    "choice position": "([the|its] (position|place|location|whereabouts|spot|position class|cell) "
    "|where ({body}|it) is)",
    "choice depth": "([the] (depth|indentation|press) (class|word|category|grade)|the class of the "
    "depth)",
    "choice area": "([the] (area|size|contact area|footprint) (class|word|category|grade)|the class "
    "of the (area|size))",
    "choice action": "([the] (next|best) (step|move|action)|your (advice|recommendation)|what to do "
    "[next|now])",
    "choice force_band": "([the] force (class|verdict|category)|[the] (force|grip) (against|versus|"
    "relative to|compared with) the (band|goal|range)|[the] band verdict)",
    "choice worse_axis": "(the|its) worse (axis|direction)",
}
QUESTIONS: Mapping[str, str] = {
    "depth": "(how deep (is (it|{thing}|the contact) [pressed|pressed in]|does (it|{thing}) "
    "(go|sink|reach))|"
    "what is the [contact] depth)",
    "force": "(how hard (is (it|{thing}) (held|pressed|gripped|squeezed)|are we (pressing|gripping|"
    "squeezing)|is it)|what is the [grip|contact] force|how (strong|firm|tight) is the grip|"
    "how much force is (there|on it|on the pad))",
    "area": "(how (large|big) is the (contact|footprint|contact area|area)|how much of the "
    "(pad|gel|sensor) (is covered|does it cover|is touched)|what is the [contact] area)",
    "distance": "how (far|much) (is (it|{thing}) off center|off center is (it|{thing}))",
    "mass": "(how heavy is (it|{thing})|what does (it|{thing}) weigh|how much does (it|"
    "{thing}) weigh)",
    "limit": "what is the [force|hard] limit",
    "headroom": "how (much force is left (to|below) the limit|far (are we|is it) from the limit)",
    "word shape": "((what|which) (shape|form) (is (it|{thing})|does (it|{thing}) have)|how is it "
    "shaped|what is (it|{thing}) shaped like|what is (its|the) (shape|form)|what shape do you feel)",
    "word texture": "(what texture (does (it|{thing}) have|is (it|{thing}))|how does the "
    "surface feel|"
    "what is the (surface|texture) [like]|what does it feel like|how (does|is) (its|the) (skin|"
    "texture|outside) [feel]|(what|which) surface has (it|{thing}))",
    "choice position": "(where (is|on the pad is) (it|{thing}|{touch})|where does (it|{thing}) "
    "(touch|sit|lie|press|rest)|whereabouts is (it|{thing})|in (what|which) cell is it)",
    "choice depth": "((which|what) depth (class|category|word) is it|how deep is it in words)",
    "choice area": "((which|what) (area|size) (class|category|word) is it|how (large|big) is it in "
    "words)",
    "choice action": "(what (should|shall) (I|we|the robot) do [next|now]|what next|"
    "what do you (advise|suggest|recommend)|what is the next step|what (should|must|has to|is to) "
    "be done [next|now]|which (step|move) (follows|comes next)|what now)",
    "choice force_band": "(is (the (force|grip)|it) (below , within or above|above , within or "
    "below|under , in or over|under , inside or over) the (band|range|goal)|how does the (force|"
    "grip) compare with the (band|goal)|where is the (force|grip) relative to the (band|goal))",
    "choice worse_axis": "(which axis is worse|in which direction is it further off)",
}
INDIRECT: Mapping[str, str] = {
    "depth": "(how deep (it|{thing}|the contact) (is [pressed]|goes|sinks)|what the depth is)",
    "force": "(how hard (it|{thing}) is (held|pressed|gripped)|how hard we (press|grip|"
    "squeeze) [it]|"
    "how (strong|firm|tight) the grip is|what the force is)",
    "area": "(how (large|big) the (contact|footprint|contact area) is|"
    "how much of the (pad|gel) is (covered|touched)|what the area is)",
    "distance": "how far (it|{thing}) is off center",
    "mass": "(how heavy (it|{thing}) is|what (it|{thing}) weighs)",
    "limit": "what the [force] limit is",
    "word shape": "((what|which) (shape|form) (it|{thing}) (is|has)|how it is shaped|what it is "
    "shaped like)",
    "word texture": "((what|which) texture (it|{thing}) has|how (the|its) (surface|skin|texture) "
    "(feels|is)|what the surface is like)",
    "choice position": "(where (it|{thing}|the contact) (is|sits|lies)|where it touches|in which "
    "cell it (is|sits))",
    "choice action": "(what (I|we) should do [next|now]|what (should|must|has to) be done [next]|"
    "what comes next)",
    "choice depth": "(what|which) depth class it (is|has)",
    "choice area": "(what|which) (area|size) class it (is|has)",
    "choice force_band": "(whether the (force|grip) is (below , within or above|under , in or over) "
    "the (band|goal)|how the (force|grip) compares with the (band|goal))",
}
_CHECKS: Mapping[str, str] = {
    "check force within": "(is it [already] (safe|ok|okay|fine) to lift [{body}]|(can|may) (we|I) "
    "lift (it|{thing})|is the (force|grip) (within|inside|in) the (band|range|goal)|"
    "is the grip (good|right)|are we (ready|clear) to lift)",
    "check force enough": "is (the grip|it) (held|firm|strong|tight) [tightly|firmly] enough",
    "check force above": "(is the (grip|force) too (firm|strong|high|tight)|do we squeeze too hard|"
    "is it (held|gripped) too (firmly|hard|tightly))",
    "check force below": "(is the (grip|force) too (weak|light|low|loose)|"
    "is it (held|gripped) too (lightly|loosely))",
    "check force over": "is the (force|load) (over|above|beyond) the limit",
    "check force under": "is the (force|load) (under|below|within) the limit",
    "check touched": "(is (anything|something|it) (touching|in contact|touching the (pad|gel|"
    "sensor))|"
    "is there [any] contact|are we touching (it|anything)|do you feel anything|do we have contact)",
    "check empty": "(is the (pad|gripper) empty|did we miss it|is nothing touching)",
    "check position centered": "(is it|is {thing}) [well] (centered|in the (center|middle))",
    "check cut": "(is it|is the contact|is any of it) (cut off|over the edge|hanging over the "
    "edge)",
    "check whole": "(is it (fully|wholly|completely|all)|is all of it|is the whole contact) on "
    "the (pad|sensor|gel)",
    "check slips given": "(will|would|could) (it|{thing}) (slip|fall|slide) [at this weight]",
    "check stays given": "(will|can) the grip (hold|carry|keep) it",
    "check left": "is it (on the left|left of the (center|middle))",
    "check right": "is it (on the right|right of the (center|middle))",
    **{
        f"check texture {word}": f"(is (it|the surface|its (surface|texture)) {said}|does (it|the "
        f"surface) feel {said})"
        for word, said in words.TEXTURES.items()
    },
    **{
        f"check shape {word}": f"(is (it|{{thing}}|the shape) {said}|do you feel {said})"
        for word, said in words.SHAPE_NOUNS.items()
    },
}
_CLAIMS: Mapping[str, str] = {
    "check force within": "(it is safe to lift [{body}]|(we|I) (can|may) lift (it|{thing})|"
    "the (force|grip) is (within|inside) the (band|range|goal))",
    "check force enough": "(it|the grip) is (held firmly|firm|tight|strong) enough",
    "check force above": "the (grip|force) is too (firm|strong|high|tight)",
    "check force below": "the (grip|force) is too (weak|light|low|loose)",
    "check force over": "the force is (over|above) the limit",
    "check touched": "((something|anything) (touches|is touching) [the (pad|gel|sensor)]|there "
    "is [any] contact|we touch it)",
    "check position centered": "(it|{thing}) is [well] centered",
    "check cut": "(it|the contact) is (cut off|over the edge)",
    "check whole": "(it is (fully|wholly|completely)|all of it is|the whole contact is) on the "
    "(pad|sensor)",
    "check slips given": "(it|{thing}) (will|would) (slip|fall)",
    "check stays given": "the grip (will|can) hold it",
    **{
        f"check texture {word}": f"((it|the surface|its (surface|texture)|the texture) is {said}|(it|the "
        f"surface) feels {said})"
        for word, said in words.TEXTURES.items()
    },
    **{
        f"check shape {word}": f"((it|{{thing}}|the shape) is {said}|we have {said} here)"
        for word, said in words.SHAPE_NOUNS.items()
    },
}
_HOW: Mapping[str, str] = {
    "depth": "how deep",
    "force": "how hard",
    "area": "(how large|how big)",
    "distance": "how far off center",
    "choice position": "where",
    "word shape": "(what|which) (shape|form)",
    "word texture": "(what|which) (texture|surface)",
}
"""Questions without their verb: 'how deep and how hard is it'."""

_CLASSES: Mapping[str, str] = {
    "word shape": "(shape|form)",
    "word texture": "(texture|surface)",
    "choice depth": "(depth|indentation)",
    "choice area": "(area|size|footprint|contact area)",
    "choice position": "(position|place|location)",
}
"""What has classes: 'the depth class and the area class'."""

_DEGREES: Mapping[str, str] = {
    "choice depth": "how (deep|deeply pressed)",
    "choice area": "how (large|big|extended)",
    "choice force_band": "how (firm|strong) compared with the band",
}
"""Questions for a class without their verb, asked in words."""

Part = Mapping[str, str]


def _units(phrases: Part) -> dict[str, str]:
    """Phrases by the part of a query; an amount has one for each of its units."""
    parts: dict[str, str] = {}
    for name, phrase in phrases.items():
        if name not in _ASKED_IN:
            parts[name] = phrase
            continue
        usual = _UNNAMED.get(name, _ASKED_IN[name][0])
        for unit in _ASKED_IN[name]:
            ending = f"[in {UNITS[unit]}]" if unit == usual else f"in {UNITS[unit]}"
            parts[f"amount {name} {unit}"] = f"{phrase} {ending}"
    return parts


def in_both(phrases: Part) -> dict[str, str]:
    """Phrases that ask for an amount in two units, by the parts of a query."""
    return {
        f"amount {name} {one}; amount {name} {other}": (
            f"({phrases[name]}) [both] in {UNITS[one]} and [also] [in] {UNITS[other]}"
        )
        for name in ("depth", "force", "area")
        for one, other in permutations(_ASKED_IN[name], 2)
    }


_OTHER_UNITS: Mapping[str, str] = {
    "depth mm": "(inches|thou|mils|nanometres|hundredths of a millimetre|tenths of a millimetre|"
    "metres|decimetres)",
    "force N": "(pounds|ounces|kilograms|kgf|kiloponds|dynes|kilonewtons|pounds of force|"
    "micronewtons)",
    "area mm²": "(square (inches|centimetres|cm|microns)|cm2|cm squared)",
    "distance mm": "(inches|microns|centimetres|cm|thou)",
    "mass g": "(pounds|ounces|stone|tons|milligrams|mg)",
    "limit N": "(pounds|ounces|kilograms|kgf|kiloponds|dynes)",
}
"""Units that no query has, by the amount that answers: one in a unit that is near."""


def in_other(phrases: Part) -> dict[str, str]:
    """Phrases that ask for an amount in a unit that no query has, by the part of a query."""
    return {
        f"amount {amount}": f"({phrases[amount.split()[0]]}) in {said}"
        for amount, said in _OTHER_UNITS.items()
        if amount.split()[0] in phrases
    }


_TABLES: Mapping[str, Part] = {
    "noun": _units(NOUNS),
    "asks": _units(QUESTIONS),
    "told": _units(INDIRECT),
    "is": _CHECKS,
    "if": _CLAIMS,
    "how": _units(_HOW),
    "named": {name: noun for name, noun in NOUNS.items() if name not in _ASKED_IN},
    "class": _CLASSES,
    "degree": _DEGREES,
}
SLOTS: Mapping[str, Mapping[str, str]] = {
    **{f"{kind}{place}": dict(table) for kind, table in _TABLES.items() for place in PLACES},
}
"""Tables by kind of phrase and place in the question."""


def asked(bindings: Bindings, _: Numbers) -> Meaning:
    """What the slots of a wording ask for, in their order."""
    # they are bound in the order of the text
    texts = [part for slot, part in bindings.items() if slot.rstrip("123") in ("pair", *_TABLES)]
    meaning = read_query(f"{'; '.join(dict.fromkeys(texts))}.")
    if meaning is None:
        raise ValueError(f"no meaning of {texts}")
    return meaning


def _topic(part: str) -> str:
    """What a part of a query is about: two units of an amount are about the same."""
    kind, name = part.split()[:2]
    return f"{kind} {name}"


def _drawn(
    phrases: Iterable[str], unasked: Collection[str], rng: np.random.Generator
) -> Mapping[str, str]:
    """Parts of a table by their topics, in any order; the usual unit is drawn more often."""
    by_topic: dict[str, list[str]] = {}
    for part in phrases:
        if part not in unasked:
            by_topic.setdefault(_topic(part), []).append(part)
    topics = list(by_topic)
    drawn = {}
    for index in rng.permutation(len(topics)):
        parts = by_topic[topics[index]]
        drawn[topics[index]] = [parts[0], *parts][rng.integers(len(parts) + 1)]
    return drawn


def different(_: AskedScene, __: bool, rng: np.random.Generator) -> Mapping[str, str]:
    """Different parts for the places of a question, however each of them is asked."""
    given: dict[str, str] = {}
    # grams of force beside grams of mass could not be told apart
    is_weighed = bool(rng.random() < 0.5)
    unasked = (
        {"amount force g"} if is_weighed else {"amount mass g", "amount mass kg", "amount holds g"}
    )
    for kinds in (
        ("noun", "asks", "told", "how"),
        ("named",),
        ("class",),
        ("degree",),
        ("is", "if"),
    ):
        common = set(_drawn(_TABLES[kinds[-1]], unasked, rng))
        order = sorted(_drawn(_TABLES[kinds[0]], unasked, rng), key=common.__contains__)
        for kind in kinds:
            drawn = _drawn(_TABLES[kind], unasked, rng)
            for start, place in enumerate(PLACES):
                # each place has topics of its own, so that nothing is asked twice
                own = [topic for topic in order[start :: len(PLACES)] if topic in drawn]
                given[f"{kind}{place}"] = drawn[own[rng.integers(len(own))]]
    return given
