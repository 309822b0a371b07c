"""Evaluate encoders on real touches: prompts (table 1), probes (table 2), geometric baseline.

Only dimensions with a label are scored. Weights that don't say what they were trained on, as the
shipped ones, are evaluated too, but their results are not stored: a report is of one data set.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from cltp.evaluation.probes import ClassProbes
from cltp.evaluation.scores import ClassScores, score_classes
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import MEASURABLE
from cltp.train.text_targets import class_numbers
from tacgrasp.pretraining.checkpoints import TrainedMethod, find_method
from tacgrasp.pretraining.evaluate import check_aligned, trained_methods
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.geometric_baseline import baseline_method
from tacgrasp.pretraining.real_touches import (
    LabelledTouch,
    encode_touches,
    labels_of,
    predict_touches,
    read_inputs,
    write_predictions,
)
from tacgrasp.pretraining.report.store import GEOMETRIC_BASELINE, Result

SPLIT = "real"


@dataclass(frozen=True, slots=True, kw_only=True)
class RealSet:
    """Labelled touches of one sensor.

    Attributes:
        rows: The touches.
        sensor: The sensor that recorded them.
        background: Frame of the untouched unit, for frames.
        predictions: CSV file with a row for each touch; with several methods,
            ``NAME-METHOD.csv``.
    """

    rows: list[LabelledTouch]
    sensor: SensorSpec
    background: Path | None
    predictions: Path

    def predictions_of(self, method: str, methods: Sequence[str]) -> Path:
        """The CSV file of one of the methods."""
        path = self.predictions
        one = len(methods) == 1
        return path if one else path.with_name(f"{path.stem}-{method}{path.suffix}")


def zero_shot_real(
    run: EvaluationRun, methods: Sequence[str], real: RealSet, *, prompting: str = "single"
) -> list[Result]:
    """Classify real touches by the nearest prompt, with ``cltp`` when no method is named.

    Raises:
        UsageError: A method has no prompts or was not trained, or the rows can't be written.
        TouchError: A file is no touch of this sensor, or weights can't be used.
    """
    names = methods or ("cltp",)
    check_aligned(names)
    table = "zero_shot" if prompting == "single" else "zero_shot_ensemble"
    touches = read_inputs(real.rows, real.sensor, real.background)
    results = []
    for name in names:
        method = find_method(name, run.weights)
        encoded = encode_touches(method.encoder(), real.rows, touches)
        prompts = ClassPrompts(method.towers(run.weights), prompting)
        predictions = predict_touches(real.rows, prompts.cosines(encoded.feature), "cosine")
        write_predictions(real.predictions_of(name, names), predictions)
        results.append(_result(run, table, name, method, predictions.scores))
    data = find_method(names[0], run.weights).data
    return [*results, _geometric_baseline(run, table, data, real, touches.clouds)]


def probe_real(
    run: EvaluationRun, methods: Sequence[str], real: RealSet, *, views: int = 2
) -> list[Result]:
    """Classify real touches by probes that learned from the training contacts of the data set.

    Raises:
        UsageError: A method was not trained, or the rows can't be written.
        TouchError: A file is no touch of this sensor, or weights or data can't be used.
    """
    touches = read_inputs(real.rows, real.sensor, real.background)
    results = []
    by_name = trained_methods(run, methods)
    for name, method in by_name.items():
        encoder = method.encoder()
        learned = run.encode_training(encoder, views)
        probes = ClassProbes(learned, seed=run.seed, report=run.report)
        probabilities = probes.probabilities(encode_touches(encoder, real.rows, touches))
        predictions = predict_touches(real.rows, probabilities, "probability")
        write_predictions(real.predictions_of(name, list(by_name)), predictions)
        method = replace(method, data=run.checksum)
        results.append(_result(run, "probe", name, method, predictions.scores))
    return [*results, _geometric_baseline(run, "probe", run.checksum, real, touches.clouds)]


def _geometric_baseline(
    run: EvaluationRun, table: str, data: str | None, real: RealSet, clouds: Sequence[TactileCloud]
) -> Result:
    classes = class_numbers([contact_state(cloud) for cloud in clouds])
    scores = score_classes(classes, labels_of(real.rows)).restricted(MEASURABLE)
    return _result(run, table, GEOMETRIC_BASELINE, replace(baseline_method(run), data=data), scores)


def _result(
    run: EvaluationRun, table: str, name: str, method: TrainedMethod, scores: ClassScores
) -> Result:
    """A result, stored where the method says what it was trained on."""
    of_data = replace(method, data=method.data or "")
    result = run.class_result(table, name, of_data, SPLIT, scores)
    return run.store(result) if method.data is not None else result
