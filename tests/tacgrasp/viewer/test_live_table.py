"""The live table of a terminal: two lines a step, as wide as the terminal, at most 100 columns."""

from __future__ import annotations

import io
from dataclasses import replace

import pytest
from rich.console import Console

from primitives.sense import Interval
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.viewer.live_table import LiveTable
from tests.fakes.episode_samples import step_record

CONTRACT = contract_of(load("strawberry")[0])


def shown(width: int, height: int = 40, num_steps: int = 3) -> str:
    console = Console(file=io.StringIO(), force_terminal=True, width=width, height=height)
    with LiveTable(CONTRACT, console) as table:
        for index in range(num_steps):
            felt = Interval(value=(1.0, 2.8, 5.3)[index % 3], low=0.7, high=6.4)
            table(replace(step_record(index % 8), index=index, felt_force_n=felt, in_contact=True))
        console.file.truncate(0)
        console.file.seek(0)
    return console.file.getvalue()  # type: ignore[attr-defined, no-any-return]


def plain(text: str) -> list[str]:
    from rich.text import Text

    return [Text.from_ansi(line).plain for line in text.splitlines()]


@pytest.mark.parametrize("width", [60, 80, 100, 120, 200])
def test_the_table_fits_the_terminal_and_is_never_wider_than_a_hundred_columns(width: int) -> None:
    lines = plain(shown(width))
    assert max(map(len, lines)) <= min(width, 100)


def test_each_step_shows_its_felt_force_with_the_interval_the_contact_and_the_action() -> None:
    text = "\n".join(plain(shown(100)))
    for part in ("1.00 N", "0.70-6.40", "0.40 mm, 9%", "(+5.0, -4.0) mm", "move_down: 2.5 mm"):
        assert part in text
    assert "0.15-2.50 N" in text  # the goal, above the felt forces
    assert "uncalibrated" in text


def test_all_steps_are_printed_at_the_end_however_low_the_terminal() -> None:
    lines = plain(shown(100, height=12, num_steps=20))
    numbers = [int(line[:4]) for line in lines if line[:4].strip().isdigit()]
    assert numbers[-20:] == list(range(20))  # the last live picture, then erased, comes before


def test_a_force_is_green_in_the_goal_yellow_outside_and_red_above_the_limit() -> None:
    text = shown(100)
    assert "\x1b[32m1.00 N" in text
    assert "\x1b[33m2.80 N" in text
    assert "\x1b[31m5.30 N" in text
