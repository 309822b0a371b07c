"""Questions about one scene, one after another: what each means, and its answer.

Not here: what is felt (``tacgrasp.playback.conversation``), what a question means behind others
(``tacgrasp.lessons.turns.turn``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from primitives import Primitive
from primitives.errors import LimitError
from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.answers import Answer
from tacgrasp.lessons.dialogue.conditions import IN_BAND
from tacgrasp.lessons.dialogue.facts import ACTIONS, REASONS
from tacgrasp.lessons.dialogue.meaning import AnswerKind, Check, Meaning, Which, kind_of
from tacgrasp.lessons.dialogue.scene import HOLD, LIFT, AskedScene
from tacgrasp.lessons.read_question import ReadQuestion
from tacgrasp.lessons.turns.certainty import LAST, SHAPE, doubted_by
from tacgrasp.lessons.turns.follow_ups import asks_by_how_much
from tacgrasp.lessons.turns.told import not_so, with_told
from tacgrasp.lessons.turns.turn import Turn
from tacgrasp.lessons.understanding import understood_by_grammar

TurnReader = Callable[[str, Turn], Turn]
"""What a question means behind a turn: ``tacgrasp.lessons.turns.turn.next_turn`` with its model."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """The answer to a question.

    Attributes:
        answer: The answer.
        confidence: Probability that the question is understood and the answer right.
        interval: Of a number, what holds it in nine cases of ten, in its unit; None without one.
        query: What the question was taken for; '' where it came to nothing.
    """

    answer: Answer
    confidence: float = 1.0
    interval: tuple[float, float] | None = None
    query: str = ""


_HOW_MUCH = {
    Primitive.INCREASE_FORCE.value: "How far are we below the band?",
    Primitive.DECREASE_FORCE.value: "By how much is the force above the band?",
    **dict.fromkeys(
        (each.value for each in Primitive if each.value.startswith("move_")),
        "How far is it from the middle of the pad?",
    ),
}
"""What a step of the advice lacks, by its name."""

_WHY = re.compile(
    r"(?:and |but |so )?(?:why(?: not| is that| can'?t you(?: say| tell)?)?|how come)[?.! ]*", re.I
)
_WHY_SO = re.compile(r"(?:and |but |so )?why ((?:is|are|does|do|has|have) [^?]+?)[?.! ]*", re.I)
_SO = re.compile(r"\b(?:so|that|too) (?=\w+\?$)", re.I)
_LIFTING = re.compile(
    r"\b(?:lift\w*|pick\w*|ready|raise|hoist|take it up|go ahead|proceed)\b", re.I
)


class Dialogue:
    """Answers one question after another; a follow-up is put with the question before it.

    Args:
        read: What reads a question behind a turn.
        scene: What is asked about, as it is felt and said, with the contract and the mass.
        words: Probabilities of the contact's words, by dimension.
        ends: Ends of the intervals of the contact's numbers, by name.
    """

    def __init__(
        self,
        read: TurnReader,
        scene: AskedScene,
        words: Mapping[str, float] | None = None,
        ends: Mapping[str, tuple[float, float]] | None = None,
    ) -> None:
        self._read = read
        self._scene = scene
        self._words, self._ends = words, ends
        self._turn = Turn()
        self._last: Said | None = None

    def ask(self, question: str) -> Said:
        """Answer a question."""
        if said := self._certainty(question) or self._reason_of_none(question):
            return said
        if refuted := refuted_premise(question, self._scene):
            return Said(answer=refuted)
        if "?" not in question and (words := not_so(question)):
            text = f"Not noted: {words!r} tells nothing of what is held now."
            return Said(answer=Answer(text=text, kind=AnswerKind.TEXT))
        self._turn = self._read(self._in_full(question), self._turn)
        try:
            scene = self._scene_of(self._turn)
        except (ValueError, LimitError) as error:
            return Said(answer=Answer(text=f"I can't take that: {error}.", kind=AnswerKind.TEXT))
        told = self._turn.told
        has_lost_band = self._scene.contract is not None and scene.contract is None
        if told is not None and not told.is_supposed:
            self._scene = scene
        if told is not None and self._turn.read is None:
            end = ", and the band above it no longer counts" if has_lost_band else ""
            return Said(answer=Answer(text=f"Noted: {told.text}{end}.", kind=AnswerKind.TEXT))
        self._last = self._answered(question, self._turn.read, scene)
        return self._last

    def _in_full(self, question: str) -> str:
        """What 'by how much?' asks behind advice; any other question as it is."""
        about = self._turn.about
        is_step = isinstance(about, Which) and about.name == "action"
        if not (is_step and asks_by_how_much(question)):
            return question
        return _HOW_MUCH.get(action_of(self._scene), question)

    def _scene_of(self, turn: Turn) -> AskedScene:
        """The scene with what a question tells."""
        return self._scene if turn.told is None else with_told(self._scene, turn.told)

    def _answered(self, question: str, asked: ReadQuestion | None, scene: AskedScene) -> Said:
        given = answered(asked, scene, self._words, self._ends)
        answer = given.answer
        if asked is not None and advises_first(question, asked.meaning, answer, scene):
            first = f"{ACTIONS[action_of(scene)]} first: {REASONS[reason_of(scene)]}"
            answer = replace(answer, text=f"{answer.text.rstrip('.')}, but {first}.")
        return Said(
            answer=answer,
            confidence=given.confidence,
            interval=given.interval,
            query="" if asked is None else asked.query,
        )

    def _certainty(self, question: str) -> Said | None:
        """How sure the answer before is, or that for a quantity; None of other questions."""
        doubted = doubted_by(question)
        if doubted == LAST and self._last is None:
            doubted = SHAPE  # nothing was said yet: what the contact is first of all
        last = self._last if doubted == LAST else None
        if doubted and doubted != LAST:
            last = self._answered(doubted, understood_by_grammar(doubted), self._scene)
        if last is None or not last.answer.decidable or not last.confidence:
            return None
        return replace(last, answer=Answer(text=certainty_text(last), kind=AnswerKind.TEXT))

    def _reason_of_none(self, question: str) -> Said | None:
        """Why the question before had no answer; None of other questions."""
        last = self._last
        if last is None or last.answer.decidable or not _WHY.fullmatch(question.strip()):
            return None
        missing = last.answer.text.removeprefix("I can't say: ")
        reasons = {AnswerKind.OFF_TOPIC: "that is not about touch."}
        reason = reasons.get(last.answer.kind, "the touch of one fingertip does not tell it.")
        if missing != last.answer.text:
            reason = missing
        elif not last.query:
            return None  # it was not understood
        return Said(answer=Answer(text=f"Because {reason}", kind=AnswerKind.TEXT))


def certainty_text(said: Said) -> str:
    """How sure an answer is: the ends of a number, or the chances of anything else."""
    if said.interval is not None:
        unit = f" {said.answer.unit}" if said.answer.unit else ""
        low, high = (f"{end:.3g}" for end in said.interval)
        return f"In nine cases of ten it is between {low} and {high}{unit}."
    percent = f"{100 * said.confidence:.0f} %"
    if said.answer.kind is AnswerKind.YES_NO:
        return f"About {percent} sure that the answer is {'yes' if said.answer.value else 'no'}."
    claim = said.answer.text.removeprefix("Probably ")
    return f"About {percent} sure: {claim[:1].lower()}{claim[1:]}"


def refuted_premise(question: str, scene: AskedScene) -> Answer | None:
    """The answer to a question for the reason of what is not so; None of other questions."""
    found = _WHY_SO.fullmatch(question.strip())
    asked = understood_by_grammar(_SO.sub("", f"{found[1]}?")) if found else None
    if asked is None or kind_of(asked.meaning) is not AnswerKind.YES_NO:
        return None
    is_so = answered(asked, scene).answer
    if not is_so.decidable or is_so.value is not False or not is_so.text.startswith("No, "):
        return None
    return Answer(text=f"It is not so: {is_so.text.removeprefix('No, ')}", kind=AnswerKind.TEXT)


def advises_first(question: str, meaning: Meaning, given: Answer, scene: AskedScene) -> bool:
    """Whether a yes to a lift leaves out that something else is advised first."""
    is_lift = isinstance(meaning, Check) and meaning.condition == IN_BAND
    if not (is_lift and given.value is True and _LIFTING.search(question)):
        return False
    return scene.state.in_contact and action_of(scene) not in (LIFT, HOLD)


def action_of(scene: AskedScene) -> str:
    """What is advised, as a scene names it."""
    return str(scene.values()["action"])


def reason_of(scene: AskedScene) -> str:
    """Why, as a scene names it."""
    return str(scene.values()["reason"])
