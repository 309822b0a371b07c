"""Data sets of simulated contacts: the same bytes however they were made, and never half of one."""

import io
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rich.console import Console

from cltp.dataset import ContactDataset
from cltp.errors import TouchError
from tacgrasp import generate as made
from tacgrasp import recipes
from tacgrasp.errors import UsageError

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def small_shards(monkeypatch):
    monkeypatch.setattr(recipes, "SHARD_GROUPS", 1)


def generate(out, contacts=90, seed=7, **options):
    made.generate(out, contacts=contacts, seed=seed, console=Console(file=io.StringIO()), **options)


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed") / "data"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(recipes, "SHARD_GROUPS", 1)
        generate(folder, workers=1)
    return folder


def test_as_many_contacts_are_made_as_were_asked_for(undisturbed):
    data = ContactDataset(undisturbed)
    assert len(data) == 90
    assert made.is_complete(undisturbed)
    assert data.about["seed"] == "7"
    assert data.column("series").tolist() == sorted(data.column("series"))


def test_what_is_missing_is_made_again_with_the_same_bytes(undisturbed, tmp_path):
    out = tmp_path / "data"
    generate(out, workers=1)
    (out / "shard-s00001-00000.parquet").unlink()  # as if killed between heights and index
    (out / "shard-s00002-00000.heights").rename(out / "shard-s00002-00000.heights.99.part")
    (out / "shard-s00002-00000.parquet").rename(out / "shard-s00002-00000.parquet.99.part")
    assert not made.is_complete(out)
    generate(out, workers=1)
    assert files(out) == files(undisturbed)


def test_a_complete_data_set_is_left_as_it_is(undisturbed, monkeypatch):
    monkeypatch.setattr(recipes, "make_group", lambda *_: pytest.fail("nothing is to be made"))
    before = files(undisturbed)
    generate(undisturbed, workers=1)
    assert files(undisturbed) == before


@pytest.mark.slow
def test_workers_don_t_change_a_byte(tmp_path, monkeypatch):
    monkeypatch.undo()  # workers import the module anew, with its own size of shards
    for workers in (1, 2):
        generate(tmp_path / str(workers), contacts=230, workers=workers)
    assert files(tmp_path / "1") == files(tmp_path / "2")


@pytest.mark.slow
def test_killed_twice_it_goes_on_and_leaves_no_worker_behind(tmp_path, monkeypatch):
    monkeypatch.undo()
    out, whole = tmp_path / "killed", tmp_path / "whole"
    command = [sys.executable, "-m", "tacgrasp", "data", "generate", "--contacts", "850"]
    command += ["--seed", "7", "--workers", "2", "--out"]
    for shards in (1, 3):
        with subprocess.Popen([*command, out], cwd=ROOT, stderr=subprocess.DEVNULL) as run:
            until = time.monotonic() + 120
            while len(list(out.glob("*.parquet"))) < shards and time.monotonic() < until:
                time.sleep(0.02)
            children = _children_of(run.pid)
            run.send_signal(signal.SIGKILL)
        assert children
        _wait_until_gone(children)
    assert not made.is_complete(out)
    subprocess.run([*command, out], cwd=ROOT, check=True)
    generate(whole, contacts=850, workers=1)
    assert files(out) == files(whole)


def _children_of(pid):
    return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def _wait_until_gone(pids):
    until = time.monotonic() + 30
    while any(Path(f"/proc/{pid}").exists() and not _is_zombie(pid) for pid in pids):
        assert time.monotonic() < until, "a worker outlived its killed parent by 30 s"
        time.sleep(0.1)


def _is_zombie(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:
        return True


def test_a_folder_of_another_command_is_refused_and_names_the_difference(undisturbed):
    with pytest.raises(UsageError, match=r"seed '7' instead of '8'"):
        generate(undisturbed, seed=8)
    with pytest.raises(UsageError, match=r"contacts '90' instead of '91'"):
        generate(undisturbed, contacts=91)


@pytest.mark.parametrize(
    "wrong", [{"contacts": 0}, {"seed": 1_000_000}, {"seed": -1}, {"workers": -1}]
)
def test_impossible_values_are_refused_before_anything_is_made(wrong, tmp_path):
    with pytest.raises(UsageError, match="expected at least 1"):
        generate(tmp_path / "data", **wrong)
    assert not (tmp_path / "data").exists()


def test_an_unknown_sensor_is_refused(tmp_path):
    with pytest.raises(TouchError, match="unknown sensor 'eye'"):
        generate(tmp_path / "data", sensor_name="eye")
    assert not (tmp_path / "data").exists()


def test_a_started_data_set_without_shards_is_not_complete(tmp_path):
    made._open(tmp_path / "data", {"contacts": "9", "seed": "0", "sensor": "gelsight_mini"})
    assert not made.is_complete(tmp_path / "data")
    with pytest.raises(TouchError, match="no data set"):
        made.is_complete(tmp_path)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_can_t_be_written_is_an_error(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(TouchError, match="can't write"):
        generate(tmp_path / "data")
