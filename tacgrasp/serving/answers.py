"""What a server answers in one step, as it is written, and as a run reads it with mistrust."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from policies import Decision, PolicyError
from policies.extraction import extract
from primitives import Primitive
from primitives.contract import Contract
from primitives.primitive import PAD_DIRECTION
from tacgrasp.config.terms import contract_json
from tacgrasp.serving.wire import WireError

ACTION_COLUMNS = ("move_x", "move_y", "force", "reset")
"""Columns of ``actions``: direction on the pad (-1, 0, 1), less, same or more force, reset."""

MAX_TEXT_CHARACTERS = 2000


def answer_message(decision: Decision, contract: Contract) -> dict[str, Any]:
    """The message of a decision, kept to the contract."""
    return {
        "actions": np.array([_action_row(decision.action)], dtype="<f4"),
        "text": decision.text[:MAX_TEXT_CHARACTERS],
        "primitive": None if decision.action is None else decision.action.value,
        "success": decision.success,
        "confidence": float(decision.confidence),
        "reason": decision.reason[:MAX_TEXT_CHARACTERS],
        "contract": contract_json(contract),
    }


def _action_row(action: Primitive | None) -> list[float]:
    if action is None:
        return [0.0] * len(ACTION_COLUMNS)
    x, y = PAD_DIRECTION.get(action, (0.0, 0.0))
    force = {Primitive.INCREASE_FORCE: 1.0, Primitive.DECREASE_FORCE: -1.0}.get(action, 0.0)
    return [x, y, force, float(action is Primitive.RESET)]


def _is_same(got: object, expected: object) -> bool:
    try:
        return bool(got == expected)
    except ValueError:  # an array in it
        return False


def read_answer(message: Mapping[str, Any], contract: Contract) -> Decision:
    """Check an answer and read it; its text is read here again, as any policy's.

    Args:
        message: From ``tacgrasp.serving.wire.unpack``.
        contract: The contract that was asked for.

    Raises:
        WireError: A value is missing or of another kind.
        PolicyError: Its action is not what its text asks for, or it keeps another contract.
    """
    text, success = message.get("text"), message.get("success")
    if not isinstance(text, str) or not 0 < len(text) <= MAX_TEXT_CHARACTERS:
        raise WireError(f"text must have 1 to {MAX_TEXT_CHARACTERS} characters")
    if not isinstance(success, bool):
        raise WireError("success must be true or false")
    confidence, name = message.get("confidence"), message.get("primitive")
    if type(confidence) is not float or not 0 <= confidence <= 1:  # NaN is in no range
        raise WireError(f"confidence must be a number of 0 to 1, got {confidence!r:.40}")
    if name is not None and not (isinstance(name, str) and name in set(Primitive)):
        raise WireError(f"primitive must be one of {', '.join(Primitive)}, got {name!r:.40}")
    action = None if name is None else Primitive(name)
    reason = message.get("reason", "")
    if not isinstance(reason, str) or len(reason) > MAX_TEXT_CHARACTERS:
        raise WireError("reason must be a text")
    if not _is_same(message.get("contract"), contract_json(contract)):
        raise PolicyError("the policy server decided for another contract than the run's")
    found = extract(text)
    if action not in (found.action, None) or success not in (found.success, False):
        raise PolicyError(
            f"the policy server says {name} and success {success}, but its text {found.reason}"
        )
    timing = message.get("server_timing")
    infer_ms = timing.get("infer_ms") if isinstance(timing, dict) else None
    is_time = type(infer_ms) is float and math.isfinite(infer_ms) and infer_ms >= 0
    return Decision(
        text=text,
        action=action,
        success=success,
        reason=reason or found.reason,
        confidence=confidence,
        stage_ms={"server": infer_ms} if is_time and infer_ms is not None else {},
    )
