"""Shards from a cluster: the same bytes as on one machine, even when a worker is killed."""

import io
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import contextmanager

import pytest
from rich.console import Console

from cltp.errors import TouchError
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets import recipes
from tacgrasp.datasets.cluster import make_remotely
from tacgrasp.datasets.generate import generate
from tacgrasp.datasets.recipes import FullRecipe
from tacgrasp.datasets.requests import GenerateRequest
from tests.paths import ROOT


def make(out, contacts, **options):
    request = GenerateRequest(out=out, set="full", contacts=contacts, seed=7, **options)
    generate(request, console=Console(file=io.StringIO()))


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_worker_with_other_software_makes_nothing():
    plan = FullRecipe(contacts=4, seed=0)
    with pytest.raises(TouchError, match="install the same version"):
        make_remotely(plan, {**plan.about(), "maker": "full 0"}, "2", 0, 4)


def test_a_number_of_workers_does_not_go_with_a_cluster(tmp_path):
    with pytest.raises(UsageError, match="the cluster of --on has its own workers"):
        make(tmp_path / "data", 4, on="tcp://127.0.0.1:1", workers=2)
    assert not (tmp_path / "data").exists()


def test_without_a_scheduler_nothing_is_begun(tmp_path, monkeypatch):
    monkeypatch.setattr("tacgrasp.datasets.cluster.CONNECT_S", 1)
    with pytest.raises(UsageError, match=r"no scheduler answers|not installed"):
        make(tmp_path / "data", 4, on=f"tcp://127.0.0.1:{_free_port()}")
    assert not (tmp_path / "data").exists()


def _free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextmanager
def _process(module, *arguments):
    command = [sys.executable, "-m", module, *arguments]
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@contextmanager
def _worker(address):
    options = ("--nthreads", "1", "--no-nanny", "--no-dashboard")
    with _process("distributed.cli.dask_worker", address, *options) as process:
        yield process


@contextmanager
def _scheduler():
    port = _free_port()
    options = ("--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
    with _process("distributed.cli.dask_scheduler", *options):
        yield f"tcp://127.0.0.1:{port}"


@pytest.fixture
def small_shards(monkeypatch):
    monkeypatch.setattr(recipes, "FULL_SHARD_SERIES", 3)


def _kill_after_a_shard(worker, out):
    while not list(out.glob("*.parquet")):
        time.sleep(0.02)
    worker.send_signal(signal.SIGKILL)


@pytest.mark.slow
def test_a_killed_worker_and_a_late_one_do_not_change_a_byte(tmp_path, small_shards):
    pytest.importorskip("distributed")
    out = tmp_path / "cluster"
    with _scheduler() as address, _worker(address) as first:
        killer = threading.Thread(target=_kill_after_a_shard, args=(first, out), daemon=True)
        killer.start()
        with _worker(address):
            make(out, 120, on=address)
        killer.join(timeout=10)
        assert first.wait(timeout=10) == -signal.SIGKILL
    make(tmp_path / "alone", 120, workers=1)
    assert files(out) == files(tmp_path / "alone")
