"""Every condition of ``tacgrasp eval ablate``, single replies and episodes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cltp.llm.generation import Reply
from cltp.train.stage import ProgressReport, silent
from policies.llm.policy import LlmPolicy
from tacgrasp.lessons.exchanges import BLIND
from tacgrasp.policy_factory import load_llm
from tacgrasp.training.ablation import episodes
from tacgrasp.training.ablation.ablated_talker import (
    ABLATIONS,
    WHOLE,
    AblatedTalker,
    Donor,
)
from tacgrasp.training.ablation.single_replies import (
    AskedStep,
    Replier,
    draw_steps,
    score_misreadings,
    score_replies,
)
from tacgrasp.training.ablation.touch_parts import touch_parts
from tacgrasp.training.question_evaluation import felt_contacts

BLIND_COPY = "blind copy"
"""Name of the condition in which a blind copy is asked."""


def ablate(
    weights: Path,
    *,
    data: Path | None,
    blind: Path | None = None,
    num_contacts: int = 100,
    num_episodes: int = 4,
    seed: int = 0,
    report: ProgressReport = silent,
) -> dict[str, Any]:
    """Measure every condition.

    Args:
        weights: Folder of weights.
        data: Folder of contacts, of which the test split is used; None makes some.
        blind: Folder of an instruction-blind copy; None leaves it out.
        num_contacts: Number of contacts, two at least.
        num_episodes: Number of episodes of each condition; 0 for none.
        seed: Random seed of contacts, noise, goals and swaps.
        report: Receives the progress.

    Returns:
        ``replies`` and ``episodes`` by condition, ``misreadings``, for JSON.

    Raises:
        TouchError: Weights or data can't be used.
    """
    policy = load_llm(weights)
    talker = policy.talker
    steps = draw_steps(felt_contacts(data, num_contacts, seed, talker.layout), seed)
    donors = [
        Donor(
            points=step.points,
            parts=touch_parts(talker.model, talker.feel(step.points)),
            prompt=step.prompt,
        )
        for step in steps
    ]
    conditions = {
        name: AblatedTalker(talker, ABLATIONS.get(name), donors, seed=seed)
        for name in (WHOLE, *ABLATIONS)
    }
    replies = {
        name: score_replies(steps, _replies(each, steps, name, report))
        for name, each in conditions.items()
    }
    if blind is not None:
        said = _replies(load_llm(blind).talker, steps, BLIND_COPY, report, prompt=BLIND)
        replies[BLIND_COPY] = score_replies(steps, said)
    return {
        "weights": str(weights),
        "blind": str(blind) if blind is not None else None,
        "data": str(data) if data is not None else None,
        "contacts": len(steps),
        "seed": seed,
        "replies": replies,
        "misreadings": score_misreadings(talker, steps),
        "episodes": {
            name: _episodes(policy, each, num_episodes, name, report)
            for name, each in conditions.items()
            if num_episodes
        },
    }


def _replies(
    replier: Replier,
    steps: Sequence[AskedStep],
    stage: str,
    report: ProgressReport,
    prompt: str | None = None,
) -> list[Reply]:
    """Replies to the steps, or to one prompt in each."""
    replies = []
    for number, step in enumerate(steps, start=1):
        touch = replier.feel(step.points).touch
        if prompt is None:
            replies.append(replier.reply_to(touch, step.prompt, grammar=step.grammar))
        else:  # the grammar would tell a blind copy the goal
            replies.append(replier.reply_to(touch, prompt))
        report(stage, number, len(steps), {})
    return replies


def _episodes(
    policy: LlmPolicy, talker: AblatedTalker, num: int, name: str, report: ProgressReport
) -> dict[str, Any]:
    results = []
    for number in range(num):
        results.append(episodes.run_episode(policy, talker, episodes.FIRST_SEED + number))
        report(f"episodes, {name}", number + 1, num, {})
    return episodes.figures(results)
