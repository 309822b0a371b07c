"""What a damaged or hostile MCAP file announces is bounded before it is unpacked."""

import resource
import struct
import zlib
from pathlib import Path

import lz4.frame
import pytest
import zstandard
from mcap.opcode import Opcode
from mcap.writer import MCAP0_MAGIC

from tacgrasp.episodes import EpisodeError, read_episode
from tacgrasp.episodes.listing import info
from tacgrasp.episodes.record import FORMAT, METADATA_NAME
from tacgrasp.episodes.recover import recover
from tacgrasp.episodes.scan import MAX_BYTES, MAX_RECORDS, scan_file
from tests.fakes.episode_samples import record, step_record


def text(value: str) -> bytes:
    return struct.pack("<I", len(value)) + value.encode()


def one(opcode: int, payload: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(payload)) + payload


def metadata() -> bytes:
    pairs = text("format") + text(FORMAT)
    return one(Opcode.METADATA, text(METADATA_NAME) + struct.pack("<I", len(pairs)) + pairs)


def chunk(packed: bytes, size: int, compression: str, crc: int = 0) -> bytes:
    head = struct.pack("<QQQI", 0, 0, size, crc) + text(compression)
    return one(Opcode.CHUNK, head + struct.pack("<Q", len(packed)) + packed)


def channel(number: int, topic: str) -> bytes:
    head = struct.pack("<HH", number, 0)
    return one(Opcode.CHANNEL, head + text(topic) + text("json") + struct.pack("<I", 0))


def message(channel_number: int, data: bytes) -> bytes:
    return one(Opcode.MESSAGE, struct.pack("<HIQQ", channel_number, 0, 1, 1) + data)


def written(path: Path, *records: bytes) -> Path:
    path.write_bytes(MCAP0_MAGIC + metadata() + b"".join(records))
    return path


def refusal(path: Path) -> str:
    with pytest.raises(EpisodeError) as caught:
        read_episode(path)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("compression", ["lz4", "zstd"])
@pytest.mark.parametrize("honest", [True, False], ids=["its size told", "its size hidden"])
def test_a_chunk_that_grows_to_gigabytes_is_not_unpacked(
    compression: str, honest: bool, tmp_path: Path
) -> None:
    size = 1_000_000_000
    zeros = bytes(10_000_000)
    if compression == "lz4":
        packer = lz4.frame.LZ4FrameCompressor()
        packed = packer.begin() + b"".join(packer.compress(zeros) for _ in range(100))
        packed += packer.flush()
    else:
        stream = zstandard.ZstdCompressor().compressobj()
        packed = b"".join(stream.compress(zeros) for _ in range(100)) + stream.flush()
    assert len(packed) < 5_000_000
    path = written(tmp_path / "e.mcap", chunk(packed, size if honest else 1000, compression))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    expected = f"at most {MAX_BYTES} are unpacked" if honest else "ends before its header"
    assert expected in refusal(path)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000  # kB


def test_a_file_of_countless_records_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path / "e.mcap", one(0x7F, b"") * (MAX_RECORDS + 1))
    assert f"more than {MAX_RECORDS} records" in refusal(path)
    inside = one(0x7F, b"") * (MAX_RECORDS + 1)
    path = written(tmp_path / "f.mcap", chunk(inside, len(inside), ""))
    assert f"more than {MAX_RECORDS} records" in refusal(path)


def test_a_file_larger_than_any_episode_is_not_read(tmp_path: Path) -> None:
    path = written(tmp_path / "e.mcap")
    with path.open("r+b") as file:
        file.truncate(MAX_BYTES + 1)  # a sparse file: no byte of it is on the disk
    assert f"at most {MAX_BYTES} are read" in refusal(path)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"[" * 100_000, "nested too deep"),
        (b"[" + b"1," * 1_500_000 + b"1]", "at most 2000000 are read"),
        (b"9" * 5000, "can't be understood"),
        (b'{"seed": ' + b"9" * 40 + b"}", "field 'task' is missing"),
        (b'{"task": "' + b"x" * 3000 + b'"}', "is missing"),
    ],
)
def test_a_message_that_no_run_wrote_is_refused_in_a_short_line(
    data: bytes, expected: str, tmp_path: Path
) -> None:
    content = channel(1, "/episode") + message(1, data)
    path = written(tmp_path / "e.mcap", chunk(content, len(content), "", zlib.crc32(content)))
    assert expected in refusal(path)
    assert len(refusal(path)) < 600


def test_many_damaged_chunks_make_a_short_line(tmp_path: Path) -> None:
    path = written(tmp_path / "e.mcap", chunk(b"x", 1, "snappy") * 1000)
    problem = scan_file(path).problem
    assert "and 996 more" in problem
    assert len(problem) < 1000


def test_a_message_whose_channel_is_lost_is_left_out_by_recovery(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    record(path, [step_record(0)])
    data = path.read_bytes()
    content = message(77, b"{}")
    orphan = chunk(content, len(content), "", zlib.crc32(content))
    end = data.rindex(struct.pack("<BQ", Opcode.DATA_END, 4))
    path.write_bytes(data[:end] + orphan)
    recover(path, tmp_path / "whole.mcap")
    assert len(read_episode(tmp_path / "whole.mcap").steps) == 1
    info(tmp_path / "whole.mcap")
