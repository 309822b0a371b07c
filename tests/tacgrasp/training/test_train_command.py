"""``tacgrasp train``: one trainer and one data set for each stage, whichever flags are present."""

import inspect
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from cltp.train.distributed import Workers
from cltp.train.recipes import (
    ALSO_FRACTION,
    CLIP_SCHEDULE,
    CLTP_SCHEDULE,
    CLTP_TUNING,
    ClipRecipe,
    CltpRecipe,
    Schedule,
)
from tacgrasp.__main__ import main
from tacgrasp.policy_factory import shipped_weights
from tacgrasp.pretraining import methods
from tests.fakes.tiny_weights import make_data

SHARED = [
    [],
    ["--seed", "3"],
    ["--precision", "bf16"],
    ["--threads", "1"],
    ["--steps", "7"],
    ["--batch-size", "8"],
    ["--texts", "caption"],
    ["--prompt-weight", "0.5"],
]
CLIP_FLAGS = [*SHARED, ["--read-weight", "0"]]
CLTP_FLAGS = [
    *SHARED,
    ["--preset", "small"],
    ["--head-weight", "0"],
    ["--moved", "0.3"],
    ["--coarse", "0.08"],
    ["--also", "{data}"],
]


@pytest.fixture
def data(tmp_path: Path) -> Path:
    return make_data(tmp_path / "data", num=4)


