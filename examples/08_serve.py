"""Serve one policy to several robots, and let a robot ask it: both sides in one program.

    pip install 'tacgrasp[serve]'
    python examples/08_serve.py [rules|llm]

In use they are two: `tacgrasp serve --policy llm` on one computer, and on each robot's
`tacgrasp run --policy remote --policy-url ws://127.0.0.1:8000`. openpi's client can ask as well.
"""

import sys

import msgpack
from websockets.sync.client import connect

from tacgrasp import api
from tacgrasp.config.layers import load
from tacgrasp.policy_factory import policy_maker
from tacgrasp.serving.server import PolicyServer, ServerSettings
from tacgrasp.serving.wire import pack, unpack

policy = sys.argv[1] if len(sys.argv) > 1 else "rules"
if policy not in ("rules", "llm"):
    sys.exit(f"expected rules or llm, got {policy}")
config, sources = load("strawberry")
config = config.model_copy(update={"policy": policy})
server = PolicyServer(policy_maker(config), config, sources, ServerSettings(port=0))

with server.background() as url:
    run = api.configure(
        "strawberry", policy="remote", policy_url=url, policy_timeout_s=20.0, seed=6
    )
    with api.connect(run) as rig:
        outcome = api.run_episode(run, rig, api.make_policy(run)).outcome
        cloud = rig.sensor.read()
    print(f"a run that asks {url}: {outcome.label} after {outcome.num_actions} actions")

    # any program can ask: a websocket and msgpack are all that it needs
    with connect(url, compression=None) as connection:
        metadata = unpack(connection.recv())
        print(f"it serves {metadata['policy']} for {metadata['task']}")
        question = {"observation/tactile_points": cloud.points_mm, "prompt": "Hold it at 2 N."}
        question["observation/in_contact"] = True  # a single light frame alone can't tell
        connection.send(pack(question))
        answer = unpack(connection.recv())
        print(f"asked for 2 N it says: {answer['text']}")
        low_n, high_n = answer["contract"]["force_n"]
        print(f"its contract is {low_n:.2f} to {high_n:.2f} N, its action {answer['primitive']}")
        connection.send(msgpack.packb({"prompt": "and without points?"}))
        print(f"and without points: {connection.recv()}")
