"""The wire format of taxel arrays: what is sent is read, whatever happens to the bytes between."""

import zlib
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from cltp.errors import TouchError
from cltp.sensing.taxel_packets import (
    HEADER_BYTES,
    MAX_TAXELS,
    SYNC,
    PacketParser,
    SequenceCount,
    TaxelFrame,
    TaxelMark,
    counts_of,
    encode_frame,
    encode_mark,
    frame_bytes,
)

U32 = st.integers(0, 2**32 - 1)
GRIDS = st.tuples(st.integers(1, 9), st.integers(1, 9)).flatmap(
    lambda shape: arrays(np.int16, shape)
)
NUMBERS = {"sequence": U32, "mark": U32, "clock_us": st.integers(0, 2**64 - 1)}
HEIGHT_FRAMES = st.builds(TaxelFrame, counts_um=GRIDS, **NUMBERS)
SHEAR_FRAMES = GRIDS.flatmap(
    lambda counts: st.builds(
        TaxelFrame,
        counts_um=st.just(counts),
        along_um=arrays(np.int16, (*counts.shape, 2)),
        **NUMBERS,
    )
)
FRAMES = HEIGHT_FRAMES | SHEAR_FRAMES


def frame(sequence=1, value=100, shape=(8, 10)):
    return TaxelFrame(
        sequence=sequence, mark=0, clock_us=0, counts_um=np.full(shape, value, np.int16)
    )


def same(a, b):
    is_same = (a.sequence, a.mark, a.clock_us) == (b.sequence, b.mark, b.clock_us)
    if a.along_um is None or b.along_um is None:
        is_same &= a.along_um is b.along_um
    else:
        is_same &= np.array_equal(a.along_um, b.along_um)
    return is_same and np.array_equal(a.counts_um, b.counts_um)


def pieces(data, cuts):
    places = [0, *sorted(cut % (len(data) + 1) for cut in cuts), len(data)]
    return [data[a:b] for a, b in pairwise(places)]


@given(st.lists(FRAMES, max_size=4), st.lists(st.integers(0), max_size=8))
def test_frames_come_back_whole_however_the_stream_is_cut(frames, cuts):
    parser = PacketParser()
    stream = b"".join(encode_frame(one) for one in frames)
    found = [one for piece in pieces(stream, cuts) for one in parser.feed(piece)]
    assert len(found) == len(frames)
    assert all(same(a, b) for a, b in zip(found, frames, strict=True))
    assert (parser.counts.damaged, parser.counts.garbage_bytes) == (0, 0)


@given(FRAMES, st.binary(max_size=200), st.lists(st.integers(0), max_size=4))
def test_garbage_before_a_frame_does_not_hide_it(one, garbage, cuts):
    parser = PacketParser()
    # a second frame ends whatever the garbage seems to have begun
    stream = garbage + encode_frame(one) + encode_frame(frame())
    found = [got for piece in pieces(stream, cuts) for got in parser.feed(piece)]
    assert same(found[-2], one)
    assert parser.counts.garbage_bytes == len(garbage)


@given(FRAMES, st.integers(0), st.integers(1, 255))
@settings(max_examples=200)
def test_a_changed_byte_anywhere_is_noticed_and_the_next_frame_is_found(one, place, change):
    packet = bytearray(encode_frame(one))
    packet[place % len(packet)] ^= change
    parser = PacketParser()
    found = parser.feed(bytes(packet) + encode_frame(frame(sequence=77)))
    assert len(found) == 1 and found[0].sequence == 77
    assert parser.counts.garbage_bytes == len(packet)


@given(FRAMES, st.integers(1))
def test_the_frame_behind_a_torn_one_is_not_lost(one, cut):
    packet = encode_frame(one)
    torn = packet[: cut % len(packet)]
    parser = PacketParser()
    # what the torn one still waits for may be longer than the next one: more has to come
    following = [frame(sequence=n) for n in range(5)]
    found = parser.feed(torn + b"".join(encode_frame(f) for f in following))
    assert [f.sequence for f in found] == [0, 1, 2, 3, 4]


@given(st.binary(max_size=400))
def test_bytes_that_are_no_packets_give_none(data):
    parser = PacketParser()
    assert parser.feed(data) == [] and parser.counts.packets == 0


def test_a_header_that_claims_a_huge_frame_is_not_waited_for():
    packet = bytearray(encode_frame(frame()))
    packet[6:10] = b"\xff\xff\xff\xff"
    packet[HEADER_BYTES - 4 : HEADER_BYTES] = zlib.crc32(packet[: HEADER_BYTES - 4]).to_bytes(
        4, "little"
    )
    parser = PacketParser()
    assert [f.sequence for f in parser.feed(bytes(packet) + encode_frame(frame(9)))] == [9]
    assert parser.counts.foreign == 1


