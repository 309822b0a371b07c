"""``tacgrasp eval``: accuracy of trained weights on contacts that they have not seen.

All clouds are of the test split, with the noise of a calibrated unit, drawn from the seed. Advice
is compared with the teacher's on the truth, under contracts: of drawn force bands, and of
instructions that the contract reader has read. The geometric baseline
(``cltp.evaluation.geometric_baseline``) is computed from the same points.

Not here: how cases are chosen (``tacgrasp.lessons.instruction_pairs``), more of questions
(``tacgrasp.training.question_evaluation``), printing (``tacgrasp.training.model_card``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from torch import Tensor
from transformers.utils.logging import disable_progress_bar

from cltp.checkpoints.frozen import frozen
from cltp.checkpoints.tac3d_llm import load_clip, load_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import NOISY, Sampler
from cltp.evaluation.features import encode_batches, random_batches
from cltp.evaluation.geometric_baseline import predict_geometrically
from cltp.evaluation.llm_scores import predict_by_captions
from cltp.evaluation.probes import predict_with_heads
from cltp.evaluation.retrieval import score_image_retrieval
from cltp.evaluation.scores import Predictions, best_classes, median_errors, score_classes
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.llm.generation import Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.measure import contact_state
from cltp.tactile.states import MEASURABLE
from cltp.train.stage import ProgressReport, silent
from policies import Observation, PolicyError
from policies.contract_steps import target_of
from policies.llm.policy import LlmPolicy
from policies.llm.spoken import CaptionSpeaker
from policies.teacher import LESSON_MOVE_STEP_MM, teacher
from primitives.contract import Contract
from tacgrasp.lessons.captions import read_numbers
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scoring.question_file import UNDECIDABLE, read_questions
from tacgrasp.lessons.exchanges import BLIND
from tacgrasp.lessons.instruction_pairs import (
    NONE,
    Case,
    answer_of,
    choose_goals,
    choose_pairs,
    choose_wordings,
    counts,
    fraction,
)
from tacgrasp.lessons.question_scores import answer_all, ask_all, figures
from tacgrasp.policy_factory import load_llm
from tacgrasp.training.question_evaluation import (
    asked_model,
    by_model,
    felt_contacts,
    own_questions,
    spoken_once,
)
from tacgrasp.training.requests import EvaluationRequest

KINDS = ("clear", "any")
"""Contacts whose answer noise does not decide, and any."""


def evaluate(
    weights: Path, request: EvaluationRequest, report: ProgressReport = silent
) -> dict[str, Any]:
    """Measure everything.

    Args:
        weights: Folder of weights.
        request: Contacts, of which the test split is used, and what is measured on how many.
        report: Receives the progress.

    Returns:
        ``captions``, ``numbers``, ``answers``, ``advice``, ``instruction_pairs``,
        ``paraphrases``, ``zero_shot``, ``clip_retrieval``, and the weights and data; None for a
        figure that can't be measured.

    Raises:
        TouchError: Weights or data can't be used.
    """
    disable_progress_bar()  # of reading weights, over in milliseconds
    blind, seed = request.blind, request.seed
    data = ContactDataset(request.data, split=Split.TEST)
    policy = load_llm(weights)
    encoder, heads = load_encoder(weights / "encoder")
    towers = load_clip(weights / "clip")
    cases = _CaseEvaluation(
        data, policy, load_llm(blind) if blind is not None else None, seed, report
    )
    layout = encoder.config.variant.layout
    described = random_batches(data, request.captions, NOISY, seed=seed, layout=layout)
    encoded = encode_batches(frozen(encoder), described)
    predictions = {
        "llm": predict_by_captions(
            _ReportedSpeaker(policy.talker, len(encoded), report),
            described,
            read_numbers,
        ),
        "heads": predict_with_heads(heads.eval(), encoded, described),
        "geometric_baseline": predict_geometrically(described),
    }
    states = [state for batch in described for state in batch.states]
    prompted = best_classes(ClassPrompts(towers).cosines(encoded.feature))
    return {
        "weights": str(weights),
        "blind": str(blind) if blind is not None else None,
        "data": str(request.data),
        "data_checksum": ContactDataset(request.data).checksum(),
        "seed": seed,
        "captions": {"contacts": len(encoded)}
        | {name: _accuracy(one, encoded.classes, name) for name, one in predictions.items()},
        "numbers": {
            name: _plain(median_errors(one.numbers, states)) for name, one in predictions.items()
        },
        "answers": _answers(policy.talker, request, report),
        "advice": {kind: cases.goals(request.goals, kind) for kind in KINDS},
        "instruction_pairs": {kind: cases.pairs(request.pairs, kind) for kind in KINDS},
        "paraphrases": {kind: cases.wordings(request.per_wording, kind) for kind in KINDS},
        "zero_shot": _plain(score_classes(prompted, encoded.classes).accuracy),
        "clip_retrieval": _plain(score_image_retrieval(towers, described)),
    }


class _ReportedSpeaker(CaptionSpeaker):
    """Captions, with the progress."""

    def __init__(self, talker: Talker, total: int, report: ProgressReport) -> None:
        super().__init__(talker)
        self._total, self._report, self._done = total, report, 0

    def caption(self, points: NDArray[np.float32]) -> str:
        text = super().caption(points)
        self._done += 1
        self._report("captions", self._done, self._total, {})
        return text


def _answers(talker: Talker, request: EvaluationRequest, report: ProgressReport) -> dict[str, Any]:
    """Fractions of right answers, where decidable, by the kind of the answer.

    ``held_out`` are questions that were kept out of the grammar, ``trained`` the grammar's own.
    """
    contacts = felt_contacts(request.data, request.answers, request.seed + 1, talker.layout)
    scenes = [contact.scene for contact in contacts]
    sets = {
        "held_out": ask_all(read_questions(None), scenes, 1),
        "trained": own_questions(scenes, 2 * len(scenes), request.seed),
    }
    right: dict[str, Any] = {"contacts": len(contacts)}
    spoken = spoken_once(talker, contacts)
    for name, asked in sets.items():
        stage = f"{name.replace('_', '-')} questions"
        model = asked_model(by_model(talker), spoken, len(asked), report, stage=stage)
        answers = answer_all(asked, model)
        by_kind = {kind: [a for a in answers if a.asked.row.kind is kind] for kind in AnswerKind}
        right[name] = {
            kind.value: (figures(some).undecidable if kind in UNDECIDABLE else figures(some).right)
            for kind, some in by_kind.items()
        } | {"mean": figures(answers).right}
    return right


class _CaseEvaluation:
    """Cases answered by the model, by its blind copy, and by the teacher on the measured state."""

    def __init__(
        self,
        data: ContactDataset,
        llm: LlmPolicy,
        blind: LlmPolicy | None,
        seed: int,
        report: ProgressReport,
    ) -> None:
        self._data, self._seed, self._report = data, seed, report
        self._sampler = Sampler(data, NOISY, seed=seed, layout=llm.talker.layout)
        self._deciders: dict[str, Callable[[TactileCloud, Case], str | None]] = {
            "llm": lambda cloud, case: _decided(llm, cloud, case.contract),
            "rules": lambda cloud, case: answer_of(
                teacher(
                    contact_state(cloud), target_of(case.contract), move_step_mm=LESSON_MOVE_STEP_MM
                )
            ),
        }
        if blind is not None:
            self._deciders["blind"] = lambda cloud, _: _named(blind.talker, cloud, BLIND)

    def goals(self, num: int, kind: str) -> dict[str, Any]:
        """Figures of ``num`` drawn force bands on contacts of a kind out of ``KINDS``."""
        cases = choose_goals(self._data, num, clear=kind == "clear", seed=self._seed)
        right = self._right(cases, f"{kind} goals")
        return {
            "cases": len(cases),
            "answers": counts(cases),
            "right": _fractions(right),
            "right_by_answer": _by_answer(cases, right),
        }

    def pairs(self, num: int, kind: str) -> dict[str, Any]:
        """Figures of ``num`` instruction pairs on contacts of a kind out of ``KINDS``."""
        pairs = choose_pairs(self._data, num, clear=kind == "clear", seed=self._seed)
        cases = [case for pair in pairs for case in pair]
        right = self._right(cases, f"{kind} instruction pairs")
        return {
            "pairs": len(pairs),
            "answers": counts(cases),
            "right": _fractions(right),
            "both_right": _fractions(
                {name: mask[::2] & mask[1::2] for name, mask in right.items()}
            ),
            "right_by_answer": _by_answer(cases, right),
        }

    def wordings(self, per_wording: int, kind: str) -> dict[str, Any]:
        """Figures of kept-out instructions on contacts of a kind out of ``KINDS``."""
        cases = choose_wordings(self._data, per_wording, clear=kind == "clear", seed=self._seed)
        right = self._right(cases, f"{kind} kept-out instructions")
        expects = np.array([case.expect for case in cases])
        return {
            "wordings": len({case.contract.text for case in cases}),
            "cases": len(cases),
            "answers": counts(cases),
            "right": _fractions(right),
            "right_by_expect": {
                name: _fractions({str(e): mask[expects == e] for e in np.unique(expects)})
                for name, mask in right.items()
            },
        }

    def _right(self, cases: Sequence[Case], stage: str) -> dict[str, NDArray[np.bool_]]:
        """By decider, whether each case is answered correctly."""
        right: dict[str, list[bool]] = {name: [] for name in self._deciders}
        for number, case in enumerate(cases, start=1):
            # noise of the contact's own, the same under every instruction
            batch = self._sampler.batch(np.array([case.index]), case.index)
            cloud = batch.cloud(0)
            for name, answer in self._deciders.items():
                right[name].append(answer(cloud, case) == case.answer)
            self._report(stage, number, len(cases), {})
        return {name: np.array(values, dtype=bool) for name, values in right.items()}


def _decided(policy: LlmPolicy, cloud: TactileCloud, contract: Contract) -> str | None:
    """A primitive's name, ``NONE`` for success, None where the policy holds or refuses."""
    policy.start()  # each case is an episode of its own: no action is barred for the one before
    try:
        decision = policy.decide(Observation(cloud=cloud), contract)
    except PolicyError:
        return None
    if decision.action is not None:
        return decision.action.value
    return NONE if decision.success else None


