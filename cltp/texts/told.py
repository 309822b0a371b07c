"""A contact as texts tell it: the true words, the numbers as they were read, the doubts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from cltp.tactile.states import ContactState


@dataclass(frozen=True, slots=True, kw_only=True)
class ToldContact:
    """What is to be told of a contact.

    Attributes:
        state: The true words, and the numbers as they were read.
        ends: Low and high end of the numbers' intervals, in the unit of each; those without one
            are told as they are.
        rivals: A second word for dimensions that are in doubt.
    """

    state: ContactState
    ends: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    rivals: Mapping[str, str] = field(default_factory=dict)
