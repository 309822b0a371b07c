"""The policy of the paper: Tac3D-LLM generates D_t from a cloud, and the action is read out of D_t.

The model is asked for the step's target and answers in the grammar of D_t (``policies.llm``). A
draft of the reply, from what the heads read and the teacher's advice on it, saves time and changes
nothing in 32 bits. A step leads to no action where what is felt can't be trusted
(``cltp.encoder.reader``), or where the model has too low a confidence.
"""

from __future__ import annotations

import copy
import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import torch

from cltp.checkpoints.tac3d_llm import load_tac3d_llm
from cltp.encoder.reader import Flag, TouchReading, reading_of
from cltp.encoder.readings import HeadReadings
from cltp.llm.generation import Felt, Reply, Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.measure import contact_state
from cltp.tactile.states import NO_CONTACT_STATE, NUMBERS
from policies.contract_steps import pressed_too_far, refuted
from policies.errors import PolicyError
from policies.extraction import Extraction, extract
from policies.llm.grammar import step_grammar
from policies.llm.question_check import check_question
from policies.llm.spoken import caption_reply
from policies.llm.text import (
    advice_text,
    contact_text,
    goal_text,
    said_numbers,
    step_request,
)
from policies.observation import Observation, is_impossible
from policies.policy import Decision
from policies.teacher import (
    LESSON_MOVE_STEP_MM,
    SLIVER_FRACTION,
    Advice,
    Reason,
    force_goal,
    teacher,
)
from primitives.contract import Band, Contract
from primitives.primitive import PAD_DIRECTION, Primitive
from primitives.sense import Interval

ABSTAIN_BELOW = 0.3
"""Confidence below which the policy does nothing and is asked again. Chosen on seeds below
1,000,000: at 0.5 one episode in eight ended with ``no_action``, undecided between good answers."""

READABLE = 0.97
"""Probability that anything touches, as the heads read it, from which they read a contact that is
felt by test. Source: 309 observations of fruit with taxels; nine in ten of their places are within
0.8 mm above 0.995, within 1.2 mm from 0.97 on, 2.9 mm from 0.9 on and 7.8 mm below 0.5. Measured
directly it is 0.3 mm throughout."""

_FORCE = NUMBERS.index("force_n")
_LESS = f"<{Primitive.DECREASE_FORCE}>"


class SaidStep(NamedTuple):
    """A step of the model.

    Attributes:
        felt: The contact as the model feels it.
        reading: What is read of it.
        reply: D_t.
        stage_ms: Measured durations of the stages [ms], by name.
    """

    felt: Felt
    reading: TouchReading
    reply: Reply
    stage_ms: dict[str, float]


