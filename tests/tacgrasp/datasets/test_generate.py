"""Data sets of simulated contacts: the same bytes however they were made, and never half of one."""

import io
import os
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from rich.console import Console

from cltp.atomic_write import write_atomically
from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets import generate as made
from tacgrasp.datasets import recipes
from tacgrasp.datasets.requests import GenerateRequest
from tacgrasp.datasets.verify import problems
from tests.paths import ROOT


@pytest.fixture(autouse=True)
def small_shards(monkeypatch):
    monkeypatch.setattr(recipes, "FULL_SHARD_SERIES", 2)


def generate(out, contacts=10, seed=7, **options):
    values = {"out": out, "set": "full", "contacts": contacts, "seed": seed, **options}
    made.generate(GenerateRequest(**values), console=Console(file=io.StringIO()))


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed") / "data"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(recipes, "FULL_SHARD_SERIES", 2)
        generate(folder, workers=1)
    return folder


def test_as_many_contacts_are_made_as_were_asked_for(undisturbed):
    data = ContactDataset(undisturbed)
    assert len(data) == 10
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
    monkeypatch.setattr(
        recipes, "make_full_series", lambda *_: pytest.fail("nothing is to be made")
    )
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
    command += ["--set", "full", "--seed", "7", "--workers", "2", "--out"]
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
    with pytest.raises(UsageError, match=r"contacts '10' instead of '11'"):
        generate(undisturbed, contacts=11)


@pytest.mark.parametrize(
    "wrong", [{"contacts": 0}, {"seed": 1_000_000}, {"seed": -1}, {"workers": -1}]
)
def test_impossible_values_are_refused_before_anything_is_made(wrong, tmp_path):
    with pytest.raises(UsageError, match="expected at least 1"):
        generate(tmp_path / "data", **wrong)
    assert not (tmp_path / "data").exists()


def test_a_started_data_set_without_shards_is_not_complete(tmp_path):
    made._open(tmp_path / "data", {"contacts": "9", "seed": "0", "set": "full"})
    assert not made.is_complete(tmp_path / "data")
    with pytest.raises(TouchError, match="no data set"):
        made.is_complete(tmp_path)


def test_a_file_in_the_place_of_the_folder_is_refused(tmp_path):
    file = tmp_path / "afile"
    file.write_text("mine")
    with pytest.raises(UsageError, match="afile is a file, not a folder"):
        generate(file)
    with pytest.raises(UsageError, match="afile is a file, not a folder"):
        generate(file / "below")
    assert file.read_text() == "mine"


def test_a_folder_with_other_files_is_refused_and_left_as_it_is(tmp_path):
    (tmp_path / "README.md").write_text("mine")
    (tmp_path / "dataset.json.123.part").write_text("{")  # of another machine, just begun
    with pytest.raises(UsageError, match=r"holds other files \(README.md\); name a new folder"):
        generate(tmp_path)
    assert (tmp_path / "README.md").read_text() == "mine"
    assert len(files(tmp_path)) == 2
    (tmp_path / "README.md").unlink()
    made._open(tmp_path, {"contacts": "9", "seed": "0", "set": "full"})


