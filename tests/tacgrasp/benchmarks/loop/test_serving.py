"""The benchmark of a policy server counts what the robots really got."""

import pytest

from policies import Observation, PolicyError
from policies.rules import RulesPolicy
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.loop import serving
from tacgrasp.testing import CLOUDS, CONTRACT
from tests.fakes.policy_servers import served

OBSERVATIONS = [Observation(cloud=cloud, in_contact=True) for cloud in CLOUDS[:2]]


def test_figures_are_those_of_all_robots_together():
    figures = serving._figures([[10.0] * 4, [20.0] * 3], seconds=2.0)
    assert figures["decisions_per_s"] == 3.5
    assert figures["p50_ms"] == 10.0
    assert figures["fairness"] == 0.75


def test_every_robot_is_answered():
    with served(lambda: RulesPolicy(move_step_mm=3.0)) as url:
        times_ms = serving._measure(url, 3, 1.0, OBSERVATIONS, CONTRACT)
    assert len(times_ms) == 3
    assert all(len(each) > 1 and min(each) > 0 for each in times_ms)


def test_a_server_that_fails_ends_the_measurement_with_its_reason():
    class Broken(RulesPolicy):
        def decide(self, observation, contract):
            raise PolicyError("no weights here")

    with served(lambda: Broken(move_step_mm=3.0)) as url:  # noqa: SIM117
        with pytest.raises(PolicyError, match="no weights here"):
            serving._measure(url, 2, 1.0, OBSERVATIONS, CONTRACT)


def test_a_server_that_does_not_start_is_named(capsys):
    assert main(["bench", "serve", "--policy", "gut", "--seconds", "1"]) == 2
    assert "the server did not start: tacgrasp: unknown policy 'gut'" in capsys.readouterr().err