class Trainers:
    """Notes the arguments of every trainer in the place of training."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.calls: list[tuple[str, inspect.BoundArguments]] = []

        def noted(name: str):  # type: ignore[no-untyped-def]
            signature = inspect.signature(getattr(methods, name))

            def note(*args: Any, **kwargs: Any) -> None:
                bound = signature.bind(*args, **kwargs)
                bound.arguments["run"].out.mkdir(parents=True, exist_ok=True)
                self.calls.append((name, bound))

            return note

        for name in ("train_clip", "train_cltp", "train_baseline"):
            monkeypatch.setattr(methods, name, noted(name))
        monkeypatch.setattr(methods, "train_words", lambda *_, **__: "words")
        monkeypatch.setattr(methods, "joined_workers", lambda precision: Workers())
        monkeypatch.setattr(methods.torch, "set_num_threads", lambda _: None)

    def arguments(
        self, stage: str, data: Path, out: Path, flags: list[str]
    ) -> tuple[str, dict[str, Any]]:
        """The trainer that a command calls, and its arguments."""
        places = ["--data", str(data), "--out", str(out)]
        assert main(["train", stage, *places, *(flag.format(data=data) for flag in flags)]) == 0
        ((name, bound),) = self.calls
        return name, bound.arguments


@pytest.mark.parametrize("flags", CLIP_FLAGS, ids=" ".join)
def test_clip_is_one_trainer_on_one_data_set_whichever_flags_are_present(
    flags: list[str], data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    name, arguments = Trainers(monkeypatch).arguments("clip", data, out, flags)
    run = arguments["run"]
    assert (name, run.data, run.out, arguments["words"]) == ("train_clip", data, out, "words")
    changed = [
        arguments["recipe"] != ClipRecipe(),
        arguments["schedule"] != CLIP_SCHEDULE,
        run.seed != 0,
    ]
    assert sum(changed) == (flags[:1] not in ([], ["--precision"], ["--threads"]))


@pytest.mark.parametrize("flags", CLTP_FLAGS, ids=" ".join)
def test_cltp_is_one_trainer_on_one_data_set_whichever_flags_are_present(
    flags: list[str], data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    name, arguments = Trainers(monkeypatch).arguments("cltp", data, out, flags)
    run = arguments["run"]
    assert (name, run.data, run.out) == ("train_cltp", data, out / "cltp")
    assert (arguments["clip_dir"], arguments["with_images"]) == (out / "clip", True)
    assert arguments["augmentation"] == methods.LEARNING_NOISE
    changed = [
        arguments["recipe"] != CltpRecipe(),
        arguments["schedule"] != CLTP_SCHEDULE,
        arguments["config"] != methods.PRESETS["grid"],
        run.also != (),
        run.seed != 0,
    ]
    assert sum(changed) == (flags[:1] not in ([], ["--precision"], ["--threads"]))


def test_without_image_is_the_papers_ablation_in_a_folder_of_its_own(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    name, arguments = Trainers(monkeypatch).arguments("cltp", data, tmp_path, ["--no-image"])
    folder = tmp_path / "cltp_no_image"
    assert (name, arguments["run"].out) == ("train_cltp", folder)
    assert not arguments["with_images"]
    assert f"cltp_no_image: writing {folder / 'encoder'}\n" in capsys.readouterr().out


def test_the_flags_of_a_recipe_and_a_schedule_arrive_whole(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flags = ["--texts", "caption", "--prompt-weight", "0.5", "--head-weight", "0.25"]
    flags += ["--moved", "0.5", "--steps", "7", "--batch-size", "8"]
    _, arguments = Trainers(monkeypatch).arguments("cltp", data, tmp_path, flags)
    assert arguments["recipe"] == CltpRecipe(
        texts="caption", prompt_weight=0.5, head_weight=0.25, moved=0.5
    )
    assert arguments["schedule"] == replace(CLTP_SCHEDULE, steps=7, batch_size=8)


@pytest.mark.parametrize(
    ("flags", "schedule", "fraction"),
    [
        ([], CLTP_SCHEDULE, None),
        (["--also", "{data}"], CLTP_SCHEDULE, None),
        (["--also", "{data}", "--also-fraction", "0.2"], CLTP_SCHEDULE, 0.2),
        (["--start", "shipped"], CLTP_TUNING, None),
        (["--start", "shipped", "--also", "{data}"], CLTP_TUNING, ALSO_FRACTION),
        (
            ["--start", "shipped", "--steps", "9", "--learning-rate", "1e-4"],
            replace(CLTP_TUNING, steps=9, learning_rate=1e-4),
            None,
        ),
    ],
)
def test_training_on_is_shorter_slower_and_mixes_both_sets(
    flags: list[str],
    schedule: Schedule,
    fraction: float | None,
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    _, arguments = Trainers(monkeypatch).arguments("cltp", data, tmp_path / "out", flags)
    assert arguments["schedule"] == schedule
    assert arguments["run"].also_fraction == fraction
    encoder = shipped_weights() / "encoder"
    assert arguments["start"] == (encoder if "--start" in flags else None)
    assert (tmp_path / "out" / "clip").exists() == ("--start" in flags)  # its towers come along


@pytest.mark.parametrize("stage", ["cltp", "llm"])
@pytest.mark.parametrize(
    ("flags", "expected"),
    [
        (["--also-fraction", "0.5"], "name it with --also"),
        (["--also", "d", "--also-fraction", "1"], "must lie between 0 and 1, got 1"),
        (["--also", "d", "--also-fraction", "0"], "must lie between 0 and 1, got 0"),
    ],
)
def test_a_fraction_that_is_no_mixture_is_refused(
    stage: str, flags: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["train", stage, *flags]) == 2
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize("stage", ["clip", "cltp", "point-mae", "random"])
def test_pre_training_never_generates_its_data(
    stage: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["train", stage, "--data", str(tmp_path / "none"), "--out", str(tmp_path)]) == 2
    assert "is no data set of contacts" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("stage", "flag"),
    [
        ("clip", "--head-weight 1"),
        ("clip", "--moved 0.1"),
        ("clip", "--preset tiny"),
        ("clip", "--contacts 40"),
        ("clip", "--methods m"),
        ("cltp", "--read-weight 1"),
        ("cltp", "--clip-steps 5"),
        ("cltp", "--contacts 40"),
        ("cltp", "--blind-of w"),
        ("cltp", "--results r"),
        ("point-mae", "--texts caption"),
        ("point-mae", "--also d"),
        ("tvl", "--no-image"),
        ("random", "--steps 5"),
        ("llm", "--steps 5"),
        ("llm", "--preset tiny"),
        ("all", "--texts caption"),
        ("all", "--methods m"),
        ("all", "--blind-of w"),
    ],
)
def test_a_flag_of_another_stage_is_refused_by_name(
    stage: str, flag: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["train", stage, *flag.split()]) == 2
    assert f"unknown arguments: {flag}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["clip", "--read-weight", "-1"], "read_weight must be at least 0, got -1"),
        (["cltp", "--prompt-weight", "-1"], "prompt_weight must be at least 0, got -1"),
        (["cltp", "--head-weight", "-1"], "head_weight must be at least 0, got -1"),
        (["cltp", "--contrast-weight", "-1"], "contrast_weight must be at least 0, got -1"),
        (
            ["cltp", *(f"--{name}-weight=0" for name in ("contrast", "prompt", "head"))],
            "contrast_weight, prompt_weight and head_weight can't all be 0",
        ),
        (["random", "--threads", "0"], "--threads must be at least 1, got 0"),
        (["cltp", "--steps", "0"], "--steps must be at least 1, got 0"),
        (["clip", "--batch-size", "-2"], "--batch-size must be at least 1, got -2"),
        (["cltp", "--learning-rate", "0"], "--learning-rate must be above 0, got 0"),
        (["llm", "--heads-steps", "0"], "--heads-steps must be at least 1, got 0"),
    ],
)
def test_a_value_out_of_range_is_refused(
    argv: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["train", *argv]) == 2
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize("stage", ["clip", "cltp", "llm", "all", "queries"])
def test_a_file_as_the_folder_to_write_is_called_one(
    stage: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "afile"
    file.write_text("mine")
    assert main(["train", stage, "--out", str(file)]) == 2
    assert f"--out {file} is a file, not a folder; name a" in capsys.readouterr().err
    assert main(["train", stage, "--out", str(file / "below")]) == 2
    assert f"--out {file / 'below'}: {file} is a file" in capsys.readouterr().err
    assert file.read_text() == "mine"


def test_data_to_be_made_in_the_place_of_a_file_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "afile"
    file.write_text("mine")
    assert main(["train", "all", "--data", str(file), "--out", str(tmp_path / "out")]) == 2
    assert f"the data set {file} is a file, not a folder" in capsys.readouterr().err
