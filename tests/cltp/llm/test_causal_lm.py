import math
from pathlib import Path

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from transformers import GPT2Config, GPT2LMHeadModel, Qwen2Config, Qwen2ForCausalLM

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.llm.causal_lm import Language, load_language, small_lm
from cltp.llm.fast_decode import FastDecoder, greedy
from cltp.llm.generation import Talker, _action_probabilities, _own, _Run
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.sensors import SENSORS
from cltp.texts.exchange_packing import NOT_LEARNED, Exchange, pack
from cltp.texts.tokenizer import ACTIONS, Words
from policies.llm.grammar import step_grammar
from policies.llm.parse import parse_reply
from primitives.contract import Band
from tests.fakes.stock_lm import save_stock_lm, save_tokenizer

TEXTS = [
    "Pick the strawberry gently, without bruising it.",
    "a smooth sphere object, pressed deep in top-left with small contact area.",
    "0.42 mm deep, 1.35 N. Action: <move_up> It is off centre.",
    "Grip the peg firmly. Action: <none> The grasp is stable.",
] * 3


@pytest.fixture(scope="module")
def words() -> Words:
    return Words.train(TEXTS, size=400)


def perturbed(lm: torch.nn.Module) -> torch.nn.Module:
    """Biases and norms that differ from their start, so that forgetting one would show."""
    generator = torch.Generator().manual_seed(1)
    with torch.no_grad():
        for parameter in lm.parameters():
            parameter.add_(0.1 * torch.randn(parameter.shape, generator=generator))
    return lm.eval()


def tiny_model(words: Words) -> Tac3dLlm:
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny"])
    language = Language(perturbed(small_lm(words, dim=48, layers=2)), words=words)
    return Tac3dLlm(encoder, StateHeads(2 * encoder.config.dim), Projector(48, 48), language)


@given(st.text(max_size=60))
def test_any_text_is_encoded_and_decoded_again(words: Words, text: str) -> None:
    assert words.decode(words.encode(text)) == text


def test_each_action_is_one_token_and_each_digit_too(words: Words) -> None:
    for action, number in zip(ACTIONS, words.actions, strict=True):
        assert words.encode(action) == [number]
    assert [len(words.encode(f" {n}")) for n in ("0.42", "-1.97", "+7.3", "8")] == [3, 3, 2, 1]


def test_a_person_cannot_write_control_tokens_or_actions(words: Words) -> None:
    ids = words.encode("<eos> <move_up> <reply>", trusted=False)
    assert not {words.eos, words.reply, *words.actions} & set(ids)


def test_a_tokenizer_of_another_version_is_refused(words: Words, tmp_path: Path) -> None:
    words.save(tmp_path)
    path = tmp_path / "tokenizer.json"
    path.write_text(path.read_text().replace("<move_up>", "<move_upward>"))
    with pytest.raises(TouchError, match="lacks <move_up>"):
        Words.load(tmp_path)
    path.write_text("{")
    with pytest.raises(TouchError, match="no tokenizer"):
        Words.load(tmp_path)


@pytest.mark.parametrize("kv_heads", [1, 2, 4])
def test_fast_decoding_says_what_transformers_generates(kv_heads: int) -> None:
    torch.manual_seed(0)
    config = Qwen2Config(
        vocab_size=200,
        hidden_size=64,
        intermediate_size=100,
        num_hidden_layers=3,
        num_attention_heads=4,
        num_key_value_heads=kv_heads,
        tie_word_embeddings=True,
    )
    lm = perturbed(Qwen2ForCausalLM(config))
    inputs = torch.randn(70, 64)
    decoder = FastDecoder(lm)
    with torch.no_grad():
        whole = lm(inputs_embeds=inputs[None]).logits[0, -1]
        torch.testing.assert_close(decoder.prefill(inputs), whole, atol=1e-4, rtol=1e-4)
        expected = lm.generate(
            inputs_embeds=inputs[None],
            attention_mask=torch.ones(1, 70, dtype=torch.long),
            max_new_tokens=20,
            do_sample=False,
            eos_token_id=None,
            pad_token_id=0,
        )
    assert greedy(decoder, inputs, stop=-1, max_tokens=20) == expected[0].tolist()


