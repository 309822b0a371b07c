"""What evaluation asks and how it judges: goals, pairs, kept-out instructions, figures."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from cltp.data.dataset import ContactDataset
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import ContactState
from cltp.texts.told import ToldContact
from policies import Decision, Observation
from policies.contract_steps import target_of
from policies.llm.text import caption_text
from policies.teacher import LESSON_MOVE_STEP_MM, teacher
from primitives import Primitive
from primitives.contract import Contract
from tacgrasp.__main__ import main
from tacgrasp.lessons import instruction_pairs
from tacgrasp.lessons.captions import read_numbers
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scene import band_contract
from tacgrasp.lessons.dialogue.scoring.question_file import read_questions
from tacgrasp.lessons.exchanges import caption_exchange
from tacgrasp.lessons.instruction_pairs import (
    MOVES,
    NONE,
    QUOTAS,
    Wordings,
    answer_for,
    answer_of,
    choose_goals,
    choose_pairs,
    choose_wordings,
    counts,
    fraction,
    kept_out,
)
from tacgrasp.training import evaluate
from tacgrasp.training.evaluate import _decided
from tests.fakes.tiny_weights import make_data, state

NOTHING = ContactState(
    depth_mm=0.0, x_mm=0.0, y_mm=0.0, area_fraction=0.0, force_n=0.0, depth=None, position=None,
    area=None,
)  # fmt: skip


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_data(tmp_path_factory.mktemp("data"))


def test_the_quotas_are_all_of_the_pairs_and_balance_four_kinds_of_answer() -> None:
    assert sum(QUOTAS.values()) == pytest.approx(1)
    of = {a: sum(s for kind, s in QUOTAS.items() if a in kind) / 2 for a in (*MOVES, NONE)}
    assert sum(of[move] for move in MOVES) == pytest.approx(0.2)
    assert of[NONE] == pytest.approx(0.25)


@pytest.mark.parametrize("clear", [True, False])
def test_the_two_instructions_of_a_pair_ask_for_different_answers_on_one_contact(
    data_dir: Path, clear: bool
) -> None:
    data = ContactDataset(data_dir)
    pairs = choose_pairs(data, 20, clear=clear)
    assert len(pairs) >= 10
    for one, other in pairs:
        assert one.index == other.index
        assert one.answer != other.answer
        assert one.contract.text != other.contract.text or one.contract != other.contract
        for case in (one, other):
            state, goal = data.state(case.index), target_of(case.contract)
            advice = teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM)
            assert answer_of(advice) == case.answer
    assert choose_pairs(data, 20, clear=clear) == pairs
    assert choose_pairs(data, 20, clear=clear, seed=1) != pairs


def test_pairs_keep_to_their_quotas_and_use_a_contact_once(data_dir: Path) -> None:
    pairs = choose_pairs(ContactDataset(data_dir), 20, clear=False)
    kinds = [frozenset({a.answer, b.answer}) for a, b in pairs]
    assert all(kinds.count(kind) <= round(20 * share_) for kind, share_ in QUOTAS.items())
    assert len({one.index for one, _ in pairs}) == len(pairs)


def test_an_answer_that_noise_decides_is_not_clear() -> None:
    goal = target_of(band_contract(0.95, 1.9))
    middle = math.sqrt(goal.force_n.low * goal.force_n.high)
    centred = state(0.0, 0.0, 0.15, middle)
    at_the_limit = state(0.0, 0.0, 0.15, 0.99 * goal.force_n.high)
    assert answer_for(centred, goal, clear=True) == NONE
    assert answer_for(at_the_limit, goal, clear=False) == NONE
    assert answer_for(at_the_limit, goal, clear=True) is None
    barely_off = state(goal.x_mm.high + 0.1, 0.0, 0.15, middle)
    assert answer_for(barely_off, goal, clear=False) == "move_right"
    assert answer_for(barely_off, goal, clear=True) is None


def test_drawn_goals_ask_for_every_kind_of_answer(data_dir: Path) -> None:
    data = ContactDataset(data_dir)
    cases = choose_goals(data, 40, clear=False)
    assert len(cases) == len({case.index for case in cases}) == 40
    for case in cases:
        goal = target_of(case.contract)
        assert answer_for(data.state(case.index), goal, clear=False) == case.answer
    assert {"increase_force", "decrease_force", NONE} <= set(counts(cases))
    assert max(counts(cases).values()) < 0.7 * len(cases)
    clear = choose_goals(data, 40, clear=True)
    assert all(
        answer_for(data.state(c.index), target_of(c.contract), clear=True) == c.answer
        for c in clear
    )


def test_every_kept_out_instruction_that_is_not_refused_is_used(data_dir: Path) -> None:
    data = ContactDataset(data_dir)
    cases = choose_wordings(data, 1, clear=False)
    texts = {case.contract.text for case in cases}
    assert len(texts) > 0.9 * len({each.text for each in kept_out().wordings})
    assert "refuse" not in {case.expect for case in cases}
    assert not any(case.contract.refused for case in cases)
    assert max(counts(cases).values()) < 0.6 * len(cases)


def test_the_numbers_of_a_description_are_read_back() -> None:
    told = ToldContact(state=state(1.0, -4.0, 0.95, 2.0))
    text = caption_exchange(told, np.random.default_rng(0)).reply
    assert read_numbers(text) == pytest.approx([0.95, 1.0, -4.0, 0.12, 2.0])
    assert read_numbers(caption_text(NOTHING)) == pytest.approx([0, 0, 0, 0, 0])
    assert read_numbers("a smooth sphere object") is None


def test_nothing_has_no_share() -> None:
    assert math.isnan(fraction(np.array([], dtype=bool)))
    assert fraction(np.array([True, False])) == 0.5


def test_eval_prints_every_table_and_writes_json_and_card(
    weights: Path,
    data_dir: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    few = Wordings(kept_out().wordings[::200][:3])
    monkeypatch.setattr(instruction_pairs, "kept_out", lambda: few)
    questions = read_questions(None)[::60]
    monkeypatch.setattr(evaluate, "read_questions", lambda path: questions)
    figures = tmp_path / "eval.json"
    argv = ["eval", "--weights", str(weights), "--data", str(data_dir), "--json", str(figures)]
    argv += ["--blind", str(weights), "--captions", "4", "--answers", "1", "--pairs", "4"]
    assert main([*argv, "--goals", "3", "--card"]) == 0
    printed = capsys.readouterr()
    titles = ("captions:", "numbers:", "answers:", "drawn goals", "instruction pairs", "CLIP")
    for title in (*titles, "kept-out instructions"):
        assert title in printed.out
    assert "captions 4/4" in printed.err  # progress, in plain lines where there is no terminal
    evaluation = json.loads(figures.read_text())
    assert evaluation["captions"]["contacts"] == 4
    assert evaluation["captions"]["geometric_baseline"]["shape"] is None
    assert evaluation["captions"]["geometric_baseline"]["depth"] >= 0.5
    assert set(evaluation["numbers"]["llm"]) == {
        "depth_mm",
        "position_mm",
        "area_percent",
        "force_percent",
    }
    for kind in ("clear", "any"):
        pairs = evaluation["instruction_pairs"][kind]
        assert set(pairs["right"]) == {"llm", "rules", "blind"}
        assert pairs["right"]["llm"] == 0.0  # it was never trained: it holds
        assert evaluation["paraphrases"][kind]["cases"] == 3
        assert evaluation["advice"][kind]["cases"] == 3
        assert set(evaluation["advice"][kind]["right"]) == {"llm", "rules", "blind"}
    for name in ("held_out", "trained"):
        assert set(evaluation["answers"][name]) == {*(k.value for k in AnswerKind), "mean"}
    card = (weights / "README.md").read_text()
    assert card.startswith("# Tac3D-LLM, small\n\nfacts\n\n## Scores\n")
    assert "| captions, geometric baseline, depth | " in card
    assert "old" not in card


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--weights", "nowhere"], "weights are missing: nowhere/encoder/config.json"),
        (["--data", "nowhere"], "--data nowhere does not exist"),
        (["--pairs", "0"], "must be at least 1"),
        (["--json", "no/where.json"], "can't be written"),
        (["--blind", "nowhere"], "weights are missing: nowhere"),
    ],
)
def test_wrong_use_of_eval_is_told_in_one_line(
    argv: list[str],
    expected: str,
    weights: Path,
    data_dir: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["eval", "--weights", str(weights), "--data", str(data_dir), *argv]) == 2
    text = capsys.readouterr().err
    assert expected in text
    assert text.count("\n") == 1


def test_no_case_remembers_the_one_before() -> None:
    class Remembering:
        name = "remembering"

        def __init__(self) -> None:
            self.asked = 0

        def start(self) -> None:
            self.asked = 0

        def decide(self, observation: Observation, contract: Contract) -> Decision:
            self.asked += 1
            text = f"<{Primitive.RESET}>"
            action = Primitive.RESET if self.asked == 1 else None
            return Decision(text=text, action=action, success=False, reason="")

    policy = Remembering()
    cloud = cloud_from_heights(np.zeros((75, 100)), sensor_named("gelsight_mini"))
    answers = [_decided(policy, cloud, band_contract(1.0, 1.5)) for _ in range(3)]
    assert answers == [Primitive.RESET.value] * 3
