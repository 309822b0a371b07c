"""The robustness benchmark on a tiny run: its cells, its limits, and how it goes on."""

import json
import math

import pytest

from cltp.tactile.states import CLASSES
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.robustness.conditions import NOMINAL, NUISANCES
from tacgrasp.benchmarks.robustness.readers import constant_answer
from tacgrasp.benchmarks.robustness.report import draw
from tacgrasp.benchmarks.robustness.store import CellResult, Store, job_name
from tests.fakes.tiny_weights import make_data, make_weights, state

ABOUT = {"episodes": 4, "first_seed": 1_000_000}


def bench(folder, *argv: str) -> dict:
    common = ["--quick", "--workers", "1", "--nuisances", "order", "--json", str(folder / "f.json")]
    weights = ["--weights", str(folder / "weights"), "--data", str(folder / "data")]
    assert main(["bench", "robustness", *common, *weights, *argv]) in (0, None)
    return json.loads((folder / "f.json").read_text())


def cell(report: dict, **wanted) -> dict:
    (found,) = (
        each
        for each in report["cells"]
        if all(each[name] == value for name, value in wanted.items())
    )
    return found


@pytest.mark.slow
def test_a_tiny_run_has_all_cells_and_goes_on_with_further_subjects(tmp_path):
    make_weights(tmp_path / "weights")
    make_data(tmp_path / "data", 12)
    report = bench(tmp_path, "--subjects", "heads")
    keys = ["nuisance", "level", "subject", "metric", "value", "limit", "n"]
    assert all(list(each) == keys for each in report["cells"])
    for metric in [*CLASSES, "force_error_percent"]:
        nominal, shuffled = (
            cell(report, nuisance="order", level=level, subject="heads", metric=metric)
            for level in (0.0, 1.0)
        )
        assert nominal["value"] == shuffled["value"]  # to the encoder points have no order
        assert nominal["n"] == 12
        assert (nominal["limit"] is None) == (metric in ("shape", "texture"))
        constant = cell(report, nuisance="order", level=0.0, subject="constant", metric=metric)
        assert constant["limit"] is None
    heads = {name: each for name, each in report["results"].items() if "heads" in name}

    resumed = bench(
        tmp_path, "--subjects", "heads,rules", "--resume", "--plot", str(tmp_path / "f.png")
    )
    assert {n: each for n, each in resumed["results"].items() if "heads" in n} == heads
    for level in (0.0, 1.0):
        rules = cell(resumed, nuisance="order", level=level, subject="rules")
        oracle = cell(resumed, nuisance="order", level=level, subject="oracle")
        assert rules["metric"] == "verified_percent" and rules["n"] == 4
        assert rules["limit"] == oracle["value"]
    assert (tmp_path / "f.png").stat().st_size > 10_000


def test_results_are_shared_by_the_nuisances_whose_nominal_level_is_the_same():
    assert job_name("rules", "fine", NOMINAL) == job_name("rules", "gel_young", NOMINAL)
    assert job_name("rules", "rotation", NUISANCES["rotation"][0.0]) == job_name(
        "rules", "order", NOMINAL
    )
    # contacts of the gels are pressed for them, and not every contact can be turned
    assert job_name("heads", "fine", NOMINAL) == job_name("heads", "order", NOMINAL)
    assert job_name("heads", "fine", NOMINAL) != job_name("heads", "gel_young", NOMINAL)
    assert job_name("heads", "rotation", NUISANCES["rotation"][0.0]) != job_name(
        "heads", "order", NOMINAL
    )


def stored(path, about=ABOUT) -> Store:
    return Store(path=path, about=about)


def test_figures_are_read_back_as_they_were_written(tmp_path):
    store = stored(tmp_path / "f.json")
    name = job_name("heads", "fine", NOMINAL)
    result = CellResult(
        n=3, seconds=0.5, values={"shape": math.nan, "depth": 66.67}, verified="101"
    )
    store.add(name, result)
    again = stored(tmp_path / "f.json")
    again.read(resume=True)
    assert again.results[name].values["depth"] == 66.67
    assert math.isnan(again.results[name].values["shape"])
    assert again.results[name].verified == "101"


@pytest.mark.parametrize(
    ("content", "about", "resume", "message"),
    [
        (None, ABOUT, False, "--resume goes on with figures"),
        (None, ABOUT | {"episodes": 8}, True, "episodes 4 instead of 8"),
        ("{}", ABOUT, True, "does not hold figures"),
        ('{"about": 1', ABOUT, True, "does not hold figures"),
        ('{"about": {}, "results": {"a": 3}}', ABOUT, True, "does not hold figures"),
    ],
)
def test_other_files_are_refused_before_anything_is_measured(
    tmp_path, content, about, resume, message
):
    path = tmp_path / "f.json"
    stored(path).add("a", CellResult(n=1, seconds=1.0, values={}))
    if content is not None:
        path.write_text(content)
    with pytest.raises(UsageError, match=message) as caught:
        stored(path, about).read(resume=resume)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--subjects", "heads,oracles"], "unknown oracles; known: heads"),
        (["--nuisances", "rain"], "unknown rain; known: fine"),
        (["--resume"], "--resume needs --json"),
        (["--episodes", "0"], "must be at least 1"),
        (["--plot", "f.pdf"], "expects a file ending in .png"),
    ],
)
def test_wrong_use_is_told_in_one_line(argv, expected, capsys):
    assert main(["bench", "robustness", *argv]) == 2
    printed = capsys.readouterr()
    assert expected in printed.err
    assert printed.err.count("\n") == 1


def test_the_constant_answer_is_right_as_often_as_its_class_is_found():
    states = [state(0.0, 0.0, 0.5, 1.0)] * 3 + [state(8.0, 6.0, 0.7, 2.0)]
    figures = constant_answer(states)
    assert figures["depth"] == figures["position"] == 75.0
    assert figures["shape"] == 100.0
    assert figures["force_error_percent"] == 0.0


def test_a_picture_that_can_not_be_written_is_told(tmp_path):
    with pytest.raises(UsageError, match="--plot"):
        draw(stored(None), tmp_path / "none" / "f.png")
