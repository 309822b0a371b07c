"""A pad that is measured in part is said to be, and nothing acts on it."""

from __future__ import annotations

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, cloud_of_pixels
from cltp.tactile.sensors import sensor_named
from policies import Observation
from policies.llm.policy import LlmPolicy
from policies.rules import RulesPolicy
from sim.independent.contacts import make_contact
from tacgrasp.playback.conversation import Conversation
from tacgrasp.playback.describe import PARTIAL, describe, describe_in_numbers
from tacgrasp.policy_factory import shipped_weights
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.serving.unread import unread_reason
from tacgrasp.testing import CONTRACT
from tests.fakes.tiny_weights import bump

MINI = sensor_named("gelsight_mini")
PIXELS = cloud_of_pixels(bump(4.0, -2.0, 0.5), MINI).points_mm


def cut(x_mm: float, contact_mm: float = 4.0) -> TactileCloud:
    points = cloud_of_pixels(bump(contact_mm, -2.0, 0.5), MINI).points_mm
    return TactileCloud(points_mm=points[points[:, 0] < x_mm], sensor=MINI)


def test_a_contact_may_be_in_the_part_that_is_not_measured() -> None:
    told = describe_in_numbers(cut(0.0), None)
    assert (told["contact"], told["numbers"], told["flags"]) == (None, {}, [PARTIAL])
    assert told["state"]["caption"].startswith("points cover 4")
    assert "contact   unknown: points cover" in describe(cut(0.0))[-1]


def test_what_is_found_in_the_rest_is_flagged() -> None:
    told = describe_in_numbers(cut(7.0, contact_mm=-4.0), None)
    assert told["contact"] is True
    assert told["flags"].count(PARTIAL) == 1
    assert any(
        "don't act on this: points cover 8" in line for line in describe(cut(7.0, contact_mm=-4.0))
    )


class Sensor:
    spec = MINI

    def read(self, frames: int = 1) -> TactileCloud:
        return cut(0.0)


def test_neither_a_run_nor_a_server_nor_the_rules_act_on_it() -> None:
    with pytest.raises(TouchError, match=r"points cover .* of the pad"):
        GelSense(Sensor()).read()  # type: ignore[arg-type]
    for in_contact in (None, True, False):
        assert "points cover" in unread_reason(
            Observation(cloud=cut(7.0, contact_mm=-4.0), in_contact=in_contact)
        )
    decision = RulesPolicy(move_step_mm=3.0).decide(
        Observation(cloud=cut(7.0, contact_mm=-4.0)), CONTRACT
    )
    assert (decision.action, decision.success) == (None, False)
    assert "points cover" in decision.reason


def test_the_remedy_for_nan_says_that_a_hole_is_not_read() -> None:
    points = np.where(PIXELS[:, :1] > 0, np.float32(np.nan), PIXELS)
    with pytest.raises(TouchError, match=r"drop them where they are few .* hole is not read"):
        TactileCloud(points_mm=points, sensor=MINI)


def test_an_answer_that_would_be_acted_on_says_that_it_is_not_to_be() -> None:
    talker = LlmPolicy(shipped_weights()).talker
    asked = Conversation(cut(7.0, contact_mm=-4.0), talker, contract=CONTRACT, mass_g=20)
    for question in ("What next?", "Is it safe to lift?"):
        assert "But don't act on it: points cover 8" in asked.ask(question).text
    assert "act on it" not in asked.ask("How deep is it?").text
    pressed = cloud_of_pixels(make_contact(1_600_000, MINI).height_mm, MINI)
    whole = Conversation(pressed, talker, contract=CONTRACT)
    assert "act on it" not in whole.ask("What next?").text
