"""A contact out of an episode: that of the step, under the contract of then."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cltp.tactile.contact.single_cloud import is_touched
from primitives.contract import Band
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.episodes import EpisodeWriter, StepPhase, StepRecord
from tacgrasp.episodes.record import Need
from tacgrasp.playback.contact_file import read_contact
from tacgrasp.playback.describe import describe_in_numbers
from tests.fakes.contracts import contract
from tests.fakes.episode_samples import header, press, step_record

FORCES = re.compile(r"(?:Goal |understood: .*, )(\d\.\d\d) ?- ?(\d\.\d\d) N")
FIRST, SOFTER = contract(1.0, 2.0, 2.5), contract(0.5, 1.0, 1.25)
NEED = Need(force_n=Band(low=0.6, high=0.7), felt="30 mm wide")


def recorded(folder: Path, *steps: StepRecord) -> Path:
    path = folder / "episode.mcap"
    with EpisodeWriter(path, replace(header(), contract=FIRST)) as writer:
        for step in steps:
            writer.write_step(step)
    return path


@pytest.fixture
def episode(tmp_path: Path) -> Path:
    return recorded(
        tmp_path,
        step_record(0),
        replace(step_record(1), contract=SOFTER),
        replace(step_record(2), need=NEED),
        step_record(3, phase=StepPhase.VERIFY_BEFORE, action=None),
    )


def test_a_step_is_read_under_the_contract_and_the_target_of_then(episode: Path) -> None:
    contacts = [read_contact(episode, "gelsight_mini", step=number) for number in range(4)]
    for number, contact in enumerate(contacts):
        assert np.array_equal(contact.cloud.points_mm, step_record(number).cloud.points_mm)
    bands = [contact.contract.terms.force_n for contact in contacts if contact.contract]
    assert bands == [FIRST.force_n, SOFTER.force_n, NEED.force_n, SOFTER.force_n]
    assert contacts[2].contract is not None
    assert contacts[2].contract.limit_n == SOFTER.limit_n
    assert contacts[0].about == "0 of 0 to 3"
    last = read_contact(episode, "digit")  # the episode says itself what sensor it is of
    assert last.about == "3 of 0 to 3 before the lift"
    assert last.cloud.sensor.name == "gelsight_mini"


def test_a_step_that_is_not_there_is_refused(episode: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="has no step 4; its steps are 0 to 3"):
        read_contact(episode, "gelsight_mini", step=4)
    with pytest.raises(UsageError, match=r"--step is for an episode \(\.mcap\)"):
        read_contact(tmp_path / "cloud.ply", "gelsight_mini", step=0)
    (tmp_path / "empty").mkdir()
    with pytest.raises(UsageError, match="has no steps"):
        read_contact(recorded(tmp_path / "empty"), "gelsight_mini")


def test_a_step_of_an_episode_is_described(
    episode: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["describe", str(episode), "--step", "1"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("step      1 of 0 to 3\nsensor    gelsight_mini")
    assert "Goal 0.50 - 1.00 N" in printed


@pytest.mark.parametrize("is_felt", [True, False, None])
def test_a_soft_press_is_felt_where_the_run_has_felt_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], is_felt: bool | None
) -> None:
    """A single cloud may show drift where the run, which knew its untouched gel, felt a berry."""
    soft = replace(step_record(0), cloud=press(1.0, -1.0, 0.08), in_contact=is_felt)
    path = recorded(tmp_path, soft)
    contact = read_contact(path, "gelsight_mini")
    assert contact.in_contact is is_felt
    assert not is_touched(contact.cloud)  # alone
    assert describe_in_numbers(contact.cloud, None, is_felt)["contact"] is bool(is_felt)
    assert main(["describe", str(path)]) == 0
    assert ("contact   none" in capsys.readouterr().out) is not bool(is_felt)
    assert main(["ask", str(path), "Does anything touch the pad?"]) == 0
    assert capsys.readouterr().out.startswith("Yes" if is_felt else "No")


def test_words_are_read_under_the_task_of_the_episode(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An egg takes more than a strawberry, and "gently" is a part of either's band."""
    folder = ["--record", str(tmp_path)]
    assert main(["run", "--task", "egg", "--policy", "rules", "--seed", "3", *folder]) == 0
    (episode,) = tmp_path.glob("*.mcap")
    capsys.readouterr()
    goals = []
    for argv in (
        ["describe", str(episode), "--instruction", "hold it very gently"],
        ["understand", "hold it very gently", "--task", "egg"],
        ["understand", "hold it very gently", "--task", "strawberry"],
    ):
        assert main(argv) == 0
        printed = capsys.readouterr().out
        found = FORCES.search(printed)
        assert found is not None
        goals.append([float(end) for end in found.groups()])
    assert goals[0] == goals[1] != goals[2]
    assert main(["describe", str(episode), "--instruction", "crush it"]) == 2
    assert "refused" in capsys.readouterr().err


def test_what_an_episode_lacks_is_told_before_its_last_step(
    episode: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = episode.read_bytes()
    episode.write_bytes(data[: len(data) * 2 // 3])
    assert main(["describe", str(episode)]) == 0
    printed = capsys.readouterr()
    assert "is incomplete" in printed.err
    assert printed.out.startswith("step ")
