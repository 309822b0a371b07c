"""What one evaluation of encoders reads and writes, and how its scores become stored results."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from torch import Tensor

from cltp.checkpoints.frozen import FrozenEncoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation
from cltp.evaluation.features import EncodedContacts, encode_contacts
from cltp.evaluation.probes import ClassProbes, ProbeTraining
from cltp.evaluation.scores import ClassScores
from cltp.evaluation.splits import PROBE_NOISE, EvaluationSplit, evaluation_splits
from cltp.train.stage import ProgressReport, silent
from tacgrasp.pretraining.checkpoints import TrainedMethod
from tacgrasp.pretraining.real_touches import RealTouches
from tacgrasp.pretraining.report.store import Result, load, save

EvaluatedContacts = EvaluationSplit | RealTouches


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluationRun:
    """Folders and settings of one evaluation.

    Attributes:
        weights: Folder of all methods.
        data: A data set of contacts.
        results: Folder of results.
        splits: Names of evaluation splits; all of the data's when empty.
        limit: Number of contacts of each split; None for all.
        encoders: The encoders to evaluate by method; found in ``weights`` when not given.
        seed: Random seed of the noise and of the probes.
        command: Command line, stored with the results.
        report: Receives the progress.
    """

    weights: Path
    data: Path
    results: Path
    splits: tuple[str, ...] = ()
    limit: int | None = None
    encoders: Mapping[str, TrainedMethod] | None = None
    seed: int = 0
    command: str = ""
    report: ProgressReport = silent

    @property
    def probe_training(self) -> ProbeTraining:
        return ProbeTraining(self.seed, self.report)

    @property
    def checksum(self) -> str:
        return ContactDataset(self.data).checksum()

    def evaluation_splits(self) -> list[EvaluationSplit]:
        return evaluation_splits(self.data, self.splits)

    def encode(self, encoder: FrozenEncoder, split: EvaluatedContacts) -> EncodedContacts:
        """Features of real touches, or of an evaluation split, at most ``limit`` contacts."""
        if isinstance(split, RealTouches):
            return split.encode(encoder)
        return self.encode_split(encoder, split.split, split.noise, limit=self.limit)

    def encode_split(
        self,
        encoder: FrozenEncoder,
        split: Split,
        noise: Augmentation,
        *,
        views: int = 1,
        limit: int | None = None,
    ) -> EncodedContacts:
        """Features of contacts of a split of the data, each encoded ``views`` times."""
        return encode_contacts(
            encoder,
            ContactDataset(self.data, split=split),
            noise,
            views=views,
            limit=limit,
            seed=self.seed,
            cache=self.results / ".features",
            report=self.report,
        )

    def store_scores(
        self,
        table: str,
        name: str,
        method: TrainedMethod,
        split: EvaluatedContacts,
        scores: ClassScores,
    ) -> Result:
        """Store accuracies in % and confusion matrices as a row of a table."""
        accuracy = scores.accuracy.items()
        values = {slot: None if math.isnan(v) else 100 * v for slot, v in accuracy}
        result = self.result(table, name, method, split.name, scores.count, values)
        confusion = {slot: counts.tolist() for slot, counts in scores.confusion.items()}
        return self.store(replace(result, confusion=confusion))

    def result(
        self,
        table: str,
        name: str,
        method: TrainedMethod,
        split: str,
        contacts: int,
        values: Mapping[str, float | None],
    ) -> Result:
        """A row of a table, not yet stored; of this run's data where the method names none."""
        return Result(
            table=table,
            method=name,
            variant=method.variant,
            split=split,
            seed=self.seed,
            data=self.checksum if method.data is None else method.data,
            budget=method.budget,
            command=self.command,
            contacts=contacts,
            values=values,
            device=method.device,
            learned_seed=method.seed,
            points=method.points,
        )

    def store(self, result: Result) -> Result:
        """Write a result at once, so that an interruption loses nothing that was measured.

        Results of unknown data are not written: a report is of one data set.
        """
        if result.data:
            save(self.results, result)
        return result

    def stored(
        self, table: str, name: str, method: TrainedMethod, split: EvaluatedContacts
    ) -> Result | None:
        """The same measurement where it is stored already, of what does not depend on training.

        Raises:
            TouchError: The stored result is damaged.
        """
        if isinstance(split, RealTouches):
            return None  # other touches may have been measured
        data = ContactDataset(self.data, split=split.split)
        contacts = len(data) if self.limit is None else min(self.limit, len(data))
        expected = self.result(table, name, method, split.name, contacts, {})
        path = self.results / expected.file
        result = load(Result, path) if path.exists() else None
        if result is None or (result.data, result.contacts) != (expected.data, contacts):
            return None
        return result


def probe_noise(split: EvaluatedContacts) -> Augmentation:
    """Noise of the contacts that probes of a split learn from."""
    return PROBE_NOISE if isinstance(split, RealTouches) else split.probe_noise


def probe_scorer(
    run: EvaluationRun, encoder: FrozenEncoder, views: int, training: ProbeTraining
) -> Callable[[EncodedContacts, EvaluatedContacts], list[Tensor]]:
    """Probabilities of the classes of a split's contacts by probes on frozen features.

    Probes of splits with noise learn with noise, those of splits without learn without; each kind
    is trained when it is first asked for.
    """

    @lru_cache
    def learned(noise: Augmentation) -> ClassProbes:
        return ClassProbes(run.encode_split(encoder, Split.TRAIN, noise, views=views), training)

    return lambda encoded, split: learned(probe_noise(split)).probabilities(encoded)
