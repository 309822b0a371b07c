"""A process to be killed: ``python -m tests.fakes.killed_recording run|record FOLDER PIPE``.

It records an episode and acknowledges each step on a pipe, with a checksum of the step's cloud,
when the writer's call has returned.
"""

import itertools
import os
import struct
import sys
import zlib
from pathlib import Path

from cltp.tactile.cloud import TactileCloud
from tacgrasp.episodes.writer import EpisodeWriter
from tests.fakes.episode_samples import header, step_record

READY = 0xFFFF_FFFF_FFFF_FFFF
WORD = struct.Struct("<Q")
"""On the pipe: ready, or the checksum of an acknowledged cloud."""


def checksum(cloud: TactileCloud) -> int:
    return zlib.crc32(cloud.points_mm.tobytes())


class AcknowledgingWriter(EpisodeWriter):
    pipe = -1

    def __enter__(self):
        entered = super().__enter__()
        os.write(self.pipe, WORD.pack(READY))
        return entered

    def write_step(self, record):
        super().write_step(record)
        os.write(self.pipe, WORD.pack(checksum(record.cloud)))


def main(kind: str, folder: Path, pipe: int) -> int:
    AcknowledgingWriter.pipe = pipe
    if kind == "run":
        from tacgrasp import __main__, run

        run.EpisodeWriter = AcknowledgingWriter
        return __main__.main(["run", "--task", "strawberry", "--record", str(folder)])
    with AcknowledgingWriter(folder / "killed.mcap", header()) as writer:
        for index in itertools.count():
            writer.write_step(step_record(index))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])))
