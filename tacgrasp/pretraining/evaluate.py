"""Evaluate pre-trained encoders: zero-shot, probes, numbers, retrieval; each into a stored result.

Every method is evaluated on the same contacts, with the same noise and the same probes.

Not here: rows that need no encoder (``tacgrasp.pretraining.geometric_baseline``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from cltp.checkpoints.frozen import FrozenEncoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation
from cltp.evaluation.features import EncodedContacts
from cltp.evaluation.probes import IntervalScale, NumberProbe, score_intervals
from cltp.evaluation.retrieval import score_retrieval
from cltp.evaluation.scores import best_classes, score_classes
from cltp.evaluation.zero_shot import PROMPTINGS, ClassPrompts
from cltp.texts.captions import caption
from cltp.train.methods import ALIGNED_METHODS, TRAINING_ORDER
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.checkpoints import (
    TrainedMethod,
    find_method,
    find_method_of_data,
)
from tacgrasp.pretraining.evaluation_run import EvaluatedContacts, EvaluationRun, probe_scorer
from tacgrasp.pretraining.methods import labelled
from tacgrasp.pretraining.real_touches import RealTouches
from tacgrasp.pretraining.report.failures import FAILURE_SPLITS, collect_failures
from tacgrasp.pretraining.report.store import Result, save

TABLES = {one: "zero_shot" if one == "single" else f"zero_shot_{one}" for one in PROMPTINGS}
_FAILURE_TABLES = ("zero_shot", "probe")

Scorer = Callable[[EncodedContacts, EvaluatedContacts], Sequence[Tensor]]
"""Scores of each class of a split's contacts by dimension, shape (N, classes), or (k N, classes)
where they are scored k times."""


def trained_methods(run: EvaluationRun, methods: Sequence[str]) -> dict[str, TrainedMethod]:
    """The methods named, or all that were trained.

    Raises:
        UsageError: One was not trained, or none.
        TouchError: One was trained on other data.
    """
    checksum = run.checksum
    if run.encoders is not None:
        return dict(run.encoders)
    if methods:
        return {method: find_method_of_data(method, run.weights, checksum) for method in methods}
    available = {}
    for method in TRAINING_ORDER:
        with suppress(UsageError):
            available[method] = find_method_of_data(method, run.weights, checksum)
    if not available:
        raise UsageError(f"no method was trained in {run.weights}; see `tacgrasp train --help`")
    return available


def zero_shot(
    run: EvaluationRun,
    methods: Sequence[str] = (),
    *,
    real: RealTouches | None = None,
    promptings: Sequence[str] = PROMPTINGS,
    predictions: Path | None = None,
) -> list[Result]:
    """Table 1: classes by the nearest prompt.

    Real touches are also classified by weights that don't say what they were trained on, as the
    shipped ones, but such results are not stored.

    Args:
        run: Folders and settings.
        methods: Names; all that were trained when empty, and ``cltp`` for real touches.
        real: Real touches in place of the data's contacts.
        promptings: Out of ``PROMPTINGS``.
        predictions: CSV file with a row for each real touch.

    Raises:
        UsageError: A method is not aligned with language in all dimensions, or was not trained.
        TouchError: Weights or data can't be used.
    """
    for method in methods:
        if method not in ALIGNED_METHODS:
            raise UsageError(
                f"{method} has no prompts for contact states; {', '.join(ALIGNED_METHODS)} do"
            )
    if real is None:
        trained = _aligned_methods(run, methods)
    else:
        trained = {name: find_method(name, run.weights) for name in methods or ("cltp",)}
        trained = {name: replace(one, data=one.data or "") for name, one in trained.items()}

    def scorers(_: str, method: TrainedMethod, __: FrozenEncoder) -> dict[str, Scorer]:
        towers = method.towers(run.weights)
        return {TABLES[one]: _by_prompts(ClassPrompts(towers, one)) for one in promptings}

    splits = [real] if real is not None else run.evaluation_splits()
    return _measure_classes(run, trained, splits, scorers, "cosine", predictions)


def probe(
    run: EvaluationRun,
    methods: Sequence[str] = (),
    *,
    views: int = 2,
    real: RealTouches | None = None,
    predictions: Path | None = None,
) -> list[Result]:
    """Table 2 and appendix A: MLPs on frozen features, and for CLTP numbers with intervals.

    Args:
        run: Folders and settings.
        methods: Names; all that were trained when empty.
        views: How often each training contact is encoded.
        real: Real touches, on which classes alone are measured, in place of the data's contacts.
        predictions: CSV file with a row for each real touch.

    Raises:
        UsageError: A method was not trained.
        TouchError: Weights or data can't be used.
    """
    results = []

    def scorers(name: str, method: TrainedMethod, encoder: FrozenEncoder) -> dict[str, Scorer]:
        if name == "cltp" and real is None:
            results.extend(_numbers(run, encoder, views, method))
        named = replace(run.probe_training, report=labelled(run.report, name))
        return {"probe": probe_scorer(run, encoder, views, named)}

    splits = [real] if real is not None else run.evaluation_splits()
    trained = trained_methods(run, methods)
    return results + _measure_classes(run, trained, splits, scorers, "probability", predictions)


def _by_prompts(prompts: ClassPrompts) -> Scorer:
    return lambda encoded, _: prompts.cosines(encoded.feature)


def _measure_classes(
    run: EvaluationRun,
    methods: Mapping[str, TrainedMethod],
    splits: Sequence[EvaluatedContacts],
    scorers: Callable[[str, TrainedMethod, FrozenEncoder], dict[str, Scorer]],
    measure: str,
    predictions: Path | None,
) -> list[Result]:
    """Score classes by each method on each split, for each table that ``scorers`` gives.

    Predictions about real touches are written into ``predictions``, with several methods into
    ``NAME-METHOD.csv``. Of CLTP, failures are stored with pictures in the splits of the paper's
    tables.
    """
    results = []
    for name, method in methods.items():
        encoder = method.encoder()
        by_table = scorers(name, method, encoder)
        for split in splits:
            encoded = run.encode(encoder, split)
            for table, scorer in by_table.items():
                scores = scorer(encoded, split)
                classes = encoded.classes.repeat(len(scores[0]) // len(encoded), 1)
                accuracy = replace(score_classes(best_classes(scores), classes), count=len(encoded))
                result = run.store_scores(table, name, method, split, accuracy)
                results.append(result)
                if isinstance(split, RealTouches):
                    if predictions is not None:
                        file = f"{predictions.stem}-{name}{predictions.suffix}"
                        path = predictions if len(methods) == 1 else predictions.with_name(file)
                        split.write_predictions(path, scores, measure)
                elif name == "cltp" and table in _FAILURE_TABLES and split.name in FAILURE_SPLITS:
                    data = ContactDataset(run.data, split=split.split)
                    failures = collect_failures(result, data, encoded, scores, measure)
                    save(run.results, failures)
    return results


def _numbers(
    run: EvaluationRun, encoder: FrozenEncoder, views: int, method: TrainedMethod
) -> list[Result]:
    """Numbers, with intervals calibrated on the validation split with each split's noise."""
    names = ContactDataset(run.data, split=Split.TRAIN).column("object")
    objects = torch.from_numpy(np.unique(names, return_inverse=True)[1])

    @lru_cache
    def fitted(learning: Augmentation, noise: Augmentation) -> tuple[NumberProbe, IntervalScale]:
        learned = run.encode_split(encoder, Split.TRAIN, learning, views=views)
        probe = NumberProbe(learned, objects[learned.index], run.probe_training)
        held_out = run.encode_split(encoder, Split.VALIDATION, noise, views=2)
        return probe, probe.calibrate(held_out)

    results = []
    for split in run.evaluation_splits():
        encoded = run.encode(encoder, split)
        probe, scale = fitted(split.probe_noise, split.noise)
        values = score_intervals(probe.intervals(encoded, scale), encoded)
        result = run.result("numbers", "cltp", method, split.name, len(encoded), values)
        results.append(run.store(result))
    return results


def retrieval(run: EvaluationRun, methods: Sequence[str] = ()) -> list[Result]:
    """How often contacts and captions find each other, among all of a split.

    Raises:
        UsageError: A method was not trained.
        TouchError: Weights or data can't be used.
    """
    results = []
    for name, method in _aligned_methods(run, methods).items():
        encoder, towers = method.encoder(), method.towers(run.weights)
        for split in run.evaluation_splits():
            encoded = run.encode(encoder, split)
            captions = captions_of(ContactDataset(run.data, split=split.split), encoded)
            values = score_retrieval(towers, encoded, captions)
            result = run.result("retrieval", name, method, split.name, len(encoded), values)
            results.append(run.store(result))
    return results


def captions_of(data: ContactDataset, encoded: EncodedContacts) -> list[str]:
    """Captions of contacts of a split."""
    return [caption(data.state(int(index))) for index in encoded.index]


def _aligned_methods(run: EvaluationRun, methods: Sequence[str]) -> Mapping[str, TrainedMethod]:
    """The methods named, or all aligned ones that were trained."""
    trained = trained_methods(run, methods)
    return {name: trained[name] for name in methods or ALIGNED_METHODS if name in trained}
