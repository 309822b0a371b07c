"""Pre-training methods on the command line: trained, evaluated, reported; wrong use refused."""

import csv
import dataclasses
import json
import re
import shutil
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from cltp.checkpoints.tac3d_llm import load_clip, save_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.evaluation.probes import SCHEDULE, ProbeTraining
from cltp.evaluation.scores import ClassScores
from cltp.evaluation.splits import EvaluationSplit
from cltp.tactile.states import CLASSES
from cltp.train.recipes import Schedule
from tacgrasp.__main__ import main
from tacgrasp.pretraining import evaluation_run, geometric_baseline, methods
from tacgrasp.pretraining.checkpoints import find_method
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.report.paper_numbers import PAPER
from tacgrasp.pretraining.report.report import report
from tacgrasp.pretraining.report.store import (
    TITLES,
    grouped,
    load_results,
    mean,
    nested,
    save,
    spread,
)
from tests.fakes.fake_contacts import fake_contact
from tests.fakes.fake_results import fake_result

pytestmark = pytest.mark.usefixtures("threads_as_before")

QUICK = ["--steps", "3", "--batch-size", "4", "--threads", "1"]


def write_data(folder: Path, first: int = 0) -> Path:
    with DatasetWriter(folder) as writer:
        for seed in range(first, first + 10):
            writer.add(fake_contact(seed))
        for seed in range(first + 100, first + 105):
            writer.add(fake_contact(seed, split=Split.VALIDATION))
        for seed in range(first + 200, first + 206):
            writer.add(fake_contact(seed, split=Split.TEST))
    return folder


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_data(tmp_path_factory.mktemp("data"))


