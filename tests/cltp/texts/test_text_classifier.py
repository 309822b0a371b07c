"""The classifier of texts: what it sees of words, and its file."""

import json

import pytest
import torch

from cltp.checkpoints.manifest import WeightsError, write_manifest
from cltp.checkpoints.stored_classifier import load_classifier, save_classifier
from cltp.texts.text_classifier import ClassifierConfig, TextClassifier

CONFIG = ClassifierConfig(classes=("deep", "firm", "round"), rows=512, dim=16, heads=2, longest=6)


@pytest.fixture
def model():
    torch.manual_seed(0)
    return TextClassifier(CONFIG).eval()


def test_a_text_has_the_same_probabilities_alone_and_beside_a_longer_one(model):
    texts = [["is", "it", "deep"], ["how", "firm", "is", "the", "grip", "now"]]
    with torch.inference_mode():
        together = torch.log_softmax(model(model.batch(texts)), dim=-1)
    for text, logs in zip(texts, together, strict=True):
        alone = model.log_probabilities(text)
        assert torch.allclose(alone, logs, atol=1e-5)
        assert float(alone.exp().sum()) == pytest.approx(1.0)


def test_a_misspelled_word_lies_nearer_to_its_own_than_another_one(model):
    def word(text):
        batch = model.batch([[text]])
        return model.table(batch.runs, batch.begins)[0]

    meant, slip, other = map(word, ("indentation", "indentaton", "strawberries"))
    assert torch.dist(meant, slip) < 0.7 * torch.dist(meant, other)


def test_order_counts_and_what_is_hidden_does_not(model):
    assert not torch.allclose(
        model.log_probabilities(["not", "deep"]), model.log_probabilities(["deep", "not"])
    )
    hidden = torch.tensor([False, True])
    with torch.inference_mode():
        firm, deep = (model(model.batch([["is", word]], hidden)) for word in ("firm", "deep"))
    assert torch.equal(firm, deep)


def test_nothing_and_more_than_counts_are_texts_too(model):
    assert torch.isfinite(model.log_probabilities([])).all()
    assert torch.isfinite(model.log_probabilities(["x" * 100_000])).all()
    longest = ["word"] * CONFIG.longest
    assert torch.equal(
        model.log_probabilities([*longest, "deep"]), model.log_probabilities(longest)
    )


def test_a_stored_one_says_nearly_the_same(model, tmp_path):
    save_classifier(tmp_path / "queries", model)
    stored = load_classifier(tmp_path / "queries")
    assert stored.config == CONFIG
    text = ["how", "deep", "is", "it"]
    assert torch.allclose(stored.log_probabilities(text), model.log_probabilities(text), atol=0.02)


@pytest.mark.parametrize(
    "change",
    [{"rows": 0}, {"dim": "16"}, {"heads": 3}, {"classes": []}, {"layers": 10**9}, {"dim": 32}],
)
def test_another_configuration_is_refused(model, tmp_path, change):
    save_classifier(tmp_path, model)
    path = tmp_path / "config.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | change))
    write_manifest(tmp_path)
    with pytest.raises(WeightsError):
        load_classifier(tmp_path)


def test_a_missing_or_changed_file_is_refused(model, tmp_path):
    with pytest.raises(WeightsError):
        load_classifier(tmp_path)
    save_classifier(tmp_path, model)
    weights = tmp_path / "model.safetensors"
    weights.write_bytes(weights.read_bytes()[:-8] + bytes(8))
    with pytest.raises(WeightsError):
        load_classifier(tmp_path)


def test_a_missing_classifier_names_the_command_that_makes_it(tmp_path):
    with pytest.raises(WeightsError, match=f"`tacgrasp train queries --out {tmp_path}`"):
        load_classifier(tmp_path)
