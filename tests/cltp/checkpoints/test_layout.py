"""Every part has the layout of the Hub, and weights of an earlier one are brought into it."""

import json
import random
import shutil
from pathlib import Path

import pytest
import torch
import transformers
import yaml
from huggingface_hub import ModelCard
from safetensors.torch import load_file
from transformers import AutoModelForCausalLM, AutoTokenizer, Qwen2Config, Qwen2ForCausalLM

from cltp.checkpoints.card import FRONT_MATTER, PARTS, renew_card, write_card
from cltp.checkpoints.frozen import load_frozen
from cltp.checkpoints.layout import renew_layout
from cltp.checkpoints.manifest import WeightsError, check_manifest, write_manifest
from cltp.checkpoints.parts import StoredEncoder, StoredProjector
from cltp.checkpoints.tac3d_llm import (
    load_clip,
    load_tac3d_llm,
    save_pretrained,
    save_tac3d_llm,
    size_bytes,
)
from cltp.encoder.clip_towers import small_clip
from cltp.errors import TouchError
from cltp.llm.causal_lm import load_language, small_lm
from cltp.llm.generation import Talker
from cltp.llm.stored_lm import StoredConfig
from cltp.texts.tokenizer import Words
from tacgrasp.__main__ import main
from tacgrasp.policy_factory import shipped_weights
from tests.fakes.tiny_weights import make_weights

TYPES = {
    "clip": "clip",
    "encoder": "tacgrasp_encoder",
    "projector": "tacgrasp_projector",
    "lm": "seed_oss",
}
TOKENIZER_FILES = {"tokenizer.json", "tokenizer_config.json", "special_tokens_map.json"}


@pytest.fixture(scope="module")
def weights(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_weights(tmp_path_factory.mktemp("weights"))


@pytest.fixture
def copy(weights: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(weights, tmp_path / "weights"))


def config_of(part: Path) -> dict[str, object]:
    return dict(json.loads((part / "config.json").read_text()))


def contents(folder: Path) -> dict[str, bytes]:
    paths = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in paths}


def age(folder: Path) -> Path:
    """Write configurations and tokenizers as they were before this layout."""
    for part in ("encoder", "projector"):
        config = config_of(folder / part)
        del config["model_type"], config["architectures"]
        (folder / part / "config.json").write_text(json.dumps(config, indent=2))
    for part in ("clip", "lm"):
        path = folder / part / "tokenizer.json"
        content = json.loads(path.read_text())
        for token in content["added_tokens"]:
            token["special"] = True
        content["decoder"] = content["decoder"]["decoders"][0]
        path.write_text(json.dumps(content))
        for name in TOKENIZER_FILES - {"tokenizer.json"}:
            (folder / part / name).unlink()
    lm = config_of(folder / "lm")
    names = {"hidden_size", "num_hidden_layers", "vocab_size", "intermediate_size", "dtype"}
    names |= {"num_attention_heads", "num_key_value_heads", "rope_parameters"}
    names |= {"max_position_embeddings", "bos_token_id", "eos_token_id", "pad_token_id"}
    kept = {name: lm[name] for name in names}
    config = Qwen2Config(**kept, tie_word_embeddings=True, architectures=["Qwen2ForCausalLM"])
    config.save_pretrained(folder / "lm")
    for part in ("encoder", "clip", "lm", "projector"):
        write_manifest(folder / part, trained_with=("encoder", "lm") if part == "projector" else ())
    return folder


def replies(folder: Path) -> list[str]:
    talker = Talker(load_tac3d_llm(folder))
    clouds = torch.rand(3, 1024, 3, generator=torch.Generator().manual_seed(0)).numpy()
    return [talker.reply(cloud, "Pick it, 1.5 N.", max_tokens=12).text for cloud in clouds]


