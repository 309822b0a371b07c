"""``tacgrasp eval``: what trained weights are worth on contacts that they have not seen.

All clouds are of the test split, with the noise of a calibrated unit, drawn from the seed. Whatever
can be computed directly from the same 1024 points (``cltp.tactile.measure``) stands beside it as
the
ceiling: it knows the sensor's geometry and learned nothing.

Not here: how pairs are chosen (``tacgrasp.lessons.instruction_pairs``), printing
(``tacgrasp.training.model_card``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from transformers.utils.logging import disable_progress_bar

from cltp.checkpoints.tac3d_llm import load_clip, load_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import NOISY, Batch, Sampler
from cltp.evaluation.evaluate import (
    Scores,
    answer_scores,
    batches,
    caption_scores,
    ceiling_scores,
    heads_scores,
    retrieval_scores,
    unscaled,
    zero_shot_scores,
)
from cltp.llm.generation import Reply, Talker
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import MEASURABLE
from cltp.train.stage import ProgressReport, silent
from policies import Policy, PolicyError
from policies.teacher import teacher
from tacgrasp.lessons.answer_scoring import answers_right, numbers_said
from tacgrasp.lessons.exchanges import BLIND
from tacgrasp.lessons.heldout_instructions import PARAPHRASES
from tacgrasp.lessons.instruction_pairs import (
    NONE,
    Case,
    answer_of,
    choose_pairs,
    choose_paraphrases,
    counts,
    share,
)
from tacgrasp.lessons.questions import HELD_OUT, QUESTIONS
from tacgrasp.policy_factory import load_llm


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes:
    """How much is asked.

    Attributes:
        captions: Contacts to describe.
        answers: Contacts to ask about; each slot once in every set of wordings.
        pairs: Instruction pairs.
        per_wording: Contacts for each paraphrase.
    """

    captions: int = 500
    answers: int = 150
    pairs: int = 200
    per_wording: int = 8


def evaluate(
    weights: Path,
    data_dir: Path,
    *,
    blind: Path | None = None,
    sizes: Sizes | None = None,
    seed: int = 0,
    report: ProgressReport = silent,
) -> dict[str, Any]:
    """Measure everything.

    Args:
        weights: Folder of weights.
        data_dir: Contacts; the test split is used.
        blind: Folder of an instruction-blind copy.
        sizes: How much is asked.
        seed: Of contacts, noise and wordings.
        report: Told about progress.

    Returns:
        ``captions``, ``numbers``, ``answers``, ``instruction_pairs``, ``paraphrases``,
        ``zero_shot``, ``clip_retrieval``, and what was measured; None where nothing could be.

    Raises:
        TouchError: Weights or data can't be used.
    """
    disable_progress_bar()  # of reading weights, over in milliseconds
    sizes = sizes or Sizes()
    data = ContactDataset(data_dir, split=Split.TEST)
    policy = load_llm(weights)
    blind_policy = load_llm(blind) if blind is not None else None
    encoder, heads = load_encoder(weights / "encoder")
    encoder.eval(), heads.eval()
    towers = load_clip(weights / "clip")
    samples = batches(data, sizes.captions, NOISY, seed=seed)
    deciders = _Deciders(data, policy, blind_policy, seed)
    described = {
        "llm": _captions(policy.talker, samples, report),
        "heads": heads_scores(encoder, heads, samples),
        "ceiling": ceiling_scores(data, samples),
    }
    zero_shot = zero_shot_scores(encoder, towers, samples)
    asked = batches(data, sizes.answers, NOISY, seed=seed + 1)
    return {
        "weights": str(weights),
        "blind": str(blind) if blind is not None else None,
        "data": str(data_dir),
        "data_checksum": ContactDataset(data_dir).checksum(),
        "seed": seed,
        "captions": {"contacts": described["llm"].count}
        | {who: _slots(scores, who) for who, scores in described.items()},
        "numbers": {who: _errors(scores) for who, scores in described.items()},
        "answers": {
            "contacts": sum(len(batch.states) for batch in asked),
            "held_out": _answers(policy.talker, asked, HELD_OUT, "held-out questions", report),
            "trained": _answers(policy.talker, asked, QUESTIONS, "trained questions", report),
        },
        "instruction_pairs": {
            kind: _pairs(deciders, data, sizes.pairs, kind, seed, report)
            for kind in ("clear", "any")
        },
        "paraphrases": {
            kind: _paraphrases(deciders, data, sizes.per_wording, kind, seed, report)
            for kind in ("clear", "any")
        },
        "zero_shot": _plain(zero_shot.right),
        "clip_retrieval": _plain(_fields(retrieval_scores(towers, data, samples))),
    }


class _Counted:
    """Reports every reply of a talker."""

    def __init__(self, talker: Talker, stage: str, total: int, report: ProgressReport) -> None:
        self._talker, self._stage, self._total, self._report = talker, stage, total, report
        self._done = 0

    def reply(self, points: NDArray[np.float32], prompt: str) -> Reply:
        reply = self._talker.reply(points, prompt)
        self._done += 1
        self._report(self._stage, self._done, self._total, {})
        return reply


def _captions(talker: Talker, samples: Sequence[Batch], report: ProgressReport) -> Scores:
    total = sum(len(batch.states) for batch in samples)
    counted = _Counted(talker, "captions", total, report)
    return caption_scores(counted, samples, read_numbers=numbers_said)


def _answers(
    talker: Talker,
    samples: Sequence[Batch],
    wordings: Mapping[str, Sequence[str]],
    stage: str,
    report: ProgressReport,
) -> dict[str, float | None]:
    total = sum(len(batch.states) for batch in samples) * len(wordings)
    counted = _Counted(talker, stage, total, report)
    found = dict(answer_scores(counted, samples, wordings, answers_right))
    return _plain(found | {"mean": float(np.mean(list(found.values())))})


class _Deciders:
    """Who answers a case: the model, its blind copy, and the teacher on the measured state."""

    def __init__(self, data: ContactDataset, llm: Policy, blind: Policy | None, seed: int) -> None:
        self._data = data
        self._sampler = Sampler(data, NOISY, seed=seed)
        self.answers: dict[str, Callable[[TactileCloud, Case], str | None]] = {
            "llm": lambda cloud, case: _decided(llm, cloud, case.instruction.text),
            "rules": lambda cloud, case: answer_of(
                teacher(contact_state(cloud), case.instruction.goal)
            ),
        }
        if blind is not None:
            self.answers["blind"] = lambda cloud, case: _decided(blind, cloud, BLIND)

    def cloud(self, index: int) -> TactileCloud:
        """The contact with the noise of its own draw, the same under every instruction."""
        batch = self._sampler.batch(np.array([index]), index)
        return unscaled(batch.points[0], sensor_named(self._data.column("sensor")[index]))

    def right(
        self, cases: Sequence[Case], stage: str, report: ProgressReport
    ) -> dict[str, NDArray[np.bool_]]:
        """By decider, whether each case is answered rightly."""
        right: dict[str, list[bool]] = {name: [] for name in self.answers}
        for number, case in enumerate(cases, start=1):
            cloud = self.cloud(case.index)
            for name, answer in self.answers.items():
                right[name].append(answer(cloud, case) == case.answer)
            report(stage, number, len(cases), {})
        return {name: np.array(judged, dtype=bool) for name, judged in right.items()}


def _decided(policy: Policy, cloud: TactileCloud, instruction: str) -> str | None:
    """A primitive's name, ``NONE`` for success, None where the policy holds or refuses."""
    policy.start()  # each case is an episode of its own: nothing is barred for the one before
    try:
        decision = policy.decide(cloud, instruction)
    except PolicyError:
        return None
    if decision.action is not None:
        return decision.action.value
    return NONE if decision.success else None


