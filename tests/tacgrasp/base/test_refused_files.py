"""A disk or folder that refuses a file: one line, no empty file, and no device replaced."""

import errno
import io
import json
import os
import resource
import select
import signal
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from cltp.atomic_write import replacing
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_page, write_result
from tacgrasp.benchmarks.faults.table import markdown_of
from tacgrasp.cli.flags import writable
from tests.fakes.episode_samples import end, header, record, step_record
from tests.fakes.tiny_weights import make_data

PRESS = ["simulate", "press", "--object", "ball:9.5", "--depth-mm", "0.5", "--grid", "80x60"]


@contextmanager
def full_disk(most_bytes: int = 0) -> Iterator[None]:
    """No file may grow beyond some bytes, as on a disk without space."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # the call then fails with EFBIG
    resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, ignored)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A data set and an episode to write about."""
    made = tmp_path_factory.mktemp("made")
    make_data(made / "data", num=12)
    record(made / "e.mcap", [step_record(0), step_record(1)])
    return made


COMMANDS = {
    "simulate press": ([*PRESS, "--out", "{out}.npz"]),
    "data stats": (["data", "stats", "{made}/data", "--json", "{out}.json"]),
    "data inspect": (["data", "inspect", "{made}/data", "--out", "{out}.png"]),
    "data gallery": (["data", "gallery", "{made}/data", "--out", "{out}.html"]),
    "data sheet": (["data", "sheet", "{made}/data", "--out", "{out}"]),
    "episodes plot": (["episodes", "plot", "{made}/e.mcap", "--out", "{out}.png"]),
    "bench latency": (["bench", "latency", "--ticks", "1", "--json", "{out}.json"]),
    "data generate": (["data", "generate", "--set", "full", "--contacts", "2", "--out", "{out}"]),
}


def filled(argv: list[str], made: Path, out: Path) -> list[str]:
    return [word.format(made=made, out=out / "out") for word in argv]


