"""``tacgrasp ask``: questions, dialogues, what is told, and what programs get."""

import io
import json
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import torch
from PIL import Image

from cltp.encoder.reader import Flag
from cltp.llm.constrained.grammar import Grammar, match
from cltp.llm.generation import Reply
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.point_layout import EVEN
from policies import PolicyError
from policies.llm.spoken import SpokenContact
from tacgrasp import policy_factory
from tacgrasp.__main__ import main
from tacgrasp.lessons import understanding
from tacgrasp.playback import conversation
from tests.fakes.query_odds import NoOdds
from tests.fakes.question_scenes import HELD
from tests.fakes.tiny_weights import bump


class Writer:
    """A talker that writes one query, feels HELD, and remembers what it was asked."""

    layout = EVEN
    width = 4
    model = SimpleNamespace(heads=SimpleNamespace(contradiction=None))

    def __init__(self, query: str = "amount depth mm.") -> None:
        self.query, self.prompts = query, list[str]()

    def feel(self, points: np.ndarray, scale: ForceScale) -> SimpleNamespace:
        assert points.shape == (1024, 3)
        return SimpleNamespace(readings=None)

    def reply_to(self, touch: torch.Tensor, prompt: str, *, grammar: Grammar) -> Reply:
        assert touch.shape == (0, 4)
        assert match(grammar, self.query)[1]
        self.prompts.append(prompt)
        return Reply(
            text=self.query,
            ended=True,
            num_tokens=9,
            action=None,
            probabilities=(),
            stage_ms={},
        )

    def log_likelihoods(self, prompt: str, replies: Sequence[str]) -> list[float]:
        return [0.0 for _ in replies]


@pytest.fixture
def talker(monkeypatch: pytest.MonkeyPatch) -> Writer:
    writer = Writer()

    def check(text: str) -> None:
        if "Welt" in text:
            raise PolicyError("ask in plain English")

    policy = SimpleNamespace(talker=writer, check=check)
    monkeypatch.setattr(policy_factory, "load_llm", lambda weights=None: policy)
    spoken = SpokenContact(HELD.state, {"shape": 0.5}, {"depth_mm": (0.16, 0.25)})
    monkeypatch.setattr(conversation, "spoken_contact", lambda *_: spoken)
    monkeypatch.setattr(understanding, "understand", lambda *_, **__: None)  # the writer decides
    monkeypatch.setattr(understanding, "QueryOdds", NoOdds)
    flagged = SimpleNamespace(flags=(Flag.NOISE,), state=HELD.state)
    monkeypatch.setattr(conversation, "reading_of", lambda *_: flagged)
    return writer


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


def test_a_question_is_read_in_plain_words_and_answered_on_what_is_felt(
    talker: Writer, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["ask", touch, "How zorby's it, please?"]) == 0
    assert capsys.readouterr().out == "0.19 mm.\n"
    assert talker.prompts == ["how zorby's it"]


