"""What the alignments minimise, and how long and how fast a stage of training learns.

Loads no torch, so that a command line can show these values and pass them on whole.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from typing import Literal

from cltp.errors import TouchError


@dataclass(frozen=True, slots=True, kw_only=True)
class AlignmentRecipe:
    """What the alignments of CLIP and of CLTP both minimise.

    Measured with a prompt weight of 0.2 on 1,417 unseen noisy contacts, shape / texture / depth /
    position / area, % right by the paper's prompts, with a linear feature on a frozen encoder and a
    text tower trained in 400 steps of 128: captions alone 27 / 51 / 59 / 82 / 58; mixed, each text
    to its own contact alone 73 / 82 / 81 / 94 / 82; mixed, each to all that it fits 78 / 86 / 83 /
    96 / 86, and 75 / 85 / 84 / 95 / 78 where the very prompts of the test were held back; captions
    and the prompt contrast 78 / 85 / 84 / 96 / 88; both 79 / 87 / 84 / 96 / 86. Duplicate captions
    alone make no difference: equal texts share their probability in any case.

    Attributes:
        texts: Texts of the contacts: the paper's captions, or (mixed) for half of the contacts a
            prompt that names one dimension and belongs to every contact that it is true of.
        prompt_weight: Weight of the contrast with one prompt for each class of each dimension; 0 in
            the paper.

    Raises:
        TouchError: A weight is negative.
    """

    texts: Literal["caption", "mixed"] = "mixed"
    prompt_weight: float = 1.0

    def __post_init__(self) -> None:
        for part in fields(self):
            value = getattr(self, part.name)
            if part.name.endswith("_weight") and value < 0:
                raise TouchError(f"{part.name} must be at least 0, got {value}")


@dataclass(frozen=True, slots=True, kw_only=True)
class ClipRecipe(AlignmentRecipe):
    """What the alignment of the small CLIP minimises.

    Attributes:
        read_weight: Weight of the cross-entropy of the classes that each text names, read from its
            feature; 0 trains by contrast alone.

    Raises:
        TouchError: A weight is negative.
    """

    read_weight: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CltpRecipe(AlignmentRecipe):
    """What the alignment of the tactile encoder minimises.

    Attributes:
        head_weight: Weight of the state heads' losses; 0 in the paper.
        moved: Fraction of the contacts, 0 to 1, that are shifted and turned on the pad.
        coarse: Fraction of the contacts, 0 to 1, that a few taxels feel instead of pixels.
        clean: Fraction of the contacts, 0 to 1, that a sensor without noise feels; that of all
            methods when not given.
        contrast_weight: Weight of L_T2L and L_T2I; 0 leaves the heads, and the prompts, alone.

    Raises:
        TouchError: A weight is negative, all are 0, or ``moved``, ``coarse`` or ``clean`` is no
            fraction.
    """

    head_weight: float = 1.0
    moved: float = 0.0
    coarse: float = field(default=0.0, repr=False)  # see ``identity``
    clean: float | None = field(default=None, repr=False)
    contrast_weight: float = field(default=1.0, repr=False)

    @property
    def identity(self) -> str:
        """All values in one line; unchanged for trainings that are older than the last one.

        ``coarse`` and ``clean`` are told by the augmentation.
        """
        weight = self.contrast_weight
        return str(self) if weight == 1 else f"{self} contrast_weight {weight}"

    def __post_init__(self) -> None:
        AlignmentRecipe.__post_init__(self)
        if not any((self.contrast_weight, self.prompt_weight, self.head_weight)):
            raise TouchError("contrast_weight, prompt_weight and head_weight can't all be 0")
        for name in ("moved", "coarse", "clean"):
            value = getattr(self, name)
            if value is not None and not 0 <= value <= 1:
                raise TouchError(f"{name} must be a fraction from 0 to 1, got {value}")


OptimiserName = Literal["adamw", "muon"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Schedule:
    """How long and how fast a stage learns: warm-up, cosine to a hundredth.

    Attributes:
        steps: Optimiser steps.
        batch_size: Contacts in a step, of all processes together.
        learning_rate: Learning rate at its peak.
        weight_decay: Weight decay of matrices; vectors (biases, norms) have none.
        warm_up: Fraction of the steps during which the learning rate rises.
        largest_gradient: Norm that gradients are scaled down to.
        optimiser: What moves the weights (``cltp.train.optimiser``).

    Raises:
        TouchError: A value is not positive.
    """

    steps: int
    batch_size: int
    learning_rate: float
    weight_decay: float = 0.05
    warm_up: float = 0.05
    largest_gradient: float = 1.0
    optimiser: OptimiserName = "adamw"

    def __post_init__(self) -> None:
        for name in ("steps", "batch_size"):
            if getattr(self, name) < 1:
                raise TouchError(f"{name} must be at least 1, got {getattr(self, name)}")
        if not self.learning_rate > 0:
            raise TouchError(f"learning_rate must be above 0, got {self.learning_rate}")

    def rate(self, step: int) -> float:
        """Learning rate in step ``step``, counted from 0."""
        progress = (step + 1) / self.steps
        if progress < self.warm_up:
            return self.learning_rate * progress / self.warm_up
        decayed = (progress - self.warm_up) / (1 - self.warm_up)
        return self.learning_rate * (0.01 + 0.99 * 0.5 * (1 + math.cos(math.pi * decayed)))


MUON_RATE = 5e-3
"""Learning rate of Muon at its peak. Our choice: after 1000 steps of 64 all losses but those of
numbers are lower at 6e-3 than at 2e-3; on the way those of numbers and places are higher."""


def by_muon(schedule: Schedule) -> Schedule:
    """The schedule with Muon in the place of its optimiser, at Muon's own rate."""
    return replace(schedule, optimiser="muon", learning_rate=MUON_RATE)


