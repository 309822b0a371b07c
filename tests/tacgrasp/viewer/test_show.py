"""What of an episode's view needs no viewer."""

from dataclasses import replace

from tacgrasp.viewer.show import recording_id
from tests.fakes.episode_samples import header, stamp


def test_episodes_of_one_task_are_recordings_of_their_own() -> None:
    first = header()
    others = [replace(first, seed=8), replace(first, stamp=stamp(0.3))]
    assert len({recording_id(each) for each in (first, header(), *others)}) == 3
