"""Text from an episode or a device can't steer the terminal that shows it."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import pytest
from rich.table import Table
from rich.text import Text

from tacgrasp.__main__ import main
from tacgrasp.base.printable import printable
from tacgrasp.console import SafeConsole
from tacgrasp.episodes import EpisodeWriter
from tests.fakes.episode_samples import end, header, step_record

STEERS = "\x1b]0;owned\x07\x1b[2Jbe\x9b31mrry\x08\u202etxt\ud800"


def test_what_steers_is_marked_and_the_rest_stays() -> None:
    assert printable(STEERS) == "�]0;owned��[2Jbe�31mrry��txt�"
    assert printable("Größe 3 µm\n\t– “ok” ½ 漢字") == "Größe 3 µm\n\t– “ok” ½ 漢字"


@pytest.mark.parametrize("terminal", [True, False])
def test_the_console_marks_it_wherever_it_stands(terminal: bool) -> None:
    file = io.StringIO()
    console = SafeConsole(file=file, force_terminal=terminal, width=200)
    grid = Table(title=STEERS)
    grid.add_column(STEERS)
    grid.add_row(STEERS)
    for shown in (STEERS, Text(STEERS, style="bold"), grid):
        console.print(shown)
    printed = file.getvalue()
    assert "owned" in printed
    assert "\x1b]0" not in printed
    assert "\x1b[2J" not in printed
    assert "\x9b" not in printed
    assert "\x07" not in printed
    assert ("\x1b[" in printed) is terminal  # its own colours stay


@pytest.mark.parametrize("argv", [["replay"], ["episodes", "info"], ["episodes", "ls"]])
def test_an_episode_shown_by_a_command_can_not_steer(
    argv: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    steers = STEERS.replace("\ud800", "")
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, replace(header(), instruction=steers, task=steers)) as writer:
        writer.write_step(replace(step_record(0), note=steers))
        writer.finish(replace(end(), message=steers, reason=steers))
    assert main([*argv, str(path.parent if "ls" in argv else path)]) == 0
    printed = capsys.readouterr().out
    assert "owned" in printed
    assert "\x1b" not in printed


def test_an_error_that_quotes_a_file_can_not_steer(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text('"\\e[2Jowned": 1\n')
    assert main(["run", "--task", str(path)]) == 2
    error = capsys.readouterr().err
    assert "owned" in error
    assert "\x1b" not in error