class LlmPolicy:
    """Tac3D-LLM in the loop.

    Args:
        folder: Folder of weights in the layout of ``cltp.checkpoints.tac3d_llm``.
        lm_folder: Folder of a Qwen2 or Qwen2.5-VL model; None takes the one in ``folder``.
        abstain_below: Confidence below which no action is taken.
        clock: Clock for the durations of the stages [s].

    Raises:
        TouchError: Weights are missing or damaged, or belong to different models.
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
        self._has_reset = False
        self._says_readings = True

    @property
    def name(self) -> str:
        return "llm"

    @property
    def talker(self) -> Talker:
        """The model itself, for benchmarks and evaluation."""
        return self._talker

    def start(self) -> None:
        self._moves, self._has_reset = [], False

    def through(self, talker: Talker, *, says_readings: bool = True) -> LlmPolicy:
        """A policy that asks ``talker``, with a memory of its own.

        Args:
            talker: The model.
            says_readings: Whether what is read decides what D_t may say: its numbers, and which
                side of the target the force is on. Without it every word of D_t is the model's.
        """
        other = self.twin()
        other._talker, other._says_readings = talker, says_readings
        return other

    def twin(self) -> LlmPolicy:
        """A policy for another robot: the same model, and a memory of its own."""
        other = copy.copy(self)
        other.start()
        return other

    def check_move_step(self, move_step_mm: float) -> None:
        """Refuse moves of a length that the weights were not trained with.

        Raises:
            PolicyError: The length [mm] differs; the message names both.
        """
        if not math.isclose(move_step_mm, LESSON_MOVE_STEP_MM, abs_tol=1e-6):
            raise PolicyError(
                f"--primitives.move-step-mm is {move_step_mm:g} mm, but the weights in "
                f"{self._folder} were trained with {LESSON_MOVE_STEP_MM:g} mm; leave it, or "
                "decide with --policy rules, which takes any step"
            )

    def check(self, text: str) -> None:
        """Refuse a question that the model can't read.

        Raises:
            PolicyError: As for ``policies.llm.question_check.check_question``.
        """
        check_question(text, self._words)

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """Encode the cloud, generate D_t for the contract's target and read the action out of it.

        Raises:
            LimitError: The contract is refused.
            TouchError: The weights' heads have no intervals.
        """
        terms = contract.terms
        state = contact_state(observation.cloud, in_contact=observation.in_contact)
        if too_far := pressed_too_far(contract, observation.felt_force_n, state):
            return _as_measured(too_far, Primitive.DECREASE_FORCE)
        against = refuted(contract, observation.felt_force_n, state)
        barred = [f"<{action or 'none'}>" for action in against]
        return self.follow(observation, terms.force_n, terms.limit_n, barred)

    def follow(
        self,
        observation: Observation,
        force_n: Band,
        limit_n: float,
        barred: Sequence[str] = (),
        request: str | None = None,
    ) -> Decision:
        """Decide for a target.

        Args:
            observation: What is felt.
            force_n: The target [N].
            limit_n: Force that is never exceeded [N].
            barred: Tokens of actions that what is felt refutes; the most probable other is taken.
            request: What the model is asked; ``policies.llm.text.step_request`` when not given.
        """
        said = self.say(observation, force_n, limit_n, barred, request)
        replied = self._clock()
        reply, felt = said.reply, observation.felt_force_n
        extraction = extract(reply.text)
        flags = flag_reason(said.reading)
        if unread := unread_reason(said.reading, observation.in_contact):
            return self._directly(unread, observation, force_n, barred, reply)
        # What presses all over, or where nothing is measured, can't be felt.
        is_unfelt = bool({Flag.RAISED, Flag.PARTIAL} & set(said.reading.flags))
        if flags and not is_unfelt and felt is not None and felt.value < force_n.low:
            return by_felt_force(flags, felt, force_n)
        is_deep = set(said.reading.flags) == {Flag.RANGE}  # felt directly, it still has a force
        if is_deep and felt is not None and felt.value > force_n.high and _LESS not in barred:
            return by_felt_force(flags, felt, force_n)
        hold = flags or hold_reason(reply, extraction, self._abstain_below)
        if not hold:
            self._remember(extraction.action)
        return Decision(
            text=reply.text,
            action=None if hold else extraction.action,
            success=extraction.success and not hold,
            reason=hold or extraction.reason,
            confidence=reply.confidence,
            stage_ms={**said.stage_ms, "extract": 1e3 * (self._clock() - replied)},
        )

    def _remember(self, action: Primitive | None) -> None:
        """Remember an action that is taken; a reset goes back to before all moves."""
        self._has_reset = action is Primitive.RESET
        if self._has_reset:
            self._moves.clear()
        elif action in PAD_DIRECTION:
            self._moves.append(action)

    def _directly(
        self,
        unread: str,
        observation: Observation,
        force_n: Band,
        barred: Sequence[str],
        reply: Reply,
    ) -> Decision:
        """The teacher's decision on a contact that the model can't read, as it is measured.

        Args:
            unread: Why the model can't read it.
            observation: What is felt.
            force_n: The target [N].
            barred: Tokens of actions that what is felt refutes.
            reply: What the model said to it, which is not acted on.
        """
        state = contact_state(observation.cloud, in_contact=observation.in_contact)
        if is_impossible(state.force_n, observation.commanded_force_n):
            # it is the gel's drift: a reset takes the untouched gel anew, a firmer grip shows more
            known_n = observation.commanded_force_n or 0.0
            state = replace(state, force_n=known_n) if self._has_reset else NO_CONTACT_STATE
        if self._has_reset:  # a sliver at the edge is where the last reset has put it
            state = replace(state, area_fraction=max(state.area_fraction, SLIVER_FRACTION))
        goal = force_goal(force_n)
        advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
        if advice.reason is Reason.OFF_CENTER:  # whatever the model has moved for before
            self._moves.clear()
        if f"<{advice.action}>" in repeated_moves(self._moves):  # it is as central as it can be
            state = replace(state, x_mm=0.0, y_mm=0.0, cut=frozenset())
            advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
        reason = f"{unread}; measured directly: {advice.reason}"
        if f"<{advice.action or 'none'}>" in barred:
            return Decision(text=reply.text, action=None, success=False, reason=reason)
        self._remember(advice.action)
        return Decision(
            text=f"{reason[0].upper()}{reason[1:]}. {advice_text(advice)}",
            action=advice.action,
            success=advice.success,
            reason=reason,
        )

    def say(
        self,
        observation: Observation,
        force_n: Band,
        limit_n: float,
        barred: Sequence[str] = (),
        request: str | None = None,
    ) -> SaidStep:
        """What is felt and said, before anything is decided; arguments as for ``follow``."""
        begin = self._clock()
        cloud = observation.cloud
        points = encoder_input(cloud, self._talker.layout)
        sampled = self._clock()
        directly = partial(with_felt_force, felt=observation.felt_force_n)
        felt = self._talker.feel(points, cloud.force_scale, directly)
        read_from = self._clock()
        commanded_n = observation.commanded_force_n
        contradiction = self._talker.model.heads.contradiction
        reading = reading_of(felt.readings, cloud, contradiction, commanded_force_n=commanded_n)
        numbers = numbers_as_read(reading)
        advice = teacher(reading.state, force_goal(force_n), move_step_mm=LESSON_MOVE_STEP_MM)
        draft = drafted(reading, numbers, force_n, advice)
        excluded = [*repeated_moves(self._moves), *barred]
        is_missed = advice.action is Primitive.RESET and not self._has_reset
        if observation.in_contact and not is_missed:
            excluded.append(f"<{Primitive.RESET}>")  # it would end where it began
        if self._says_readings:
            excluded += denied(reading, force_n)
        grammar = step_grammar(
            cloud.sensor, force_n, excluded, numbers=numbers if self._says_readings else None
        )
        read = self._clock()
        reply = self._talker.reply_to(
            felt.touch,
            request or step_request(force_n, limit_n),
            grammar=grammar,
            draft=draft,
        )
        stages = {
            "sample": 1e3 * (sampled - begin),
            **felt.stage_ms,
            "read": 1e3 * (read - read_from),
            **reply.stage_ms,
        }
        return SaidStep(felt, reading, reply, stages)

    def read(self, cloud: TactileCloud) -> TouchReading:
        """What the encoder's heads read of a contact, of which nothing is said."""
        felt = self._talker.feel(encoder_input(cloud, self._talker.layout), cloud.force_scale)
        return reading_of(felt.readings, cloud, self._talker.model.heads.contradiction)

    def describe(self, cloud: TactileCloud, *, doubt: bool = True) -> str:
        """The model's caption of a contact, with its numbers.

        Args:
            cloud: The contact.
            doubt: Whether a word that is in doubt is said with its rival, and a number that is not
                well known as its interval.
        """
        felt = self._talker.feel(encoder_input(cloud, self._talker.layout), cloud.force_scale)
        return caption_reply(self._talker, felt, cloud.sensor, doubt=doubt, ranges=doubt).text


