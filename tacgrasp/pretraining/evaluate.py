"""Try pre-trained encoders: zero-shot, probes, numbers, retrieval; each figure into a result.

Every method is tried in the same way: the same contacts, the same noise, the same probes. What can
be had from the same 1024 points without an encoder stands beside all of them
(``tacgrasp.pretraining.geometric_baseline``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import torch
from torch import Tensor

from cltp.checkpoints.frozen import FrozenEncoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY
from cltp.evaluation.features import Observed
from cltp.evaluation.probes import ClassProbes, Judged, NumberProbe, judge, number_scores
from cltp.evaluation.splits import LEARNING
from cltp.evaluation.zero_shot import PROMPTINGS, Prompts, retrieve
from cltp.texts.captions import caption
from cltp.train.stage import ProgressReport
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.checkpoints import TrainedMethod, checkpoint_of_others, trained
from tacgrasp.pretraining.evaluation_run import EvaluationRun, keep
from tacgrasp.pretraining.geometric_baseline import ceiling, heights_alone
from tacgrasp.pretraining.methods import METHODS
from tacgrasp.pretraining.report.failures import TRIALS as FAILURE_TRIALS
from tacgrasp.pretraining.report.failures import collect, save_failures
from tacgrasp.pretraining.report.store import Result, save

ALIGNED = ("cltp_no_image", "cltp")
"""Methods that speak of all dimensions, so that zero-shot prompts mean something to them."""


def trainable(place: EvaluationRun, methods: Sequence[str]) -> dict[str, TrainedMethod]:
    """The methods asked for, or all that were trained; see ``tacgrasp.pretraining.checkpoints``.

    Raises:
        UsageError: One was not trained, or none.
        TouchError: One was trained on other data.
    """
    checksum = place.checksum
    if place.checkpoint is not None:
        if len(methods) != 1:
            raise UsageError("--checkpoint needs one method: --methods tvl or unitouch")
        return {methods[0]: checkpoint_of_others(methods[0], place.checkpoint)}
    if methods:
        return {method: trained(method, place.weights, checksum) for method in methods}
    found = {}
    for method in METHODS:
        try:
            found[method] = trained(method, place.weights, checksum)
        except UsageError:
            continue
    if not found:
        raise UsageError(f"no method was trained in {place.weights}; see `tacgrasp train --help`")
    return found


def zero_shot(place: EvaluationRun, methods: Sequence[str] = ()) -> list[Result]:
    """Table 1: classes by the nearest prompt, with one prompt a class and with several.

    Raises:
        UsageError: A method is not aligned with language in all dimensions, or was not trained.
        TouchError: Weights or data can't be used.
    """
    for method in methods:
        if method not in ALIGNED:
            raise UsageError(f"{method} has no prompts for contact states; {', '.join(ALIGNED)} do")
    found = []
    for method, how in trainable(place, methods or _there(place, ALIGNED)).items():
        encoder, towers = how.encoder(), how.towers(place.weights)
        for trial in place.trying():
            seen = place.seen(encoder, trial.split, trial.noise)
            for prompting, table in zip(
                PROMPTINGS, ("zero_shot", "zero_shot_ensemble"), strict=True
            ):
                prompts = Prompts(towers, prompting)
                judged = judge(prompts.said(seen.feature), seen.classes)
                found.append(keep(place, table, method, how, trial, judged))
                if table == "zero_shot":
                    _keep_failures(place, found[-1], seen, prompts.cosines(seen.feature), "cosine")
    return found + ceiling(place, ("zero_shot",))


def probe(place: EvaluationRun, methods: Sequence[str] = (), *, views: int = 2) -> list[Result]:
    """Table 2 and appendix A: MLPs on frozen features, and for CLTP numbers with intervals.

    Args:
        place: What is tried.
        methods: All that were trained when empty.
        views: How often each training contact is seen, half of the time without noise.

    Raises:
        UsageError: A method was not trained.
        TouchError: Weights or data can't be used.
    """
    found, trials = [], place.trying()
    for method, how in trainable(place, methods).items():
        encoder = how.encoder()
        learned = place.seen(encoder, Split.TRAIN, LEARNING, views=views, whole=True)
        probes = ClassProbes(learned, seed=place.seed, report=_named(place.report, method))
        for trial in trials:
            seen = place.seen(encoder, trial.split, trial.noise)
            judged = judge(probes.said(seen), seen.classes)
            found.append(keep(place, "probe", method, how, trial, judged))
            _keep_failures(place, found[-1], seen, probes.sure(seen), "probability")
        if method == "cltp":
            found += _numbers(place, encoder, learned, method, how)
    return [*found, *ceiling(place, ("probe",)), *heights_alone(place, views)]


def _numbers(
    place: EvaluationRun, encoder: FrozenEncoder, learned: Observed, method: str, how: TrainedMethod
) -> list[Result]:
    """Regression and its intervals, calibrated on the validation split with the trial's noise."""
    names = ContactDataset(place.data, split=Split.TRAIN).column("object")
    things = torch.from_numpy(np.unique(names, return_inverse=True)[1])[learned.index]
    reader = NumberProbe(learned, things, seed=place.seed, report=place.report)
    stretches = {
        str(noise): reader.calibrate(
            place.seen(encoder, Split.VALIDATION, noise, views=2, whole=True)
        )
        for noise in (CLEAN, NOISY)
    }
    found = []
    for trial in place.trying():
        seen = place.seen(encoder, trial.split, trial.noise)
        scores = number_scores(reader.said(seen, stretches[str(trial.noise)]), seen)
        judged = Judged(scores, {}, len(seen))
        result = keep(place, "numbers", method, how, trial, judged)
        found.append(replace(result, values=dict(scores)))
        save(place.results, found[-1])
    return found


