"""``tacgrasp eval questions``: the language model's answers to a file of questions.

Contacts are of a data set's test split, or a few that are made for the purpose; all with the noise
of a calibrated unit. Each has a contract and a mass, or not, drawn from the seed.

Not here: what is right (``tacgrasp.lessons.dialogue.scoring.answer_scores``), trivial answers
(``tacgrasp.lessons.question_scores``).
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.data.sampler import NOISY, Sampler
from cltp.llm.generation import Talker
from cltp.tactile.point_layout import EVEN, PointLayout
from cltp.tactile.sensors import sensor_named
from cltp.train.stage import ProgressReport, silent
from policies.llm.spoken import SpokenContact, spoken_contact
from sim.full.series import press_on_gel
from sim.gel.layer import gel_of
from sim.grasp.rig import BENCHMARK_SEED
from tacgrasp.base.errors import UsageError
from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.scene import AskedScene
from tacgrasp.lessons.dialogue.scoring.question_file import QuestionRow
from tacgrasp.lessons.question_draws import draw_scene, drawn_rows
from tacgrasp.lessons.question_scores import (
    AskedQuestion,
    ScoredAnswer,
    answer_all,
    ask_all,
    baselines,
    confidence_figures,
    figures,
    figures_by_family,
    perfect_answer,
)
from tacgrasp.lessons.read_question import ReadQuestion
from tacgrasp.lessons.turns.dialogue import Dialogue, Said, TurnReader
from tacgrasp.lessons.turns.turn import next_turn
from tacgrasp.lessons.understanding import understood_by_model

MADE_SEED = BENCHMARK_SEED + 7
"""Seed of the contacts that are made where none are given; no data set can have it."""

ALONE = "model alone"
"""Name in tables of the model that reads the wordings of the grammar too."""

AS_FELT = "truth as felt"
"""Name in tables of what understands every question and feels as the model does."""

APART = "each question apart"
"""Name in tables of the model that does not hear what was asked before."""

TRUE_TOUCH = "true touch"
"""Name in tables of the model that is told the contact as it is."""

GRAMMAR_QUESTIONS = 500
"""Number of the grammar's own questions that its answers are scored on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FeltContact:
    """A contact as the model gets it, and as it is.

    Attributes:
        points: Shape (N, 3), scaled.
        scene: The truth, with contract and mass.
    """

    points: NDArray[np.float32]
    scene: AskedScene


def felt_contacts(
    folder: Path | None, num: int, seed: int, layout: PointLayout = EVEN
) -> list[FeltContact]:
    """Contacts of a data set's test split, or made ones.

    Args:
        folder: The data set; None presses objects of the set ``full``.
        num: How many.
        seed: Random seed of choice, noise, contracts and masses.
        layout: Layout of the points that the model takes.

    Raises:
        TouchError: The data set can't be used.
    """
    with tempfile.TemporaryDirectory() as work:
        data = ContactDataset(folder, split=Split.TEST) if folder else _made(Path(work), num)
        rng = np.random.default_rng([seed, 41])
        chosen = rng.permutation(len(data))[:num]
        batch = Sampler(data, NOISY, seed=seed, layout=layout).batch(np.sort(chosen), 0)
    return [
        FeltContact(points=points, scene=draw_scene(state, rng))
        for points, state in zip(batch.points, batch.states, strict=True)
    ]


def _made(work: Path, num: int) -> ContactDataset:
    sensor = sensor_named("gelsight_mini")
    with DatasetWriter(work / "made") as writer:
        for contact in press_on_gel(gel_of(sensor.name), sensor, seed=MADE_SEED, num=num):
            writer.add(contact)
    return ContactDataset(work / "made")


def evaluate_questions(
    rows: Sequence[QuestionRow],
    contacts: Sequence[FeltContact],
    talker: Talker | None,
    *,
    per_question: int,
    seed: int = 0,
    report: ProgressReport = silent,
) -> tuple[dict[str, Any], list[ScoredAnswer]]:
    """Ask every question and score the answers of the model and of what needs no model.

    Args:
        rows: The questions.
        contacts: The contacts.
        talker: The model; None scores the others alone.
        per_question: Number of contacts for each question.
        seed: Random seed of the grammar's own questions.
        report: Receives the progress.

    Returns:
        Figures for JSON, and the model's answers.

    Raises:
        UsageError: A truth can't be evaluated in a scene.
    """
    scenes = [contact.scene for contact in contacts]
    asked = ask_all(rows, scenes, per_question)
    try:
        contestants = baselines(asked)
        scored = {name: answer_all(asked, one) for name, one in contestants.items()}
        own = own_questions(scenes, GRAMMAR_QUESTIONS, seed)
        scored["grammar"] = answer_all(own, contestants["grammar"])
        answers: list[ScoredAnswer] = []
        trust: dict[str, Any] = {}
        if talker is not None:
            confidences: list[float] = []
            spoken = spoken_once(talker, contacts)
            read = cache(partial(next_turn, talker))
            model = in_dialogue(read, spoken, len(asked), report, confidences=confidences)
            answers = answer_all(asked, model)
            mine: dict[str, list[ScoredAnswer]] = {"model": answers}
            if any(row.before for row in rows):
                apart = [replace(one, row=replace(one.row, before=())) for one in asked]
                model = in_dialogue(read, spoken, len(asked), silent)
                mine[APART] = answer_all(apart, model)
            model = asked_model(by_model(talker), spoken, len(asked), silent)
            mine[ALONE] = answer_all(asked, model)
            mine[TRUE_TOUCH] = answer_all(asked, with_true_touch(read))
            mine[AS_FELT] = answer_all(asked, truth_as_felt(spoken))
            scored = {**mine, **scored}
            trust = {"confidence": confidence_figures(answers, confidences)}
    except ValueError as error:
        raise UsageError(f"the file of questions: {error}") from None
    return trust | {
        "questions": len(rows),
        "contacts": len(contacts),
        "per_question": min(per_question, len(contacts)),
        "figures": {name: asdict(figures(each)) for name, each in scored.items()},
        "families": {name: asdict(each) for name, each in figures_by_family(answers).items()},
    }, answers


