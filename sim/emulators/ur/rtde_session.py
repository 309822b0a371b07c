"""A client's connection to the RTDE port of an emulated controller: versions, recipes, data.

What the guide leaves open is our choice, each marked at its place: a packet whose payload does not
fit its type is answered with a text message of level error and has no other effect, since the
stream of packets stays readable. A size that no packet has closes the connection.

Source: Universal Robots' RTDE guide, protocol versions 1 and 2; what ur_rtde 1.6.5 asks for.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass

from sim.emulators.ur import packets as rtde
from sim.emulators.ur.controller import Controller
from sim.emulators.ur.sessions import Session

VERSIONS = (1, 2)
FASTEST_HZ = 500.0
LARGEST_ID = 255
"""Recipe ids are one byte; 0 says that a recipe was not accepted."""


@dataclass(frozen=True, slots=True)
class Recipe:
    """Variables of a data packet in their order, and the packet's layout."""

    names: Sequence[str]
    sizes: Sequence[int]
    layout: struct.Struct


class RtdeSession(Session):
    """One RTDE connection; it speaks protocol version 1 until another one is requested.

    Attributes:
        period_s: Requested time between data packets [s].
        streaming: The client has started the data stream.
    """

    def __init__(
        self, controller: Controller, version: tuple[int, int], taken: dict[str, RtdeSession]
    ) -> None:
        """``taken``: owners of the input variables, shared by all sessions of a controller."""
        self._controller, self._version, self._taken = controller, version, taken
        self._buffer = bytearray()
        self._inputs: list[Recipe] = []
        self._outputs: Recipe | None = None
        self._protocol = 1
        self.period_s = 1.0 / FASTEST_HZ
        self.streaming = False

    def receive(self, data: bytes) -> bytes:
        self._buffer += data
        return b"".join(self._answer(kind, body) for kind, body in rtde.split(self._buffer))

    def close(self) -> None:
        for name in [name for name, owner in self._taken.items() if owner is self]:
            del self._taken[name]

    def data(self) -> bytes:
        """The next data packet; a variable that is not emulated is all zeros."""
        if self._outputs is None:
            return b""
        values: list[float] = []
        for name, count in zip(self._outputs.names, self._outputs.sizes, strict=True):
            current = self._controller.values(name)
            values += current if len(current) == count else [0] * count
        recipe_id = b"\x01" if self._protocol == 2 else b""
        return rtde.packet(rtde.DATA, recipe_id + self._outputs.layout.pack(*values))

    def _answer(self, kind: int, body: bytes) -> bytes:
        if kind == rtde.VERSION:
            return self._choose_version(body)
        if kind == rtde.CONTROLLER_VERSION:
            return rtde.packet(kind, struct.pack(">4I", *self._version, 0, 0))
        if kind == rtde.OUTPUTS:
            return self._set_outputs(body)
        if kind == rtde.INPUTS:
            return self._set_inputs(body)
        if kind == rtde.DATA:
            return self._write(body)
        if kind == rtde.START:
            self.streaming = self._outputs is not None
            return rtde.packet(kind, bytes([self.streaming]))
        if kind == rtde.PAUSE:
            self.streaming = False
            return rtde.packet(kind, b"\x01")
        if kind == rtde.MESSAGE:
            return b""  # of the client, for the controller's log
        return self._error(f"unknown package type {kind}")

    def _error(self, text: str) -> bytes:
        return rtde.text_message(self._protocol, text)

    def _choose_version(self, body: bytes) -> bytes:
        """Take a version, or refuse it and go on with the one before."""
        if len(body) != 2:
            return self._error(f"expected a protocol version of 2 bytes, got {len(body)}")
        (version,) = struct.unpack(">H", body)
        if version in VERSIONS:
            self._protocol = version
        return rtde.packet(rtde.VERSION, bytes([version in VERSIONS]))

    def _set_outputs(self, body: bytes) -> bytes:
        """Set the one output recipe; a refused one leaves the recipe before in place.

        A rate outside of 1 to 500 Hz leaves the rate as it is. Our choice, as the last sentence.
        """
        if self._protocol == 2:
            if len(body) < 8:
                return self._error(f"expected an output frequency of 8 bytes, got {len(body)}")
            (rate_hz,) = struct.unpack_from(">d", body)
            if 1.0 <= rate_hz <= FASTEST_HZ:
                self.period_s = 1.0 / rate_hz
            body = body[8:]
        names = rtde.names_in(body)
        types = rtde.types_of(names, rtde.OUTPUT_TYPES)
        if names and "NOT_FOUND" not in types:
            self._outputs = _recipe(names, types)
        recipe_id = b"\x01" if self._protocol == 2 else b""
        return rtde.packet(rtde.OUTPUTS, recipe_id + ",".join(types).encode())

    def _set_inputs(self, body: bytes) -> bytes:
        """Add an input recipe; with a variable that is unknown or in use, none and id 0."""
        names = rtde.names_in(body)
        types = rtde.types_of(names, rtde.INPUT_TYPES)
        for i, name in enumerate(names):
            if self._taken.get(name, self) is not self:
                types[i] = "IN_USE"
        refused = not names or "IN_USE" in types or "NOT_FOUND" in types
        if refused or len(self._inputs) == LARGEST_ID:
            return rtde.packet(rtde.INPUTS, b"\x00" + ",".join(types).encode())
        for name in names:
            self._taken[name] = self
        self._inputs.append(_recipe(names, types))
        return rtde.packet(rtde.INPUTS, bytes([len(self._inputs)]) + ",".join(types).encode())

    def _write(self, body: bytes) -> bytes:
        """Write input variables; there is no answer to a whole packet."""
        if not body or not 1 <= body[0] <= len(self._inputs):
            return self._error(f"no input recipe {body[0] if body else 'in an empty data packet'}")
        recipe = self._inputs[body[0] - 1]
        if len(body) - 1 != recipe.layout.size:
            expected = recipe.layout.size
            return self._error(f"input recipe {body[0]} has {expected} bytes, got {len(body) - 1}")
        values = list(recipe.layout.unpack_from(body, 1))
        for name, size in zip(recipe.names, recipe.sizes, strict=True):
            if size == 1:
                self._controller.inputs[name] = values[0]
            del values[:size]
        self._controller.on_inputs("input_int_register_0" in recipe.names)
        return b""


def _recipe(names: Sequence[str], types: Sequence[str]) -> Recipe:
    return Recipe(names, [rtde.num_values(kind) for kind in types], rtde.layout(types))
