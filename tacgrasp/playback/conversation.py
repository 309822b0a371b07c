"""Questions about one contact, one after another: the model feels it once, and reads each question.

Not here: the lines of a terminal (``tacgrasp.cli.ask``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from cltp.encoder.reader import reading_of
from cltp.llm.generation import Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.raised_pad import is_raised, raised_text
from cltp.tactile.contact.single_cloud import is_touched
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.states import NO_CONTACT_STATE
from policies.llm.spoken import SpokenContact, spoken_contact
from primitives.contract import Contract
from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.answers import Answer
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.understanding import understood_in_turn
from tacgrasp.playback.describe import RAISED, cloud_flags, zero_flags


@dataclass(frozen=True, slots=True, kw_only=True)
class Spoken:
    """The answer to a question.

    Attributes:
        answer: The answer.
        confidence: Probability that the question is understood and the answer right.
        interval: Of a number, what holds it in nine cases of ten, in its unit; None without one.
        query: What the model took the question for; '' where it came to nothing.
        flags: Why what is felt is not to be trusted, those of ``tacgrasp describe``; empty where it
            may be.
    """

    answer: Answer
    confidence: float
    interval: tuple[float, float] | None
    query: str
    flags: tuple[str, ...] = ()

    def json(self) -> dict[str, Any]:
        """The answer for programs."""
        return {
            "answer": self.answer.text,
            "kind": self.answer.kind.value,
            "value": self.answer.value,
            "unit": self.answer.unit or None,
            "interval": self.interval,
            "confidence": self.confidence,
            "decidable": self.answer.decidable,
            "query": self.query,
            "flags": list(self.flags),
        }


class Conversation:
    """Asks about one contact; a follow-up is put with the question before it.

    Of a pad that is raised all over no question is answered.

    Args:
        cloud: The contact.
        talker: The model.
        contract: Contract that questions may be about; None for none.
        mass_g: Mass of the object [g]; None where it is not known.

    Raises:
        TouchError: The gel rises where a contact would press it in, or the weights' heads have no
            intervals.
        ValueError: The contract is refused, or the mass is not above 0.
    """

    def __init__(
        self,
        cloud: TactileCloud,
        talker: Talker,
        *,
        contract: Contract | None = None,
        mass_g: float | None = None,
    ) -> None:
        self._talker = talker
        spoken = SpokenContact(NO_CONTACT_STATE, {}, {})
        self._flags: tuple[str, ...] = ()
        self._unread = f"I can't say: {raised_text(cloud)}." if is_raised(cloud) else ""
        told = AskedScene(contract=contract, mass_g=mass_g, sensor=cloud.sensor)
        if self._unread:
            self._flags = (RAISED,)
        elif is_touched(cloud):
            felt = talker.feel(encoder_input(cloud, talker.layout), cloud.force_scale)
            spoken = spoken_contact(talker, felt, cloud.sensor)
            reading = reading_of(felt.readings, cloud, talker.model.heads.contradiction)
            self._flags = (*(flag.value for flag in reading.flags), *cloud_flags(cloud))
        else:
            self._flags = tuple(zero_flags(cloud))
        self._scene = replace(told, state=spoken.state)
        self._words, self._ends = spoken.confidence, spoken.ends
        self._before = ""

    def ask(self, question: str) -> Spoken:
        """Answer a question."""
        if self._unread:
            return Spoken(
                answer=Answer(text=self._unread, kind=AnswerKind.UNKNOWABLE, decidable=False),
                confidence=1.0,
                interval=None,
                query="",
                flags=self._flags,
            )
        asked = understood_in_turn(self._talker, question, self._before)
        self._before = question
        given = answered(asked, self._scene, self._words, self._ends)
        query = "" if asked is None else asked.query
        return Spoken(
            answer=given.answer,
            confidence=given.confidence,
            interval=given.interval,
            query=query,
            flags=self._flags,
        )
