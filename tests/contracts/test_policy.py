"""The Policy contract on every policy that needs no simulator, and what is each one's own."""

import importlib.util
from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import ContactState, Side, area_word, depth_word, position_word
from policies import Observation
from policies.baselines import FixedForcePolicy, RandomPolicy
from policies.rules import RulesPolicy
from primitives import LimitError, Primitive
from tacgrasp.testing import CLOUDS, CONTRACT, PolicyContract
from tests.fakes.contracts import refused_contract


def by_eye(cloud) -> ContactState:
    """A crude measurement, enough to tell the contract's dents apart; 3 N per mm."""
    points = cloud.points_mm
    x, y, depth = (float(v) for v in points[points[:, 2].argmax()])
    share = float((points[:, 2] > 0.02).mean())
    touching = depth > 0.05
    return ContactState(
        depth_mm=depth,
        x_mm=x,
        y_mm=y,
        area_fraction=share,
        force_n=3 * depth,
        depth=depth_word(depth) if touching else None,
        position=position_word(x, y, sensor_named("gelsight_mini")) if touching else None,
        area=area_word(share) if touching else None,
        cut=frozenset[Side](),
    )


class TestRules(PolicyContract):
    def make(self):
        return RulesPolicy(move_step_mm=3.0, measure=by_eye)

    def test_each_dent_gets_its_advice(self, policy):
        actions = [d.action for d in self.decide_all(policy)]
        assert actions == [
            None,
            Primitive.MOVE_DOWN,
            Primitive.MOVE_RIGHT,
            Primitive.DECREASE_FORCE,
            Primitive.RESET,
        ]
        assert [d.success for d in self.decide_all(policy)] == [True] + 4 * [False]

    def test_a_refused_contract_is_not_decided_for(self, policy):
        with pytest.raises(LimitError, match="refused"):
            policy.decide(Observation(cloud=CLOUDS[0]), refused_contract())

    def test_nothing_is_done_about_a_pad_that_is_raised_all_over(self):
        for cloud in CLOUDS:
            raised = replace(cloud, points_mm=cloud.points_mm + np.float32([0, 0, 0.5]))
            decision = RulesPolicy(move_step_mm=3.0).decide(Observation(cloud=raised), CONTRACT)
            assert (decision.action, decision.success) == (None, False)
            assert "raised by 0.50 mm" in decision.reason
            with pytest.raises(LimitError, match="refused"):
                RulesPolicy(move_step_mm=3.0).decide(Observation(cloud=raised), refused_contract())

    def test_every_stage_is_timed(self, policy):
        decision = policy.decide(Observation(cloud=CLOUDS[0]), CONTRACT)
        assert list(decision.stage_ms) == ["measure", "teacher", "speak", "extract"]

    def test_stages_are_the_differences_of_the_clock_in_ms(self):
        ticks = iter([0.0, 0.001, 0.003, 0.006, 0.010])
        policy = RulesPolicy(move_step_mm=3.0, measure=by_eye, clock=lambda: next(ticks))
        stages = policy.decide(Observation(cloud=CLOUDS[0]), CONTRACT).stage_ms
        assert list(stages.values()) == pytest.approx([1, 2, 3, 4])


@pytest.mark.skipif(
    importlib.util.find_spec("cltp.tactile.measure") is None,
    reason="cltp.tactile.measure is not there yet",
)
class TestRulesAsShipped(PolicyContract):
    def make(self):
        return RulesPolicy(move_step_mm=3.0)

    def test_dents_off_centre_are_followed_and_no_dent_is_a_reset(self, policy):
        actions = [d.action for d in self.decide_all(policy)]
        assert actions[1:3] == [Primitive.MOVE_DOWN, Primitive.MOVE_RIGHT]
        assert actions[4] is Primitive.RESET


class TestFixedForce(PolicyContract):
    def make(self):
        return FixedForcePolicy()

    def test_it_calls_everything_secure(self, policy):
        assert all(d.success and d.action is None for d in self.decide_all(policy))


class TestRandom(PolicyContract):
    def make(self):
        return RandomPolicy(seed=7)

    def test_each_of_the_eight_choices_comes_about_as_often(self, policy):
        drawn = [policy.decide(Observation(cloud=CLOUDS[0]), CONTRACT) for _ in range(1600)]
        counts = [sum(d.action is p for d in drawn) for p in Primitive]
        counts.append(sum(d.success for d in drawn))
        assert sum(counts) == 1600
        assert all(140 <= n <= 260 for n in counts)  # 200 ± 4.5 standard deviations

    def test_another_seed_draws_otherwise(self, policy):
        other = RandomPolicy(seed=8)
        ours = [policy.decide(Observation(cloud=CLOUDS[0]), CONTRACT).text for _ in range(20)]
        assert ours != [
            other.decide(Observation(cloud=CLOUDS[0]), CONTRACT).text for _ in range(20)
        ]
