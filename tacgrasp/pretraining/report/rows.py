"""The rows that the paper's tables want: name, method, encoder, recipe and share of the budget.

The one list of them. ``tacgrasp eval row NAME`` makes one, ``tacgrasp eval report`` names those
that are missing. Loads no torch.

Not here: their files (``row_file``), how they are made (``tacgrasp.pretraining.make_row``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from cltp.train.methods import ALIGNED_METHODS, IMAGE_METHODS, METHODS
from cltp.train.recipes import (
    CLIP_SCHEDULE,
    CLTP_SCHEDULE,
    ClipRecipe,
    CltpRecipe,
    OptimiserName,
    Schedule,
    by_muon,
)
from tacgrasp.pretraining.report.store import GEOMETRIC_BASELINE

BUDGET = 256_000
"""Samples that every encoder sees, of all methods alike; a row may take a part of them. Our choice:
what fits into an hour of two cores with the measuring, for the slowest encoder."""

WHOLE, QUARTER = Fraction(1), Fraction(1, 4)

PRECISION = "bf16"
"""Precision of matrix products in training, of all rows alike: two thirds of the time of "no"."""

CLIP = replace(CLIP_SCHEDULE, steps=700)
"""How long the small CLIP learns before, whose towers all rows of a seed share."""

DATA: Mapping[str, str] = {
    "paper": "set tcl3d, maker tcl3d 1, seed 0, contacts 52425",
    "full": "set full, maker full 1, seed 0, contacts 120000",
}
"""``ContactDataset.origin`` of the sets (``tacgrasp data generate --set NAME --seed 0``); rows of
other data are marked."""

SHIPPED = "shipped"
"""The weights that are shipped, in the place of a row."""

EVEN = "small"
"""Encoder of all rows of points that are compared on equal terms: the paper's 1024 even points."""

