import json
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file, save_file

from cltp.errors import TouchError
from cltp.llm.causal_lm import load_language, small_lm
from cltp.llm.fast_decode import FastDecoder
from cltp.llm.stored_lm import load_stored_lm, write_seed_oss_config
from cltp.texts.tokenizer import Words


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    torch.manual_seed(0)
    words = Words.train(["a few words of a kind"] * 5, size=300)
    lm = small_lm(words, dim=48, layers=2)
    with torch.no_grad():
        for parameter in lm.parameters():  # biases and norms too, which begin at 0 and 1
            parameter.add_(0.1 * torch.randn_like(parameter))
    lm.half().save_pretrained(tmp_path)
    words.save(tmp_path)
    return tmp_path


def test_it_decodes_as_what_transformers_reads_from_the_same_files(folder: Path) -> None:
    inputs = torch.randn(80, 48)
    ours, theirs = FastDecoder(load_stored_lm(folder)), load_language(folder).lm
    with torch.no_grad():
        whole = theirs(inputs_embeds=inputs[None]).logits[0, -1]
    torch.testing.assert_close(ours.prefill(inputs), whole, atol=1e-4, rtol=1e-4)
    same = FastDecoder(theirs)
    torch.testing.assert_close(ours.prefill(inputs), same.prefill(inputs), atol=1e-6, rtol=1e-6)
    torch.testing.assert_close(ours.step(7), same.step(7), atol=1e-6, rtol=1e-6)


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("model.norm.weight", None, "weights don't fit: model.norm.weight"),
        ("model.norm.bias", torch.zeros(48), "weights don't fit: model.norm.bias"),
        ("model.norm.weight", torch.ones(47), "weights don't fit: model.norm.weight"),
        ("model.norm.weight", torch.full((48,), float("nan")), "model.norm.weight is not finite"),
    ],
)
def test_weights_that_do_not_fit_are_refused(
    folder: Path, name: str, change: torch.Tensor | None, message: str
) -> None:
    state = load_file(folder / "model.safetensors")
    state.pop(name, None)
    save_file(state if change is None else {**state, name: change}, folder / "model.safetensors")
    with pytest.raises(TouchError, match=message):
        load_stored_lm(folder)


@pytest.mark.parametrize(
    "change",
    [{"model_type": "gpt2"}, {"hidden_act": "gelu"}, {"tie_word_embeddings": False},
     {"rope_parameters": {"rope_type": "yarn", "rope_theta": 1e4}}],
)  # fmt: skip
def test_another_architecture_is_refused(folder: Path, change: dict[str, object]) -> None:
    path = folder / "config.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), **change}))
    with pytest.raises(TouchError, match="no language model of ours"):
        load_stored_lm(folder)


@pytest.mark.parametrize(
    "change",
    [{"attention_bias": False}, {"attention_out_bias": True}, {"mlp_bias": True}, {"head_dim": 16}],
)
def test_another_seed_oss_is_refused(folder: Path, change: dict[str, object]) -> None:
    write_seed_oss_config(folder)
    load_stored_lm(folder)
    path = folder / "config.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), **change}))
    with pytest.raises(TouchError, match="describes no language model"):
        load_stored_lm(folder)


def test_both_names_of_the_model_decode_the_same(folder: Path) -> None:
    inputs = torch.randn(30, 48)
    qwen2, before = load_language(folder).lm, FastDecoder(load_stored_lm(folder)).prefill(inputs)
    write_seed_oss_config(folder)
    seed_oss, after = load_language(folder).lm, FastDecoder(load_stored_lm(folder)).prefill(inputs)
    assert (type(qwen2).__name__, type(seed_oss).__name__) == (
        "Qwen2ForCausalLM", "SeedOssForCausalLM"
    )  # fmt: skip
    torch.testing.assert_close(after, before, atol=0, rtol=0)
    with torch.no_grad():
        one, two = (lm(inputs_embeds=inputs[None]).logits for lm in (qwen2, seed_oss))
    torch.testing.assert_close(two, one, atol=0, rtol=0)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"model_type": "qwen2"}'])
def test_a_config_that_says_too_little_is_refused(folder: Path, text: str) -> None:
    (folder / "config.json").write_text(text)
    with pytest.raises(TouchError, match="describes no language model"):
        load_stored_lm(folder)


def test_truncated_weights_are_refused(folder: Path) -> None:
    path = folder / "model.safetensors"
    path.write_bytes(path.read_bytes()[:900])
    with pytest.raises(TouchError, match="no language model could be read"):
        load_stored_lm(folder)
