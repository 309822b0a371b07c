"""What an evaluation of trained weights measures; ``tacgrasp eval`` reads its flags into it.

Imports nothing heavy, so that ``--help`` answers at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError


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
        pairs: Number of instruction pairs.
        per_wording: Number of contacts for each paraphrase.
        seed: Random seed of the choice of contacts, of the sensor noise and of the wordings.
        card: Write the scores into the model card too.
    """

    weights: Path | None = None
    data: Path = Path("runs/data")
    json: Path | None = None
    blind: Path | None = None
    captions: int = 500
    answers: int = 150
    pairs: int = 200
    per_wording: int = 8
    seed: int = 0
    card: bool = False

    def __post_init__(self) -> None:
        if min(self.captions, self.answers, self.pairs, self.per_wording) < 1 or self.seed < 0:
            raise UsageError("every number of eval must be at least 1, --seed at least 0")
