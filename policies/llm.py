"""The policy of the paper: Tac3D-LLM feels, says D_t, and the action is read out of D_t.

Whatever goes wrong with the text ends in no action: a reply that never ends, names nothing or two
things, or is chosen with too little confidence. Instructions that the model can't have understood
are refused instead of answered.
"""

from __future__ import annotations

import math
import re
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from cltp.checkpoints.tac3d_llm import load_tac3d_llm
from cltp.llm.generation import Reply, Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input
from cltp.texts.tokenizer import Words
from policies.errors import PolicyError
from policies.extraction import Extraction, extract
from policies.observation import Observation
from policies.policy import Decision
from policies.teacher import LESSON_MOVE_STEP_MM
from primitives.primitive import PAD_DIRECTION, Primitive

ABSTAIN_BELOW = 0.3
"""Confidence under which the policy holds and asks again. Chosen on seeds below 1,000,000: at 0.5
one episode in eight ended with ``no_action``, between two answers that were both good enough."""

RELUCTANCE = {f"<{Primitive.INCREASE_FORCE}>": math.log(3.0)}
"""Nats that speak against an action: it has to be so many times likelier than what else is said.

A berry that is held too lightly can be pressed harder at the next touch, a bruise stays. Chosen on
seeds below 1,000,000.
"""

LONGEST_WORDS = 120
"""Words of an instruction; longer ones are refused, since the model would see only their ends."""

KNOWN_SHARE = 0.5
"""Share of an instruction's words that the model must know as words. Our choice: hand-written
English paraphrases have 0.8 and more, other languages below 0.3."""

_SHORT = frozenset(
    "a i an as at be by do go in is it me my no of on or so to up us we".split(" ")  # noqa: SIM905
)


