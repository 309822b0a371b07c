"""``tacgrasp ask``: questions, dialogues, what the model is told, and what programs get."""

import io
import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import torch

from cltp.llm.generation import Reply
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.point_layout import EVEN
from policies import PolicyError
from tacgrasp import policy_factory
from tacgrasp.__main__ import main
from tests.fakes.tiny_weights import bump


class Answering:
    """A talker with one answer, which remembers its prompts."""

    layout = EVEN

    def __init__(self, text: str = "The depth is 0.50 mm.", *, ended: bool = True) -> None:
        self.text, self.ended, self.prompts = text, ended, list[str]()

    def feel(self, points: np.ndarray, scale: ForceScale) -> SimpleNamespace:
        assert points.shape == (1024, 3)
        return SimpleNamespace(touch=torch.zeros(3, 4))

    def reply_to(self, touch: torch.Tensor, prompt: str) -> Reply:
        self.prompts.append(prompt)
        return Reply(
            text=self.text,
            ended=self.ended,
            num_tokens=9,
            action=None,
            probabilities=(),
            stage_ms={},
            token_probabilities=(0.5, 0.125),
        )


@pytest.fixture
def talker(monkeypatch: pytest.MonkeyPatch) -> Answering:
    answering = Answering()

    def check(text: str) -> None:
        if "Welt" in text:
            raise PolicyError("ask in plain English")

    policy = SimpleNamespace(talker=answering, check=check)
    monkeypatch.setattr(policy_factory, "load_llm", lambda weights=None: policy)
    return answering


@pytest.fixture
def touch(tmp_path: Path) -> str:
    np.save(tmp_path / "touch.npy", bump(1.0, -2.0, 0.5))
    return str(tmp_path / "touch.npy")


@pytest.fixture
def untouched(tmp_path: Path) -> str:
    np.save(tmp_path / "flat.npy", np.zeros((75, 100), np.float32))
    return str(tmp_path / "flat.npy")


class Typed(io.StringIO):
    """Standard input, at a terminal or not."""

    def __init__(self, text: str, *, terminal: bool) -> None:
        super().__init__(text)
        self._terminal = terminal

    def isatty(self) -> bool:
        return self._terminal


def test_one_question_is_put_as_it_is(
    talker: Answering, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["ask", touch, "How deep is it?"]) == 0
    assert capsys.readouterr().out == "The depth is 0.50 mm.\n"
    assert talker.prompts == ["How deep is it?"]


def test_goal_limit_and_mass_are_told(talker: Answering, touch: str) -> None:
    told = ["--goal", "0.42", "0.51", "--limit", "0.8", "--mass", "25"]
    assert main(["ask", touch, "Will it slip at this weight?", *told]) == 0
    assert talker.prompts == [
        "Goal 0.42 - 0.51 N, limit 0.80 N, mass 25 g. Will it slip at this weight?"
    ]


def test_task_and_instruction_become_the_contract_that_a_run_would_have(
    talker: Answering, touch: str
) -> None:
    assert main(["ask", touch, "Safe to lift?", "--task", "egg"]) == 0
    assert main(["ask", touch, "Safe to lift?", "--instruction", "Use 0.6 to 0.8 N."]) == 0
    assert re.fullmatch(
        r"Goal [\d.]+ - [\d.]+ N, limit [\d.]+ N. Safe to lift\?", talker.prompts[0]
    )
    assert talker.prompts[1].startswith("Goal 0.60 - 0.72 N, limit 0.79 N.")


def test_programs_get_value_unit_and_confidence(
    talker: Answering, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["ask", touch, "How deep is it?", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {
        "answer": "The depth is 0.50 mm.",
        "kind": "number",
        "value": 0.5,
        "unit": "mm",
        "confidence": pytest.approx(0.25),
        "decidable": True,
    }
    talker.text = "I can't feel its price."
    assert main(["ask", touch, "What does it cost?", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert (said["kind"], said["value"], said["decidable"]) == ("unknowable", None, False)


def test_an_untouched_pad_answers_by_the_contact_test(
    talker: Answering, untouched: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["ask", untouched, "How deep is it?"]) == 0
    assert capsys.readouterr().out == "Nothing touches.\n"
    assert talker.prompts == []


def test_follow_ups_of_a_dialogue_are_put_with_the_exchange_before(
    talker: Answering,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lines = iter(["What should I do next?", "Hallo Welt", "Why?", "How deep is the contact?", ""])
    monkeypatch.setattr("builtins.input", lambda prompt: next(lines))
    monkeypatch.setattr("sys.stdin", Typed("", terminal=True))
    talker.text = "Move left."
    assert main(["ask", touch]) == 0
    assert talker.prompts == [
        "What should I do next?",
        "What should I do next? Move left. Why?",
        "How deep is the contact?",
    ]
    assert "ask in plain English\n" in capsys.readouterr().out


def test_ctrl_d_ends_a_dialogue(
    talker: Answering, touch: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def end(prompt: str) -> str:
        raise EOFError

    monkeypatch.setattr("builtins.input", end)
    monkeypatch.setattr("sys.stdin", Typed("", terminal=True))
    assert main(["ask", touch]) == 0
    assert talker.prompts == []


def test_lines_of_input_are_answered_by_a_line_each(
    talker: Answering,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sys.stdin", Typed("How deep is it?\n\nHow hard?\n", terminal=False))
    assert main(["ask", touch, "--json"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [json.loads(line)["value"] for line in lines] == [0.5, 0.5]


@pytest.mark.parametrize(
    ("argv", "typed", "expected", "code"),
    [
        ([], "", "there is no question", 2),
        ([], "How deep?\nHallo Welt\n", "line 2: ask in plain English", 2),
        (["Hallo Welt"], "", "ask in plain English", 2),
        (["Deep?", "--limit", "1"], "", "--limit belongs to --goal", 2),
        (["Deep?", "--goal", "1", "2", "--task", "egg"], "", "both name a contract", 2),
        (["Deep?", "--goal", "2", "1"], "", "--goal, --limit: a band needs", 2),
        (["Deep?", "--goal", "0", "1"], "", "--goal, --limit: force terms need", 2),
        (["Deep?", "--goal", "1", "2", "--limit", "1.5"], "", "above its limit", 2),
        (["Deep?", "--mass", "0"], "", "--mass: a mass must be above 0 g", 2),
        (["Deep?", "--instruction", "Crush it."], "", "is refused: ", 2),
    ],
)
def test_wrong_use_is_told_in_one_line(
    argv: list[str],
    typed: str,
    expected: str,
    code: int,
    talker: Answering,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sys.stdin", Typed(typed, terminal=False))
    assert main(["ask", touch, *argv]) == code
    printed = capsys.readouterr().err
    assert expected in printed
    assert printed.count("\n") == 1


def test_an_answer_that_does_not_end_is_not_given(
    talker: Answering, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    talker.ended = False
    assert main(["ask", touch, "How deep is it?"]) == 3
    assert "did not end within 9 tokens" in capsys.readouterr().err
