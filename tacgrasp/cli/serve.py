"""``tacgrasp serve``: let other programs ask a policy, over openpi's protocol."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse


@dataclass(frozen=True)
class ServeFlags:
    """Serve a policy to robots and programs, until Ctrl-C.

    Attributes:
        policy: Policy that decides: llm, rules, or a plugin's; by default that of the rig's file.
        weights: Folder of the language model's weights; by default those of the rig's file, else
            the shipped ones.
        task: Task whose terms an instruction is read with.
        rig: Rig whose gripper and sensor are meant.
        host: Address to listen on; beyond this computer (127.0.0.1) a key is needed.
        port: Port; 0 takes a free one.
        key_file: File with the key that clients must give (Authorization: Api-Key ...).
        max_clients: Most connections at a time.
    """

    policy: str | None = None
    weights: Path | None = None
    task: str = "strawberry"
    rig: str = "sim"
    host: str = "127.0.0.1"
    port: int = 8000
    key_file: Path | None = None
    max_clients: int = 32

    def __post_init__(self) -> None:
        if not 0 <= self.port <= 65535:
            raise UsageError(f"--port must be 0 to 65535, got {self.port}")
        if not 1 <= self.max_clients <= 1000:
            raise UsageError(f"--max-clients must be 1 to 1000, got {self.max_clients}")


def main(argv: Sequence[str]) -> int:
    """Serve until Ctrl-C."""
    flags = parse(ServeFlags, argv, prog="tacgrasp serve")
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console
    from tacgrasp.policy_factory import policy_maker
    from tacgrasp.serving.keys import read_key
    from tacgrasp.serving.server import PolicyServer, ServerSettings

    key = None if flags.key_file is None else read_key(flags.key_file, flag="--key-file")
    settings = ServerSettings(
        host=flags.host, port=flags.port, key=key, max_clients=flags.max_clients
    )
    below, sources = load(flags.task, flags.rig, os.environ)
    given = {"policy": flags.policy, "weights": flags.weights}
    given = {name: value for name, value in given.items() if value is not None}
    config = below.model_copy(update=given)
    if config.policy == "remote":
        raise UsageError("the policy remote asks a server itself; serve what that one serves")
    server = PolicyServer(policy_maker(config), config, sources, settings)
    console = make_console()

    def ready(url: str) -> None:
        console.print(f"serving {config.policy} for {flags.task} on {url} (Ctrl-C ends it)")
        console.file.flush()

    try:
        asyncio.run(server.run(ready))
    except OSError as error:
        raise UsageError(
            f"--host {flags.host} --port {flags.port} can't be listened on: {error.strerror}"
        ) from None
    return 0
