import math
import random

import pytest
import torch

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.llm.causal_lm import Language
from cltp.llm.generation import Talker
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.sensors import SENSORS
from cltp.texts.tokenizer import ACTIONS, Words
from policies.llm.grammar import caption_grammar, step_grammar
from policies.llm.parse import parse_caption_reply, parse_reply
from primitives.contract import Band
from tests.fakes.language import random_lm, random_text

MINI = SENSORS["gelsight_mini"]
GRAMMAR = step_grammar(MINI, Band(low=0.4, high=0.8))
POINTS = torch.rand(1024, 3, generator=torch.Generator().manual_seed(0)).numpy()


@pytest.fixture(scope="module")
def talker() -> Talker:
    rng = random.Random(0)
    words = Words.train([random_text(GRAMMAR, rng) for _ in range(60)], size=500)
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny"])
    language = Language(random_lm(len(words), 3), words=words)
    heads = StateHeads(2 * encoder.config.dim)
    return Talker(Tac3dLlm(encoder, heads, Projector(48, 48), language))


def test_a_reply_under_a_grammar_is_whole_and_says_how_it_was_decided(talker: Talker) -> None:
    for prompt in ("Hold it.", "What next?", "Goal 0.40 - 0.80 N, limit 1.00 N. What next?"):
        reply = talker.reply(POINTS, prompt, grammar=GRAMMAR)
        assert reply.ended
        parsed = parse_reply(reply.text, MINI)
        assert reply.action == f"<{parsed.advice.action or 'none'}>"
        assert reply.action == reply.slots["action"].chosen
        assert sum(reply.probabilities) == pytest.approx(1.0)
        assert reply.confidence == reply.slots["action"].probability
        assert 1 < reply.passes <= reply.num_tokens
        assert set(reply.stage_ms) == {"encode", "project", "prefill", "generate"}
        drafted = talker.reply(POINTS, prompt, grammar=GRAMMAR, draft=reply.text)
        assert (drafted.text, drafted.slots.keys()) == (reply.text, reply.slots.keys())
        assert drafted.passes == 1 or drafted.close_calls


def test_penalties_and_doubt_are_obeyed(talker: Talker) -> None:
    plain = talker.reply(POINTS, "Hold it.", grammar=GRAMMAR, doubt_below={})
    penalties = {plain.action: math.inf}
    if plain.slots["texture"].chosen == "nothing":
        pytest.skip("the model of this seed feels nothing")
    other = talker.reply(POINTS, "Hold it.", grammar=GRAMMAR, penalties=penalties)
    assert other.action != plain.action
    assert other.probabilities[ACTIONS.index(plain.action)] == 0.0
    never = dict.fromkeys(("texture", "shape", "depth", "position", "area"), 0.0)
    sure = talker.reply(POINTS, "Hold it.", grammar=GRAMMAR, doubt_below=never)
    assert not parse_reply(sure.text).rivals
    always = dict.fromkeys(never, 1.1)
    unsure = talker.reply(POINTS, "Hold it.", grammar=GRAMMAR, doubt_below=always)
    assert set(parse_reply(unsure.text).rivals) == set(always)


def test_a_caption_is_said_under_its_grammar(talker: Talker) -> None:
    reply = talker.reply(POINTS, "Describe it.", grammar=caption_grammar(MINI))
    assert parse_caption_reply(reply.text, MINI).goal is None
    assert reply.action is None
    assert reply.probabilities == ()
