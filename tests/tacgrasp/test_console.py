"""What a run prints: two lines a step within a hundred columns, and one force with its name."""

from __future__ import annotations

import io
import re
import time
from dataclasses import replace

import pytest
from rich.console import Console

from cltp.tactile.force_scale import ForceScale
from primitives.primitive import Primitive
from primitives.sense import Interval
from tacgrasp.console import COLUMNS, StepPrinter, action_text, last_words, working
from tacgrasp.episodes import StepPhase, StepRecord
from tests.fakes.episode_samples import press, step_record

CALIBRATED = ForceScale(factor=1.3, spread=0.04, source="mini-1, 2026-03-01")
FELT = Interval(value=1.234, low=0.914, high=1.666)


def felt_step(index: int = 0, **changes: object) -> StepRecord:
    step = step_record(index)
    cloud = replace(step.cloud, force_scale=CALIBRATED)
    return replace(step, **{"cloud": cloud, "felt_force_n": FELT, "in_contact": True, **changes})


def printed(step: StepRecord, *, verbose: bool = False) -> list[str]:
    console = Console(file=io.StringIO(), soft_wrap=True, width=400)
    StepPrinter(console, verbose=verbose)(step)
    return console.file.getvalue().splitlines()  # type: ignore[attr-defined]


def unlimited(step: StepRecord) -> StepRecord:
    assert step.executed is not None
    return replace(step, executed=replace(step.executed, clamped=()))


def test_a_step_has_two_lines_what_is_felt_then_what_is_said_and_done() -> None:
    felt, done = printed(unlimited(felt_step()))
    assert "felt 1.23 N (0.91-1.67), " in felt
    assert "0.40 mm deep" in felt
    assert done.strip().endswith("→ move_down: 2.5 mm")
    assert "I will move_down." in done


def test_a_step_shows_one_force_and_it_has_a_name() -> None:
    decision = replace(
        step_record(0).decision,  # type: ignore[type-var]
        text="The contact is slight, " + 12 * "so it is, " + "about 0.2 N. It is off centre.",
        action=Primitive.INCREASE_FORCE,
    )
    executed = replace(
        unlimited(felt_step()).executed,  # type: ignore[type-var]
        primitive=Primitive.INCREASE_FORCE,
        sent="0.3 N",
    )
    felt, done = printed(felt_step(decision=decision, executed=executed))
    assert re.findall(r"(\w+) [\d.]+ N\b", felt) == ["felt"]
    assert re.findall(r"(\w+) [\d.]+ N\b", done) == ["commanded"]
    assert "… It is off centre.” → increase_force: commanded 0.30 N" in done


@pytest.mark.parametrize("action", [None, *Primitive])
@pytest.mark.parametrize("calibrated", [True, False])
def test_no_line_of_a_step_is_wider_than_a_hundred_columns(
    action: Primitive | None, calibrated: bool
) -> None:
    step = step_record(3, action=action)
    scale = CALIBRATED if calibrated else step.cloud.force_scale
    cloud = replace(press(-9.5, -7.0, 0.9), force_scale=scale)
    decision = replace(step.decision, text="A word. " * 80)  # type: ignore[type-var]
    step = replace(
        step,
        cloud=cloud,
        decision=decision,
        in_contact=True,
        felt_force_n=Interval(value=10.5, low=7.25, high=15.125),
        note="TouchError: " + "no frame came; " * 20,
    )
    for verbose in (False, True):
        lines = printed(step, verbose=verbose)
        assert max(map(len, lines)) <= COLUMNS
    assert ("uncalibrated" in printed(step)[0]) is not calibrated
    assert "cut: bottom left" in printed(step)[0]


def test_a_changed_command_and_a_survived_failure_are_shown_below() -> None:
    lines = printed(felt_step(note="TouchError: no frame"))
    assert [line.strip() for line in lines[2:]] == [
        "a step of 3 mm was cut to 2.5 mm",
        "TouchError: no frame",
    ]


def test_verbose_shows_all_of_the_text_the_command_and_the_duration() -> None:
    text = " ".join(" ".join(printed(felt_step(), verbose=True)).split())
    for part in (
        "Touch 0: the contact is at the bottom-center, I will move_down.",
        "sent 2.5 mm, (0.00, 0.00, -2.50) mm in the base frame",
        "confidence 0.33",
        "took 12 ms",
    ):
        assert part in text


def test_an_untouched_gel_and_the_phases_of_the_lift_are_named() -> None:
    _, done = printed(step_record(0, phase=StepPhase.VERIFY_BEFORE))
    assert done.strip() == "before the lift"
    assert "nothing touches the gel" in printed(replace(step_record(0), in_contact=False))[0]


def test_a_dry_run_says_what_would_be_done_with_its_forces_named() -> None:
    step = unlimited(step_record(0))
    assert step.executed is not None
    executed = replace(
        step.executed, dry_run=True, asked="start pose, close until something is felt, at most 1 N"
    )
    assert action_text(replace(step, executed=executed)) == (
        "move_down: dry run, would be start pose, close until something is felt, at most 1 N "
        "commanded"
    )


def test_the_last_whole_sentences_of_a_text_are_kept() -> None:
    text = "The force is about 0.2 N. It is off centre. Move the gripper downward."
    assert last_words(text, 100) == text
    assert last_words(text, 50) == "… It is off centre. Move the gripper downward."
    assert last_words(text, 30) == "… Move the gripper downward."
    assert last_words("word " * 40, 20) == "… word word word"


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_spinner_begins_after_its_delay_and_only_on_a_terminal(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("tacgrasp.console.SPINNER_DELAY_S", 0.02)
    shown = {}
    for name, file in (("terminal", Terminal()), ("pipe", io.StringIO())):
        console = Console(file=file, force_terminal=name == "terminal", width=80)
        with working("loading", console):
            deadline = time.monotonic() + 5
            while name == "terminal" and "loading" not in file.getvalue():
                assert time.monotonic() < deadline
                time.sleep(0.01)
        shown[name] = file.getvalue()
    assert "loading …" in shown["terminal"]
    assert shown["pipe"] == ""


def test_what_is_over_at_once_shows_no_spinner() -> None:
    file = Terminal()
    with working("loading", Console(file=file, force_terminal=True, width=80)):
        pass
    assert file.getvalue() == ""
