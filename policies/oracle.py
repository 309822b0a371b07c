"""Policy that decides from the simulator's truth: an upper bound, for benchmarks alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from policies.observation import Observation
from policies.policy import Decision
from primitives import Primitive
from primitives.contract import Contract


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspTruth:
    """The true state of a grasp.

    Attributes:
        x_mm, y_mm: Position of the body's nearest point on the pad [mm, gel frame].
        force_n: Present true force [N]; 0 when nothing is held.
        slip_n: Smallest force that holds this body through the lift when centred [N].
        bruise_n: Force that bruises the body when centred [N].
    """

    x_mm: float
    y_mm: float
    force_n: float
    slip_n: float
    bruise_n: float


_HALF_STEP_MM = 1.6
SLIP_RESERVE, BRUISE_RESERVE = 1.15, 0.95
"""Force band of the oracle, over the slip minimum and over the bruise force."""


class OraclePolicy:
    """Centres the contact within half a step, then brings the force between slip and bruise.

    Args:
        truth: Function that returns the present truth.
    """

    name = "oracle"

    def __init__(self, truth: Callable[[], GraspTruth]) -> None:
        self._truth = truth

    def start(self) -> None:
        pass

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        action = self._action(self._truth())
        text = "The grasp is secure." if action is None else f"Do {action.value}."
        return Decision(text=text, action=action, success=action is None, reason="truth")

    def _action(self, truth: GraspTruth) -> Primitive | None:
        if truth.force_n > BRUISE_RESERVE * truth.bruise_n:
            return Primitive.DECREASE_FORCE
        if abs(truth.x_mm) > _HALF_STEP_MM:
            return Primitive.MOVE_RIGHT if truth.x_mm > 0 else Primitive.MOVE_LEFT
        if abs(truth.y_mm) > _HALF_STEP_MM:
            return Primitive.MOVE_UP if truth.y_mm > 0 else Primitive.MOVE_DOWN
        if truth.force_n < SLIP_RESERVE * truth.slip_n:
            return Primitive.INCREASE_FORCE
        return None
