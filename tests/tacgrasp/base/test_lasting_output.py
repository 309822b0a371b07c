"""Output that goes on when its reader has gone."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from tacgrasp.base.lasting_output import lasting_output
from tacgrasp.episodes import read_episode

ROOT = Path(__file__).parents[3]


def test_what_nobody_reads_is_lost_and_raises_nothing(monkeypatch):
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as stream:
        monkeypatch.setattr(sys, "stdout", stream)
        with lasting_output():
            for _ in range(3):
                sys.stdout.write("text\n")
                sys.stdout.flush()
        assert sys.stdout is stream


def test_what_finds_no_place_is_lost_and_raises_nothing(monkeypatch):
    with Path("/dev/full").open("w") as stream:
        monkeypatch.setattr(sys, "stdout", stream)
        with lasting_output():
            sys.stdout.write("text\n")
            sys.stdout.flush()
            sys.stdout.write("text\n")


def test_a_command_without_an_output_ends_as_any_other():
    command = f"exec {sys.executable} -m tacgrasp --version >&-"
    child = subprocess.run(["sh", "-c", command], cwd=ROOT, stderr=subprocess.PIPE, text=True)
    assert (child.returncode, child.stderr) == (0, "")


def test_a_run_whose_output_is_cut_off_ends_as_any_other(tmp_path):
    command = [sys.executable, "-m", "tacgrasp", "run", "--policy", "rules", "--seed", "6"]
    child = subprocess.Popen(
        [*command, "--record", str(tmp_path)], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    child.stdout.readline()
    child.stdout.close()  # as `| head -1` does
    assert child.wait(120) == 0
    (path,) = tmp_path.glob("*.mcap")
    assert read_episode(path).end.reason == "success"