_USUAL, _USUAL_CLIP = CltpRecipe(), ClipRecipe()
_PAPERS = CltpRecipe(texts="caption", prompt_weight=0.0, head_weight=0.0)
_PAPERS_CLIP = ClipRecipe(texts="caption", prompt_weight=0.0, read_weight=0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class RowRecipe:
    """One row.

    Attributes:
        about: What it is, for the page.
        method: Name out of ``store.TITLES``.
        preset: Encoder; the method's own when not given.
        recipe: What CLTP minimises.
        clip: What the alignment of CLIP minimises.
        part: Part of ``BUDGET`` that its encoder sees.
        seeds: Random seeds of pre-training, noise and probes.
        learns_from: Name out of ``DATA``. Every row is measured on ``paper``.
        optimiser: What moves the weights of its encoder and of its CLIP.
        variant: Name in tables of what has no encoder; that of the encoder when empty.
        behind: Row behind whose encoder a language model learns to caption, or ``SHIPPED``; its
            captions are then all that is measured.
    """

    about: str
    method: str
    preset: str | None = None
    recipe: CltpRecipe = _USUAL
    clip: ClipRecipe = _USUAL_CLIP
    part: Fraction = WHOLE
    seeds: tuple[int, ...] = (0,)
    learns_from: str = "paper"
    optimiser: OptimiserName = "adamw"
    variant: str = ""
    behind: str = ""

    @property
    def samples(self) -> int:
        """Samples that its encoder sees; 0 where nothing is learned."""
        learns = self.method in METHODS and self.method != "random" and self.behind != SHIPPED
        return int(BUDGET * self.part) if learns else 0

    @property
    def has_towers(self) -> bool:
        """Whether it is aligned with the towers of a CLIP."""
        aligned = (*ALIGNED_METHODS, *IMAGE_METHODS)
        return self.method in aligned and self.behind != SHIPPED

    @property
    def towers(self) -> str:
        """Name of what its CLIP learns from; rows of one name share it."""
        name = self.learns_from if self.optimiser == "adamw" else f"{self.learns_from}-muon"
        return name if self.clip == _USUAL_CLIP else f"{name}-captions"

    @property
    def remarks(self) -> list[str]:
        """What its encoder's preset and recipe don't say, for its name in tables."""
        remarks = [] if self.learns_from == "paper" else [f"learned from {self.learns_from}"]
        if self.clip != _USUAL_CLIP:
            remarks.append("CLIP too")
        if self.optimiser == "muon":
            remarks.append("Muon")
        return remarks + ([] if self.part == WHOLE else [f"{self.part} of the budget"])

    def schedule(self, samples: int) -> Schedule:
        """The schedule of so many samples; of one step where nothing is learned."""
        usual = replace(CLTP_SCHEDULE, steps=max(1, samples // CLTP_SCHEDULE.batch_size))
        return by_muon(usual) if self.optimiser == "muon" else usual

    @property
    def clip_schedule(self) -> Schedule:
        """The schedule of its CLIP."""
        return by_muon(CLIP) if self.optimiser == "muon" else CLIP


def _quarter(
    about: str, recipe: CltpRecipe, clip: ClipRecipe = _USUAL_CLIP, method: str = "cltp"
) -> RowRecipe:
    return RowRecipe(about=about, method=method, recipe=recipe, clip=clip, part=QUARTER)


ROWS: Mapping[str, RowRecipe] = {
    "cltp": RowRecipe(about="CLTP, all points", method="cltp", seeds=(0, 1, 2)),
    "cltp_even": RowRecipe(
        about="CLTP, the paper's 1024 even points", method="cltp", preset=EVEN, seeds=(0, 1, 2)
    ),
    "no_image": RowRecipe(about="CLTP without image", method="cltp_no_image", preset=EVEN),
    "point_bert": RowRecipe(about="Point-BERT", method="point_bert", preset=EVEN),
    "point_mae": RowRecipe(about="Point-MAE", method="point_mae", preset=EVEN),
    "random": RowRecipe(about="an encoder that learned nothing", method="random", preset=EVEN),
    "unitouch": RowRecipe(about="UniTouch-like, images", method="unitouch"),
    "tvl": RowRecipe(about="TVL-like, images", method="tvl"),
    "cltp_full": RowRecipe(
        about="CLTP, all points, learned from the set full without the unseen objects",
        method="cltp",
        learns_from="full",
    ),
    "cltp_muon": RowRecipe(
        about="CLTP, all points, by Muon instead of AdamW", method="cltp", optimiser="muon"
    ),
    "cltp_muon_full": RowRecipe(
        about="CLTP, all points, by Muon, learned from the set full without the unseen objects",
        method="cltp",
        learns_from="full",
        optimiser="muon",
    ),
    "cltp_muon_curves": RowRecipe(
        about="CLTP, all points, their heights and pressures in falling order beside, by Muon",
        method="cltp",
        preset="grid_curves",
        optimiser="muon",
    ),
    "cltp_muon_curves_clean": RowRecipe(
        about="cltp-muon-curves, half of whose contacts are felt without noise",
        method="cltp",
        preset="grid_curves",
        recipe=CltpRecipe(clean=0.5),
        optimiser="muon",
        seeds=(0, 1, 2),
    ),
    "cltp_muon_curves_full": RowRecipe(
        about="cltp-muon-curves, learned from the set full without the unseen objects",
        method="cltp",
        preset="grid_curves",
        learns_from="full",
        optimiser="muon",
    ),
    "cltp_quarter": _quarter("CLTP, all points, a quarter of the budget", _USUAL),
    "cltp_muon_quarter": replace(
        _quarter("CLTP, all points, by Muon, a quarter of the budget", _USUAL), optimiser="muon"
    ),
    "cltp_pressure": replace(
        _quarter(
            "CLTP, all points and the pressure under their heights, a quarter of the budget", _USUAL
        ),
        preset="grid_pressure",
    ),
    "papers_losses": _quarter(
        "CLTP by the paper's captions and losses alone, for CLIP too", _PAPERS, _PAPERS_CLIP
    ),
    "papers_losses_no_image": _quarter(
        "CLTP without image, by the paper's captions and losses alone, for CLIP too",
        _PAPERS,
        _PAPERS_CLIP,
        "cltp_no_image",
    ),
    "heads_off": _quarter("CLTP without the state heads' losses", CltpRecipe(head_weight=0.0)),
    "heads_alone": _quarter(
        "CLTP by the state heads' losses alone", CltpRecipe(contrast_weight=0.0, prompt_weight=0.0)
    ),
    "shipped_llm": RowRecipe(
        about="Tac3D-LLM as shipped, learned from the set full",
        method="cltp",
        variant=f"{SHIPPED}, of the set full",
        behind=SHIPPED,
    ),
    "cltp_even_llm": RowRecipe(
        about="Tac3D-LLM: a language model behind CLTP, the paper's 1024 even points",
        method="cltp",
        preset=EVEN,
        behind="cltp_even",
    ),
    "point_bert_llm": RowRecipe(
        about="PointBERT-LLM", method="point_bert", preset=EVEN, behind="point_bert"
    ),
    "point_mae_llm": RowRecipe(
        about="PointMAE-LLM", method="point_mae", preset=EVEN, behind="point_mae"
    ),
    "geometric_baseline": RowRecipe(
        about="direct computation from the 1024 points",
        method=GEOMETRIC_BASELINE,
        variant="measured",
    ),
    "heights_alone": RowRecipe(
        about="probes on the heights of the 1024 points, without their positions",
        method=GEOMETRIC_BASELINE,
        variant="heights alone",
    ),
}
"""All rows, in the order of the page."""


def wanted() -> Iterator[tuple[str, int]]:
    """Name and seed of every file that the page wants."""
    return ((name, seed) for name, row in ROWS.items() for seed in row.seeds)


def row_command(name: str, seed: int) -> str:
    """The command that makes a row."""
    return f"tacgrasp eval row {name.replace('_', '-')}" + (f" --seed {seed}" if seed else "")
