"""Requests for a description of a contact, and the numbers of one.

Not here: captions themselves (``cltp.texts.captions``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from cltp.tactile.states import NUMBERS

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

NUMBER = r"[+-]?\d+(?:\.\d+)?"
"""Pattern of a number as captions write it."""

_FIGURE = r"\d+(?:\.\d+)?"
_UNITS = {"depth_mm": r" mm(?![²\w])", "force_n": r" N\b", "area_fraction": " %"}
_ALONE = rf"(?<![\d.-])({NUMBER})"
_PATTERNS: Mapping[str, re.Pattern[str]] = {
    **{name: re.compile(_ALONE + unit, re.ASCII) for name, unit in _UNITS.items()},
    "x_mm": re.compile(rf"\bx ({NUMBER})", re.ASCII),
    "y_mm": re.compile(rf"\by ({NUMBER})", re.ASCII),
}
_RANGES: Mapping[str, re.Pattern[str]] = {
    name: re.compile(rf"({_FIGURE})-({_FIGURE}){unit}", re.ASCII) for name, unit in _UNITS.items()
}


def numbers_by_name(text: str) -> dict[str, float]:
    """Every number of a description, by its name out of ``cltp.tactile.states.NUMBERS``.

    Depth, x and y in mm, area as a fraction, force in N; of each the first in the text. An
    interval is no number.
    """
    matches = {name: pattern.search(text) for name, pattern in _PATTERNS.items()}
    numbers = {name: float(match[1]) for name, match in matches.items() if match is not None}
    if "area_fraction" in numbers:
        numbers["area_fraction"] /= 100
    return numbers


def ranges_by_name(text: str) -> dict[str, tuple[float, float]]:
    """Low and high end of every interval of a description, by name, in the units of numbers."""
    matches = {name: pattern.search(text) for name, pattern in _RANGES.items()}
    scale = {"area_fraction": 0.01}
    return {
        name: (scale.get(name, 1.0) * float(match[1]), scale.get(name, 1.0) * float(match[2]))
        for name, match in matches.items()
        if match is not None
    }


def read_numbers(text: str) -> Sequence[float] | None:
    """The same in the order of ``cltp.tactile.states.NUMBERS``.

    None when the text lacks depth or force; position and area are 0 without a contact.
    """
    numbers = numbers_by_name(text)
    if not {"depth_mm", "force_n"} <= numbers.keys():
        return None
    return [numbers.get(name, 0.0) for name in NUMBERS]
