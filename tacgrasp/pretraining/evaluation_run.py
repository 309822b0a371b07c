"""Where encoders are tried, and how what was found becomes a stored result."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from cltp.checkpoints.frozen import FrozenEncoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation
from cltp.evaluation.features import Observed, observe
from cltp.evaluation.probes import Judged
from cltp.evaluation.splits import EvaluationSplit, evaluation_splits
from cltp.tactile.states import CLASSES
from cltp.train.stage import ProgressReport, silent
from tacgrasp.pretraining.checkpoints import TrainedMethod
from tacgrasp.pretraining.report.store import Result, percent, read, save


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluationRun:
    """Where things lie, and what is tried.

    Attributes:
        weights: Folder of all methods.
        data: A data set of contacts.
        results: Folder of results.
        trials: Names of trials; all of the data's when empty.
        limit: Contacts of each trial; None for all.
        checkpoint: An image encoder in transformers' format, tried as the one method named.
        seed: Of noise and probes.
        command: For the results.
        report: Told about progress.
    """

    weights: Path
    data: Path
    results: Path
    trials: tuple[str, ...] = ()
    limit: int | None = None
    checkpoint: Path | None = None
    seed: int = 0
    command: str = ""
    report: ProgressReport = silent

    @property
    def checksum(self) -> str:
        """Of the data."""
        return ContactDataset(self.data).checksum()

    def trying(self) -> list[EvaluationSplit]:
        """The trials."""
        return evaluation_splits(self.data, self.trials)

    def seen(
        self,
        encoder: FrozenEncoder,
        split: Split,
        noise: Augmentation,
        *,
        views: int = 1,
        whole: bool = False,
    ) -> Observed:
        """Features of a split, from the cache where they are there already."""
        return observe(
            encoder,
            ContactDataset(self.data, split=split),
            noise,
            views=views,
            limit=None if whole else self.limit,
            seed=self.seed,
            cache=self.results / ".features",
            report=self.report,
        )


def kept(
    place: EvaluationRun, table: str, method: str, how: TrainedMethod, trial: EvaluationSplit
) -> Result | None:
    """The same measurement where it was stored before: of what never learns and never changes.

    Raises:
        TouchError: What is stored is damaged.
    """
    data = ContactDataset(place.data, split=trial.split)
    count = len(data) if place.limit is None else min(place.limit, len(data))
    judged = Judged({}, {}, count)
    wanted = as_result(place, table, method, how, trial.name, judged, data.checksum())
    path = place.results / wanted.file
    found = read(path) if path.exists() else None
    same = found is not None and (found.data, found.contacts) == (wanted.data, wanted.contacts)
    return found if same else None


def keep(
    place: EvaluationRun,
    table: str,
    method: str,
    how: TrainedMethod,
    trial: EvaluationSplit,
    judged: Judged,
) -> Result:
    """A result, written at once: what is interrupted loses nothing that was measured."""
    result = as_result(place, table, method, how, trial.name, judged, place.checksum)
    if table not in ("numbers", "retrieval"):
        save(place.results, result)
    return result


def as_result(
    place: EvaluationRun,
    table: str,
    method: str,
    how: TrainedMethod,
    trial: str,
    judged: Judged,
    data: str,
) -> Result:
    """What was judged, as a row of a table, with all that it depends on; not yet written."""
    return Result(
        table=table,
        method=method,
        variant=how.variant,
        trial=trial,
        seed=place.seed,
        data=data,
        budget=how.budget,
        command=place.command,
        contacts=judged.count,
        values=percent({slot: judged.right.get(slot, math.nan) for slot in CLASSES}),
        confusion={slot: counts.tolist() for slot, counts in judged.confusion.items()},
        device=how.device,
        learned_seed=how.seed,
    )
