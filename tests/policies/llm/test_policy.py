import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from numpy.typing import NDArray

import policies.llm.policy
from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.tac3d_llm import save_encoder, save_tac3d_llm
from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.encoder.reader import Flag, TouchReading
from cltp.encoder.readings import HeadReadings
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import Felt, Reply
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.cloud import TactileCloud, cloud_from_heights
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import NO_CONTACT_STATE, NUMBERS, ContactState, Side
from cltp.texts.tokenizer import ACTIONS, Words
from policies import Decision, Observation
from policies.errors import PolicyError
from policies.extraction import extract
from policies.llm.grammar import step_grammar
from policies.llm.parse import parse_reply
from policies.llm.policy import (
    LlmPolicy,
    denied,
    hold_reason,
    numbers_as_read,
    repeated_moves,
    with_felt_force,
)
from policies.teacher import SLIVER_FRACTION
from primitives import Primitive
from primitives.contract import Band
from primitives.sense import Interval
from tests.fakes.contracts import contract, wide_contract
from tests.fakes.question_scenes import HELD

TEXTS = [
    "Pick the strawberry gently, without bruising it.",
    "Please hold the egg securely, but do not crack it.",
    "Grip the peg firmly so that it does not turn.",
] * 20


@pytest.fixture(scope="module")
def words() -> Words:
    return Words.train(TEXTS, size=600)


@pytest.fixture(scope="module")
def untrained(words: Words, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("weights")
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny"])
    save_encoder(folder / "encoder", encoder, StateHeads(2 * encoder.config.dim))
    language = Language(small_lm(words, dim=48, layers=1), words=words)
    save_tac3d_llm(
        folder, Tac3dLlm(encoder, StateHeads(2 * encoder.config.dim), Projector(48, 48), language)
    )
    return folder


def touch() -> TactileCloud:
    y, x = np.mgrid[0:40, 0:50]
    return cloud_from_heights(
        0.4 * np.exp(-((x - 25) ** 2 + (y - 20) ** 2) / 60), SENSORS["gelsight_mini"]
    )


def reply(text: str, action: str | None, chance: float = 0.9, *, ended: bool = True) -> Reply:
    chances = [(1 - chance) / 7] * 8
    if action is not None:
        chances[ACTIONS.index(action)] = chance
    return Reply(
        text=text,
        ended=ended,
        num_tokens=20,
        action=action,
        probabilities=tuple(chances) if action else (),
        stage_ms={},
    )


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (reply("Action: <move_up>. It is off", "<move_up>", ended=False), "did not end"),
        (reply("The the the.", None), "comes to no action"),
        (reply("Action: <move_up>. Then <move_down>.", "<move_up>"), "was chosen"),
        (reply("Action: <move_up>. It is off centre.", "<move_up>", 0.3), "abstained"),
        (reply("Action: <none>. Move up.", "<none>"), None),
    ],
)
def test_nothing_is_done_about_a_reply_that_does_not_stand(
    answer: Reply, reason: str | None
) -> None:
    extraction = extract(answer.text)
    held = hold_reason(answer, extraction, 0.5)
    if reason is None:  # extraction itself calls this one ambiguous
        assert extraction.action is None
        assert not extraction.success
    else:
        assert reason in held


@pytest.mark.parametrize("action", ACTIONS)
def test_a_clear_reply_stands(action: str) -> None:
    answer = reply(f"smooth sphere, deep 0.70 mm. Action: {action}. It is so.", action)
    assert hold_reason(answer, extract(answer.text), 0.5) == ""


def test_an_untrained_model_is_held_and_never_acts_by_accident(untrained: Path) -> None:
    policy = LlmPolicy(untrained)
    policy.start()
    decision = policy.decide(Observation(cloud=touch()), wide_contract())
    assert decision.action is None
    assert not decision.success
    assert decision.reason
    assert set(decision.stage_ms) == {
        "sample",
        "encode",
        "project",
        "read",
        "prefill",
        "generate",
        "extract",
    }
    assert policy.decide(Observation(cloud=touch()), wide_contract()).text == decision.text


