"""The policy of rules: measure the contact, ask the teacher, say it, read what was said.

Its words go through the same extraction as a language model's, so the loop can't tell them apart.
Loads no torch.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from policies.extraction import extract
from policies.goal import Goal
from policies.observation import Observation
from policies.policy import Decision
from policies.speech import speak
from policies.teacher import teacher


class RulesPolicy:
    """The teacher on the computed contact state; the instruction is not read, its goal is."""

    def __init__(
        self,
        goal: Goal,
        *,
        move_step_mm: float,
        measure: Callable[[TactileCloud], ContactState] | None = None,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        """Take a goal.

        Args:
            goal: What a good grasp is.
            move_step_mm: Length of a move that the rig carries out [mm].
            measure: From a cloud to a state; None takes ``cltp.tactile.measure.contact_state``.
            clock: For the durations of the stages [s].
        """
        self._goal, self._move_step_mm = goal, move_step_mm
        self._measure, self._clock = measure, clock

    @property
    def name(self) -> str:
        """'rules'."""
        return "rules"

    def start(self) -> None:
        """Nothing to forget: every touch is judged by itself."""

    def decide(self, observation: Observation, instruction: str) -> Decision:
        """Say what the contact is and what to do.

        Raises:
            TouchError: The cloud can't be measured.
        """
        marks = [self._clock()]
        if self._measure is not None:
            state = self._measure(observation.cloud)
        else:
            state = contact_state(observation.cloud, in_contact=observation.in_contact)
        marks.append(self._clock())
        advice = teacher(state, self._goal, move_step_mm=self._move_step_mm)
        marks.append(self._clock())
        text = speak(state, advice)
        marks.append(self._clock())
        found = extract(text)
        marks.append(self._clock())
        stages = ("measure", "teacher", "speak", "extract")
        return Decision(
            text=text,
            action=found.action,
            success=found.success,
            reason=f"{found.reason} ({advice.why})",
            stage_ms={
                stage: 1e3 * (end - begin)
                for stage, begin, end in zip(stages, marks, marks[1:], strict=False)
            },
        )
