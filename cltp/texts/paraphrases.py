"""Other words for a contact than the template's: paraphrases, and prompts for each dimension.

Every text follows from the contact and a seed alone, and reads back: ``read_paraphrase`` gives the
slots that it says. The template itself, on which trained weights depend, is in
``cltp.texts.captions``; numbers with tolerances are in ``cltp.texts.tolerances``, questions in
``cltp.texts.question_answers``.
"""

from __future__ import annotations

import hashlib
import re
import struct
import zlib
from collections.abc import Mapping
from typing import Any

from cltp.errors import TouchError
from cltp.tactile.states import (
    DIMENSIONS,
    MEASURABLE,
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Texture,
)
from cltp.texts.captions import Slots

PROMPTS: Mapping[str, tuple[str, ...]] = {
    "shape": (
        "This is {a}.",
        "It is shaped like {a}.",
        "The object that touches is {a}.",
    ),
    "texture": (
        "The texture is {word}.",
        "Its surface feels {word}.",
        "The object is {word}.",
    ),
    "depth": (
        "Contact is {word}.",
        "The object is pressed {word}.",
        "The indentation is {word}.",
    ),
    "position": (
        "Contact at {word}.",
        "The object touches in {word}.",
        "The contact is {word} on the pad.",
    ),
    "area": (
        "The contact area is {word}.",
        "Contact with {a} area.",
        "{A} part of the pad is touched.",
    ),
}
"""Prompts of zero-shot classification. The first of each is the paper's (section 5.1: 'This is a
[Shape]', 'Contact is [Depth]', 'Contact at [Position]', 'etc.'), the others are for ensembles.
``{a}`` is the word with its article."""


def prompts(slot: str, word: str) -> list[str]:
    """The prompts for one class of a dimension, the paper's first.

    Raises:
        TouchError: There is no such dimension, or no such class in it.
    """
    if slot not in PROMPTS or word not in list(DIMENSIONS[slot]):
        raise TouchError(
            f"no prompt for {slot!r} {word!r}; dimensions are {', '.join(PROMPTS)}, their words "
            "those of cltp.tactile.states"
        )
    named = with_article(word)
    capital = named[0].upper() + named[1:]
    return [text.format(word=word, a=named, A=capital) for text in PROMPTS[slot]]


