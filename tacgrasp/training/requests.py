"""What ``tacgrasp train`` and ``tacgrasp eval`` do with weights; their flags are read into it.

Imports nothing heavy, so that ``--help`` answers at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Annotated, Literal

import tyro

from cltp.train.recipes import ALSO_FRACTION, HEADS_SCHEDULE, StockRecipe
from tacgrasp.base.errors import UsageError


def check_mixture(also: Path | None, fraction: float | None) -> None:
    """Refuse a fraction of nothing, or one that leaves out one of the two data sets.

    Raises:
        UsageError: A fraction without a further data set, or not between 0 and 1.
    """
    if fraction is None:
        return
    if also is None:
        raise UsageError("--also-fraction is of a further data set; name it with --also")
    if not 0 < fraction < 1:
        raise UsageError(f"--also-fraction must lie between 0 and 1, got {fraction:g}")


def check_at_least_1(flag: str, value: int | None) -> None:
    """Refuse a number below 1; None is a flag that was not given.

    Raises:
        UsageError: It is below 1.
    """
    if value is not None and value < 1:
        raise UsageError(f"{flag} must be at least 1, got {value}")


def also_fraction(also: Path | None, fraction: float | None, start: Path | None) -> float | None:
    """Fraction of a further data set in each batch; None draws every contact equally often."""
    if also is None or fraction is not None or start is None:
        return fraction
    return ALSO_FRACTION


@dataclass(frozen=True)
class EvaluationRequest:
    """Measure captions, numbers, answers, instructions and alignment on the test split.

    Pre-trained encoders: tacgrasp eval zero-shot, probe, retrieval, report.

    Attributes:
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        data: Folder of contacts, as tacgrasp train made it.
        json: JSON file for the figures.
        blind: Folder of an instruction-blind copy (tacgrasp train llm --blind-of).
        captions: Number of contacts to describe.
        answers: Number of contacts to ask about.
        goals: Number of contacts to advise on for a drawn force band.
        pairs: Number of instruction pairs.
        per_wording: Number of contacts for each kept-out instruction.
        seed: Random seed of the choice of contacts, of the sensor noise and of the wordings.
        card: Write the scores into the model card too.
    """

    weights: Path | None = None
    data: Path = Path("runs/full")
    json: Path | None = None
    blind: Path | None = None
    captions: int = 500
    answers: int = 150
    goals: int = 300
    pairs: int = 200
    per_wording: int = 1
    seed: int = 0
    card: bool = False

    def __post_init__(self) -> None:
        numbers = (self.captions, self.answers, self.goals, self.pairs, self.per_wording)
        if min(numbers) < 1 or self.seed < 0:
            raise UsageError("every number of eval must be at least 1, --seed at least 0")


@dataclass(frozen=True)
class TrainAllRequest:
    """Run clip, cltp and llm one after another, into one folder of weights.

    Attributes:
        out: Folder of weights; checkpoints and pre-training lie in its .training.
        data: Folder of contacts; missing ones are generated first.
        contacts: Number of contacts. Default: those of a complete data set, else 120000.
        seed: Random seed of data, weights, order, noise and wordings.
        threads: Threads of torch; one for each core when not given.
        precision: Precision of matrix products.
    """

    out: Path = Path("weights")
    data: Path = Path("runs/full")
    contacts: int | None = None
    seed: int = 0
    threads: int | None = None
    precision: Literal["no", "bf16"] = "no"


@dataclass(frozen=True)
class TrainLlmRequest(TrainAllRequest):
    """Train the language model behind the encoder and CLIP in OUT.

    Several processes: accelerate launch --num-processes N -m tacgrasp train llm ...

    Attributes:
        lm: Directory of a Qwen2, Qwen2.5, Qwen2.5-VL or Qwen3 in transformers' layout, to train
            behind instead of our own small model; nothing is downloaded, and it is not changed.
        recipe: How it is trained; only with --lm.
        methods: Folder of pre-training from which the encoder and CLIP are copied into OUT first.
        encoder: Folder with an encoder in it, of weights (or the word shipped) or of one method
            (runs/methods/point_mae), which is copied into OUT first; state heads are fitted on one
            that has none.
        heads_steps: Optimiser steps of these heads.
        blind_of: Folder of weights; trains an instruction-blind copy behind its encoder, for
            tacgrasp eval --blind.
        start: Folder of weights, or the word shipped, whose projector and language model are
            trained on, in fewer steps, instead of random ones.
        language: Folder of weights, or the word shipped, whose language model stands behind a new
            projector: it is trained on in all stages but the first, in which no encoder has a part.
        joint_steps: Optimiser steps with --start. Default: 1200; 300 with --also.
        also: Folder of a further data set to learn from, such as contacts of one's own.
        also_fraction: Fraction of it in each batch, between 0 and 1. Default: 0.5 with --start;
            without, the contacts of both sets come equally often.
        coarse: Fraction of the contacts, 0 to 1, that a few taxels feel instead of pixels.
    """

    lm: Path | None = None
    recipe: Annotated[StockRecipe, tyro.conf.OmitArgPrefixes] = field(default_factory=StockRecipe)
    methods: Path | None = None
    encoder: Path | None = None
    heads_steps: int = HEADS_SCHEDULE.steps
    blind_of: Path | None = None
    start: Path | None = None
    language: Path | None = None
    joint_steps: int | None = None
    also: Path | None = None
    also_fraction: float | None = None
    coarse: float = 0.0

    def __post_init__(self) -> None:
        if not 0 <= self.coarse <= 1:
            raise UsageError(f"--coarse must be a fraction from 0 to 1, got {self.coarse:g}")
        check_mixture(self.also, self.also_fraction)
        check_at_least_1("--heads-steps", self.heads_steps)
        sources = {
            "--methods": self.methods,
            "--encoder": self.encoder,
            "--blind-of": self.blind_of,
        }
        given = [flag for flag, folder in sources.items() if folder is not None]
        if len(given) > 1:
            raise UsageError(f"{' and '.join(given)} exclude each other")
        if self.lm is None and self.recipe != StockRecipe():
            changed = next(
                part.name
                for part in fields(StockRecipe)
                if getattr(self.recipe, part.name) != part.default
            )
            raise UsageError(
                f"--{changed.replace('_', '-')} is for a language model of others; name its "
                "directory with --lm"
            )
        models = {"--lm": self.lm, "--start": self.start, "--language": self.language}
        if len(given := [flag for flag, folder in models.items() if folder is not None]) > 1:
            raise UsageError(f"{' and '.join(given)} both name a language model; give one")
        if self.joint_steps is not None and (self.start is None or self.joint_steps < 1):
            raise UsageError("--joint-steps must be at least 1, and is for training on by --start")


@dataclass(frozen=True)
class RefitRequest:
    """What is fitted after the training of an encoder, fitted anew.

    Attributes:
        weights: Folder of weights, or of one method.
        data: Folder of contacts, which must exist.
        coarse: Fraction of contacts that are felt by a coarse sensor, as in their training.
        seed: Random seed of contacts, noise and fit.
    """

    weights: Path
    data: Path = Path("runs/full")
    coarse: float = 0.0
    seed: int = 0