def numbers_as_read(reading: TouchReading) -> dict[str, str]:
    """Texts of the numbers of a contact that is read; none where nothing touches."""
    if not reading.state.in_contact:
        return {}
    ends = {name: (number.low, number.high) for name, number in reading.numbers.items()}
    return said_numbers(reading.state, ends)


def drafted(
    reading: TouchReading, numbers: Mapping[str, str], force_n: Band, advice: Advice
) -> str:
    """The reply that is expected: what the heads read, and the teacher's advice on it."""
    contact = contact_text(reading.state, numbers)
    return f"{contact} {goal_text(force_n)} {advice_text(advice)}"


def with_felt_force(readings: HeadReadings, felt: Interval | None) -> HeadReadings:
    """Readings of one contact with the force as it is felt directly.

    The target of a step follows from that force (``policies.contract_steps.TargetTracker``), so
    that both err alike: with the heads' own force, as good by itself, one grip in twenty bruises.
    Where the two contradict each other, as on contacts that the pad's edge cuts, the heads' force
    is kept.

    Args:
        readings: A batch of one.
        felt: The force that is felt directly [N]; None where there is none.
    """
    force, low, high = (float(ends[0, _FORCE]) for ends in readings[3:])
    if felt is None or min(felt.value, force) <= 0 or felt.high < low or high < felt.low:
        return readings
    factor = torch.ones(readings.values.shape[1])
    factor[_FORCE] = felt.value / force
    values, low_ends, high_ends = (factor * ends for ends in readings[3:])
    return readings._replace(values=values, low=low_ends, high=high_ends)