def with_article(noun: str) -> str:
    """'an edge', 'a sphere'."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


_SHAPES: Mapping[Shape, tuple[str, ...]] = {
    Shape.SPHERE: ("sphere", "ball"),
    Shape.ELLIPSOID: ("ellipsoid", "oval cap"),
    Shape.CUBOID: ("cuboid", "rectangular block"),
    Shape.TRIANGLE: ("triangle", "triangular block"),
    Shape.HEXAGON: ("hexagon", "hexagonal block"),
    Shape.DISC: ("disc", "flat round end"),
    Shape.PEAK: ("peak", "pointed tip"),
    Shape.PLANE: ("plane", "wide flat face"),
    Shape.CYLINDER: ("cylinder", "side of a rod"),
    Shape.RING: ("ring", "round rim"),
    Shape.CRESCENT: ("crescent", "part of a ring"),
    Shape.EDGE: ("edge", "straight edge of two faces"),
    Shape.CORNER: ("corner", "corner of three faces"),
    Shape.LINE: ("line", "narrow bar"),
    Shape.CROSS: ("cross", "pair of crossing bars"),
    Shape.STRIPES: ("set of stripes", "row of parallel bars"),
    Shape.DOTS: ("group of dots", "cluster of separate bumps"),
    Shape.WAVE: ("wave", "row of gentle waves"),
    Shape.HOLE: ("hole", "flat face around a hole"),
}
_TEXTURES: Mapping[Texture, tuple[str, ...]] = {
    Texture.SMOOTH: ("smooth", "polished"),
    Texture.ROUGH: ("rough", "coarse"),
    Texture.RIDGED: ("ridged", "finely grooved"),
    Texture.BUMPY: ("bumpy", "pimpled"),
    Texture.WOVEN: ("woven", "cross-ribbed"),
}
_DEPTHS: Mapping[Depth, tuple[str, ...]] = {
    Depth.SLIGHT: ("slightly", "lightly"),
    Depth.MODERATE: ("moderately", "somewhat"),
    Depth.DEEP: ("deeply", "far"),
    Depth.VERY_DEEP: ("very deeply", "very far"),
}
_POSITIONS: Mapping[Position, tuple[str, ...]] = {
    Position.TOP_LEFT: ("at the top left", "in the upper left corner"),
    Position.TOP_CENTER: ("at the top center", "in the upper middle"),
    Position.TOP_RIGHT: ("at the top right", "in the upper right corner"),
    Position.MIDDLE_LEFT: ("at the middle left", "on the left side"),
    Position.CENTERED: ("at the center", "in the middle of the pad"),
    Position.MIDDLE_RIGHT: ("at the middle right", "on the right side"),
    Position.BOTTOM_LEFT: ("at the bottom left", "in the lower left corner"),
    Position.BOTTOM_CENTER: ("at the bottom center", "in the lower middle"),
    Position.BOTTOM_RIGHT: ("at the bottom right", "in the lower right corner"),
}
_AREAS: Mapping[Area, tuple[str, ...]] = {
    Area.TINY: ("tiny", "very small"),
    Area.SMALL: ("small", "fairly small"),
    Area.MEDIUM: ("medium", "medium-sized"),
    Area.LARGE: ("large", "big"),
    Area.VERY_LARGE: ("very large", "very big"),
}
_WORDS: Mapping[str, Mapping[Any, tuple[str, ...]]] = {
    "texture": _TEXTURES,
    "shape": _SHAPES,
    "depth": _DEPTHS,
    "position": _POSITIONS,
    "area": _AREAS,
}

PARAPHRASES: tuple[str, ...] = (
    "{thing} is pressed {depth} {position}, with a {area} contact area.",
    "the gel is pressed in {depth} {position} by {thing}; the area in contact is {area}.",
    "{position}, {thing} sinks in {depth} and covers a {area} area.",
    "there is {thing} {position}: the contact is {area} in area, and the gel gives way {depth}.",
    "a {area} contact {position}: {thing}, pushed in {depth}.",
    "what touches {position} is {thing}; it covers a {area} part of the pad and goes in {depth}.",
)
"""Sentences with a place for each slot; ``{thing}`` is texture and shape with their article."""

NOTHING: tuple[str, ...] = (
    "nothing touches the gel.",
    "the gel is untouched.",
    "there is no contact on the pad.",
)


def text_seed(*, seed: int, series: int, depth_mm: float) -> int:
    """What a contact's texts are drawn from: the same wherever and in whichever split it is read.

    Args:
        seed: Of the contact, as it is stored.
        series: Of the contact, as it is stored.
        depth_mm: Its depth as it is stored (float32), which tells loads of one series apart.
    """
    return zlib.crc32(struct.pack("<qqf", seed, series, depth_mm))


def paraphrase(state: ContactState, seed: int) -> str:
    """One wording of a state, drawn from ``seed``; shapes and textures nobody named are left out.

    Raises:
        TouchError: The state has a depth but no position or area.
    """
    draw = _Draws(seed)
    if state.depth is None:
        return draw.of(NOTHING)
    if state.position is None or state.area is None:
        raise TouchError("a contact with a depth needs a position and an area to be worded")
    thing = [
        draw.of(_TEXTURES[state.texture]) if state.texture is not None else "",
        draw.of(_SHAPES[state.shape]) if state.shape is not None else "object",
    ]
    text = draw.of(PARAPHRASES).format(
        thing=with_article(" ".join(filter(None, thing))),
        depth=draw.of(_DEPTHS[state.depth]),
        position=draw.of(_POSITIONS[state.position]),
        area=draw.of(_AREAS[state.area]),
    )
    return re.sub(r"\ba(?= [aeiou])", "an", text)


def drawn(seed: int, what: str, count: int) -> int:
    """A number below ``count`` that follows from a seed and a name, with any library's version."""
    digest = hashlib.blake2b(f"{seed} {what}".encode(), digest_size=8).digest()
    return int.from_bytes(digest, "little") % count


class _Draws:
    """One choice after another."""

    def __init__(self, seed: int) -> None:
        self._seed = seed
        self._drawn = 0

    def of(self, choices: tuple[str, ...]) -> str:
        self._drawn += 1
        return choices[drawn(self._seed, str(self._drawn), len(choices))]


def _reading(template: str) -> re.Pattern[str]:
    pattern = re.escape(template)
    thing = rf"an? (?:(?P<texture>{_said('texture')}) )?(?:(?P<shape>{_said('shape')})|object)"
    pattern = pattern.replace(re.escape("{thing}"), thing)
    for slot in MEASURABLE:
        pattern = pattern.replace(re.escape(f"{{{slot}}}"), rf"(?P<{slot}>{_said(slot)})")
    return re.compile(re.sub(r"(?<=\\ )a(?=\\ \(\?P)", "an?", re.sub(r"^a(?=\\ )", "an?", pattern)))


def _said(slot: str) -> str:
    every = [wording for wordings in _WORDS[slot].values() for wording in wordings]
    return "|".join(re.escape(wording) for wording in sorted(every, key=len, reverse=True))


_READINGS = [_reading(template) for template in PARAPHRASES]
_MEANT = {
    slot: {wording: word for word, wordings in words.items() for wording in wordings}
    for slot, words in _WORDS.items()
}


def read_paraphrase(text: str) -> Slots:
    """The slots that a paraphrase says; case and outer space are free.

    Raises:
        TouchError: It is no sentence of ``PARAPHRASES``.
    """
    plain = " ".join(text.lower().split())
    if plain in NOTHING:
        return Slots()
    for reading in _READINGS:
        found = reading.fullmatch(plain)
        if found is not None:
            named = {s: _MEANT[s][said] for s, said in found.groupdict().items() if said}
            return Slots(**named)
    raise TouchError(
        f"expected a sentence of cltp.texts.paraphrases.PARAPHRASES, got {plain[:80]!r}"
    )
