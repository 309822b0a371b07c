import json
import random
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.writer import Writer

from tacgrasp.episodes import EpisodeError, EpisodeWriter, StepRecord, read_episode
from tacgrasp.episodes.codec import to_json
from tacgrasp.episodes.record import FORMAT
from tacgrasp.episodes.recover import recover
from tests.fakes.episode_samples import exact_text, header, record, same, step_record

Recorded = tuple[bytes, list[int]]

STEPS = [step_record(index) for index in range(4)]
TEXTS = [exact_text(step) for step in STEPS]


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Recorded:
    """A finished episode of four steps, and its size after the header and after each step."""
    path = tmp_path_factory.mktemp("recorded") / "e.mcap"
    sizes = record(path, STEPS)
    return path.read_bytes(), sizes


def stock_count(path: Path, topic: str = "/state") -> int:
    with path.open("rb") as file:
        return sum(1 for _ in make_reader(file, validate_crcs=True).iter_messages(topics=[topic]))


def assert_prefix(read: Sequence[StepRecord]) -> None:
    """Steps that were read are the first of ``STEPS``, to the last bit."""
    assert len(read) <= len(STEPS)
    for a, b, text in zip(read, STEPS, TEXTS, strict=False):
        assert exact_text(a) == text
        assert a.cloud.points_mm.tobytes() == b.cloud.points_mm.tobytes()


def sampled_cuts(size: int, boundaries: Sequence[int]) -> list[int]:
    """Lengths around each boundary between records of ours, and at random between them."""
    near = {b + d for b in boundaries for d in (-9, -8, -1, 0, 1, 8, 9)}
    rng = random.Random(0)
    drawn = {rng.randrange(boundaries[0], size) for _ in range(120)}
    return sorted(cut for cut in near | drawn if boundaries[0] <= cut < size)


def test_a_file_cut_anywhere_still_gives_every_whole_step(
    recorded: Recorded, tmp_path: Path
) -> None:
    data, sizes = recorded
    cuts = sampled_cuts(len(data), sizes)
    assert len(cuts) > 100
    for cut in cuts:
        path = tmp_path / "cut.mcap"
        path.write_bytes(data[:cut])
        episode = read_episode(path)
        whole = sum(size <= cut for size in sizes[1:])
        assert whole <= len(episode.steps) <= whole + 1  # its index may be all that is missing
        assert not episode.complete and episode.problem
        assert_prefix(episode.steps)


def test_a_recovered_file_is_no_more_open_to_others_than_it_was(
    recorded: Recorded, tmp_path: Path
) -> None:
    path = tmp_path / "e.mcap"
    path.write_bytes(recorded[0][:-100])
    path.chmod(0o600)
    recover(path)
    assert path.stat().st_mode & 0o777 == 0o600


