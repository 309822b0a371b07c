"""Baselines that leave out a part of what is felt."""

import numpy as np
import pytest

from cltp.tactile.measure import contact_state
from policies import Observation
from policies.baselines import CenterOnlyPolicy, ForceOnlyPolicy, RandomPolicy
from primitives.primitive import PAD_DIRECTION, Primitive
from tests.fakes.contracts import contract
from tests.fakes.loop_fakes import touch

SEEN = Observation(cloud=touch(), in_contact=True)
FELT_N = contact_state(SEEN.cloud, in_contact=True).force_n


@pytest.mark.parametrize("factor", [0.1, 10.0])
def test_center_only_leaves_every_force_as_it_is(factor):
    held = contract(factor * FELT_N, 1.2 * factor * FELT_N, 100.0)
    decision = CenterOnlyPolicy(move_step_mm=3.0).decide(SEEN, held)
    assert decision.action is None or decision.action in PAD_DIRECTION


@pytest.mark.parametrize(
    ("factor", "action"),
    [(0.1, Primitive.DECREASE_FORCE), (4.0, Primitive.INCREASE_FORCE), (0.9, None)],
)
def test_force_only_changes_the_force_as_the_rules_do(factor, action):
    held = contract(factor * FELT_N, 1.3 * factor * FELT_N, 100.0)
    decision = ForceOnlyPolicy(move_step_mm=3.0).decide(SEEN, held)
    assert decision.action is action
    assert decision.success is (action is None)


def test_random_decisions_tell_nothing_of_what_draws_the_world():
    choices = [*Primitive, None]
    for seed in range(3):
        policy, world = RandomPolicy(seed), np.random.default_rng([seed, 0])
        drawn = [policy.decide(SEEN, contract(1.0, 2.0, 3.0)).action for _ in range(20)]
        assert drawn != [choices[int(8 * world.random())] for _ in range(20)]
        assert not np.array_equal(policy._rng.random(8), np.random.default_rng(seed).random(8))
