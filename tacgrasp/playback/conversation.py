"""Questions about one contact, one after another: the model feels it once, and reads each question.

Not here: the dialogue itself (``tacgrasp.lessons.turns.dialogue``), the lines of a terminal
(``tacgrasp.cli.ask``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from cltp.encoder.reader import reading_of
from cltp.llm.generation import Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.partial_pad import is_partial, partial_text
from cltp.tactile.contact.raised_pad import is_raised, raised_text
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.states import NO_CONTACT_STATE
from policies.llm.policy import flag_reason
from policies.llm.spoken import SpokenContact, spoken_contact
from primitives.contract import Contract
from tacgrasp.lessons.dialogue.answers import Answer
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.turns.dialogue import Dialogue, Said
from tacgrasp.lessons.turns.turn import next_turn
from tacgrasp.playback.describe import (
    RAISED,
    cloud_flags,
    contact_flags,
    touches,
    unadvised_text,
    zero_flags,
)

_ADVISES = re.compile(r"\baction\b|\bforce (?:within|below|above|enough)\b|band_low_n <= force_n")
"""In the queries whose answers are acted on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spoken:
    """The answer to a question about a contact.

    Attributes:
        said: The answer, with its doubt.
        flags: Why what is felt is not to be trusted, those of ``tacgrasp describe``; empty where it
            may be.
    """

    said: Said
    flags: tuple[str, ...]

    @property
    def text(self) -> str:
        """The answer in words."""
        return self.said.answer.text

    def json(self) -> dict[str, Any]:
        """The answer for programs."""
        answer = self.said.answer
        return {
            "answer": answer.text,
            "kind": answer.kind.value,
            "value": answer.value,
            "unit": answer.unit or None,
            "interval": self.said.interval,
            "confidence": self.said.confidence,
            "decidable": answer.decidable,
            "query": self.said.query,
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
        in_contact: As ``tacgrasp.playback.describe.touches`` takes it.

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
        in_contact: bool | None = None,
    ) -> None:
        spoken = SpokenContact(NO_CONTACT_STATE, {}, {})
        self._flags: tuple[str, ...] = ()
        self._unread = f"I can't say: {raised_text(cloud)}." if is_raised(cloud) else ""
        self._unadvised = ""
        is_in_contact = not self._unread and touches(cloud, in_contact)
        mass_g = None if mass_g is None else float(mass_g)
        told = AskedScene(contract=contract, mass_g=mass_g, sensor=cloud.sensor)
        if self._unread:
            self._flags = (RAISED,)
        elif is_in_contact:
            felt = talker.feel(encoder_input(cloud, talker.layout), cloud.force_scale)
            spoken = spoken_contact(talker, felt, cloud.sensor)
            reading = reading_of(felt.readings, cloud, talker.model.heads.contradiction)
            flags = [flag.value for flag in reading.flags]
            flags += contact_flags(cloud, reading.state) + cloud_flags(cloud)
            self._flags = tuple(dict.fromkeys(flags))
            self._unadvised = unadvised_text(cloud, reading.state) or flag_reason(reading)
        else:
            self._flags = tuple(zero_flags(cloud))
            if is_partial(cloud):
                self._unread = f"I can't say: {partial_text(cloud)}."
        self._dialogue = Dialogue(
            partial(next_turn, talker),
            replace(told, state=spoken.state),
            spoken.confidence,
            spoken.ends,
        )

    def ask(self, question: str) -> Spoken:
        """Answer a question."""
        if self._unread:
            unread = Answer(text=self._unread, kind=AnswerKind.UNKNOWABLE, decidable=False)
            return Spoken(said=Said(answer=unread), flags=self._flags)
        said = self._dialogue.ask(question)
        if self._unadvised and _ADVISES.search(said.query):
            text = f"{said.answer.text} But don't act on it: {self._unadvised}."
            said = replace(said, answer=replace(said.answer, text=text))
        return Spoken(said=said, flags=self._flags)
