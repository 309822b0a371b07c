"""``tacgrasp eval own``: what weights read in one's own contacts and in ours, before and after.

One's own are the test split of a data set that ``tacgrasp data import`` wrote. Their heights carry
the noise of their sensor, so that none is added. Ours are the test split of a generated data set,
with the noise of a calibrated unit. Only given labels are scored, never measured ones.

Not here: contacts of another simulator (``tacgrasp.benchmarks.transfer.other_sim``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import torch
from torch import Tensor
from transformers.utils.logging import disable_progress_bar

from cltp.checkpoints.frozen import frozen
from cltp.checkpoints.tac3d_llm import load_clip, load_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY, Batch
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.evaluation.features import encode_batches, random_batches
from cltp.evaluation.llm_scores import predict_by_captions
from cltp.evaluation.probes import predict_with_heads
from cltp.evaluation.scores import best_classes, score_classes
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.tactile.states import CLASSES
from cltp.train.stage import ProgressReport, silent
from cltp.train.text_targets import class_numbers
from policies.llm.spoken import CaptionSpeaker
from tacgrasp.base.errors import UsageError
from tacgrasp.lessons.captions import read_numbers
from tacgrasp.policy_factory import load_llm

IMPORTED = "tacgrasp data import"
"""``made_by`` of a data set whose heights a sensor has measured."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OwnScores:
    """One row of the table.

    Attributes:
        contacts: ``own`` or ``ours``.
        weights: ``before`` or ``after``.
        reader: ``heads``, ``zero_shot`` or ``captions``.
        right: Percent right, in the order of ``CLASSES``; None where no contact has the label.
        count: Number of contacts that have it, in the same order.
    """

    contacts: str
    weights: str
    reader: str
    right: tuple[float | None, ...]
    count: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class OwnEvaluation:
    """What is measured on what.

    Attributes:
        data: Our data set.
        also: One's own.
        before: Folder of the weights that were trained on.
        after: Folder of the weights after that; it may lack the language model.
        contacts: Largest number of contacts of each data set.
        seed: Random seed of the choice of contacts and of the noise.
    """

    data: Path
    also: Path
    before: Path
    after: Path
    contacts: int
    seed: int


def evaluate_own(run: OwnEvaluation, report: ProgressReport = silent) -> list[OwnScores]:
    """Measure both weights on both data sets.

    Captions are scored where the folder of weights has a language model.

    Raises:
        UsageError: A data set has no test split, or one's own has no given label in it.
        TouchError: Weights or data can't be used.
    """
    disable_progress_bar()  # of reading weights, over in milliseconds
    sets = {"own": _test_split(run.also), "ours": _test_split(run.data)}
    rows: list[OwnScores] = []
    # Both are read before anything is measured.
    readers = {"before": _load(run.before), "after": _load(run.after)}
    for title, weights in readers.items():
        layout = weights.encoder.config.variant.layout
        for name, data in sets.items():
            batches = random_batches(
                data,
                run.contacts,
                CLEAN if data.about.get("made_by") == IMPORTED else NOISY,
                seed=run.seed,
                layout=layout,
            )
            labels = torch.cat([given_classes(data, batch) for batch in batches])
            if not (labels >= 0).any():
                raise UsageError(f"no contact of the test split of {data.folder} has a given label")
            report(f"{name}, {title}", 0, len(labels), {})
            for reader, classes in read_classes(weights, batches):
                rows.append(_row(name, title, reader, classes, labels))
            report(f"{name}, {title}", len(labels), len(labels), {})
    return rows


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedWeights:
    """What reads contacts by some weights.

    Attributes:
        encoder: The encoder.
        heads: Its heads.
        prompts: Prompts of the classes by the towers, for zero-shot.
        speaker: The language model's captions; None without one.
    """

    encoder: TactileEncoder
    heads: StateHeads
    prompts: ClassPrompts
    speaker: CaptionSpeaker | None


def _load(weights: Path) -> LoadedWeights:
    encoder, heads = load_encoder(_encoder_folder(weights))
    encoder.eval(), heads.eval()
    if not (weights / "clip").is_dir():
        raise TouchError(f"{weights} has no clip; name a folder of weights or of tacgrasp train")
    prompts = ClassPrompts(load_clip(weights / "clip"))
    has_speaker = (weights / "lm").is_dir()
    speaker = CaptionSpeaker(load_llm(weights).talker) if has_speaker else None
    return LoadedWeights(encoder=encoder, heads=heads, prompts=prompts, speaker=speaker)


def _encoder_folder(weights: Path) -> Path:
    """The encoder of weights, or of a folder of pre-training."""
    own = weights / "cltp" / "encoder"
    return own if own.is_dir() else weights / "encoder"


def _test_split(folder: Path) -> ContactDataset:
    if Split.TEST.value not in ContactDataset(folder).column("split"):
        raise UsageError(
            f"{folder} has no contacts of the split test to measure on; import again with "
            "--held-out 0.2, or with a column split"
        )
    return ContactDataset(folder, split=Split.TEST)


def given_classes(data: ContactDataset, batch: Batch) -> Tensor:
    """Class numbers (N, 5) of a batch; -1 where the label is unknown or was measured."""
    classes = class_numbers(batch.states)
    measured = data.column("measured")[batch.index]
    for number, name in enumerate(CLASSES):
        not_given = [name in (fields or "").split() for fields in measured]
        classes[torch.tensor(not_given), number] = -1
    return classes


def read_classes(weights: LoadedWeights, batches: Sequence[Batch]) -> Iterator[tuple[str, Tensor]]:
    """Each reader of some weights, and the classes (N, 5) that it reads in some contacts."""
    encoded = encode_batches(frozen(weights.encoder), batches)
    yield "heads", predict_with_heads(weights.heads, encoded, batches).classes
    yield "zero_shot", best_classes(weights.prompts.cosines(encoded.feature))
    if weights.speaker is not None:
        yield "captions", predict_by_captions(weights.speaker, batches, read_numbers).classes


def _row(contacts: str, weights: str, reader: str, classes: Tensor, labels: Tensor) -> OwnScores:
    accuracy = score_classes(classes, labels).accuracy
    count = tuple(int(n) for n in (labels >= 0).sum(0))
    right = (100 * accuracy[name] if n else None for name, n in zip(CLASSES, count, strict=True))
    return OwnScores(
        contacts=contacts, weights=weights, reader=reader, right=tuple(right), count=count
    )


def figures(rows: Sequence[OwnScores]) -> list[dict[str, object]]:
    """The rows as JSON takes them, % right and counts by dimension."""
    return [
        {
            **asdict(row),
            "right": dict(zip(CLASSES, row.right, strict=True)),
            "count": dict(zip(CLASSES, row.count, strict=True)),
        }
        for row in rows
    ]
