"""``tacgrasp train``: pre-train encoders, and train the weights of the language model."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import tyro

from cltp.train.recipes import (
    CLIP_SCHEDULE,
    CLTP_SCHEDULE,
    CLTP_TUNING,
    ClipRecipe,
    CltpRecipe,
    OptimiserName,
    Schedule,
    by_muon,
)
from tacgrasp.base.errors import UsageError
from tacgrasp.base.folders import check_folder
from tacgrasp.cli.flags import parse, subcommand
from tacgrasp.training.requests import (
    RefitRequest,
    TrainAllRequest,
    TrainLlmRequest,
    also_fraction,
    check_at_least_1,
    check_mixture,
)

if TYPE_CHECKING:
    from cltp.train.stage import ProgressReport
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

    def train(self, stage: str, command: str) -> None:
        """Open the folders, the progress and the processes of a stage, and train in them."""
        from cltp.data.dataset import read_header

        read_header(self.data)  # what is no data set is refused before torch is loaded
        from tacgrasp.pretraining.methods import pretraining_run

        names = ("out", "data", "seed", "threads", "precision", "tensorboard")
        shared = {name: value for name, value in vars(self).items() if name in names}
        with pretraining_run(**shared, command=command) as run:
            self.train_in(run, stage)

    def train_in(self, run: PretrainingRun, stage: str) -> None:
        raise NotImplementedError


@dataclass(frozen=True)
class TrainRandomFlags(MethodsFlags):
    """Write an encoder with random weights, into OUT/random.

    Attributes:
        preset: Name of the encoder; small when not given.
    """

    preset: str | None = None

    def train_in(self, run: PretrainingRun, stage: str) -> None:
        from tacgrasp.pretraining.methods import pretrain

        pretrain("random", run, preset=self.preset)


@dataclass(frozen=True)
class PretrainingFlags(MethodsFlags):
    """Flags of every stage that pre-trains by gradients.

    Attributes:
        precision: Precision of matrix products.
        tensorboard: Also write curves for TensorBoard into OUT/tensorboard; needs that package.
        steps: Optimiser steps. Default: 5000, of clip 400; 400 for cltp with --start.
        batch_size: Contacts in a step, of all processes together.
        optimiser: What moves the weights. Muon needs far fewer steps (docs/pretraining.md).
    """

    precision: Literal["no", "bf16"] = "no"
    tensorboard: bool = False
    steps: int | None = None
    batch_size: int = CLTP_SCHEDULE.batch_size
    optimiser: OptimiserName = "adamw"

    def __post_init__(self) -> None:
        check_at_least_1("--steps", self.steps)
        check_at_least_1("--batch-size", self.batch_size)

    def schedule(self, usual: Schedule = CLTP_SCHEDULE) -> Schedule:
        steps = usual.steps if self.steps is None else self.steps
        schedule = replace(usual, steps=steps, batch_size=self.batch_size)
        return by_muon(schedule) if self.optimiser == "muon" else schedule


@dataclass(frozen=True)
class TrainClipFlags(PretrainingFlags):
    """Align the small CLIP on images and captions, into OUT/clip."""

    batch_size: int = CLIP_SCHEDULE.batch_size
    recipe: Annotated[ClipRecipe, tyro.conf.OmitArgPrefixes] = field(default_factory=ClipRecipe)

    def train_in(self, run: PretrainingRun, stage: str) -> None:
        from tacgrasp.pretraining.methods import pretrain_clip

        pretrain_clip(run, self.recipe, self.schedule(CLIP_SCHEDULE))


@dataclass(frozen=True)
class TrainMethodFlags(PretrainingFlags):
    """Pre-train an encoder by one method, into OUT/METHOD.

    Several processes: accelerate launch --num-processes N -m tacgrasp train ...

    Attributes:
        preset: Name of the encoder; by default grid for cltp, small_image for tvl and unitouch,
            which take frames, and small for the others.
    """

    preset: str | None = None

    def train_in(self, run: PretrainingRun, stage: str) -> None:
        from tacgrasp.pretraining.methods import pretrain

        pretrain(stage.replace("-", "_"), run, self.schedule(), preset=self.preset)


@dataclass(frozen=True)
class TrainCltpFlags(TrainMethodFlags):
    """Align the tactile encoder with the frozen CLIP in OUT/clip, into OUT/cltp.

    Attributes:
        no_image: Leave L_T2I out (the paper's ablation); writes OUT/cltp_no_image.
        also: Folder of a further data set to learn from, such as contacts of one's own.
        also_fraction: Fraction of it in each batch, between 0 and 1. Default: 0.5 with --start;
            without, the contacts of both sets come equally often.
        start: Folder of weights, or the word shipped: its encoder is trained on, behind its towers,
            instead of a random one.
        learning_rate: Learning rate at its peak. Default: 0.002, of muon 0.005;
            0.0005 with --start.
    """

    recipe: Annotated[CltpRecipe, tyro.conf.OmitArgPrefixes] = field(default_factory=CltpRecipe)
    no_image: bool = False
    also: Path | None = None
    also_fraction: float | None = None
    start: Path | None = None
    learning_rate: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        check_mixture(self.also, self.also_fraction)
        if self.learning_rate is not None and not self.learning_rate > 0:
            raise UsageError(f"--learning-rate must be above 0, got {self.learning_rate:g}")

    def train(self, stage: str, command: str) -> None:
        """As every stage, after a check that the encoder to start from can be used."""
        if self.start is not None:
            from cltp.checkpoints.tac3d_llm import load_encoder
            from tacgrasp.policy_factory import named_weights

            load_encoder((named_weights(self.start) or self.start) / "encoder")
        super().train(stage, command)

    def train_in(self, run: PretrainingRun, stage: str) -> None:
        from tacgrasp.policy_factory import named_weights
        from tacgrasp.pretraining.methods import pretrain

        method = "cltp_no_image" if self.no_image else "cltp"
        start = named_weights(self.start)
        schedule = self.schedule(CLTP_SCHEDULE if start is None else CLTP_TUNING)
        if self.learning_rate is not None:
            schedule = replace(schedule, learning_rate=self.learning_rate)
        pretrain(
            method,
            run,
            schedule,
            preset=self.preset,
            recipe=self.recipe,
            also=self.also,
            also_fraction=also_fraction(self.also, self.also_fraction, start),
            start=start,
        )


@dataclass(frozen=True)
class ManifestFlags:
    """Write the manifests of a folder of weights as it is now, for folders older than manifests.

    The weights are trusted as they are: from then on any change of a file is noticed.

    Attributes:
        weights: Folder of weights, or of one method: its parts are encoder, clip, projector, lm.
    """

    weights: Path


@dataclass(frozen=True)
class LayoutFlags:
    """Write configuration, tokenizer and model card of a folder of weights in today's layout.

    The weights stay as they are, byte for byte, and the answers too.

    Attributes:
        weights: Folder of weights, or of one method: its parts are encoder, clip, projector, lm.
    """

    weights: Path


@dataclass(frozen=True)
class BaseFlags:
    """Name the folder of the language model that weights were trained behind, where it has moved.

    Attributes:
        weights: Folder of weights that tacgrasp train llm --lm wrote.
        lm: Where that language model is now.
    """

    weights: Path
    lm: Path


@dataclass(frozen=True)
class RefitFlags(RefitRequest):
    """What is fitted after the training of an encoder, fitted anew.

    Attributes:
        threads: Threads of torch; one for each core when not given.
    """

    threads: int | None = None

    def train(self, command: str) -> None:
        """Fit and write."""
        import torch

        from cltp.train.progress import Bar

        if self.threads is not None:
            torch.set_num_threads(self.threads)
        with Bar() as report:
            self._fit(command, report)

    def _fit(self, command: str, report: ProgressReport) -> None:
        raise NotImplementedError


@dataclass(frozen=True)
class TrainForceFlags(RefitFlags):
    """Fit what reads the force of a contact from the mechanics of the gel; the rest stays."""

    def _fit(self, command: str, report: ProgressReport) -> None:
        from tacgrasp.training.force import train_force

        train_force(self, command, report)


@dataclass(frozen=True)
class TrainIntervalsFlags(RefitFlags):
    """Set the intervals of weights' numbers anew, and fit the force to them; the rest stays."""

    def _fit(self, command: str, report: ProgressReport) -> None:
        from tacgrasp.training.force import train_intervals

        train_intervals(self, command, report)


@dataclass(frozen=True)
class TrainSlipFlags:
    """Train the slip models on simulated loads on held bodies; needs no data.

    Attributes:
        out: Folder of the models, which must exist.
        seeds: Number of random seeds of loads.
        units: Noisy units of each sensor that see a load.
        loads: Folder where the simulated loads are kept; those that are there are taken.
        seed: Random seed of the weights.
        sensor: Sensor of the model: taxels or gelsight_mini_markers; both when not given.
    """

    out: Path
    seeds: int = 5900
    units: int = 2
    loads: Path = Path("data/slip_loads")
    seed: int = 0
    sensor: str | None = None

    def train(self) -> None:
        """Simulate, train and write."""
        if self.seeds < 8 or self.units < 1:
            raise UsageError("--seeds must be at least 8, --units at least 1")
        if not self.out.is_dir():
            raise UsageError(f"--out {self.out} is no folder")
        from tacgrasp.console import make_console
        from tacgrasp.training.slip import SlipRequest, train
        from tacgrasp.training.slip_loads import SENSORS

        if self.sensor is not None and self.sensor not in SENSORS:
            raise UsageError(f"--sensor {self.sensor}: slip models are of {' and '.join(SENSORS)}")
        console = make_console()
        request = SlipRequest(
            seeds=self.seeds,
            units=self.units,
            out=self.out,
            loads=self.loads,
            seed=self.seed,
            sensors=SENSORS if self.sensor is None else (self.sensor,),
        )
        for name, model in train(request, console).items():
            path = self.out / f"slip_{name}.npz"
            console.print(f"written   {path}; slips from {model.threshold:.2f} on")


@dataclass(frozen=True)
class TrainReserveFlags:
    """Train what tells how much a held contact could still carry; simulates its own grips.

    Attributes:
        out: Folder of the models, which must exist.
        grips: Folder of the simulated grips; those that are there are not simulated again.
        bodies: Number of bodies, one random seed each.
        units: Noisy units of each sensor that see a grip.
        workers: Number of processes that simulate; by default one for each core.
        seed: Random seed of noise and weights.
    """

    out: Path
    grips: Path = Path("runs/grips")
    bodies: int = 600
    units: int = 4
    workers: int | None = None
    seed: int = 0

    def train(self) -> None:
        """Simulate, train and write."""
        if self.bodies < 10 or self.units < 1:
            raise UsageError("--bodies must be at least 10, --units at least 1")
        if not self.out.is_dir():
            raise UsageError(f"--out {self.out} is no folder")
        from tacgrasp.console import make_console
        from tacgrasp.training.reserve import ReserveRequest, train

        console = make_console()
        request = ReserveRequest(
            bodies=self.bodies,
            units=self.units,
            out=self.out,
            grips=self.grips,
            workers=self.workers,
            seed=self.seed,
        )
        for name, errors in train(request, console).items():
            console.print(
                f"written   {self.out / f'reserve_{name}.npz'}; of {errors.grips} grips held out "
                f"{errors.middle:.3f} off in the mean, {errors.below:.1%} below the low quantile"
            )


@dataclass(frozen=True)
class TrainQueriesFlags:
    """Train the classifier of questions on wordings of their grammar; needs no data.

    Attributes:
        out: Folder of the classifier, and of its checkpoint.
        questions: Number of wordings that are drawn.
        steps: Optimiser steps.
        seed: Random seed of wordings, weights and order.
        threads: Threads of torch; one for each core when not given.
    """

    out: Path
    questions: int = 800_000
    steps: int = 6000
    seed: int = 0
    threads: int | None = None

    def train(self) -> None:
        """Draw wordings, train and write."""
        if min(self.questions, self.steps) < 1:
            raise UsageError("--questions and --steps must be at least 1")
        import torch

        from tacgrasp.console import make_console
        from tacgrasp.training.query_classifier import HELD_OUT, QueryClassifierRequest, train

        if self.questions < 2 * HELD_OUT:
            raise UsageError(
                f"--questions must be at least {2 * HELD_OUT}: {HELD_OUT} of them are held out"
            )

        if self.threads is not None:
            torch.set_num_threads(self.threads)
        request = QueryClassifierRequest(
            out=self.out, questions=self.questions, steps=self.steps, seed=self.seed
        )
        console = make_console()
        right = train(request, console)
        console.print(f"written   {self.out}; {right:.1%} of wordings held out are read rightly")


STAGES: dict[str, tuple[type[Any], str]] = {
    "clip": (TrainClipFlags, "Align the small CLIP on images and captions."),
    "cltp": (TrainCltpFlags, "Align the tactile encoder with the frozen CLIP."),
    "llm": (TrainLlmRequest, "Train the language model, our own or (--lm) any local Qwen."),
    "all": (TrainAllRequest, "clip, cltp and llm, one after another, into one folder of weights."),
    "point-mae": (TrainMethodFlags, "Baseline: reconstruct hidden patches of clouds."),
    "point-bert": (TrainMethodFlags, "Baseline: predict hidden patches in a vocabulary of shapes."),
    "tvl": (TrainMethodFlags, "Baseline: an image encoder aligned with words for textures."),
    "unitouch": (TrainMethodFlags, "Baseline: an image encoder aligned with names of objects."),
    "queries": (TrainQueriesFlags, "What reads questions beside the language model."),
    "force": (TrainForceFlags, "What reads forces from the mechanics of the gel, for any weights."),
    "intervals": (TrainIntervalsFlags, "How far the numbers of any weights may be off."),
    "slip": (TrainSlipFlags, "The slip models of all sensors that measure shear."),
    "reserve": (TrainReserveFlags, "What tells how much a held contact could still carry."),
    "random": (TrainRandomFlags, "Floor: an encoder that has learned nothing."),
    "manifest": (ManifestFlags, "Write the checksums of older weights, trusted as they are."),
    "layout": (LayoutFlags, "Bring older weights into today's layout, without training."),
    "base": (BaseFlags, "Name the folder of a language model that was trained behind, and moved."),
}


def main(argv: Sequence[str]) -> int:
    """Train one stage; the same command continues where it was stopped, and repeats nothing."""
    summaries = {stage: summary for stage, (_, summary) in STAGES.items()}
    stage, rest = subcommand("train", argv, summaries)
    if stage is None:
        return 0
    flags = parse(STAGES[stage][0], rest, prog=f"tacgrasp train {stage}")
    check_at_least_1("--threads", getattr(flags, "threads", None))
    if hasattr(flags, "out"):
        check_folder(flags.out, "--out")
    command = shlex.join(["tacgrasp", "train", stage, *rest])
    if isinstance(flags, MethodsFlags):
        flags.train(stage, command)
        return 0
    if isinstance(flags, RefitFlags):
        flags.train(command)
        return 0
    if isinstance(flags, TrainQueriesFlags | TrainSlipFlags | TrainReserveFlags):
        flags.train()
        return 0
    from tacgrasp.training import train, upkeep

    if isinstance(flags, ManifestFlags):
        upkeep.write_manifests(flags.weights)
    elif isinstance(flags, LayoutFlags):
        upkeep.renew_weights(flags.weights)
    elif isinstance(flags, BaseFlags):
        upkeep.name_base(flags.weights, flags.lm)
    elif isinstance(flags, TrainLlmRequest):
        train.train_language_model(flags, command)
    else:
        train.train_all(flags, command)
    return 0
