"""Ablations change the part that they name and no other; their figures tell right from wrong."""

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import torch

from cltp.llm.constrained.grammar import Grammar
from cltp.llm.generation import Reply, Talker
from cltp.llm.reading_tokens import NUM_READINGS
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.states import CLASSES
from policies.llm.grammar import step_grammar
from policies.llm.policy import LlmPolicy
from policies.llm.text import REQUEST, advice_text, contact_text, goal_text
from primitives.contract import Band
from tacgrasp.__main__ import main
from tacgrasp.training.ablation.ablated_talker import (
    ABLATIONS,
    AblatedTalker,
    Ablation,
    Change,
    Donor,
    InputPart,
)
from tacgrasp.training.ablation.evaluate import BLIND_COPY
from tacgrasp.training.ablation.single_replies import (
    AskedStep,
    draw_steps,
    score_misreadings,
    score_replies,
)
from tacgrasp.training.ablation.touch_parts import Misreading, mean_tokens, touch_parts
from tacgrasp.training.question_evaluation import FeltContact
from tests.fakes.question_scenes import HELD, random_states
from tests.fakes.tiny_weights import make_data

pytestmark = pytest.mark.usefixtures("one_thread")

BAND = Band(low=0.4, high=0.6)


@pytest.fixture(scope="module")
def talker(weights: Path) -> Talker:
    return LlmPolicy(weights).talker


@pytest.fixture(scope="module")
def steps() -> list[AskedStep]:
    rng = np.random.default_rng(0)
    contacts = [
        FeltContact(
            points=rng.uniform(-1, 1, (1024, 3)).astype(np.float32),
            scene=replace(HELD, state=state),
        )
        for state in random_states(10)
    ]
    return draw_steps(contacts, 0)


@pytest.fixture(scope="module")
def donors(talker: Talker, steps: list[AskedStep]) -> list[Donor]:
    return [
        Donor(
            points=each.points,
            parts=touch_parts(talker.model, talker.feel(each.points)),
            prompt=each.prompt,
        )
        for each in steps
    ]


class Recording:
    """A talker that remembers what it is asked to reply to."""

    def __init__(self, talker: Talker) -> None:
        self.model, self.layout, self.feel = talker.model, talker.layout, talker.feel
        self.asked: list[tuple[torch.Tensor, str, Grammar | None]] = []

    def reply_to(
        self, touch: torch.Tensor, prompt: str, *, grammar: Grammar | None = None
    ) -> Reply:
        self.asked.append((touch, prompt, grammar))
        return reply_of("")


def asked(ablated: AblatedTalker, own: Donor) -> None:
    ablated.reply_to(ablated.feel(own.points).touch, own.prompt, grammar=step_grammar(None, BAND))


def reply_of(text: str) -> Reply:
    token = text[text.index("<") : text.index(">") + 1] if "<" in text else None
    return Reply(text=text, ended=True, num_tokens=9, action=token, probabilities=(), stage_ms={})


def right_text(step: AskedStep) -> str:
    advice = step.scene.advice
    assert advice is not None
    assert step.scene.contract is not None
    goal = goal_text(step.scene.contract.terms.force_n)
    return f"{contact_text(step.scene.state)} {goal} {advice_text(advice)}"


def test_both_parts_are_what_the_model_makes_of_a_contact(
    talker: Talker, steps: list[AskedStep]
) -> None:
    felt = talker.feel(steps[0].points, ForceScale(factor=1.3, spread=0.1, source="unit"))
    parts = touch_parts(talker.model, felt)
    assert torch.equal(parts.whole, felt.touch)
    assert len(parts.readings) == NUM_READINGS
    assert len(parts.tokens) == talker.model.num_touch - NUM_READINGS


def test_embeddings_reply_as_their_points_do(talker: Talker, steps: list[AskedStep]) -> None:
    ours = talker.reply(steps[0].points, REQUEST, max_tokens=12)
    parts = touch_parts(talker.model, talker.feel(steps[0].points))
    same = talker.reply_to(parts.whole, REQUEST, max_tokens=12)
    assert (ours.text, ours.action) == (same.text, same.action)
    assert list(ours.stage_ms) == ["encode", "project", "prefill", "generate"]


@pytest.mark.parametrize("name", [None, *ABLATIONS])
def test_an_ablation_changes_its_part_alone(
    name: str | None, talker: Talker, steps: list[AskedStep], donors: list[Donor]
) -> None:
    recording, own = Recording(talker), donors[3]
    ablation = ABLATIONS[name] if name is not None else None
    ablated = AblatedTalker(recording, ablation, donors)  # type: ignore[arg-type]
    asked(ablated, own)
    ((touch, prompt, grammar),) = recording.asked
    num = len(own.parts.tokens)
    part = ablation.part if ablation is not None else None
    assert torch.equal(touch[:num], own.parts.tokens) is (part is not InputPart.TOKENS)
    assert torch.equal(touch[num:], own.parts.readings) is (part is not InputPart.READINGS)
    assert (prompt == own.prompt) is (part is not InputPart.GOAL)
    assert (grammar is None) is (part is InputPart.GOAL)  # it would tell the goal


