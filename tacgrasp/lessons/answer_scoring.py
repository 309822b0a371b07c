"""Read the model's answers back, and judge them against the truth; for ``tacgrasp eval``.

Not here: how answers are worded for training (``tacgrasp.lessons.questions``,
``tacgrasp.lessons.exchanges``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from cltp.tactile.states import CLASSES, ContactState, Side
from tacgrasp.lessons.questions import NOTHING

FORCE_TOLERANCE = 0.25
"""An answer about the force is right within this share of it, or within ``FORCE_TOLERANCE_N``.
Our choice: the depth scale of units, ±15 %, and drift leave about that much."""

FORCE_TOLERANCE_N = 0.1

_NUMBER = r"([+-]?\d+(?:\.\d+)?)"
_NUMBERS = re.compile(
    rf"{_NUMBER} mm, {_NUMBER} N(?:, {_NUMBER} %, x {_NUMBER}, y {_NUMBER})?", re.ASCII
)


def numbers_said(text: str) -> Sequence[float] | None:
    """``cltp.tactile.states.NUMBERS`` of a description: depth, x, y [mm], area [share], force [N].

    None when the text has none; zeros for the place and area of no contact.
    """
    found = _NUMBERS.search(text)
    if found is None:
        return None
    depth, force, percent, x, y = (float(part or 0) for part in found.groups())
    return depth, x, y, percent / 100, force


def answers_right(slot: str, text: str, state: ContactState) -> bool:
    """Whether an answer to a question about one slot of ``tacgrasp.lessons.questions`` is right.

    Words have to be exactly those of the truth; a number beside them is not judged. Forces have to
    be right within ``FORCE_TOLERANCE``.
    """
    if not state.in_contact:
        return text == NOTHING
    if slot == "force":
        found = re.search(rf"{_NUMBER} N\b", text, re.ASCII)
        if found is None:
            return False
        off = abs(float(found[1]) - state.force_n)
        return off <= max(FORCE_TOLERANCE * state.force_n, FORCE_TOLERANCE_N)
    if slot == "cut":
        sides = {side for side in Side if re.search(rf"\b{side}\b", text)}
        denied = text.startswith("Not cut")
        return text.lower().find("cut") >= 0 and sides == state.cut and denied == (not state.cut)
    return _words(slot, text) == [w for w in (getattr(state, slot),) if w is not None]


def _words(slot: str, text: str) -> list[str]:
    """Every word of a slot's vocabulary in a text; of 'very deep' only that, not also 'deep'."""
    longest_first = sorted(CLASSES[slot], key=len, reverse=True)
    pattern = "|".join(re.escape(word) for word in longest_first)
    return [found[0] for found in re.finditer(rf"(?<![\w-])(?:{pattern})(?![\w-])", text)]
