"""The loop never waits for a viewer; what a slow one can't draw is left out and counted."""

from __future__ import annotations

import logging
import threading

import pytest

from tacgrasp.__main__ import main
from tacgrasp.episodes import StepRecord
from tacgrasp.viewer.feed import WAITING, Feed
from tests.fakes.episode_samples import step_record


def test_steps_are_drawn_in_order_before_it_ends() -> None:
    drawn: list[int] = []
    feed = Feed(lambda record: drawn.append(record.index))
    for index in range(5):
        feed(step_record(index))
    feed.close()
    assert drawn == list(range(5))
    assert feed.num_dropped == 0


def test_a_viewer_that_stands_still_holds_up_nothing_and_fills_no_memory() -> None:
    go_on, drawn = threading.Event(), []

    def draw(record: StepRecord) -> None:
        go_on.wait(10)
        drawn.append(record.index)

    feed = Feed(draw)
    step = step_record(0)
    for _ in range(WAITING + 50):  # returns, though nothing is drawn
        feed(step)
    assert feed.num_dropped >= 49
    go_on.set()
    feed.close()
    assert len(drawn) <= WAITING + 1


def test_a_viewer_that_fails_ends_the_drawing_and_says_so(
    caplog: pytest.LogCaptureFixture,
) -> None:
    def fail(record: StepRecord) -> None:
        raise OSError("the viewer was closed")

    with caplog.at_level(logging.ERROR):
        feed = Feed(fail)
        feed(step_record(0))
        feed.close()
        feed(step_record(1))  # goes on
    assert "the run goes on without it" in caplog.text


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["view"], "name one thing to see: EPISODE, --rig R or --sensor R; got 0"),
        (["view", "e.mcap", "--rig", "sim"], "got 2"),
        (["view", "--rig", "sim", "--seconds", "0"], "--seconds must be above 0"),
    ],
)
def test_wrong_use_of_view_is_refused(
    argv: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(argv) == 2
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize(
    ("argv", "extra"),
    [
        (["view", "e.mcap"], "view"),
        (["run", "--view"], "view"),
        (["episodes", "export", "E", "--to", "rrd"], "export"),
    ],
)
def test_without_rerun_the_command_that_installs_it_is_named(
    argv: list[str],
    extra: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: object,
) -> None:
    from importlib import util
    from pathlib import Path

    old = Path(__file__).parents[1] / "episodes" / "data" / "format1.mcap"
    monkeypatch.setattr(util, "find_spec", lambda name: None)
    monkeypatch.setattr("tacgrasp.__main__.check_packages", lambda: None, raising=False)
    monkeypatch.setattr("tacgrasp.base.package_check.check_packages", lambda: None)
    assert main([str(old) if part == "E" else part for part in argv]) == 2
    assert f"pip install 'tacgrasp[{extra}]'" in capsys.readouterr().err
