import re
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.tac3d_llm import save_encoder, save_tac3d_llm
from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.generation import Reply
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.cloud import TactileCloud, cloud_from_heights
from cltp.tactile.sensors import SENSORS
from cltp.texts.tokenizer import ACTIONS, Words
from policies import Observation
from policies.errors import PolicyError
from policies.extraction import extract
from policies.llm import (
    LlmPolicy,
    as_request,
    check_instruction,
    hold_reason,
    repeated_moves,
)
from primitives import Primitive

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
    decision = policy.decide(Observation(cloud=touch()), "Pick the strawberry gently.")
    assert decision.action is None
    assert not decision.success
    assert decision.reason
    assert set(decision.stage_ms) == {
        "sample",
        "encode",
        "project",
        "prefill",
        "generate",
        "extract",
    }
    assert (
        policy.decide(Observation(cloud=touch()), "Pick the strawberry gently.").text
        == decision.text
    )


@pytest.mark.parametrize(
    ("instruction", "message"),
    [
        ("", "in words"),
        ("  123 !!", "in words"),
        ("strawberry " * 10_000, "shorten"),
        ("Hebe die Erdbeere vorsichtig hoch, ohne sie zu zerdrücken.", "plain English"),
        ("Soulève la fraise délicatement sans l'écraser.", "plain English"),
        ("请轻轻地拿起草莓", "plain English"),
    ],
)
def test_an_instruction_that_it_cannot_know_is_refused(
    words: Words, instruction: str, message: str
) -> None:
    with pytest.raises(PolicyError, match=message):
        check_instruction(instruction, words)


def test_known_words_are_let_through(words: Words) -> None:
    check_instruction("Hold the strawberry securely.", words)
    check_instruction("Hebe die Erdbeere vorsichtig.", None)  # a stock model may know it


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


def test_an_instruction_worded_as_a_question_is_no_question() -> None:
    assert as_request("Could you pick up the egg?") == "Could you pick up the egg."
    assert as_request("Pick it up gently.") == "Pick it up gently."
