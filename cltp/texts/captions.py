"""Captions of contact states in the paper's words, in numbers, and reading them back.

The template is the paper's, section 3.2: 'a [Texture] [Shape] object, pressed [Depth] in
[Position] with [Area] contact area.' The slots hold the words of ``cltp.tactile.states`` without
inflection ('pressed slight in top-left'), so that every slot reads back exactly. Where the paper is
silent we chose: an unknown shape or texture is left out ('an object, pressed ...'), 'a' becomes
'an' before a vowel, and without contact the caption is ``NO_CONTACT``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from cltp.errors import TouchError
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import DIMENSIONS, Area, ContactState, Depth, Position, Shape, Texture

NO_CONTACT = "no contact."


@dataclass(frozen=True, slots=True, kw_only=True)
class Slots:
    """The words of a caption; all None for ``NO_CONTACT``."""

    texture: Texture | None = None
    shape: Shape | None = None
    depth: Depth | None = None
    position: Position | None = None
    area: Area | None = None


def slots_of(state: ContactState) -> Slots:
    """The words of a state."""
    words: dict[str, Any] = {slot: getattr(state, slot) for slot in DIMENSIONS}
    return Slots(**words) if state.in_contact else Slots()


def caption(state: ContactState, rivals: Mapping[str, str] | None = None) -> str:
    """Word a state in the paper's template.

    Args:
        state: The state.
        rivals: A second word for dimensions that are in doubt: 'sphere or ellipsoid'.

    Raises:
        TouchError: It has a depth but no position or area.
    """
    if state.depth is None:
        return NO_CONTACT
    if state.position is None or state.area is None:
        raise TouchError("a contact with a depth needs a position and an area to be worded")
    words = {
        slot: f"{word} or {rivals[slot]}" if rivals and slot in rivals else str(word)
        for slot in DIMENSIONS
        if (word := getattr(state, slot)) is not None
    }
    nouns = [words[slot] for slot in ("texture", "shape") if slot in words]
    return (
        f"{with_article(' '.join([*nouns, 'object']))}, pressed {words['depth']} in "
        f"{words['position']} with {words['area']} contact area."
    )


def with_article(noun: str) -> str:
    """'an edge', 'a sphere'."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


def numeric_caption(state: ContactState, sensor: SensorSpec) -> str:
    """Word a state in numbers: mm, mm² and N, in the gel frame of ``sensor``.

    Source: the paper's limitations ask for numbers instead of words; the wording is ours.
    """
    if not state.in_contact:
        return NO_CONTACT
    area_mm2 = state.area_fraction * sensor.area_mm2
    return (
        f"pressed {state.depth_mm:.2f} mm at x {state.x_mm:+.1f} mm, y {state.y_mm:+.1f} mm, "
        f"with {area_mm2:.1f} mm² contact area and {state.force_n:.2f} N."
    )


def alternatives(words: Iterable[str]) -> str:
    """A regular expression for any of some words; of 'very deep' it does not match 'deep' alone."""
    return "|".join(re.escape(str(word)) for word in sorted(words, key=len, reverse=True))


_GROUPS = {slot: rf"(?P<{slot}>{alternatives(words)})" for slot, words in DIMENSIONS.items()}
_CAPTION = re.compile(
    "an? (?:{texture} )?(?:{shape} )?object, pressed {depth} in {position} "
    r"with {area} contact area\.?".format_map(_GROUPS)
)


def parse_caption(text: str) -> Slots:
    """Read the slots of a caption back; case, outer space and the full stop are free.

    Raises:
        TouchError: Not in the template, or with a word outside the vocabulary.
    """
    plain = " ".join(text.lower().split())
    if plain.rstrip(".") == NO_CONTACT.rstrip("."):
        return Slots()
    match = _CAPTION.fullmatch(plain)
    if match is None:
        shown = plain if len(plain) <= 80 else plain[:77] + "..."
        raise TouchError(
            "expected 'a [texture] [shape] object, pressed [depth] in [position] with [area] "
            f"contact area.' in the words of cltp.tactile.states, got {shown!r}"
        )
    words: dict[str, Any] = {
        slot: classes(match[slot]) for slot, classes in DIMENSIONS.items() if match[slot]
    }
    return Slots(**words)