def _named(talker: Talker, cloud: TactileCloud, prompt: str) -> str | None:
    """The action that a reply names; ``NONE`` for none, None without either."""
    points = encoder_input(cloud, talker.layout)
    action = talker.reply(points, prompt, scale=cloud.force_scale).action
    return None if action is None else action.strip("<>")


def _by_answer(
    cases: Sequence[Case], right: Mapping[str, NDArray[np.bool_]]
) -> dict[str, dict[str, float | None]]:
    """By decider, the fractions of right cases by their answer."""
    answers = np.array([case.answer for case in cases])
    return {
        name: _fractions({answer: mask[answers == answer] for answer in counts(cases)})
        for name, mask in right.items()
    }


def _accuracy(predictions: Predictions, labels: Tensor, name: str) -> dict[str, float | None]:
    scores = score_classes(predictions.classes, labels)
    return _plain(
        (scores.restricted(MEASURABLE) if name == "geometric_baseline" else scores).accuracy
    )


def _fractions(right: Mapping[str, NDArray[np.bool_]]) -> dict[str, float | None]:
    return _plain({name: fraction(mask) for name, mask in right.items()})


def _plain(values: Mapping[str, float]) -> dict[str, float | None]:
    """None where there is no finite number, so that the figures are JSON."""
    return {name: float(v) if np.isfinite(v) else None for name, v in values.items()}
