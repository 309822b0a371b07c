"""Training on one's own contacts: what is mixed, and the table before and after."""

import dataclasses
import json
import re
from pathlib import Path
from typing import Any

import pytest

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.train.recipes import ALSO_FRACTION
from cltp.train.stage import TrainingRun
from tacgrasp.__main__ import main
from tacgrasp.training import train
from tests.fakes.fake_contacts import fake_contact
from tests.fakes.tiny_weights import make_data, make_weights

pytestmark = pytest.mark.usefixtures("one_thread")

MEASURED = frozenset({"depth", "position", "area", "force_n"})


def write_own(folder: Path, *, test: int = 4, measured: frozenset[str] = MEASURED) -> Path:
    """Six contacts as an import writes them, ``test`` of them held out, the first without shape."""
    with DatasetWriter(folder, about={"made_by": "tacgrasp data import"}) as writer:
        for seed in range(6):
            split = Split.TEST if seed < test else Split.TRAIN
            contact = dataclasses.replace(fake_contact(seed, split=split), measured=measured)
            if seed == 0:
                state = dataclasses.replace(contact.state, shape=None)
                contact = dataclasses.replace(contact, state=state)
            writer.add(contact)
    return folder


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_data(tmp_path_factory.mktemp("ours"), num=8)


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_own(tmp_path_factory.mktemp("own"))


@pytest.fixture(scope="module")
def other(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_weights(tmp_path_factory.mktemp("other"), seed=5)


def evaluated(tmp_path: Path, *flags: object) -> list[dict[str, Any]]:
    out = tmp_path / "own.json"
    assert main(["eval", "own", *map(str, flags), "--json", str(out)]) == 0
    rows: list[dict[str, Any]] = json.loads(out.read_text())["rows"]
    return rows


def test_the_table_has_both_sets_both_weights_and_every_reader(
    ours: Path,
    own: Path,
    weights: Path,
    other: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    places = ["--data", ours, "--also", own, "--weights", other, "--before", weights]
    rows = evaluated(tmp_path, *places)
    kinds = [(row["contacts"], row["weights"], row["reader"]) for row in rows]
    readers = ("heads", "zero_shot", "captions")
    assert sorted(kinds) == sorted(
        (contacts, when, reader)
        for contacts in ("own", "ours")
        for when in ("before", "after")
        for reader in readers
    )
    printed = capsys.readouterr().out
    for title in ("your own, held out", "ours", "zero-shot", "contacts with a label"):
        assert title in printed
    row = next(row for row in rows if (row["contacts"], row["reader"]) == ("ours", "heads"))
    before, after = (
        next(
            each["right"]["depth"]
            for each in rows
            if (each["contacts"], each["weights"], each["reader"]) == ("ours", when, "heads")
        )
        for when in ("before", "after")
    )
    assert row["count"] == dict.fromkeys(("shape", "texture", "depth", "position", "area"), 8)
    assert re.search(rf"{before:.1f} → {after:.1f}", printed)


def test_only_given_labels_of_ones_own_are_scored(
    ours: Path, own: Path, weights: Path, tmp_path: Path
) -> None:
    rows = evaluated(
        tmp_path, "--data", ours, "--also", own, "--weights", weights, "--before", weights
    )
    mine = [row for row in rows if row["contacts"] == "own"]
    counts = {"shape": 3, "texture": 4, "depth": 0, "position": 0, "area": 0}
    assert all(row["count"] == counts for row in mine)
    assert all(row["right"]["depth"] is None for row in mine)
    halves = len(rows) // 2
    for before, after in zip(rows[:halves], rows[halves:], strict=True):
        assert before["right"] == after["right"]  # the same weights


def test_weights_and_folders_are_checked_before_anything_is_measured(
    ours: Path, own: Path, weights: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    argv = ["eval", "own", "--data", str(ours), "--before", str(weights), "--weights"]
    assert main([*argv, str(tmp_path / "gone"), "--also", str(own)]) == 2
    printed = capsys.readouterr()
    assert "gone/encoder" in printed.err
    assert "before" not in printed.out + printed.err
    assert main([*argv, str(weights), "--also", str(ours.parent / "." / ours.name)]) == 2
    assert "is the folder of --data too" in capsys.readouterr().err


def test_training_on_from_no_weights_writes_nothing(
    ours: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    argv = ["train", "cltp", "--data", str(ours), "--start", str(tmp_path / "gone"), "--out"]
    assert main([*argv, str(out)]) == 2
    printed = capsys.readouterr()
    assert "gone/encoder" in printed.err
    assert "writing" not in printed.out
    assert not out.exists()


def test_sets_that_can_not_be_measured_on_are_refused(
    ours: Path, weights: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    learned = write_own(tmp_path / "learned", test=0)
    argv = ["eval", "own", "--data", str(ours), "--weights", str(weights), "--also"]
    assert main([*argv, str(learned)]) == 2
    assert "no contacts of the split test" in capsys.readouterr().err
    every = frozenset({"shape", "texture", *MEASURED})
    unlabelled = write_own(tmp_path / "unlabelled", measured=every)
    assert main([*argv, str(unlabelled)]) == 2
    assert "has a given label" in capsys.readouterr().err


def test_the_language_model_learns_from_both_sets(
    ours: Path, own: Path, weights: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[TrainingRun] = []
    monkeypatch.setattr(train, "train_llm", lambda run, *_, **__: runs.append(run))
    argv = ["train", "llm", "--data", str(ours), "--out", str(weights), "--threads", "1"]
    assert main([*argv, "--start", str(weights), "--also", str(own)]) == 0
    assert main([*argv, "--start", "shipped", "--also", str(own), "--also-fraction", "0.3"]) == 0
    assert [run.also for run in runs] == [(own,)] * 2
    assert [run.also_fraction for run in runs] == [ALSO_FRACTION, 0.3]


def test_a_complete_data_set_is_taken_as_it_is(
    ours: Path, weights: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without --contacts, nothing is generated beside contacts that are there."""
    before = ContactDataset(ours).checksum()
    monkeypatch.setattr(train, "train_llm", lambda *_, **__: None)
    monkeypatch.setattr(train, "_words", lambda *_: None)
    argv = ["train", "llm", "--data", str(ours), "--out", str(weights), "--threads", "1"]
    assert main(argv) == 0
    assert ContactDataset(ours).checksum() == before
    assert main([*argv, "--contacts", "9"]) == 2
