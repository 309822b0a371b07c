"""Policy servers for tests: ours in a thread, and one that misbehaves from a given question on."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from websockets.sync.server import ServerConnection, serve

from policies import Policy
from tacgrasp.config.layers import load
from tacgrasp.serving.remote import PROTOCOL, SERVER
from tacgrasp.serving.server import PolicyServer, ServerSettings
from tacgrasp.serving.wire import pack

METADATA = {"server": SERVER, "protocol": PROTOCOL}


@contextmanager
def served(make: Callable[[], Policy], **settings: object) -> Iterator[str]:
    """Our server with a policy for the strawberry; gives its address."""
    config, sources = load("strawberry")
    server = PolicyServer(make, config, sources, ServerSettings(port=0, **settings))
    with server.background() as url:
        yield url


@contextmanager
def misbehaving(answer: Callable[[ServerConnection, bytes, int], None]) -> Iterator[str]:
    """A server whose answer to each question is up to the test; questions count from 0 in all."""
    count = [0]

    def handle(connection: ServerConnection) -> None:
        connection.send(pack(METADATA))
        with contextlib.suppress(Exception):  # the client has hung up, as it should
            for data in connection:
                number, count[0] = count[0], count[0] + 1
                answer(connection, data, number)

    with serve(handle, "127.0.0.1", 0, compression=None, close_timeout=0.1) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        try:
            yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}"
        finally:
            server.shutdown()
            thread.join()