def denied(reading: TouchReading, force_n: Band) -> tuple[str, ...]:
    """Tokens of actions that go against the force as it is read.

    Which side of the target a force is on is read, not guessed: the model decides between a move,
    a new grasp and the one action on the force that is left. Read as a text of digits, one force in
    fifteen was taken for another one, and one grip in twenty bruised or slipped.

    Args:
        reading: What is read of the contact.
        force_n: Target of the step [N].
    """
    if not reading.state.in_contact:
        return ()
    more, less, enough = "<increase_force>", "<decrease_force>", "<none>"
    if reading.state.force_n < force_n.low:
        return less, enough
    if reading.state.force_n > force_n.high:
        return more, enough
    return more, less


def flag_reason(reading: TouchReading) -> str:
    """Why what is felt is not acted on; '' where it may be."""
    if not reading.flags:
        return ""
    return f"what is felt can't be trusted: {', '.join(reading.flags)}"


def unread_reason(reading: TouchReading, in_contact: bool | None) -> str:
    """Why the model can't read a contact that is felt by test; '' where it can.

    Other flags stand for a cloud that lies outside of what was learned from; then what is measured
    directly can't be trusted either.
    """
    if not in_contact or set(reading.flags) - {Flag.UNSURE}:
        return ""
    if reading.contact < READABLE:
        return "the contact is too light to be read"
    return flag_reason(reading)


def by_felt_force(flags: str, felt: Interval, force_n: Band) -> Decision:
    """The decision on a contact that can't be read, and whose felt force is off the target.

    Below it goes on with the approach, whose force is felt directly: a firmer contact can be read.
    Above, one that is too deep to be read is let go of.
    """
    is_below = felt.value < force_n.low
    side = f"below {force_n.low:.2f}" if is_below else f"above {force_n.high:.2f}"
    action = Primitive.INCREASE_FORCE if is_below else Primitive.DECREASE_FORCE
    return _as_measured(f"{flags}; {felt.value:.2f} N is felt directly, {side} N", action)


def _as_measured(reason: str, action: Primitive) -> Decision:
    """The decision for an action on what is measured, without the model."""
    text = f"{reason[0].upper()}{reason[1:]}. Action: <{action}>."
    return Decision(text=text, action=action, success=False, reason=reason)


def repeated_moves(moves: Sequence[Primitive]) -> frozenset[str]:
    """Action tokens of two opposite moves, if these were the last two of the episode.

    A contact as long as the pad is always cut by one of its edges. The model decides each step on
    its own, so without this it could move to and fro for ever.

    Args:
        moves: Moves of this episode so far.
    """
    if len(moves) < 2:
        return frozenset()
    (x, y), (back_x, back_y) = (PAD_DIRECTION[move] for move in moves[-2:])
    if (x, y) != (-back_x, -back_y):
        return frozenset()
    return frozenset(f"<{move}>" for move in moves[-2:])


def hold_reason(reply: Reply, extraction: Extraction, abstain_below: float) -> str:
    """The reason for doing nothing about a reply; '' when its action or verdict is taken."""
    if not reply.ended:
        return f"the reply did not end within {reply.num_tokens} tokens"
    if reply.action is None:
        return "the reply comes to no action and no <none>"
    token = f"<{extraction.action}>" if extraction.action is not None else "<none>"
    if token != reply.action:
        return f"the text asks for {token} where {reply.action} was chosen ({extraction.reason})"
    if reply.confidence < abstain_below:
        return f"abstained: {reply.action} has a confidence of {reply.confidence:.2f} only"
    return ""
