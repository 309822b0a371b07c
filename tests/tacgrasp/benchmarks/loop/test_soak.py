"""The soak counts its episodes, goes on where it ended, and says when memory or files grow."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.loop import soak
from tacgrasp.benchmarks.settings import SoakSettings
from tacgrasp.config.schema import RunConfig
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import Outcome


def figures(path: Path) -> dict[str, object]:
    return dict(json.loads(path.read_text()))


@pytest.mark.slow
def test_a_soak_goes_on_where_it_ended(tmp_path: Path) -> None:
    path = tmp_path / "soak.json"
    assert soak.run(SoakSettings(episodes=2, json=path))
    first = figures(path)
    assert {"episodes", "rss_mib_first", "rss_mib_last", "fds_last", "per_s"} <= first.keys()
    assert (first["episodes"], first["processes"]) == (2, 1)
    soak.run(SoakSettings(episodes=3, json=path))
    second = figures(path)
    assert (second["episodes"], second["processes"]) == (3, 2)
    assert sum(second["ends"].values()) == 3  # type: ignore[attr-defined]
    assert second["rss_mib_first"] == first["rss_mib_first"]


def test_figures_of_another_soak_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "soak.json"
    path.write_text('{"policy": "llm", "task": "strawberry", "first_seed": 2000000}')
    with pytest.raises(UsageError, match="does not hold figures of a soak with policy rules"):
        soak.run(SoakSettings(episodes=1, json=path))
    path.write_text("[]")
    with pytest.raises(UsageError, match="does not hold figures"):
        soak.run(SoakSettings(episodes=1, json=path))


@pytest.fixture(scope="module")
def episode_run_once() -> Callable[..., tuple[Outcome, Path]]:
    """Runs the first episode that is asked for, and afterwards gives its outcome again."""
    outcomes: list[Outcome] = []

    def run(rig: object, policy: object, config: RunConfig, *rest: object) -> tuple[Outcome, Path]:
        if outcomes:
            path = Path(str(config.record)) / "again.mcap"
            path.touch()
        else:
            outcome, path = run_recorded(rig, policy, config, *rest)  # type: ignore[arg-type]
            outcomes.append(outcome)
        return outcomes[0], path

    return run


@pytest.mark.parametrize(
    ("measure", "grows_to"), [("_rss_mib", 300.0), ("_num_open_files", 9)], ids=["memory", "files"]
)
def test_growth_fails_the_soak(
    measure: str,
    grows_to: float,
    episode_run_once: Callable[..., tuple[Outcome, Path]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(soak, "run_recorded", episode_run_once)
    values = iter([1, grows_to, grows_to, grows_to])
    monkeypatch.setattr(soak, measure, lambda: next(values))
    assert not soak.run(SoakSettings(episodes=1))
