"""Reads the model's answers and scores them against the truth, for ``tacgrasp eval``.

Not here: the wording of answers for training (``tacgrasp.lessons.questions``,
``tacgrasp.lessons.exchanges``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from cltp.tactile.states import CLASSES, ContactState, Side
from cltp.texts.captions import alternatives
from tacgrasp.lessons.questions import NOTHING

FORCE_TOLERANCE = 0.25
"""An answer about the force is right within this fraction of the force, or within
``FORCE_TOLERANCE_N``. Our choice: the depth scale of units, ±15 %, and drift allow no less."""

FORCE_TOLERANCE_N = 0.1

_NUMBER = r"([+-]?\d+(?:\.\d+)?)"
_NUMBERS = re.compile(
    rf"{_NUMBER} mm, {_NUMBER} N(?:, {_NUMBER} %, x {_NUMBER}, y {_NUMBER})?", re.ASCII
)


def read_numbers(text: str) -> Sequence[float] | None:
    """Numbers of a description in the order of ``cltp.tactile.states.NUMBERS``.

    Depth, x and y in mm, area as a fraction, force in N. None when the text has no
    numbers; position and area are 0 without a contact.
    """
    match = _NUMBERS.search(text)
    if match is None:
        return None
    depth, force, percent, x, y = (float(part or 0) for part in match.groups())
    return depth, x, y, percent / 100, force


def is_right(slot: str, text: str, state: ContactState) -> bool:
    """Whether an answer to a question about one slot of ``tacgrasp.lessons.questions`` is right.

    The words must be exactly those of the truth; a number beside them is not scored. A force must
    be right within ``FORCE_TOLERANCE``.
    """
    if not state.in_contact:
        return text == NOTHING
    if slot == "force":
        match = re.search(rf"{_NUMBER} N\b", text, re.ASCII)
        if match is None:
            return False
        error_n = abs(float(match[1]) - state.force_n)
        return error_n <= max(FORCE_TOLERANCE * state.force_n, FORCE_TOLERANCE_N)
    if slot == "cut":
        sides = {side for side in Side if re.search(rf"\b{side}\b", text)}
        is_negated = text.startswith("Not cut")
        return "cut" in text.lower() and sides == state.cut and is_negated == (not state.cut)
    return _words(slot, text) == [w for w in (getattr(state, slot),) if w is not None]


def _words(slot: str, text: str) -> list[str]:
    """Words of a slot's vocabulary in a text; 'very deep' does not also count as 'deep'."""
    pattern = alternatives(CLASSES[slot])
    return [match[0] for match in re.finditer(rf"(?<![\w-])(?:{pattern})(?![\w-])", text)]