class LlmPolicy:
    """Tac3D-LLM in the loop.

    Args:
        folder: Weights, as ``cltp.checkpoints.tac3d_llm`` lays them out.
        lm_folder: A Qwen2 or Qwen2.5-VL directory instead of the folder's own language model.
        abstain_below: Confidence under which nothing is done.
        clock: For the durations of the stages [s].

    Raises:
        TouchError: Weights are missing, damaged, or don't fit together.
    """

    def __init__(
        self,
        folder: Path,
        *,
        lm_folder: Path | None = None,
        abstain_below: float = ABSTAIN_BELOW,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        model = load_tac3d_llm(Path(folder), lm_folder=lm_folder)
        self._words = model.language.words
        self._talker = Talker(model, clock)
        self._folder, self._abstain_below, self._clock = folder, abstain_below, clock
        self._moves: list[Primitive] = []

    @property
    def name(self) -> str:
        """'llm'."""
        return "llm"

    @property
    def talker(self) -> Talker:
        """The model itself, for measurements of it."""
        return self._talker

    def start(self) -> None:
        """Forget the moves of the episode before."""
        self._moves = []

    def check_move_step(self, move_step_mm: float) -> None:
        """Refuse moves of another length than those that the weights were trained with.

        Raises:
            PolicyError: It is another length.
        """
        if not math.isclose(move_step_mm, LESSON_MOVE_STEP_MM, abs_tol=1e-6):
            raise PolicyError(
                f"--primitives.move-step-mm is {move_step_mm:g} mm, but the weights in "
                f"{self._folder} were trained with {LESSON_MOVE_STEP_MM:g} mm; leave it, or "
                "decide with --policy rules, which takes any step"
            )

    def check(self, text: str) -> None:
        """Refuse an instruction or question that the model can't have understood.

        Raises:
            PolicyError: As ``check_instruction``.
        """
        check_instruction(text, self._words)

    def decide(self, observation: Observation, instruction: str) -> Decision:
        """Feel, say, extract.

        Raises:
            PolicyError: The instruction is empty, too long, or in no language that it knows.
        """
        self.check(instruction)
        begin = self._clock()
        points = encoder_input(observation.cloud)
        sampled = self._clock()
        against = RELUCTANCE | dict.fromkeys(going_in_circles(self._moves), math.inf)
        reply = self._talker.reply(points, as_request(instruction), penalties=against)
        replied = self._clock()
        found = extract(reply.text)
        stages = {
            "sample": 1e3 * (sampled - begin),
            **reply.stage_ms,
            "extract": 1e3 * (self._clock() - replied),
        }
        held = held_because(reply, found, self._abstain_below)
        if not held and found.action in PAD_DIRECTION:
            self._moves.append(found.action)
        return Decision(
            text=reply.text,
            action=None if held else found.action,
            success=found.success and not held,
            reason=held or found.reason,
            confidence=reply.confidence,
            stage_ms=stages,
        )

    def ask(self, cloud: TactileCloud, question: str) -> str:
        """What the model says to any question about a contact.

        Raises:
            PolicyError: The question is empty, too long, or in no language that it knows; or the
                answer does not end.
        """
        self.check(question)
        reply = self._talker.reply(encoder_input(cloud), question)
        if not reply.ended:
            raise PolicyError(
                f"the answer did not end within {reply.num_tokens} tokens, so it is not given; "
                "ask otherwise, or train the model longer"
            )
        return reply.text


def as_request(instruction: str) -> str:
    """An instruction without the mark of a question: 'Could you pick it up?' asks for an action.

    The model answers what is marked as a question; what comes here is never one (``ask`` is for
    those).
    """
    return instruction.replace("?", ".")


def going_in_circles(moves: Sequence[Primitive]) -> frozenset[str]:
    """Moves that would only undo each other again: both of a pair, once there was one and back.

    A contact that is as long as the pad is cut at one end or the other wherever it lies. Every
    touch is judged by itself, so without this the model can go to and fro for ever.

    Args:
        moves: The moves of this episode so far.
    """
    if len(moves) < 2:
        return frozenset()
    (x, y), (back_x, back_y) = (PAD_DIRECTION[move] for move in moves[-2:])
    if (x, y) != (-back_x, -back_y):
        return frozenset()
    return frozenset(f"<{move}>" for move in moves[-2:])


def check_instruction(text: str, words: Words | None) -> None:
    """Refuse what the model can't have understood.

    Args:
        text: What a person wrote.
        words: The model's tokenizer; None for a stock checkpoint, which may know any language.

    Raises:
        PolicyError: Empty, too long, or made of words that the model does not know.
    """
    spoken = re.findall(r"[^\W\d_]+", text)
    if not spoken:
        raise PolicyError(
            f"an instruction in words is needed, got {text[:40]!r}; say what to grasp"
        )
    if len(spoken) > LONGEST_WORDS:
        raise PolicyError(
            f"the instruction has {len(spoken)} words, at most {LONGEST_WORDS} are read; shorten it"
        )
    if words is None:
        return
    known = sum(_known(word.lower(), words) for word in spoken)
    if known < KNOWN_SHARE * len(spoken):
        raise PolicyError(
            f"only {known} of {len(spoken)} words of {text[:60]!r} are known; say it in plain "
            "English, for example 'Pick the strawberry gently.'"
        )


def _known(word: str, words: Words) -> bool:
    if len(word) <= 2:
        return word in _SHORT  # pieces of longer words are tokens too
    return words.has_token(word) or words.has_token(word.capitalize())


def held_because(reply: Reply, found: Extraction, abstain_below: float) -> str:
    """Why nothing is done about a reply; empty when its action or verdict stands."""
    if not reply.ended:
        return f"the reply did not end within {reply.num_tokens} tokens"
    if reply.action is None:
        return "the reply comes to no action and no <none>"
    said = f"<{found.action}>" if found.action is not None else "<none>"
    if said != reply.action:
        return f"the text asks for {said} where {reply.action} was chosen ({found.reason})"
    if reply.confidence < abstain_below:
        return f"abstained: {reply.action} has a confidence of {reply.confidence:.2f} only"
    return ""
