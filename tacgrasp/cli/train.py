"""``tacgrasp train``: from nothing to weights, by CLTP and by every method beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand

STAGES = {
    "clip": "Align the small CLIP on images and captions.",
    "cltp": "Align the tactile encoder with the frozen CLIP.",
    "llm": "Train the language model behind the encoder: text, projector, both together.",
    "all": "All three, one after the other.",
    "point-mae": "Baseline: draw hidden patches of clouds again.",
    "point-bert": "Baseline: name hidden patches in a vocabulary of local shapes.",
    "tvl": "Baseline: an image encoder aligned with words for how a surface feels.",
    "unitouch": "Baseline: an image encoder aligned with what is touched.",
    "random": "Floor: an encoder that has learned nothing.",
    "probe": "MLPs on frozen encoders; also measures them, as tacgrasp eval probe does.",
    "all-methods": "CLIP, CLTP with and without image, all baselines, their tables, the report.",
}

WEIGHTS = ("clip", "cltp", "llm", "all")
"""Stages that make the weights of the language model, with a model card."""


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
        methods: Take the encoder and CLIP from this folder, where they were pre-trained with a
            budget of their own (llm alone).
    """

    out: Path = Path("weights")
    data: Path = Path("runs/data")
    contacts: int = 24_000
    seed: int = 0
    threads: int | None = None
    blind_of: Path | None = None
    methods: Path | None = None


@dataclass(frozen=True)
class Pretrain:
    """Pre-train by one method, or all, with one budget; goes on where it was stopped.

    Several processes: accelerate launch --num-processes N -m tacgrasp train ...

    Attributes:
        out: Folder of all methods: OUT/clip and OUT/METHOD/encoder.
        data: Folder of contacts; it must be there.
        preset: Encoder; by default small_graded for cltp, small_image for tvl and unitouch, which
            see frames, and small for others.
        steps: Optimiser steps, the same for every method; by default 5000.
        batch_size: Contacts in a step; by default 64.
        clip_steps: Steps of CLIP; by default 400.
        no_image: Leave L_T2I out (cltp; it becomes OUT/cltp_no_image).
        texts: What CLTP and CLIP are told: the paper's captions, or half of the time a prompt for
            one dimension.
        prompt_weight: Of a contrast with one prompt for every class.
        head_weight: Of the state heads beside CLTP's losses; 0 is the paper.
        read_weight: Of letting CLIP's texts be read back (clip); 0 is a contrast alone.
        moved: Share of contacts, 0 to 1, that CLTP sees shifted and turned on the pad.
        also: A further data set that CLTP learns from (cltp); it is tried on none of it.
        precision: Of matrix products.
        seed: Of weights, order, noise and probes.
        seeds: Of probes (probe, all-methods): so many, counted from seed, for CLTP alone.
        results: Folder of results (probe, all-methods).
        threads: Of torch; by default one for each core.
        tensorboard: Also write curves for TensorBoard into OUT/tensorboard; needs that package.
    """

    out: Path = Path("runs/methods")
    data: Path = Path("runs/tcl3d")
    preset: str | None = None
    steps: int | None = None
    batch_size: int | None = None
    clip_steps: int | None = None
    no_image: bool = False
    texts: Literal["caption", "mixed"] = "mixed"
    prompt_weight: float = 1.0
    head_weight: float = 1.0
    read_weight: float = 1.0
    moved: float = 0.0
    also: Path | None = None
    precision: Literal["no", "bf16"] = "no"
    seed: int = 0
    seeds: int = 1
    results: Path = Path("runs/results")
    threads: int | None = None
    tensorboard: bool = False


def main(argv: Sequence[str]) -> int:
    """Train one stage or method, or all of them."""
    stage, rest = subcommand("train", argv, STAGES)
    if stage is None:
        return 0
    if stage in WEIGHTS and not _for_methods(rest):
        return _weights(stage, rest)
    if stage in ("llm", "all"):
        raise UsageError(f"tacgrasp train {stage} takes no flags of methods; see its --help")
    return _methods(stage, rest, " ".join(["tacgrasp train", stage, *rest]))


def _for_methods(rest: Sequence[str]) -> bool:
    """Whether flags speak of methods and budgets: CLIP and CLTP can be trained either way."""
    own = {"preset", "steps", "batch-size", "clip-steps", "no-image", "texts", "prompt-weight"}
    own |= {"head-weight", "read-weight", "moved", "also", "precision", "seeds", "results"}
    own |= {"tensorboard"}
    given = {token.split("=")[0].removeprefix("--").replace("_", "-") for token in rest}
    return bool(own & given)


def _weights(stage: str, rest: Sequence[str]) -> int:
    flags = parse(Train, rest, prog=f"tacgrasp train {stage}")
    if flags.threads is not None and flags.threads < 1:
        raise UsageError(f"--threads must be at least 1, got {flags.threads}")
    if flags.blind_of is not None and stage != "llm":
        raise UsageError("--blind-of is for `tacgrasp train llm`; the encoder sees no instructions")
    if flags.methods is not None and (stage != "llm" or flags.blind_of is not None):
        raise UsageError("--methods is for `tacgrasp train llm`, and not with --blind-of")
    from tacgrasp.training import train

    if flags.methods is not None:
        train.take_pretrained(flags.methods, flags.out)
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


def _methods(stage: str, rest: Sequence[str], command: str) -> int:
    flags = parse(Pretrain, rest, prog=f"tacgrasp train {stage}")
    if flags.threads is not None and flags.threads < 1:
        raise UsageError(f"--threads must be at least 1, got {flags.threads}")
    if flags.seeds < 1 or min(flags.prompt_weight, flags.head_weight, flags.read_weight) < 0:
        raise UsageError("--seeds must be at least 1, weights of losses at least 0")
    if not 0 <= flags.moved <= 1:
        raise UsageError(f"--moved is a share from 0 to 1, got {flags.moved}")
    if flags.no_image and stage != "cltp":
        raise UsageError("--no-image is for `tacgrasp train cltp`; all-methods trains both")
    if flags.also is not None and stage != "cltp":
        raise UsageError("--also is for `tacgrasp train cltp`; methods share one data set")
    from tacgrasp.pretraining.run_all import Order, carry_out

    carry_out(
        stage,
        Order(
            out=flags.out,
            data=flags.data,
            results=flags.results,
            preset=flags.preset,
            steps=flags.steps,
            batch_size=flags.batch_size,
            clip_steps=flags.clip_steps,
            with_images=not flags.no_image,
            texts=flags.texts,
            prompt_weight=flags.prompt_weight,
            head_weight=flags.head_weight,
            read_weight=flags.read_weight,
            moved=flags.moved,
            also=flags.also,
            precision=flags.precision,
            seed=flags.seed,
            seeds=flags.seeds,
            threads=flags.threads,
            tensorboard=flags.tensorboard,
            command=command,
        ),
    )
    return 0
