"""Rows of the tables: their list, their files, and the page that is made from files alone."""

import dataclasses
import json
from html.parser import HTMLParser
from pathlib import Path

import pytest

from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.encoder.encoder import PRESETS
from cltp.errors import TouchError
from cltp.tactile.states import CLASSES
from cltp.train.methods import METHODS
from cltp.train.recipes import CltpRecipe
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.recipes import FullRecipe, Tcl3dRecipe
from tacgrasp.pretraining.report.report import report
from tacgrasp.pretraining.report.row_file import RowFile, load_rows, measured, missing, save_row
from tacgrasp.pretraining.report.rows import BUDGET, DATA, ROWS, row_command, wanted
from tacgrasp.pretraining.report.store import TITLES, Budget, Result, grouped, nested
from tests.fakes.fake_contacts import fake_contact
from tests.fakes.fake_results import fake_result

WHOLE = Budget(steps=BUDGET // 64, batch_size=64)
NUMBERS = {"depth_mm": 0.02, "coverage_depth": 90.0, "width_depth": 0.1}


def fake_row(results: list[Result] | None = None, **changed: object) -> RowFile:
    """The row ``cltp`` as it is wanted, with probes at 50 % on ``contact``."""
    usual: dict[str, object] = {
        "row": "cltp",
        "seed": 0,
        "method": "cltp",
        "variant": "grid",
        "command": "tacgrasp eval row cltp",
        "data": DATA["paper"],
        "learned_from": DATA["paper"],
        "checksums": {"data": "d" * 64, "learned_from": "d" * 64},
        "budget": WHOLE,
        "points": 7500,
        "minutes": {"clip": 5.0, "train": 30.0, "measure": 10.0},
        "limit": None,
        "precision": "no",
        "device": "cpu",
        "versions": {"torch": "2"},
        **measured(results or [fake_result()]),
    }
    return RowFile(**{**usual, **changed})  # type: ignore[arg-type]


class Balance(HTMLParser):
    """Notes tags that are not closed in their order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wrong: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        if tag not in ("meta", "img", "br", "link"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


def test_every_row_is_of_a_known_method_and_encoder_and_takes_a_part_of_one_budget() -> None:
    for name, row in ROWS.items():
        assert row.method in TITLES, name
        assert row.preset is None or row.preset in PRESETS, name
        assert row.samples in (0, BUDGET // 4, BUDGET), name
        assert row.samples % 64 == 0, name
        steps = row.schedule(row.samples).steps
        assert steps == max(1, row.samples // 64), name
    assert {row.method for row in ROWS.values()} >= METHODS.keys()
    assert [name for name, row in ROWS.items() if len(row.seeds) == 3] == [
        "cltp",
        "cltp_even",
        "cltp_muon_curves_clean",
    ]


def test_no_two_rows_have_one_name_in_tables() -> None:
    usual = dataclasses.asdict(CltpRecipe())
    names = []
    for row in ROWS.values():
        changed = {k: v for k, v in dataclasses.asdict(row.recipe).items() if v != usual[k]}
        preset = row.preset or (METHODS[row.method].preset if row.method in METHODS else "")
        names.append((row.method, preset, row.variant, row.behind, str(changed), *row.remarks))
    assert len(set(names)) == len(names)


def test_the_data_of_the_rows_are_what_their_commands_make(tmp_path: Path) -> None:
    for name, requested in (("paper", Tcl3dRecipe), ("full", FullRecipe)):
        count = int(DATA[name].split()[-1])
        about = requested(contacts=count, seed=0).about()
        with DatasetWriter(tmp_path / name, about={**about, "contacts": "1"}) as writer:
            writer.add(fake_contact(0))
        origin = ContactDataset(tmp_path / name).origin
        assert origin == DATA[name].replace(f"contacts {count}", "contacts 1")
        assert about["contacts"] == str(count)


def test_data_without_a_recipe_are_told_by_their_checksum(tmp_path: Path) -> None:
    with DatasetWriter(tmp_path) as writer:
        writer.add(fake_contact(0))
    data = ContactDataset(tmp_path)
    assert data.origin == data.checksum()


def test_a_row_comes_back_from_its_file_as_it_was(tmp_path: Path) -> None:
    counts = {"shape": [[1, 0], [0, 2]]}
    results = [
        fake_result(confusion=counts),
        fake_result(table="zero_shot", split="physics", contacts=9),
        fake_result(table="numbers", values=NUMBERS),
    ]
    row = fake_row(results)
    path = save_row(tmp_path, row)
    assert path.name == "cltp-seed0.json"
    assert load_rows(tmp_path) == [row]
    read = load_rows(tmp_path)[0].results()
    assert {(r.table, r.split, r.contacts) for r in read} == {
        ("probe", "contact", 7),
        ("zero_shot", "physics", 9),
        ("numbers", "contact", 7),
    }
    by_table = {result.table: result for result in read}
    assert by_table["numbers"].values == NUMBERS
    assert by_table["probe"].confusion == counts
    assert (by_table["probe"].points, by_table["probe"].minutes) == (7500, 45.0)
    content = json.loads(path.read_text())
    assert content["samples"] == BUDGET
    depth = content["scores"]["numbers"]["contact"]["depth"]
    assert depth == {"median_error": 0.02, "inside": 90.0, "width": 0.1}
    assert nested(grouped(read)) == row.scores


@pytest.mark.parametrize(
    ("changed", "mark"),
    [
        ({}, []),
        ({"data": "e" * 64, "learned_from": "e" * 64}, [f"other data ({'e' * 60})"]),
        ({"learned_from": "e" * 64}, [f"learned from other data ({'e' * 60})"]),
        ({"budget": Budget(steps=10, batch_size=64)}, [f"640 samples, not {BUDGET:,}"]),
        ({"limit": 9}, ["at most 9 contacts of a split"]),
        ({"row": "dance"}, ["not in the list of rows"]),
        ({"row": "cltp_full", "learned_from": DATA["full"]}, []),
        ({"row": "cltp_full"}, [f"learned from other data ({DATA['paper']})"]),
    ],
)
def test_a_row_is_marked_where_data_or_budget_differ(
    changed: dict[str, object], mark: list[str], tmp_path: Path
) -> None:
    row = fake_row(**changed)
    assert row.marks == mark
    assert row.results()[0].variant == ", ".join(["grid", *mark])
    save_row(tmp_path, row)
    page = report(tmp_path, tmp_path)[0].read_text()
    assert all(page.count(each) >= 2 for each in mark)  # in the list of rows, and in the tables


def test_seeds_are_averaged_but_a_marked_row_stands_by_itself(tmp_path: Path) -> None:
    for seed, value in enumerate((50.0, 60.0)):
        scores = [fake_result(values=dict.fromkeys(CLASSES, value))]
        save_row(tmp_path, fake_row(scores, seed=seed))
    save_row(
        tmp_path, fake_row([fake_result(values=dict.fromkeys(CLASSES, 90.0))], seed=2, limit=1)
    )
    figures = tmp_path / "figures" / "f.json"
    figures.parent.mkdir()
    argv = ["eval", "report", "--results", str(tmp_path), "--json", str(figures)]
    assert main(argv) == 0
    found = json.loads(figures.read_text())
    assert found["probe"]["cltp"]["contact"]["shape"] == 55.0
    assert found["rows"]["cltp"]["seed1"]["samples"] == BUDGET
    assert found["rows"]["cltp"]["seed2"]["marks"] == ["at most 1 contacts of a split"]
    assert "tacgrasp eval row cltp" not in found["missing"]
    assert "tacgrasp eval row cltp-even --seed 2" in found["missing"]
    page = (tmp_path / "pretraining.md").read_text()
    assert "| 55.0 ± 5.0 |" in page
    assert "| 90.0 |" in page


def test_a_page_of_somebody_else_s_stays(tmp_path: Path) -> None:
    notes = tmp_path / "pretraining.md"
    notes.write_text("my own notes")
    with pytest.raises(UsageError, match="is no earlier result"):
        report(tmp_path, tmp_path)
    assert notes.read_text() == "my own notes"


def test_a_page_of_no_rows_is_whole_and_names_every_command(tmp_path: Path) -> None:
    markdown, html = report(tmp_path, tmp_path / "page")
    text = html.read_text()
    balance = Balance()
    balance.feed(text)
    assert (balance.open, balance.wrong) == ([], [])
    commands = [row_command(*each) for each in wanted()]
    assert len(set(commands)) == len(commands) > 15
    for page in (text, markdown.read_text()):
        assert all(f"missing: {command}" in page for command in commands)
        assert "Nothing was trained or measured for this page" in page
        assert "84.8 / 96.1" in page  # the paper's
    assert "<h2>Plots</h2>" not in text


def test_what_is_missing_is_what_no_file_is_of() -> None:
    every = [fake_row(row=name, seed=seed) for name, seed in wanted()]
    assert missing(every) == []
    assert missing(every[1:]) == [("cltp", 0)]


def test_wordings_stand_beside_the_papers_prompt_and_chance(tmp_path: Path) -> None:
    values = {"zero_shot": 80.0, "zero_shot_unseen": 72.0, "zero_shot_synonyms": 20.0}
    results = [fake_result(table=t, values=dict.fromkeys(CLASSES, v)) for t, v in values.items()]
    save_row(tmp_path, fake_row(results))
    lines = report(tmp_path, tmp_path)[0].read_text().splitlines()
    (unseen,) = [line for line in lines if line.startswith("| CLTP, all points: unseen wordings")]
    assert "72.0 / 72.0 / 72.0 / 72.0 / 72.0 | 90 % | grid |" in unseen
    (chance,) = [line for line in lines if line.startswith("| chance")]
    assert "5.3 / 20.0 / 25.0 / 11.1 / 20.0" in chance


def test_methods_are_ranked_on_equal_input(tmp_path: Path) -> None:
    """CLTP of all points must not outrank methods that are given 1024."""
    order = {"cltp": 60.0, "cltp_no_image": 50.0, "point_bert": 40.0, "point_mae": 41.0}
    results = [
        fake_result(method=name, variant="small", values=dict.fromkeys(CLASSES, value))
        for name, value in {**order, "random": 30.0}.items()
    ]
    names = ("cltp_even", "no_image", "point_bert", "point_mae", "random")
    for name, result in zip(names, results, strict=True):
        save_row(
            tmp_path, fake_row([result], row=name, method=result.method, variant=result.variant)
        )
    save_row(tmp_path, fake_row([fake_result(values=dict.fromkeys(CLASSES, 10.0))]))
    line = "Probes, contact | mean | as in the paper | CLTP 60.0 > CLTP w/o image 50.0 > Point-MAE"
    assert line in report(tmp_path, tmp_path)[0].read_text()
    lower = dataclasses.replace(results[1], values=dict.fromkeys(CLASSES, 60.5))
    save_row(tmp_path, fake_row([lower], row="no_image", method="cltp_no_image", variant="small"))
    assert "Probes, contact | mean | differs" in report(tmp_path, tmp_path)[0].read_text()


def test_damaged_rows_are_refused_by_name(tmp_path: Path) -> None:
    path = save_row(tmp_path, fake_row())
    whole = path.read_text()
    path.write_text(whole[:200])
    with pytest.raises(TouchError, match=r"cltp-seed0\.json is damaged"):
        report(tmp_path, tmp_path)
    path.write_text(whole.replace('"seed": 0', '"seed": "x"'))
    with pytest.raises(TouchError, match=r"cltp-seed0\.json is damaged"):
        report(tmp_path, tmp_path)
