"""Try encoders on real touches: table 1 by prompts, table 2 by probes, the ceiling beside them.

Only the labels that somebody gave are judged. Weights that don't say what they were trained on, as
those that come along, are tried too, but their results are not stored: a report is of one data
set.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import torch

from cltp.data.contact import Split
from cltp.evaluation.probes import ClassProbes, Judged, judge
from cltp.evaluation.splits import LEARNING
from cltp.evaluation.zero_shot import Prompts
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import MEASURABLE
from cltp.train.text_targets import class_numbers
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.checkpoints import TrainedMethod, stored
from tacgrasp.pretraining.evaluate import ALIGNED, trainable
from tacgrasp.pretraining.evaluation_run import EvaluationRun, as_result
from tacgrasp.pretraining.geometric_baseline import of_slots
from tacgrasp.pretraining.real_touches import (
    Labelled,
    observed,
    read_inputs,
    told,
    write_predictions,
)
from tacgrasp.pretraining.report.store import Result, save

TRIAL = "real"


@dataclass(frozen=True, slots=True, kw_only=True)
class RealSet:
    """Labelled touches of one sensor.

    Attributes:
        rows: The touches.
        sensor: That made them.
        background: Frame of the unit untouched, for frames.
        predictions: CSV file for one row a prediction; with several methods, ``NAME-METHOD.csv``.
    """

    rows: list[Labelled]
    sensor: SensorSpec
    background: Path | None
    predictions: Path


def zero_shot_real(
    place: EvaluationRun, methods: Sequence[str], real: RealSet, *, prompting: str = "single"
) -> list[Result]:
    """Name real touches by the nearest prompt; ``cltp`` when no method is named.

    Raises:
        UsageError: A method has no prompts or was not trained, or the rows can't be written.
        TouchError: A file is no touch of this sensor, or weights can't be used.
    """
    methods = methods or ("cltp",)
    for method in methods:
        if method not in ALIGNED:
            raise UsageError(f"{method} has no prompts for contact states; {', '.join(ALIGNED)} do")
    table = "zero_shot" if prompting == "single" else "zero_shot_ensemble"
    touches = read_inputs(real.rows, real.sensor, real.background)
    found = []
    for method in methods:
        how = stored(method, place.weights)
        seen = observed(how.encoder(), real.rows, touches)
        prompts = Prompts(how.towers(place.weights), prompting)
        said = told(real.rows, prompts.cosines(seen.feature), "cosine")
        write_predictions(_file(real, methods, method), said)
        found.append(_stored(place, table, method, how, said.judged))
    how = stored(methods[0], place.weights)
    return [*found, _ceiling(place, table, how.data, real, touches.clouds)]


def probe_real(
    place: EvaluationRun, methods: Sequence[str], real: RealSet, *, views: int = 2
) -> list[Result]:
    """Name real touches by probes that learned from the training contacts of the data set.

    Raises:
        UsageError: A method was not trained, or the rows can't be written.
        TouchError: A file is no touch of this sensor, or weights or data can't be used.
    """
    touches = read_inputs(real.rows, real.sensor, real.background)
    found = []
    hows = trainable(place, methods)
    for method, how in hows.items():
        encoder = how.encoder()
        learned = place.seen(encoder, Split.TRAIN, LEARNING, views=views, whole=True)
        probes = ClassProbes(learned, seed=place.seed, report=place.report)
        sure = probes.sure(observed(encoder, real.rows, touches))
        said = told(real.rows, sure, "probability")
        write_predictions(_file(real, list(hows), method), said)
        found.append(
            _stored(place, "probe", method, replace(how, data=place.checksum), said.judged)
        )
    return [*found, _ceiling(place, "probe", place.checksum, real, touches.clouds)]


def _file(real: RealSet, methods: Sequence[str], method: str) -> Path:
    path = real.predictions
    return path if len(methods) == 1 else path.with_name(f"{path.stem}-{method}{path.suffix}")


def _ceiling(
    place: EvaluationRun,
    table: str,
    data: str | None,
    real: RealSet,
    clouds: Sequence[TactileCloud],
) -> Result:
    """What direct computation from the same points gives; shape and texture are not computed."""
    said = class_numbers([contact_state(cloud) for cloud in clouds])
    judged = of_slots(judge(said, torch.tensor([row.classes for row in real.rows])), MEASURABLE)
    how = TrainedMethod(folder=place.weights, variant="measured", budget=None, data=data)
    return _stored(place, table, "ceiling", how, judged)


def _stored(
    place: EvaluationRun, table: str, method: str, how: TrainedMethod, judged: Judged
) -> Result:
    result = as_result(place, table, method, how, TRIAL, judged, how.data or "")
    if how.data is not None:
        save(place.results, result)
    return result
