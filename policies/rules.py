"""The rule-based policy: measures the contact, takes the teacher's advice and puts it into words.

The action is then extracted from the words, as for the language model. Loads no torch.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.partial_pad import is_partial, partial_text
from cltp.tactile.contact.raised_pad import is_raised, raised_text
from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from policies.contract_steps import refuted, target_of
from policies.extraction import extract
from policies.observation import Observation, is_impossible
from policies.policy import Decision
from policies.speech import speak
from policies.teacher import teacher
from primitives.contract import DEFAULT_AREA, DEFAULT_DEPTH_MM, Contract


class RulesPolicy:
    """The teacher's advice on the measured contact, for the contract's target."""

    def __init__(
        self,
        *,
        move_step_mm: float,
        measure: Callable[[TactileCloud], ContactState] | None = None,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        """Take the length of a move.

        Args:
            move_step_mm: Length of a move that the rig carries out [mm].
            measure: Function from a cloud to its contact state; None takes
                ``cltp.tactile.measure.contact_state``.
            clock: Clock for the durations of the stages [s].
        """
        self._move_step_mm = move_step_mm
        self._measure, self._clock = measure, clock

    @property
    def name(self) -> str:
        return "rules"

    def start(self) -> None:
        pass  # each step is decided on its own

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """Describe the contact and advise on it.

        Raises:
            TouchError: The cloud can't be measured.
            LimitError: The contract is refused.
        """
        times_s = [self._clock()]
        if observation.in_contact is None and (why := _unread_text(observation.cloud)):
            _ = contract.terms  # a refused one ends here
            unread = f"What is felt can't be read: {why}"
            return Decision(text=f"{unread}.", action=None, success=False, reason=unread)
        if self._measure is not None:
            state = self._measure(observation.cloud)
        else:
            state = contact_state(observation.cloud, in_contact=observation.in_contact)
            commanded_n = observation.commanded_force_n
            if commanded_n is not None and is_impossible(state.force_n, commanded_n):
                state = replace(state, force_n=commanded_n)
        times_s.append(self._clock())
        goal = target_of(contract)
        advice = teacher(state, goal, move_step_mm=self._move_step_mm)
        if advice.action in refuted(contract, observation.felt_force_n):
            # depth and area of a broad drift, not of the contact: only force and place are left
            goal = replace(goal, depth_mm=DEFAULT_DEPTH_MM, area_fraction=DEFAULT_AREA)
            advice = teacher(state, goal, move_step_mm=self._move_step_mm)
        times_s.append(self._clock())
        text = speak(state, advice)
        times_s.append(self._clock())
        extraction = extract(text)
        times_s.append(self._clock())
        stages = ("measure", "teacher", "speak", "extract")
        return Decision(
            text=text,
            action=extraction.action,
            success=extraction.success,
            reason=f"{extraction.reason} ({advice.reason})",
            stage_ms={
                stage: 1e3 * (end - begin)
                for stage, begin, end in zip(stages, times_s, times_s[1:], strict=False)
            },
        )


def _unread_text(cloud: TactileCloud) -> str:
    """Why a cloud can't be read, which a run would have refused; '' where it can."""
    if is_partial(cloud):
        return partial_text(cloud)
    return raised_text(cloud) if is_raised(cloud) else ""
