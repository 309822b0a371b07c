"""What went wrong first in an episode, with the state before it and what was sent."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from primitives.sense import Interval
from tacgrasp.__main__ import main
from tacgrasp.episodes import Episode, EpisodeWriter, StepPhase, StepRecord
from tacgrasp.episodes.command_log import Command
from tacgrasp.episodes.why import explain, first_trouble
from tests.fakes.episode_samples import end, header, step_record


def free(index: int, **changes: Any) -> StepRecord:
    """A step that nothing limited."""
    step = step_record(index)
    assert step.executed is not None
    return replace(step, executed=replace(step.executed, clamped=()), **changes)


def episode(steps: list[StepRecord], **changes: Any) -> Episode:
    ended = replace(end(), **changes)
    return Episode(header=header(), steps=tuple(steps), end=ended, complete=True)


def failed(error: str) -> Command:
    return Command(
        device="gripper",
        asked="grip with 1 N",
        sent="goal current 40",
        reached="",
        error=error,
        started_s=1.0,
        ended_s=2.0,
    )


def test_a_good_episode_has_no_trouble() -> None:
    good = episode([free(0)])
    assert first_trouble(good) is None
    assert explain(good, "e.mcap")[0] == (
        "trouble",
        "none: no fault, no refusal, no failed verification",
    )


def test_the_first_trouble_is_shown_not_the_last() -> None:
    steps = [free(0), free(1, commands=(failed("no answer"),)), free(2, note="cut short: x")]
    trouble = first_trouble(episode(steps, reason="fault", message="no answer"))
    assert trouble is not None
    assert (trouble.kind, trouble.message) == ("fault", "gripper: no answer")
    assert trouble.step is steps[1]


def refused(index: int) -> StepRecord:
    step = free(index)
    assert step.executed is not None
    changed = replace(step.executed, sent="nothing", clamped=("at the limit of force",))
    return replace(step, executed=changed)


def test_a_command_that_was_not_sent_and_a_text_beyond_the_contract_are_refusals() -> None:
    trouble = first_trouble(episode([free(0), refused(1)], reason="limit"))
    assert trouble is not None
    assert (trouble.kind, trouble.message) == ("refusal", "at the limit of force")
    step = free(0)
    assert step.decision is not None
    beyond = replace(step.decision, action=None, reason="beyond the contract: 3 N are felt")
    unasked = replace(step, decision=beyond, executed=None)
    trouble = first_trouble(episode([unasked], reason="no_action"))
    assert trouble is not None
    assert trouble.kind == "refusal"


def test_a_failed_verification_shows_the_state_before_the_lift() -> None:
    before = step_record(1, phase=StepPhase.VERIFY_BEFORE)
    lifted = step_record(2, phase=StepPhase.VERIFY_AFTER)
    message = "the contact moved 3.0 mm (at most 1)"
    bad = episode(
        [free(0), before, lifted], reason="unverified", verified_success=False, message=message
    )
    trouble = first_trouble(bad)
    assert trouble is not None
    assert (trouble.kind, trouble.message, trouble.step) == ("failed verification", message, before)
    assert ("step", "1 of 3, 0.5 s after the start, before the lift") in explain(bad, "e.mcap")


@pytest.mark.parametrize(("reason", "kind"), [("operator", "operator"), ("limit", "refusal")])
def test_a_stop_and_a_limit_in_mid_action_are_no_faults(reason: str, kind: str) -> None:
    cut = free(1, note="cut short: x", commands=(failed("KeyboardInterrupt"),))
    trouble = first_trouble(episode([free(0), cut], reason=reason, message="x"))
    assert trouble is not None
    assert (trouble.kind, trouble.message, trouble.step) == (kind, "x", cut)


def test_what_the_run_survived_is_told_but_no_trouble() -> None:
    hiccup = free(0, note="TouchError: no fresh frame")
    steps = [hiccup, refused(1), free(2)]
    good = episode(steps)
    assert first_trouble(good) is None
    assert explain(good, "e.mcap")[:3] == [
        ("trouble", "none: what failed was survived, no failed verification"),
        ("survived", "step 0: TouchError: no fresh frame"),
        ("survived", "step 1: at the limit of force"),
    ]
    dropped = episode(steps, reason="unverified", verified_success=False, message="dropped")
    rows = explain(dropped, "e.mcap")
    assert rows[0] == ("trouble", "failed verification: dropped")
    assert rows[1] == ("survived", "step 0: TouchError: no fresh frame")
    fault = first_trouble(episode(steps, reason="fault", message="3 times in a row"))
    assert fault is not None
    assert (fault.kind, fault.step) == ("fault", hiccup)


def test_a_bruise_that_touch_called_a_success_is_trouble() -> None:
    trouble = first_trouble(episode([free(0)], truth={"held": True, "bruised": True}))
    assert trouble is not None
    assert trouble.message == "verified by touch, but bruised"


def test_a_killed_run_is_a_crash() -> None:
    killed = Episode(
        header=header(), steps=(free(0),), end=None, complete=False, problem="it ends at byte 3"
    )
    trouble = first_trouble(killed)
    assert trouble is not None
    assert trouble.kind == "crash"
    assert "it ends at byte 3" in trouble.message
    assert "or its file is damaged" in trouble.message


def test_a_damaged_episode_is_judged_by_what_was_read_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        for index in range(3):
            writer.write_step(free(index))
        writer.finish(end())
    assert main(["why", str(path)]) == 0
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 0xFF
    path.write_bytes(data)
    capsys.readouterr()
    assert main(["why", str(path)]) == 1
    printed = " ".join(capsys.readouterr().out.split())
    assert "messages were read" in printed
    assert "what is missing can't be judged" in printed
    assert "trouble none in what was read: no fault" in printed


def test_the_state_before_it_what_was_sent_and_the_commands_are_shown() -> None:
    step = free(
        2,
        commands=(failed("no answer"),),
        felt_force_n=Interval(value=1.2, low=0.9, high=1.6),
    )
    bad = episode([free(0), free(1), step], reason="fault", message="no answer")
    rows = explain(bad, "e.mcap")
    lines = [f"{name}: {value}" for name, value in rows]
    for part in (
        "arm before: (0.10000, 0.33333, 0.20000) m, (0.0000, 3.1416, 0.0000) rad",
        "gripper before: closed, 30.0 mm, commanded 0.33 N",
        "felt before: 1.20 N (0.90-1.60)",
        "sent: 2.5 mm, (0.00, 0.00, -2.50) mm in the base frame",
        "on the wire: gripper: grip with 1 N; sent goal current 40; FAILED: no answer",
        "decide again: tacgrasp replay e.mcap --decide",
        "look at it: tacgrasp view e.mcap",
    ):
        assert part in lines


@pytest.mark.parametrize(("reason", "code"), [("success", 0), ("unverified", 1)])
def test_the_command_prints_it_within_a_hundred_columns(
    reason: str, code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        writer.write_step(free(0))
        writer.finish(replace(end(), reason=reason, message="words " * 60))
    assert main(["why", str(path)]) == code
    printed = capsys.readouterr().out
    assert printed.startswith("trouble          failed verification: words") is bool(code)
    lines = [line for line in printed.splitlines() if str(path) not in line]
    assert max(map(len, lines)) <= 100
