"""A language model of others on the command line: trained, run and asked."""

import json
import shutil
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.manifest import write_manifest
from cltp.data.contact import Split
from tacgrasp import policy_factory
from tacgrasp.__main__ import main
from tacgrasp.episodes import read_episode
from tacgrasp.training import train
from tests.fakes.fake_contacts import write_contacts
from tests.fakes.stock_lm import KINDS, save_stock_lm
from tests.fakes.tiny_weights import bump

pytestmark = pytest.mark.usefixtures("threads_as_before")

FEW = ["--projector-steps", "1", "--tune-steps", "2", "--batch-size", "2"]
needs_peft = pytest.mark.skipif(
    find_spec("peft") is None, reason="adapters need peft: pip install 'tacgrasp[lora]'"
)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_contacts(tmp_path_factory.mktemp("data"), {Split.TRAIN: range(8)})


@pytest.fixture
def made(data: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Flags of training on contacts that are there already."""
    monkeypatch.setattr(train, "generate", lambda request: None)
    monkeypatch.setattr(train, "check_trainable", lambda data: None)
    monkeypatch.setattr(policy_factory, "stock_threads", lambda: 1)  # it is tiny here
    return ["--data", str(data), "--threads", "1", *FEW]


def complaint(argv: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(argv) == 2
    printed = capsys.readouterr().err
    assert printed.startswith("tacgrasp: ")
    assert printed.count("\n") == 1
    return printed


@needs_peft
@pytest.mark.parametrize("kind", KINDS)
def test_any_local_qwen_is_trained_run_and_asked(
    kind: str,
    weights: Path,
    made: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    base, out = save_stock_lm(tmp_path / "base", kind), tmp_path / "out"
    argv = ["train", "llm", "--lm", str(base), "--encoder", str(weights), "--out", str(out)]
    assert main([*argv, *made]) == 0
    card = (out / "README.md").read_text()
    assert f"the {kind} in `{base}`" in card
    assert "base_model: ['base']" in card
    (out / "README.md").write_text(card + "scored")
    assert main([*argv, *made]) == 0  # nothing is left to do: the card keeps its scores
    assert (out / "README.md").read_text().endswith("scored")
    capsys.readouterr()

    run = ["run", "--policy", "llm", "--llm.dir", str(out), "--loop.max-steps", "1"]
    assert main([*run, "--loop.max-asks", "1", "--record", str(tmp_path / "record")]) in (0, 1)
    (path,) = (tmp_path / "record").glob("*.mcap")
    texts = [step.decision.text for step in read_episode(path).steps if step.decision is not None]
    assert texts
    assert "Action: <" in texts[0]
    capsys.readouterr()

    touch = tmp_path / "touch.npy"
    np.save(touch, bump(1.0, -2.0, 0.5))
    ask = ["ask", str(touch), "How deep is it pressed?", "--json", "--llm.dir", str(out)]
    assert main(ask) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["answer"].endswith(".")
    assert said["query"]
    assert 0 < said["confidence"] <= 1


def test_the_folder_of_the_language_model_is_named_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one, other = str(tmp_path / "one"), str(tmp_path / "other")
    both = ["--weights", one, "--llm.dir", other]
    assert "give one" in complaint(["run", "--policy", "llm", *both], capsys)
    assert "give one" in complaint(["ask", "touch.npy", "How deep?", *both], capsys)
    assert f"{one} is not a folder" in complaint(["run", "--llm.dir", one], capsys)


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (
            ["--lm", "nowhere"],
            "weights has no encoder to train behind; take one by --encoder shipped",
        ),
        (["--lm", "nowhere", "--encoder", "w"], "nowhere: it is not a directory"),
        (["--start", "nowhere", "--encoder", "w"], "weights are missing: nowhere/encoder"),
        (["--language", "nowhere", "--encoder", "w"], "weights are missing: nowhere/encoder"),
        (["--start", "shipped"], "weights has no encoder to train behind"),
        (["--lm", "m", "--start", "w"], "--lm and --start both name a language model"),
        (["--language", "v", "--start", "w"], "--start and --language both name a language model"),
        (["--tune", "all"], "--tune is for a language model of others; name its directory"),
        (["--lm", "m", "--lora-rank", "0"], "lora_rank must be above 0"),
        (["--encoder", "w", "--methods", "m"], "--methods and --encoder exclude each other"),
    ],
)
def test_wrong_use_is_told_in_one_line(
    argv: list[str],
    expected: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert expected in complaint(["train", "llm", *argv], capsys)


def test_a_moved_base_is_named_by_a_command(
    weights: Path,
    made: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    base, out = save_stock_lm(tmp_path / "base", "qwen2"), tmp_path / "out"
    monkeypatch.setattr(policy_factory, "shipped_weights", lambda: weights)
    argv = ["train", "llm", "--lm", str(base), "--encoder", "shipped", "--out", str(out)]
    assert main([*argv, *made, "--tune", "projector"]) == 0
    capsys.readouterr()
    onto = ["train", "llm", "--start", str(out), "--out", str(tmp_path / "new")]
    assert "was trained behind a language model of others" in complaint(onto, capsys)
    moved = base.rename(tmp_path / "moved")
    touch = tmp_path / "touch.npy"
    np.save(touch, bump(1.0, -2.0, 0.5))
    ask = ["ask", str(touch), "How deep?", "--weights", str(out)]
    capsys.readouterr()
    assert f"tacgrasp train base --weights {out} --lm DIR" in complaint(ask, capsys)
    assert main(["train", "base", "--weights", str(out), "--lm", str(moved)]) == 0
    assert f"the qwen2 in {moved}" in capsys.readouterr().out
    assert main(ask) == 0


def test_an_encoder_without_heads_gets_some(
    weights: Path, made: list[str], data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from cltp.checkpoints.frozen import load_frozen, save_frozen
    from cltp.checkpoints.tac3d_llm import load_encoder

    method, out = tmp_path / "point_mae", tmp_path / "out"
    save_frozen(method / "encoder", load_encoder(weights / "encoder")[0], "point_mae")
    base = save_stock_lm(tmp_path / "base", "qwen2")
    argv = ["train", "llm", "--lm", str(base), "--tune", "projector", "--out", str(out), *made]
    assert main([*argv, "--encoder", str(method), "--heads-steps", "2"]) == 0
    encoder, heads = load_encoder(out / "encoder")
    assert heads.has_intervals
    same = load_frozen(method / "encoder").encoder.state_dict()
    for name, weight in encoder.state_dict().items():
        torch.testing.assert_close(weight, same[name], rtol=1e-3, atol=1e-4)  # 16 bits
    source = json.loads((out / "encoder" / "source.json").read_text())
    assert source["method"] == "point_mae"
    assert source["heads"] == "fitted in 2 steps of 64"
    other = tmp_path / "other"
    shutil.copytree(method, other)
    config = json.loads((other / "encoder" / "config.json").read_text())
    (other / "encoder" / "config.json").write_text(json.dumps({**config, "method": "point_bert"}))
    write_manifest(other / "encoder")
    capsys.readouterr()
    assert "holds another encoder" in complaint([*argv, "--encoder", str(other)], capsys)
