"""``tacgrasp train clip | cltp | llm | all``: from nothing to weights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.cli.flags import parse, subcommand
from tacgrasp.errors import UsageError

STAGES = {
    "clip": "Align the small CLIP on images and captions.",
    "cltp": "Align the tactile encoder with the frozen CLIP.",
    "llm": "Train the language model behind the encoder: text, projector, both together.",
    "all": "All three, one after the other.",
}


@dataclass(frozen=True)
class Train:
    """Train weights; the same command goes on where it was stopped, and repeats nothing.

    Attributes:
        out: Folder of weights; checkpoints lie in its .training.
        data: Folder of contacts; what is missing of it is made first.
        contacts: How many of them.
        seed: Of data, weights, order, noise and wordings.
        threads: Of torch; by default one for each core.
        blind_of: Train an instruction-blind copy of the language model behind this folder's
            encoder, for tacgrasp eval --blind (llm alone).
    """

    out: Path = Path("weights")
    data: Path = Path("runs/data")
    contacts: int = 24_000
    seed: int = 0
    threads: int | None = None
    blind_of: Path | None = None


def main(argv: Sequence[str]) -> int:
    """Train one stage, or all of them."""
    stage, rest = subcommand("train", argv, STAGES)
    if stage is None:
        return 0
    flags = parse(Train, rest, prog=f"tacgrasp train {stage}")
    if flags.threads is not None and flags.threads < 1:
        raise UsageError(f"--threads must be at least 1, got {flags.threads}")
    if flags.blind_of is not None and stage != "llm":
        raise UsageError("--blind-of is for `tacgrasp train llm`; the encoder sees no instructions")
    from tacgrasp import train

    if flags.blind_of is not None:
        train.take_encoder(flags.blind_of, flags.out)
    train.train(
        train.STAGES if stage == "all" else (stage,),
        out=flags.out,
        data=flags.data,
        contacts=flags.contacts,
        seed=flags.seed,
        blind=flags.blind_of is not None,
        threads=flags.threads,
        command=f"tacgrasp train {stage}",
    )
    return 0
