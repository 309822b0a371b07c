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
from cltp.evaluation.probes import ClassProbes
from cltp.evaluation.scores import ClassScores, score_classes
from cltp.evaluation.splits import EvaluationSplit
from cltp.tactile.states import MEASURABLE
from cltp.train.text_targets import class_numbers
from tacgrasp.pretraining.checkpoints import TrainedMethod
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.report.store import GEOMETRIC_BASELINE, USUAL_VARIANTS, Result

READ_FROM_HEIGHTS = ("depth", "area")


def baseline_method(run: EvaluationRun, variant: str | None = None) -> TrainedMethod:
    """The baseline in place of a trained method; computed directly unless a variant is named."""
    variant = variant or USUAL_VARIANTS[GEOMETRIC_BASELINE]
    return TrainedMethod(folder=run.weights, variant=variant, budget=None)


def geometric_baseline(run: EvaluationRun, tables: Sequence[str]) -> list[Result]:
    """Direct computation as a row of tables; not repeated where it is stored already.

    Raises:
        TouchError: The data or a stored result can't be used.
    """
    results = []
    method = baseline_method(run)
    for split in run.evaluation_splits():
        stored = [run.stored(table, GEOMETRIC_BASELINE, method, split) for table in tables]
        complete = [result for result in stored if result is not None]
        if len(complete) < len(tables):
            scores = score_geometry(run, split)
            complete = [
                run.store(run.class_result(table, GEOMETRIC_BASELINE, method, split.name, scores))
                for table in tables
            ]
        results += complete
    return results


def score_geometry(run: EvaluationRun, split: EvaluationSplit) -> ClassScores:
    """Scores of direct computation on the contacts, and with the noise, that encoders are given."""
    data = ContactDataset(run.data, split=split.split)
    rows = selected_rows(len(data), limit=run.limit, seed=run.seed)
    sampler = Sampler(data, split.noise, seed=run.seed)
    batches = [batch for batch, _ in numbered_batches(sampler, rows)]
    labels = torch.cat([class_numbers(batch.states) for batch in batches])
    classes = predict_geometrically(data, batches).classes
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
    method = baseline_method(run, "heights alone")
    splits = run.evaluation_splits()
    stored = [run.stored("probe", GEOMETRIC_BASELINE, method, split) for split in splits]
    complete = [result for result in stored if result is not None]
    if len(complete) == len(splits):
        return complete
    probes = ClassProbes(run.encode_training(encoder, views), seed=run.seed, report=run.report)
    results = []
    for split in splits:
        encoded = run.encode(encoder, split)
        scores = score_classes(probes.classes(encoded), encoded.classes)
        scores = scores.restricted(READ_FROM_HEIGHTS)
        result = run.class_result("probe", GEOMETRIC_BASELINE, method, split.name, scores)
        results.append(run.store(result))
    return results
