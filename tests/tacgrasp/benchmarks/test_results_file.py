"""Benchmarks that were ended go on with the file of their figures, and with no other."""

import json
import math
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest
from rich.console import Console

from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks import results_file
from tacgrasp.benchmarks.results_file import WRITE_EVERY, SeedResults
from tests.paths import ROOT

ABOUT = {"benchmark": "strawberry", "first_seed": 7, "weights": None}
CONSOLE = Console(quiet=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Drop:
    """A result as benchmarks have them."""

    seed: int
    place_mm: tuple[float, float]
    force_n: float | None = None


def drop(seed: int) -> Drop:
    return Drop(seed=seed, place_mm=(seed / 3, math.inf), force_n=None if seed % 2 else 0.1)


@pytest.fixture(autouse=True)
def computed(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Seeds in the order of their computation, which is in this process."""
    seeds: list[int] = []

    def each(console, name, function, missing):
        for seed in missing:
            seeds.append(seed)
            yield function(seed)

    monkeypatch.setattr(results_file, "each_result", each)
    return seeds


def opened(path: Path | None, *, resume: bool = True, **about: object) -> SeedResults:
    store = SeedResults(path=path, about=ABOUT | about)
    store.read(resume=resume)
    return store


def test_results_come_back_as_they_were_and_are_computed_once(tmp_path, computed):
    path = tmp_path / "f.json"
    first = opened(path, resume=False).map_seeds(CONSOLE, "drops", Drop, drop, range(3))
    again = opened(path).map_seeds(CONSOLE, "drops", Drop, drop, range(5))
    assert first == [drop(seed) for seed in range(3)]
    assert again == [drop(seed) for seed in range(5)]
    assert computed == [0, 1, 2, 3, 4]


def test_parts_keep_their_results_apart(tmp_path, computed):
    path = tmp_path / "f.json"
    opened(path, resume=False).map_seeds(CONSOLE, "drops", Drop, drop, range(2))
    assert opened(path).map_seeds(CONSOLE, "doubles", int, lambda seed: 2 * seed, range(2)) == [
        0,
        2,
    ]
    assert computed == [0, 1, 0, 1]


def test_the_file_is_written_after_every_few_seeds_and_by_an_error(tmp_path):
    path, sizes = tmp_path / "f.json", []

    def failing(seed: int) -> int:
        sizes.append(len(json.loads(path.read_text())["results"]["n"]) if path.exists() else 0)
        if seed == WRITE_EVERY + 2:
            raise RuntimeError("out of berries")
        return seed

    with pytest.raises(RuntimeError, match="out of berries"):
        opened(path, resume=False).map_seeds(CONSOLE, "n", int, failing, range(50))
    assert sizes[WRITE_EVERY - 1 : WRITE_EVERY + 1] == [0, WRITE_EVERY]
    assert len(json.loads(path.read_text())["results"]["n"]) == WRITE_EVERY + 2


def test_what_is_no_file_is_given_the_figures_alone(monkeypatch):
    written = []
    monkeypatch.setattr(results_file, "write_figures", lambda path, report: written.append(report))
    store = opened(Path("/dev/null"), resume=False)
    store.map_seeds(CONSOLE, "n", int, lambda seed: seed, range(WRITE_EVERY + 1))
    assert not written
    store.write({"sum": 15})
    assert [report["sum"] for report in written] == [15]


@pytest.mark.parametrize(
    ("content", "about", "resume", "message"),
    [
        (None, {}, False, "--resume goes on with figures"),
        (None, {"weights": "ab12"}, True, "weights None instead of 'ab12'; name another file"),
        (None, {"first_seed": 8}, True, "first_seed 7 instead of 8; name another file"),
        (None, {"benchmark": "missed"}, True, "benchmark 'strawberry' instead of 'missed'"),
        ("{}", {}, True, "does not hold figures of bench strawberry to go on with"),
        ("no", {}, True, "does not hold figures of bench strawberry to go on with"),
        ('{"about": {"benchmark": ', {}, True, "does not hold figures"),
        (json.dumps({"about": ABOUT, "results": {"drops": 3}}), {}, True, "does not hold figures"),
    ],
)
def test_other_files_are_refused_in_one_line(tmp_path, content, about, resume, message):
    path = tmp_path / "f.json"
    opened(path).map_seeds(CONSOLE, "drops", Drop, drop, range(1))
    if content is not None:
        path.write_text(content)
    with pytest.raises(UsageError, match=message) as caught:
        opened(path, resume=resume, **about)
    assert "\n" not in str(caught.value)


def test_results_of_another_kind_are_refused(tmp_path):
    path = tmp_path / "f.json"
    opened(path).map_seeds(CONSOLE, "drops", int, lambda seed: seed, range(2))
    with pytest.raises(UsageError, match="does not hold figures"):
        opened(path).map_seeds(CONSOLE, "drops", Drop, drop, range(2))


@pytest.mark.parametrize("name", ["strawberry", "missed", "verifier", "contact", "robustness"])
def test_to_go_on_needs_a_file(name, capsys):
    assert main(["bench", name, "--resume"]) == 2
    assert "--resume needs --json" in capsys.readouterr().err


@pytest.mark.slow
def test_a_killed_benchmark_goes_on_and_ends_with_the_figures_of_an_undisturbed_one(tmp_path):
    killed, whole = tmp_path / "killed.json", tmp_path / "whole.json"
    bench = ["bench", "strawberry", "--policies", "rules", "--episodes", "14"]
    with subprocess.Popen(
        [sys.executable, "-m", "tacgrasp", *bench, "--json", str(killed)],
        cwd=ROOT,
        stdout=subprocess.DEVNULL,
    ) as process:
        for _ in range(600):
            if killed.exists() and killed.stat().st_size:
                break
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
    kept = json.loads(killed.read_text())["results"]["episodes"]
    assert WRITE_EVERY <= len(kept) < 14
    assert main([*bench, "--json", str(killed), "--resume"]) == 0
    assert main([*bench, "--json", str(whole)]) == 0
    reports = [json.loads(path.read_text()) for path in (killed, whole)]
    assert all(reports[0]["results"]["episodes"][seed] == kept[seed] for seed in kept)
    for report in reports:
        del report["results"]  # they hold the time of each episode
        report["policies"]["rules"].pop("seconds_per_episode")
        for episode in report["episodes_by_policy"]["rules"]:
            episode.pop("seconds")
    assert reports[0] == reports[1]
