"""Messages on the wire: written as openpi writes them, read within bounds."""

import msgpack
import numpy as np
import pytest

from tacgrasp.serving.wire import MAX_ITEMS, MAX_MESSAGE_BYTES, MAX_TEXT_BYTES, WireError
from tacgrasp.serving.wire import pack as written
from tacgrasp.serving.wire import unpack as read


def array(**changes):
    """An array of two float32 as openpi's client writes it, with fields changed."""
    fields = {"__ndarray__": True, "data": bytes(8), "dtype": "<f4", "shape": (2,)} | changes
    return msgpack.packb({"points": {key.encode(): value for key, value in fields.items()}})


def test_an_array_stands_on_the_wire_as_in_openpi():
    points = np.array([[1.0, 2.0, 3.0]], dtype="<f4")
    assert msgpack.unpackb(written({"points": points}), strict_map_key=False) == {
        "points": {
            b"__ndarray__": True,
            b"data": points.tobytes(),
            b"dtype": "<f4",
            b"shape": [1, 3],
        }
    }


@pytest.mark.parametrize("dtype", ["|b1", "|u1", "<i4", "<i8", "<f4", "<f8"])
def test_arrays_come_back_as_they_were(dtype):
    values = np.arange(6).reshape(2, 3).astype(dtype)
    again = read(written({"values": values}))["values"]
    assert again.dtype == values.dtype
    assert np.array_equal(again, values)


def test_numbers_texts_and_lists_come_back_exactly():
    message = {"pi": 0.1 + 0.2, "n": -3, "text": "für", "list": [None, True, {"x": 1.5}]}
    assert read(written(message)) == message


def test_a_numpy_scalar_is_a_number():
    scalar = {b"__npgeneric__": True, b"data": 1.5, b"dtype": "<f8"}
    assert read(msgpack.packb({"value": scalar})) == {"value": 1.5}


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"", "within the bounds"),
        (b"\xc1", "within the bounds"),
        (b"GET / HTTP/1.1", "within the bounds|must be a mapping"),
        (msgpack.packb([1, 2]), "must be a mapping"),
        (msgpack.packb({1: 2}), "within the bounds"),
        (msgpack.packb({b"key": 2}), "texts as keys"),
        (msgpack.packb({"x": msgpack.ExtType(5, b"code")}), "no extension types"),
        (msgpack.packb({"x": "a" * (MAX_TEXT_BYTES + 1)}), "within the bounds"),
        (msgpack.packb({"x": [0] * (MAX_ITEMS + 1)}), "within the bounds"),
        (b"\x91" * 5000, "within the bounds"),
        (bytes(MAX_MESSAGE_BYTES + 1), f"at most {MAX_MESSAGE_BYTES}"),
        (array(dtype="|O"), r"of a type out of .*, got '\|O'"),
        (array(dtype="V8"), "of a type out of"),
        (array(dtype=["<f4"]), "of a type out of|within the bounds"),
        (array(shape=(3,)), "has 12 bytes, got 8"),
        (array(shape=(-2,)), "at most 2 sizes"),
        (array(shape=(2**40, 2**40)), "at most 2 sizes"),
        (array(shape=(2, 1, 1)), "at most 2 sizes"),
        (array(shape=("2",)), "at most 2 sizes"),
        (array(data="ab"), "has 8 bytes, got str"),
    ],
)
def test_a_message_beyond_the_protocol_is_refused_in_one_line(data, expected):
    with pytest.raises(WireError, match=expected) as caught:
        read(data)
    assert "\n" not in str(caught.value)


def test_what_can_not_be_read_again_is_not_written():
    with pytest.raises(WireError, match="object"):
        written({"x": np.array([object()])})
    with pytest.raises(WireError, match="complex"):
        written({"x": 1j})
