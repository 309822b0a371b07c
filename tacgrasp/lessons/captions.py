"""Requests for a description of a contact, and the numbers of one.

Not here: captions themselves (``cltp.texts.captions``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

CAPTION_REQUESTS: tuple[str, ...] = (
    "Describe the contact.",
    "What do you feel?",
    "Describe what touches the pad.",
    "Tell me about the contact.",
    "What is touching the sensor?",
    "Give a description of this touch.",
    "What can you feel?",
    "What is the contact like?",
    "Say what you feel.",
    "Describe this.",
)

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
