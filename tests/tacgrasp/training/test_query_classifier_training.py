"""``tacgrasp train queries``: what it draws, that it learns, and that it goes on after a stop."""

import json
import shutil

import numpy as np
import pytest
import torch
from rich.console import Console

from cltp.checkpoints.stored_classifier import load_classifier
from tacgrasp.__main__ import main
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.training import query_classifier
from tacgrasp.training.query_classifier import QueryClassifierRequest, draw_block, train

FEW_STEPS, STEPS = 8, 128
"""Steps of a training that is stopped half-way, and of one that learns."""


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    monkeypatch.setattr(query_classifier, "BLOCK", 400)
    monkeypatch.setattr(query_classifier, "BATCH", 32)
    monkeypatch.setattr(query_classifier, "HELD_OUT", 50)

    class Here:
        """Maps in this process: the constants of this test are no other one's."""

        map = staticmethod(map)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            return None

    monkeypatch.setattr(query_classifier, "worker_pool", Here)


def test_blocks_are_deterministic_and_hold_queries():
    lines = draw_block((0, 3))
    assert lines == draw_block((0, 3)) != draw_block((0, 4))
    for line in lines[:100]:
        words, name = line.split("\t")
        assert words
        assert name == "several" or read_query(name, (1.0, 2.0, 3.0, 4.0)) is not None


def request_in(folder, steps):
    return QueryClassifierRequest(out=folder, questions=1200, steps=steps)


def losses_in(folder):
    curve = (folder / ".training" / "queries.csv").read_text().splitlines()
    return [float(row.split(",")[2]) for row in curve[1:]]


def test_it_goes_on_where_it_stopped(tmp_path):
    train(request_in(tmp_path / "whole", FEW_STEPS), Console(quiet=True))
    whole = load_classifier(tmp_path / "whole")
    (drawn,) = (tmp_path / "whole" / ".training").glob("questions-*.tsv")
    (tmp_path / "stopped" / ".training").mkdir(parents=True)
    shutil.copy(drawn, tmp_path / "stopped" / ".training")  # the same are drawn: tested above
    stage = query_classifier.Stage

    class StoppedError(Exception):
        pass

    class Stopping(stage):
        def train(self, losses):
            def some(step):
                if step == FEW_STEPS // 2:
                    self.save()
                    raise StoppedError
                return losses(step)

            super().train(some)

    query_classifier.Stage = Stopping
    try:
        with pytest.raises(StoppedError):
            train(request_in(tmp_path / "stopped", FEW_STEPS), Console(quiet=True))
    finally:
        query_classifier.Stage = stage
    train(request_in(tmp_path / "stopped", FEW_STEPS), Console(quiet=True))
    stopped = load_classifier(tmp_path / "stopped")
    for name, value in whole.state_dict().items():
        assert torch.equal(value, stopped.state_dict()[name]), name
    assert len(losses_in(tmp_path / "whole")) == FEW_STEPS
    assert losses_in(tmp_path / "stopped") == losses_in(tmp_path / "whole")


@pytest.mark.slow
def test_it_learns(tmp_path):
    train(request_in(tmp_path, STEPS), Console(quiet=True))
    losses = losses_in(tmp_path)
    assert len(losses) == STEPS
    last = losses[-query_classifier.POOL :]  # steps that share questions of all lengths
    assert np.mean(last) < 0.8 * np.mean(losses[:5])


def test_the_command_refuses_nothing_to_learn(tmp_path, capsys):
    assert main(["train", "queries", "--out", str(tmp_path), "--steps", "0"]) == 2
    assert "--steps" in capsys.readouterr().err


def test_the_command_writes_a_classifier(tmp_path, capsys):
    argv = ["train", "queries", "--out", str(tmp_path / "q"), "--questions", "1200", "--steps", "2"]
    assert main(argv) == 0
    assert "are read rightly" in capsys.readouterr().out
    config = json.loads((tmp_path / "q" / "config.json").read_text())
    assert len(config["classes"]) > 50
