"""A row of captions: an encoder of another row, a language model behind it, ratings in one file."""

from pathlib import Path

import numpy as np
import pytest

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.texts.told import ToldContact
from cltp.train.recipes import Schedule
from policies.llm.text import caption_text
from tacgrasp import policy_factory
from tacgrasp.__main__ import main
from tacgrasp.pretraining.report.row_file import RowFile, load_rows
from tacgrasp.pretraining.report.rows import ROWS, SHIPPED
from tacgrasp.pretraining.report.store import (
    CAPTIONS,
    EVERY_NUMBER,
    EXACT_HEIGHTS,
    MOST_FREQUENT,
    SHUFFLED,
    WORDS_ALONE,
)
from tacgrasp.training.captions import caption_row
from tacgrasp.training.captions.caption_row import TEXTS, CaptionLessons
from tests.fakes.fake_contacts import write_contacts
from tests.fakes.tiny_weights import make_weights, state

pytestmark = pytest.mark.usefixtures("threads_as_before")

PRECISION = ("--precision", "no")
"""That of all other tests: accelerate takes one for a whole process."""


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    seeds = {Split.TRAIN: range(9), Split.TEST: range(100, 104)}
    return write_contacts(tmp_path_factory.mktemp("data"), seeds)


@pytest.fixture
def row(data: Path, tmp_path: Path):  # type: ignore[no-untyped-def]
    """Runs ``eval row`` and gives the file."""

    def made(name: str, *flags: str) -> RowFile:
        places = ["--data", str(data), "--out", str(tmp_path / "rows")]
        results = ["--results", str(tmp_path / "results"), "--threads", "1", *PRECISION]
        assert main(["eval", "row", name, *places, *results, *flags]) == 0
        return {each.row: each for each in load_rows(tmp_path / "results")}[name.replace("-", "_")]

    return made


def test_a_language_model_learns_captions_and_nothing_else() -> None:
    lessons, felt = CaptionLessons(), ToldContact(state=state(1.0, 0.0, 0.5, 2.0))
    rng = np.random.default_rng(0)
    assert len(lessons.mixed(felt, rng)) == TEXTS
    said = {each.reply for each in (*lessons.mixed(felt, rng), *lessons.captions(felt, rng))}
    assert said == {caption_text(felt.state)}
    assert lessons.questions(5, rng) == ()


def test_every_row_of_captions_is_behind_a_row_of_the_same_method() -> None:
    behind = {name: recipe for name, recipe in ROWS.items() if recipe.behind}
    assert {recipe.method for recipe in behind.values()} == {"cltp", "point_bert", "point_mae"}
    for recipe in behind.values():
        if recipe.behind == SHIPPED:
            assert (recipe.samples, recipe.has_towers) == (0, False)
            continue
        encoder = ROWS[recipe.behind]
        assert (recipe.method, recipe.preset) == (encoder.method, encoder.preset)
        assert (recipe.samples, recipe.towers) == (encoder.samples, encoder.towers)


def test_an_encoder_is_trained_and_a_model_behind_it_is_rated(
    row,  # type: ignore[no-untyped-def]
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    quick = Schedule(steps=1, batch_size=2, learning_rate=1e-3)
    monkeypatch.setattr(caption_row, "HEADS_SCHEDULE", quick)
    monkeypatch.setattr(
        caption_row, "STAGES", dict.fromkeys(("text", "projector", "joint", "words"), quick)
    )
    flags = ("--samples", "64", "--limit", "3")
    made = row("point-mae-llm", *flags)
    group = tmp_path / "rows/paper-seed0-64-samples-3-contacts-precision-no"
    assert (group / "point_mae/encoder").is_dir()
    assert (group / "point_mae_llm/lm").is_dir()
    assert set(made.scores) == {CAPTIONS}
    assert set(made.scores[CAPTIONS]) == {"point_mae"}
    assert 1 <= made.scores[CAPTIONS]["point_mae"]["contact_noisy"]["rating"] <= 5
    assert made.contacts == {"contact_noisy": 3}
    assert (made.samples, made.learned_from) == (64, ContactDataset(data).checksum())
    assert set(made.minutes) == {"train", "language", "measure"}
    again = row("point-mae-llm", *flags)
    assert again.scores == made.scores
    assert again.minutes["language"] == made.minutes["language"]  # done again, not counted
    main(["eval", "report", "--results", str(tmp_path / "results")])
    page = (tmp_path / "results/pretraining.md").read_text()
    line = next(each for each in page.splitlines() if each.startswith("| PointMAE-LLM"))
    assert f"{made.scores[CAPTIONS]['point_mae']['contact_noisy']['rating']:.2f}" in line


def test_the_shipped_weights_are_rated_beside_trivial_captions(
    row,  # type: ignore[no-untyped-def]
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    weights = make_weights(tmp_path / "weights")
    monkeypatch.setattr(caption_row, "shipped_weights", lambda: weights)
    assert policy_factory.shipped_weights() != weights
    made = row("shipped-llm", "--limit", "3")
    trivial = {MOST_FREQUENT, SHUFFLED, EXACT_HEIGHTS}
    assert made.scores[CAPTIONS].keys() == {"cltp", EVERY_NUMBER, WORDS_ALONE, *trivial}
    assert (made.samples, made.learned_from, set(made.minutes)) == (0, None, {"measure"})
    methods = {result.method: result for result in made.results()}
    assert methods[SHUFFLED].variant == ""
    assert methods["cltp"].variant.startswith(SHIPPED)