@pytest.mark.parametrize("folder", ["written", "shipped"])
def test_every_part_names_itself_and_its_sizes(folder: str, weights: Path) -> None:
    root = weights if folder == "written" else shipped_weights()
    for part, kind in TYPES.items():
        config = config_of(root / part)
        assert config["model_type"] == kind
        assert all(isinstance(name, str) for name in config["architectures"])
        assert config["architectures"]
        check_manifest(root / part)
    assert config_of(root / "encoder")["encoder"]["dim"] >= 48
    assert config_of(root / "projector")["lm_dim"] == config_of(root / "lm")["hidden_size"]
    for part in ("clip", "lm"):
        listed = json.loads((root / part / "manifest.json").read_text())["files"]
        assert listed.keys() >= TOKENIZER_FILES


def test_the_shipped_weights_have_todays_layout_and_fit_into_20_mb(tmp_path: Path) -> None:
    assert size_bytes(shipped_weights()) <= 20e6
    folder = Path(shutil.copytree(shipped_weights(), tmp_path / "weights"))
    assert renew_layout(folder) == list(PARTS)
    assert contents(folder) == contents(shipped_weights())


def test_an_encoder_is_read_and_saved_under_the_hubs_verbs(weights: Path, tmp_path: Path) -> None:
    stored = StoredEncoder.from_pretrained(str(weights / "encoder"))
    stored.save_pretrained(str(tmp_path / "again"))
    assert contents(tmp_path / "again") == contents(weights / "encoder")
    points = torch.rand(2, 1024, 3)
    again = StoredEncoder.from_pretrained(tmp_path / "again")
    expected, encoded = stored.encoder(points), again.encoder(points)
    torch.testing.assert_close(encoded.feature, expected.feature, atol=0, rtol=0)
    numbers, same = (s.heads(e.pooled).numbers for s, e in ((stored, expected), (again, encoded)))
    torch.testing.assert_close(same, numbers, atol=0, rtol=0)


def test_a_projector_is_read_and_saved_under_the_hubs_verbs(weights: Path, tmp_path: Path) -> None:
    stored = StoredProjector.from_pretrained(weights / "projector")
    assert stored.tokenizer_sha256 == Words.load(weights / "lm").fingerprint()
    stored.save_pretrained(tmp_path / "again")
    again = load_file(tmp_path / "again" / "model.safetensors")
    before = load_file(weights / "projector" / "model.safetensors")
    assert again.keys() == before.keys()
    assert all(torch.equal(again[name], before[name]) for name in before)
    assert config_of(tmp_path / "again") == config_of(weights / "projector")
    StoredProjector.from_pretrained(tmp_path / "again")


@pytest.mark.parametrize(
    ("read", "part", "expected"),
    [
        (StoredEncoder.from_pretrained, "projector", "tacgrasp_encoder"),
        (StoredEncoder.from_pretrained, "lm", "tacgrasp_encoder"),
        (StoredProjector.from_pretrained, "encoder", "tacgrasp_projector"),
    ],
)
def test_another_kind_of_part_is_refused_by_its_name(
    read: object, part: str, expected: str, weights: Path
) -> None:
    message = f"{part} holds a model of type '{TYPES[part]}' where '{expected}' is expected; name"
    with pytest.raises(WeightsError, match=message):
        read(weights / part)  # type: ignore[operator]


@pytest.mark.parametrize("dim", [0, -1, True, None, "x", 2.5, 10**9])
@pytest.mark.parametrize("name", ["encoder_dim", "lm_dim"])
def test_a_projector_of_no_possible_size_is_refused(name: str, dim: object, copy: Path) -> None:
    folder = copy / "projector"
    (folder / "config.json").write_text(json.dumps({**config_of(folder), name: dim}))
    write_manifest(folder)
    with pytest.raises(WeightsError, match=f"{name} must be a whole number of 1 to"):
        StoredProjector.from_pretrained(folder)


def test_a_projector_larger_than_its_file_is_refused(copy: Path) -> None:
    folder = copy / "projector"
    (folder / "config.json").write_text(json.dumps({**config_of(folder), "lm_dim": 9000}))
    write_manifest(folder)
    with pytest.raises(WeightsError, match="they don't belong together"):
        StoredProjector.from_pretrained(folder)


