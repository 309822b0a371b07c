"""Mutations of bytes: what a broken disk, a cut connection or another program's file looks like."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

_INTEGERS = tuple(
    (value % (1 << 8 * size)).to_bytes(size, order)
    for size in (1, 2, 4, 8)
    for value in (0, 1, -1, 1 << 8 * size - 1, (1 << 8 * size - 1) - 1, 0x7F, 0x10)
    for order in ("little", "big")
)
_NUMBERS = (b"0", b"-1", b"1e999", b"nan", b"999999999", b"18446744073709551616", b"0x10")


def mutated(rng: Random, data: bytes, words: Sequence[bytes] = ()) -> bytes:
    """One to six random changes of ``data``; ``words`` of its format stand in for its own."""
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        _change(rng, changed, words)
    return bytes(changed)


def _change(rng: Random, data: bytearray, words: Sequence[bytes]) -> None:
    start = _place(rng, len(data))
    length = min(rng.choice((1, 1, 2, 4, 8, 40, 400)), len(data) - start)
    kind = rng.randrange(9)
    if kind == 0 and length:
        data[start] ^= 1 << rng.randrange(8)
    elif kind == 1 and length:
        data[start : start + length] = rng.randbytes(length)
    elif kind == 2:
        del data[start:]
    elif kind == 3:
        del data[start : start + length]
    elif kind == 4:
        data[start:start] = data[start : start + length] * rng.choice((1, 2, 100))
    elif kind == 5:
        value = rng.choice(_INTEGERS)
        data[start : start + len(value)] = value
    elif kind == 6:
        data[start : start + length] = rng.choice(_NUMBERS)
    elif kind == 7 and words:
        data[start : start + rng.choice((0, length))] = rng.choice(words)
    else:
        other = _place(rng, len(data))
        data[start : start + length] = data[other : other + length]


def _place(rng: Random, size: int) -> int:
    """A position; every other one in the first 200 bytes, where headers are."""
    return rng.randrange(min(size, 200 if rng.random() < 0.5 else size) + 1)
