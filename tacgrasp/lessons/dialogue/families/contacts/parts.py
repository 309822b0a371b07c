"""Phrases for each part of a query, to be joined in a question.

Slots bind the part of a query that is asked ('amount force g'), so that any parts may be joined.
Not here: the sentences around them (``tacgrasp.lessons.dialogue.families.contacts.together``).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from itertools import permutations

import numpy as np

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
    "word shape": "([the|its] (shape|form|geometry)|the shape [of {body}])",
    "word texture": "([the|its] (texture|surface texture|surface|roughness)|the texture [of "
    "{body}])",
    "choice position": "([the|its] (position|place|location|whereabouts)|where ({body}|it) is)",
    "choice depth": "the depth (class|word|category)",
    "choice area": "the area (class|word|category)",
    "choice action": "(the (next|best) (step|move|action)|your (advice|recommendation)|what to do "
    "[next|now])",
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
    "word shape": "(what shape (is (it|{thing})|does (it|{thing}) have)|how is it shaped|"
    "what is (its|the) shape)",
    "word texture": "(what texture (does (it|{thing}) have|is (it|{thing}))|how does the "
    "surface feel|"
    "what is the (surface|texture) [like]|what does it feel like)",
    "choice position": "(where (is|on the pad is) (it|{thing}|{touch})|where does it touch)",
    "choice depth": "which depth class is it",
    "choice area": "which area class is it",
    "choice action": "(what (should|shall) (I|we|the robot) do [next|now]|what next|"
    "what do you (advise|suggest|recommend)|what is the next step)",
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
    "word shape": "(what shape (it|{thing}) (is|has)|how it is shaped)",
    "word texture": "(what texture (it|{thing}) has|how the surface feels)",
    "choice position": "(where (it|{thing}|the contact) is|where it touches)",
    "choice action": "what (I|we) should do [next|now]",
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
    "check texture smooth": "is (it|the surface) smooth",
    "check texture rough": "is (it|the surface) rough",
    "check shape sphere": "is it (a sphere|a ball)",
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
}
_HOW: Mapping[str, str] = {
    "depth": "how deep",
    "force": "how hard",
    "area": "(how large|how big)",
    "distance": "how far off center",
    "choice position": "where",
    "word shape": "what shape",
}
"""Questions without their verb: 'how deep and how hard is it'."""

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


_TABLES: Mapping[str, Part] = {
    "noun": _units(NOUNS),
    "asks": _units(QUESTIONS),
    "told": _units(INDIRECT),
    "is": _CHECKS,
    "if": _CLAIMS,
    "how": _units(_HOW),
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
    for kinds in (("noun", "asks", "told", "how"), ("is", "if")):
        common = set(_drawn(_TABLES[kinds[-1]], unasked, rng))
        order = sorted(_drawn(_TABLES[kinds[0]], unasked, rng), key=common.__contains__)
        for kind in kinds:
            drawn = _drawn(_TABLES[kind], unasked, rng)
            for start, place in enumerate(PLACES):
                # each place has topics of its own, so that nothing is asked twice
                own = [topic for topic in order[start :: len(PLACES)] if topic in drawn]
                given[f"{kind}{place}"] = drawn[own[rng.integers(len(own))]]
    return given