def test_a_frame_is_laid_out_as_documented():
    packet = encode_frame(
        TaxelFrame(sequence=0x01020304, mark=5, clock_us=6, counts_um=np.array([[1, -2]], np.int16))
    )
    assert packet[:26].hex() == (
        "a554585a" "01" "01" "0100" "0200" "04030201" "05000000" "0600000000000000"
    )  # fmt: skip
    assert packet[30:34] == bytes([1, 0, 0xFE, 0xFF])
    assert packet[34:] == zlib.crc32(packet[30:34]).to_bytes(4, "little")


def test_a_frame_of_displacements_is_laid_out_as_documented():
    counts, along = np.array([[3, -6]], np.int16), np.array([[[1, 2], [-4, -5]]], np.int16)
    packet = encode_frame(
        TaxelFrame(sequence=1, mark=0, clock_us=0, counts_um=counts, along_um=along)
    )
    assert packet[4:6] == bytes([2, 1])
    assert np.frombuffer(packet[30:42], "<i2").tolist() == [1, 2, 3, -4, -5, -6]
    assert packet[42:] == zlib.crc32(packet[30:42]).to_bytes(4, "little")


def test_a_hundred_frames_of_twelve_by_twelve_displacements_fit_the_line():
    counts = np.zeros((12, 12), np.int16)
    one = TaxelFrame(
        sequence=1, mark=0, clock_us=0, counts_um=counts, along_um=np.zeros((12, 12, 2), np.int16)
    )
    size = len(encode_frame(one))
    assert size == frame_bytes(12, 12, with_shear=True) == 898
    assert 10 * 100 * size <= 921_600  # start bit, 8 bits, stop bit
    assert len(encode_frame(frame())) == frame_bytes(8, 10, with_shear=False)


def test_a_version_that_nobody_knows_is_foreign():
    for version in (0, 3):
        packet = bytearray(encode_frame(frame(5)))
        packet[4] = version
        packet[26:30] = zlib.crc32(packet[:26]).to_bytes(4, "little")
        parser = PacketParser()
        assert [f.sequence for f in parser.feed(bytes(packet) + encode_frame(frame(9)))] == [9]
        assert parser.counts.foreign == 1


def test_marks_go_the_other_way():
    parser = PacketParser()
    assert parser.feed(b"noise" + encode_mark(7) + encode_mark(2**32 - 1)) == [
        TaxelMark(mark=7),
        TaxelMark(mark=2**32 - 1),
    ]
    for wrong in (0, -1, 2**32):
        with pytest.raises(TouchError, match="mark"):
            encode_mark(wrong)


def test_a_partial_sync_at_the_end_is_kept():
    parser = PacketParser()
    packet = encode_frame(frame(3))
    assert parser.feed(b"x" + packet[:2]) == []
    assert [f.sequence for f in parser.feed(packet[2:])] == [3]
    assert parser.counts.garbage_bytes == 1 and packet[:4] == SYNC


def test_heights_are_rounded_to_micrometres_and_refused_when_they_do_not_fit():
    heights = np.array([[0.0004, -0.0316], [1.2346, 3.0]])
    assert counts_of(heights).tolist() == [[0, -32], [1235, 3000]]
    for wrong in (np.nan, np.inf, 40.0):
        with pytest.raises(TouchError, match="finite"):
            counts_of(np.array([[wrong]]))


def test_a_frame_that_is_no_grid_is_refused():
    for counts in (
        np.zeros(4, np.int16),
        np.zeros((2, 2), np.int32),
        np.zeros((0, 4), np.int16),
        np.zeros((1, MAX_TAXELS + 1), np.int16),
    ):
        with pytest.raises(TouchError, match="taxel frame"):
            TaxelFrame(sequence=0, mark=0, clock_us=0, counts_um=counts)
    for along in (np.zeros((2, 2), np.int16), np.zeros((2, 2, 2), np.int32)):
        with pytest.raises(TouchError, match="along the gel"):
            TaxelFrame(
                sequence=0,
                mark=0,
                clock_us=0,
                counts_um=np.zeros((2, 2), np.int16),
                along_um=along,
            )
    with pytest.raises(TouchError, match="32 bits"):
        TaxelFrame(sequence=2**32, mark=0, clock_us=0, counts_um=np.zeros((2, 2), np.int16))


def test_missing_repeated_and_restarted_numbers_are_counted():
    seen = SequenceCount()
    new = [seen.is_new(n) for n in (2**32 - 2, 2**32 - 1, 0, 0, 3, 1)]
    assert new == [True, True, True, False, True, True]
    assert (seen.missing, seen.repeated, seen.restarts) == (2, 1, 1)
