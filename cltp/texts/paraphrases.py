"""Paraphrases of captions, and prompts for each dimension.

Every text follows from the contact and a seed alone, and ``read_paraphrase`` reads its slots back.

Not here: the template, on which trained weights depend (``cltp.texts.captions``), numbers with
tolerances (``cltp.texts.tolerances``), questions (``cltp.texts.question_answers``).
"""

from __future__ import annotations

import hashlib
import itertools
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
from cltp.texts.captions import Slots, alternatives, with_article

PROMPTS: Mapping[str, tuple[str, ...]] = {
    "shape": ("This is {a}.", "It is shaped like {a}.", "The object that touches is {a}."),
    "texture": ("The texture is {word}.", "Its surface feels {word}.", "The object is {word}."),
    "depth": ("Contact is {word}.", "The object is pressed {word}.", "The indentation is {word}."),
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


UNSEEN_PROMPTS: Mapping[str, tuple[str, ...]] = {
    "shape": ("The sensor has met {a}.", "{A} presses on the gel.", "One feels {a} here."),
    "texture": ("One feels that it is {word}.", "A {word} skin.", "To the touch it seems {word}."),
    "depth": ("The gel gives way: {word}.", "A {word} press.", "How far it sinks in: {word}."),
    "position": ("It lies {word}.", "One feels it {word} of the gel.", "Where it presses: {word}."),
    "area": ("It covers {a} patch.", "The size of the patch is {word}.", "{A} part is covered."),
}
"""Prompts in wordings that no training uses, around the words that training does use."""


def prompts(slot: str, word: str) -> list[str]:
    """The prompts for one class of a dimension, the paper's first.

    Raises:
        TouchError: No such dimension, or no such class in it.
    """
    return _worded(PROMPTS, slot, word)


def unseen_prompts(slot: str, word: str) -> list[str]:
    """Prompts for one class of a dimension in wordings that no training uses.

    Raises:
        TouchError: No such dimension, or no such class in it.
    """
    return _worded(UNSEEN_PROMPTS, slot, word)


def synonym_prompt(slot: str, word: str) -> str:
    """The paper's prompt with a synonym, which no alignment learns from, in place of the word.

    Raises:
        TouchError: No such dimension, or no such class in it.
    """
    prompts(slot, word)  # refuses other words
    synonym = _WORDINGS[slot][DIMENSIONS[slot](word)][1]
    if slot == "position":  # its synonyms bring their own preposition
        return f"Contact {synonym}."
    return PROMPTS[slot][0].format(word=synonym, a=with_article(synonym))


def _worded(texts: Mapping[str, tuple[str, ...]], slot: str, word: str) -> list[str]:
    if slot not in texts or word not in list(DIMENSIONS[slot]):
        raise TouchError(
            f"no prompt for {slot!r} {word!r}; dimensions are {', '.join(texts)}, their words "
            "those of cltp.tactile.states"
        )
    noun = with_article(word)
    capital = noun[0].upper() + noun[1:]
    return [text.format(word=word, a=noun, A=capital) for text in texts[slot]]


_WORDINGS: Mapping[str, Mapping[Any, tuple[str, ...]]] = {
    "shape": {
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
    },
    "texture": {
        Texture.SMOOTH: ("smooth", "polished"),
        Texture.ROUGH: ("rough", "coarse"),
        Texture.RIDGED: ("ridged", "finely grooved"),
        Texture.BUMPY: ("bumpy", "pimpled"),
        Texture.WOVEN: ("woven", "cross-ribbed"),
    },
    "depth": {
        Depth.SLIGHT: ("slightly", "lightly"),
        Depth.MODERATE: ("moderately", "somewhat"),
        Depth.DEEP: ("deeply", "far"),
        Depth.VERY_DEEP: ("very deeply", "very far"),
    },
    "position": {
        Position.TOP_LEFT: ("at the top left", "in the upper left corner"),
        Position.TOP_CENTER: ("at the top center", "in the upper middle"),
        Position.TOP_RIGHT: ("at the top right", "in the upper right corner"),
        Position.MIDDLE_LEFT: ("at the middle left", "on the left side"),
        Position.CENTERED: ("at the center", "in the middle of the pad"),
        Position.MIDDLE_RIGHT: ("at the middle right", "on the right side"),
        Position.BOTTOM_LEFT: ("at the bottom left", "in the lower left corner"),
        Position.BOTTOM_CENTER: ("at the bottom center", "in the lower middle"),
        Position.BOTTOM_RIGHT: ("at the bottom right", "in the lower right corner"),
    },
    "area": {
        Area.TINY: ("tiny", "very small"),
        Area.SMALL: ("small", "fairly small"),
        Area.MEDIUM: ("medium", "medium-sized"),
        Area.LARGE: ("large", "big"),
        Area.VERY_LARGE: ("very large", "very big"),
    },
}

PARAPHRASES: tuple[str, ...] = (
    "{thing} is pressed {depth} {position}, with a {area} contact area.",
    "the gel is pressed in {depth} {position} by {thing}; the area in contact is {area}.",
    "{position}, {thing} sinks in {depth} and covers a {area} area.",
    "there is {thing} {position}: the contact is {area} in area, and the gel gives way {depth}.",
    "a {area} contact {position}: {thing}, pushed in {depth}.",
    "what touches {position} is {thing}; it covers a {area} part of the pad and goes in {depth}.",
)
"""Sentences with all slots; ``{thing}`` is texture and shape with their article."""

NOTHING: tuple[str, ...] = (
    "nothing touches the gel.",
    "the gel is untouched.",
    "there is no contact on the pad.",
)


def text_seed(*, seed: int, series: int, depth_mm: float) -> int:
    """Random seed of a contact's texts, from its stored labels: independent of folder and split.

    The depth (float32) tells the contacts of one series apart.
    """
    return zlib.crc32(struct.pack("<qqf", seed, series, depth_mm))


def paraphrase(state: ContactState, seed: int) -> str:
    """One wording of a state, drawn from ``seed``; an unknown shape or texture is left out.

    Raises:
        TouchError: The state has a depth but no position or area.
    """
    numbers = itertools.count(1)

    def pick(choices: tuple[str, ...]) -> str:
        return choices[draw_index(seed, str(next(numbers)), len(choices))]

    if state.depth is None:
        return pick(NOTHING)
    if state.position is None or state.area is None:
        raise TouchError("a contact with a depth needs a position and an area to be worded")
    noun = [
        pick(_WORDINGS["texture"][state.texture]) if state.texture is not None else "",
        pick(_WORDINGS["shape"][state.shape]) if state.shape is not None else "object",
    ]
    text = pick(PARAPHRASES).format(
        thing=with_article(" ".join(filter(None, noun))),
        **{slot: pick(_WORDINGS[slot][getattr(state, slot)]) for slot in MEASURABLE},
    )
    return re.sub(r"\ba(?= [aeiou])", "an", text)


def draw_index(seed: int, name: str, count: int) -> int:
    """A number below ``count`` that follows from a seed and a name, with any library's version."""
    digest = hashlib.blake2b(f"{seed} {name}".encode(), digest_size=8).digest()
    return int.from_bytes(digest, "little") % count


def _pattern(template: str) -> re.Pattern[str]:
    groups = {
        slot: rf"(?P<{slot}>{alternatives(itertools.chain(*words.values()))})"
        for slot, words in _WORDINGS.items()
    }
    groups["thing"] = "an? (?:{texture} )?(?:{shape}|object)".format_map(groups)
    pattern = re.escape(template)
    for slot in ("thing", *MEASURABLE):
        pattern = pattern.replace(re.escape(f"{{{slot}}}"), groups[slot])
    return re.compile(re.sub(r"(?<=\\ )a(?=\\ \(\?P)", "an?", re.sub(r"^a(?=\\ )", "an?", pattern)))


_PATTERNS = [_pattern(template) for template in PARAPHRASES]
_CLASS_OF = {
    slot: {wording: word for word, wordings in words.items() for wording in wordings}
    for slot, words in _WORDINGS.items()
}


def read_paraphrase(text: str) -> Slots:
    """The slots of a paraphrase; case and outer space are free.

    Raises:
        TouchError: Not a sentence of ``PARAPHRASES``.
    """
    plain = " ".join(text.lower().split())
    if plain in NOTHING:
        return Slots()
    for pattern in _PATTERNS:
        match = pattern.fullmatch(plain)
        if match is not None:
            wordings = match.groupdict().items()
            return Slots(**{slot: _CLASS_OF[slot][each] for slot, each in wordings if each})
    raise TouchError(
        f"expected a sentence of cltp.texts.paraphrases.PARAPHRASES, got {plain[:80]!r}"
    )
