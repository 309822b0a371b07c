"""What the language model is taught about contacts: captions, questions, and advice on goals.

A person's instruction stands for a goal in numbers; ``policies.teacher`` says what the goal asks of
a contact; the reply is the model's D_t. ``cltp.train`` receives the texts and knows no goals.

D_t, in this order: the contact in words and numbers; the force that the instruction asks for;
``Action:`` and one of eight tokens; the reason. It is short, since every token costs time in the
loop; the paper's caption is said when somebody asks for a description. The action comes before the
reason so that the softmax at its place is the model's own doubt, not an echo of a given reason.

Where a state is ``felt``, its words are the truth and its numbers are as the encoder's heads read
them (``cltp.train.llm`` says why); advice always comes from the truth.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cltp.tactile.states import ContactState
from cltp.texts.captions import NO_CONTACT, caption
from cltp.texts.exchange_packing import Exchange
from policies.goal import Goal
from policies.speech import REASON_WORDINGS, SUCCESS_WORDINGS
from policies.teacher import LESSON_MOVE_STEP_MM, Advice, teacher
from tacgrasp.lessons.instructions import Instruction, draw_instruction, draw_instruction_near
from tacgrasp.lessons.questions import CAPTION_REQUESTS, draw_question, percent

ADVICE_PER_CONTACT = 3
"""Advice for goals that differ, on the same touch. Our choice: the touch tokens cost most."""

GOAL_QUESTIONS = (
    "What force is meant by: {}",
    "Which force does this ask for? {}",
    "In newtons, what does this mean? {}",
    "How many newtons are wanted here? {}",
)
MEANINGS_PER_CONTACT = 2
"""Instructions read for their force alone: more wordings for fewer tokens than whole advice."""


def numbers(state: ContactState) -> str:
    """The numbers of a contact, short: depth [mm], force [N], area [%], x and y [mm], sides cut."""
    if not state.in_contact:
        return "0.00 mm, 0.00 N."
    cut = f", cut {' '.join(sorted(state.cut))}" if state.cut else ""
    return (
        f"{state.depth_mm:.2f} mm, {state.force_n:.2f} N, {percent(state)} %, "
        f"x {state.x_mm:+.1f}, y {state.y_mm:+.1f}{cut}."
    )


def described(state: ContactState) -> str:
    """The contact as D_t begins: the five slots, each beside its number, force, and sides cut."""
    if not state.in_contact:
        return "Nothing touches."
    named = " ".join(str(word) for word in (state.texture, state.shape) if word is not None)
    cut = f", cut {' '.join(sorted(state.cut))}" if state.cut else ""
    return (
        f"{named or 'object'}, {state.depth} {state.depth_mm:.2f} mm, {state.position} "
        f"x {state.x_mm:+.1f} y {state.y_mm:+.1f}, {state.area} {percent(state)} %, "
        f"{state.force_n:.2f} N{cut}."
    )


def wanted(goal: Goal) -> str:
    """The goal's force, as D_t names it: as many digits as the contact's, to compare one by one."""
    return f"Goal {goal.force_n.low:.2f} - {goal.force_n.high:.2f} N."


def advice_reply(state: ContactState, goal: Goal, felt: ContactState | None = None) -> str:
    """D_t for a contact and a goal; ``policies.extraction`` reads the advice in it."""
    advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
    action = f"<{advice.action}>" if advice.action is not None else "<none>"
    return f"{described(felt or state)} {wanted(goal)} Action: {action}. {_why(advice)}"


def _why(advice: Advice) -> str:
    if advice.success:
        return SUCCESS_WORDINGS[0]
    return REASON_WORDINGS[advice.reason][0]


def advice_exchange(
    state: ContactState, instruction: Instruction, felt: ContactState | None = None
) -> Exchange:
    """An instruction and D_t."""
    return Exchange(prompt=instruction.text, reply=advice_reply(state, instruction.goal, felt))


def meaning_exchange(rng: np.random.Generator) -> Exchange:
    """A question what force an instruction means, and the force as D_t names it."""
    instruction = draw_instruction(rng)
    question = GOAL_QUESTIONS[rng.integers(len(GOAL_QUESTIONS))]
    return Exchange(prompt=question.format(instruction.text), reply=wanted(instruction.goal))


def caption_exchange(state: ContactState, rng: np.random.Generator) -> Exchange:
    """A request to describe, and the caption with its numbers."""
    request = CAPTION_REQUESTS[rng.integers(len(CAPTION_REQUESTS))]
    text = NO_CONTACT if not state.in_contact else caption(state)
    return Exchange(prompt=request, reply=f"{text} {numbers(state)}")


class TouchLessons:
    """``cltp.train.llm.Lessons``: all that is taught. Deterministic in the generator given.

    Args:
        blind: Replaces every instruction by the same few words: the control that can't know what
            is wanted.
    """

    def __init__(self, *, blind: bool = False) -> None:
        self._blind = blind

    def captions(self, felt: ContactState, rng: np.random.Generator) -> Sequence[Exchange]:
        """One description."""
        return [caption_exchange(felt, rng)]

    def mixed(
        self, state: ContactState, felt: ContactState, rng: np.random.Generator
    ) -> Sequence[Exchange]:
        """A caption or a question, advice for several goals, and instructions to be understood."""
        first = caption_exchange(felt, rng) if rng.random() < 0.3 else draw_question(felt, rng)
        drawn = [
            draw_instruction_near(state, rng) if rng.random() < 0.6 else draw_instruction(rng)
            for _ in range(ADVICE_PER_CONTACT)
        ]
        exchanges = [advice_exchange(state, instruction, felt) for instruction in drawn]
        if self._blind:
            exchanges = [Exchange(prompt=BLIND, reply=e.reply) for e in exchanges]
            return [first, *exchanges]
        return [first, *exchanges, *(meaning_exchange(rng) for _ in range(MEANINGS_PER_CONTACT))]


BLIND = "Do what is needed."