def test_a_file_cut_before_its_header_says_that_nothing_can_be_recovered(
    recorded: Recorded, tmp_path: Path
) -> None:
    data, sizes = recorded
    path = tmp_path / "cut.mcap"
    for cut in [1, 7, 8, 9, 20, 60, sizes[0] // 2]:
        path.write_bytes(data[:cut])
        with pytest.raises(EpisodeError, match=r"cut\.mcap ends .*delete it"):
            read_episode(path)
        with pytest.raises(EpisodeError, match=r"cut\.mcap ends .*delete it"):
            recover(path)


@pytest.mark.slow
@settings(max_examples=150)
@given(where=st.floats(0, 1, exclude_max=True), flipped=st.integers(1, 255))
def test_a_flipped_byte_never_changes_what_is_read(
    recorded: Recorded,
    tmp_path_factory: pytest.TempPathFactory,
    where: float,
    flipped: int,
) -> None:
    data = bytearray(recorded[0])
    data[int(where * len(data))] ^= flipped
    path = tmp_path_factory.mktemp("flip") / "e.mcap"
    path.write_bytes(data)
    try:
        episode = read_episode(path)
    except EpisodeError as error:
        assert str(path) in str(error)
        return
    assert len(episode.steps) == len(STEPS) or not episode.complete
    for read in episode.steps:
        assert same(read, STEPS[read.index])
        assert read.cloud.points_mm.tobytes() == STEPS[read.index].cloud.points_mm.tobytes()


def test_a_damaged_chunk_costs_its_own_step_alone(recorded: Recorded, tmp_path: Path) -> None:
    data, sizes = bytearray(recorded[0]), recorded[1]
    data[(sizes[1] + sizes[2]) // 2] ^= 0xFF  # in the middle of step 1
    path = tmp_path / "e.mcap"
    path.write_bytes(data)
    episode = read_episode(path)
    assert [t.index for t in episode.steps] == [0, 2, 3]
    assert not episode.complete and "left out" in episode.problem
    assert ": 3 steps recovered; step 1 is missing, so that it stays" in recover(path)
    assert stock_count(path) == 3


def damage(data: bytes, *places: int) -> bytes:
    changed = bytearray(data)
    for place in places:
        changed[place] ^= 0xFF
    return bytes(changed)


def middle(sizes: Sequence[int], step: int) -> int:
    """Place of a byte in the chunk of a step; of the end for the number after the last step."""
    return sizes[step] + 300 if step + 1 == len(sizes) else (sizes[step] + sizes[step + 1]) // 2


@pytest.mark.parametrize(
    ("lost", "missing"),
    [
        ([0], "step 0 is missing"),
        ([1, 2], "steps 1 to 2 are missing"),
        ([0, 2], "step 0 and step 2 are missing"),
        ([3], "step 3 is missing"),  # known by the end behind it
        ([2, 3], "steps 2 to 3 are missing"),
    ],
)
def test_what_a_damaged_file_lost_is_told_after_recovery_too(
    recorded: Recorded, tmp_path: Path, lost: list[int], missing: str
) -> None:
    path = tmp_path / "e.mcap"
    path.write_bytes(damage(recorded[0], *(middle(recorded[1], step) for step in lost)))
    assert read_episode(path).missing == missing
    recover(path)
    recovered = path.read_bytes()
    assert f"finished already ({4 - len(lost)} steps; {missing}); left as it is" in recover(path)
    episode = read_episode(path)
    assert episode.finished and not episode.complete
    assert [step.index for step in episode.steps] == [i for i in range(4) if i not in lost]
    assert episode.missing == missing and episode.problem.startswith(f"{missing}; recovered from ")
    with path.open("rb") as file:
        names = {m.name: m.metadata for m in make_reader(file).iter_metadata()}
    assert names["tacgrasp_recovered"]["missing"] == missing
    assert "left out" in names["tacgrasp_recovered"]["lost"]
    path.write_bytes(recovered[:-100])  # damaged and recovered once more
    recover(path)
    assert read_episode(path).missing == missing and "left out" in read_episode(path).problem


def test_a_loss_that_no_number_tells_is_told_after_recovery_too(
    recorded: Recorded, tmp_path: Path
) -> None:
    data, sizes = recorded
    path = tmp_path / "e.mcap"
    assert len(sizes) == 5
    path.write_bytes(damage(data, middle(sizes, 3), middle(sizes, 4)))  # last step and end
    recover(path)
    episode = read_episode(path)
    assert (len(episode.steps), episode.end, episode.missing) == (3, None, "")
    assert not episode.complete and "recovered from a damaged file: " in episode.problem


def test_the_rest_behind_a_damaged_length_is_lost_unless_the_run_was_killed(
    recorded: Recorded, tmp_path: Path
) -> None:
    data, sizes = recorded
    path = tmp_path / "e.mcap"
    long = bytearray(data)
    long[sizes[2] + 8] = 0x7F  # the highest byte of the length of step 2's chunk
    for content, complete in ((bytes(long), False), (data[: sizes[2] + 100], True)):
        path.write_bytes(content)
        recover(path)
        assert len(read_episode(path).steps) == 2
        assert read_episode(path).complete == complete, read_episode(path).problem
    path.write_bytes(long)
    recover(path)
    assert "the rest was not read" in read_episode(path).problem


def test_what_a_recovered_file_says_of_its_damage_stays_one_short_line(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.add_metadata("tacgrasp_episode", {"format": FORMAT})
        writer.add_metadata("tacgrasp_recovered", {"lost": "a\nb " + 5000 * "x"})
        channel = writer.register_channel("/episode", "json", 0)
        writer.add_message(channel, 0, json.dumps(to_json(header())).encode(), 0)
        writer.finish()
    problem = read_episode(path).problem
    assert problem.startswith("recovered from a damaged file: a b xx") and len(problem) < 600


def test_zeros_after_a_power_cut_are_no_record(recorded: Recorded, tmp_path: Path) -> None:
    data, sizes = recorded
    path = tmp_path / "e.mcap"
    path.write_bytes(data[: sizes[2]] + bytes(5000))
    episode = read_episode(path)
    assert len(episode.steps) == 2 and "zeros" in episode.problem


def test_recovery_makes_a_file_that_the_stock_reader_opens(
    recorded: Recorded, tmp_path: Path
) -> None:
    data, sizes = recorded
    path = tmp_path / "e.mcap"
    cut = data[: sizes[3] + 100]
    path.write_bytes(cut)
    with pytest.raises(McapError):
        stock_count(path)
    original = tmp_path / "e.mcap.broken"
    message = recover(path)
    assert message.startswith(f"{path}: 3 steps recovered; ")
    assert message.endswith(f"; kept as {original}")
    assert original.read_bytes() == cut
    assert sorted(p.name for p in tmp_path.iterdir()) == ["e.mcap", "e.mcap.broken"]
    episode = read_episode(path)
    assert episode.complete and episode.end is None and len(episode.steps) == 3
    assert same(episode.header, header())
    assert_prefix(episode.steps)
    assert stock_count(path) == stock_count(path, "/touch/cloud") == 3
    with path.open("rb") as file:
        names = {m.name: m.metadata for m in make_reader(file).iter_metadata()}
    assert names["tacgrasp_recovered"]["from"] == "e.mcap"


def test_an_end_that_was_recorded_survives_recovery(recorded: Recorded, tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    path.write_bytes(recorded[0][:-100])  # in the summary
    assert ": 4 steps recovered; " in recover(path)
    episode = read_episode(path)
    assert episode.complete and episode.end is not None and episode.end.reason == "success"


def test_a_finished_file_is_left_alone(recorded: Recorded, tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    path.write_bytes(recorded[0])
    assert "finished already (4 steps)" in recover(path)
    assert path.read_bytes() == recorded[0] and len(list(tmp_path.iterdir())) == 1


def test_recovery_to_another_place_leaves_the_original(recorded: Recorded, tmp_path: Path) -> None:
    path, out = tmp_path / "e.mcap", tmp_path / "out.mcap"
    path.write_bytes(recorded[0][: recorded[1][1]])
    assert f"{out}: 1 steps recovered; " in recover(path, out)
    assert path.read_bytes() == recorded[0][: recorded[1][1]] and stock_count(out) == 1
    with pytest.raises(EpisodeError, match="never overwritten"):
        recover(path, out)
    with pytest.raises(EpisodeError, match=r"can't write .*does not exist"):
        recover(path, tmp_path / "missing" / "out.mcap")


def test_a_second_recovery_keeps_both_originals(recorded: Recorded, tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    for _ in range(2):
        path.write_bytes(recorded[0][:-100])
        recover(path)
    names = ["e.mcap", "e.mcap.broken", "e.mcap.broken2"]
    assert sorted(p.name for p in tmp_path.iterdir()) == names


def test_an_episode_that_is_being_recorded_is_not_recovered(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        writer.write_step(STEPS[0])
        assert len(read_episode(path).steps) == 1  # but it can be read
        with pytest.raises(EpisodeError, match="still being recorded"):
            recover(path)
    assert read_episode(path).complete


def write_foreign(path: Path, *, metadata: dict[str, str] | None = None) -> None:
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        schema = writer.register_schema("x", "jsonschema", b"{}")
        channel = writer.register_channel("/x", "json", schema)
        writer.add_message(channel, 0, json.dumps({"a": 1}).encode(), 0)
        if metadata is not None:
            writer.add_metadata("tacgrasp_episode", metadata)
        writer.finish()


def test_somebody_elses_mcap_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "foreign.mcap"
    write_foreign(path)
    for use in (read_episode, recover):
        with pytest.raises(EpisodeError, match=r"is an MCAP file but no episode of tacgrasp"):
            use(path)


def test_another_format_version_is_named(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    write_foreign(path, metadata={"format": "tacgrasp-episode/9"})
    with pytest.raises(EpisodeError, match=r"format tacgrasp-episode/9, this tacgrasp reads .*/1"):
        read_episode(path)


def test_our_format_without_our_records_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    write_foreign(path, metadata={"format": "tacgrasp-episode/1"})
    with pytest.raises(EpisodeError, match=r"can't be understood: no message on /episode"):
        read_episode(path)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is empty: .*delete it"),
        (b"hello, this is text", "is not an MCAP file; expected an episode"),
        (b"\x89PNG\r\n\x1a\n", "is not an MCAP file"),
    ],
)
def test_a_file_that_is_no_mcap_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "e.mcap"
    path.write_bytes(content)
    with pytest.raises(EpisodeError, match=message):
        read_episode(path)


def test_a_path_without_a_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(EpisodeError, match=r"no\.mcap does not exist; `tacgrasp episodes ls`"):
        read_episode(tmp_path / "no.mcap")
    with pytest.raises(EpisodeError, match=r"is a folder; name an episode in it"):
        read_episode(tmp_path)
