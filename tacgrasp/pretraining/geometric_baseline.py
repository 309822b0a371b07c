"""What can be had from the same 1024 points without an encoder: computed, or read off heights.

``measured``: direct computation (``cltp.tactile.measure``), which stands up to noise and knows the
    sensor's geometry; depth, position and area.
``heights alone``: probes on the points' heights in falling order, without their places
    (``cltp.evaluation.heights_alone``); depth and area. It learns from the same contacts as other
    probes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.evaluation.heights_alone import HeightsAlone
from cltp.evaluation.probes import ClassProbes, Judged, judge
from cltp.evaluation.splits import LEARNING
from cltp.evaluation.zero_shot import measured
from cltp.tactile.states import MEASURABLE
from tacgrasp.pretraining.checkpoints import TrainedMethod
from tacgrasp.pretraining.evaluation_run import EvaluationRun, keep, kept
from tacgrasp.pretraining.report.store import Result

READ_OFF = ("depth", "area")


def ceiling(place: EvaluationRun, tables: Sequence[str]) -> list[Result]:
    """What direct computation gives, as a row of tables. Shape and texture are not computed.

    What is stored of the same contacts is not computed again.
    """
    found = []
    how = TrainedMethod(folder=place.weights, variant="measured", budget=None)
    for trial in place.trying():
        there = [kept(place, table, "ceiling", how, trial) for table in tables]
        if None not in there:
            found += [result for result in there if result is not None]
            continue
        data = ContactDataset(place.data, split=trial.split)
        said, truth = measured(data, trial.noise, limit=place.limit, seed=place.seed)
        judged = of_slots(judge(said, truth), MEASURABLE)
        found += [keep(place, table, "ceiling", how, trial, judged) for table in tables]
    return found


def heights_alone(place: EvaluationRun, views: int) -> list[Result]:
    """What probes read off heights in falling order, as a row of table 2; once, as ``ceiling``.

    Args:
        place: What is tried.
        views: How often each training contact is seen.

    Raises:
        TouchError: The data can't be used.
    """
    encoder = HeightsAlone()
    how = TrainedMethod(folder=place.weights, variant="heights alone", budget=None)
    there = [kept(place, "probe", "ceiling", how, trial) for trial in place.trying()]
    if None not in there:
        return [result for result in there if result is not None]
    learned = place.seen(encoder, Split.TRAIN, LEARNING, views=views, whole=True)
    probes = ClassProbes(learned, seed=place.seed, report=place.report)
    found = []
    for trial in place.trying():
        seen = place.seen(encoder, trial.split, trial.noise)
        judged = of_slots(judge(probes.said(seen), seen.classes), READ_OFF)
        found.append(keep(place, "probe", "ceiling", how, trial, judged))
    return found


def of_slots(judged: Judged, slots: Sequence[str]) -> Judged:
    """What was judged, of some dimensions alone."""
    right = {slot: v if slot in slots else math.nan for slot, v in judged.right.items()}
    return Judged(right, {slot: judged.confusion[slot] for slot in slots}, judged.count)
