"""The language model on the command line: what it is asked, and everything that can be wrong."""

import errno
import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import BinaryIO

import numpy as np
import pytest
import torch

import policies.llm.policy
from cltp.checkpoints.manifest import write_manifest
from cltp.checkpoints.tac3d_llm import load_clip
from cltp.data.dataset import ContactDataset
from cltp.llm.generation import Reply, Talker
from cltp.texts.tokenizer import ACTIONS, Words
from cltp.train.stage import TrainingRun
from policies import PolicyError
from policies.llm.policy import LlmPolicy
from tacgrasp import policy_factory
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.learning import llm_latency as bench_language
from tacgrasp.benchmarks.loop import strawberry as bench_strawberry
from tacgrasp.benchmarks.loop.contestants import language_model
from tacgrasp.config.layers import load
from tacgrasp.console import COMPLETED
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.pretraining import methods as methods_module
from tacgrasp.training import train
from tests.fakes.tiny_weights import bump, make_data
from tests.paths import ROOT

pytestmark = pytest.mark.usefixtures("threads_as_before")

GOOD = "smooth sphere, deep 0.70 mm. Goal 0.95 - 1.90 N. Action: <decrease_force>. It is too firm."


@pytest.fixture(autouse=True)
def readable(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let weights that have learned next to nothing decide, not the direct measurement."""
    monkeypatch.setattr(policies.llm.policy, "READABLE", 0.0)


@pytest.fixture
def copy(weights: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(weights, tmp_path / "copy"))


@pytest.fixture(scope="module")
def touch(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("touch") / "touch.npy"
    np.save(path, bump(1.0, -2.0, 0.5))
    return str(path)


class Scripted:
    """A talker that feels as another one does, and always says the same."""

    def __init__(self, talker: Talker, text: str, *, ended: bool = True) -> None:
        named = [action for action in ACTIONS if action in text]
        self.layout, self.model, self.feel = talker.layout, talker.model, talker.feel
        self._reply = Reply(
            text=text,
            ended=ended,
            num_tokens=40,
            action=named[0] if named else None,
            probabilities=(0.93, *[0.01] * 7) if named else (),
            stage_ms={},
        )

    def reply(self, points: np.ndarray, prompt: str, **_: object) -> Reply:
        return self._reply

    def reply_to(self, touch: torch.Tensor, prompt: str, **_: object) -> Reply:
        return self._reply


def saying(monkeypatch: pytest.MonkeyPatch, text: str, *, ended: bool = True) -> None:
    """Every model that is loaded from now on says ``text``."""
    load = policy_factory.load_llm

    def scripted(weights: Path | None = None) -> LlmPolicy:
        policy = load(weights)
        monkeypatch.setattr(policy, "_talker", Scripted(policy.talker, text, ended=ended))
        return policy

    monkeypatch.setattr(policy_factory, "load_llm", scripted)


def complaint(argv: list[str], capsys: pytest.CaptureFixture[str], code: int = 2) -> str:
    assert main(argv) == code
    printed = capsys.readouterr()
    assert COMPLETED not in printed.out
    assert printed.err.startswith("tacgrasp: ")
    assert printed.err.count("\n") == 1
    return printed.err


def test_a_question_is_answered(
    weights: Path, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Untrained weights write any query, but always one."""
    argv = ["ask", touch, "How deep is it pressed?", "--json", "--weights", str(weights)]
    assert main(argv) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["answer"].endswith(".")
    assert read_query(said["query"]) is not None
    assert 0 < said["confidence"] <= 1


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("", "in words is needed"),
        ("1 2 3 ?", "in words is needed"),
        ("deep " * 10_000, "has 10000 words, at most"),
        ("Wie tief ist der Gegenstand eingedrückt?", "plain English"),
    ],
)
def test_a_question_that_it_cannot_know_is_refused(
    question: str, expected: str, weights: Path, touch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in complaint(["ask", touch, question, "--weights", str(weights)], capsys)


def test_describe_also_gives_the_models_caption_and_advice(
    weights: Path,
    touch: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saying(monkeypatch, GOOD)
    assert main(["describe", touch, "--weights", str(weights)]) == 0
    lines = dict(line.split(None, 1) for line in capsys.readouterr().out.splitlines())
    assert lines["caption"].startswith("an object, pressed")
    assert lines["model"] == GOOD
    assert lines["forces"] == "uncalibrated, -26 to +35 %, in the model's texts too"
    assert lines["asked"] == "Pick the strawberry gently, without bruising it."
    assert lines["advice"] == "decrease_force (confidence 0.93)"
    assert main(["describe", touch, "--weights", str(weights), "--instruction", "Hold it."]) == 0
    assert "asked     Hold it.\n" in capsys.readouterr().out


def test_describe_without_weights_measures_and_says_that_there_are_none(
    touch: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv(policy_factory.WEIGHTS_VARIABLE, raising=False)
    monkeypatch.setattr(policy_factory, "shipped_weights", lambda: tmp_path / "none")
    assert main(["describe", touch]) == 0
    said = capsys.readouterr().out
    assert "depth     moderate" in said
    assert f"model     none: no weights in {tmp_path / 'none'}" in said
    monkeypatch.setenv(policy_factory.WEIGHTS_VARIABLE, str(tmp_path / "named"))
    assert "weights are missing" in complaint(["describe", touch], capsys)  # somebody named these


def test_the_variable_goes_over_the_shipped_weights_and_the_flag_over_both(
    weights: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(policy_factory.WEIGHTS_VARIABLE, raising=False)
    assert policy_factory.default_weights() == ROOT / "policies" / "weights"
    monkeypatch.setenv(policy_factory.WEIGHTS_VARIABLE, "elsewhere")
    assert policy_factory.default_weights() == Path("elsewhere")
    assert policy_factory.load_llm(weights).name == "llm"


RUN = ["run", "--policy", "llm"]


@pytest.mark.parametrize(
    "argv",
    [
        RUN,
        ["bench", "strawberry", "--policies", "llm", "--episodes", "1"],
        ["bench", "latency", "--policies", "llm"],
    ],
)
def test_missing_weights_end_every_command_in_one_line(
    argv: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    message = complaint([*argv, "--weights", str(tmp_path / "none")], capsys)
    assert "weights are missing" in message
    assert "tacgrasp train all" in message


def test_truncated_weights_are_refused(copy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for part in ("encoder", "projector", "lm"):
        path = copy / part / "model.safetensors"
        whole = path.read_bytes()
        path.write_bytes(whole[: len(whole) // 2])
        message = complaint([*RUN, "--weights", str(copy)], capsys)
        assert str(copy / part) in message
        path.write_bytes(whole)


def test_a_tokenizer_of_another_version_is_refused(
    copy: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Words.train(["other words of another model"] * 5, size=300).save(copy / "lm")
    write_manifest(copy / "lm")
    assert "is not the one that" in complaint([*RUN, "--weights", str(copy)], capsys)
    (copy / "lm" / "tokenizer.json").write_text("{}")
    write_manifest(copy / "lm")
    assert "no tokenizer could be read" in complaint([*RUN, "--weights", str(copy)], capsys)


def test_weights_of_another_size_are_refused(
    copy: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    config = json.loads((copy / "projector" / "config.json").read_text())
    (copy / "projector" / "config.json").write_text(json.dumps({**config, "lm_dim": 96}))
    write_manifest(copy / "projector")
    assert "joins widths" in complaint([*RUN, "--weights", str(copy)], capsys)
    (copy / "projector" / "config.json").write_text(json.dumps({**config, "version": 0}))
    write_manifest(copy / "projector")
    assert "another version" in complaint([*RUN, "--weights", str(copy)], capsys)


@pytest.mark.parametrize(
    ("instruction", "expected"),
    [
        (" ", "refused: there are no words"),
        pytest.param(
            "pick " * 10_000,
            "refused: ",
        ),
        (
            "Hebe die Erdbeere vorsichtig hoch, ohne sie zu zerdrücken.",
            "refused: it is not in English",
        ),
        ("Levanta la fresa con cuidado sin aplastarla.", "refused: it is not in English"),
    ],
)
def test_an_instruction_that_it_cannot_know_is_refused_before_anything_moves(
    instruction: str,
    expected: str,
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    argv = [*RUN, "--weights", str(weights), "--record", str(tmp_path / "episodes")]
    assert expected in complaint([*argv, "--instruction", instruction], capsys)
    assert not (tmp_path / "episodes").exists()


def test_another_length_of_moves_than_in_training_is_refused_before_anything_moves(
    weights: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    argv = [*RUN, "--weights", str(weights), "--record", str(tmp_path / "episodes")]
    printed = complaint([*argv, "--primitives.move-step-mm", "5"], capsys)
    assert f"--primitives.move-step-mm is 5 mm, but the weights in {weights} were" in printed
    assert "trained with 3 mm" in printed
    assert not (tmp_path / "episodes").exists()


NO_ACTIONS = {
    "names nothing": ("A berry is a fine thing.", True),
    "is empty": ("", True),
    "names two": ("Action: <move_up>. Then <move_down>.", True),
    "says none and acts": ("Action: <none>. Move the gripper up.", True),
    "never ends": ("Action: <move_up>. It is off off off off off", False),
    "declares success and never ends": ("Action: <none>. The grasp is stable and", False),
    "is success without a choice": ("The grasp is stable.", True),
    "denies its action": ("Do not <move_up> now.", True),
}


@pytest.mark.parametrize("name", NO_ACTIONS)
def test_a_text_without_one_clear_action_is_held_and_ends_safely(
    name: str,
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text, ended = NO_ACTIONS[name]
    saying(monkeypatch, text, ended=ended)
    assert main([*RUN, "--weights", str(weights), "--record", str(tmp_path), "--seed", "1"]) == 1
    said = capsys.readouterr().out
    assert "end: no_action" in said
    assert "0 actions in" in said
    assert "the gripper has released" in said
    assert COMPLETED not in said


def test_a_clear_reply_acts(
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saying(monkeypatch, "Goal 0.95 - 1.90 N. Action: <increase_force>. It is too light.")
    argv = [*RUN, "--weights", str(weights), "--record", str(tmp_path), "--loop.max-steps", "1"]
    assert main(argv) == 1
    assert "→ increase_force: commanded" in capsys.readouterr().out


def test_a_clear_reply_against_what_is_felt_moves_nothing(
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saying(monkeypatch, GOOD)  # less force, at the first touch
    assert main([*RUN, "--weights", str(weights), "--record", str(tmp_path)]) == 1
    said = capsys.readouterr().out
    assert "decrease_force: " not in said
    assert "beyond the contract: less force, but" in said
    assert "end: no_action" in said


def test_a_run_of_the_model_is_decided_again_with_the_recorded_weights(
    weights: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*RUN, "--weights", str(weights), "--record", str(tmp_path)]) == 1
    episode = str(next(tmp_path.glob("*.mcap")))
    assert main(["replay", episode, "--decide"]) == 0
    assert "reproduced exactly" in capsys.readouterr().out
    argv = ["replay", episode, "--decide", "--weights", str(tmp_path / "none")]
    assert "weights are missing" in complaint(argv, capsys)
    assert "--weights needs --decide" in complaint(
        ["replay", episode, "--weights", str(weights)], capsys
    )


def test_latency_puts_every_stage_beside_its_floor_and_transformers_beside_ours(
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(bench_language, "start_to_first_action_s", lambda *_: 4.5)
    figures = tmp_path / "latency.json"
    argv = ["bench", "latency", "--policies", "llm", "--weights", str(weights), "--ticks", "3"]
    argv += ["--contacts", "4"]
    assert main([*argv, "--json", str(figures)]) == 0
    found = json.loads(figures.read_text())
    stages = ["sample", "encode", "project", "read", "prefill", "generate", "extract", "record"]
    assert list(found["stages_ms"]) == stages
    assert set(found["floors"]) == {"encode", "project", "prefill"}
    assert (found["contacts"], found["same_without_draft"], found["same_in_32_bits"]) == (4, 4, 4)
    assert found["precision"] in ("bfloat16", "float32")
    assert found["tick_ms_in_32_bits"].keys() == {"p50", "p99"}
    assert found["tokens"]["p50"] > 40
    assert 1 <= found["passes"]["p50"] <= found["tokens"]["p50"]
    assert found["speedup_cached"] > 0
    assert found["start_to_first_action_s"] == 4.5
    assert "tokens said" in capsys.readouterr().out


def test_a_run_that_comes_to_no_turn_is_told_with_what_it_said(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="weights are missing"):
        bench_language.start_to_first_action_s("strawberry", tmp_path / "none")


def test_the_benchmark_takes_the_model_and_reads_it_once(weights: Path) -> None:
    config = load("strawberry")[0].model_copy(update={"weights": weights})
    before = language_model.cache_info().misses
    for seed in (5, 6):
        (result,) = bench_strawberry.run_seed(config, [("llm", None)], seed)
        assert result.reason == "no_action"
        assert not result.verified
    assert language_model.cache_info().misses == before + 1


def test_deciding_does_not_load_transformers(weights: Path) -> None:
    """Its import takes longer than a person should wait for the first action."""
    code = (
        "import sys; from pathlib import Path; from tacgrasp.policy_factory import load_llm; "
        f"load_llm(Path({str(weights)!r})); print('transformers' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout.strip() == "False", done.stderr


class Trainer:
    """Notes which stages were carried out, and writes what each would."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, weights: Path) -> None:
        self.carried_out: list[tuple[str, Path]] = []
        self.blind: bool | None = None

        def stage(name: str, *parts: str):  # type: ignore[no-untyped-def]
            def carry_out(run: TrainingRun, *args: object, **_: object) -> None:
                self.carried_out.append((name, run.out))
                if name == "llm":
                    self.blind = args[1]._blind  # type: ignore[attr-defined]
                for part in parts:
                    shutil.copytree(weights / part, run.out / part, dirs_exist_ok=True)

            return carry_out

        monkeypatch.setattr(train, "generate", lambda r: r.out.exists() or make_data(r.out))
        for module in (train, methods_module):
            monkeypatch.setattr(module, "train_words", lambda *_, **__: None)
        monkeypatch.setattr(methods_module, "train_clip", stage("clip", "clip"))
        monkeypatch.setattr(methods_module, "train_cltp", stage("cltp", "encoder"))
        monkeypatch.setattr(train, "train_llm", stage("llm", "projector", "lm"))


def test_train_all_carries_out_the_stages_in_order_and_writes_a_card(
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    trainer, out, data = Trainer(monkeypatch, weights), tmp_path / "w", tmp_path / "data"
    argv = ["train", "all", "--out", str(out), "--data", str(data), "--contacts", "40"]
    assert main([*argv, "--threads", "1"]) == 0
    pretrained = out / ".training" / "methods"
    stages = [("clip", pretrained), ("cltp", pretrained / "cltp"), ("llm", out)]
    assert trainer.carried_out == stages
    assert not trainer.blind
    printed = capsys.readouterr().out
    for stage, folder in (("clip", "clip"), ("cltp", "cltp/encoder")):
        assert f"{stage}: writing {pretrained / folder}\n" in printed
    assert f"llm: writing {out}\n" in printed
    for part in train.PARTS:
        same = (out / part / "model.safetensors").read_bytes()
        assert same == (weights / part / "model.safetensors").read_bytes()
    card = out / "README.md"
    checksum = ContactDataset(data).checksum()
    command = shlex.join(["tacgrasp", *argv, "--threads", "1"])
    pretraining = "`tacgrasp train all --contacts 40 --seed 0`: grid, 5000 steps"
    for fact in (f"| command | `{command}` |", pretraining, checksum, "| size | "):
        assert fact in card.read_text()
    card.write_text(card.read_text() + "scored")
    assert main([*argv, "--threads", "2"]) == 0  # nothing was left to do: the card keeps its scores
    assert card.read_text().endswith("scored")


def test_a_blind_copy_stands_behind_the_same_encoder_in_a_folder_of_its_own(
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    trainer, out = Trainer(monkeypatch, weights), tmp_path / "blind"
    data = ["--data", str(tmp_path / "data")]
    argv = ["train", "llm", "--out", str(out), "--blind-of", str(weights), *data]
    assert main(argv) == 0
    assert trainer.blind
    assert trainer.carried_out == [("llm", out)]
    same = (out / "encoder" / "model.safetensors").read_bytes()
    assert same == (weights / "encoder" / "model.safetensors").read_bytes()
    capsys.readouterr()
    assert "an instruction-blind copy" in complaint(["train", "llm", "--out", str(out)], capsys)
    onto = ["train", "llm", "--out", str(weights), "--blind-of", str(weights)]
    assert "weights that see" in complaint(onto, capsys)


@pytest.fixture
def methods(weights: Path, tmp_path: Path) -> Path:
    """CLTP as if it had been pre-trained with a budget."""
    folder = tmp_path / "methods"
    shutil.copytree(weights / "clip", folder / "clip")
    shutil.copytree(weights / "encoder", folder / "cltp" / "encoder")
    about = {"command": "tacgrasp train cltp --steps 9", "preset": "tiny", "steps": 9}
    about |= {"batch_size": 4, "data": "abcdef", "seed": 0, "recipe": None}
    (folder / "cltp" / "about.json").write_text(json.dumps(about))
    return folder


def test_a_language_model_stands_behind_an_encoder_that_was_pretrained(
    weights: Path,
    methods: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    trainer, out = Trainer(monkeypatch, weights), tmp_path / "weights"
    argv = ["train", "llm", "--out", str(out), "--methods", str(methods)]
    argv += ["--data", str(tmp_path / "data")]
    assert main(argv) == 0
    assert trainer.carried_out == [("llm", out)]
    for part in ("clip", "encoder"):
        same = (out / part / "model.safetensors").read_bytes()
        assert same == (weights / part / "model.safetensors").read_bytes()
    card = (out / "README.md").read_text()
    assert "`tacgrasp train cltp --steps 9`: tiny, 9 steps of 4, data checksum abcdef" in card
    assert main(argv) == 0  # and goes on
    about = methods / "cltp" / "about.json"
    about.write_text(about.read_text().replace("abcdef", "fedcba"))
    assert "holds another encoder" in complaint(argv, capsys)
    (methods / "cltp" / "about.json").unlink()
    assert "was not trained" in complaint(argv, capsys)


def test_taking_an_encoder_goes_on_where_it_was_stopped(
    methods: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "weights"
    whole = shutil.copyfileobj

    for part in (".clip.part", ".encoder.part"):

        def stopped(source: BinaryIO, to: BinaryIO, part: str = part) -> None:
            if Path(to.name).parent.name == part and "model" in Path(to.name).name:
                raise KeyboardInterrupt
            whole(source, to)

        monkeypatch.setattr(shutil, "copyfileobj", stopped)
        with pytest.raises(KeyboardInterrupt):
            train.take_pretrained(methods, out)
        assert not (out / "encoder").exists()
    monkeypatch.setattr(shutil, "copyfileobj", whole)
    train.take_pretrained(methods, out)
    assert sorted(path.name for path in out.iterdir()) == ["clip", "encoder"]
    load_clip(out / "clip")


@pytest.mark.parametrize(
    "argv", ["llm --encoder {from}", "llm --methods {methods}", "cltp --start {from}"]
)
def test_a_copy_onto_a_full_disk_is_told_in_one_line_and_leaves_nothing(
    argv: str,
    weights: Path,
    methods: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    data = make_data(tmp_path / "data", num=12)
    monkeypatch.setattr(shutil, "copyfileobj", full)
    out = tmp_path / "out"
    flags = argv.format(**{"from": weights, "methods": methods}).split()
    places = ["--data", str(data), "--out", str(out), "--threads", "1"]
    said = complaint(["train", *flags, *places], capsys)
    assert f"{out / '.clip.part'}/" in said
    assert "can't be used: No space left on device; free space" in said
    assert not list(out.glob("*"))


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        ([], "expects one of clip, cltp, llm, all, point-mae"),
        (["all", "--methods", "m"], "unknown arguments: --methods m"),
        (["everything"], "got 'everything'"),
        (["all", "--threads", "0"], "--threads must be at least 1"),
        (["all", "--contacts", "0"], "at least 1 contact"),
        (["all", "--blind-of", "w"], "unknown arguments: --blind-of w"),
        (["llm", "--blind-of", "w", "--methods", "m"], "exclude each other"),
        (["llm", "--blind-of", "nowhere"], "weights are missing: nowhere/encoder"),
        (["all", "--ouy", "w"], "did you mean --out"),
    ],
)
def test_wrong_use_of_train_is_told_in_one_line(
    argv: list[str],
    expected: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert expected in complaint(["train", *argv], capsys)


def test_weights_cannot_be_asked_about_without_words(weights: Path) -> None:
    with pytest.raises(PolicyError, match="in words"):
        LlmPolicy(weights).check("?!")