def test_greedy_stops_at_its_bounds() -> None:
    torch.manual_seed(0)
    lm = Qwen2ForCausalLM(
        Qwen2Config(vocab_size=50, hidden_size=32, intermediate_size=32, num_hidden_layers=1,
                    num_attention_heads=2, num_key_value_heads=2)
    )  # fmt: skip
    inputs = torch.randn(10, 32)
    assert len(greedy(FastDecoder(lm), inputs, stop=-1, max_tokens=7)) == 7
    assert len(greedy(FastDecoder(lm, longest=14), inputs, stop=-1, max_tokens=7)) == 4


def test_packed_segments_are_computed_as_if_each_were_alone(words: Words) -> None:
    model = tiny_model(words)
    exchanges = [
        Exchange(prompt="Pick the strawberry.", reply="Action: <move_up> It is off centre."),
        Exchange(prompt="Grip the peg firmly, please.", reply="Action: <none> Stable."),
    ]
    touch = torch.randn(1, 5, 48)
    together = pack(words, [exchanges], 5)
    with torch.no_grad():
        joint = model.loss(touch, together)["language"] * together.weights.sum()
        alone = torch.tensor(0.0)
        for exchange in exchanges:
            single = pack(words, [[exchange]], 5)
            alone += model.loss(touch, single)["language"] * single.weights.sum()
    assert joint.item() == pytest.approx(alone.item(), rel=1e-4)


def test_only_replies_are_learned_and_actions_weigh_more(words: Words) -> None:
    exchange = Exchange(prompt="Pick the strawberry.", reply="Action: <move_up> Off.")
    packed = pack(words, [[exchange]], 3, action_weight=5.0)
    learned = packed.labels[0][packed.labels[0] != NOT_LEARNED].tolist()
    assert learned == [*words.encode(exchange.reply), words.eos]
    assert packed.weights[packed.labels == words.actions[0]].tolist() == [5.0]
    assert packed.weights.sum() == len(learned) + 4.0


def test_ten_thousand_words_are_cut_to_what_the_model_can_take(words: Words) -> None:
    model = tiny_model(words)
    points = torch.rand(1024, 3).numpy()
    for prompt in ("", "strawberry " * 10_000):
        reply = Talker(model).reply(points, prompt, max_tokens=5)
        assert reply.num_tokens <= 5


class ScriptedDecoder:
    """Says ``<increase_force>`` with known probabilities, then ends."""

    longest = 100

    def __init__(self, words: Words) -> None:
        self.words = words

    def prefill(self, inputs: torch.Tensor) -> torch.Tensor:
        logits = torch.full((len(self.words),), -20.0)
        logits[self.words.actions] = 0.0
        logits[self.words.actions[4]] = float(torch.tensor(7.0).log())
        return logits

    def step(self, token: int) -> torch.Tensor:
        return torch.nn.functional.one_hot(torch.tensor(self.words.eos), len(self.words)).float()


def test_the_choice_is_a_softmax_over_the_eight_at_the_place_of_the_action(words: Words) -> None:
    language = tiny_model(words).language
    ids, ended, probabilities, *_ = _own(
        ScriptedDecoder(words), language, torch.zeros(3, 48), 10, lambda: None, {}
    )
    assert words.decode(ids).strip() == "<increase_force>"
    assert ended
    assert probabilities == pytest.approx([1 / 14] * 4 + [0.5] + [1 / 14] * 3)


def test_a_barred_action_is_neither_said_nor_given_a_chance(words: Words) -> None:
    language = tiny_model(words).language
    decoder, inputs = ScriptedDecoder(words), torch.zeros(3, 48)
    barred = {"<increase_force>": math.inf}
    ids, _, probabilities, *_ = _own(decoder, language, inputs, 10, lambda: None, barred)
    assert words.decode(ids).strip() != "<increase_force>"
    assert probabilities == pytest.approx([1 / 7] * 4 + [0.0] + [1 / 7] * 3)


