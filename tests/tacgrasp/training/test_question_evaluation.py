"""``tacgrasp eval questions`` with a model of one query: prompts, figures, and refused files."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from cltp.llm.constrained.grammar import match
from policies.llm.spoken import SpokenContact
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.eval_questions import _show
from tacgrasp.lessons import understanding
from tacgrasp.lessons.dialogue.scoring.question_file import question_row
from tacgrasp.lessons.turns import turn
from tacgrasp.training import question_evaluation
from tacgrasp.training.question_evaluation import FeltContact, evaluate_questions, felt_contacts
from tests.fakes.query_odds import NoOdds
from tests.fakes.question_scenes import FIRM, HELD

CONTACTS = [FeltContact(points=np.zeros((1024, 3), np.float32), scene=s) for s in (HELD, FIRM)]


class Parrot:
    """Writes the same query to every question, feels HELD, and remembers what it was asked."""

    width = 4

    def __init__(self, query):
        self.query, self.prompts = query, []

    def feel(self, points):
        assert points.shape == (1024, 3)

    def reply_to(self, touch, prompt, *, grammar):
        assert touch.shape == (0, self.width)
        assert match(grammar, self.query)[1]
        self.prompts.append(prompt)
        return SimpleNamespace(text=self.query, ended=True)

    def log_likelihoods(self, prompt, replies):
        return [0.0 for _ in replies]


def row(question, kind, truth="", before=""):
    columns = {"family": kind, "question": question, "kind": kind, "truth": truth}
    return question_row({**columns, "tolerance": "", "before": before})


ROWS = [
    row("Over 1 N?", "yes_no", "force_n > 1"),
    row("And how deep?", "number", "depth_mm", before="Over 1 N?"),
    row("Is it red?", "unknowable"),
]


@pytest.fixture(autouse=True)
def _few_own_questions(monkeypatch):
    monkeypatch.setattr(question_evaluation, "GRAMMAR_QUESTIONS", 3)
    monkeypatch.setattr(understanding, "QueryOdds", NoOdds)
    spoken = SpokenContact(HELD.state, {}, {})
    monkeypatch.setattr(question_evaluation, "spoken_contact", lambda talker, felt: spoken)


def evaluated(talker):
    return evaluate_questions(ROWS, CONTACTS, talker, per_question=2)


def test_the_model_reads_each_question_once_and_answers_on_what_is_felt():
    parrot = Parrot("amount force N.")
    results, answers = evaluated(parrot)
    assert parrot.prompts == ["over # n", "over # n ? and how deep", "is it red"]
    alone = results["figures"]["model alone"]
    assert (alone["right"], alone["decidable_n"], alone["undecidable_n"]) == (0, 4, 2)
    assert alone["undecidable"] == 0
    assert len(answers) == 6
    assert json.dumps(results)


def test_wordings_of_the_grammar_are_read_by_it_and_the_model_without_it_stands_beside():
    results, answers = evaluated(Parrot("amount force N."))
    said = {each.asked.row.question: each.text for each in answers}
    assert said == {
        "Over 1 N?": "No, the force is 0.83 N.",
        "And how deep?": "0.19 mm.",
        "Is it red?": "I can't feel its color.",
    }
    assert results["figures"]["model"]["undecidable"] == 1


def test_a_question_is_asked_behind_all_those_before_it(monkeypatch):
    before = "What if I add 0.9 N? | Is that over the limit?"
    rows = [row("And with 0.1 N?", "yes_no", "force_n + 0.1 > limit_n", before=before)]
    parrot = Parrot("amount force N.")
    results, answers = evaluate_questions(rows, CONTACTS[:1], parrot, per_question=1)
    assert answers[0].text == "No, the force would be 0.93 N, the limit is 1.30 N."
    assert results["figures"]["model"]["right"] == results["figures"]["true touch"]["right"] == 1
    assert results["figures"]["each question apart"]["right"] == 0


def test_confidence_is_scored_on_what_the_model_answers(monkeypatch):
    monkeypatch.setattr(turn, "understood_by_grammar", lambda *_: None)
    monkeypatch.setattr(understanding, "understood_by_grammar", lambda *_: None)
    results, answers = evaluated(Parrot("amount force N."))
    assert {each.text for each in answers} == {"0.83 N."}
    assert results["figures"]["model"] == results["figures"]["model alone"]
    assert results["confidence"]["auroc"] is None  # all wrong
    assert results["confidence"]["calibration_error"] == pytest.approx(1.0, abs=0.01)


def test_a_right_query_gives_right_answers():
    results, _ = evaluated(Parrot("amount depth mm."))
    assert results["figures"]["model alone"]["right"] == 0.25  # the number about HELD, no verdict
    assert results["families"]["number"]["right"] == 0.5  # felt is HELD, asked about FIRM too


def test_what_touch_misses_is_told_from_what_language_misses():
    results, _ = evaluated(Parrot("amount force N."))
    felt = results["figures"]["truth as felt"]
    assert felt["right"] == 0.5  # felt is HELD, asked about FIRM too
    assert felt["undecidable"] == felt["right_kind"] == 1


def test_the_upper_bounds_are_reached():
    results, answers = evaluated(None)
    assert answers == []
    assert results["figures"]["truth in words"]["right"] == 1
    assert results["figures"]["grammar"]["right_kind"] == 1
    assert results["figures"]["unknowable"]["undecidable"] == 1


def test_contacts_are_made_where_none_are_given():
    first, second = felt_contacts(None, 5, 0), felt_contacts(None, 5, 0)
    assert len(first) == 5
    assert all(each.points.shape == (1024, 3) for each in first)
    assert [each.scene for each in first] == [each.scene for each in second]


def test_a_truth_that_can_not_be_evaluated_is_named():
    with pytest.raises(UsageError, match="can't be evaluated"):
        evaluate_questions([row("?", "yes_no", "shape > 3")], CONTACTS, None, per_question=1)


def test_a_bad_file_is_one_line(tmp_path, capsys):
    path = tmp_path / "q.csv"
    path.write_text("family,question,kind,truth,tolerance\na,How?,number,depth,x\n")
    assert main(["eval", "questions", "--file", str(path)]) == 2
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert "line 2" in printed


@pytest.mark.parametrize("talker", [None, Parrot("amount force N.")], ids=["no model", "model"])
def test_the_words_below_the_table_name_its_rows(talker, capsys):
    results, answers = evaluated(talker)
    _show(results, answers, wrong=False)
    table, words = capsys.readouterr().out.split("trivial: no")
    for name in ("truth as felt", "truth in words", "grammar"):
        assert (name in table) == (name in " ".join(words.split())), name


@pytest.mark.slow
def test_the_command_prints_and_writes_its_figures(tmp_path, capsys):
    path = tmp_path / "figures.json"
    argv = ["eval", "questions", "--no-model", "--contacts", "4", "--per-question", "1"]
    assert main([*argv, "--json", str(path)]) == 0
    assert "truth in words" in capsys.readouterr().out
    written = json.loads(path.read_text())
    assert written["questions"] == 300
    assert written["figures"]["truth in words"]["right"] == 1
