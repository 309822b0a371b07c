"""``tacgrasp eval captions``: what it stores, and what the report makes of it."""

import json
import shlex
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from cltp.checkpoints.base_lm import BaseLm
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.texts.captions import caption
from policies.llm.text import caption_text
from tacgrasp.__main__ import main
from tacgrasp.pretraining.report.store import (
    EVERY_NUMBER,
    EXACT_HEIGHTS,
    MOST_FREQUENT,
    SHUFFLED,
    WORDS_ALONE,
    load_results,
)
from tacgrasp.training.captions.evaluate import (
    most_frequent_caption,
    others,
    rated,
    variant_of,
)
from tacgrasp.training.captions.rating import rate_caption
from tests.fakes.fake_contacts import write_contacts
from tests.fakes.fake_results import fake_result
from tests.fakes.tiny_weights import make_weights, state

pytestmark = pytest.mark.usefixtures("threads_as_before")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    seeds = {Split.TRAIN: range(9), Split.TEST: range(100, 104)}
    return write_contacts(tmp_path_factory.mktemp("data"), seeds)


def test_nobody_gets_its_own_caption() -> None:
    references = [f"caption {number}" for number in range(7)]
    taken = others(references, 0)
    assert sorted(taken) == references
    assert all(one != other for one, other in zip(taken, references, strict=True))


def test_the_most_frequent_caption_is_a_caption(data: Path) -> None:
    train = ContactDataset(data, split=Split.TRAIN)
    text = most_frequent_caption(train)
    assert not rate_caption(text, train.state(0)).is_malformed
    words = [caption(train.state(index)) for index in range(len(train))]
    said = text.partition(" contact area.")[0] + " contact area."
    assert words.count(said) == max(map(words.count, words)) > 0


def test_figures_are_means_over_contacts() -> None:
    truths = [state(0.0, 0.0, 0.6, 2.0), state(4.0, 0.0, 0.6, 2.0)]
    references = [caption_text(each) for each in truths]
    assert rated(references, truths, references, None)["rating"] == 5.0
    half = rated([references[0], "nothing of the kind"], truths, references, None)
    assert half["rating"] == 3.0
    assert half["malformed"] == half["shape"] == 50.0
    assert half["numbers"] == 100.0  # of those that are said


def test_a_row_says_what_its_language_model_learned_from(tmp_path: Path) -> None:
    assert variant_of(tmp_path, "abcdef12") == "our small one, of unknown data"
    (tmp_path / "README.md").write_text("| seed | 0 |\n| data checksum | abcdef1234 |\n")
    assert variant_of(tmp_path, "abcdef1234") == "our small one"
    assert variant_of(tmp_path, "0123456789") == "our small one, of data abcdef12"
    base = BaseLm(path="/there/Qwen2.5-VL-3B", model_type="qwen2_5_vl", fingerprint="", tune="lora")
    (tmp_path / "lm").mkdir()
    base.write(tmp_path / "lm")
    said = variant_of(tmp_path, "abcdef1234")
    assert said == "Qwen2.5-VL-3B (qwen2_5_vl), lora"


def test_captions_are_rated_stored_and_reported(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    weights, results = make_weights(tmp_path / "weights"), tmp_path / "results"
    judge = shlex.join([sys.executable, "-c", "import sys\nfor _ in sys.stdin: print(2)"])
    argv = ["eval", "captions", "--weights", str(weights), "--data", str(data), "--contacts", "3"]
    argv += ["--results", str(results), "--judge", judge, "--json", str(tmp_path / "f.json")]
    assert main(argv) == 0
    stored = {result.method: result for result in load_results(results)}
    trivial = {MOST_FREQUENT, SHUFFLED, EXACT_HEIGHTS}
    assert stored.keys() == {"cltp", EVERY_NUMBER, WORDS_ALONE, *trivial}
    said = {name: stored[name].values["numbers_said"] or 0.0 for name in stored}
    assert said[WORDS_ALONE] == 0
    assert said["cltp"] <= said[EVERY_NUMBER]
    for result in stored.values():
        assert result.contacts == 3
        assert result.values["judge"] == 2.0
        rating = result.values["rating"]
        assert rating is not None
        assert 1 <= rating <= 5
    assert stored["cltp"].values["malformed"] == 0.0  # a grammar allows nothing else
    assert json.loads((tmp_path / "f.json").read_text())[SHUFFLED]["judge"] == 2.0
    before = replace(stored["cltp"])
    assert main(argv) == 0  # the same again, in the same place
    assert {r.method: r for r in load_results(results)}["cltp"] == before
    assert main(["eval", "report", "--results", str(results)]) == 0
    page = (results / "pretraining.md").read_text()
    rows = {line.split("|")[1].strip(): line for line in page.splitlines() if line.startswith("|")}
    assert f"{before.values['rating']:.2f}" in rows["Tac3D-LLM"]
    assert "4.28" in rows["Tac3D-LLM"]
    assert "not measured" in rows["PointBERT-LLM"]
    assert "1.73" in rows["PointBERT-LLM"]
    assert "1.61" in rows["PointMAE-LLM"]
    capsys.readouterr()


def test_the_table_stands_in_a_report_without_captions(tmp_path: Path) -> None:
    from tacgrasp.pretraining.report.store import save

    save(tmp_path, fake_result())
    assert main(["eval", "report", "--results", str(tmp_path)]) == 0
    page = (tmp_path / "pretraining.md").read_text()
    assert page.count("not measured") >= 3
    row = next(line for line in page.splitlines() if line.startswith("| Tac3D-LLM"))
    assert "| – | – | 4.28 |" in row


def test_questions_stand_beside_the_captions_where_they_were_asked() -> None:
    from tacgrasp.pretraining.report.caption_table import caption_section
    from tacgrasp.pretraining.report.store import grouped

    values = {"rating": 4.1, "questions": 70.0, "unseen_wordings": 61.5}
    result = fake_result(table="captions", split="contact_noisy", values=values, judge="")
    other = replace(result, method="point_mae", variant="x", values={"rating": 1.5})
    table = caption_section(grouped([result, other])).table
    assert table is not None
    rows = {row[0]: dict(zip(table.head, row, strict=True)) for row in table.rows}
    assert rows["Tac3D-LLM"]["rating by rule"] == "4.10"
    assert rows["Tac3D-LLM"]["unseen wordings"] == "61.5"
    assert rows["PointMAE-LLM"]["unseen wordings"] == "–"
    assert rows["PointMAE-LLM"]["the paper's, by GPT-4"] == "1.61"
    assert rows["PointBERT-LLM"]["rating by rule"] == "–"
