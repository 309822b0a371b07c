"""Contact states in the paper's words, in numbers, and back.

The template is the paper's, section 3.2: 'a [Texture] [Shape] object, pressed [Depth] in
[Position] with [Area] contact area.' The slots hold the words of ``cltp.tactile.states`` as they
stand ('pressed slight in top-left'), not inflected, so that every slot reads back exactly. Ours,
where the paper is silent: a shape or texture that nobody named is left out ('an object, pressed
...'), 'a' becomes 'an' before a vowel, and without contact the caption is ``NO_CONTACT``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeVar

from cltp.errors import TouchError
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Area, ContactState, Depth, Position, Shape, Texture

NO_CONTACT = "no contact."

Word = TypeVar("Word", bound=StrEnum)


@dataclass(frozen=True, slots=True, kw_only=True)
class Slots:
    """What a caption says; all None for ``NO_CONTACT``."""

    texture: Texture | None = None
    shape: Shape | None = None
    depth: Depth | None = None
    position: Position | None = None
    area: Area | None = None


def slots_of(state: ContactState) -> Slots:
    """The words of a state."""
    if not state.in_contact:
        return Slots()
    return Slots(
        texture=state.texture,
        shape=state.shape,
        depth=state.depth,
        position=state.position,
        area=state.area,
    )


def caption(state: ContactState) -> str:
    """Word a state in the paper's template.

    Raises:
        TouchError: It has a depth but no position or area.
    """
    if state.depth is None:
        return NO_CONTACT
    if state.position is None or state.area is None:
        raise TouchError("a contact with a depth needs a position and an area to be worded")
    named = [str(word) for word in (state.texture, state.shape) if word is not None]
    noun = " ".join([*named, "object"])
    article = "an" if noun[0] in "aeiou" else "a"
    return (
        f"{article} {noun}, pressed {state.depth} in {state.position} "
        f"with {state.area} contact area."
    )


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


def _any_of(words: type[StrEnum]) -> str:
    longest_first = sorted((str(w) for w in words), key=len, reverse=True)
    return "|".join(re.escape(w) for w in longest_first)


_CAPTION = re.compile(
    rf"an? (?:(?P<texture>{_any_of(Texture)}) )?(?:(?P<shape>{_any_of(Shape)}) )?object, "
    rf"pressed (?P<depth>{_any_of(Depth)}) in (?P<position>{_any_of(Position)}) "
    rf"with (?P<area>{_any_of(Area)}) contact area\.?"
)


def parse_caption(text: str) -> Slots:
    """Read the slots of a caption back; case, outer space and the full stop are free.

    Raises:
        TouchError: Not in the template, or with a word outside the vocabulary.
    """
    plain = " ".join(text.lower().split())
    if plain.rstrip(".") == NO_CONTACT.rstrip("."):
        return Slots()
    found = _CAPTION.fullmatch(plain)
    if found is None:
        shown = plain if len(plain) <= 80 else plain[:77] + "..."
        raise TouchError(
            "expected 'a [texture] [shape] object, pressed [depth] in [position] with [area] "
            f"contact area.' in the words of cltp.tactile.states, got {shown!r}"
        )
    return Slots(
        texture=_word(Texture, found["texture"]),
        shape=_word(Shape, found["shape"]),
        depth=_word(Depth, found["depth"]),
        position=_word(Position, found["position"]),
        area=_word(Area, found["area"]),
    )


def _word(words: type[Word], value: str | None) -> Word | None:
    return None if value is None else words(value)
