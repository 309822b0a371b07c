"""One command makes one row: trained or taken up, measured, written into one file."""

import dataclasses
import json
from functools import partial
from pathlib import Path

import pytest
import torch

from cltp.checkpoints.tac3d_llm import save_pretrained
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.encoder.clip_towers import small_clip
from cltp.errors import TouchError
from cltp.evaluation.probes import SCHEDULE, ProbeTraining
from cltp.tactile.states import CLASSES
from cltp.texts.paraphrases import prompts
from cltp.texts.tokenizer import Words
from cltp.train.recipes import Schedule
from cltp.train.stage import Stage
from tacgrasp.__main__ import main
from tacgrasp.pretraining import evaluation_run, make_row
from tacgrasp.pretraining.make_row import RowRequest
from tacgrasp.pretraining.report.row_file import RowFile, load_rows
from tacgrasp.pretraining.report.rows import ROWS
from tacgrasp.pretraining.work_clock import WorkClock
from tests.fakes.fake_contacts import fake_contact

PRECISION = ("--precision", "no")
"""That of all other tests: accelerate takes one for a whole process."""

pytestmark = pytest.mark.usefixtures("threads_as_before")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    with DatasetWriter(folder) as writer:
        for seed in range(10):
            writer.add(fake_contact(seed))
        for seed in range(100, 105):
            writer.add(fake_contact(seed, split=Split.VALIDATION))
        for seed in range(200, 206):
            writer.add(fake_contact(seed, split=Split.TEST))
    return folder


