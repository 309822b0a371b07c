"""Masked and vision-based pre-training: what is hidden stays hidden, and every method learns."""

from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.frozen import frozen, load_frozen, noisy_frames, save_frozen
from cltp.checkpoints.manifest import WeightsError, write_manifest
from cltp.checkpoints.tac3d_llm import save_encoder, save_pretrained
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY, Sampler
from cltp.encoder.clip_towers import small_clip
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.encoder.masked_modelling import (
    PointMae,
    ShapeWords,
    chamfer,
    hide,
    patches,
    visible_tokens,
)
from cltp.errors import TouchError
from cltp.tactile.sensors import SENSORS
from cltp.texts.tokenizer import Words
from cltp.train.baselines import BASELINES, surface_texts, train_baseline
from cltp.train.curves import read_curves
from cltp.train.recipes import Schedule
from cltp.train.stage import TrainingRun
from tests.fakes.fake_contacts import fake_contact, write_contacts

MINI = SENSORS["gelsight_mini"]
SIZES = {
    name: EncoderConfig(
        tokenizer=name,
        dim=24,
        depth=1,
        heads=4,
        stem_dim=8,
        group_size=16,
        feature_dim=32,
        bearing=16 if name == "lattice" else 0,
        projection=40,
    )
    for name in ("lattice", "fps", "image")
}
SEES = {"tvl": "image", "unitouch": "image", "point_mae": "fps", "point_bert": "fps"}


pytestmark = pytest.mark.usefixtures("one_thread")


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    seeds = {Split.TRAIN: range(12)}
    return write_contacts(tmp_path_factory.mktemp("data"), seeds)


@pytest.fixture(scope="module")
def clip_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("towers") / "clip"
    words = Words.train(["The surface feels smooth to the touch."] * 5, 400)
    save_pretrained(folder, small_clip(words, dim=32, layers=1), words)
    return folder


@pytest.fixture(scope="module")
def points(data_dir: Path) -> torch.Tensor:
    data = ContactDataset(data_dir, split=Split.TRAIN)
    return torch.from_numpy(Sampler(data, CLEAN).batch(np.arange(4), 0).points)


def test_the_chamfer_distance_by_hand() -> None:
    one = torch.tensor([[0.0, 0, 0], [2.0, 0, 0]])
    other = torch.tensor([[0.0, 0, 0], [3.0, 0, 0]])
    assert chamfer(one, other).item() == pytest.approx(0.5 + 0.5)
    assert chamfer(one, one[[1, 0]]).item() == 0.0


def test_as_many_patches_are_hidden_in_every_row() -> None:
    hidden = hide(38, 64, 5, torch.Generator().manual_seed(1))
    assert hidden.sum(dim=1).tolist() == [38] * 5
    assert not torch.equal(hidden[0], hidden[1])


@pytest.mark.parametrize("tokenizer", ["lattice", "fps"])
def test_hidden_patches_do_not_reach_the_encoder(tokenizer: str, points: torch.Tensor) -> None:
    torch.manual_seed(0)
    encoder = TactileEncoder(SIZES[tokenizer]).eval()
    cloud = patches(encoder, points)
    hidden = hide(38, 64, len(points), torch.Generator().manual_seed(2))
    tokens, cls = visible_tokens(encoder, points, cloud, hidden)
    if tokenizer == "lattice":  # the hidden heights are all that changes
        cells = hidden.view(-1, 8, 1, 8, 1).expand(-1, 8, 4, 8, 4).reshape(len(points), -1)
        other = points.clone()
        other[..., 2] += cells * 0.3
        changed = patches(encoder, other)
    else:
        other, changed = points, cloud._replace(groups=cloud.groups + hidden[..., None, None] * 0.3)
    again, cls_again = visible_tokens(encoder, other, changed, hidden)
    torch.testing.assert_close(again, tokens, rtol=0, atol=0)
    torch.testing.assert_close(cls_again, cls, rtol=0, atol=0)
    assert tokens[hidden].abs().max() == 0
    shown, _ = visible_tokens(encoder, other, changed, ~hidden)
    before, _ = visible_tokens(encoder, points, cloud, ~hidden)
    assert not torch.equal(shown, before)


def test_patches_of_the_lattice_hold_every_point_once(points: torch.Tensor) -> None:
    cloud = patches(TactileEncoder(SIZES["lattice"]), points)
    whole = (cloud.groups / 8.0 + cloud.centres[:, :, None]).flatten(1, 2)
    order = lambda p: p[0][p[0][:, :2].mul(torch.tensor([1e3, 1.0])).sum(1).argsort()]  # noqa: E731
    torch.testing.assert_close(order(whole), order(points), atol=1e-5, rtol=0)
    with pytest.raises(TouchError, match="not for image"):
        patches(TactileEncoder(SIZES["image"]), points)