@dataclass(frozen=True, slots=True, kw_only=True)
class StockRecipe:
    """How a projector and a language model that others made are trained (--lm).

    First the projector alone, by captions, which is all that the paper trains. Then the projector
    and what ``tune`` names, by captions, advice and questions.

    Attributes:
        tune: What of the language model is trained after the projector: low-rank adapters, all of
            it, or nothing.
        lora_rank: Rank of the adapters.
        lora_alpha: Their scale times the rank.
        projector_steps: Optimiser steps of the projector alone.
        tune_steps: Optimiser steps after that.
        batch_size: Contacts in a step, of all processes together.
        projector_rate: Learning rate of the projector alone, at its peak.
        tune_rate: Learning rate after that, at its peak; a tenth of it does for --tune all.
        recompute_activations: Compute the activations of a layer once more in the backward pass,
            instead of keeping them: a third more time, a tenth of their memory.

    Raises:
        TouchError: A number is not positive.
    """

    tune: Literal["lora", "all", "projector"] = "lora"
    lora_rank: int = 16
    lora_alpha: float = 32.0
    projector_steps: int = 500
    tune_steps: int = 2000
    batch_size: int = 16
    projector_rate: float = 1e-3
    tune_rate: float = 2e-4
    recompute_activations: bool = False

    def __post_init__(self) -> None:
        for part in fields(self):
            value = getattr(self, part.name)
            if part.name not in ("tune", "recompute_activations") and not value > 0:
                raise TouchError(f"{part.name} must be above 0, got {value}")

    @property
    def stages(self) -> dict[str, Schedule]:
        """The schedules of its stages, in their order."""
        first = Schedule(
            steps=self.projector_steps,
            batch_size=self.batch_size,
            learning_rate=self.projector_rate,
        )
        second = Schedule(
            steps=self.tune_steps, batch_size=self.batch_size, learning_rate=self.tune_rate
        )
        return {"projector": first} | ({} if self.tune == "projector" else {"joint": second})


CLIP_SCHEDULE = Schedule(steps=400, batch_size=128, learning_rate=1e-3)
CLTP_SCHEDULE = Schedule(steps=5000, batch_size=64, learning_rate=2e-3)
"""Of CLTP, and of every method that it is compared with."""
CLTP_TUNING = Schedule(steps=400, batch_size=64, learning_rate=5e-4)
"""Of a CLTP that is trained on from other weights."""
ALSO_FRACTION = 0.5
"""Fraction of a further data set in each batch where weights are trained on: so that little of
one's own is learned, and what was learned before is not forgotten."""
HEADS_SCHEDULE = Schedule(steps=1000, batch_size=64, learning_rate=1e-3)
"""Of state heads on a frozen encoder that has none."""
