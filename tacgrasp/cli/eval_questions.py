"""``tacgrasp eval questions``: how many questions about touch are answered rightly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_result
from tacgrasp.cli.flags import contacts_in, parse, writable

if TYPE_CHECKING:
    from tacgrasp.lessons.question_scores import ScoredAnswer

COLUMNS = {
    "right": "right, where decidable",
    "right_kind": "right kind of answer",
    "undecidable": "undecidable answered as such",
}


@dataclass(frozen=True)
class QuestionFlags:
    """Ask the language model a file of questions about contacts and compare with the truth.

    Attributes:
        file: CSV file with the columns family, question, kind, truth and tolerance, and before of
            a dialogue (docs/questions.md); by default the questions that were kept out of the
            grammar.
        data: Folder of contacts, whose test split is used; a few are made when not given.
        contacts: Number of contacts.
        per_question: Number of contacts that each question is asked about.
        weights: Folder of weights; by default TACGRASP_WEIGHTS, else the shipped weights.
        model: Ask the model; --no-model prints the trivial answers and the upper bounds alone.
        seed: Random seed of contacts, noise, contracts and masses.
        json: JSON file for the figures and the answers.
        wrong: Print the model's wrong answers.
    """

    file: Path | None = None
    data: Path | None = None
    contacts: int = 60
    per_question: int = 4
    weights: Path | None = None
    model: bool = True
    seed: int = 0
    json: Path | None = None
    wrong: bool = False

    def __post_init__(self) -> None:
        if min(self.contacts, self.per_question) < 1:
            raise UsageError("--contacts and --per-question must be at least 1")


def main(argv: Sequence[str]) -> None:
    """Ask, compare, and print the figures of the model beside those of trivial answers."""
    flags = parse(QuestionFlags, argv, prog="tacgrasp eval questions")
    writable(flags.json)
    if flags.data is not None:
        contacts_in(flags.data, command="tacgrasp data generate --set full")
    from tacgrasp.lessons.dialogue.scoring.question_file import read_questions

    rows = read_questions(flags.file)
    from cltp.tactile.point_layout import EVEN
    from cltp.train.progress import Bar
    from tacgrasp.policy_factory import load_llm
    from tacgrasp.training.question_evaluation import evaluate_questions, felt_contacts

    talker = load_llm(flags.weights).talker if flags.model else None
    layout = EVEN if talker is None else talker.layout
    contacts = felt_contacts(flags.data, flags.contacts, flags.seed, layout)
    with Bar(line_s=10.0) as report:
        results, answers = evaluate_questions(
            rows,
            contacts,
            talker,
            per_question=flags.per_question,
            seed=flags.seed,
            report=report,
        )
    _show(results, answers, wrong=flags.wrong)
    if flags.json is not None:
        columns = {"weights": str(flags.weights or "default"), "seed": flags.seed}
        report_json = columns | results | {"answers": [_plain(each) for each in answers]}
        write_result(flags.json, report_json)


def _show(results: dict[str, Any], answers: Sequence[ScoredAnswer], *, wrong: bool) -> None:
    from rich.table import Table

    from tacgrasp.console import make_table_console
    from tacgrasp.training.question_evaluation import APART, AS_FELT

    console = make_table_console()
    if wrong:
        for each in answers:
            if not each.score.right:
                truths = "; ".join(truth.text for truth in each.asked.row.truths)
                wanted = truths or each.asked.row.kind
                lines = " | ".join((*each.asked.row.before, each.asked.row.question))
                console.print(f"{lines!r} ({wanted}): {each.text!r}")
    table = Table("%", *COLUMNS.values(), "questions")
    groups = {
        "by family": results["families"],
        f"{results['questions']} questions": results["figures"],
    }
    for title, group in groups.items():
        if not group:
            continue
        table.add_section()
        table.add_row(title)
        for name, figures in group.items():
            count = figures["decidable_n"] + figures["undecidable_n"]
            table.add_row(name, *(_percent(figures[column]) for column in COLUMNS), str(count))
    console.print(table)
    if trust := results.get("confidence"):
        console.print(
            f"confidence: {_percent(trust['calibration_error'])} % off the fraction right in the "
            f"mean of ten groups; right above wrong in {_percent(trust['auroc'])} % (AUROC)"
        )
    felt = (
        "true touch (the model's understanding of the true contact), truth as felt (every question "
        "understood, and the touch of the model), "
    )
    apart = "each question apart: none of those before it is heard; "
    console.print(
        f"{apart if APART in results['figures'] else ''}"
        "trivial: no, yes, unknowable, most frequent; upper bounds: "
        f"{felt if AS_FELT in results['figures'] else ''}truth in words, and grammar on questions "
        "of its own"
    )


def _percent(fraction: float | None) -> str:
    return "-" if fraction is None else f"{100 * fraction:.1f}"


def _plain(each: ScoredAnswer) -> dict[str, object]:
    row = each.asked.row
    return {
        "family": row.family,
        "question": row.question,
        "before": list(row.before),
        "kind": row.kind.value,
        "truth": "; ".join(truth.text for truth in row.truths),
        "contact": each.asked.contact,
        "answer": each.text,
        "decidable": each.score.decidable,
        "left_out": each.score.is_close,
        "right": each.score.right,
        "right_kind": each.score.right_kind,
    }