@pytest.fixture(scope="module")
def out(data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with CLIP, CLTP and the floor, hardly trained."""
    folder = tmp_path_factory.mktemp("methods")
    where = ["--out", str(folder), "--data", str(data), "--threads", "1"]
    with pytest.MonkeyPatch.context() as patch:
        brief = partial(methods.train_words, num_contacts=100, size=1024)
        patch.setattr(methods, "train_words", brief)
        assert main(["train", "clip", *where, "--steps", "2"]) == 0
    assert main(["train", "cltp", *where, "--preset", "tiny", *QUICK]) == 0
    assert main(["train", "random", *where, "--preset", "tiny"]) == 0
    return folder


@pytest.fixture
def places(out: Path, data: Path, tmp_path: Path) -> list[str]:
    flags = ["--weights", str(out), "--data", str(data), "--results", str(tmp_path / "results")]
    return [*flags, "--threads", "1"]


@pytest.fixture
def quick_probes(monkeypatch: pytest.MonkeyPatch) -> None:
    quick = Schedule(steps=5, batch_size=8, learning_rate=SCHEDULE.learning_rate)
    monkeypatch.setattr(evaluation_run, "ProbeTraining", partial(ProbeTraining, schedule=quick))


def real_touches(folder: Path, rows: str = "0.npy,sphere,,,,\n", count: int = 1) -> list[str]:
    """Flags of a folder of height maps with a table of labels."""
    folder.mkdir(exist_ok=True)
    for number in range(count):
        np.save(folder / f"{number}.npy", fake_contact(number).height_mm)
    table = folder / "labels.csv"
    table.write_text(f"file,shape,texture,depth,position,area\n{rows}")
    predictions = str(folder / "predictions.csv")
    return ["--real", str(folder), "--labels", str(table), "--out", predictions]


def complaint(argv: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    capsys.readouterr()
    assert main(argv) == 2
    *_, last = capsys.readouterr().err.splitlines()  # progress may stand above it
    assert last.startswith("tacgrasp: ")
    return last


def test_a_trained_method_says_how_it_came_about_and_is_not_trained_again(
    out: Path, data: Path
) -> None:
    about = json.loads((out / "cltp" / "about.json").read_text())
    assert (about["method"], about["preset"], about["steps"]) == ("cltp", "tiny", 3)
    assert about["recipe"]["head_weight"] == 1.0
    assert "tacgrasp train cltp" in about["command"]
    weights = out / "cltp" / "encoder" / "model.safetensors"
    before = weights.stat().st_mtime_ns
    argv = ["train", "cltp", "--out", str(out), "--data", str(data), "--preset", "tiny", *QUICK]
    assert main(argv) == 0
    assert weights.stat().st_mtime_ns == before


@pytest.mark.parametrize("name", ["labels.csv", "mine.csv"])
def test_predictions_replace_no_table_of_labels(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    argv = ["eval", "zero-shot", *real_touches(tmp_path / "touches")]
    argv[-1] = str(tmp_path / "touches" / name)
    (tmp_path / "touches/mine.csv").write_text("my precious\n")
    before = Path(argv[-1]).read_bytes()
    assert "exists and holds no predictions" in complaint(argv, capsys)
    assert Path(argv[-1]).read_bytes() == before


def test_tables_are_measured_stored_and_reported(
    places: list[str], tmp_path: Path, quick_probes: None
) -> None:
    figures = tmp_path / "figures.json"
    assert main(["eval", "zero-shot", *places, "--json", str(figures)]) == 0
    zero = json.loads(figures.read_text())["zero_shot"]
    assert set(zero) == {"cltp", "geometric_baseline"}
    assert set(zero["cltp"]["contact"]) == set(CLASSES)
    assert zero["geometric_baseline"]["contact"]["shape"] is None
    assert zero["geometric_baseline"]["contact"]["depth"] > 30
    assert main(["eval", "probe", *places, "--seeds", "2", "--json", str(figures)]) == 0
    found = json.loads(figures.read_text())
    assert set(found["probe"]) == {"cltp", "random", "geometric_baseline"}
    numbers = found["numbers"]["contact_noisy"]
    assert {"depth_mm", "coverage_depth"} <= set(numbers)
    assert set(numbers["force"]) == {"median_error", "inside", "width"}
    assert numbers["position"]["median_error"] == numbers["position_mm"]
    results = tmp_path / "results"
    alone = [
        r for r in load_results(results) if r.variant == "heights alone" and r.split == "contact"
    ]
    assert {slot for slot, v in alone[0].values.items() if v is not None} == {"depth", "area"}
    assert main(["eval", "retrieval", *places]) == 0
    argv = ["eval", "report", "--results", str(results), "--json", str(figures)]
    assert main(argv) == 0
    assert {"zero_shot", "probe", "numbers", "retrieval"} <= set(json.loads(figures.read_text()))
    text = (results / "pretraining.md").read_text()
    assert "| CLTP | " in text
    assert "84.8" in text  # the paper's
    assert "tacgrasp eval probe" in text
    page = (results / "pretraining.html").read_text()
    assert page.count("<table>") == text.count("\n|---|")
    assert "data:image/png;base64," in page
    assert "data:image/webp;base64," in page  # contacts that failed
    for plot in re.findall(r"!\[.*\]\((.*)\)", text):
        assert (results / plot).stat().st_size > 1000
    assert "Without an accelerator." in text
    assert "spread over 2 seeds of probes for CLTP, random encoder" in text


def test_baselines_are_measured_once(
    places: list[str], tmp_path: Path, quick_probes: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[int | None] = []
    whole = geometric_baseline.score_geometry

    def counted(run: EvaluationRun, split: EvaluationSplit) -> ClassScores:
        calls.append(run.limit)
        return whole(run, split)

    monkeypatch.setattr(geometric_baseline, "score_geometry", counted)
    few = ["eval", "zero-shot", *places, "--limit", "4"]
    assert main(few) == main(["eval", "probe", *places]) == 0
    splits = len(calls) // 2
    assert calls == [4] * splits + [None] * splits
    alone = tmp_path / "results" / "probe-geometric_baseline-heights alone-contact-s0.json"
    before = alone.stat().st_mtime_ns
    assert main(few) == main(["eval", "probe", *places]) == 0
    assert len(calls) == 2 * splits
    assert alone.stat().st_mtime_ns == before
    assert main(["eval", "zero-shot", *places]) == 0  # of other contacts
    assert calls[2 * splits :] == [None] * splits


def test_text_finds_contacts_and_a_contact_finds_texts(
    places: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert (
        main(["eval", "retrieval", *places, "--text", "Contact at top-left.", "--count", "2"]) == 0
    )
    assert "the nearest of 6 contacts" in capsys.readouterr().out
    page = tmp_path / "found.html"
    assert main(["eval", "retrieval", *places, "--contact", "3", "--page", str(page)]) == 0
    text = capsys.readouterr().out
    assert re.search(r"contact 3 \(.*\) is: a .*\n.*own words are number \d of \d texts", text)
    assert page.read_text().count("<img") == 1
    assert page.read_text().count("<li") == 5
    assert "one of them" in complaint(
        ["eval", "retrieval", *places, "--contact", "3", "--text", "x"], capsys
    )
    assert "it has 0 to" in complaint(["eval", "retrieval", *places, "--contact", "900"], capsys)


def test_real_touches_are_named_from_a_table(
    places: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "real"
    rows = "0.npy,sphere,,deep,,\n1.npy,,smooth,,centered,\n2.npy,,,,,tiny\n"
    flags = ["eval", "zero-shot", *places, *real_touches(folder, rows, 3)]
    assert main(flags) == 0
    predictions = list(csv.DictReader((folder / "predictions.csv").open()))
    assert len(predictions) == 3
    assert predictions[0]["shape"] in CLASSES["shape"]
    (stored,) = (tmp_path / "results").glob("*cltp*real*.json")
    assert sum(map(sum, json.loads(stored.read_text())["confusion"]["depth"])) == 1
    (baseline,) = (tmp_path / "results").glob("*geometric_baseline*real*.json")
    assert json.loads(baseline.read_text())["values"]["shape"] is None
    for row, expected in (
        ("0.npy,blob", "row 2: no shape 'blob'"),
        ("9.npy,", "9.npy does not exist"),
        ("0.npy,sphere,", "row 2: more than 6 fields; a comma"),
    ):
        real_touches(folder, f"{row},,,,\n")
        assert expected in complaint(flags, capsys)
    (folder / "labels.csv").write_text("file,shape\n0.npy,sphere\n")
    assert "needs the columns" in complaint(flags, capsys)
    assert "belong together" in complaint(flags[:-4], capsys)


def test_an_encoder_of_all_points_names_real_touches(out: Path, tmp_path: Path) -> None:
    shutil.copytree(out / "clip", tmp_path / "weights" / "clip")
    config = dataclasses.replace(PRESETS["tiny_grid"], dim=24)
    wide = load_clip(out / "clip").feature_dim
    encoder = TactileEncoder(dataclasses.replace(config, feature_dim=wide))
    save_encoder(tmp_path / "weights" / "encoder", encoder, StateHeads(48))
    argv = [*real_touches(tmp_path), "--weights", str(tmp_path / "weights")]
    assert main(["eval", "zero-shot", *argv]) == 0
    (row,) = csv.DictReader((tmp_path / "predictions.csv").open())
    assert row["shape"] in CLASSES["shape"]


def test_cltp_learns_from_a_further_set_and_says_so(
    out: Path, data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other, folder = write_data(tmp_path / "other", first=40), tmp_path / "methods"
    shutil.copytree(out / "clip", folder / "clip")
    argv = ["train", "cltp", "--data", str(data), "--out", str(folder), "--preset", "tiny", *QUICK]
    assert main([*argv, "--also", str(other)]) == 0
    about = json.loads((folder / "cltp" / "about.json").read_text())
    assert about["data"] == ContactDataset(data).checksum()
    assert about["also"] == ContactDataset(other).checksum()
    results = tmp_path / "results"
    places = ["--weights", str(folder), "--data", str(data), "--results", str(results)]
    assert main(["eval", "zero-shot", *places, "--threads", "1"]) == 0
    assert list(results.glob("zero_shot-cltp-tiny+also-contact-s0.json"))
    alone, both = (ContactDataset(data, also=also).checksum()[:8] for also in ((), (other,)))
    assert f"training: data {both} instead of {alone}; delete it" in complaint(argv, capsys)
    assert "unknown arguments: --also" in complaint(
        ["train", "tvl", *argv[2:], "--also", str(other)], capsys
    )


def test_the_heads_learn_alone_where_no_contrast_is_minimised(
    out: Path, data: Path, tmp_path: Path
) -> None:
    shutil.copytree(out / "clip", tmp_path / "clip")
    argv = [
        "train",
        "cltp",
        "--data",
        str(data),
        "--out",
        str(tmp_path),
        "--preset",
        "tiny",
        *QUICK,
    ]
    assert main([*argv, "--contrast-weight", "0", "--prompt-weight", "0"]) == 0
    columns = (tmp_path / "cltp/.training/cltp.csv").read_text().splitlines()[0].split(",")
    assert "numbers" in columns
    assert not {"t2l", "t2i", "prompt_shape"} & set(columns)
    assert find_method("cltp", tmp_path).variant == "tiny+prompt_weight=0.0+contrast_weight=0.0"


def test_contacts_are_moved_by_a_share(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    argv = ["train", "cltp", "--data", str(data), "--out", str(tmp_path), "--moved"]
    assert "moved must be a fraction from 0 to 1, got 2" in complaint([*argv, "2"], capsys)


def test_probes_name_real_touches_by_points_and_by_frames(
    places: list[str], tmp_path: Path, quick_probes: None
) -> None:
    figures = tmp_path / "figures.json"
    argv = [*places, *real_touches(tmp_path), "--json", str(figures)]
    assert main(["eval", "probe", *argv]) == 0
    found = json.loads(figures.read_text())["probe"]
    assert set(found) == {"cltp", "random", "geometric_baseline"}
    assert found["cltp"]["real"]["shape"] in (0.0, 100.0)
    assert found["cltp"]["real"]["depth"] is None
    (row,) = csv.DictReader((tmp_path / "predictions-random.csv").open())
    assert 0 < float(row["depth_probability"]) <= 1


def test_an_image_encoder_of_others_stands_for_a_method(
    out: Path, places: list[str], tmp_path: Path, quick_probes: None
) -> None:
    figures = tmp_path / "figures.json"
    argv = ["--methods", "tvl", "--checkpoint", str(out / "clip"), "--json", str(figures)]
    assert main(["eval", "probe", *places, *argv]) == 0
    assert json.loads(figures.read_text())["probe"]["tvl"]["contact"]["shape"] is not None
    (stored,) = (tmp_path / "results").glob("probe-tvl-*-contact-s0.json")
    content = json.loads(stored.read_text())
    assert (content["variant"], content["budget"]) == ("checkpoint clip", None)


def test_shipped_weights_name_real_touches_and_store_nothing(
    out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for part in ("clip", "cltp/encoder"):
        shutil.copytree(out / part, tmp_path / "weights" / Path(part).name)
    argv = ["--weights", str(tmp_path / "weights"), "--results", str(tmp_path / "results")]
    argv += real_touches(tmp_path)
    assert main(["eval", "zero-shot", *argv]) == 0
    assert "not stored for the report" in capsys.readouterr().out
    assert not list(tmp_path.glob("results/*.json"))


def test_results_come_back_as_they_were(tmp_path: Path) -> None:
    save(tmp_path, fake_result())
    save(tmp_path, fake_result(values=dict.fromkeys(CLASSES, 60.0)))  # takes its place
    save(tmp_path, fake_result(seed=1))
    found = load_results(tmp_path)
    assert len(found) == 2
    assert found[0].values["shape"] == 60.0
    assert nested(grouped(found))["probe"]["cltp"]["contact"]["shape"] == 55.0
    (rows,) = grouped(found).values()
    assert spread([row.values["shape"] for row in rows]) == 10.0
    assert mean([None, None]) is None


def test_a_report_never_mixes_data(tmp_path: Path) -> None:
    save(tmp_path, fake_result())
    save(tmp_path, fake_result(method="random", data="def"))
    with pytest.raises(TouchError, match="different data sets"):
        report(tmp_path, tmp_path)
    assert not list(tmp_path.glob("*.html"))


def test_damaged_results_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    argv = ["eval", "report", "--results", str(tmp_path)]
    assert "no folder" in complaint([*argv[:-1], str(tmp_path / "none")], capsys)
    path = save(tmp_path, fake_result())
    path.write_text(path.read_text().replace('"version": 2', '"version": 1'))
    assert "of version 1, not tacgrasp-result of version 2" in complaint(argv, capsys)
    path.write_text("{")
    assert "is damaged" in complaint(argv, capsys)


def test_the_report_has_the_papers_order_and_the_budgets(tmp_path: Path) -> None:
    for method in reversed(TITLES):
        save(tmp_path, fake_result(method=method))
    (page, _) = report(tmp_path, tmp_path)
    lines = [line.split(" | ")[0][2:] for line in page.read_text().splitlines()]
    first = lines.index("CLTP, probe") if "CLTP, probe" in lines else 0
    named = [line for line in lines[first:] if line in TITLES.values()]
    assert named[-len(TITLES) :] == list(TITLES.values())
    assert "| grid | – | 40 | – | 1 |" in page.read_text()  # points, samples, minutes, seeds


def test_the_papers_numbers_have_five_dimensions() -> None:
    assert all(len(row) == len(CLASSES) for row in PAPER.values())
    assert {method for _, method, _ in PAPER} <= set(TITLES)


def test_encoders_of_other_data_are_refused(
    out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = write_data(tmp_path / "other", first=1000)
    argv = ["eval", "probe", "--weights", str(out), "--data", str(other), "--methods", "cltp"]
    assert "test contacts could have been learned from" in complaint(
        [*argv, "--results", str(tmp_path / "r")], capsys
    )


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["eval", "zero-shot", "--methods", "random"], "no prompts for contact states"),
        (["eval", "probe", "--methods", "tvl"], "do `tacgrasp train tvl"),
        (["eval", "probe", "--splits", "moon"], "it has contact, contact_noisy"),
        (["eval", "probe", "--limit", "0"], "--limit must be at least 1"),
        (["eval", "probe", "--checkpoint", "."], "--methods tvl or unitouch"),
        (["eval", "probe", "--methods", "cltp", "--checkpoint", "."], "is for tvl or unitouch"),
        (["eval", "probe", "--methods", "tvl", "--checkpoint", "/no"], "is no directory"),
        (
            ["eval", "dance"],
            "expects one of ablate, captions, instructions, intervals, own, questions, zero-shot, "
            "probe, retrieval, row, report",
        ),
    ],
)
def test_wrong_use_of_eval_is_told_in_one_line(
    argv: list[str], expected: str, places: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in complaint([*argv, *places], capsys)


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["cltp", "--preset", "giant"], "unknown preset 'giant'"),
        (["tvl", "--no-image"], "unknown arguments: --no-image"),
        (["point-mae", "--steps", "0"], "--steps must be at least 1, got 0"),
        (["all", "--steps", "5"], "unknown arguments: --steps 5"),
        (["tvl", "--preset", "tiny"], "tvl needs an encoder of image"),
    ],
)
def test_wrong_use_of_train_is_told_in_one_line(
    argv: list[str],
    expected: str,
    data: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    where = ["--out", str(tmp_path), "--data", str(data)]
    assert expected in complaint(["train", *argv, *where], capsys)


def test_training_never_reads_a_test_contact(data: Path, out: Path, tmp_path: Path) -> None:
    """The same curve and weights come out when every test contact is another one."""
    weights = []
    for name, first in (("one", 0), ("other", 50)):
        folder = tmp_path / name
        with DatasetWriter(folder) as writer:
            for seed in range(10):
                writer.add(fake_contact(seed))
            for seed in range(200 + first, 206 + first):
                writer.add(fake_contact(seed, split=Split.TEST))
        shutil.copytree(out / "clip", tmp_path / f"{name}-out" / "clip")
        where = ["--out", str(tmp_path / f"{name}-out"), "--data", str(folder)]
        assert main(["train", "cltp", *where, "--preset", "tiny", *QUICK]) == 0
        weights.append((tmp_path / f"{name}-out/cltp/encoder/model.safetensors").read_bytes())
    assert weights[0] == weights[1]


def test_failures_are_named_with_their_share(tmp_path: Path) -> None:
    names = CLASSES["shape"]
    counts = [[0] * len(names) for _ in names]
    triangle, peak = names.index("triangle"), names.index("peak")
    counts[triangle][triangle], counts[triangle][peak], counts[peak][peak] = 3, 1, 5
    save(tmp_path, fake_result(confusion={"shape": counts}))
    page = report(tmp_path, tmp_path)[0].read_text()
    assert "| probe, contact | 25 / 0 | – / – | 50.0 | 88.9 | grid | triangle as peak (1) |" in page
