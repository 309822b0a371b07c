"""The oracle: decides from a simulator's truth. An upper bound for benchmarks, never for a run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from policies.observation import Observation
from policies.policy import Decision
from primitives import Primitive


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspTruth:
    """What the oracle is told.

    Attributes:
        x_mm, y_mm: Where the body's nearest point is on the pad [mm, gel frame].
        force_n: True force now [N]; 0 when nothing is held.
        slip_n: Smallest force that holds this body, centred, through the lift [N].
        bruise_n: Force that bruises it, centred [N].
    """

    x_mm: float
    y_mm: float
    force_n: float
    slip_n: float
    bruise_n: float


_HALF_STEP_MM = 1.6
_SLIP_RESERVE, _BRUISE_RESERVE = 1.15, 0.95


class OraclePolicy:
    """Centres within half a step, then brings the force between slip and bruise.

    Args:
        truth: Tells the truth of the moment.
    """

    name = "oracle"

    def __init__(self, truth: Callable[[], GraspTruth]) -> None:
        self._truth = truth

    def start(self) -> None:
        """Nothing to forget."""

    def decide(self, observation: Observation, instruction: str) -> Decision:
        """Decide from the truth; observation and instruction are ignored."""
        action = self._action(self._truth())
        text = "The grasp is secure." if action is None else f"Do {action.value}."
        return Decision(text=text, action=action, success=action is None, reason="truth")

    def _action(self, now: GraspTruth) -> Primitive | None:
        if now.force_n > _BRUISE_RESERVE * now.bruise_n:
            return Primitive.DECREASE_FORCE
        if abs(now.x_mm) > _HALF_STEP_MM:
            return Primitive.MOVE_RIGHT if now.x_mm > 0 else Primitive.MOVE_LEFT
        if abs(now.y_mm) > _HALF_STEP_MM:
            return Primitive.MOVE_UP if now.y_mm > 0 else Primitive.MOVE_DOWN
        if now.force_n < _SLIP_RESERVE * now.slip_n:
            return Primitive.INCREASE_FORCE
        return None
