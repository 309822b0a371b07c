"""``tacgrasp bench encoder|tcl3d``: what encoders and simulated contacts cost."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import writable


@dataclass(frozen=True)
class EncoderBenchFlags:
    """Time training and encoding beside a PointBERT of the same size, written plainly in torch.

    Attributes:
        preset: Name of the encoder: small, ulip2, ...
        repeats: Number of encodings of one cloud; batches and training steps take a tenth of it.
        threads: Number of torch's threads.
        json: File to write the figures to.
    """

    preset: str = "small"
    repeats: int = 100
    threads: int = 1
    json: Path | None = None


def encoder(flags: EncoderBenchFlags) -> None:
    """Run the benchmark of encoders."""
    if min(flags.repeats, flags.threads) < 1:
        raise UsageError("--repeats and --threads must be at least 1")
    json_path = writable(flags.json)
    from cltp.torch_threads import torch_threads
    from tacgrasp.benchmarks.learning import encoder as benchmark

    with torch_threads(flags.threads):
        benchmark.run(flags.preset, repeats=flags.repeats, json_path=json_path)


@dataclass(frozen=True)
class Tcl3dBenchFlags:
    """Time the making of contacts at a sensor's own resolution, from object to caption.

    Attributes:
        series: Number of series, four contacts each.
        workers: Number of processes, one thread each.
        device: Device for ray casting and contact solving: cpu or cuda.
        tacto: Python interpreter with TACTO installed, whose renderer is timed in the same run.
        json: File to write the figures to.
    """

    series: int = 60
    workers: int = 2
    device: str = "cpu"
    tacto: Path | None = None
    json: Path | None = None


def tcl3d(flags: Tcl3dBenchFlags) -> bool:
    """Run the benchmark of simulated contacts."""
    if flags.workers < 1 or flags.series < 2 * flags.workers:
        raise UsageError("--workers must be at least 1 and --series at least twice as many")
    from tacgrasp.benchmarks.learning import tcl3d as benchmark

    return benchmark.run(
        series=flags.series,
        workers=flags.workers,
        device=flags.device,
        tacto=flags.tacto,
        json_path=writable(flags.json),
    )