def test_a_twin_shares_the_model_and_has_a_memory_of_its_own(untrained: Path) -> None:
    first = LlmPolicy(untrained)
    first._moves.append(Primitive.MOVE_UP)
    twin = first.twin()
    twin._moves.append(Primitive.MOVE_DOWN)
    assert twin.talker is first.talker
    assert (first._moves, twin._moves) == ([Primitive.MOVE_UP], [Primitive.MOVE_DOWN])


def test_moves_of_another_length_than_in_training_are_refused_by_name_and_value(
    untrained: Path,
) -> None:
    policy = LlmPolicy(untrained)
    policy.check_move_step(3.0)
    message = (
        f"--primitives.move-step-mm is 5 mm, but the weights in {untrained} were trained with 3 mm"
    )
    with pytest.raises(PolicyError, match=re.escape(message)):
        policy.check_move_step(5.0)


def test_missing_weights_say_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="train"):
        LlmPolicy(tmp_path)


@pytest.mark.parametrize(
    ("moves", "banned"),
    [
        ([], set()),
        (["move_up"], set()),
        (["move_up", "move_up"], set()),
        (["move_up", "move_left"], set()),
        (["move_up", "move_down"], {"<move_up>", "<move_down>"}),
        (["move_up", "move_right", "move_left"], {"<move_left>", "<move_right>"}),
        (["move_up", "move_down", "move_left"], set()),
    ],
)
def test_a_move_and_its_undoing_ban_both_and_nothing_else(moves, banned):
    assert repeated_moves([Primitive(move) for move in moves]) == banned


