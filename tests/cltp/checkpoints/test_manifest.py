"""Weights that are not, to the byte, what was trained are refused before a model is made."""

import json
import re
import shutil
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from cltp.checkpoints.frozen import load_frozen
from cltp.checkpoints.manifest import MANIFEST, WeightsError, check_manifest, write_manifest
from cltp.checkpoints.tac3d_llm import load_clip, load_encoder, load_tac3d_llm
from cltp.errors import TouchError
from policies.llm.policy import LlmPolicy
from tacgrasp.base.errors import UsageError
from tacgrasp.policy_factory import shipped_weights
from tacgrasp.training.upkeep import write_manifests
from tests.fakes.tiny_weights import make_weights

PARTS = ("encoder", "clip", "projector", "lm")


@pytest.fixture(scope="module")
def weights(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_weights(tmp_path_factory.mktemp("weights"))


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Weights of the same sizes and words from another training."""
    return make_weights(tmp_path_factory.mktemp("others"), seed=1)


@pytest.fixture
def copy(weights: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(weights, tmp_path / "weights"))


def load(folder: Path) -> None:
    load_tac3d_llm(folder)
    load_clip(folder / "clip")


def refusal(read: Callable[[], object]) -> str:
    with pytest.raises(TouchError) as caught:
        read()
    assert "\n" not in str(caught.value)
    return str(caught.value)


def part_files(folder: Path) -> list[Path]:
    return sorted(path for part in PARTS for path in (folder / part).iterdir())


def test_whole_weights_are_read(weights: Path) -> None:
    load(weights)
    assert {p.relative_to(weights).parts[0] for p in part_files(weights)} == set(PARTS)
    assert all((weights / part / MANIFEST).is_file() for part in PARTS)


def flip(data: bytes) -> bytes:
    middle = len(data) // 2
    return data[:middle] + bytes([data[middle] ^ 1]) + data[middle + 1 :]


def damaged_each_way(folder: Path, read: Callable[[Path], object]) -> list[tuple[str, str]]:
    """What is said of every file when one bit is flipped, it is cut short, or missing."""
    said = []
    for path in part_files(folder):
        whole = path.read_bytes()
        for change in (flip(whole), whole[: len(whole) // 2], b"", None):
            if change is None:
                path.unlink()
            else:
                path.write_bytes(change)
            said.append((path.name, refusal(lambda: read(folder))))
        path.write_bytes(whole)
    return said


def assert_each_is_named(said: list[tuple[str, str]]) -> None:
    for name, message in said:
        assert name in message
        assert re.search("damaged|does not exist|missing|has no manifest|of another set", message)


def test_every_file_flipped_cut_short_or_missing_is_named(copy: Path) -> None:
    said = damaged_each_way(copy, load)
    assert len(said) == 4 * len(part_files(copy))
    assert_each_is_named(said)
    load(copy)


def test_every_file_of_the_shipped_weights_is_guarded(tmp_path: Path) -> None:
    folder = Path(shutil.copytree(shipped_weights(), tmp_path / "weights"))
    manifests = damaged_each_way(folder, lambda whole: [check_manifest(whole / p) for p in PARTS])
    assert_each_is_named([pair for pair in manifests if pair[0] != MANIFEST])
    projector = folder / "projector" / "model.safetensors"
    projector.write_bytes(flip(projector.read_bytes()))
    assert "is damaged or of another set" in refusal(lambda: LlmPolicy(folder))


def test_every_file_of_another_set_is_refused(copy: Path, others: Path) -> None:
    for path in part_files(others):
        ours = copy / path.relative_to(others)
        whole = ours.read_bytes()
        if whole == path.read_bytes():
            continue  # the same configuration, the same words
        ours.write_bytes(path.read_bytes())
        message = refusal(lambda: load(copy))
        assert "of another set" in message
        ours.write_bytes(whole)


@pytest.mark.parametrize("part", ["encoder", "projector", "lm"])
def test_a_whole_part_of_another_set_is_refused(part: str, copy: Path, others: Path) -> None:
    shutil.rmtree(copy / part)
    shutil.copytree(others / part, copy / part)
    check_manifest(copy / part)  # whole in itself
    assert "is of another set" in refusal(lambda: load_tac3d_llm(copy))


def test_a_file_that_was_not_there_is_refused(copy: Path) -> None:
    (copy / "clip" / "pytorch_model.bin").write_bytes(b"another model")
    assert "pytorch_model.bin is not in manifest.json" in refusal(lambda: load(copy))


@pytest.mark.parametrize("part", PARTS)
def test_a_folder_without_a_manifest_is_refused_with_the_command_that_writes_it(
    part: str, copy: Path
) -> None:
    (copy / part / MANIFEST).unlink()
    message = refusal(lambda: load(copy))
    assert f"tacgrasp train manifest --weights {copy}" in message
    write_manifests(copy)
    load(copy)


def test_a_folder_without_weights_gets_no_manifest(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="has none of clip, encoder, projector, lm"):
        write_manifests(tmp_path)


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", "null", '{"version": 1}', '{"version": 1, "files": 3}', "[" * 9000]
)
def test_a_damaged_manifest_is_refused(text: str, copy: Path) -> None:
    (copy / "projector" / MANIFEST).write_text(text)
    assert "manifest.json is damaged" in refusal(lambda: load(copy))


def changed(folder: Path, section: str, name: str, value: object) -> None:
    """Change a configuration and make a manifest for it, as another program might."""
    path = folder / "config.json"
    config = json.loads(path.read_text())
    (config[section] if section else config)[name] = value
    path.write_text(json.dumps(config))
    write_manifest(folder)


BAD_SIZES = [0, -1, "x", None, 2.5, True, [1], 10**6, 10**30]


@pytest.mark.parametrize("value", BAD_SIZES)
@pytest.mark.parametrize("name", ["dim", "depth", "heads", "num_groups"])
def test_an_encoder_of_no_possible_size_is_refused_at_once(
    name: str, value: object, copy: Path
) -> None:
    changed(copy / "encoder", "encoder", name, value)
    began_s = time.monotonic()
    assert "encoder" in refusal(lambda: load_encoder(copy / "encoder"))
    assert "encoder" in refusal(lambda: load_frozen(copy / "encoder"))
    assert time.monotonic() - began_s < 5.0


@pytest.mark.parametrize("value", BAD_SIZES)
@pytest.mark.parametrize("name", ["hidden_size", "num_hidden_layers", "num_attention_heads"])
def test_a_language_model_of_no_possible_size_is_refused_at_once(
    name: str, value: object, copy: Path
) -> None:
    changed(copy / "lm", "", name, value)
    assert "language model" in refusal(lambda: load_tac3d_llm(copy))


@pytest.mark.parametrize("value", [v for v in BAD_SIZES if v is not None])
@pytest.mark.parametrize("name", ["hidden_size", "num_hidden_layers", "num_attention_heads"])
def test_a_clip_of_no_possible_size_is_refused_at_once(
    name: str, value: object, copy: Path
) -> None:
    changed(copy / "clip", "text_config", name, value)
    assert name in refusal(lambda: load_clip(copy / "clip"))


def test_an_encoder_larger_than_its_file_is_refused(copy: Path) -> None:
    changed(copy / "encoder", "encoder", "dim", 2048)
    assert "don't belong together" in refusal(lambda: load_encoder(copy / "encoder"))


def test_a_policy_of_the_shipped_weights_starts() -> None:
    LlmPolicy(shipped_weights())


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="does not exist"):
        load_tac3d_llm(tmp_path / "none")
