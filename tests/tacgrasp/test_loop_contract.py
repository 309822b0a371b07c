"""The loop under a contract: decisions beyond it, the objection of a soft contact, refusals."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from cltp.tactile.measure import contact_state
from policies import Decision, Observation, observation
from primitives import LimitError, Primitive
from primitives.contract import Contract
from sim.grasp.rig import build
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import Episode, read_episode
from tacgrasp.playback.replay import contract_in, differences
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.protocols import Rig
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import EndReason, Outcome, Verification
from tacgrasp.runtime.steps import Steps
from tests.fakes.contracts import STRAWBERRY, contract, refused_contract, wide_contract
from tests.fakes.loop_fakes import (
    GOOD,
    LIGHT,
    FakeRig,
    ListRecorder,
    Scripted,
    config,
    play,
    touch,
)


@pytest.fixture(autouse=True)
def _any_force(monkeypatch: pytest.MonkeyPatch) -> None:
    """The fake sensor shows the same contact under any command."""
    monkeypatch.setattr(observation, "POSSIBLE_RATIO", math.inf)


FELT_N = contact_state(touch()).force_n
FIRM = "It is too firm. Decrease the gripping force."
HARD = contract(3.6, 7.2, 9.0, soft=STRAWBERRY)


@pytest.mark.parametrize(
    ("text", "held", "reason"),
    [
        (GOOD, contract(3 * FELT_N, 6 * FELT_N, 10 * FELT_N), "success, but"),
        (GOOD, contract(FELT_N / 6, FELT_N / 3, FELT_N / 2), "success, but"),
        (LIGHT, contract(FELT_N / 6, FELT_N / 3, 10 * FELT_N), "more force, but"),
        (FIRM, contract(3 * FELT_N, 6 * FELT_N, 10 * FELT_N), "less force, but"),
        (
            GOOD,
            replace(wide_contract(), depth_mm=contract(5.0, 6.0, 7.0).terms.force_n),
            "success, but the depth is",
        ),
    ],
    ids=["too light", "too firm", "more of too much", "less of too little", "too shallow"],
)
def test_a_decision_beyond_the_contract_is_no_action_and_is_recorded_as_such(
    text: str, held: Contract, reason: str
) -> None:
    outcome, rig, recorder = play(Scripted(text), settings=config(max_asks=2), contract=held)
    assert outcome.reason is EndReason.NO_ACTION
    assert outcome.message.startswith(
        f"2 decisions in a row moved nothing (beyond the contract: {reason}"
    )
    assert (outcome.num_actions, rig.moves) == (0, 0)
    assert rig.gripper.forces_n == [0.03]  # the first grasp
    decision = recorder.steps[0].decision
    assert decision is not None
    assert decision.text == text
    assert (decision.action, decision.success) == (None, False)
    assert decision.reason.startswith(f"beyond the contract: {reason}")


def test_a_success_inside_the_contract_stands() -> None:
    held = contract(FELT_N / 1.5, FELT_N * 1.5, 10 * FELT_N)
    assert play(Scripted(GOOD), contract=held)[0].reason is EndReason.SUCCESS


def test_a_refused_contract_sends_nothing_to_any_device() -> None:
    rig, recorder = FakeRig(), ListRecorder()
    with pytest.raises(LimitError, match="refused: it asks to let go"):
        play(Scripted(GOOD), rig=rig, recorder=recorder, contract=refused_contract())
    assert rig.calls == []
    assert (recorder.steps, recorder.ends) == ([], [])


def test_policy_and_verification_are_given_the_contract_of_the_episode() -> None:
    seen: list[Contract] = []

    class Asking(Scripted):
        def decide(self, observation: Observation, contract: Contract) -> Decision:
            seen.append(contract)
            return super().decide(observation, contract)

    def verify(rig: Rig, steps: Steps, config: RunConfig, contract: Contract) -> Verification:
        seen.append(contract)
        return Verification(passed=True, message="held")

    held = wide_contract()
    play(Asking(GOOD), verify=verify, contract=held)
    assert seen == [held, held]


def test_an_increase_at_the_contracts_limit_ends_the_episode_with_limit() -> None:
    held = contract(1.1 * FELT_N, 1.2 * FELT_N, 1.3 * FELT_N)  # a reading may be off by more
    outcome, rig, _ = play(Scripted(LIGHT), contract=held, settings=config(max_steps=50))
    assert outcome.reason is EndReason.LIMIT
    assert "already at its limit" in outcome.message
    assert rig.gripper.forces_n == [0.03]


@pytest.fixture(scope="module")
def objected(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Outcome, Episode, Path]]:
    """A soft berry under the contract of a peg, in the simulator."""
    folder = tmp_path_factory.mktemp("objection")
    settings = config().model_copy(update={"record": folder, "policy": "rules", "seed": 9})
    rig = build("strawberry", 9, start_offset_mm=(0.0, 0.0), noise_level=0.0)
    try:
        outcome, path = run_recorded(rig, make_policy("rules", settings), settings, HARD)
    finally:
        rig.disconnect()
    yield outcome, read_episode(path), path


def test_a_soft_contact_changes_a_contract_for_hard_things_within_the_episode(objected) -> None:
    outcome, episode, _ = objected
    assert outcome.reason is EndReason.SUCCESS
    assert episode.header.contract == HARD
    changed = [step for step in episode.steps if step.contract is not None]
    assert len(changed) == 1
    assert changed[0].contract.terms == STRAWBERRY
    assert "what is felt is soft: held to 0.95-1.90 N" in changed[0].note


def test_the_berry_that_objected_is_held_within_the_terms_of_soft_things(objected) -> None:
    outcome, _, _ = objected
    assert outcome.truth["peak_force_n"] <= STRAWBERRY.limit_n
    assert not outcome.truth["bruised"]
    assert not outcome.truth["dropped"]


def test_an_episode_with_an_objection_is_decided_again_exactly(objected) -> None:
    _, episode, _ = objected
    settings = config()
    held = contract_in(episode, settings)
    assert list(differences(episode, make_policy("rules", settings), held)) == []
    decided = [step.decision for step in episode.steps if step.decision is not None]
    assert Primitive.INCREASE_FORCE in {decision.action for decision in decided}


@pytest.mark.parametrize(
    "change",
    [{"action": "squeeze_hard"}, {"confidence": float("nan")}, None],
    ids=["unknown action", "not finite", "nothing"],
)
def test_a_corrupt_reply_moves_nothing_and_the_policy_is_asked_again(
    change: dict[str, object] | None,
) -> None:
    class Corrupt(Scripted):
        def decide(self, observation: Observation, contract: Contract) -> Decision:
            reply = super().decide(observation, contract)
            if self.num_asks > 2:
                return reply
            broken = None if change is None else replace(reply, success=False, **change)
            return cast("Decision", broken)

    outcome, rig, recorder = play(Corrupt(GOOD), settings=config(max_faults=3))
    assert outcome.reason is EndReason.SUCCESS
    assert outcome.num_actions == 0
    assert rig.gripper.forces_n == [0.03]  # the first grasp
    assert recorder.steps[0].note.count("PolicyError") == 2