def test_what_speaks_against_an_action_takes_from_its_chance(words: Words) -> None:
    language = tiny_model(words).language
    decoder, inputs = ScriptedDecoder(words), torch.zeros(3, 48)
    penalties = {"<increase_force>": math.log(3.5)}
    ids, _, probabilities, *_ = _own(decoder, language, inputs, 10, lambda: None, penalties)
    assert words.decode(ids).strip() == "<increase_force>"  # still the likeliest, by 2 to 1
    assert probabilities == pytest.approx([1 / 9] * 4 + [2 / 9] + [1 / 9] * 3)


def test_a_reply_reports_its_stages_and_whether_it_ended(words: Words) -> None:
    reply = Talker(tiny_model(words)).reply(torch.rand(1024, 3).numpy(), "Pick it.", max_tokens=4)
    assert set(reply.stage_ms) == {"encode", "project", "prefill", "generate"}
    assert reply.ended == (reply.num_tokens < 4)


@pytest.mark.parametrize("kind", ["qwen2", "qwen2_5_vl"])
def test_a_stock_checkpoint_goes_through_the_same_class(kind: str, tmp_path: Path) -> None:
    language = load_language(save_stock_lm(tmp_path, kind))
    assert language.words is None
    assert len({tuple(a) for a in language.actions()}) == 8
    model = Tac3dLlm(
        TactileEncoder(PRESETS["tiny"]), StateHeads(96), Projector(48, language.dim), language
    )
    reply = Talker(model).reply(torch.rand(1024, 3).numpy(), "Pick it.", max_tokens=6)
    assert reply.num_tokens <= 6


def test_a_stock_checkpoint_chooses_among_the_eight_after_the_cue(tmp_path: Path) -> None:
    language = load_language(save_stock_lm(tmp_path, "qwen2"))
    names = language.actions()
    assert any(len(name) > 1 for name in names)
    with torch.no_grad():
        run = _Run(language)
        inputs = torch.randn(6, language.dim)
        logits = run.begin(inputs)[0]
        probabilities = _action_probabilities(run, logits, names)
        assert sum(probabilities) == pytest.approx(1.0, abs=1e-5)
        fresh = _Run(language)  # the trie leaves the model where it was
        torch.testing.assert_close(fresh.begin(inputs)[0], logits)
        assert run.length == fresh.length


@pytest.mark.parametrize("kind", ["qwen2", "qwen2_5_vl"])
def test_a_stock_checkpoint_keeps_the_same_grammar(kind: str, tmp_path: Path) -> None:
    language = load_language(save_stock_lm(tmp_path, kind))
    model = Tac3dLlm(
        TactileEncoder(PRESETS["tiny"]), StateHeads(96), Projector(48, language.dim), language
    )
    grammar = step_grammar(SENSORS["gelsight_mini"], Band(low=0.4, high=0.8))
    reply = Talker(model).reply(torch.rand(1024, 3).numpy(), "Pick it.", grammar=grammar)
    advice = parse_reply(reply.text).advice
    assert reply.ended
    assert reply.action == f"<{advice.action or 'none'}>"
    assert sum(reply.probabilities) == pytest.approx(1.0)


def test_other_architectures_and_missing_weights_are_refused(tmp_path: Path) -> None:
    gpt2 = tmp_path / "gpt2"
    GPT2LMHeadModel(GPT2Config(vocab_size=50, n_embd=16, n_layer=1, n_head=1)).save_pretrained(gpt2)
    save_tokenizer(gpt2)
    with pytest.raises(TouchError, match="gpt2"):
        load_language(gpt2)
    folder = save_stock_lm(tmp_path / "cut", "qwen2")
    weights = folder / "model.safetensors"
    weights.write_bytes(weights.read_bytes()[:1000])
    with pytest.raises(TouchError, match="no language model"):
        load_language(folder)
    with pytest.raises(TouchError, match="no language model"):
        load_language(tmp_path / "nowhere")
