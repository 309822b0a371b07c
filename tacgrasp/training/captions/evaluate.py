"""``tacgrasp eval captions``: the ratings of a language model's captions, and of trivial ones.

The contacts are of the split ``contact_noisy``: unseen ones with the noise of a calibrated unit.
Trivial answers are rated on the same contacts:

    most frequent      the words that most contacts of the training split have, with its median
                       numbers
    another contact's  the true caption of another contact of the sample

So are the model's own captions with every number, however well known, and without any: the rating
counts what is said, so that a caption may gain by saying less.

So is what an observer with exact heights would say (``cltp.evaluation.exact_observer``), who is
told shape and texture: it shows what the errors of a unit leave of the numbers and of the other
words.

Not here: the rule (``tacgrasp.training.captions.rating``).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from cltp.checkpoints.base_lm import BaseLm, is_stock
from cltp.checkpoints.card import CARD
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Batch
from cltp.evaluation.exact_observer import observed_state
from cltp.evaluation.features import random_batches
from cltp.evaluation.splits import evaluation_splits
from cltp.llm.generation import Talker
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.states import CLASSES, NUMBERS, ContactState
from cltp.texts.captions import caption
from cltp.train.stage import ProgressReport, silent
from policies.llm.spoken import caption_reply
from policies.llm.text import caption_text
from tacgrasp.lessons.dialogue.scoring.question_file import read_questions
from tacgrasp.lessons.question_scores import answer_all, ask_all, figures
from tacgrasp.policy_factory import load_llm
from tacgrasp.pretraining.report.store import (
    CAPTIONS,
    EVERY_NUMBER,
    EXACT_HEIGHTS,
    MOST_FREQUENT,
    SHUFFLED,
    WORDS_ALONE,
    Result,
    save,
)
from tacgrasp.training.captions.judges import Judge, JudgedPair
from tacgrasp.training.captions.rating import CaptionRating, rate_caption, words_of
from tacgrasp.training.other_encoder import method_of
from tacgrasp.training.question_evaluation import (
    asked_model,
    by_model,
    felt_contacts,
    own_questions,
    spoken_once,
)

SPLIT = "contact_noisy"

CONTACTS = 1000
"""Contacts whose captions are rated."""

_LEARNED_DATA = re.compile(r"^\| data checksum \| ([0-9a-f]{8,})", re.M)
"""The line of a model card that names the data of the training."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaptionRun:
    """What is measured.

    Attributes:
        weights: Folder of weights with a language model.
        data: A data set of contacts.
        results: Folder of results.
        contacts: Number of contacts.
        questions: Number of contacts to ask questions about; 0 for none.
        seed: Random seed of the choice and of the noise.
        judge: Rates the captions too; None for the rule alone.
        command: Command line, stored with the results.
        report: Receives the progress.
    """

    weights: Path
    data: Path
    results: Path
    contacts: int = CONTACTS
    questions: int = 0
    seed: int = 0
    judge: Judge | None = None
    command: str = ""
    report: ProgressReport = silent


def rate_captions(run: CaptionRun) -> list[Result]:
    """Rate the model's captions and the trivial ones, and store the ratings.

    Raises:
        UsageError: The judge fails, or results can't be written.
        TouchError: Weights or data can't be used, or the data has no contacts of the split.
    """
    (split,) = evaluation_splits(run.data, (SPLIT,))
    talker, checksum = load_llm(run.weights).talker, ContactDataset(run.data).checksum()
    data = ContactDataset(run.data, split=split.split)
    batches = random_batches(data, run.contacts, split.noise, seed=run.seed, layout=talker.layout)
    truths = [state for batch in batches for state in batch.states]
    references = [caption_text(state) for state in truths]
    texts: list[str] = []
    with_numbers: list[str] = []
    for points in (points for batch in batches for points in batch.points):
        felt = talker.feel(points)
        texts.append(caption_reply(talker, felt, ranges=True).text)
        with_numbers.append(caption_reply(talker, felt).text)
        run.report("captions", len(texts), len(truths), {})
    usual = Result(
        table=CAPTIONS,
        method=method_of(run.weights),
        variant=variant_of(run.weights, checksum),
        split=SPLIT,
        seed=run.seed,
        data=checksum,
        budget=None,
        command=run.command,
        contacts=len(truths),
        values={},
    )
    frequent = most_frequent_caption(ContactDataset(run.data, split=Split.TRAIN))
    rows = (
        (usual, texts),
        (replace(usual, method=EVERY_NUMBER, variant=""), with_numbers),
        (replace(usual, method=WORDS_ALONE, variant=""), [words_of(text) for text in texts]),
        (replace(usual, method=MOST_FREQUENT, variant=""), [frequent] * len(truths)),
        (replace(usual, method=SHUFFLED, variant=""), others(references, run.seed)),
        (replace(usual, method=EXACT_HEIGHTS, variant=""), observed_captions(batches, run.seed)),
    )
    results = []
    for result, captions in rows:
        values = rated(captions, truths, references, run.judge)
        if result is usual:
            values |= _question_values(run, talker)
        named = replace(result, values=values, judge=run.judge.title if run.judge else "")
        save(run.results, named)
        results.append(named)
    return results


