"""The language model's stages: one goes on from those before it, and one process alone writes."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.tac3d_llm import save_encoder
from cltp.data.contact import Split
from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.texts.captions import caption
from cltp.texts.exchange_packing import Exchange
from cltp.texts.told import ToldContact
from cltp.train.distributed import Workers
from cltp.train.llm import earlier, train_llm, train_words
from cltp.train.recipes import Schedule
from cltp.train.stage import TrainingRun
from tests.fakes.fake_contacts import write_contacts

pytestmark = pytest.mark.usefixtures("one_thread")


class FewLessons:
    def captions(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [Exchange(prompt="Describe the contact.", reply=caption(felt.state))]

    def mixed(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [Exchange(prompt="What now?", reply=f"{caption(felt.state)} Action: <none>")]

    def questions(self, num: int, rng: np.random.Generator) -> Sequence[Exchange]:
        return ()


def schedule(steps: int) -> Schedule:
    return Schedule(steps=steps, batch_size=2, learning_rate=1e-3)


@pytest.fixture
def run(tmp_path: Path) -> TrainingRun:
    data = write_contacts(tmp_path / "data", {Split.TRAIN: range(8)})
    torch.manual_seed(0)
    config = PRESETS["tiny"]
    save_encoder(tmp_path / "out/encoder", TactileEncoder(config), StateHeads.of(config))
    return TrainingRun(data=data, out=tmp_path / "out")


def train(run: TrainingRun, schedules: dict[str, Schedule]) -> None:
    words = train_words(run.data, FewLessons(), size=600, num_contacts=8)
    train_llm(run, words, FewLessons(), schedules, dim=48, layers=1)


def test_a_stage_is_refused_behind_one_that_was_trained_otherwise(run: TrainingRun) -> None:
    stages = {"text": schedule(2), "projector": schedule(1)}
    train(run, stages)
    train(run, stages)  # is done, and taken up
    (run.out / ".training/text.checkpoint").unlink()
    with pytest.raises(TouchError, match="delete it to start afresh"):
        train(run, {**stages, "text": schedule(3)})


def test_one_process_alone_writes_the_weights(run: TrainingRun) -> None:
    train(replace(run, workers=Workers(index=1, count=2)), {"text": schedule(1)})
    assert [part.name for part in run.out.iterdir() if part.is_dir()] == ["encoder"]


def test_the_first_stage_goes_on_from_nothing() -> None:
    stages = {"text": schedule(2), "projector": schedule(1), "joint": schedule(4)}
    assert earlier(stages, "text") == {}
    assert list(earlier(stages, "joint")) == ["before"]
    assert earlier(stages, "projector") != earlier({**stages, "text": schedule(3)}, "projector")
