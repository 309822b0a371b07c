import io
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.image import imread
from rich.console import Console
from rich.table import Table

from primitives.primitive import Primitive
from tacgrasp.episodes import EpisodeError, EpisodeWriter, StepPhase, read_episode
from tacgrasp.episodes.listing import duration_s, info, list_episodes, table
from tacgrasp.episodes.plot import MAX_PICTURES, TITLE_LENGTH, draw_episode, plot_episode
from tests.fakes.contracts import contract
from tests.fakes.episode_samples import end, header, record, step_record


def shown(content: Table) -> str:
    console = Console(file=io.StringIO(), width=220)
    console.print(content)
    return console.file.getvalue()  # type: ignore[attr-defined]


def row_of(text: str, name: str) -> str:
    return next(line for line in text.splitlines() if name in line)


def test_the_list_tells_finished_unfinished_and_unreadable_apart(tmp_path: Path) -> None:
    steps = [step_record(0), step_record(1), step_record(2, phase=StepPhase.VERIFY_BEFORE)]
    sizes = record(tmp_path / "done.mcap", steps)
    (tmp_path / "killed.mcap").write_bytes((tmp_path / "done.mcap").read_bytes()[: sizes[2]])
    (tmp_path / "text.mcap").write_text("hello")
    (tmp_path / "other.txt").write_text("not listed")
    listed = list_episodes(tmp_path)
    assert [path.name for path in listed] == ["done.mcap", "killed.mcap", "text.mcap"]
    text = shown(table(listed))
    assert row_of(text, "done.mcap").split() == ["done.mcap", "rules", "3", "success", "6.7", "s"]
    assert "no end recorded, unfinished: recover it" in row_of(text, "killed.mcap")
    assert "is not an MCAP file" in row_of(text, "text.mcap")


@pytest.mark.parametrize("width", [80, 120])
def test_the_list_fits_the_terminal_and_keeps_names_whole(width: int, tmp_path: Path) -> None:
    name = "strawberry-20261122T091500.037Z-6.mcap"
    record(tmp_path / name, [step_record(0)])
    (tmp_path / "text.mcap").write_text("hello")
    console = Console(file=io.StringIO(), width=width)
    console.print(table(list_episodes(tmp_path)))
    lines = console.file.getvalue().splitlines()  # type: ignore[attr-defined]
    assert max(map(len, lines)) <= width
    assert any(name in line and line.endswith("6.7 s") for line in map(str.rstrip, lines))


def test_a_bruise_stands_beside_an_end_that_is_no_success(tmp_path: Path) -> None:
    with EpisodeWriter(tmp_path / "e.mcap", header()) as writer:
        writer.finish(replace(end(), reason="max_steps", truth={"bruised": True, "slipped": True}))
    assert "max_steps, slipped, bruised" in shown(table([tmp_path / "e.mcap"]))


def test_a_directory_that_is_none_can_not_be_listed(tmp_path: Path) -> None:
    with pytest.raises(EpisodeError, match="is not a directory"):
        list_episodes(tmp_path / "missing")


