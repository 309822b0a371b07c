"""``tacgrasp bench encoder``: how fast encoders are, beside the reference design."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, writable


@dataclass(frozen=True)
class Encoder:
    """Time training and encoding beside a PointBERT of the same size, written plainly in torch.

    Attributes:
        preset: Whose sizes: small, ulip2, ...
        repeats: Encodings of one cloud; a tenth of it for batches and steps.
        threads: Of torch.
        json: File for the figures.
    """

    preset: str = "small"
    repeats: int = 100
    threads: int = 1
    json: Path | None = None


def encoder(argv: Sequence[str]) -> None:
    """Time encoders beside a PointBERT of the same size."""
    flags = parse(Encoder, argv, prog="tacgrasp bench encoder")
    if min(flags.repeats, flags.threads) < 1:
        raise UsageError("--repeats and --threads must be at least 1")
    json_path = writable(flags.json)
    import torch

    from tacgrasp.benchmarks.learning import encoder as bench_encoder

    torch.set_num_threads(flags.threads)
    bench_encoder.run(flags.preset, repeats=flags.repeats, json_path=json_path)
