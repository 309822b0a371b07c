"""The server: openpi's protocol, one policy a connection, decisions in the order of arrival.

A connection begins with the server's metadata; then a question and its answer, again and again. A
question that can't be answered is told why in one line of text, and its connection is closed.
``/healthz`` answers ``OK``. Pages of browsers are refused: they send an Origin.

Decisions are made one at a time, first come, first served: since a client has one question at a
time, none waits for more than one decision of each other client.

Source of the protocol: Physical-Intelligence/openpi, ``serving/websocket_policy_server.py``.
"""

from __future__ import annotations

import asyncio
import hmac
import http
import logging
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractAsyncContextManager, contextmanager
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from cltp import TouchError
from policies import Decision, Policy, PolicyError
from primitives import LimitError
from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.runtime.steps import NO_CONTACT_DECISION, decide
from tacgrasp.serving.answers import ACTION_COLUMNS, answer_message
from tacgrasp.serving.keys import is_loopback
from tacgrasp.serving.questions import KEYS, read_question
from tacgrasp.serving.remote import PROTOCOL, SERVER
from tacgrasp.serving.unread import unread_reason
from tacgrasp.serving.wire import MAX_MESSAGE_BYTES, WireError, pack, unpack

try:
    from websockets.asyncio.server import Server, ServerConnection, serve
    from websockets.exceptions import ConnectionClosed
    from websockets.http11 import Request, Response
except ImportError as missing:
    raise UsageError(
        f"{missing.name} is not installed; serving a policy needs it: pip install 'tacgrasp[serve]'"
    ) from None

log = logging.getLogger(__name__)

MAX_CLIENTS = 32
INTERNAL_ERROR, TRY_AGAIN = 1011, 1013

