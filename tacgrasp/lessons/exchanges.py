"""Exchanges that teach the language model: captions, questions, and advice on goals.

A goal is a force band with its limit, ``policies.teacher`` advises on a contact for that goal, and
the reply is the D_t that the model learns. ``cltp.train`` receives texts and knows no goals.

D_t consists of the contact in words and numbers, the force that is asked for,
``Action:`` with one of eight tokens, and the reason, in this order. It is short, since every token
costs time in the loop; the paper's caption is the reply to a request for a description. The action
comes before the reason, so that the softmax of its token is the model's own confidence and not an
echo of the reason.

A ``reading`` is a state whose words are the truth and whose numbers are as the encoder's heads read
them (the reason is in ``cltp.train.llm``); advice always comes from the truth.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cltp.tactile.states import ContactState
from cltp.texts.captions import caption
from cltp.texts.exchange_packing import Exchange
from policies.contract_steps import target_of
from policies.goal import Goal
from policies.reply.text import percent, step_request
from policies.speech import REASON_WORDINGS, SUCCESS_WORDINGS
from policies.teacher import LESSON_MOVE_STEP_MM, teacher
from primitives.contract import Contract
from tacgrasp.lessons.captions import CAPTION_REQUESTS
from tacgrasp.lessons.question_draws import draw_contract, question_exchange

ADVICE_PER_CONTACT = 3
"""Number of goals, and so of pieces of advice, for one contact. Our choice: the tactile tokens,
which they share, cost the most."""


def numbers(state: ContactState) -> str:
    """Numbers of a contact as text: depth [mm], force [N], area [%], x and y [mm], cut sides."""
    if not state.in_contact:
        return "0.00 mm, 0.00 N."
    cut = f", cut {' '.join(sorted(state.cut))}" if state.cut else ""
    return (
        f"{state.depth_mm:.2f} mm, {state.force_n:.2f} N, {percent(state.area_fraction)} %, "
        f"x {state.x_mm:+.1f}, y {state.y_mm:+.1f}{cut}."
    )


def contact_text(state: ContactState) -> str:
    """First part of D_t: the five slots, each beside its number, the force, and the cut sides."""
    if not state.in_contact:
        return "Nothing touches."
    nouns = " ".join(str(word) for word in (state.texture, state.shape) if word is not None)
    cut = f", cut {' '.join(sorted(state.cut))}" if state.cut else ""
    return (
        f"{nouns or 'object'}, {state.depth} {state.depth_mm:.2f} mm, {state.position} "
        f"x {state.x_mm:+.1f} y {state.y_mm:+.1f}, {state.area} {percent(state.area_fraction)} %, "
        f"{state.force_n:.2f} N{cut}."
    )


def goal_text(goal: Goal) -> str:
    """Force of the goal in D_t, with as many digits as that of the contact, to compare the two."""
    return f"Goal {goal.force_n.low:.2f} - {goal.force_n.high:.2f} N."


def advice_reply(state: ContactState, goal: Goal, reading: ContactState | None = None) -> str:
    """D_t for a contact and a goal; ``policies.extraction`` reads the advice back from it."""
    advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
    action = f"<{advice.action}>" if advice.action is not None else "<none>"
    contact = contact_text(reading or state)
    reason = SUCCESS_WORDINGS[0] if advice.success else REASON_WORDINGS[advice.reason][0]
    return f"{contact} {goal_text(goal)} Action: {action}. {reason}"


def caption_exchange(state: ContactState, rng: np.random.Generator) -> Exchange:
    """A request for a description, and the caption with its numbers."""
    request = CAPTION_REQUESTS[rng.integers(len(CAPTION_REQUESTS))]
    return Exchange(prompt=request, reply=f"{caption(state)} {numbers(state)}")


class TouchLessons:
    """All exchanges about a contact, as ``cltp.train.llm.Lessons``; deterministic in the generator.

    Args:
        blind: Whether every goal is replaced by ``BLIND``: the control, whose model can't know it.
    """

    def __init__(self, *, blind: bool = False) -> None:
        self._blind = blind

    def captions(self, reading: ContactState, rng: np.random.Generator) -> Sequence[Exchange]:
        return [caption_exchange(reading, rng)]

    def mixed(
        self, state: ContactState, reading: ContactState, rng: np.random.Generator
    ) -> Sequence[Exchange]:
        """A caption or a question, and advice for several goals."""
        is_caption = rng.random() < 0.3
        first = caption_exchange(reading, rng) if is_caption else None
        contracts = [draw_contract(state, rng) for _ in range(ADVICE_PER_CONTACT)]
        return [
            first or question_exchange(state, reading, rng),
            *(self._advice(state, reading, contract) for contract in contracts),
        ]

    def _advice(self, state: ContactState, reading: ContactState, contract: Contract) -> Exchange:
        terms = contract.terms
        return Exchange(
            prompt=BLIND if self._blind else step_request(terms.force_n, terms.limit_n),
            reply=advice_reply(state, target_of(contract), reading),
        )


BLIND = "Do what is needed."