def test_an_earlier_layout_is_read_as_it_is(copy: Path, weights: Path) -> None:
    age(copy)
    assert replies(copy) == replies(weights)
    assert load_frozen(copy / "encoder").sha256 == load_frozen(weights / "encoder").sha256
    load_clip(copy / "clip")


def test_an_earlier_layout_is_brought_into_todays_with_the_same_answers(
    copy: Path, weights: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    age(copy)
    before = contents(copy)
    assert main(["train", "layout", "--weights", str(copy)]) == 0
    assert "clip, encoder, projector, lm" in capsys.readouterr().out
    after = contents(copy)
    for part in PARTS:
        assert after[f"{part}/model.safetensors"] == before[f"{part}/model.safetensors"]
        assert config_of(copy / part) == config_of(weights / part)
    assert replies(copy) == replies(weights)
    renew_layout(copy)
    assert contents(copy) == after


def test_a_language_model_trained_from_an_earlier_layout_is_written_in_todays(
    copy: Path, weights: Path
) -> None:
    age(copy)
    model = load_tac3d_llm(copy, lm_folder=copy / "lm")
    assert isinstance(model.lm, Qwen2ForCausalLM)
    save_tac3d_llm(copy, model)
    assert config_of(copy / "lm") == config_of(weights / "lm")
    assert replies(copy) == replies(weights)


def test_damage_is_refused_before_anything_is_written(copy: Path) -> None:
    age(copy)
    path = copy / "lm" / "model.safetensors"
    data = path.read_bytes()
    path.write_bytes(data[:-1] + bytes([data[-1] ^ 1]))
    before = contents(copy)
    with pytest.raises(WeightsError, match="is damaged or of another set"):
        renew_layout(copy)
    assert contents(copy) == before


def test_parts_of_two_trainings_are_not_brought_together(copy: Path, tmp_path: Path) -> None:
    other = make_weights(tmp_path / "other", seed=1)
    shutil.rmtree(copy / "encoder")
    shutil.copytree(other / "encoder", copy / "encoder")
    before = contents(copy)
    with pytest.raises(WeightsError, match="is of another set"):
        renew_layout(copy)
    assert contents(copy) == before


def test_a_folder_without_parts_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["train", "layout", "--weights", str(tmp_path)]) != 0
    message = capsys.readouterr().err.strip()
    assert "has none of clip, encoder, projector, lm" in message
    assert "\n" not in message


def test_our_language_model_is_a_qwen2_to_the_bit() -> None:
    folder = shipped_weights() / "lm"
    model = AutoModelForCausalLM.from_pretrained(folder, dtype=torch.float32).eval()
    names = {"vocab_size", "hidden_size", "intermediate_size", "num_hidden_layers"}
    names |= {"num_attention_heads", "num_key_value_heads", "rms_norm_eps", "rope_parameters"}
    qwen2 = Qwen2ForCausalLM(
        Qwen2Config(**{n: config_of(folder)[n] for n in names}, tie_word_embeddings=True)
    ).eval()
    qwen2.load_state_dict(model.state_dict(), strict=True)
    ids = torch.randint(0, 1024, (2, 60), generator=torch.Generator().manual_seed(0))
    with torch.no_grad():
        assert torch.equal(model(ids).logits, qwen2(ids).logits)
    assert set(StoredConfig.__dataclass_fields__) - {"rope_theta"} < config_of(folder).keys()


@pytest.mark.skipif(
    int(transformers.__version__.split(".")[0]) < 5, reason="transformers 4 leaves the tokens alone"
)
def test_under_the_name_qwen2_transformers_would_take_other_tokens(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(shipped_weights() / "lm", tmp_path / "lm"))
    text, words = "x -3.42 mm", Words.load(folder)
    theirs = AutoTokenizer.from_pretrained(folder, local_files_only=True)
    assert theirs(text)["input_ids"] == words.encode(text)
    Qwen2Config().save_pretrained(folder)
    theirs = AutoTokenizer.from_pretrained(folder, local_files_only=True)
    assert theirs(text)["input_ids"] != words.encode(text)  # the reason for the other name