Spoken = Callable[[int], SpokenContact]
"""What the model feels and says of a contact, by its number."""


def spoken_once(talker: Talker, contacts: Sequence[FeltContact]) -> Spoken:
    """What feels each contact once, however often it is asked about."""

    @cache
    def spoken(contact: int) -> SpokenContact:
        return spoken_contact(talker, talker.feel(contacts[contact].points))

    return spoken


def truth_as_felt(spoken: Spoken) -> Callable[[AskedQuestion], str]:
    """What would answer every question as it is meant, from what the model feels and says.

    It is an upper bound for a model that feels so: what it misses, touch misses.
    """

    def reply(asked: AskedQuestion) -> str:
        scene = replace(asked.scene, state=spoken(asked.contact).state)
        return perfect_answer(replace(asked, scene=scene))

    return reply


def with_true_touch(read: TurnReader) -> Callable[[AskedQuestion], str]:
    """What answers questions, as it understands them, about the contact as it is.

    It is an upper bound for a touch that is read so: what it misses, language misses.

    Args:
        read: What reads a question behind others.
    """

    def reply(asked: AskedQuestion) -> str:
        return _said(Dialogue(read, asked.scene), asked.row).answer.text

    return reply


def in_dialogue(
    read: TurnReader,
    spoken: Spoken,
    total: int,
    report: ProgressReport,
    *,
    confidences: list[float] | None = None,
) -> Callable[[AskedQuestion], str]:
    """What answers as ``tacgrasp ask`` does: behind the questions before, from what it feels.

    Args:
        read: What reads a question behind others.
        spoken: What the model feels and says of a contact.
        total: Number of questions to come, for the progress.
        report: Receives the progress.
        confidences: Receives the confidence of each answer.
    """
    done = 0

    def reply(asked: AskedQuestion) -> str:
        nonlocal done
        felt = spoken(asked.contact)
        scene = replace(asked.scene, state=felt.state)
        said = _said(Dialogue(read, scene, felt.confidence, felt.ends), asked.row)
        done += 1
        if confidences is not None:
            confidences.append(said.confidence)
        report("questions", done, total, {})
        return said.answer.text

    return reply


def _said(dialogue: Dialogue, row: QuestionRow) -> Said:
    """The answer to a question behind those before it."""
    for question in row.before:
        dialogue.ask(question)
    return dialogue.ask(row.question)


def own_questions(scenes: Sequence[AskedScene], num: int, seed: int) -> list[AskedQuestion]:
    """Questions of the grammar, each about one scene that it was drawn for."""
    rows = drawn_rows(scenes, num, seed)
    numbers = {id(scene): number for number, scene in enumerate(scenes)}
    return [AskedQuestion(row=row, contact=numbers[id(scene)], scene=scene) for row, scene in rows]


Understanding = Callable[[str, str], ReadQuestion | None]
"""What a question means, by it and the question before it, or ''."""


def by_model(talker: Talker) -> Understanding:
    """What the model takes each question for, without the grammar; it reads each once."""

    @cache
    def meant(question: str, before: str) -> ReadQuestion | None:
        return understood_by_model(talker, question, before)

    return meant


def asked_model(
    meant: Understanding,
    spoken: Spoken,
    total: int,
    report: ProgressReport,
    *,
    stage: str = "questions",
) -> Callable[[AskedQuestion], str]:
    """What answers questions from what a model feels, each behind the one before it at most.

    Args:
        meant: What a question means.
        spoken: What the model feels and says of a contact.
        total: Number of questions to come, for the progress.
        report: Receives the progress.
        stage: Name of the stage, for the progress.
    """
    done = 0

    def reply(asked: AskedQuestion) -> str:
        nonlocal done
        felt, row = spoken(asked.contact), asked.row
        scene = replace(asked.scene, state=felt.state)
        given = answered(meant(row.question, row.last), scene, felt.confidence, felt.ends)
        done += 1
        report(stage, done, total, {})
        return given.answer.text

    return reply
