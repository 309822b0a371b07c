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
from cltp.errors import TouchError
from cltp.evaluation.features import encode_batches, random_batches
from cltp.evaluation.llm_scores import predict_by_captions
from cltp.evaluation.probes import predict_with_heads
from cltp.evaluation.scores import best_classes, score_classes
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.tactile.point_layout import PointLayout
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
    for title, weights in (("before", run.before), ("after", run.after)):
        encoder, _ = load_encoder(_encoder_folder(weights))
        layout = encoder.config.variant.layout
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
            for reader, classes in read_classes(weights, batches, layout):
                rows.append(_row(name, title, reader, classes, labels))
            report(f"{name}, {title}", len(labels), len(labels), {})
    return rows


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


def read_classes(
    weights: Path, batches: Sequence[Batch], layout: PointLayout
) -> Iterator[tuple[str, Tensor]]:
    """Each reader of some weights, and the classes (N, 5) that it reads in some contacts.

    Raises:
        TouchError: Weights can't be used, or their towers are missing.
    """
    folder = _encoder_folder(weights)
    encoder, heads = load_encoder(folder)
    encoder.eval(), heads.eval()
    encoded = encode_batches(frozen(encoder), batches)
    yield "heads", predict_with_heads(heads, encoded, batches).classes
    if not (weights / "clip").is_dir():
        raise TouchError(f"{weights} has no clip; name a folder of weights or of tacgrasp train")
    prompts = ClassPrompts(load_clip(weights / "clip"))
    yield "zero_shot", best_classes(prompts.cosines(encoded.feature))
    if (weights / "lm").is_dir():
        speaker = CaptionSpeaker(load_llm(weights).talker)
        yield "captions", predict_by_captions(speaker, batches, read_numbers).classes


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
