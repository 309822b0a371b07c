"""``tacgrasp eval``: accuracy of trained weights on contacts that they did not learn from.

Not here: pre-trained encoders by themselves (``tacgrasp.cli.eval_methods``).
"""

from __future__ import annotations

from collections.abc import Sequence

from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import contacts_in, parse, subcommand, writable
from tacgrasp.training.requests import EvaluationRequest


def main(argv: Sequence[str]) -> int:
    """Measure and print; write the figures and the model card where asked for."""
    if argv and not argv[0].startswith("-"):
        from tacgrasp.cli.eval_methods import COMMANDS

        summaries = {name: command.__doc__ or "" for name, command in COMMANDS.items()}
        name, rest = subcommand("eval", argv, summaries)
        if name is not None:
            COMMANDS[name](rest)
        return 0
    request = parse(EvaluationRequest, argv, prog="tacgrasp eval")
    json_path = writable(request.json)
    contacts_in(request.data, command="tacgrasp data generate --set full")
    from cltp.train.progress import Bar
    from tacgrasp.console import make_table_console
    from tacgrasp.policy_factory import default_weights
    from tacgrasp.training.evaluate import evaluate
    from tacgrasp.training.model_card import show, write_scores

    weights = request.weights or default_weights()
    with Bar(line_s=10.0) as report:
        scores = evaluate(weights, request, report)
    show(scores, make_table_console())
    if json_path is not None:
        write_result(json_path, scores)
    if request.card:
        write_scores(weights, scores)
    return 0
