"""A policy of one's own: centre the contact, then press in small steps, then say so."""

from cltp.tactile.measure import contact_state
from policies import Decision, Observation, Policy
from policies.extraction import extract
from primitives.contract import Contract
from tacgrasp.config.schema import RunConfig


class PatientPolicy:
    """Moves before it presses, and never asks for less force than the contract's middle."""

    name = "patient"

    def __init__(self, move_step_mm: float) -> None:
        self._reach_mm = 0.6 * move_step_mm

    def start(self) -> None:
        """Nothing to forget: each contact is decided on its own."""

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """Say what is felt and what to do; the action is read out of these words alone."""
        text = self._text(observation, contract)
        found = extract(text)
        return Decision(text=text, action=found.action, success=found.success, reason=found.reason)

    def _text(self, observation: Observation, contract: Contract) -> str:
        state = contact_state(observation.cloud, in_contact=observation.in_contact)
        force, band = observation.felt_force_n, contract.terms.force_n
        force_n = state.force_n if force is None else force.value
        if not state.in_contact:
            return "I feel no contact. Reset the grasp."
        if abs(state.x_mm - contract.x_mm.middle) > self._reach_mm:
            side = "right" if state.x_mm > contract.x_mm.middle else "left"
            return f"It is off centre. Move the gripper to the {side}."
        if abs(state.y_mm - contract.y_mm.middle) > self._reach_mm:
            side = "upward" if state.y_mm > contract.y_mm.middle else "downward"
            return f"It is off centre. Move the gripper {side}."
        if force_n < band.low:
            return "That is too light. Increase the gripping force."
        if force_n > band.high:
            return "That is too firm. Decrease the gripping force."
        return "It lies within the goal. The grasp is stable."


def make_policy(config: RunConfig) -> Policy:
    """The entry point: a policy for a run."""
    return PatientPolicy(config.primitives.move_step_mm)