def test_the_model_is_told_newtons_by_the_scale_of_the_cloud_s_unit(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy, scales = LlmPolicy(untrained), []
    feel = policy.talker.feel

    def noted(points: NDArray[np.float32], scale: ForceScale, *correct: Any) -> Felt:
        scales.append((scale.factor, scale.spread))
        return feel(points, scale, *correct)

    monkeypatch.setattr(policy.talker, "feel", noted)
    cloud = replace(touch(), force_scale=ForceScale(factor=1.7, spread=0.05, source="unit a"))
    policy.decide(Observation(cloud=cloud), wide_contract())
    policy.describe(cloud)
    assert scales == [(1.7, 0.05)] * 2


def test_d_t_names_the_target_of_the_contract_and_no_other(untrained: Path) -> None:
    said = LlmPolicy(untrained).decide(Observation(cloud=touch()), contract(0.95, 1.9, 2.4)).text
    assert "Goal 0.95 - 1.90 N." in said
    assert parse_reply(said).goal == Band(low=0.95, high=1.9)


SLIVER = replace(HELD.state, area_fraction=0.5 * SLIVER_FRACTION, cut=frozenset({Side.LEFT}))


@pytest.mark.parametrize(
    ("state", "barred"),
    [(SLIVER, [False, False, True, False]), (HELD.state, [True, False, True, True])],
)
def test_a_contact_that_is_felt_is_reset_once_where_only_a_sliver_is_on_the_pad(
    state: ContactState, barred: list[bool], untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    is_barred: list[bool] = []
    reading = policies.llm.policy.reading_of
    monkeypatch.setattr(
        policies.llm.policy,
        "reading_of",
        lambda *a, **k: replace(reading(*a, **k), state=state),
    )

    def record(_sensor: object, band: Band, excluded: list[str], *, numbers: object) -> Grammar:
        is_barred.append("<reset>" in excluded)
        return step_grammar(None, band)

    monkeypatch.setattr(policies.llm.policy, "step_grammar", record)
    policy, band = LlmPolicy(untrained), Band(low=0.42, high=0.51)
    found, lost = (Observation(cloud=touch(), in_contact=each) for each in (True, False))
    policy.say(found, band, 0.8)
    policy._has_reset = True
    policy.say(lost, band, 0.8)
    policy.say(found, band, 0.8)
    policy.start()
    policy.say(found, band, 0.8)
    assert is_barred == barred


def test_what_is_read_is_said_as_it_is_unless_the_model_must_say_all(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[object] = []

    def record(_sensor: object, band: Band, _excluded: object, *, numbers: object) -> Grammar:
        given.append(numbers)
        return step_grammar(None, band)

    monkeypatch.setattr(policies.llm.policy, "step_grammar", record)
    policy, band = LlmPolicy(untrained), Band(low=0.42, high=0.51)
    said = policy.say(Observation(cloud=touch()), band, 1.0)
    policy.through(policy.talker, says_readings=False).say(Observation(cloud=touch()), band, 1.0)
    assert given == [numbers_as_read(said.reading), None]


def test_every_number_of_a_contact_that_is_read_has_a_text() -> None:
    def read(state: ContactState) -> TouchReading:
        return TouchReading(state=state, numbers={}, confidence={}, contact=1.0, flags=())

    assert set(numbers_as_read(read(HELD.state))) == set(NUMBERS)
    assert numbers_as_read(read(NO_CONTACT_STATE)) == {}


def test_what_can_t_be_trusted_is_not_acted_on(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    monkeypatch.setattr(
        policy.talker, "reply_to", lambda *_, **__: reply("Action: <reset>.", "<reset>")
    )
    reading = policies.llm.policy.reading_of
    for flags, action in (((), Primitive.RESET), ((Flag.NOISE, Flag.FORCE), None)):
        monkeypatch.setattr(
            policies.llm.policy,
            "reading_of",
            lambda *a, flags=flags, **k: replace(reading(*a, **k), flags=flags),
        )
        decision = policy.decide(Observation(cloud=touch()), wide_contract())
        assert decision.action is action
        assert ("noise, force" in decision.reason) is (action is None)


def unread(
    policy: LlmPolicy,
    monkeypatch: pytest.MonkeyPatch,
    *flags: Flag,
    state: ContactState,
    contact: float = 1.0,
) -> None:
    """Let the model read a contact like this, and ask for a reset."""
    monkeypatch.setattr(
        policy.talker, "reply_to", lambda *_, **__: reply("Action: <reset>.", "<reset>")
    )
    reading = policies.llm.policy.reading_of
    monkeypatch.setattr(
        policies.llm.policy,
        "reading_of",
        lambda *a, **k: replace(reading(*a, **k), flags=flags, state=state, contact=contact),
    )


@pytest.mark.parametrize(
    ("flags", "state", "contact", "action", "reason"),
    [
        ((), NO_CONTACT_STATE, 0.1, Primitive.INCREASE_FORCE, "too light to be read"),
        ((), HELD.state, 0.9, Primitive.INCREASE_FORCE, "too light to be read"),
        ((Flag.UNSURE,), HELD.state, 1.0, Primitive.INCREASE_FORCE, "unsure"),
        ((Flag.NOISE,), HELD.state, 1.0, None, "noise"),
        ((Flag.UNSURE, Flag.FORCE), HELD.state, 1.0, None, "force"),
        ((), HELD.state, 1.0, Primitive.RESET, ""),
    ],
)
def test_a_contact_that_is_felt_and_can_t_be_read_is_measured(
    flags: tuple[Flag, ...],
    state: ContactState,
    contact: float,
    action: Primitive | None,
    reason: str,
    untrained: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, *flags, state=state, contact=contact)
    felt_n = contact_state(touch(), in_contact=True).force_n
    felt = Interval(value=felt_n, low=felt_n / 1.3, high=felt_n * 1.3)
    observation = Observation(cloud=touch(), in_contact=True, felt_force_n=felt)
    band = Band(low=0.9 * felt_n, high=1.1 * felt_n) if action is None else None
    band = band or Band(low=1.1 * felt_n, high=1.4 * felt_n)
    decision = policy.follow(observation, band, 10 * felt_n)
    assert decision.action is action
    assert reason in decision.reason
    assert ("measured directly" in decision.reason) is (action is Primitive.INCREASE_FORCE)


def test_nothing_is_measured_where_nothing_is_felt(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, state=NO_CONTACT_STATE)
    decision = policy.follow(Observation(cloud=touch()), Band(low=0.4, high=0.5), 1.0)
    assert decision.action is Primitive.RESET


@pytest.mark.parametrize(
    ("flag", "action"), [(Flag.NOISE, Primitive.INCREASE_FORCE), (Flag.RAISED, None)]
)
def test_no_grip_becomes_firmer_where_the_whole_pad_is_raised(
    flag: Flag, action: Primitive | None, untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, flag, state=HELD.state)
    felt = Interval(value=0.2, low=0.15, high=0.27)
    observation = Observation(cloud=touch(), in_contact=True, felt_force_n=felt)
    assert policy.follow(observation, Band(low=0.4, high=0.5), 1.0).action is action


@pytest.mark.parametrize(
    ("flags", "felt_n", "barred", "action"),
    [
        ((Flag.RANGE,), 0.9, (), Primitive.DECREASE_FORCE),
        ((Flag.RANGE,), 0.9, ("<decrease_force>",), None),
        ((Flag.RANGE,), 0.45, (), None),
        ((Flag.RANGE, Flag.NOISE), 0.9, (), None),
        ((Flag.NOISE,), 0.9, (), None),
    ],
)
def test_a_contact_too_deep_to_be_read_is_loosened_where_its_felt_force_is_above_the_target(
    flags: tuple[Flag, ...],
    felt_n: float,
    barred: tuple[str, ...],
    action: Primitive | None,
    untrained: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, *flags, state=HELD.state)
    felt = Interval(value=felt_n, low=felt_n / 1.3, high=felt_n * 1.3)
    observation = Observation(cloud=touch(), in_contact=True, felt_force_n=felt)
    decision = policy.follow(observation, Band(low=0.4, high=0.5), 1.0, barred)
    assert decision.action is action
    assert not decision.success


def pressed_along(first: int, last: int) -> TactileCloud:
    """A ridge along x, in columns of 0.2 mm of a GelSight Mini from its left edge."""
    y, x = np.mgrid[:76, :102]
    beside = np.maximum(np.maximum(first - x, x - last), 0)
    return cloud_from_heights(
        0.4 * np.exp(-(beside**2 + (y - 38) ** 2) / 60), SENSORS["gelsight_mini"]
    )


def measured(policy: LlmPolicy, cloud: TactileCloud, *barred: str) -> Decision:
    """What is decided on a cloud that is measured directly, and held a little too lightly."""
    felt_n = contact_state(cloud, in_contact=True).force_n
    felt = Interval(value=felt_n, low=felt_n / 1.3, high=felt_n * 1.3)
    observation = Observation(cloud=cloud, in_contact=True, felt_force_n=felt)
    return policy.follow(observation, Band(low=1.1 * felt_n, high=1.4 * felt_n), 9.0, barred)


def test_what_is_measured_moves_neither_to_and_fro_nor_against_what_is_felt(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, state=NO_CONTACT_STATE, contact=0.1)
    cut = pressed_along(30, 101)
    assert measured(policy, cut).action is Primitive.MOVE_RIGHT
    policy._moves[:] = [Primitive.MOVE_RIGHT, Primitive.MOVE_LEFT]
    assert measured(policy, cut).action is Primitive.INCREASE_FORCE
    barred = measured(policy, cut, "<increase_force>")
    assert barred.action is None
    assert not barred.success


def test_what_is_measured_off_centre_is_moved_for_whatever_the_model_has_moved_for(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, state=NO_CONTACT_STATE, contact=0.1)
    policy._moves[:] = [Primitive.MOVE_RIGHT, Primitive.MOVE_LEFT]
    assert measured(policy, pressed_along(90, 90)).action is Primitive.MOVE_RIGHT
    assert policy._moves == [Primitive.MOVE_RIGHT]


def test_a_force_that_no_command_makes_is_none(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, state=NO_CONTACT_STATE, contact=0.1)
    felt_n = contact_state(touch(), in_contact=True).force_n
    observation = Observation(cloud=touch(), in_contact=True, commanded_force_n=felt_n / 4)
    band = Band(low=0.5 * felt_n, high=0.7 * felt_n)
    aim = contract(band.low, band.high, 2 * felt_n)
    actions = [policy.decide(observation, aim).action for _ in range(2)]
    assert actions == [Primitive.RESET, Primitive.INCREASE_FORCE]  # one reset is enough


def test_a_reset_forgets_the_moves_before_it(
    untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    unread(policy, monkeypatch, state=HELD.state)
    policy._moves[:] = [Primitive.MOVE_RIGHT, Primitive.MOVE_LEFT]
    policy.follow(Observation(cloud=touch()), Band(low=0.4, high=0.5), 1.0)
    assert policy._moves == []


@pytest.mark.parametrize(
    ("felt_n", "barred"),
    [
        (0.3, {"<none>", "<decrease_force>"}),
        (1.2, set()),
        (4.0, {"<none>", "<increase_force>"}),
        (None, set()),
    ],
)
def test_what_is_clearly_felt_bars_the_decisions_against_it(
    felt_n: float | None, barred: set[str], untrained: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = LlmPolicy(untrained)
    asked: list[set[str]] = []

    def record(
        _sensor: object, _band: object, excluded: Iterable[str], *, numbers: object
    ) -> Grammar:
        asked.append(set(excluded))
        return step_grammar(None, Band(low=0.95, high=1.9), excluded)

    monkeypatch.setattr(policies.llm.policy, "step_grammar", record)
    monkeypatch.setattr(policies.llm.policy, "denied", lambda *_: ())
    felt = None if felt_n is None else Interval(value=felt_n, low=felt_n / 1.3, high=felt_n * 1.3)
    policy.decide(Observation(cloud=touch(), felt_force_n=felt), contract(0.95, 1.9, 2.4))
    assert asked[0] == barred


def test_a_contact_too_deep_for_the_contract_is_loosened_and_never_moved(untrained: Path) -> None:
    shallow = replace(contract(0.95, 1.9, 2.4), depth_mm=Band(low=0.0, high=0.1))
    felt = Interval(value=1.2, low=1.0, high=1.5)
    decision = LlmPolicy(untrained).decide(Observation(cloud=touch(), felt_force_n=felt), shallow)

    assert decision.action is Primitive.DECREASE_FORCE
    assert not decision.success
    assert "the contract has 0.10 mm" in decision.reason


@pytest.mark.parametrize(
    ("force_n", "expected"),
    [
        (0.41, {"<decrease_force>", "<none>"}),
        (0.42, {"<increase_force>", "<decrease_force>"}),
        (0.51, {"<increase_force>", "<decrease_force>"}),
        (0.52, {"<increase_force>", "<none>"}),
    ],
)
def test_what_goes_against_the_force_as_it_is_read_is_denied(
    force_n: float, expected: set[str]
) -> None:
    read = TouchReading(
        state=replace(HELD.state, force_n=force_n), numbers={}, confidence={}, contact=1.0, flags=()
    )
    band = Band(low=0.42, high=0.51)
    assert set(denied(read, band)) == expected
    assert denied(replace(read, state=NO_CONTACT_STATE), band) == ()


def test_the_felt_force_takes_the_place_of_a_reading_that_it_agrees_with() -> None:
    ends = [torch.tensor([[0.2, 0.0, 0.0, 0.1, force]]) for force in (0.8, 0.6, 1.1)]
    words = tuple(torch.ones(1, 2) for _ in range(5))
    read = HeadReadings(words, torch.ones(1), torch.zeros(1, 4), *ends)
    told = with_felt_force(read, Interval(value=1.0, low=0.7, high=1.4))
    forces = [float(end[0, 4]) for end in (told.values, told.low, told.high)]
    assert forces == pytest.approx([1.0, 0.75, 1.375])
    assert torch.equal(told.values[:, :4], read.values[:, :4])
    assert with_felt_force(read, None) is read
    assert with_felt_force(read, Interval(value=3.0, low=2.0, high=4.0)) is read  # they contradict
