"""``tacgrasp eval``: accuracy of trained weights on contacts that they did not learn from.

Not here: pre-trained encoders by themselves (``tacgrasp.cli.eval_methods``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand, writable


@dataclass(frozen=True)
class EvalFlags:
    """Measure captions, numbers, answers, instructions and alignment on the test split.

    Pre-trained encoders: tacgrasp eval zero-shot, probe, retrieval, report.

    Attributes:
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        data: Folder of contacts, as tacgrasp train made it.
        json: JSON file for the figures.
        blind: Folder of an instruction-blind copy (tacgrasp train llm --blind-of).
        captions: Number of contacts to describe.
        answers: Number of contacts to ask about.
        pairs: Number of instruction pairs.
        per_wording: Number of contacts for each paraphrase.
        seed: Random seed of the choice of contacts, of the sensor noise and of the wordings.
        card: Write the scores into the model card too.
    """

    weights: Path | None = None
    data: Path = Path("runs/data")
    json: Path | None = None
    blind: Path | None = None
    captions: int = 500
    answers: int = 150
    pairs: int = 200
    per_wording: int = 8
    seed: int = 0
    card: bool = False


def main(argv: Sequence[str]) -> int:
    """Measure and print; write the figures and the model card where asked for."""
    if argv and not argv[0].startswith("-"):
        from tacgrasp.cli.eval_methods import COMMANDS

        summaries = {name: command.__doc__ or "" for name, command in COMMANDS.items()}
        name, rest = subcommand("eval", argv, summaries)
        if name is not None:
            COMMANDS[name](rest)
        return 0
    flags = parse(EvalFlags, argv, prog="tacgrasp eval")
    if min(flags.captions, flags.answers, flags.pairs, flags.per_wording) < 1 or flags.seed < 0:
        raise UsageError("every number of eval must be at least 1, --seed at least 0")
    json_path = writable(flags.json)
    import json

    from rich.console import Console

    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import default_weights
    from tacgrasp.training.evaluate import Sizes, evaluate
    from tacgrasp.training.model_card import show, write_scores

    weights = flags.weights or default_weights()
    sizes = Sizes(
        captions=flags.captions,
        answers=flags.answers,
        pairs=flags.pairs,
        per_wording=flags.per_wording,
    )
    with Bar(line_s=10.0) as report:
        scores = evaluate(
            weights, flags.data, blind=flags.blind, sizes=sizes, seed=flags.seed, report=report
        )
    console = Console()
    show(scores, console if console.is_terminal else Console(width=160))
    if json_path is not None:
        json_path.write_text(json.dumps(scores, indent=1) + "\n", encoding="utf-8")
    if flags.card:
        write_scores(weights, scores)
    return 0
