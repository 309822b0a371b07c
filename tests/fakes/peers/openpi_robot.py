"""Asks a policy server with openpi's own client, unmodified; runs in that client's environment.

    python openpi_robot.py PORT

Prints one line of JSON: the metadata, the answers and the error of a question without points.
"""

from __future__ import annotations

import importlib.metadata
import json
import sys

import numpy as np
from openpi_client.websocket_client_policy import WebsocketClientPolicy

POINTS, PROMPT = "observation/tactile_points", "Pick the strawberry gently, without bruising it."


def dent(x_mm: float, y_mm: float, depth_mm: float) -> np.ndarray:
    """Points of a round dent in a GelSight Mini, shape (1024, 3) [mm]."""
    u = (np.arange(32) + 0.5) / 32 - 0.5
    x, y = np.meshgrid(20.288 * u, -15.216 * u)
    z = depth_mm * np.clip(1 - ((x - x_mm) ** 2 + (y - y_mm) ** 2) / 16, 0, None)
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def plain(answer: dict) -> dict:
    """An answer without arrays."""
    return {k: v.tolist() if isinstance(v, np.ndarray) else v for k, v in answer.items()}


robot = WebsocketClientPolicy("127.0.0.1", int(sys.argv[1]))
answers = [
    plain(robot.infer({POINTS: points, "prompt": prompt}))
    for points, prompt in (
        (dent(0, -4, 0.3), PROMPT),
        (dent(0, 0, 0.3).astype(np.float32), "Hold it at 5 N."),
        (dent(0, 0, 0.8), PROMPT),
    )
]
try:
    robot.infer({"prompt": PROMPT})
    error = ""
except RuntimeError as refusal:
    error = str(refusal)
names = ("openpi-client", "numpy", "websockets", "msgpack")
versions = {name: importlib.metadata.version(name) for name in names}
metadata = robot.get_server_metadata()
print(json.dumps({"versions": versions, "metadata": metadata, "answers": answers, "error": error}))