def retrieval(place: EvaluationRun, methods: Sequence[str] = ()) -> list[Result]:
    """How often contacts and captions find each other, all of a split against all.

    Raises:
        UsageError: A method was not trained.
        TouchError: Weights or data can't be used.
    """
    found = []
    for method, how in trainable(place, methods or _there(place, ALIGNED)).items():
        encoder, towers = how.encoder(), how.towers(place.weights)
        for trial in place.trying():
            seen = place.seen(encoder, trial.split, trial.noise)
            captions = captions_of(ContactDataset(place.data, split=trial.split), seen)
            scores = retrieve(towers, seen, captions)
            values: dict[str, float | None] = {
                **{f"contact_to_text_{k}": 100 * v for k, v in scores.contact_to_text.items()},
                **{f"text_to_contact_{k}": 100 * v for k, v in scores.text_to_contact.items()},
                "chance": 100 * scores.chance,
                "captions": float(scores.captions),
            }
            result = keep(place, "retrieval", method, how, trial, Judged({}, {}, len(seen)))
            found.append(replace(result, values=values))
            save(place.results, found[-1])
    return found


def captions_of(data: ContactDataset, seen: Observed) -> list[str]:
    """Captions of the contacts seen."""
    return [caption(data.state(int(index))) for index in seen.index]


def _keep_failures(
    place: EvaluationRun, result: Result, seen: Observed, sure: Sequence[Tensor], measure: str
) -> None:
    """Keep what CLTP named wrongly, with pictures, in the trials of the paper's tables."""
    if result.method != "cltp" or result.trial not in FAILURE_TRIALS:
        return
    split = next(trial.split for trial in place.trying() if trial.name == result.trial)
    data = ContactDataset(place.data, split=split)
    save_failures(place.results, result, collect(result, data, seen, sure, measure))


def _there(place: EvaluationRun, methods: Sequence[str]) -> list[str]:
    """Those of some methods that were trained."""
    return [method for method in methods if method in trainable(place, ())]


def _named(report: ProgressReport, method: str) -> ProgressReport:
    def told(stage: str, step: int, steps: int, scores: object) -> None:
        report(f"{method} {stage}", step, steps, {})

    return told