@pytest.mark.parametrize("tokenizer", ["lattice", "fps"])
def test_a_cloud_is_drawn_again_better_and_better(tokenizer: str, points: torch.Tensor) -> None:
    torch.manual_seed(0)
    model = PointMae(TactileEncoder(SIZES[tokenizer]), 16)
    optimiser = torch.optim.AdamW(model.parameters(), lr=3e-3)
    errors = []
    for step in range(25):
        loss = model.losses(points, torch.Generator().manual_seed(step))["chamfer"]
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        errors.append(loss.item())
    assert np.mean(errors[-5:]) < 0.5 * errors[0]


def test_patches_that_differ_get_words_that_differ(points: torch.Tensor) -> None:
    torch.manual_seed(0)
    words = ShapeWords(24, 16, vocabulary=8)
    cloud = patches(TactileEncoder(SIZES["fps"]), points)
    terms = words.losses(cloud, 1.0, torch.Generator().manual_seed(0))
    assert terms["spread"].item() >= -1e-6  # a divergence
    assert words.logits(cloud).shape == (4, 64, 8)


@pytest.mark.parametrize("method", BASELINES)
def test_every_method_trains_and_is_read_back(
    method: str, data_dir: Path, clip_dir: Path, tmp_path: Path
) -> None:
    config = SIZES[SEES.get(method, "lattice")]
    schedule = Schedule(steps=8, batch_size=4, learning_rate=1e-3)
    run = TrainingRun(data=data_dir, out=tmp_path)
    folder = train_baseline(method, run, config, schedule, clip_dir=clip_dir)
    read = load_frozen(folder)
    assert read.encoder.config == config
    data = ContactDataset(data_dir, split=Split.TRAIN)
    batch = Sampler(data, NOISY).batch(np.arange(3), 0)
    frames = None
    if read.sees_images:
        frames = noisy_frames(batch.height_mm, [MINI] * 3, NOISY, np.random.default_rng(0))
    pooled, feature = read.encode(batch, frames)
    assert (pooled.shape, feature.shape) == ((3, 48), (3, 32))
    curves = list((tmp_path / ".training").glob("*.csv"))
    assert sum(int(read_curves(path)["step"][-1]) for path in curves) == 8 * (method != "random")


def test_a_method_refuses_an_encoder_that_cannot_see_it(data_dir: Path, tmp_path: Path) -> None:
    schedule = Schedule(steps=1, batch_size=4, learning_rate=1e-3)
    run = TrainingRun(data=data_dir, out=tmp_path)
    for method, tokenizer in (("tvl", "fps"), ("point_mae", "image")):
        with pytest.raises(TouchError, match="needs an encoder of"):
            train_baseline(method, run, SIZES[tokenizer], schedule)
    with pytest.raises(TouchError, match="name a CLIP"):
        train_baseline("tvl", run, SIZES["image"], schedule)
    with pytest.raises(TouchError, match="known: random, point_mae"):
        train_baseline("simclr", run, SIZES["lattice"], schedule)


def test_vision_hears_of_touch_and_material_alone(data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TRAIN)
    batch = Sampler(data, CLEAN).batch(np.arange(3), 0)
    state = batch.states[0]
    assert (
        surface_texts("tvl", data, batch)[0] == f"The surface feels {state.texture} to the touch."
    )
    assert str(data.column("object")[0]) in surface_texts("unitouch", data, batch)[0]
    for text in (*surface_texts("tvl", data, batch), *surface_texts("unitouch", data, batch)):
        assert not any(str(word) in text for word in (state.position, state.area))


def test_weights_that_do_not_match_their_configuration_are_refused(tmp_path: Path) -> None:
    encoder = TactileEncoder(SIZES["fps"])
    save_frozen(tmp_path, encoder, "point_mae")
    assert load_frozen(tmp_path).sha256 == frozen(encoder).sha256
    path = tmp_path / "config.json"
    path.write_text(path.read_text().replace('"dim": 24', '"dim": 48'))
    write_manifest(tmp_path)
    with pytest.raises(WeightsError, match=r"does not match its config.*tacgrasp train llm"):
        load_frozen(tmp_path)
    with pytest.raises(WeightsError, match="holds no encoder"):
        load_frozen(tmp_path / "none")


def test_encoders_of_cltp_are_read_too(tmp_path: Path) -> None:
    encoder = TactileEncoder(SIZES["lattice"])
    save_encoder(tmp_path, encoder, StateHeads(48))
    assert load_frozen(tmp_path).encoder.config == encoder.config


def test_frames_without_noise_are_the_clean_ones_and_with_it_are_not() -> None:
    heights = fake_contact(1).height_mm
    rng = np.random.default_rng(0)
    clean = noisy_frames([heights], [MINI], CLEAN, rng)
    assert torch.equal(clean, noisy_frames([heights], [MINI], CLEAN, rng))
    assert (noisy_frames([heights], [MINI], NOISY, rng) - clean).abs().max() > 0.01