def most_frequent_caption(data: ContactDataset) -> str:
    """The words that most contacts of a split have, behind them the medians of their numbers."""
    states = [data.state(index) for index in range(len(data))]
    captions = [caption(state) for state in states]
    ((most, _),) = Counter(captions).most_common(1)
    alike = [state for state, text in zip(states, captions, strict=True) if text == most]
    medians = {
        name: float(np.median([getattr(state, name) for state in alike])) for name in NUMBERS
    }
    return caption_text(replace(alike[0], cut=frozenset(), **medians))  # type: ignore[arg-type]  # numbers


def others(references: Sequence[str], seed: int) -> list[str]:
    """For each contact the caption of another one; with one contact, its own."""
    order = np.random.default_rng([seed, 91]).permutation(len(references))
    following = dict(zip(order.tolist(), np.roll(order, 1).tolist(), strict=True))
    return [references[following[index]] for index in range(len(references))]


def observed_captions(batches: Sequence[Batch], seed: int) -> list[str]:
    """What an observer with exact heights says of contacts under the errors of calibrated units."""
    rng, captions = np.random.default_rng([seed, 92]), []
    for batch in batches:
        for height_mm, state, sensor in zip(
            batch.height_mm, batch.states, batch.sensors, strict=True
        ):
            if state.in_contact:
                unit = NoiseUnit.draw(rng, spread=spread_of(sensor))
                state = observed_state(height_mm, state, sensor, unit, rng)
            captions.append(caption_text(state))
    return captions


def rated(
    captions: Sequence[str],
    truths: Sequence[ContactState],
    references: Sequence[str],
    judge: Judge | None,
) -> dict[str, float | None]:
    """Mean rating by the rule and by the judge; percent right of each word and of the numbers.

    Beside these: how many numbers a caption says, and percent of its intervals with the truth.
    """
    ratings = [rate_caption(text, truth) for text, truth in zip(captions, truths, strict=True)]
    values: dict[str, float | None] = {"rating": _mean([each.rating for each in ratings])}
    if judge is not None:
        pairs = [JudgedPair(*pair) for pair in zip(references, captions, strict=True)]
        values["judge"] = _mean(judge.rate(pairs))
    for name in CLASSES:
        values[name] = _percent(_words(ratings, truths, name))
    values["numbers"] = _percent([right for each in ratings for right in each.numbers.values()])
    values["numbers_said"] = _mean([len(each.numbers) for each in ratings])
    values["ranges"] = _percent([inside for each in ratings for inside in each.ranges.values()])
    values["malformed"] = _percent([each.is_malformed for each in ratings])
    return values


def variant_of(weights: Path, data: str) -> str:
    """What language model some weights have, and whether it learned from the data it is rated on.

    Args:
        weights: Folder of weights; its model card names the data of the training.
        data: Checksum of the data that captions are rated on.
    """
    model = "our small one"
    if is_stock(weights / "lm"):
        base = BaseLm.read(weights / "lm")
        model = f"{Path(base.path).name} ({base.model_type}), {base.tune}"
    try:
        match = _LEARNED_DATA.search((weights / CARD).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        match = None
    if match is None:
        return f"{model}, of unknown data"
    return model if match[1] == data else f"{model}, of data {match[1][:8]}"


def _words(
    ratings: Sequence[CaptionRating], truths: Sequence[ContactState], name: str
) -> list[bool]:
    """Whether each contact's word is right; of a malformed text, none is."""
    return [
        each.words.get(name, False)
        for each, truth in zip(ratings, truths, strict=True)
        if not truth.in_contact or getattr(truth, name) is not None
    ]


def _question_values(run: CaptionRun, talker: Talker) -> dict[str, float | None]:
    """Percent of questions answered rightly, in the grammar's wordings and in unseen ones."""
    if not run.questions:
        return {}
    contacts = felt_contacts(run.data, run.questions, run.seed + 1, talker.layout)
    scenes = [contact.scene for contact in contacts]
    sets = {
        "questions": own_questions(scenes, 2 * len(scenes), run.seed),
        "unseen_wordings": ask_all(read_questions(None), scenes, 1),
    }
    values: dict[str, float | None] = {}
    spoken = spoken_once(talker, contacts)
    for name, asked in sets.items():
        stage = name.replace("_", " ")
        model = asked_model(by_model(talker), spoken, len(asked), run.report, stage=stage)
        right = figures(answer_all(asked, model)).right
        values[name] = 100 * right if right is not None and np.isfinite(right) else None
    return values


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if values else None


def _percent(right: Sequence[bool]) -> float | None:
    return 100 * float(np.mean(right)) if right else None
