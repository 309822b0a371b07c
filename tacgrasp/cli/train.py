"""``tacgrasp train``: pre-train encoders, and train the weights of the language model."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import tyro

from cltp.train.recipes import CLIP_SCHEDULE, CLTP_SCHEDULE, ClipRecipe, CltpRecipe, Schedule
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand

if TYPE_CHECKING:
    from tacgrasp.pretraining.methods import PretrainingRun


@dataclass(frozen=True)
class MethodsFlags:
    """Flags of every stage that works on a folder of methods.

    Attributes:
        out: Folder of all methods: OUT/clip and OUT/METHOD/encoder.
        data: Folder of contacts, which must exist.
        seed: Random seed of weights, order and noise.
        threads: Threads of torch; one for each core when not given.
    """

    out: Path = Path("runs/methods")
    data: Path = Path("runs/tcl3d")
    seed: int = 0
    threads: int | None = None

    def run(
        self, command: str, *, precision: str = "no", tensorboard: bool = False
    ) -> AbstractContextManager[PretrainingRun]:
        """Open the folders, the progress and the processes of the command."""
        from tacgrasp.pretraining.run_all import pretraining_run

        return pretraining_run(
            self.out,
            self.data,
            seed=self.seed,
            command=command,
            threads=self.threads,
            precision=precision,
            tensorboard=tensorboard,
        )


@dataclass(frozen=True)
class TrainRandomFlags(MethodsFlags):
    """Write an encoder with random weights, into OUT/random.

    Attributes:
        preset: Name of the encoder; small when not given.
    """

    preset: str | None = None

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.pretraining.methods import pretrain

        with self.run(command) as run:
            pretrain("random", run, preset=self.preset)


@dataclass(frozen=True)
class PretrainingFlags(MethodsFlags):
    """Flags of every stage that pre-trains by gradients.

    Attributes:
        precision: Precision of matrix products.
        tensorboard: Also write curves for TensorBoard into OUT/tensorboard; needs that package.
    """

    precision: Literal["no", "bf16"] = "no"
    tensorboard: bool = False

    def training_run(self, command: str) -> AbstractContextManager[PretrainingRun]:
        return self.run(command, precision=self.precision, tensorboard=self.tensorboard)


@dataclass(frozen=True)
class TrainClipFlags(PretrainingFlags):
    """Align the small CLIP on images and captions, into OUT/clip.

    Attributes:
        steps: Optimiser steps.
        batch_size: Contacts in a step, of all processes together.
    """

    recipe: Annotated[ClipRecipe, tyro.conf.OmitArgPrefixes] = field(default_factory=ClipRecipe)
    steps: int = CLIP_SCHEDULE.steps
    batch_size: int = CLIP_SCHEDULE.batch_size

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.pretraining.methods import pretrain_clip

        schedule = replace(CLIP_SCHEDULE, steps=self.steps, batch_size=self.batch_size)
        with self.training_run(command) as run:
            pretrain_clip(run, self.recipe, schedule)


@dataclass(frozen=True)
class TrainMethodFlags(PretrainingFlags):
    """Pre-train an encoder by one method, into OUT/METHOD.

    Several processes: accelerate launch --num-processes N -m tacgrasp train ...

    Attributes:
        preset: Name of the encoder; by default small_graded for cltp, small_image for tvl and
            unitouch, which take frames, and small for the others.
        steps: Optimiser steps.
        batch_size: Contacts in a step, of all processes together.
    """

    preset: str | None = None
    steps: int = CLTP_SCHEDULE.steps
    batch_size: int = CLTP_SCHEDULE.batch_size

    @property
    def schedule(self) -> Schedule:
        return replace(CLTP_SCHEDULE, steps=self.steps, batch_size=self.batch_size)

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.pretraining.methods import pretrain

        with self.training_run(command) as run:
            pretrain(stage.replace("-", "_"), run, self.schedule, preset=self.preset)


@dataclass(frozen=True)
class TrainCltpFlags(TrainMethodFlags):
    """Align the tactile encoder with the frozen CLIP in OUT/clip, into OUT/cltp.

    Attributes:
        no_image: Leave L_T2I out (the paper's ablation); writes OUT/cltp_no_image.
        also: Folder of a further data set to learn from; nothing is measured on it.
    """

    recipe: Annotated[CltpRecipe, tyro.conf.OmitArgPrefixes] = field(default_factory=CltpRecipe)
    no_image: bool = False
    also: Path | None = None

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.pretraining.methods import pretrain

        method = "cltp_no_image" if self.no_image else "cltp"
        with self.training_run(command) as run:
            pretrain(
                method, run, self.schedule, preset=self.preset, recipe=self.recipe, also=self.also
            )


@dataclass(frozen=True)
class TrainProbeFlags(MethodsFlags):
    """Train MLPs on the frozen encoders in OUT, and measure them as tacgrasp eval probe does.

    Attributes:
        results: Folder of results.
        seeds: Number of seeds, counted from --seed.
    """

    results: Path = Path("runs/results")
    seeds: int = 1

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.pretraining.run_all import run_probes

        with self.run(command) as run:
            run_probes(run, self.results, self.seeds)


@dataclass(frozen=True)
class TrainAllMethodsFlags(TrainMethodFlags):
    """Pre-train CLIP and every method, CLTP with and without image; measure them; write the report.

    Attributes:
        clip: What the alignment of CLIP minimises.
        cltp: What the alignment of CLTP minimises.
        clip_steps: Optimiser steps of CLIP.
        results: Folder of results.
        seeds: Number of seeds of probes, counted from --seed; those after the first for CLTP alone.
    """

    clip: ClipRecipe = field(default_factory=ClipRecipe)
    cltp: CltpRecipe = field(default_factory=CltpRecipe)
    clip_steps: int = CLIP_SCHEDULE.steps
    results: Path = Path("runs/results")
    seeds: int = 1

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.pretraining.run_all import run_all_methods

        with self.training_run(command) as run:
            run_all_methods(
                run,
                self.results,
                seeds=self.seeds,
                clip_recipe=self.clip,
                clip_schedule=replace(CLIP_SCHEDULE, steps=self.clip_steps),
                cltp_recipe=self.cltp,
                schedule=self.schedule,
                preset=self.preset,
            )


@dataclass(frozen=True)
class TrainAllFlags:
    """Run clip, cltp and llm one after another, into one folder of weights.

    Attributes:
        out: Folder of weights; checkpoints and pre-training lie in its .training.
        data: Folder of contacts; missing ones are generated first.
        contacts: Number of contacts.
        seed: Random seed of data, weights, order, noise and wordings.
        threads: Threads of torch; one for each core when not given.
    """

    out: Path = Path("weights")
    data: Path = Path("runs/data")
    contacts: int = 24_000
    seed: int = 0
    threads: int | None = None

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.training.train import train_all

        train_all(**vars(self))


@dataclass(frozen=True)
class TrainLlmFlags(TrainAllFlags):
    """Train the language model behind the encoder and CLIP in OUT.

    Attributes:
        methods: Folder of pre-training from which the encoder and CLIP are copied into OUT first.
        blind_of: Folder of weights; trains an instruction-blind copy behind its encoder, for
            tacgrasp eval --blind.
    """

    methods: Path | None = None
    blind_of: Path | None = None

    def train(self, stage: str, command: str) -> None:
        from tacgrasp.training.train import train_language_model

        train_language_model(**vars(self))


STAGES: dict[str, tuple[type[Any], str]] = {
    "clip": (TrainClipFlags, "Align the small CLIP on images and captions."),
    "cltp": (TrainCltpFlags, "Align the tactile encoder with the frozen CLIP."),
    "llm": (TrainLlmFlags, "Train the language model: text, projector, both together."),
    "all": (TrainAllFlags, "clip, cltp and llm, one after another, into one folder of weights."),
    "point-mae": (TrainMethodFlags, "Baseline: reconstruct hidden patches of clouds."),
    "point-bert": (TrainMethodFlags, "Baseline: predict hidden patches in a vocabulary of shapes."),
    "tvl": (TrainMethodFlags, "Baseline: an image encoder aligned with words for textures."),
    "unitouch": (TrainMethodFlags, "Baseline: an image encoder aligned with names of objects."),
    "random": (TrainRandomFlags, "Floor: an encoder that has learned nothing."),
    "probe": (TrainProbeFlags, "MLPs on frozen encoders, measured as by tacgrasp eval probe."),
    "all-methods": (TrainAllMethodsFlags, "clip, cltp, all baselines, their tables, the report."),
}


def main(argv: Sequence[str]) -> int:
    """Train one stage; the same command continues where it was stopped, and repeats nothing."""
    summaries = {stage: summary for stage, (_, summary) in STAGES.items()}
    stage, rest = subcommand("train", argv, summaries)
    if stage is None:
        return 0
    flags = parse(STAGES[stage][0], rest, prog=f"tacgrasp train {stage}")
    for name in ("threads", "seeds"):
        count = getattr(flags, name, None)
        if count is not None and count < 1:
            raise UsageError(f"--{name} must be at least 1, got {count}")
    flags.train(stage, " ".join(["tacgrasp train", stage, *rest]))
    return 0
