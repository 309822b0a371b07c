"""A talker that gets its input with one part left out, or swapped with another contact's."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from cltp.llm.generation import MAX_TOKENS, Reply, Talker
from cltp.tactile.point_layout import PointLayout
from policies.reply.text import REQUEST
from tacgrasp.training.ablation.touch_parts import TouchParts, mean_parts, touch_parts


class InputPart(StrEnum):
    """A part of what the model gets."""

    TOKENS = "tokens"
    READINGS = "readings"
    GOAL = "goal"


class Change(StrEnum):
    """What is done to it.

    Tokens and readings that are left out are the means over the contacts; a goal is not named.
    """

    LEFT_OUT = "left out"
    SWAPPED = "swapped"


@dataclass(frozen=True, slots=True)
class Ablation:
    """One part, changed."""

    part: InputPart
    change: Change

    @property
    def name(self) -> str:
        """In words."""
        return f"{self.part} {self.change}"


WHOLE = "whole"
"""Name of the condition without any change."""

ABLATIONS: Mapping[str, Ablation] = {
    each.name: each for each in (Ablation(part, change) for part in InputPart for change in Change)
}
"""Every ablation by its name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Donor:
    """A contact that others get a part of.

    Attributes:
        points: Shape (N, 3), scaled.
        parts: Its embeddings.
        prompt: What the model is asked about it.
    """

    points: NDArray[np.float32]
    parts: TouchParts
    prompt: str


class AblatedTalker:
    """Stands in for ``cltp.llm.generation.Talker``.

    Args:
        talker: Replies.
        ablation: What is changed; None for nothing.
        donors: Contacts to swap with, two at least.
        seed: Random seed of the swaps.

    Raises:
        ValueError: There are fewer than two donors.
    """

    def __init__(
        self, talker: Talker, ablation: Ablation | None, donors: Sequence[Donor], *, seed: int = 0
    ) -> None:
        if len(donors) < 2:
            raise ValueError(f"an ablation needs two contacts at least, got {len(donors)}")
        self._talker, self._ablation, self._donors = talker, ablation, donors
        self._mean = mean_parts([donor.parts for donor in donors])
        self._rng = np.random.default_rng(seed)

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        return self._talker.layout

    def reply(
        self,
        points: NDArray[np.float32],
        prompt: str,
        *,
        max_tokens: int = MAX_TOKENS,
        penalties: Mapping[str, float] | None = None,
        force_factor: float = 1.0,
    ) -> Reply:
        """Ask about one contact; as ``Talker.reply``, with the part changed."""
        parts = touch_parts(self._talker.model, points, force_factor)
        if self._ablation is not None:
            parts, prompt = self._changed(self._ablation, points, parts, prompt)
        return self._talker.reply_to(
            parts.whole, prompt, max_tokens=max_tokens, penalties=penalties
        )

    def _changed(
        self, ablation: Ablation, points: NDArray[np.float32], parts: TouchParts, prompt: str
    ) -> tuple[TouchParts, str]:
        other = self._other(points)
        is_swap = ablation.change is Change.SWAPPED
        if ablation.part is InputPart.GOAL:
            return parts, other.prompt if is_swap else REQUEST
        new = other.parts if is_swap else self._mean
        if ablation.part is InputPart.TOKENS:
            return parts._replace(tokens=new.tokens), prompt
        return parts._replace(readings=new.readings), prompt

    def _other(self, points: NDArray[np.float32]) -> Donor:
        """A drawn donor that is not the contact itself."""
        at = int(self._rng.integers(len(self._donors)))
        if np.array_equal(self._donors[at].points, points):
            at = (at + 1) % len(self._donors)
        return self._donors[at]
