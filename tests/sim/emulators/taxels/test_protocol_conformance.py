"""The emulated taxel array against docs/taxels.md, byte by byte, without our own parser."""

import os
import select
import struct
import time
import tty
import zlib

import numpy as np
import pytest

from sim.emulators.taxels.array import TaxelEmulator

SYNC = bytes.fromhex("A554585A")
HEADER = struct.Struct("<4sBBHHIIQ")
ROWS, COLUMNS = 8, 9


class Ramp:
    """Heights that tell rows, columns and signs apart: row minus half a column [0.1 mm]."""

    captures = 0

    def height_mm(self):
        self.captures += 1
        row, column = np.mgrid[0:ROWS, 0:COLUMNS]
        return (0.1 * row - 0.05 * column).astype(np.float32)


class Host:
    """The bytes of an array, cut into packets by the offsets of the document."""

    def __init__(self, path):
        self.fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.fd)
        self.data = b""

    def packet(self, seconds=5.0):
        """Header fields and the bytes of heights of the next whole packet."""
        deadline_s = time.monotonic() + seconds
        size = 30 + 2 * ROWS * COLUMNS + 4
        while time.monotonic() < deadline_s:
            start = self.data.find(SYNC)
            if start >= 0 and len(self.data) >= start + size:
                whole, self.data = self.data[start : start + size], self.data[start + size :]
                return whole
            if select.select([self.fd], [], [], 0.1)[0]:
                self.data += os.read(self.fd, 65536)
        raise AssertionError("no packet came")

    def mark(self, number, *, version=1, kind=2, spoil=False):
        head = HEADER.pack(SYNC, version, kind, 0, 0, 0, number, 0)
        check = struct.pack("<I", zlib.crc32(head) ^ spoil)
        os.write(self.fd, head + check)

    def marks_of(self, count):
        return [HEADER.unpack(self.packet()[:26])[6] for _ in range(count)]


@pytest.fixture
def array(tmp_path):
    emulator = TaxelEmulator(Ramp(), link=tmp_path / "array", rate_hz=100)
    yield emulator
    emulator.close()


@pytest.fixture
def host(array):
    one = Host(array.port)
    yield one
    os.close(one.fd)


def test_every_byte_of_a_frame_stands_where_the_document_says(host):
    whole = host.packet()
    sync, version, kind, rows, columns, sequence, mark, clock_us = HEADER.unpack(whole[:26])
    assert (sync, version, kind, rows, columns, mark) == (SYNC, 1, 1, ROWS, COLUMNS, 0)
    assert sequence >= 1 and clock_us > 0
    assert struct.unpack("<I", whole[26:30])[0] == zlib.crc32(whole[:26])
    assert struct.unpack("<I", whole[-4:])[0] == zlib.crc32(whole[30:-4])
    counts = np.frombuffer(whole[30:-4], "<i2").reshape(ROWS, COLUMNS)
    assert counts[3, 0] == 300 and counts[0, 4] == -200  # micrometres, row by row


def test_numbers_and_clock_go_up_from_one_after_power_up(tmp_path):
    array = TaxelEmulator(Ramp(), link=tmp_path / "fresh", rate_hz=20)
    host = Host(array.port)
    heads = [HEADER.unpack(host.packet()[:26]) for _ in range(4)]
    os.close(host.fd)
    array.close()
    numbers, clocks = [head[5] for head in heads], [head[7] for head in heads]
    assert numbers[0] <= 2 and numbers == list(range(numbers[0], numbers[0] + 4))
    assert clocks == sorted(set(clocks))


@pytest.mark.parametrize("number", [1, 77, 2**32 - 1])
def test_a_mark_is_in_every_frame_after_the_first_that_carries_it(host, number):
    host.mark(number)
    marks = host.marks_of(12)
    first = marks.index(number)
    assert set(marks[:first]) <= {0} and set(marks[first:]) == {number}


def test_the_last_of_several_marks_counts(host):
    for number in (5, 9, 6):
        host.mark(number)
    assert host.marks_of(12)[-1] == 6


@pytest.mark.parametrize("damage", [{"version": 2}, {"kind": 3}, {"spoil": True}])
def test_what_is_no_mark_is_skipped_and_the_next_mark_taken(host, damage):
    host.mark(4)
    assert host.marks_of(12)[-1] == 4
    host.mark(8, **damage)
    os.write(host.fd, b"\xa5TX\x5a\x00garbage")
    assert set(host.marks_of(8)) == {4}
    host.mark(9)
    assert host.marks_of(12)[-1] == 9


def test_a_frame_s_mark_was_received_before_its_capture(tmp_path):
    """'Take the number first, then capture': a mark during a capture is not in that frame."""

    class Slow(Ramp):
        def __init__(self):
            self.host, self.during = None, []

        def height_mm(self):
            if self.host is not None and not self.during:
                self.during.append(True)
                self.host.mark(50)
                time.sleep(0.05)
            return super().height_mm()

    source = Slow()
    array = TaxelEmulator(source, link=tmp_path / "slow", rate_hz=20)
    host = Host(array.port)
    before = HEADER.unpack(host.packet()[:26])[5]
    source.host = host
    heads = [HEADER.unpack(host.packet()[:26]) for _ in range(8)]
    os.close(host.fd)
    array.close()
    assert source.during
    first = next(head for head in heads if head[6] == 50)
    assert first[5] > before + 1  # at least one frame, the one under capture, came without it
    assert heads[-1][6] == 50
