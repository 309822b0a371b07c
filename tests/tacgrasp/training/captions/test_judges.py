"""Judges of captions: a command, and a local language model."""

import shlex
import sys
from pathlib import Path

import pytest
import torch

from tacgrasp.base.errors import UsageError
from tacgrasp.training.captions.judges import CommandJudge, JudgedPair, LmJudge, make_judge
from tests.fakes.stock_lm import save_stock_lm

PAIRS = [
    JudgedPair("a smooth sphere", "a smooth sphere"),
    JudgedPair("a smooth sphere", "a rough édge"),
]
SAME = """
import json, sys
for line in sys.stdin:
    pair = json.loads(line)
    print(5 if pair["reference"] == pair["caption"] else 1.5)
"""


def python(code: str) -> str:
    return shlex.join([sys.executable, "-c", code])


def test_a_command_gets_json_lines_and_rates_each() -> None:
    judge = CommandJudge(python(SAME), timeout_s=60)
    assert judge.rate(PAIRS) == [5.0, 1.5]
    assert judge.title == Path(sys.executable).name


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        ("print(5)", "answered 1 lines to 2 captions"),
        ("print('good'); print(3)", "answered 'good' in line 1; a number from 1 to 5"),
        ("print(3); print(6)", "answered '6' in line 2"),
        ("print('nan'); print(3)", "answered 'nan' in line 1"),
        ("import sys; sys.exit('no key')", "ended with code 1; it says no key"),
    ],
)
def test_nonsense_of_a_command_is_told(code: str, reason: str) -> None:
    with pytest.raises(UsageError, match=reason):
        CommandJudge(python(code), timeout_s=60).rate(PAIRS)


def test_a_command_that_hangs_is_ended() -> None:
    with pytest.raises(UsageError, match=r"gave no ratings of 2 captions within 0\.2 s"):
        CommandJudge(python("import time; time.sleep(60)"), timeout_s=0.2).rate(PAIRS)


@pytest.mark.parametrize(("command", "reason"), [("", "needs a command"), ("'", "is no command")])
def test_a_command_that_is_none_is_refused(command: str, reason: str) -> None:
    with pytest.raises(UsageError, match=reason):
        make_judge(command, None, 1.0)


def test_a_command_that_is_not_there_is_told() -> None:
    with pytest.raises(UsageError, match="can't be started"):
        CommandJudge("no-such-judge-anywhere", timeout_s=1).rate(PAIRS)


def test_one_judge_is_named() -> None:
    assert make_judge(None, None, 1.0) is None
    with pytest.raises(UsageError, match="exclude each other"):
        make_judge("judge", Path("judge"), 1.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return save_stock_lm(tmp_path_factory.mktemp("judge") / "judge", "qwen2")


def test_a_language_model_rates_by_the_probabilities_of_five_digits(folder: Path) -> None:
    judge = LmJudge(folder)
    ratings = judge.rate(PAIRS)
    assert all(1 < rating < 5 for rating in ratings)
    assert ratings[0] != ratings[1]  # it reads the caption
    assert judge.title == "judge"
    head = judge._lm.get_output_embeddings()

    def sure_of(digit: int):  # type: ignore[no-untyped-def]
        def bias(_: object, __: object, logits: torch.Tensor) -> torch.Tensor:
            logits[..., judge._digits[digit - 1]] += 1e4
            return logits

        return bias

    for digit in (1, 4):
        hook = head.register_forward_hook(sure_of(digit))
        assert judge.rate(PAIRS) == pytest.approx([digit, digit])
        hook.remove()


def test_a_folder_that_holds_no_judge_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="is no directory"):
        LmJudge(tmp_path / "none")
    with pytest.raises(UsageError, match="holds no causal language model"):
        LmJudge(tmp_path)
