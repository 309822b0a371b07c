"""Evaluate pre-trained encoders: zero-shot, probes, numbers, retrieval; each into a stored result.

Every method is evaluated on the same contacts, with the same noise and the same probes. The
geometric baseline, which needs no encoder, is measured with them
(``tacgrasp.pretraining.geometric_baseline``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import torch
from torch import Tensor

from cltp.checkpoints.frozen import FrozenEncoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY
from cltp.evaluation.features import EncodedContacts
from cltp.evaluation.probes import ClassProbes, NumberProbe, score_intervals
from cltp.evaluation.retrieval import score_retrieval
from cltp.evaluation.scores import score_classes
from cltp.evaluation.splits import EvaluationSplit
from cltp.evaluation.zero_shot import PROMPTINGS, ClassPrompts
from cltp.texts.captions import caption
from cltp.train.methods import ALIGNED_METHODS, TRAINING_ORDER
from cltp.train.stage import ProgressReport
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.checkpoints import TrainedMethod, external_checkpoint, find_method_of_data
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.geometric_baseline import geometric_baseline, heights_alone
from tacgrasp.pretraining.report.failures import FAILURE_SPLITS, collect_failures
from tacgrasp.pretraining.report.store import Result, save


def trained_methods(run: EvaluationRun, methods: Sequence[str]) -> dict[str, TrainedMethod]:
    """The methods named, or all that were trained.

    Raises:
        UsageError: One was not trained, or none.
        TouchError: One was trained on other data.
    """
    checksum = run.checksum
    if run.checkpoint is not None:
        if len(methods) != 1:
            raise UsageError("--checkpoint needs one method: --methods tvl or unitouch")
        return {methods[0]: external_checkpoint(methods[0], run.checkpoint)}
    if methods:
        return {method: find_method_of_data(method, run.weights, checksum) for method in methods}
    available = {}
    for method in TRAINING_ORDER:
        try:
            available[method] = find_method_of_data(method, run.weights, checksum)
        except UsageError:
            continue
    if not available:
        raise UsageError(f"no method was trained in {run.weights}; see `tacgrasp train --help`")
    return available


def check_aligned(methods: Sequence[str]) -> None:
    """Refuse methods without prompts.

    Raises:
        UsageError: A method is not aligned with language in all dimensions.
    """
    for method in methods:
        if method not in ALIGNED_METHODS:
            raise UsageError(
                f"{method} has no prompts for contact states; {', '.join(ALIGNED_METHODS)} do"
            )


def zero_shot(run: EvaluationRun, methods: Sequence[str] = ()) -> list[Result]:
    """Table 1: classes by the nearest prompt, with one prompt a class and with several.

    Raises:
        UsageError: A method is not aligned with language in all dimensions, or was not trained.
        TouchError: Weights or data can't be used.
    """
    check_aligned(methods)
    results = []
    tables = dict(zip(PROMPTINGS, ("zero_shot", "zero_shot_ensemble"), strict=True))
    for name, method in _aligned_methods(run, methods).items():
        encoder, towers = method.encoder(), method.towers(run.weights)
        prompts = {prompting: ClassPrompts(towers, prompting) for prompting in tables}
        for split in run.evaluation_splits():
            encoded = run.encode(encoder, split)
            for prompting, table in tables.items():
                classes = prompts[prompting].classes(encoded.feature)
                scores = score_classes(classes, encoded.classes)
                result = run.store(run.class_result(table, name, method, split.name, scores))
                results.append(result)
                if table == "zero_shot":
                    cosines = prompts[prompting].cosines(encoded.feature)
                    _store_failures(run, result, split, encoded, cosines, "cosine")
    return results + geometric_baseline(run, ("zero_shot",))


def probe(run: EvaluationRun, methods: Sequence[str] = (), *, views: int = 2) -> list[Result]:
    """Table 2 and appendix A: MLPs on frozen features, and for CLTP numbers with intervals.

    Args:
        run: Folders and settings.
        methods: Names; all that were trained when empty.
        views: How often each training contact is encoded, half of the time without noise.

    Raises:
        UsageError: A method was not trained.
        TouchError: Weights or data can't be used.
    """
    results = []
    splits = run.evaluation_splits()
    for name, method in trained_methods(run, methods).items():
        encoder = method.encoder()
        learned = run.encode_training(encoder, views)
        probes = ClassProbes(learned, seed=run.seed, report=_named(run.report, name))
        for split in splits:
            encoded = run.encode(encoder, split)
            scores = score_classes(probes.classes(encoded), encoded.classes)
            result = run.store(run.class_result("probe", name, method, split.name, scores))
            results.append(result)
            probabilities = probes.probabilities(encoded)
            _store_failures(run, result, split, encoded, probabilities, "probability")
        if name == "cltp":
            results += _numbers(run, encoder, learned, name, method)
    return [*results, *geometric_baseline(run, ("probe",)), *heights_alone(run, views)]


def _numbers(
    run: EvaluationRun,
    encoder: FrozenEncoder,
    learned: EncodedContacts,
    name: str,
    method: TrainedMethod,
) -> list[Result]:
    """Numbers, with intervals calibrated on the validation split with each split's noise."""
    names = ContactDataset(run.data, split=Split.TRAIN).column("object")
    objects = torch.from_numpy(np.unique(names, return_inverse=True)[1])[learned.index]
    probe = NumberProbe(learned, objects, seed=run.seed, report=run.report)
    scales = {
        str(noise): probe.calibrate(run.encode_validation(encoder, noise))
        for noise in (CLEAN, NOISY)
    }
    results = []
    for split in run.evaluation_splits():
        encoded = run.encode(encoder, split)
        values = score_intervals(probe.intervals(encoded, scales[str(split.noise)]), encoded)
        result = run.result("numbers", name, method, split.name, len(encoded), values)
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
            scores = score_retrieval(towers, encoded, captions)
            values: dict[str, float | None] = {
                **{f"contact_to_text_{k}": 100 * v for k, v in scores.contact_to_text.items()},
                **{f"text_to_contact_{k}": 100 * v for k, v in scores.text_to_contact.items()},
                "chance": 100 * scores.chance,
                "captions": float(scores.captions),
            }
            result = run.result("retrieval", name, method, split.name, len(encoded), values)
            results.append(run.store(result))
    return results


def captions_of(data: ContactDataset, encoded: EncodedContacts) -> list[str]:
    """Captions of contacts of a split."""
    return [caption(data.state(int(index))) for index in encoded.index]


def _store_failures(
    run: EvaluationRun,
    result: Result,
    split: EvaluationSplit,
    encoded: EncodedContacts,
    scores: Sequence[Tensor],
    measure: str,
) -> None:
    """Store CLTP's wrong predictions, with pictures, in the splits of the paper's tables."""
    if result.method == "cltp" and split.name in FAILURE_SPLITS:
        data = ContactDataset(run.data, split=split.split)
        save(run.results, collect_failures(result, data, encoded, scores, measure))


def _aligned_methods(run: EvaluationRun, methods: Sequence[str]) -> Mapping[str, TrainedMethod]:
    """The methods named, or all aligned ones that were trained."""
    if methods:
        return trained_methods(run, methods)
    available = trained_methods(run, ())
    return {name: available[name] for name in ALIGNED_METHODS if name in available}


def _named(report: ProgressReport, method: str) -> ProgressReport:
    def named_report(stage: str, step: int, steps: int, scores: object) -> None:
        report(f"{method} {stage}", step, steps, {})

    return named_report
