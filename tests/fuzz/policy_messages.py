"""Questions and answers of a policy server under mutated bytes, read on either side."""

from __future__ import annotations

from functools import cache
from random import Random

import msgpack
import numpy as np

from cltp.errors import TouchError
from policies import Observation, PolicyError
from policies.rules import RulesPolicy
from primitives import LimitError
from tacgrasp.serving.answers import answer_message, read_answer
from tacgrasp.serving.questions import question_message, read_question
from tacgrasp.serving.wire import WireError, pack, unpack
from tacgrasp.testing import CLOUDS, CONTRACT
from tests.fuzz.target import FuzzTarget

_VALUES = (
    *(None, True, False, 0, -1, 2**63, -(2**63), 1.5, float("nan"), float("inf"), 1e308),
    *("", "x", "x" * 3000, "move_up", b"", b"bytes", [], [1.0, 2.0, 3.0], {}, {"x": 1}),
    {b"__ndarray__": True}, {b"__npgeneric__": True, b"data": None, b"dtype": "O"},
    {b"__ndarray__": True, b"data": bytes(12), b"dtype": "<f4", b"shape": [1, 3]},
    {b"__ndarray__": True, b"data": bytes(12), b"dtype": "<f4", b"shape": [3, 0, 2**62]},
    {b"__ndarray__": True, b"data": b"", b"dtype": "O", b"shape": [2**40]},
    msgpack.ExtType(1, b"x"), msgpack.Timestamp(0, 0),
)  # fmt: skip


@cache
def _messages() -> tuple[bytes, bytes]:
    observation = Observation(cloud=CLOUDS[1], in_contact=True)
    decision = RulesPolicy(move_step_mm=3.0).decide(observation, CONTRACT)
    question = question_message(observation, CONTRACT, first=True)
    return pack(question), pack(answer_message(decision, CONTRACT))


def _case(rng: Random) -> bytes:
    """One byte for the side, then a message with a value exchanged, or bytes damaged."""
    side = rng.randrange(2)
    data = _messages()[side]
    if rng.random() < 0.6:
        message = msgpack.unpackb(data, strict_map_key=False)
        place = message
        while True:
            key = rng.choice(list(place) if isinstance(place, dict) else range(len(place)))
            inner = place[key]
            if not (isinstance(inner, (dict, list)) and inner) or rng.random() < 0.4:
                break
            place = inner
        place[key] = rng.choice(_VALUES)
        if isinstance(place, dict) and rng.random() < 0.1:
            place[rng.choice(("x", b"__ndarray__"))] = rng.choice(_VALUES)
        data = msgpack.packb(message)
    mutable = bytearray(data)
    for _ in range(rng.choice((0, 0, 1, 3))):
        mutable[rng.randrange(min(len(mutable), 400))] = rng.randrange(256)
    cut = rng.randrange(len(mutable)) if rng.random() < 0.1 else len(mutable)
    return bytes([side]) + bytes(mutable[:cut])


def _read(data: bytes) -> object:
    message = unpack(data[1:])
    if data[0]:
        return read_answer(message, CONTRACT)
    question = read_question(message, sensor="gelsight_mini", read_prompt=lambda _: CONTRACT)
    assert np.isfinite(question.observation.cloud.points_mm).all()
    return question.contract.summary


TARGETS: tuple[FuzzTarget, ...] = (
    FuzzTarget(
        name="policy",
        make_case=_case,
        read=_read,
        documented=(WireError, TouchError, LimitError, PolicyError),
    ),
)
