"""Questions about one contact, one after another, answered by the language model.

Not here: the lines of a terminal (``tacgrasp.cli.ask``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from torch import Tensor

from cltp.llm.generation import Felt, Reply
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.point_layout import PointLayout
from cltp.texts.exchange_packing import Exchange
from policies import PolicyError
from policies.llm.text import NOTHING
from primitives.contract import Contract
from tacgrasp.lessons.dialogue.answer_values import answer_in
from tacgrasp.lessons.dialogue.answers import Answer
from tacgrasp.lessons.dialogue.families.catalogue import understand
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.question_draws import question_prompt
from tacgrasp.playback.describe import is_touched

FOLLOW_UP_WORDS = 5
"""Longest question [words] that is taken as a follow-up where the grammar has it neither alone nor
after the one before. Our choice."""

_FOLLOWS = re.compile(r"(?:and|but|then|why|how come|what about|how about|same)\b", re.I)


class Answerer(Protocol):
    """What answers; ``cltp.llm.generation.Talker`` is one."""

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        ...

    def feel(self, points: NDArray[np.float32], scale: ForceScale) -> Felt:
        """Encode one contact."""
        ...

    def reply_to(self, touch: Tensor, prompt: str) -> Reply:
        """Answer about one contact that is felt."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Spoken:
    """The model's answer to a question.

    Attributes:
        answer: Its text, and what is read out of it.
        confidence: Geometric mean of the probabilities of its tokens; None where they are not
            known, as for the answer of the contact test. It is not calibrated.
    """

    answer: Answer
    confidence: float | None

    def json(self) -> dict[str, Any]:
        """The answer for programs; a number in mm, N, percent, mm² or g."""
        return {
            "answer": self.answer.text,
            "kind": self.answer.kind.value,
            "value": self.answer.value,
            "unit": self.answer.unit or None,
            "confidence": self.confidence,
            "decidable": self.answer.decidable,
        }


class Conversation:
    """Asks about one contact; a follow-up is put with the exchange before it.

    Args:
        cloud: The contact.
        answerer: The model.
        contract: What the model is told of the contract; None for none.
        mass_g: Mass of the object [g]; None where it is not known.

    Raises:
        TouchError: The gel rises where a contact would press it in.
        ValueError: The contract is refused, or the mass is not above 0.
    """

    def __init__(
        self,
        cloud: TactileCloud,
        answerer: Answerer,
        *,
        contract: Contract | None = None,
        mass_g: float | None = None,
    ) -> None:
        self._told = AskedScene(contract=contract, mass_g=mass_g, sensor=cloud.sensor)
        self._answerer = answerer
        self._touch: Tensor | None = None
        if is_touched(cloud):
            points = encoder_input(cloud, answerer.layout)
            self._touch = answerer.feel(points, cloud.force_scale).touch
        self._before: Exchange | None = None

    def ask(self, question: str) -> Spoken:
        """Answer a question; an untouched pad answers every one.

        Raises:
            PolicyError: The answer does not end.
        """
        if self._touch is None:
            return Spoken(answer=answer_in(NOTHING), confidence=None)
        before = self._before
        if before is not None and not is_follow_up(question, before.prompt):
            before = None
        prompt = question_prompt(question, self._told, before)
        reply = self._answerer.reply_to(self._touch, prompt)
        if not reply.ended:
            raise PolicyError(
                f"the answer did not end within {reply.num_tokens} tokens, so it is not given; "
                "ask otherwise, or train the model longer"
            )
        self._before = Exchange(prompt=question, reply=reply.text)
        return Spoken(
            answer=answer_in(reply.text), confidence=mean_probability(reply.token_probabilities)
        )


def is_follow_up(question: str, before: str) -> bool:
    """Whether a question means something only after the one before it.

    One that begins as follow-ups do is; where the grammar has it neither alone nor after that one,
    a short one is taken to be.
    """
    if _FOLLOWS.match(question):
        return True
    if understand(question) is not None:
        return False
    if understand(question, before=before) is not None:
        return True
    return len(question.split()) <= FOLLOW_UP_WORDS


def mean_probability(probabilities: Sequence[float]) -> float | None:
    """Geometric mean of the probabilities of a text's tokens; None without any."""
    if not probabilities:
        return None
    least = 1e-12  # of a token that rounding left without any
    logs = [math.log(max(probability, least)) for probability in probabilities]
    return math.exp(sum(logs) / len(logs))