@pytest.mark.parametrize("name", COMMANDS)
def test_a_full_disk_is_one_line_and_leaves_no_empty_file(
    name: str, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with full_disk():
        code = main(filled(COMMANDS[name], folder, tmp_path))
    lines = capsys.readouterr().err.splitlines()
    assert code == 2
    assert [line.startswith("tacgrasp: ") for line in lines].count(True) == 1, lines
    assert not any("Traceback" in line for line in lines)
    assert "too large" in lines[-1].lower() or "size limit" in lines[-1]
    rest = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert rest == []


@pytest.mark.parametrize("name", COMMANDS)
def test_a_folder_that_does_not_exist_or_takes_no_file_is_one_line(
    name: str, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("not a folder")
    assert main(filled(COMMANDS[name], folder, tmp_path / "file")) == 2
    error = capsys.readouterr().err
    assert error.count("tacgrasp: ") == 1
    assert "Traceback" not in error


def test_a_device_is_not_replaced_by_a_file(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.npz"
    os.mkfifo(pipe)
    with pytest.raises(OSError, match="a device or pipe, not a file"), replacing(pipe) as part:
        part.write_bytes(b"x")
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert main([*PRESS, "--out", str(pipe)]) == 2
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    folder = tmp_path / "folder.npz"
    folder.mkdir()
    assert main([*PRESS, "--out", str(folder)]) == 2
    assert list(tmp_path.iterdir()) == [folder, pipe] or len(list(tmp_path.iterdir())) == 2


def test_a_pipe_is_left_to_its_writer(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)  # so that an opened pipe does not wait
    try:
        assert writable(pipe) == pipe
        poll = select.poll()
        poll.register(reader, select.POLLIN)
        assert poll.poll(0) == []  # somebody who has closed it would be an end of the file
    finally:
        os.close(reader)


@pytest.mark.parametrize(
    ("argv", "expected"),
    [([*PRESS, "--out", "x.txt"], ".npz"), (["episodes", "plot", "e", "--out", "x.txt"], ".png")],
)
def test_a_name_of_another_format_is_refused(
    argv: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(argv) == 2
    assert f"--out expects a file ending in {expected}, got x.txt" in capsys.readouterr().err


REPORTS = {
    "run": (["run", "--json", "{file}"], ".json or .jsonl"),
    "understand": (["understand", "Hold it.", "--json", "{file}"], ".json"),
    "data stats": (["data", "stats", "{made}/data", "--json", "{file}"], ".json"),
    "data inspect": (["data", "inspect", "{made}/data", "--out", "{file}"], ".png"),
    "data gallery": (["data", "gallery", "{made}/data", "--out", "{file}"], ".html"),
    "episodes plot": (["episodes", "plot", "{made}/e.mcap", "--out", "{file}"], ".png"),
    "episodes export": (
        ["episodes", "export", "{made}/e.mcap", "--to", "parquet", "--out", "{file}"],
        ".parquet",
    ),
    "bench latency": (["bench", "latency", "--ticks", "1", "--json", "{file}"], ".json"),
    "bench draws": (["bench", "draws", "--plot", "{file}"], ".png"),
    "bench faults": (["bench", "faults", "--markdown", "{file}"], ".md"),
    "eval own": (["eval", "own", "--weights", "w", "--also", "a", "--json", "{file}"], ".json"),
    "eval zero-shot": (
        ["eval", "zero-shot", "--data", "{made}/data", "--out", "{file}"],
        ".csv",
    ),
    "eval retrieval": (
        ["eval", "retrieval", "--data", "{made}/data", "--page", "{file}"],
        ".html",
    ),
    "calibrate slip": (["calibrate", "slip", "--overwrite", "--out", "{file}"], ".json"),
}


@pytest.mark.parametrize("name", REPORTS)
def test_a_report_never_takes_the_place_of_a_file_of_another_kind(
    name: str, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    task = tmp_path / "salad_tomato.yaml"
    task.write_text("object: cherry_tomato\n")
    argv, ending = REPORTS[name]
    assert main([word.format(made=folder, file=task) for word in argv]) == 2
    assert f"expects a file ending in {ending}, got {task}" in capsys.readouterr().err
    assert task.read_text() == "object: cherry_tomato\n"


def test_a_link_leads_no_report_to_a_file_of_another_kind(tmp_path: Path) -> None:
    task, link = tmp_path / "task.yaml", tmp_path / "report.json"
    task.write_text("mine")
    link.symlink_to(task)
    with pytest.raises(UsageError, match=r"ending in \.json"):
        write_result(link, {})
    assert task.read_text() == "mine"


def test_a_report_takes_the_place_of_an_earlier_one_or_of_an_empty_file(tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    report.touch()
    for value in (1, 2):
        write_result(report, {"value": value})
        assert json.loads(report.read_text()) == {"written_by": "tacgrasp", "value": value}


EARLIER = {
    "figures": '{"written_by": "tacgrasp", "value": 1}',
    "a run": '{"event": "contract"}\n{"event": "end"}\n',
    "a run that was stopped": '{"event": "contract"}\n{"event": "st',
    "a long benchmark before the mark": '{"value": 1, "about": {}, "results": {}}',
}


@pytest.mark.parametrize("content", EARLIER.values(), ids=EARLIER)
def test_what_a_command_wrote_is_an_earlier_result(content: str, tmp_path: Path) -> None:
    path = tmp_path / "f.json"
    path.write_text(content)
    assert writable(path) == path
    assert path.read_text() == content
    write_result(path, {})


@pytest.mark.parametrize(
    "content",
    ["[]", "{}", "note", '{"written_by": "me"}', '{"about": {}}', '["written_by"]', b"\xff\xfe"],
)
def test_a_file_that_is_no_earlier_result_stays(content: str | bytes, tmp_path: Path) -> None:
    path, link = tmp_path / "note.json", tmp_path / "link.json"
    before = content if isinstance(content, bytes) else content.encode()
    path.write_bytes(before)
    link.symlink_to(path)
    for each in (path, link):
        with pytest.raises(UsageError, match=r"is no earlier result of tacgrasp, so it is not rep"):
            writable(each)
        with pytest.raises(UsageError, match="name another file"):
            write_result(each, {})
    assert path.read_bytes() == before


def test_a_page_takes_the_place_of_an_earlier_page_alone(tmp_path: Path) -> None:
    page, readme = tmp_path / "faults.md", tmp_path / "README.md"
    text = markdown_of([], "tacgrasp bench faults")
    for _ in range(2):
        write_page(page, text, flag="--markdown")
    assert writable(page, ".md", flag="--markdown") == page
    readme.write_text("# Mine\n")
    with pytest.raises(
        UsageError, match=r"--markdown .*README\.md exists and is no earlier result"
    ):
        writable(readme, ".md", flag="--markdown")
    assert readme.read_text() == "# Mine\n"


OVER_OTHERS = {
    "run": ["run", "--policy", "rules", "--json", "{file}"],
    "understand": ["understand", "Hold it.", "--json", "{file}"],
    "data stats": ["data", "stats", "{made}/data", "--json", "{file}"],
    "bench latency": ["bench", "latency", "--ticks", "1", "--json", "{file}"],
    "eval instructions": ["eval", "instructions", "--json", "{file}"],
}


@pytest.mark.parametrize("name", OVER_OTHERS)
def test_no_command_writes_its_result_over_a_file_of_another_s(
    name: str, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    note = tmp_path / "note.json"
    note.write_text('{"mine": 1}')
    assert main([word.format(made=folder, file=note) for word in OVER_OTHERS[name]]) == 2
    said = capsys.readouterr()
    assert said.err.count("\n") == 1
    assert f"--json {note} exists and is no earlier result of tacgrasp" in said.err
    assert said.out == ""
    assert note.read_text() == '{"mine": 1}'


def test_a_data_set_s_own_description_is_not_replaced_by_its_figures(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    description = folder / "data" / "dataset.json"
    before = description.read_bytes()
    assert main(["data", "stats", str(folder / "data"), "--json", str(description)]) == 2
    assert "is no earlier result of tacgrasp" in capsys.readouterr().err
    assert description.read_bytes() == before
    for _ in range(2):
        argv = ["data", "stats", str(folder / "data"), "--json", str(tmp_path / "stats.json")]
        assert main(argv) == 0


@pytest.mark.parametrize("name", ["run.json", "run.jsonl"])
def test_a_run_takes_the_place_of_an_earlier_run(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    argv = ["run", "--instruction", "Crush the berry.", "--policy", "rules", "--json", str(path)]
    for _ in range(2):
        assert main(argv) == 2  # the instruction is refused, which the file tells
        text = path.read_text()
        is_array = path.suffix == ".json"
        events = json.loads(text) if is_array else [json.loads(x) for x in text.splitlines()]
        assert [event["event"] for event in events] == ["contract", "end"]
        assert events[-1]["reason"] == "refused"


def test_a_result_goes_into_a_pipe_or_terminal_as_it_is(tmp_path: Path) -> None:
    write_result(Path(os.devnull), {})
    assert Path(os.devnull).is_char_device()
    with pytest.raises(UsageError, match="can't be written"):
        write_result(tmp_path, {})


def test_a_recording_that_fills_the_disk_says_so_on_standard_error(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    from tacgrasp.episodes import EpisodeError, EpisodeWriter, read_episode

    path = tmp_path / "e.mcap"
    with full_disk(60_000), EpisodeWriter(path, header()) as writer:
        with pytest.raises(EpisodeError, match="the file would exceed the size limit"):
            for index in range(50):
                writer.write_step(step_record(index))
        with pytest.raises(EpisodeError, match="is closed"):
            writer.finish(end())
    (logged,) = caplog.records  # nothing else configures logging: errors go to standard error
    assert logged.levelname == "ERROR"
    assert "the file would exceed the size limit" in logged.getMessage()
    assert read_episode(path).steps


def test_an_error_of_the_disk_anywhere_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device", "/full/disk.json")

    monkeypatch.setattr("tacgrasp.cli.episodes._list", fail)
    assert main(["episodes", "ls"]) == 2
    error = capsys.readouterr().err
    assert error.startswith("tacgrasp: /full/disk.json can't be used: No space left on device")
    assert error.endswith("free space, or name another file or folder\n")
    assert error.count("\n") == 1


def test_freeing_space_is_advised_for_a_full_disk_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise OSError(errno.ENOTDIR, "Not a directory", "/a/file/below")

    monkeypatch.setattr("tacgrasp.cli.episodes._list", fail)
    assert main(["episodes", "ls"]) == 2
    expected = "/a/file/below can't be used: Not a directory; name another file or folder"
    assert capsys.readouterr().err == f"tacgrasp: {expected}\n"


def test_the_limit_of_these_tests_stops_a_write(tmp_path: Path) -> None:
    with full_disk(), pytest.raises(OSError, match="too large"):
        np.save(tmp_path / "a.npy", np.zeros(9))
    assert io.DEFAULT_BUFFER_SIZE > 0
