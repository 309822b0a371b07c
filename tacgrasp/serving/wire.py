"""Messages on the wire: msgpack whose arrays are written as openpi's client writes them.

An array is ``{b"__ndarray__": True, b"data": bytes, b"dtype": text, b"shape": sizes}``, a numpy
scalar ``{b"__npgeneric__": True, b"data": number, b"dtype": text}``. Everything is bounded before
it is allocated; there is no pickle, and no type beyond those of JSON, bytes and arrays.

Source: Physical-Intelligence/openpi, ``openpi_client/msgpack_numpy.py`` (15a9616).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tacgrasp.base.errors import UsageError

try:
    import msgpack
except ImportError as missing:
    raise UsageError(
        f"{missing.name} is not installed; serving a policy needs it: pip install 'tacgrasp[serve]'"
    ) from None

MAX_MESSAGE_BYTES = 4 * 1024 * 1024
"""Longest message. A cloud of a point a pixel (76,800) in float64 has 1.8 MB."""

MAX_ITEMS = 1000
"""Most entries of a mapping or list."""

MAX_TEXT_BYTES = 8000
"""Longest text: four bytes for each of its ``policies.extraction.extraction.MAX_CHARACTERS``."""

DTYPES = frozenset({"|b1", "|u1", "<i4", "<i8", "<f4", "<f8"})
"""Types of arrays that are read."""

MAX_DIMENSIONS = 2


class WireError(Exception):
    """A message that is not one of this protocol, or beyond its bounds."""


def pack(message: dict[str, Any]) -> bytes:
    """Write a message of plain values and arrays.

    Raises:
        WireError: A value of another type; the message names it.
    """
    try:
        data: bytes = msgpack.packb(message, default=_written)
    except (TypeError, ValueError, OverflowError) as error:
        raise WireError(f"a message can't carry this: {error}") from None
    return data


def unpack(data: bytes) -> dict[str, Any]:
    """Read a message.

    Raises:
        WireError: It is damaged, too large, or holds what the protocol has not.
    """
    if len(data) > MAX_MESSAGE_BYTES:
        raise WireError(f"a message has at most {MAX_MESSAGE_BYTES} bytes, got {len(data)}")
    try:
        message = msgpack.unpackb(
            data,
            object_hook=_read,
            ext_hook=_refuse_extension,
            max_str_len=MAX_TEXT_BYTES,
            max_bin_len=MAX_MESSAGE_BYTES,
            max_array_len=MAX_ITEMS,
            max_map_len=MAX_ITEMS,
        )
    except WireError:
        raise
    except (ValueError, TypeError, KeyError, RecursionError, msgpack.UnpackException) as error:
        reason = str(error) or type(error).__name__
        raise WireError(f"a message must be msgpack within the bounds: {reason:.200}") from None
    if not isinstance(message, dict) or not all(isinstance(key, str) for key in message):
        raise WireError("a message must be a mapping with texts as keys")
    return message


def _written(value: object) -> object:
    if isinstance(value, np.ndarray):
        if value.dtype.str not in DTYPES:
            raise TypeError(f"an array of {value.dtype}")
        return {
            b"__ndarray__": True,
            b"data": value.tobytes(),
            b"dtype": value.dtype.str,
            b"shape": value.shape,
        }
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a {type(value).__name__}")


def _read(mapping: dict[Any, Any]) -> Any:
    if b"__ndarray__" in mapping:
        return _array(mapping)
    if b"__npgeneric__" in mapping:
        value = mapping.get(b"data")
        if not isinstance(value, (bool, int, float)):
            raise WireError(f"a numpy scalar must be a number, got {type(value).__name__}")
        return value
    return mapping


def _array(mapping: dict[Any, Any]) -> np.ndarray:
    data, dtype, shape = (mapping.get(key) for key in (b"data", b"dtype", b"shape"))
    if dtype not in DTYPES:
        known = ", ".join(sorted(DTYPES))
        raise WireError(f"an array must be of a type out of {known}, got {dtype!r:.40}")
    if not (
        isinstance(shape, list)
        and len(shape) <= MAX_DIMENSIONS
        and all(type(size) is int and 0 <= size <= MAX_MESSAGE_BYTES for size in shape)
    ):
        raise WireError(f"an array has at most {MAX_DIMENSIONS} sizes, got {shape!r:.80}")
    kind = np.dtype(dtype)
    expected = math.prod(shape) * kind.itemsize
    if not isinstance(data, bytes) or len(data) != expected:
        got = len(data) if isinstance(data, bytes) else type(data).__name__
        raise WireError(f"an array of {shape} {dtype} has {expected} bytes, got {got}")
    return np.frombuffer(data, dtype=kind).reshape(shape)


def _refuse_extension(code: int, _: bytes) -> object:
    raise WireError(f"a message has no extension types, got {code}")
