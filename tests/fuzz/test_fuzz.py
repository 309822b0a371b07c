"""Every parser takes mutated input as documented, and the harness sees it when one does not."""

import gc
import json
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fuzz import runner
from tests.fuzz.runner import fuzz
from tests.fuzz.target import FuzzTarget
from tests.fuzz.targets import all_targets

BUDGET_S = 20.0
"""Time of all parsers together [s]; `make fuzz` runs them longer."""


@pytest.fixture(scope="module", autouse=True)
def _garbage_of_other_tests_is_no_cases() -> Iterator[None]:
    """Leave what other tests hold to no collection: one takes over a second of a case's time."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.mark.parametrize("target", all_targets(), ids=lambda target: target.name)
def test_mutated_input_is_read_or_refused_as_documented(target: FuzzTarget, tmp_path: Path) -> None:
    budget_s = BUDGET_S / len(all_targets())
    result = fuzz(target, 100_000, seed=0, out=tmp_path, budget_s=budget_s)
    findings = [path.read_text() for path in sorted(tmp_path.glob("*.txt"))]
    assert result.undocumented == 0, findings[0]
    assert result.cases > 50


def wrong_at(trigger: int, error: Exception | None = None, wait_s: float = 0.0) -> FuzzTarget:
    """A parser of numbers that is wrong at one of them."""

    def read(data: bytes) -> None:
        if int(data) == trigger:
            ends_s = time.thread_time() + wait_s
            while time.thread_time() < ends_s:
                pass
            if error is not None:
                raise error
        raise ValueError("not this one")

    def make_case(rng: object) -> bytes:
        make_case.number += 1  # type: ignore[attr-defined]
        return b"%d" % (make_case.number % 40)  # type: ignore[attr-defined]

    make_case.number = 0  # type: ignore[attr-defined]
    return FuzzTarget(name="fake", make_case=make_case, read=read, documented=(ValueError,))


def test_an_undocumented_error_is_counted_and_its_input_kept(tmp_path: Path) -> None:
    result = fuzz(wrong_at(20, KeyError("lost")), 30, seed=3, out=tmp_path)
    assert (result.cases, result.undocumented) == (30, 1)
    (kept,) = tmp_path.glob("fake-3-*.txt")
    assert "KeyError: 'lost'" in kept.read_text()
    assert kept.with_suffix(".bin").exists()


def test_an_error_of_several_lines_is_a_finding(tmp_path: Path) -> None:
    assert fuzz(wrong_at(20, ValueError("a\nb")), 30, seed=3, out=tmp_path).undocumented == 1


def test_a_slow_case_and_a_hang_are_findings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner, "MAX_CASE_S", 0.05)
    result = fuzz(wrong_at(20, wait_s=0.1), 30, seed=3, out=tmp_path / "slow")
    assert result.undocumented == 1
    assert result.slowest_s >= 0.1
    monkeypatch.setattr(runner, "HANG_S", 1)
    result = fuzz(wrong_at(20, wait_s=60.0), 30, seed=3, out=tmp_path / "hang")
    assert result.undocumented == 1


def test_a_second_call_goes_on_with_the_same_cases(tmp_path: Path) -> None:
    target = next(target for target in all_targets() if target.name == "extraction")
    fuzz(target, 20, seed=1, out=tmp_path)
    result = fuzz(target, 50, seed=1, out=tmp_path)
    assert result.cases == 50
    assert json.loads((tmp_path / "extraction-1.json").read_text())["cases"] == 50
    assert runner.case_of(target, 1, 7) == runner.case_of(target, 1, 7)
    assert runner.case_of(target, 1, 7) != runner.case_of(target, 2, 7)