def test_info_tells_the_instruction_the_end_and_what_to_do(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    steps = [step_record(0), step_record(1), step_record(2, phase=StepPhase.VERIFY_AFTER)]
    sizes = record(path, steps)
    text = shown(info(path))
    assert "hold the 'berry' – gently" in text
    assert "3, 1 of the verification" in text
    assert "Grasp completed successfully" in text
    assert "2 × move_down" in text
    assert "held, not bruised, slip_mm 0.1, count 3" in text
    path.write_bytes(path.read_bytes()[: sizes[1]])
    text = shown(info(path))
    assert "tacgrasp episodes recover" in text and "not recorded" in text


def test_the_duration_is_measured_on_the_monotonic_clock(tmp_path: Path) -> None:
    record(tmp_path / "e.mcap", [step_record(0), step_record(3)])
    assert duration_s(read_episode(tmp_path / "e.mcap")) == pytest.approx(20 / 3)
    record(tmp_path / "f.mcap", [step_record(0), step_record(3)], with_end=False)
    assert duration_s(read_episode(tmp_path / "f.mcap")) == pytest.approx(3.5 / 3)


def test_the_picture_has_a_panel_for_each_touch_and_says_what_was_done(tmp_path: Path) -> None:
    steps = [
        step_record(0),
        replace(step_record(1, action=Primitive.RESET), executed=None),
        step_record(2, action=None),
        step_record(3, phase=StepPhase.VERIFY_AFTER),
    ]
    record(tmp_path / "e.mcap", steps)
    figure = draw_episode(read_episode(tmp_path / "e.mcap"), "e.mcap")
    titles = [axes.get_title() for axes in figure.axes]
    panels = [t for t in titles if t[:1].isdigit()]
    assert panels == [
        "0  → move_down",
        "1  → reset (not done)",
        "2  success declared",
        "3  after the lift",
    ]


def test_a_long_episode_is_thinned_to_its_first_and_last_touch(tmp_path: Path) -> None:
    num = MAX_PICTURES + 7
    record(tmp_path / "e.mcap", [step_record(i % 8) for i in range(num - 1)] + [step_record(9)])
    figure = draw_episode(read_episode(tmp_path / "e.mcap"), "e.mcap")
    panels = [axes.get_title() for axes in figure.axes if axes.get_title()[:1].isdigit()]
    assert len(panels) == MAX_PICTURES
    assert panels[0].startswith("0 ") and panels[-1].startswith("9 ")


@pytest.mark.parametrize(("limit_n", "named"), [(0.7, "never above"), (9.0, "never above 9 N")])
def test_a_light_hold_stays_readable_under_a_limit_far_above_it(
    tmp_path: Path, limit_n: float, named: str
) -> None:
    path, steps = tmp_path / "e.mcap", [step_record(0), step_record(1)]
    with EpisodeWriter(path, replace(header(), contract=contract(0.2, 0.5, limit_n))) as writer:
        for step in steps:
            writer.write_step(step)
    figure = draw_episode(read_episode(path), path.name)
    force = next(axes for axes in figure.axes if axes.get_ylabel().startswith("force"))
    legend = force.get_legend()
    assert legend is not None
    (label,) = [t.get_text() for t in legend.get_texts() if t.get_text().startswith("never")]
    assert label.startswith(named)
    commanded_n = steps[0].gripper.force_n
    assert force.get_ylim()[1] < 3 * commanded_n
    assert (force.get_ylim()[1] > limit_n) == (limit_n < 1)


def test_a_long_title_ends_within_the_picture(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        writer.write_step(step_record(0))
        writer.finish(replace(end(), message="the arm refused " * 20))
    figure = draw_episode(read_episode(path), path.name)
    assert len(figure.texts[0].get_text()) <= TITLE_LENGTH


def test_the_picture_names_the_steps_that_are_missing(tmp_path: Path) -> None:
    record(tmp_path / "e.mcap", [step_record(0), step_record(2)])
    whole = read_episode(tmp_path / "e.mcap")
    lossy = replace(whole, complete=False, missing="step 1 is missing", problem="x")
    for episode, expected in ((whole, False), (lossy, True)):
        title, subtitle = (text.get_text() for text in draw_episode(episode, "e.mcap").texts[:2])
        assert ("(incomplete)" in title) == expected
        assert ("(step 1 is missing)" in subtitle) == expected


def test_the_picture_is_written_as_png(tmp_path: Path) -> None:
    record(tmp_path / "e.mcap", [step_record(0)])
    plot_episode(tmp_path / "e.mcap", tmp_path / "e.png")
    pixels = imread(tmp_path / "e.png")
    assert pixels.shape[1] == 1430
    assert 0.02 < (pixels[..., :3].min(axis=2) < 0.9).mean() < 0.9  # drawn on, and not all over


def test_a_picture_that_can_not_be_made_is_a_clear_error(tmp_path: Path) -> None:
    record(tmp_path / "none.mcap", [])
    with pytest.raises(EpisodeError, match="no touch to draw"):
        plot_episode(tmp_path / "none.mcap", tmp_path / "e.png")
    record(tmp_path / "e.mcap", [step_record(0)])
    with pytest.raises(EpisodeError, match=r"can't write .*does not exist; .*with --out"):
        plot_episode(tmp_path / "e.mcap", tmp_path / "missing" / "e.png")