def test_a_tokenizer_of_ours_that_is_damaged_is_not_taken_for_a_stock_one(copy: Path) -> None:
    path = copy / "lm" / "tokenizer.json"
    path.write_text(path.read_text().replace("<move_up>", "<move_upward>"))
    with pytest.raises(TouchError, match="lacks <move_up>"):
        load_language(copy / "lm")


def test_a_vocabulary_of_eight_thousand_tokens_fits_into_20_mb(tmp_path: Path) -> None:
    rng = random.Random(0)
    letters = ["".join(rng.choices("abcdefghijklmnopqrst", k=7)) for _ in range(6000)]
    words = Words.train([" ".join(letters)] * 2, size=8192)
    assert len(words) == 8192
    folder = Path(shutil.copytree(shipped_weights(), tmp_path / "weights"))
    save_pretrained(folder / "clip", small_clip(words), words)
    save_pretrained(folder / "lm", small_lm(words), words)
    assert config_of(folder / "lm")["vocab_size"] == 8192
    assert size_bytes(shipped_weights()) < size_bytes(folder) <= 20e6


@pytest.mark.parametrize("folder", ["written", "shipped"])
def test_the_card_has_front_matter_that_the_hub_reads(folder: str, weights: Path) -> None:
    root = shipped_weights()
    if folder == "written":
        root = weights
        write_card(root, {"command": "`tacgrasp train llm --seed 3`", "seed": "3"})
    text = (root / "README.md").read_text()
    meta = yaml.safe_load(text.split("---\n")[1])
    assert meta == yaml.safe_load(FRONT_MATTER.strip("-\n"))
    assert (meta["license"], meta["library_name"]) == ("mit", "tacgrasp")
    assert meta["pipeline_tag"] == "robotics"
    assert meta["language"] == ["en"]
    assert {"tactile", "robotics"} <= set(meta["tags"])
    assert (meta["base_model"], meta["datasets"], meta["metrics"]) == ([], [], ["accuracy"])
    card = ModelCard(text)
    assert card.data.license == "mit"
    assert card.text.lstrip().startswith("# Tac3D-LLM")
    assert "| command | `tacgrasp train " in text
    for part, kind in TYPES.items():
        assert f"| {part} | `{kind}` |" in text
    assert text.count("## Scores") == text.count("## Parts") == 1


def test_the_parts_of_a_card_are_counted_in_the_files(weights: Path) -> None:
    write_card(weights, {"command": "`a command`"})
    text = (weights / "README.md").read_text()
    for part in PARTS:
        state = load_file(weights / part / "model.safetensors")
        count = sum(value.numel() for value in state.values())
        size = sum(path.stat().st_size for path in (weights / part).iterdir())
        assert f"| {count:,} | {size:,} |" in text


def test_a_card_is_renewed_around_its_facts_and_scores(weights: Path) -> None:
    plain = "# Tac3D-LLM, small\n\n| command | `x` |\n\n## Scores\n\n| depth | 0.9 |\n"
    (weights / "README.md").write_text(plain)
    renew_card(weights)
    once = (weights / "README.md").read_text()
    assert once.startswith(FRONT_MATTER)
    assert once.endswith("## Scores\n\n| depth | 0.9 |\n")
    assert "| command | `x` |" in once
    renew_card(weights)
    assert (weights / "README.md").read_text() == once


def test_the_python_of_the_card_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    text = (shipped_weights() / "README.md").read_text()
    code = text.split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(shipped_weights())
    names: dict[str, object] = {}
    exec(code, names)
    assert names["tokenizer"]("0.4 N")["input_ids"] == Words.load(Path("lm")).encode("0.4 N")
    assert type(names["lm"]).__name__ == "SeedOssForCausalLM"
