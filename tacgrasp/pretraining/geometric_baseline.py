"""Rows of tables without an encoder, from the same 1024 points: the geometric baseline.

``measured``: direct computation (``cltp.evaluation.geometric_baseline``); depth, position and area.
``heights alone``: probes on the points' heights in falling order, without their positions
    (``cltp.evaluation.heights_alone``); depth and area. They learn from the same contacts as other
    probes.
"""

from __future__ import annotations

from collections.abc import Sequence

import torch

from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Sampler
from cltp.evaluation.features import numbered_batches, selected_rows
from cltp.evaluation.geometric_baseline import predict_geometrically
from cltp.evaluation.heights_alone import HeightsAlone
from cltp.evaluation.scores import ClassScores, best_classes, score_classes
from cltp.tactile.measure import contact_state
from cltp.tactile.states import MEASURABLE
from cltp.train.text_targets import class_numbers
from tacgrasp.pretraining.checkpoints import TrainedMethod
from tacgrasp.pretraining.evaluation_run import EvaluatedContacts, EvaluationRun, probe_scorer
from tacgrasp.pretraining.real_touches import RealTouches
from tacgrasp.pretraining.report.store import GEOMETRIC_BASELINE, USUAL_VARIANTS, Result

READ_FROM_HEIGHTS = ("depth", "area")


def geometric_baseline(
    run: EvaluationRun, table: str, splits: Sequence[EvaluatedContacts], data: str | None = None
) -> list[Result]:
    """Direct computation as a row of a table; not repeated where it is stored already.

    Args:
        run: Folders and settings.
        table: Name of the table.
        splits: What methods are measured on.
        data: Checksum of the data that the result belongs to; the run's when not given.

    Raises:
        TouchError: The data or a stored result can't be used.
    """
    variant = USUAL_VARIANTS[GEOMETRIC_BASELINE]
    method = TrainedMethod(folder=run.weights, variant=variant, budget=None, data=data)
    row = (table, GEOMETRIC_BASELINE, method)
    return [
        run.stored(*row, split) or run.store_scores(*row, split, score_geometry(run, split))
        for split in splits
    ]


def score_geometry(run: EvaluationRun, split: EvaluatedContacts) -> ClassScores:
    """Scores of direct computation on the contacts, and with the noise, that encoders are given."""
    if isinstance(split, RealTouches):
        classes, labels = class_numbers(list(map(contact_state, split.clouds))), split.labels
    else:
        data = ContactDataset(run.data, split=split.split)
        rows = selected_rows(len(data), limit=run.limit, seed=run.seed)
        sampler = Sampler(data, split.noise, seed=run.seed)
        batches = [batch for batch, _ in numbered_batches(sampler, rows)]
        labels = torch.cat([class_numbers(batch.states) for batch in batches])
        classes = predict_geometrically(batches).classes
    return score_classes(classes, labels).restricted(MEASURABLE)


def heights_alone(run: EvaluationRun, views: int) -> list[Result]:
    """Probes on sorted heights as a row of table 2; not repeated where they are stored already.

    Args:
        run: Folders and settings.
        views: How often each training contact is encoded.

    Raises:
        TouchError: The data or a stored result can't be used.
    """
    encoder = HeightsAlone()
    method = TrainedMethod(folder=run.weights, variant="heights alone", budget=None)
    row = ("probe", GEOMETRIC_BASELINE, method)
    splits = run.evaluation_splits()
    stored = [result for split in splits if (result := run.stored(*row, split)) is not None]
    if len(stored) == len(splits):
        return stored
    scorer = probe_scorer(run, encoder, views, run.probe_training)
    results = []
    for split in splits:
        encoded = run.encode(encoder, split)
        scores = score_classes(best_classes(scorer(encoded, split)), encoded.classes)
        results.append(run.store_scores(*row, split, scores.restricted(READ_FROM_HEIGHTS)))
    return results