def test_who_stops_it_is_told_that_it_stops(tmp_path, monkeypatch, caplog):
    def interrupted(futures):
        raise KeyboardInterrupt

    monkeypatch.setattr(made, "as_completed", interrupted)
    monkeypatch.setattr(made, "worker_pool", ThreadPoolExecutor)  # processes load for seconds
    monkeypatch.setattr(made, "_make_shard", lambda job, plan: 0)
    with pytest.raises(KeyboardInterrupt):
        generate(tmp_path / "data", contacts=10, workers=2)
    assert "stopping, once the workers have; the same command goes on" in caplog.text


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_can_t_be_written_is_an_error(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(TouchError, match="can't write"):
        generate(tmp_path / "data")


def tcl3d(out, contacts=24, seed=5, **options):
    generate(out, contacts, seed, set="paper", **options)


@pytest.fixture(scope="module")
def whole_tcl3d(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tcl3d") / "data"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(recipes, "SHARD_SERIES", 2)
        tcl3d(folder, workers=1)
    return folder


@pytest.fixture
def shards_of_two_series(monkeypatch):
    monkeypatch.setattr(recipes, "SHARD_SERIES", 2)


def test_parts_from_several_machines_give_the_same_bytes(
    whole_tcl3d, tmp_path, shards_of_two_series
):
    joined = tmp_path / "joined"
    for part in ("2/2", "1/2"):
        tcl3d(tmp_path / part[0], shard=part, workers=1)
        shutil.copytree(tmp_path / part[0], joined, dirs_exist_ok=True)
    assert not (joined / "README.md").exists()
    with pytest.raises(TouchError, match=r"holds 16 of 24 contacts|holds 8 of 24 contacts"):
        ContactDataset(tmp_path / "1")
    tcl3d(joined, workers=1)
    assert files(joined) == files(whole_tcl3d)


def test_the_full_set_in_parts_has_the_same_bytes(undisturbed, tmp_path):
    joined = tmp_path / "joined"
    for part in ("2/2", "1/2"):
        generate(joined, shard=part, workers=1)
    assert files(joined) == files(undisturbed)
    assert len(ContactDataset(joined)) == 10


def test_the_full_set_is_whole_and_says_what_it_is(undisturbed):
    about = ContactDataset(undisturbed).about
    assert (about["set"], about["maker"]) == ("full", recipes.FULL_MAKER)
    assert [problem for _, problem in problems(undisturbed) if problem is not None] == []
    assert (
        "`tacgrasp data generate --set full --seed 7 --contacts 10`"
        in (undisturbed / "README.md").read_text()
    )


def test_the_paper_s_set_is_still_found_by_its_former_name(whole_tcl3d):
    assert recipes.recipe(GenerateRequest(out=whole_tcl3d, set="tcl3d")) == recipes.recipe(
        GenerateRequest(out=whole_tcl3d, set="paper")
    )
    assert sum(recipes.recipe(GenerateRequest(out=whole_tcl3d, set="paper")).shard_sizes()) == 52425


def test_a_card_says_what_is_in_the_folder(whole_tcl3d):
    data = ContactDataset(whole_tcl3d)
    card = (whole_tcl3d / "README.md").read_text()
    assert data.checksum() in card
    assert "`tacgrasp data generate --set paper --seed 5 --contacts 24`" in card
    assert len(data) == 24
    assert data.contact(0).unsure is not None
    assert data.contact(0).approach_mm > 0


@pytest.mark.parametrize("wrong", ["0/2", "3/2", "1/0", "1", "a/b", "-1/2"])
def test_a_part_that_does_not_exist_is_refused(wrong, tmp_path):
    with pytest.raises(UsageError, match="--shard expects i/n"):
        tcl3d(tmp_path / "data", shard=wrong)
    assert not (tmp_path / "data").exists()


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"set": "tcl4d"}, "--set expects full, paper, got 'tcl4d'"),
        ({"set": "starter"}, "--set expects full, paper, got 'starter'"),
        ({"set": "full", "meshes": Path("x")}, "belongs to --set paper"),
        ({"set": "full", "on": "nowhere:1"}, "no scheduler answers|not installed"),
        ({"set": "tcl3d", "device": "abacus"}, "abacus can't be used: .*; cpu always can"),
        ({"set": "tcl3d", "device": "cuda:99"}, "cuda:99 can't be used: .*; cpu always can"),
    ],
)
def test_flags_that_do_not_go_together_are_refused(wrong, message, tmp_path, monkeypatch):
    monkeypatch.setattr("tacgrasp.datasets.cluster.CONNECT_S", 1)
    with pytest.raises(UsageError, match=message):
        generate(tmp_path / "data", **wrong)
    assert not (tmp_path / "data").exists()


def test_a_full_disk_is_an_error_that_leaves_no_shard(tmp_path, monkeypatch, shards_of_two_series):
    def write_all_but_an_index(path, content):
        if path.suffix == ".parquet":
            raise OSError(28, "No space left on device")
        return write_atomically(path, content)

    monkeypatch.setattr("cltp.data.dataset_writer.write_atomically", write_all_but_an_index)
    with pytest.raises(TouchError, match="No space left on device"):
        tcl3d(tmp_path / "data", contacts=8, workers=1)
    assert not made.is_complete(tmp_path / "data")
    monkeypatch.undo()


def test_a_folder_without_meshes_is_refused(tmp_path):
    with pytest.raises(TouchError, match="has no mesh"):
        tcl3d(tmp_path / "data", meshes=tmp_path)
