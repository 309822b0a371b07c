"""``--policy remote``: a policy that asks a server, and trusts nothing that it answers.

A server that is gone, silent, slow or wrong is a ``PolicyError``: the arm rests, the server is
asked again ``loop.max_faults`` times, on a new connection each time, and then the episode ends with
``fault``. Every wait is bounded, sending too.
"""

from __future__ import annotations

import contextlib
import socket
import struct
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any
from urllib.parse import urlsplit

from policies import Decision, Observation, PolicyError
from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.serving.answers import read_answer
from tacgrasp.serving.questions import question_message
from tacgrasp.serving.wire import MAX_MESSAGE_BYTES, WireError, pack, unpack

try:
    from websockets.exceptions import InvalidStatus, WebSocketException
    from websockets.sync.client import ClientConnection, connect
except ImportError as missing:
    raise UsageError(
        f"{missing.name} is not installed; a remote policy needs it: pip install 'tacgrasp[serve]'"
    ) from None

SERVER = "tacgrasp"
"""What our servers call themselves in their metadata."""

PROTOCOL = 1


class RemotePolicy:
    """A ``policies.Policy`` behind a websocket.

    Args:
        url: Address of the server, ``ws://host:port`` or ``wss://host:port``.
        timeout_s: Longest wait for a connection, and for each answer [s].
        key: Key that the server asks for; None without one.
        clock: Clock of the durations [s].

    Raises:
        UsageError: The address is none of a websocket.
    """

    name = "remote"

    def __init__(
        self,
        url: str,
        *,
        timeout_s: float,
        key: str | None = None,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        try:
            parts = urlsplit(url)
            is_address = parts.scheme in ("ws", "wss") and parts.hostname and parts.port != 0
        except ValueError:  # brackets that don't close, a port that is none
            is_address = False
        if not is_address:
            raise UsageError(f"--policy-url must be like ws://127.0.0.1:8000, got {url!r}")
        self._url, self._timeout_s, self._key, self._clock = url, timeout_s, key, clock
        self._connection: ClientConnection | None = None
        self._open = contextlib.ExitStack()
        self._is_first = True

    def connect(self) -> None:
        """Connect and read the server's metadata, which says what it serves.

        Raises:
            PolicyError: No server of this protocol answers in time.
        """
        headers = {"Authorization": f"Api-Key {self._key}"} if self._key else None
        try:
            self._connection = self._open.enter_context(
                connect(
                    self._url,
                    additional_headers=headers,
                    compression=None,
                    open_timeout=self._timeout_s,
                    close_timeout=0.1,
                    max_size=MAX_MESSAGE_BYTES,
                    proxy=None,
                )
            )
            _bound_sending(self._connection.socket, self._timeout_s)
            metadata = self._received()
            if metadata.get("server") != SERVER or metadata.get("protocol") != PROTOCOL:
                raise WireError(f"its metadata is of another server: {metadata!s:.120}")
        except InvalidStatus as error:
            self.drop()
            advice = "name its key with --policy-key-file" if _is_key(error) else "see its log"
            status = error.response.status_code
            raise PolicyError(
                f"the policy server {self._url} refuses ({status}): {advice}"
            ) from None
        except PolicyError:
            self.drop()
            raise
        except (OSError, WebSocketException, WireError) as error:
            raise self._failed(error) from None

    def start(self) -> None:
        self._is_first = True

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        """Ask the server.

        Raises:
            PolicyError: The server is gone, too slow, refuses, or its answer can't be used.
            LimitError: The contract is refused.
        """
        _ = contract.terms  # a refused one ends here
        began_s = self._clock()
        try:
            if self._connection is None:
                self.connect()
            assert self._connection is not None
            question = question_message(observation, contract, first=self._is_first)
            self._connection.send(pack(question))
            decision = read_answer(self._received(), contract)
        except PolicyError:
            self.drop()
            raise
        except (OSError, WebSocketException, WireError) as error:
            raise self._failed(error) from None
        self._is_first = False
        stages = {**decision.stage_ms, "remote": 1e3 * (self._clock() - began_s)}
        return replace(decision, stage_ms=stages)

    def drop(self) -> None:
        """Give the connection up at once; the next question makes a new one."""
        connection, self._connection = self._connection, None
        if connection is not None:
            with contextlib.suppress(OSError):  # no closing words to who may not listen
                connection.socket.shutdown(socket.SHUT_RDWR)
            with contextlib.suppress(OSError, WebSocketException):
                self._open.close()

    def _received(self) -> dict[str, Any]:
        assert self._connection is not None
        data = self._connection.recv(timeout=self._timeout_s)
        if isinstance(data, str):
            raise PolicyError(f"the policy server {self._url} says: {data[:400]}")
        return unpack(data)

    def _failed(self, error: Exception) -> PolicyError:
        self.drop()
        start = f"the policy server {self._url}"
        if isinstance(error, TimeoutError | BlockingIOError):
            return PolicyError(f"{start} gave no answer within {self._timeout_s:g} s")
        if isinstance(error, WireError):
            return PolicyError(f"{start} answered what can't be used: {error}")
        reason = str(error) or type(error).__name__
        return PolicyError(f"{start} is gone: {reason}; start it with tacgrasp serve")


def _bound_sending(connected: socket.socket, seconds: float) -> None:
    """A server that reads nothing must not hold the sender for ever."""
    whole = int(seconds)
    value = struct.pack("ll", whole, int(1e6 * (seconds - whole)))
    connected.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, value)


def _is_key(error: InvalidStatus) -> bool:
    return error.response.status_code in (401, 403)