def _pairs(
    deciders: _Deciders,
    data: ContactDataset,
    num: int,
    kind: str,
    seed: int,
    report: ProgressReport,
) -> dict[str, Any]:
    pairs = choose_pairs(data, num, clear=kind == "clear", seed=seed)
    cases = [case for pair in pairs for case in pair]
    right = deciders.right(cases, f"{kind} instruction pairs", report)
    both = {name: judged[::2] & judged[1::2] for name, judged in right.items()}
    return {
        "pairs": len(pairs),
        "answers": counts(cases),
        "right": _plain({name: share(judged) for name, judged in right.items()}),
        "both_right": _plain({name: share(judged) for name, judged in both.items()}),
        "right_by_answer": {name: _by(judged, cases) for name, judged in right.items()},
    }


def _paraphrases(
    deciders: _Deciders,
    data: ContactDataset,
    per_wording: int,
    kind: str,
    seed: int,
    report: ProgressReport,
) -> dict[str, Any]:
    chosen = choose_paraphrases(data, per_wording, clear=kind == "clear", seed=seed)
    cases = [case for case, _ in chosen]
    naming = np.array([names for _, names in chosen], dtype=bool)
    right = deciders.right(cases, f"{kind} paraphrases", report)
    texts = [text for wordings in PARAPHRASES.values() for text in wordings]
    said = np.array([case.instruction.text for case in cases])
    return {
        "wordings": len(set(said.tolist())),
        "cases": len(cases),
        "answers": counts(cases),
        "right": _plain({name: share(judged) for name, judged in right.items()}),
        "naming_an_object": _plain({n: share(judged[naming]) for n, judged in right.items()}),
        "naming_no_object": _plain({n: share(judged[~naming]) for n, judged in right.items()}),
        "right_by_wording": _plain({text: share(right["llm"][said == text]) for text in texts}),
    }


def _by(right: NDArray[np.bool_], cases: Sequence[Case]) -> dict[str, float | None]:
    return _plain(
        {
            answer: share(right[np.array([case.answer == answer for case in cases])])
            for answer in counts(cases)
        }
    )


def _slots(scores: Scores, who: str) -> dict[str, float | None]:
    measured = MEASURABLE if who == "ceiling" else tuple(scores.right)
    return _plain({s: value if s in measured else np.nan for s, value in scores.right.items()})


def _errors(scores: Scores) -> dict[str, float | None]:
    """Median errors: mm, mm, % of the field, % of the true force."""
    errors = scores.errors
    return _plain(
        {
            "depth_mm": errors["depth_mm"],
            "position_mm": errors["position_mm"],
            "area_percent": 100 * errors["area_fraction"],
            "force_percent": 100 * errors["force_share"],
        }
    )


def _fields(found: Any) -> dict[str, float]:
    return {name: float(getattr(found, name)) for name in found.__slots__}


def _plain(values: Mapping[str, float]) -> dict[str, float | None]:
    """None where there is no finite number, so that the figures are JSON."""
    return {name: float(v) if np.isfinite(v) else None for name, v in values.items()}
