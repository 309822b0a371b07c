"""The file of a run for machines: valid at every moment, whichever kind it is."""

import json
import os
import resource
import threading

import pytest

from cltp.tactile.force_scale import UNCALIBRATED
from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_replaceable
from tacgrasp.cli.run import main
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.runtime.events import EventFile
from tests.tacgrasp.episodes.test_force_scale import scaled_step

CONTRACT = contract_of(load("strawberry")[0])


def test_a_json_file_is_one_array_after_every_event(tmp_path):
    path = tmp_path / "events.json"
    with EventFile(path) as events:
        for number in range(1, 4):
            if number == 1:
                events.contract(CONTRACT)
            else:
                events.step(scaled_step(UNCALIBRATED))
            names = [event["event"] for event in json.loads(path.read_text("utf-8"))]
            assert names == ["contract", "step", "step"][:number]
    check_replaceable(path)  # a later run may replace it
    path.write_text('[{"event": "mine"}]')
    with pytest.raises(UsageError, match="no earlier result"):
        check_replaceable(path)


def test_a_jsonl_file_has_an_object_a_line(tmp_path):
    path = tmp_path / "events.jsonl"
    with EventFile(path) as events:
        events.contract(CONTRACT)
        events.step(scaled_step(UNCALIBRATED))
    lines = [json.loads(line) for line in path.read_text("utf-8").splitlines()]
    assert [line["event"] for line in lines] == ["contract", "step"]


def test_a_pipe_gets_an_object_a_line_whatever_its_name(tmp_path):
    path, received = tmp_path / "pipe.json", []
    os.mkfifo(path)
    reader = threading.Thread(target=lambda: received.extend(path.read_text().splitlines()))
    reader.start()
    with EventFile(path) as events:
        events.contract(CONTRACT)
        events.contract(CONTRACT)
    reader.join(10)
    assert [json.loads(line)["event"] for line in received] == ["contract", "contract"]


def test_a_file_that_another_run_writes_to_is_refused(tmp_path):
    path = tmp_path / "run.json"
    with EventFile(path) as events:
        events.contract(CONTRACT)
        with pytest.raises(UsageError, match="is being written by another run"), EventFile(path):
            pass
    assert [event["event"] for event in json.loads(path.read_text("utf-8"))] == ["contract"]


def test_a_file_on_a_full_disk_ends_there_and_raises_nothing(tmp_path):
    path = tmp_path / "full.jsonl"
    path.symlink_to("/dev/full")
    with EventFile(path) as events:
        events.contract(CONTRACT)
        events.step(scaled_step(UNCALIBRATED))
    assert events.problem == f"--json {path}: No space left on device"


def test_a_file_that_takes_nothing_is_refused_before_anything_moves(tmp_path):
    path = tmp_path / "full.jsonl"
    path.symlink_to("/dev/full")
    argv = ["--policy", "rules", "--record", str(tmp_path / "episodes"), "--json", str(path)]
    with pytest.raises(UsageError, match=r"full.jsonl: No space left.*another file; nothing moved"):
        main(argv)
    assert not (tmp_path / "episodes").exists()


def test_a_run_whose_file_is_cut_short_says_so_and_is_no_success(tmp_path, monkeypatch, capsys):
    def step_of_a_full_disk(events, record):
        events.problem = "--json run.json: No space left on device"

    monkeypatch.setattr(EventFile, "step", step_of_a_full_disk)
    argv = ["--policy", "rules", "--record", str(tmp_path), "--json", str(tmp_path / "run.json")]
    assert main(argv) == 3
    told = capsys.readouterr()
    assert "Grasp completed successfully" in told.out
    assert "No space left on device; what came later is not in it" in told.err


def test_an_array_that_can_t_grow_keeps_what_it_has(tmp_path):
    path = tmp_path / "events.json"
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    with EventFile(path) as events:
        events.contract(CONTRACT)
        resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 20, hard))
        try:
            events.step(scaled_step(UNCALIBRATED))
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        events.step(scaled_step(UNCALIBRATED))
    assert events.problem
    assert [event["event"] for event in json.loads(path.read_text("utf-8"))] == ["contract"]


def test_the_command_writes_an_array_from_contract_to_end(tmp_path):
    path = tmp_path / "run.json"
    argv = ["--policy", "rules", "--record", str(tmp_path / "episodes"), "--json", str(path)]
    assert main(argv) == 0
    written = json.loads(path.read_text("utf-8"))
    assert written[1]["t_s"] == 0.0 < written[2]["t_s"]  # since the first step, as on the screen
    events = [event["event"] for event in written]
    assert (events[0], events[-1]) == ("contract", "end")
    assert set(events[1:-1]) == {"step"}
    end = json.loads(path.read_text("utf-8"))[-1]
    assert (end["reason"], end["safe_state"]) == ("success", "the gripper keeps its grip")
    assert main(argv) == 0  # replaced by the next run


@pytest.mark.parametrize("events_before", [0, 1])
@pytest.mark.parametrize(
    ("stop", "reason"), [(KeyboardInterrupt(), "operator"), (ValueError("no camera"), "fault")]
)
def test_what_stops_a_run_before_it_begins_is_its_end(tmp_path, events_before, stop, reason):
    path = tmp_path / "events.json"
    with pytest.raises(type(stop)), EventFile(path) as events:
        if events_before:
            events.contract(CONTRACT)
        raise stop
    told = json.loads(path.read_text("utf-8"))
    assert [event["event"] for event in told] == ["contract", "end"][1 - events_before :]
    assert told[-1]["reason"] == reason
    assert told[-1]["message"] == (str(stop) or "stopped by the operator")
    assert told[-1]["verified"] is None
    check_replaceable(path)


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (KeyboardInterrupt(), "operator"),
        (UsageError("no such weights"), "refused"),
        (ValueError("a bug"), "fault"),
    ],
)
def test_a_run_without_an_outcome_ends_with_its_reason_and_what_was_done(tmp_path, error, reason):
    path = tmp_path / "run.jsonl"
    with pytest.raises(type(error)), EventFile(path) as events:
        events.step(scaled_step(UNCALIBRATED))
        raise error
    end = json.loads(path.read_text("utf-8").splitlines()[-1])
    assert (end["event"], end["reason"], end["steps"]) == ("end", reason, 1)


def test_a_wrong_flag_leaves_the_events_of_an_earlier_run(tmp_path):
    path = tmp_path / "run.jsonl"
    path.write_text('{"event": "end"}\n')
    with pytest.raises(UsageError, match="unknown policy"):
        main(["--policy", "nonsense", "--json", str(path)])
    assert path.read_text() == '{"event": "end"}\n'
