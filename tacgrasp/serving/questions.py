"""What a client asks in one step, as it is written and read; every key is here.

The two keys of openpi's client suffice: the points, and a prompt whose words become the contract.
A run of tacgrasp sends what it knows besides, and its own contract, which the answer then keeps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import sensor_named
from policies import Observation
from policies.instructions.reader import MAX_CHARACTERS
from primitives.contract import Contract
from primitives.sense import Interval
from tacgrasp.episodes.codec import from_json, to_json
from tacgrasp.serving.wire import WireError

POINTS, PROMPT = "observation/tactile_points", "prompt"

KEYS: Mapping[str, str] = {
    POINTS: "points on the gel, shape (N, 3), float32 or float64 [mm, gel frame]",
    PROMPT: "instruction in plain English; its words become the contract",
    "sensor": "name of the sensor; by default that of the served rig",
    "observation/in_contact": "whether something touches the gel, by test",
    "observation/felt_force_n": "[low, best, high] of the felt force [N]",
    "observation/width_m": "opening of the gripper [m]",
    "observation/commanded_force_n": "force last commanded [N]",
    "observation/t_s": "time since the episode began [s]",
    "observation/force_scale": "force scale of the sensor's unit",
    "contract": "contract of the episode, in place of one read from the prompt",
    "start": "true in the first question of an episode",
}
"""Every key of a question; the first two are those that a client must give."""

MAX_POINTS = 100_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """A question that can be decided.

    Attributes:
        observation: What the client feels.
        contract: Contract of the client's episode.
        is_first: Whether an episode begins.
    """

    observation: Observation
    contract: Contract
    is_first: bool


def question_message(
    observation: Observation, contract: Contract, *, first: bool
) -> dict[str, Any]:
    """The message of a run's step."""
    message = {
        POINTS: np.ascontiguousarray(observation.cloud.points_mm, dtype="<f4"),
        PROMPT: contract.text[:MAX_CHARACTERS],
        "sensor": observation.cloud.sensor.name,
        "observation/in_contact": observation.in_contact,
        "observation/width_m": observation.width_m,
        "observation/commanded_force_n": observation.commanded_force_n,
        "observation/t_s": observation.t_s,
        "observation/force_scale": to_json(observation.cloud.force_scale),
        "contract": to_json(contract),
        "start": first,
    }
    felt = observation.felt_force_n
    if felt is not None:
        message["observation/felt_force_n"] = [felt.low, felt.value, felt.high]
    return {key: value for key, value in message.items() if value is not None}


def read_question(
    message: Mapping[str, Any], *, sensor: str, read_prompt: Callable[[str], Contract]
) -> Question:
    """Check a message and read it.

    Args:
        message: From ``tacgrasp.serving.wire.unpack``.
        sensor: Name of the sensor where the message names none.
        read_prompt: Makes a contract of a prompt.

    Raises:
        WireError: A key is unknown or missing, or its value of another kind.
        TouchError: The points are no cloud of the sensor.
        LimitError: The contract contradicts itself.
    """
    if unknown := sorted(message.keys() - KEYS.keys()):
        raise WireError(f"unknown key {unknown[0]!r:.80}; known: {', '.join(KEYS)}")
    if missing := [key for key in (POINTS, PROMPT) if key not in message]:
        raise WireError(f"the key {missing[0]} is missing: {KEYS[missing[0]]}")
    prompt = message[PROMPT]
    if not isinstance(prompt, str) or not 0 < len(prompt) <= MAX_CHARACTERS:
        raise WireError(f"prompt must be a text of 1 to {MAX_CHARACTERS} characters")
    contract = _of_json(Contract, message, "contract") or read_prompt(prompt)
    is_first = message.get("start", False)
    if not isinstance(is_first, bool):
        raise WireError("start must be true or false")
    observation = _observation(message, sensor)
    return Question(observation=observation, contract=contract, is_first=is_first)


def _observation(message: Mapping[str, Any], sensor: str) -> Observation:
    points = message[POINTS]
    if not isinstance(points, np.ndarray) or points.dtype.str not in ("<f4", "<f8"):
        raise WireError(f"{POINTS} must be {KEYS[POINTS]}, got {_kind(points)}")
    if points.ndim != 2 or points.shape[1] != 3 or len(points) > MAX_POINTS:
        raise WireError(f"{POINTS} must be (N, 3), N at most {MAX_POINTS}, got {points.shape}")
    if not (np.abs(points) < 1e3).all():  # NaN too; a cast to float32 must not overflow
        raise WireError(f"{POINTS} must be finite and below 1 m")
    name = message.get("sensor", sensor)
    if not isinstance(name, str):
        raise WireError(f"sensor must be a name, got {_kind(name)}")
    in_contact = message.get("observation/in_contact")
    if not isinstance(in_contact, bool | None):
        raise WireError(f"observation/in_contact must be true or false, got {_kind(in_contact)}")
    scale = _of_json(ForceScale, message, "observation/force_scale") or UNCALIBRATED
    return Observation(
        cloud=TactileCloud(points_mm=points, sensor=sensor_named(name), force_scale=scale),
        in_contact=in_contact,
        width_m=_number(message, "observation/width_m"),
        commanded_force_n=_number(message, "observation/commanded_force_n"),
        felt_force_n=_interval(message.get("observation/felt_force_n")),
        t_s=_number(message, "observation/t_s") or 0.0,
    )


def _number(message: Mapping[str, Any], key: str) -> float | None:
    value = message.get(key)
    if value is None:
        return None
    if type(value) not in (int, float) or not abs(value) < 1e9:  # NaN is not below either
        raise WireError(f"{key} must be a finite number, got {_kind(value)}")
    if value < 0:
        raise WireError(f"{key} must be 0 or more, got {value:g}")
    return float(value)


def _interval(values: Any) -> Interval | None:
    if values is None:
        return None
    if isinstance(values, np.ndarray):
        values = values.tolist()
    is_three = isinstance(values, list) and len(values) == 3
    if not (is_three and all(type(v) in (int, float) and math.isfinite(v) for v in values)):
        raise WireError("observation/felt_force_n must be three finite numbers [N]")
    low, best, high = map(float, values)
    if not 0 <= low <= best <= high:
        raise WireError(f"observation/felt_force_n must rise, from 0 or more, got {values}")
    return Interval(low=low, value=best, high=high)


def _of_json(kind: type[Any], message: Mapping[str, Any], key: str) -> Any:
    if key not in message:
        return None
    try:
        return from_json(kind, message[key])
    except (ValueError, TypeError) as error:  # a type that JSON has not, such as an array
        raise WireError(" ".join(f"{key}: {error}"[:400].split())) from None


def _kind(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} {value.shape}"
    return type(value).__name__
