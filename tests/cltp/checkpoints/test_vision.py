"""Image encoders of others: a tiny random CLIP and its vision tower, read strictly or refused."""

import json
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file, save_file
from transformers import (
    CLIPConfig,
    CLIPModel,
    CLIPVisionConfig,
    CLIPVisionModelWithProjection,
)

from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.vision import load_vision_checkpoint

TOWER = {
    "hidden_size": 16,
    "intermediate_size": 32,
    "num_hidden_layers": 2,
    "num_attention_heads": 2,
    "image_size": 48,
    "patch_size": 16,
    "projection_dim": 12,
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    torch.manual_seed(0)
    CLIPVisionModelWithProjection(CLIPVisionConfig(**TOWER)).save_pretrained(tmp_path / "vision")
    return tmp_path / "vision"


def test_features_are_those_of_the_model_itself(folder: Path) -> None:
    preprocessing = {"image_mean": [0.1, 0.2, 0.3], "image_std": [0.5, 0.25, 1.0]}
    (folder / "preprocessor_config.json").write_text(json.dumps(preprocessing))
    encoder = load_vision_checkpoint(folder)
    assert encoder.sees_images
    frames = torch.rand(2, 3, 48, 48)
    pooled, feature = encoder.read(frames)
    mean, std = (torch.tensor(v).view(3, 1, 1) for v in preprocessing.values())
    with torch.no_grad():
        expected = CLIPVisionModelWithProjection.from_pretrained(folder)((frames - mean) / std)
    torch.testing.assert_close(feature, expected.image_embeds)
    torch.testing.assert_close(pooled[:, :16], expected.last_hidden_state[:, 0])
    assert encoder.read(torch.rand(2, 3, 64, 64))[0].shape == (2, 32)


def test_a_whole_clip_gives_its_vision_tower(tmp_path: Path) -> None:
    text = {"hidden_size": 16, "intermediate_size": 32, "num_hidden_layers": 1,
            "num_attention_heads": 2, "vocab_size": 50, "max_position_embeddings": 8}  # fmt: skip
    clip = CLIPModel(CLIPConfig(text_config=text, vision_config=TOWER, projection_dim=12)).eval()
    clip.save_pretrained(tmp_path)
    pixels = torch.rand(3, 3, 48, 48)
    encoder = load_vision_checkpoint(tmp_path)
    with torch.no_grad():
        features = clip.get_image_features((pixels - encoder.mean) / encoder.std)
    expected = getattr(features, "pooler_output", features)  # the tensor itself before 5
    torch.testing.assert_close(encoder.read(pixels)[1], expected)


def test_other_weights_have_another_checksum(folder: Path) -> None:
    before = load_vision_checkpoint(folder).sha256
    weights = load_file(folder / "model.safetensors")
    weights["visual_projection.weight"] += 1
    save_file(weights, folder / "model.safetensors", metadata={"format": "pt"})
    assert load_vision_checkpoint(folder).sha256 != before


@pytest.mark.parametrize(
    ("spoil", "expected"),
    [
        ("missing", "can't be read"),
        ("kind", "model of type 'vit'"),
        ("weight", "lacks or adds weights: visual_projection.weight"),
        ("nan", "visual_projection.weight is not finite"),
        ("cut", "no image encoder could be read"),
        ("std", "image_std must be positive"),
        ("mean", "must have three numbers"),
    ],
)
def test_what_does_not_fit_is_refused(folder: Path, spoil: str, expected: str) -> None:
    path, config = folder / "model.safetensors", folder / "config.json"
    weights = load_file(path)
    if spoil == "missing":
        config.unlink()
    elif spoil == "kind":
        config.write_text(json.dumps({**json.loads(config.read_text()), "model_type": "vit"}))
    elif spoil == "weight":
        del weights["visual_projection.weight"]
        save_file(weights, path, metadata={"format": "pt"})
    elif spoil == "nan":
        weights["visual_projection.weight"][0, 0] = torch.nan
        save_file(weights, path, metadata={"format": "pt"})
    elif spoil == "cut":
        path.write_bytes(path.read_bytes()[:200])
    else:
        processing = {"image_std": [0.5, 0.0, 0.5]} if spoil == "std" else {"image_mean": [0.5]}
        (folder / "preprocessor_config.json").write_text(json.dumps(processing))
    with pytest.raises(WeightsError, match=expected):
        load_vision_checkpoint(folder)
