import pytest

from tacgrasp.base.errors import UsageError
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scoring.question_file import question_row, read_questions

HEAD = "family,question,kind,truth,tolerance\n"


def written(tmp_path, text):
    path = tmp_path / "questions.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_file_is_read(tmp_path):
    path = written(
        tmp_path,
        HEAD + "depth,How deep?,number,depth_mm,10%\n"
        'two,"Where, and how hard?",text,position; force_n,\n'
        "color,Is it red?,unknowable,,\n",
    )
    rows = read_questions(path)
    assert [row.kind for row in rows] == [
        AnswerKind.NUMBER,
        AnswerKind.TEXT,
        AnswerKind.UNKNOWABLE,
    ]
    assert rows[0].tolerance.of(2.0) == pytest.approx(0.2)
    assert rows[1].names == ("position", "force_n")
    assert rows[1].usual_tolerance(Expression("force_n")).of(2.0) == pytest.approx(0.5)
    assert rows[2].truths == ()


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("a,How?,numbers,depth_mm,", "kind must be one of number, yes_no"),
        ("a,How?,number,,", "needs a truth"),
        ("a,How?,unknowable,depth_mm,", "needs no truth"),
        ("a,How?,number,depth_cm,", "no name is called 'depth_cm'"),
        ("a,How?,number,depth_mm; force_n,", "needs one truth, got 2"),
        ("a,How?,number,depth_mm,much", "tolerance must be a number"),
        ("a,How?,number,depth_mm,-1", "tolerance must be a number"),
        ("a,,number,depth_mm,", "the question is empty"),
        ("a,How?,number,exec('1'),", "Call"),
    ],
)
def test_a_bad_row_is_named_with_its_line(tmp_path, line, named):
    path = written(tmp_path, f"{HEAD}ok,Where?,choice,position,\n{line}\n")
    with pytest.raises(UsageError, match="line 3") as caught:
        read_questions(path)
    assert named in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_without_its_columns_is_refused(tmp_path):
    with pytest.raises(UsageError, match="needs the columns"):
        read_questions(written(tmp_path, "question,truth\nHow deep?,depth_mm\n"))
    with pytest.raises(UsageError, match="can't be read"):
        read_questions(tmp_path / "none.csv")


@pytest.mark.parametrize(
    ("kind", "truth", "reason"),
    [
        ("number", "depth_mm / 0", "divides by 0"),
        ("number", "depth_mm > 0.3", "needs a number"),
        ("choice", "depth_mm", "needs a word"),
        ("yes_no", "shape", "needs a condition"),
    ],
)
def test_a_truth_of_another_kind_is_refused(kind, truth, reason):
    row = {"family": "", "question": "What?", "kind": kind, "truth": truth, "tolerance": ""}
    with pytest.raises(ValueError, match=reason):
        question_row(row)
