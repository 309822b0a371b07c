"""A talker that gets its input with one part left out, or swapped with another contact's."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray
from torch import Tensor

from cltp.encoder.readings import HeadReadings
from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import NOMINAL, Felt, Reply, Talker
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.point_layout import PointLayout
from policies.llm.text import REQUEST
from tacgrasp.training.ablation.touch_parts import TouchParts, mean_tokens, touch_parts


class InputPart(StrEnum):
    """A part of what the model gets."""

    TOKENS = "tokens"
    READINGS = "readings"
    GOAL = "goal"


class Change(StrEnum):
    """What is done to it.

    Tokens that are left out are the means over the contacts, readings are said to be left out, and
    a goal is not named. Without its own goal the model's reply is free: the grammar of a step names
    the goal.
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
        self._mean = mean_tokens([donor.parts for donor in donors])
        self._rng = np.random.default_rng(seed)

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        return self._talker.layout

    @property
    def model(self) -> Tac3dLlm:
        """The model itself."""
        return self._talker.model

    def feel(
        self,
        points: NDArray[np.float32],
        scale: ForceScale = NOMINAL,
        correct: Callable[[HeadReadings], HeadReadings] | None = None,
    ) -> Felt:
        """Encode one contact; as ``Talker.feel``, with the part changed."""
        felt = self._talker.feel(points, scale, correct)
        ablation = self._ablation
        if ablation is None or ablation.part is InputPart.GOAL:
            return felt
        parts = touch_parts(self._talker.model, felt)
        other = self._other(points) if ablation.change is Change.SWAPPED else None
        if ablation.part is InputPart.TOKENS:
            parts = parts._replace(tokens=self._mean if other is None else other.parts.tokens)
        elif other is not None:
            parts = parts._replace(readings=other.parts.readings)
        else:
            parts = touch_parts(self._talker.model, felt, are_told=False)
        return replace(felt, touch=parts.whole)

    def reply_to(
        self, touch: Tensor, prompt: str, *, grammar: Grammar | None = None, **options: Any
    ) -> Reply:
        """Ask about one contact that is felt; as ``Talker.reply_to``, with the goal changed."""
        ablation = self._ablation
        if ablation is not None and ablation.part is InputPart.GOAL:
            others = [each.prompt for each in self._donors if each.prompt != prompt]
            is_swap = ablation.change is Change.SWAPPED
            other = others[int(self._rng.integers(len(others)))] if is_swap else REQUEST
            prompt, grammar = other, None
        return self._talker.reply_to(touch, prompt, grammar=grammar, **options)

    def _other(self, points: NDArray[np.float32]) -> Donor:
        """A drawn donor that is not the contact itself."""
        at = int(self._rng.integers(len(self._donors)))
        if np.array_equal(self._donors[at].points, points):
            at = (at + 1) % len(self._donors)
        return self._donors[at]