REFUSALS = (WireError, TouchError, PolicyError, LimitError, UsageError)
"""What a client is told in one line; anything else is a bug of the server."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ServerSettings:
    """Where and how a policy is served.

    Attributes:
        host: Address to listen on.
        port: Port; 0 takes a free one.
        key: Key that clients must give; needed beyond loopback.
        max_clients: Most connections at a time.

    Raises:
        UsageError: It would be open to others without a key.
    """

    host: str = "127.0.0.1"
    port: int = 8000
    key: str | None = None
    max_clients: int = MAX_CLIENTS

    def __post_init__(self) -> None:
        if not is_loopback(self.host) and self.key is None:
            raise UsageError(
                f"--host {self.host} lets other computers ask for decisions: that needs a key, "
                "name its file with --key-file"
            )


class PolicyServer:
    """Serves policies for one task and rig.

    Args:
        make: Makes a policy for a connection; called in the thread of the decisions.
        config: Task and rig: what a prompt's contract is made from.
        sources: Source of each value of it.
        settings: Where and how.
    """

    def __init__(
        self,
        make: Callable[[], Policy],
        config: RunConfig,
        sources: Mapping[str, str],
        settings: ServerSettings,
    ) -> None:
        self._make, self._config, self._settings = make, config, settings
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="decisions")
        self._num_clients = 0

        @lru_cache(maxsize=256)
        def read_prompt(prompt: str) -> Contract:
            return contract_of(config.model_copy(update={"instruction": prompt}), sources)

        self._read_prompt = read_prompt

    @contextmanager
    def background(self) -> Iterator[str]:
        """Serve in a thread; gives the address, and ends with the block."""
        loop, ready = asyncio.new_event_loop(), threading.Event()
        stop, urls, errors = asyncio.Event(), list[str](), list[BaseException]()

        async def main() -> None:
            async with self._listening() as server:
                urls.append(self._url(server))
                ready.set()
                await stop.wait()

        def target() -> None:
            try:
                loop.run_until_complete(main())
            except BaseException as error:  # given to the caller below
                errors.append(error)
            finally:
                ready.set()

        thread = threading.Thread(target=target, name="policy server", daemon=True)
        thread.start()
        ready.wait()
        if errors:
            raise errors[0]
        try:
            yield urls[0]
        finally:
            loop.call_soon_threadsafe(stop.set)
            thread.join()
            loop.close()
            self._pool.shutdown(cancel_futures=True)

    async def run(self, on_ready: Callable[[str], None]) -> None:
        """Serve until cancelled; ``on_ready`` is called with the address."""
        async with self._listening() as server:
            on_ready(self._url(server))
            await server.serve_forever()

    def _listening(self) -> AbstractAsyncContextManager[Server]:
        return serve(
            self._serve_client,
            self._settings.host,
            self._settings.port,
            process_request=self._check_request,
            origins=[None],
            compression=None,
            max_size=MAX_MESSAGE_BYTES,
            max_queue=2,
            open_timeout=10,
            close_timeout=1,
        )

    def _url(self, server: Server) -> str:
        host, port = next(iter(server.sockets)).getsockname()[:2]
        return f"ws://[{host}]:{port}" if ":" in host else f"ws://{host}:{port}"

    def _check_request(self, connection: ServerConnection, request: Request) -> Response | None:
        if request.path == "/healthz":
            return connection.respond(http.HTTPStatus.OK, "OK\n")
        if self._settings.key is not None:
            given = request.headers.get("Authorization", "").encode("utf-8", "replace")
            if not hmac.compare_digest(given, f"Api-Key {self._settings.key}".encode()):
                return connection.respond(http.HTTPStatus.UNAUTHORIZED, "a key is needed\n")
        return None

    async def _serve_client(self, connection: ServerConnection) -> None:
        if self._num_clients >= self._settings.max_clients:
            await connection.close(TRY_AGAIN, f"{self._num_clients} clients are served already")
            return
        self._num_clients += 1
        try:
            await self._answer_all(connection)
        except ConnectionClosed:
            pass
        finally:
            self._num_clients -= 1

    async def _answer_all(self, connection: ServerConnection) -> None:
        loop = asyncio.get_running_loop()
        try:
            policy = await loop.run_in_executor(self._pool, self._new_policy)
            await connection.send(pack(self._metadata(policy)))
            total_ms: float | None = None
            while True:
                data = await connection.recv()
                began_s = time.perf_counter()
                message = await loop.run_in_executor(self._pool, self._answer, policy, data)
                if total_ms is not None:
                    message["server_timing"]["prev_total_ms"] = total_ms
                await connection.send(pack(message))
                total_ms = 1e3 * (time.perf_counter() - began_s)
        except ConnectionClosed:
            raise
        except REFUSALS as error:
            text = " ".join(str(error).split())
        except Exception:
            log.exception("a question could not be answered")
            text = "a bug of the server; its log has the details"
        await connection.send(text)
        await connection.close(INTERNAL_ERROR, "the text before this says why")

    def _new_policy(self) -> Policy:
        policy = self._make()
        policy.start()
        return policy

    def _metadata(self, policy: Policy) -> dict[str, Any]:
        return {
            "server": SERVER,
            "protocol": PROTOCOL,
            "policy": policy.name,
            "task": self._config.task,
            "sensor": self._config.sensor,
            "keys": dict(KEYS),
            "action_columns": list(ACTION_COLUMNS),
        }

    def _answer(self, policy: Policy, data: bytes | str) -> dict[str, Any]:
        """Answer one question as a run would decide it: by the same contract, read the same way."""
        began_s = time.perf_counter()
        if isinstance(data, str):
            raise WireError("a question must be a binary message (msgpack), got text")
        question = read_question(
            unpack(data), sensor=self._config.sensor, read_prompt=self._read_prompt
        )
        if question.is_first:
            policy.start()
        observation, contract = question.observation, question.contract
        _ = contract.terms  # a refused one has no answer, whatever is felt
        if unread := unread_reason(observation):
            decision = Decision(text=f"{unread}.", action=None, success=False, reason=unread)
        elif observation.in_contact is False:
            decision = NO_CONTACT_DECISION
        else:
            decision = decide(policy, observation, contract)
        message = answer_message(decision, contract)
        message["server_timing"] = {"infer_ms": 1e3 * (time.perf_counter() - began_s)}
        return message
