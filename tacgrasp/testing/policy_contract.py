"""What every Policy must do, whatever it is; run by subclassing ``PolicyContract``.

A subclass gives ``make``: a fresh policy, the same each time.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from cltp.tactile.cloud import TactileCloud, cloud_from_heights
from cltp.tactile.sensors import sensor_named
from policies import Decision, Observation, Policy
from policies.extraction import extract
from primitives.contract import Band, Contract

SENSOR = sensor_named("gelsight_mini")
CONTRACT = Contract(
    text="Pick the strawberry gently, without bruising it.",
    summary="pick the strawberry",
    force_n=Band(low=0.5, high=2.5),
    limit_n=3.2,
    slip_mm=1.0,
    depth_mm=Band(low=0.1, high=0.6),
    area_fraction=Band(low=0.01, high=0.6),
    x_mm=Band(low=-2.5, high=2.5),
    y_mm=Band(low=-2.5, high=2.5),
)
"""What every policy of the suite decides for."""


def cap(x_mm: float, y_mm: float, depth_mm: float) -> TactileCloud:
    """A rounded dent of 4 mm radius; none when ``depth_mm`` is 0."""
    across = (np.arange(64) + 0.5) / 64 * SENSOR.width_mm - SENSOR.width_mm / 2
    down = SENSOR.height_mm / 2 - (np.arange(48) + 0.5) / 48 * SENSOR.height_mm
    far2 = (across[None, :] - x_mm) ** 2 + (down[:, None] - y_mm) ** 2
    return cloud_from_heights(depth_mm * np.clip(1 - far2 / 16, 0, None), SENSOR)


CLOUDS = (cap(0, 0, 0.4), cap(0, -5, 0.3), cap(7, 0, 0.2), cap(0, 0, 1.2), cap(0, 0, 0))
"""A good contact, one below the middle, one to the right, a deep one, none."""


class PolicyContract:
    """Subclass as Test...; every test runs on ``make()``."""

    def make(self) -> Policy:
        """A fresh policy, the same each time."""
        raise NotImplementedError

    @pytest.fixture
    def policy(self) -> Policy:
        policy = self.make()
        policy.start()
        return policy

    def decide_all(self, policy: Policy) -> list[Decision]:
        """Decisions on ``CLOUDS``."""
        return [policy.decide(Observation(cloud=cloud), CONTRACT) for cloud in CLOUDS]

    def test_it_has_a_name_that_fits_a_command_line(self, policy: Policy) -> None:
        assert policy.name
        assert policy.name.replace("_", "").isalnum()

    def test_every_decision_is_complete(self, policy: Policy) -> None:
        for decision in self.decide_all(policy):
            assert isinstance(decision, Decision)
            assert decision.text.strip()
            assert decision.reason
            assert 0 <= decision.confidence <= 1
            assert all(math.isfinite(ms) and ms >= 0 for ms in decision.stage_ms.values())

    def test_action_and_success_are_what_extraction_reads_in_the_text(self, policy: Policy) -> None:
        for decision in self.decide_all(policy):
            extraction = extract(decision.text)
            assert decision.action in (extraction.action, None)  # a policy may abstain
            assert decision.success in (extraction.success, False)

    def test_a_fresh_policy_decides_the_same(self, policy: Policy) -> None:
        def as_tuples(decisions: list[Decision]) -> list[tuple[object, ...]]:
            return [(d.text, d.action, d.success, d.confidence) for d in decisions]

        again = self.make()
        again.start()
        assert as_tuples(self.decide_all(policy)) == as_tuples(self.decide_all(again))

    def test_a_cloud_is_left_as_it_was(self, policy: Policy) -> None:
        before = CLOUDS[0].points_mm.copy()
        policy.decide(Observation(cloud=CLOUDS[0]), CONTRACT)
        assert np.array_equal(CLOUDS[0].points_mm, before)

    def test_start_can_be_called_at_any_time(self, policy: Policy) -> None:
        policy.start()
        self.decide_all(policy)
        policy.start()
        self.decide_all(policy)