def test_what_is_left_out_tells_nothing_and_what_is_swapped_is_never_the_own(
    talker: Talker, donors: list[Donor]
) -> None:
    recording = Recording(talker)

    def ablated(part: InputPart, change: Change, among: list[Donor]) -> AblatedTalker:
        return AblatedTalker(recording, Ablation(part, change), among)  # type: ignore[arg-type]

    without = ablated(InputPart.READINGS, Change.LEFT_OUT, donors)
    for own in donors[:2]:
        asked(without, own)
    one, other = (touch[-NUM_READINGS:] for touch, _, _ in recording.asked)
    assert torch.equal(one, other)
    asked(ablated(InputPart.TOKENS, Change.LEFT_OUT, donors), donors[0])
    mean = mean_tokens([each.parts for each in donors])
    assert torch.equal(recording.asked[-1][0][:-NUM_READINGS], mean)
    recording.asked.clear()
    swapped = ablated(InputPart.GOAL, Change.SWAPPED, [donors[0], donors[1]])
    for _ in range(8):
        asked(swapped, donors[0])
    assert {prompt for _, prompt, _ in recording.asked} == {donors[1].prompt}
    with pytest.raises(ValueError, match="two contacts at least"):
        AblatedTalker(talker, None, donors[:1])


def test_a_misreading_changes_the_readings_and_no_token(
    talker: Talker, steps: list[AskedStep]
) -> None:
    felt = talker.feel(steps[0].points)
    chances = torch.zeros(len(CLASSES["shape"])).index_fill(0, torch.tensor([7]), 1.0)
    before = touch_parts(talker.model, felt)
    after = touch_parts(talker.model, felt, Misreading(dimension="shape", chances=chances))
    assert torch.equal(before.tokens, after.tokens)
    assert not torch.allclose(before.readings[0], after.readings[0])
    own = felt.readings.words[list(CLASSES).index("shape")][0]
    unchanged = touch_parts(talker.model, felt, Misreading(dimension="shape", chances=own))
    assert torch.allclose(before.readings, unchanged.readings, atol=1e-6)


def test_true_replies_are_right_and_those_of_other_contacts_are_not(steps: list[AskedStep]) -> None:
    texts = [right_text(step) for step in steps]
    right = score_replies(steps, [reply_of(text) for text in texts])
    assert set(right["words"].values()) == set(right["named"].values()) == {1.0}
    assert (right["actions"], right["doubtful"], right["read"]) == (1.0, 0.0, 1.0)
    wrong = score_replies(steps, [reply_of(text) for text in (*texts[1:], texts[0])])
    assert max(wrong["words"].values()) < 0.7
    assert wrong["actions"] < 1
    nothing = score_replies(steps, [reply_of("the gel is a gel")] * len(steps))
    assert set(nothing["words"].values()) == {0.0}
    assert (nothing["actions"], nothing["read"]) == (0.0, 0.0)


def test_a_rival_is_named_but_not_right(steps: list[AskedStep]) -> None:
    replies = []
    for step in steps:
        state = step.scene.state
        first = next(name for name in CLASSES["shape"] if name != str(state.shape))
        text = right_text(step).replace(f" {state.shape},", f" {first} or {state.shape},", 1)
        replies.append(reply_of(text))
    figures = score_replies(steps, replies)
    assert (figures["words"]["shape"], figures["named"]["shape"]) == (0.0, 1.0)
    assert figures["doubtful"] == 1.0


def test_misreadings_count_what_is_still_said_rightly(
    talker: Talker, steps: list[AskedStep]
) -> None:
    by_prompt = {step.prompt: right_text(step) for step in steps}
    deaf = SimpleNamespace(
        model=talker.model,
        feel=talker.feel,
        reply_to=lambda touch, prompt, grammar: reply_of(by_prompt[prompt]),
    )
    figures = score_misreadings(deaf, steps)  # type: ignore[arg-type]
    assert 1 <= figures["contacts"] <= 2  # a fifth of ten
    assert (figures["right_before"], figures["right"], figures["follows"]) == (1.0, 1.0, 0.0)
    assert score_misreadings(deaf, steps[:1])["right"] is None  # type: ignore[arg-type]


def test_eval_ablate_prints_and_writes_every_condition(
    weights: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    data, path = make_data(tmp_path / "data", num=8), tmp_path / "ablate.json"
    argv = ["eval", "ablate", "--weights", str(weights), "--blind", str(weights)]
    argv += ["--data", str(data), "--contacts", "3", "--episodes", "1", "--json", str(path)]
    assert main(argv) == 0
    printed = capsys.readouterr().out
    results = json.loads(path.read_text())
    assert list(results["replies"]) == ["whole", *ABLATIONS, BLIND_COPY]
    assert list(results["episodes"]) == ["whole", *ABLATIONS]
    for name in results["replies"]:
        assert name in printed
    assert results["replies"]["whole"]["read"] == 1.0  # the grammar allows nothing else
    assert results["replies"][BLIND_COPY]["read"] == 0.0  # it was never trained
    assert sum(results["episodes"]["whole"]["ends"].values()) == 1


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--contacts", "1"], "--contacts must be at least 2"),
        (["--episodes", "-1"], "--episodes at least 0"),
        (["--data", "nowhere"], "--data nowhere does not exist"),
        (["--json", "no/where.json"], "can't be written"),
    ],
)
def test_wrong_use_is_told_in_one_line(
    argv: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["eval", "ablate", *argv]) == 2
    printed = capsys.readouterr().err
    assert expected in printed
    assert printed.count("\n") == 1