def test_what_the_grammar_has_is_answered_whatever_words_the_model_knows(
    talker: Writer, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(text: str) -> None:
        raise PolicyError("no word is known")

    policy_factory.load_llm().check = refuse  # type: ignore[method-assign]
    assert main(["ask", touch, "To bring the grip to 3 N, must I tighten or loosen?"]) == 0
    assert capsys.readouterr().out.startswith(("Tighten", "Loosen"))
    assert main(["ask", touch, "Fester oder lockerer?"]) == 2
    assert "no word is known" in capsys.readouterr().err
    assert talker.prompts == []


def test_a_frame_is_read_beside_the_frame_of_its_untouched_gel(
    talker: Writer, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    frame = str(tmp_path / "frame.png")
    Image.fromarray(np.full((240, 320, 3), 100, np.uint8)).save(frame)
    assert main(["ask", frame, "How deep?"]) == 2
    assert "as --background" in capsys.readouterr().err
    assert main(["ask", frame, "How deep?", "--background", frame]) == 0


def test_heights_of_the_wrong_sign_name_their_file(
    talker: Writer, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    np.save(tmp_path / "neg.npy", -bump(1.0, -2.0, 0.5))
    assert main(["ask", str(tmp_path / "neg.npy"), "How deep?"]) == 2
    assert "neg.npy: the gel rises" in capsys.readouterr().err


def test_goal_limit_and_mass_are_told(
    talker: Writer, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    told = ["--goal", "0.42", "0.51", "--limit", "0.8", "--mass", "25"]
    asked = {
        "amount limit N.": "0.80 N.",
        "amount mass g.": "25 g.",
        "amount band_low N.": "0.42 N.",
    }
    for talker.query, expected in asked.items():
        assert main(["ask", touch, "What is told?", *told]) == 0
        assert capsys.readouterr().out == f"{expected}\n"


def test_task_and_instruction_become_the_contract_that_a_run_would_have(
    talker: Writer, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    talker.query = "amount band_high N."
    assert main(["ask", touch, "How much at most?", "--instruction", "Use 0.6 to 0.8 N."]) == 0
    assert capsys.readouterr().out == "0.72 N.\n"
    assert main(["ask", touch, "How much at most?"]) == 0
    assert capsys.readouterr().out == "I can't say: no force band is given.\n"


def test_programs_get_value_unit_confidence_query_and_flags(
    talker: Writer, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    talker.query = "amount depth µm."
    assert main(["ask", touch, "How deep is it in microns?", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {
        "answer": "190 µm.",
        "kind": "number",
        "value": 190.0,
        "unit": "µm",
        "confidence": pytest.approx(59 / 64),
        "decidable": True,
        "interval": pytest.approx([160, 250], abs=15),
        "query": "amount depth µm.",
        "flags": ["noise", "uncalibrated_force"],
    }
    talker.query = "unknown price."
    assert main(["ask", touch, "What does it cost?", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert (said["kind"], said["value"], said["decidable"]) == ("unknowable", None, False)
    talker.query = "word shape."
    assert main(["ask", touch, "What shape is it?", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert (said["answer"], said["confidence"]) == ("Probably it is an ellipsoid.", 0.5)


def test_an_untouched_pad_answers_by_the_contact_test(
    talker: Writer, untouched: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["ask", untouched, "How deep is it?"]) == 0
    assert capsys.readouterr().out == "Nothing touches the pad.\n"


def test_no_question_about_a_pad_that_is_pressed_all_over_is_answered(
    talker: Writer, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    np.save(tmp_path / "pressed.npy", np.full((75, 100), 0.5, np.float32))
    asked = ["ask", str(tmp_path / "pressed.npy"), "Is it safe to lift?", "--goal", "0.5", "0.9"]
    assert main(asked) == 0
    assert "I can't say: the whole pad is raised by 0.50 mm" in capsys.readouterr().out
    assert main([*asked, "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert (said["kind"], said["decidable"], said["flags"]) == ("unknowable", False, ["raised"])
    assert talker.prompts == []


def test_follow_ups_of_a_dialogue_are_put_with_the_question_before(
    talker: Writer,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lines = iter(["What should I do next?", "Hallo Welt", "And otherwise?", ""])
    monkeypatch.setattr("builtins.input", lambda prompt: next(lines))
    monkeypatch.setattr("sys.stdin", Typed("", terminal=True))
    assert main(["ask", touch]) == 0
    assert talker.prompts == ["what should i do next", "what should i do next ? and otherwise"]
    assert "ask in plain English\n" in capsys.readouterr().out


def test_ctrl_d_ends_a_dialogue(
    talker: Writer, touch: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def end(prompt: str) -> str:
        raise EOFError

    monkeypatch.setattr("builtins.input", end)
    monkeypatch.setattr("sys.stdin", Typed("", terminal=True))
    assert main(["ask", touch]) == 0
    assert talker.prompts == []


def test_lines_of_input_are_answered_by_a_line_each(
    talker: Writer,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sys.stdin", Typed("How deep is it?\n\nHow zorby?\n", terminal=False))
    assert main(["ask", touch, "--json"]) == 0
    lines = capsys.readouterr().out.splitlines()
    first, blank, last = map(json.loads, lines)
    assert (first["value"], blank, last["value"]) == (0.19, None, 0.19)


def test_a_blank_line_of_input_is_answered_by_a_blank_line(
    talker: Writer,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    typed = "\nHow deep is it?\n  \nHow hard?\n\n"
    monkeypatch.setattr("sys.stdin", Typed(typed, terminal=False))
    assert main(["ask", touch]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [bool(line) for line in lines] == [False, True, False, True, False]


def test_a_line_that_cannot_be_answered_is_told_in_its_place(
    talker: Writer,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for flags in ([], ["--json"]):
        lines = "How deep is it?\nHallo Welt\nHow deep is it?\n"
        monkeypatch.setattr("sys.stdin", Typed(lines, terminal=False))
        assert main(["ask", touch, *flags]) == 2
        printed = capsys.readouterr()
        said = printed.out.splitlines()
        assert len(said) == 3
        assert said[1] == ('{"error": "ask in plain English"}' if flags else "ask in plain English")
        assert said[0] == said[2]
        assert printed.err == "tacgrasp: line 2: ask in plain English\n"


@pytest.mark.parametrize(
    ("argv", "typed", "expected", "code"),
    [
        ([], "", "there is no question", 2),
        ([], "\n \n", "there is no question", 2),
        ([], "How deep?\nHallo Welt\n", "line 2: ask in plain English", 2),
        (["Hallo Welt"], "", "ask in plain English", 2),
        (["Deep?", "--limit", "1"], "", "--limit belongs to --goal", 2),
        (["Deep?", "--goal", "1", "2", "--task", "egg"], "", "both name a contract", 2),
        (["--goal", "1", "2", "Deep?"], "", "what stands without a flag goes before it", 2),
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
    talker: Writer,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sys.stdin", Typed(typed, terminal=False))
    assert main(["ask", touch, *argv]) == code
    printed = capsys.readouterr().err
    assert expected in printed
    assert printed.count("\n") == 1


def test_input_that_is_no_utf_8_is_answered_line_by_line(
    talker: Writer,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    typed = io.TextIOWrapper(io.BytesIO(b"\xff\xfe deep?\nHow deep is it?\n"), encoding="utf-8")
    monkeypatch.setattr("sys.stdin", typed)
    main(["ask", touch])
    assert len(capsys.readouterr().out.splitlines()) == 2
