"""Files of questions with their truths.

A file has the columns family, question, kind, truth, tolerance and, where a question follows
another, before:

    kind        number, yes_no, choice, text, unknowable or off_topic
    truth       an expression (``tacgrasp.lessons.dialogue.expression``), or several with semicolons
                for a text; empty for unknowable and off_topic
    tolerance   of a number: in its unit (0.3) or of the value (15%); of a yes or no: how near to
                the threshold a contact is left out. Empty: the usual one of a number
                (``tacgrasp.lessons.dialogue.scoring.tolerances``), 0 of yes and no
    before      the questions that were answered before this one, with `` | `` between them
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from tacgrasp.base.csv_rows import csv_rows
from tacgrasp.base.errors import UsageError
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scoring.tolerances import Tolerance, tolerance_of

KEPT_OUT = "kept_out_questions.csv"
"""Questions in ``tacgrasp.lessons`` that were written before the grammar and are not in it."""

BETWEEN = " | "
"""What stands between two questions of the column before."""

COLUMNS = ("family", "question", "kind", "truth", "tolerance")
UNDECIDABLE = (AnswerKind.UNKNOWABLE, AnswerKind.OFF_TOPIC)

_RESULTS = {
    AnswerKind.NUMBER: "number",
    AnswerKind.YES_NO: "condition",
    AnswerKind.CHOICE: "word",
}
"""What a truth of each kind comes to; that of a text may be anything."""


@dataclass(frozen=True, slots=True, kw_only=True)
class QuestionRow:
    """One question of a file.

    Attributes:
        family: Its family, for the table.
        question: Its wording.
        kind: Kind of the right answer.
        truths: Its truth, or several; empty where touch knows none.
        tolerance: Of a number or a threshold.
        before: The questions before it.
    """

    family: str
    question: str
    kind: AnswerKind
    truths: tuple[Expression, ...] = ()
    tolerance: Tolerance | None = None
    before: tuple[str, ...] = ()

    @property
    def last(self) -> str:
        """The question right before it; ''."""
        return self.before[-1] if self.before else ""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of a scene that its truths use."""
        return tuple(dict.fromkeys(name for truth in self.truths for name in truth.names))

    def usual_tolerance(self, truth: Expression) -> Tolerance:
        """Tolerance of one of its truths where the row has none."""
        return tolerance_of(truth.names)


def read_questions(path: Path | None) -> list[QuestionRow]:
    """Questions of a CSV file; None takes those that come along.

    Raises:
        UsageError: The file can't be read, or a row is not as the module says.
    """
    source = path or Path(str(resources.files("tacgrasp.lessons") / KEPT_OUT))
    rows = csv_rows(source)
    if not rows or not set(COLUMNS) <= set(rows[0]):
        raise UsageError(f"{source} needs the columns {', '.join(COLUMNS)}, and a row")
    questions = []
    for line, row in enumerate(rows, start=2):
        try:
            questions.append(question_row({key: value or "" for key, value in row.items() if key}))
        except ValueError as error:
            raise UsageError(f"{source}, line {line}: {error}") from None
    return questions


def question_row(row: Mapping[str, str]) -> QuestionRow:
    """A question out of its columns.

    Raises:
        ValueError: A column is wrong; the message names it.
    """
    try:
        kind = AnswerKind(row["kind"].strip())
    except ValueError:
        raise ValueError(
            f"kind must be one of {', '.join(AnswerKind)}, got {row['kind']!r}"
        ) from None
    if not row["question"].strip():
        raise ValueError("the question is empty")
    truths = tuple(Expression(part) for part in row["truth"].split(";") if part.strip())
    if bool(truths) == (kind in UNDECIDABLE):
        wanted = "no truth" if truths else "a truth"
        raise ValueError(f"a question of kind {kind} needs {wanted}")
    if len(truths) > 1 and kind is not AnswerKind.TEXT:
        raise ValueError(f"a question of kind {kind} needs one truth, got {len(truths)}")
    result = _RESULTS.get(kind)
    for truth in truths:
        if result and truth.result and truth.result != result:
            raise ValueError(
                f"a question of kind {kind} needs a {result} as its truth, and {truth.text!r} is a "
                f"{truth.result}"
            )
    return QuestionRow(
        family=row["family"].strip() or kind.value,
        question=row["question"].strip(),
        kind=kind,
        truths=truths,
        tolerance=_tolerance(row["tolerance"].strip()),
        before=tuple(
            line.strip() for line in row.get("before", "").split(BETWEEN.strip()) if line.strip()
        ),
    )


def _tolerance(text: str) -> Tolerance | None:
    if not text:
        return None
    try:
        value = float(text.rstrip(" %"))
    except ValueError:
        value = -1.0
    if not 0 <= value < float("inf"):
        raise ValueError(f"tolerance must be a number such as 0.3 or 15%, got {text!r}")
    return Tolerance(fraction=value / 100) if text.endswith("%") else Tolerance(absolute=value)
