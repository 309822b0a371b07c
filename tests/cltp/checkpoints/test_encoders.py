"""Encoders of every variant are written and read back; shipped and older configurations too."""

import json
from pathlib import Path

import pytest
import torch

from cltp.checkpoints.frozen import frozen, load_frozen, save_frozen
from cltp.checkpoints.manifest import write_manifest
from cltp.checkpoints.tac3d_llm import load_encoder, save_encoder
from cltp.encoder.encoder import PRESETS, VARIANTS, EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads
from tests.paths import ROOT

KEYS = {
    "tokenizer", "dim", "depth", "heads", "num_groups", "group_size", "stem_dim", "stem_blocks",
    "feature_dim", "bearing", "projection", "grades", "pressure", "curves",
}  # fmt: skip
"""Keys of a stored configuration; weights of earlier versions have all but the last two."""


@pytest.mark.parametrize(
    ("tokenizer", "pressure"), [*((name, 0) for name in VARIANTS), ("grid", 1)]
)
def test_every_variant_is_read_back_as_it_was_written(
    tokenizer: str, pressure: int, tmp_path: Path
) -> None:
    variant = VARIANTS[tokenizer]
    config = EncoderConfig(
        tokenizer=tokenizer,
        dim=24,
        depth=1,
        heads=2,
        stem_dim=8,
        num_groups=variant.groups or 64,
        bearing=16 if variant.has_places else 0,
        pressure=pressure,
    )
    encoder = TactileEncoder(config)
    save_frozen(tmp_path, encoder, "random")
    stored = json.loads((tmp_path / "config.json").read_text())
    assert stored["encoder"].keys() == KEYS
    assert stored["encoder"]["tokenizer"] == tokenizer
    assert load_frozen(tmp_path).sha256 == frozen(encoder).sha256


def test_every_preset_belongs_to_one_variant() -> None:
    names = [name for variant in VARIANTS.values() for name in variant.presets]
    assert sorted(names) == sorted(PRESETS)
    assert {"grid", "small_graded", "pointbert", "ulip2"} <= set(names)
    assert {config.tokenizer for config in PRESETS.values()} == set(VARIANTS)


def test_the_shipped_encoder_is_the_preset_that_it_was_trained_with() -> None:
    folder = ROOT / "policies" / "weights" / "encoder"
    assert load_encoder(folder)[0].config == PRESETS["grid"]
    assert load_frozen(folder).sha256.startswith("a92c26a3f5b26b16")


def test_weights_from_before_grades_are_read(tmp_path: Path) -> None:
    config = EncoderConfig(dim=24, depth=1, heads=2, stem_dim=8, bearing=16)
    encoder = TactileEncoder(config)
    save_encoder(tmp_path, encoder, StateHeads(48))
    path = tmp_path / "config.json"
    stored = json.loads(path.read_text())
    del stored["encoder"]["grades"]
    path.write_text(json.dumps(stored))
    write_manifest(tmp_path)
    loaded, _ = load_encoder(tmp_path)
    assert loaded.config == config
    points = torch.rand(1, 1024, 3)
    torch.testing.assert_close(loaded(points).feature, encoder(points).feature, atol=0.01, rtol=0)