@pytest.fixture(scope="module")
def clip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with random towers of the usual sizes."""
    torch.manual_seed(0)
    texts = [
        text for slot, names in CLASSES.items() for name in names for text in prompts(slot, name)
    ]
    words = Words.train(texts * 2, 500)
    folder = tmp_path_factory.mktemp("towers") / "clip"
    save_pretrained(folder, small_clip(words, dim=32, layers=1), words)
    return folder


@pytest.fixture
def row(data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):  # type: ignore[no-untyped-def]
    """Runs ``eval row`` with short probes and gives the file."""
    quick = Schedule(steps=5, batch_size=8, learning_rate=SCHEDULE.learning_rate)
    monkeypatch.setattr(evaluation_run, "ProbeTraining", partial(ProbeTraining, schedule=quick))

    def made(name: str, *flags: str) -> RowFile:
        places = ["--data", str(data), "--out", str(tmp_path / "rows")]
        results = ["--results", str(tmp_path / "results"), "--threads", "1", *PRECISION]
        assert main(["eval", "row", name, *places, *results, *flags]) == 0
        files = {each.row: each for each in load_rows(tmp_path / "results")}
        return files[name.replace("-", "_")]

    return made


def complaint(argv: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    capsys.readouterr()
    assert main(["eval", "row", *argv]) == 2
    *_, last = capsys.readouterr().err.splitlines()
    return str(last)


def test_a_row_is_trained_measured_and_written_and_not_trained_again(
    row,  # type: ignore[no-untyped-def]
    data: Path,
    clip: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    even = dataclasses.replace(ROWS["cltp_even"], preset="tiny")
    monkeypatch.setitem(ROWS, "cltp_even", even)  # type: ignore[index]
    monkeypatch.setattr(Stage, "plot", lambda _: None)
    group = tmp_path / "rows" / "paper-seed3-128-samples-4-contacts-precision-no"
    group.mkdir(parents=True)
    (group / "clip").symlink_to(clip)
    flags = ("--seed", "3", "--samples", "128", "--limit", "4")
    first = row("cltp-even", *flags)
    checksum = ContactDataset(data).checksum()
    assert (first.seed, first.samples, first.points) == (3, 128, 1024)
    assert first.data == first.learned_from == checksum  # this set names no maker
    assert first.checksums == {"data": checksum, "learned_from": checksum}
    command = "tacgrasp eval row cltp-even --seed 3 --samples 128 --limit 4 --precision no"
    assert first.command == command
    assert first.minutes["train"] is not None
    assert first.minutes["measure"] is not None
    assert (first.minutes["clip"], first.total_minutes) == (None, None)  # it was taken up
    scores = first.scores
    assert set(scores) == {
        *("zero_shot", "zero_shot_ensemble", "zero_shot_unseen", "zero_shot_synonyms"),
        *("probe", "numbers", "retrieval"),
    }
    assert set(scores["zero_shot"]["cltp"]["contact"]) == set(CLASSES)
    assert set(scores["numbers"]["contact_noisy"]["depth"]) == {"median_error", "inside", "width"}
    assert first.contacts == {"contact": 4, "contact_noisy": 4}
    assert str(tmp_path) not in (tmp_path / "results/cltp_even-seed3.json").read_text()
    weights = group / "cltp_even/encoder/model.safetensors"
    before = weights.stat().st_mtime_ns
    again = row("cltp-even", *flags)
    assert weights.stat().st_mtime_ns == before
    assert again.scores == first.scores
    assert again.minutes == first.minutes  # what is done again is not counted

    about = weights.parents[1] / "about.json"
    about.write_text(about.read_text().replace(checksum, "0" * 64))
    (weights.parents[1] / "minutes.json").unlink()
    places = ["--data", str(data), "--out", str(tmp_path / "rows"), "--results", str(tmp_path)]
    text = complaint(["cltp-even", *places, *flags, "--threads", "1", *PRECISION], capsys)
    assert "test contacts could have been learned from" in text


def test_rows_without_an_encoder_are_measured_alone(row) -> None:  # type: ignore[no-untyped-def]
    measured = row("geometric-baseline")
    assert set(measured.scores) == {"zero_shot", "probe"}
    five = measured.scores["probe"]["geometric_baseline"]["contact"]
    assert (five["shape"], five["texture"]) == (None, None)
    assert five["depth"] > 30
    assert (measured.samples, measured.learned_from, measured.points) == (0, None, 1024)
    assert set(measured.minutes) == {"measure"}


def test_each_row_asks_for_its_own_training(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: dict[str, object] = {}

    class EnoughError(Exception):
        pass

    def noted(method, run, schedule, *, preset, recipe, name):  # type: ignore[no-untyped-def]
        asked.update(method=method, preset=preset, recipe=recipe, steps=schedule.steps)
        asked.update(data=run.data, folder=run.out / name)
        raise EnoughError

    def clip_noted(run, recipe, schedule) -> None:  # type: ignore[no-untyped-def]
        asked.update(clip=recipe, clip_steps=schedule.steps, clip_folder=run.out)

    monkeypatch.setattr(make_row, "pretrain", noted)
    monkeypatch.setattr(make_row, "pretrain_clip", clip_noted)
    folders = set()
    trained = {name: each for name, each in ROWS.items() if each.samples and not each.behind}
    for name, recipe in trained.items():
        asked.clear()
        request = RowRequest(
            name=name,
            seed=1,
            data=data,
            full=data,
            out=tmp_path / name,
            results=tmp_path,
            precision="no",
        )
        with pytest.raises(EnoughError):
            make_row.make_row(request)
        assert asked["method"] == recipe.method
        assert asked["recipe"] == recipe.recipe
        assert asked["steps"] == recipe.samples / 64
        folders.add(Path(str(asked["folder"])).relative_to(tmp_path / name))
        if name in ("point_bert", "point_mae"):
            assert "clip" not in asked  # they learn from points alone
        else:
            assert (asked["clip"], asked["clip_steps"]) == (recipe.clip, 700)
    assert Path("paper-captions-seed1-precision-no/papers_losses") in folders
    assert Path("full-seed1-precision-no/cltp_full") in folders
    assert len(folders) == len(trained)


def test_work_adds_up_over_interruptions(tmp_path: Path) -> None:
    now_s = [100.0]
    path = tmp_path / "minutes.json"
    clock = WorkClock(path, lambda: now_s[0])
    report = clock.watched(lambda *_: None)
    with clock.part("train"):
        now_s[0] += 30
        report("cltp", 1, 2, {})  # written, since 10 s have passed
        now_s[0] += 5
        assert json.loads(path.read_text()) == {"train": 30.0}  # what a kill would leave
    now_s[0] += 1000  # nothing is done
    later = WorkClock(path, lambda: now_s[0])
    with pytest.raises(KeyboardInterrupt), later.part("train"):
        now_s[0] += 25
        raise KeyboardInterrupt
    assert WorkClock(path).minutes("train") == 1.0
    assert WorkClock(path).minutes("measure") is None
    WorkClock(path).finish()
    again = WorkClock(path, lambda: now_s[0])
    with again.part("train"):
        now_s[0] += 60
    assert WorkClock(path).minutes("train") == 1.0  # it was finished before
    path.write_text("{")
    with pytest.raises(TouchError, match="delete it"):
        WorkClock(path)


def test_all_rows_are_listed_with_their_commands(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["eval", "row", "--results", str(tmp_path)]) == 0
    text = capsys.readouterr().out
    assert "missing: tacgrasp eval row cltp --seed 2" in text
    assert all(name.replace("_", "-") in text for name in ROWS)


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["dance"], "no row 'dance'; rows are cltp, cltp_even"),
        (["cltp", "--data", "/none"], "make them: tacgrasp data generate --set paper"),
        (["all", "--data", "{data}"], "make them: tacgrasp data generate --set full"),
        (["cltp", "--results", "/none/at/all"], "/none/at is not a folder"),
        (["cltp", "--samples", "0"], "--samples must be at least 1, got 0"),
        (["cltp", "--seed", "-1"], "--seed must be at least 0, got -1"),
    ],
)
def test_wrong_use_is_told_in_one_line(
    argv: list[str],
    expected: str,
    data: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    results = [] if "--results" in argv else ["--results", str(tmp_path)]
    full = ["--full", str(tmp_path / "none")]
    filled = [each.format(data=data) for each in argv]
    assert expected in complaint([*filled, *results, *full], capsys)
