"""Text from files and devices as a terminal may show it: without codes that steer the terminal."""

from __future__ import annotations

import re

_STEERING = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff]"
)
"""Control characters but tab and newline, marks of writing direction, and lone surrogates."""


def printable(text: str) -> str:
    """The text with a mark in the place of every character that would steer a terminal."""
    return _STEERING.sub("\N{REPLACEMENT CHARACTER}", text)
