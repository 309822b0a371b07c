import io
import math
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.frozen import frozen
from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.tac3d_llm import (
    load_clip,
    load_encoder,
    load_tac3d_llm,
    save_encoder,
    size_bytes,
)
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.prefetch import prefetched
from cltp.data.sampler import CLEAN, NOISY, Augmentation, Sampler, mirrored
from cltp.encoder.class_token import (
    HeightQuantiles,
    encoded_ranks,
    height_quantiles,
    ordered_curves,
    piecewise_linear,
    quantile_ranks,
)
from cltp.encoder.encoder import PRESETS, EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads, restored, targets, transformed
from cltp.encoder.losses import CltpLoss, ContrastiveLoss
from cltp.encoder.render import render
from cltp.encoder.tokenizers import even_channels, farthest_points, grid_maps
from cltp.errors import TouchError
from cltp.evaluation.features import encode_batches, random_batches
from cltp.evaluation.geometric_baseline import predict_geometrically
from cltp.evaluation.probes import predict_with_heads
from cltp.evaluation.scores import best_classes, score_classes
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.llm.generation import Talker
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.encoder_input import cell_centres, encoder_input, lattice_points, scaled
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import ContactState, Position, Side
from cltp.texts.captions import caption
from cltp.texts.exchange_packing import Exchange
from cltp.texts.tokenizer import Words
from cltp.texts.told import ToldContact
from cltp.train.alignment import train_cltp, train_heads
from cltp.train.clip import train_clip
from cltp.train.llm import train_llm, train_words
from cltp.train.recipes import Schedule
from cltp.train.stage import Stage, TrainingRun
from tests.fakes.fake_contacts import fake_contact, write_contacts

MINI = SENSORS["gelsight_mini"]
TINY = PRESETS["tiny"]


def schedule(steps: int, batch_size: int, rate: float = 3e-3) -> Schedule:
    return Schedule(steps=steps, batch_size=batch_size, learning_rate=rate)


def run_in(folder: Path, seed: int = 0) -> TrainingRun:
    return TrainingRun(data=folder, out=folder, seed=seed)


class FakeLessons:
    """Lessons for tests: the caption, and an action that the prompt and the depth decide."""

    def captions(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [Exchange(prompt="Describe the contact.", reply=caption(felt.state))]

    def mixed(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        hard = "<decrease_force>" if felt.state.depth_mm > 0.3 else "<none>"
        soft = "<none>" if felt.state.depth_mm > 0.3 else "<increase_force>"
        return [
            *self.captions(felt, rng),
            Exchange(prompt="Hold it gently.", reply=f"Action: {hard}."),
            Exchange(prompt="Hold it firmly.", reply=f"Action: {soft}."),
        ]

    def questions(self, num: int, rng: np.random.Generator) -> Sequence[Exchange]:
        return [Exchange(prompt="how deep", reply="amount depth mm.")] * num


pytestmark = pytest.mark.usefixtures("one_thread")

CONTACTS = 8
"""Contacts that are learned by heart, all of them in every step."""


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    seeds = {Split.TRAIN: range(CONTACTS), Split.TEST: range(100, 106)}
    return write_contacts(tmp_path_factory.mktemp("data"), seeds)


def train_all(data: Path, folder: Path, steps: Mapping[str, int]) -> Path:
    """Train tiny weights of every part on clean contacts."""
    words = train_words(data, FakeLessons(), num_contacts=60, size=400)
    run = TrainingRun(data=data, out=folder)
    train_clip(run, words, schedule(6, CONTACTS), dim=32)
    train_cltp(run, TINY, schedule(steps["encoder"], CONTACTS), augmentation=CLEAN)
    train_llm(
        run,
        words,
        FakeLessons(),
        {stage: schedule(steps[stage], CONTACTS, 5e-3) for stage in ("text", "projector", "joint")},
        dim=48,
        layers=2,
        augmentation=CLEAN,
    )
    return folder


FEW_STEPS = {"encoder": 20, "text": 2, "projector": 2, "joint": 4}
"""Steps of weights that exist, and need not be good."""


@pytest.fixture(scope="module")
def trained(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Tiny weights after a few steps."""
    return train_all(data_dir, tmp_path_factory.mktemp("weights"), FEW_STEPS)


def test_the_contrastive_loss_of_two_orthogonal_pairs_is_known() -> None:
    loss = ContrastiveLoss()
    with torch.no_grad():
        loss.log_scale.fill_(math.log(2.0))
    pairs = torch.eye(2)
    expected = math.log(1 + math.exp(-2.0))  # -log(e^2 / (e^2 + e^0)), the same both ways
    assert loss(3 * pairs, 5 * pairs).item() == pytest.approx(expected, rel=1e-5)


def test_the_temperature_cannot_fall_below_a_hundredth() -> None:
    loss = ContrastiveLoss()
    with torch.no_grad():
        loss.log_scale.fill_(50.0)
    swapped = torch.eye(2).flip(0)
    assert loss(torch.eye(2), swapped).item() == pytest.approx(100.0, rel=1e-4)


def test_without_images_only_language_is_aligned() -> None:
    features = torch.randn(4, 8)
    assert set(CltpLoss()(features, features)) == {"t2l"}
    assert set(CltpLoss()(features, features, features)) == {"t2l", "t2i"}


def test_scaling_is_by_constants_of_the_sensor() -> None:
    points = np.array([[MINI.width_mm / 2, -MINI.width_mm / 4, 0.75]])
    np.testing.assert_allclose(scaled(points, MINI), [[1.0, -0.5, 0.5]], rtol=1e-6)


def test_a_stratified_cloud_is_taken_as_it_is() -> None:
    cloud = cloud_from_heights(fake_contact(3).height_mm, MINI, rng=np.random.default_rng(0))
    np.testing.assert_array_equal(lattice_points(cloud), cloud.points_mm)


@pytest.mark.parametrize("num_points", [64, 400, 1024, 6400])
def test_any_cloud_becomes_1024_points_on_the_same_plane(num_points: int) -> None:
    y = np.linspace(0.3, 0.1, 60)[:, None]
    tilted = np.broadcast_to(y, (60, 80))
    cloud = cloud_from_heights(tilted, MINI, rng=np.random.default_rng(1), num_points=num_points)
    points = lattice_points(cloud)
    assert points.shape == (1024, 3)
    centres = cell_centres(MINI)
    assert np.abs(points[:, 0] - centres[:, 0]).max() <= MINI.width_mm / 64 + 1e-4
    expected = 0.2 + 0.2 * points[:, 1] / MINI.height_mm
    inner = np.abs(points[:, 1]) < 0.4 * MINI.height_mm
    assert np.abs(points[:, 2] - expected)[inner].max() < 0.02


def test_the_order_of_a_cloud_does_not_matter() -> None:
    cloud = cloud_from_heights(fake_contact(3).height_mm, MINI, rng=np.random.default_rng(0))
    shuffled = np.random.default_rng(1).permutation(1024)
    other = type(cloud)(points_mm=cloud.points_mm[shuffled], sensor=MINI)
    np.testing.assert_array_equal(encoder_input(other), encoder_input(cloud))


def test_the_lattice_channels_are_height_relief_and_place() -> None:
    centres = scaled(np.c_[cell_centres(MINI), np.full(1024, 0.15)], MINI)
    channels = even_channels(torch.from_numpy(centres)[None])
    assert channels.shape == (1, 4, 32, 32)
    torch.testing.assert_close(channels[0, 0], torch.full((32, 32), 0.5))  # 5 × 0.15 / 1.5
    assert channels[0, 1:].abs().max() < 1e-3  # flat, and every point at its cell's centre


def test_farthest_points_of_a_square_are_its_corners() -> None:
    corners = torch.tensor([[0.0, 0, 0], [0, 0.1, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]])
    assert set(farthest_points(corners[None], 4)[0].tolist()) == {0, 2, 3, 4}


@pytest.mark.parametrize("tokenizer", ["lattice", "fps"])
def test_both_tokenizers_give_a_token_for_each_group(tokenizer: str) -> None:
    config = EncoderConfig(tokenizer=tokenizer, dim=24, depth=1, heads=2, stem_dim=8)
    out = TactileEncoder(config)(torch.rand(2, 1024, 3))
    assert out.tokens.shape == (2, 65, 24)
    assert out.pooled.shape == (2, 48)
    assert out.feature.shape == (2, config.feature_dim)


def test_sizes_that_do_not_fit_are_refused() -> None:
    with pytest.raises(TouchError, match="multiple"):
        EncoderConfig(dim=30, heads=4)
    with pytest.raises(TouchError, match="known: grid, lattice, fps, image"):
        EncoderConfig(tokenizer="voxels")
    with pytest.raises(TouchError, match="whole number of 0 to"):
        EncoderConfig(projection=-1)
    with pytest.raises(TouchError, match="height quantiles are not for fps"):
        EncoderConfig(tokenizer="fps", bearing=16)
    with pytest.raises(TouchError, match="lattice has 64 groups, got 32"):
        EncoderConfig(num_groups=32)
    with pytest.raises(TouchError, match="image has 64 groups, got 256"):
        EncoderConfig(tokenizer="image", num_groups=256)


def test_the_bearing_curve_knows_heights_and_not_places() -> None:
    torch.manual_seed(0)
    curve = HeightQuantiles(8, 16)
    points = torch.rand(2, 1024, 3)
    moved = points.clone()
    moved[0, :, :2] += 0.3
    moved[1] = points[1, torch.randperm(1024)]
    torch.testing.assert_close(curve(moved), curve(points))
    deeper = points.clone()
    deeper[0, points[0, :, 2].argmax(), 2] += 0.2
    for before, after in zip(curve(points), curve(deeper), strict=True):
        assert not torch.equal(before[0], after[0])
        torch.testing.assert_close(before[1], after[1])
    ranks, few = quantile_ranks(16, torch.tensor([[1024], [9]]))
    assert few.max() == 8
    assert ranks[:8].tolist() == list(range(8))
    assert (ranks.diff() > 0).all()
    assert ranks[-1] == 1023


def test_graded_heights_fill_steps_one_after_the_other() -> None:
    encoded = piecewise_linear(torch.tensor([[0.5, 1.2], [-0.1, 0.875]]), 4)
    expected = [[1, 1, 0, 0, 1, 1, 1, 1], [0, 0, 0, 0, 1, 1, 1, 0.5]]
    torch.testing.assert_close(encoded, torch.tensor(expected, dtype=torch.float32))
    ranks = encoded_ranks(64)
    assert ranks == sorted(set(ranks))
    assert (ranks[0], ranks[-1]) == (0, 63)
    assert HeightQuantiles(8, 64, grades=10).trunk[0].in_features == 64 + 10 * len(ranks)


def test_grades_are_of_a_bearing_curve_and_tell_encoders_apart() -> None:
    with pytest.raises(TouchError, match="60 grades need height quantiles"):
        EncoderConfig(grades=60)
    plain, graded = EncoderConfig(bearing=64), EncoderConfig(bearing=64, grades=60)
    assert plain != graded
    assert plain.identity == str(plain) != graded.identity


def test_ordered_curves_stand_beside_what_is_learned_whatever_that_is(tmp_path: Path) -> None:
    config = PRESETS["grid_curves"]
    heights = np.stack([fake_contact(number).height_mm for number in range(2)])
    clouds = [cloud_from_heights(each, MINI) for each in heights]
    layout = config.variant.layout
    points = torch.from_numpy(np.stack([encoder_input(cloud, layout) for cloud in clouds]))
    first, second = (TactileEncoder(config).eval() for _ in range(2))
    with torch.no_grad():
        pooled, other = first(points).pooled, second(points).pooled
    maps = grid_maps(points, has_pressure=True)
    curves = ordered_curves(points, maps, config.bearing, config.grades, config.curves)
    width = config.pooled_dim - 2 * config.dim
    assert curves.shape == (2, width) == (2, 64 + 60 + 2 * 224)
    assert torch.equal(pooled[:, :width], curves)
    assert torch.equal(other[:, :width], curves)
    assert not torch.equal(pooled[:, width:-1], other[:, width:-1])
    torch.testing.assert_close(curves[:, :64], 5 * height_quantiles(points, 64))
    pressures = curves[:, 124:].unflatten(1, (2, 224))
    assert (pressures.diff(dim=2) <= 0).all()  # in falling order
    save_encoder(tmp_path / "encoder", first, StateHeads.of(config))
    assert load_encoder(tmp_path / "encoder")[0].config == config


def test_ordered_curves_need_a_grid() -> None:
    with pytest.raises(TouchError, match="curves need a grid, height quantiles and more than 16"):
        EncoderConfig(bearing=64, curves=112)
    assert PRESETS["grid_curves"].identity != PRESETS["grid"].identity


def test_a_stem_sees_the_pressure_only_where_it_is_asked_to() -> None:
    curves = PRESETS["grid_curves"]
    assert curves.pressure == 0
    assert TactileEncoder(curves).tokenizer.stem.in_channels == 5
    both = replace(curves, pressure=1)  # as the first encoders with curves were
    assert TactileEncoder(both).tokenizer.stem.in_channels == 7
    assert both.pooled_dim == curves.pooled_dim
    layout = both.variant.layout
    cloud = cloud_from_heights(fake_contact(0).height_mm, MINI)
    points = torch.from_numpy(encoder_input(cloud, layout)[None])
    with torch.no_grad():
        assert TactileEncoder(both).eval()(points).pooled.shape == (1, both.pooled_dim)


def test_heads_that_learned_under_other_noise_are_not_taken_up(tmp_path: Path) -> None:
    write_contacts(tmp_path / "data", {Split.TRAIN: range(8)})
    encoder = TactileEncoder(PRESETS["tiny"])
    run = TrainingRun(data=tmp_path / "data", out=tmp_path / "out")
    schedule = Schedule(steps=2, batch_size=4, learning_rate=1e-3)
    train_heads(run, encoder, schedule, LEARNING_NOISE)
    for part in ("windows", "loose", "coarse"):
        other = replace(LEARNING_NOISE, **{part: 0.9})
        with pytest.raises(TouchError, match="delete it to start afresh"):
            train_heads(run, encoder, schedule, other)


def test_numbers_survive_their_transformation() -> None:
    numbers = torch.tensor([[0.4, -3.0, 5.0, 0.12, 1.7], [0.0, 0.0, 0.0, 0.0, 0.0]])
    torch.testing.assert_close(restored(transformed(numbers)), numbers, atol=1e-5, rtol=1e-4)


def test_a_slot_that_nobody_named_is_not_learned() -> None:
    state = fake_contact(0).state
    unnamed = targets([type(state)(**{**_fields(state), "shape": None, "texture": None})])
    assert unnamed.classes[0, :2].tolist() == [-1, -1]
    losses = StateHeads(8).losses(torch.randn(1, 8), unnamed)
    assert losses["shape"].item() == 0.0
    assert losses["depth"].item() > 0.0


def _fields(state: ContactState) -> dict[str, object]:
    return {name: getattr(state, name) for name in ContactState.__slots__}


def test_mirroring_turns_positions_and_cut_sides() -> None:
    state = type(fake_contact(0).state)(
        **{
            **_fields(fake_contact(0).state),
            "x_mm": 8.0,
            "y_mm": 6.0,
            "position": Position.TOP_RIGHT,
            "cut": frozenset({Side.RIGHT}),
        }
    )
    image = mirrored(state, MINI, along_x=True, along_y=False)
    assert (image.x_mm, image.y_mm) == (-8.0, 6.0)
    assert image.position is Position.TOP_LEFT
    assert image.cut == {Side.LEFT}
    again = mirrored(image, MINI, along_x=True, along_y=False)
    assert again == state


def test_a_bump_is_lit_from_the_left_and_from_the_top() -> None:
    y, x = np.mgrid[0:76, 0:102]
    bump = 0.6 * np.exp(-((x - 50.5) ** 2 + (y - 37.5) ** 2) / 200)
    red, green, blue = render(bump, MINI)
    assert red[32, 22] > 0.6 > 0.4 > red[32, 42]  # rising to the right is bright
    assert green[42, 32] > 0.6 > 0.4 > green[22, 32]  # rising towards the top is bright
    assert blue.argmax() in (31 * 64 + 31, 31 * 64 + 32, 32 * 64 + 31, 32 * 64 + 32)


def test_samples_depend_on_seed_and_step_alone(data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TRAIN)
    first = Sampler(data, seed=1)
    steps = [first.numbered(5, step) for step in range(5)]
    later = Sampler(data, seed=1).numbered(5, 3)
    np.testing.assert_array_equal(later.points, steps[3].points)
    assert sorted(np.concatenate([s.index for s in steps])[:CONTACTS]) == list(range(CONTACTS))
    other = Sampler(data, seed=2).numbered(5, 0)
    assert not np.array_equal(other.points, steps[0].points)


def test_clean_samples_are_the_stored_contact(data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TRAIN)
    points = Sampler(data, CLEAN).batch(np.array([2]), 0).points[0]
    heights = data.height_mm(2) - np.median(data.height_mm(2))
    x_mm, y_mm = points[:, :2].T * (MINI.width_mm / 2)
    column = ((x_mm / MINI.width_mm + 0.5) * heights.shape[1]).astype(int)
    row = ((0.5 - y_mm / MINI.height_mm) * heights.shape[0]).astype(int)
    off = points[:, 2] * MINI.max_depth_mm - heights[row, column]  # within half a pixel
    assert np.median(np.abs(off)) < 0.005


def test_an_error_while_making_a_batch_is_raised_in_its_place() -> None:
    def items() -> object:
        yield 1
        raise TouchError("damaged")

    made = prefetched(items())  # type: ignore[arg-type]
    assert next(made) == 1
    with pytest.raises(TouchError, match="damaged"):
        next(made)
    assert list(prefetched([1, 2, 3])) == [1, 2, 3]


@pytest.mark.slow
def test_a_handful_of_contacts_is_learned_by_heart(data_dir: Path, tmp_path: Path) -> None:
    steps = {"encoder": 150, "text": 40, "projector": 30, "joint": 130}
    trained = train_all(data_dir, tmp_path, steps)
    data = ContactDataset(data_dir, split=Split.TRAIN)
    encoder, heads = load_encoder(trained / "encoder")
    samples = random_batches(data, CONTACTS, CLEAN)
    encoded = encode_batches(frozen(encoder), samples)
    predicted = predict_with_heads(heads.eval(), encoded, samples)
    scores = score_classes(predicted.classes, encoded.classes)
    assert min(scores.accuracy.values()) >= 0.9
    talker = Talker(load_tac3d_llm(trained))
    states = [s for batch in samples for s in batch.states]
    points = np.concatenate([batch.points for batch in samples])
    replies = [talker.reply(p, "Describe the contact.") for p in points]
    assert (
        np.mean([s.text == caption(state) for s, state in zip(replies, states, strict=True)]) > 0.7
    )
    firm = [talker.reply(p, "Hold it firmly.").action for p in points]
    gentle = [talker.reply(p, "Hold it gently.").action for p in points]
    deep = [state.depth_mm > 0.3 for state in states]
    when_firm = ["<none>" if d else "<increase_force>" for d in deep]
    when_gentle = ["<decrease_force>" if d else "<none>" for d in deep]
    assert np.mean([a == b for a, b in zip(firm, when_firm, strict=True)]) > 0.8
    assert np.mean([a == b for a, b in zip(gentle, when_gentle, strict=True)]) > 0.8


def test_shuffled_labels_do_not_generalise(
    data_dir: Path, trained: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "w"
    (folder / "clip").parent.mkdir(parents=True)
    (folder / "clip").symlink_to(trained / "clip")
    data, shuffled_data = (ContactDataset(data_dir, split=Split.TRAIN) for _ in range(2))
    order = np.random.default_rng([0, 99]).permutation(len(data))
    monkeypatch.setattr(shuffled_data, "state", lambda index: data.state(int(order[index])))
    monkeypatch.setattr(TrainingRun, "dataset", lambda *_: shuffled_data)
    run = TrainingRun(data=data_dir, out=folder)
    train_cltp(run, TINY, schedule(100, CONTACTS), augmentation=CLEAN)
    encoder, heads = load_encoder(folder / "encoder")
    samples = random_batches(data, CONTACTS, CLEAN)
    encoded = encode_batches(frozen(encoder), samples)
    predicted = predict_with_heads(heads.eval(), encoded, samples)
    shuffled = score_classes(predicted.classes, encoded.classes)
    assert shuffled.accuracy["shape"] < 0.5  # against the true labels


def test_training_that_starts_from_weights_begins_where_they_ended(
    data_dir: Path, trained: Path, tmp_path: Path
) -> None:
    run = TrainingRun(data=data_dir, out=tmp_path)
    shutil.copytree(trained / "clip", tmp_path / "clip")
    slow = schedule(1, CONTACTS, 1e-9)
    train_cltp(run, TINY, slow, augmentation=CLEAN, start=trained / "encoder")
    words = Words.load(trained / "lm")
    train_llm(run, words, FakeLessons(), {"joint": slow}, augmentation=CLEAN, start=trained)
    begun, own = ((folder / "lm" / "config.json").read_text() for folder in (trained, tmp_path))
    assert own == begun
    before, after = (load_tac3d_llm(folder).state_dict() for folder in (trained, tmp_path))
    assert before.keys() == after.keys()
    assert all(torch.allclose(before[name], after[name], atol=1e-5) for name in before)


def test_a_language_model_is_trained_on_behind_a_new_projector(
    data_dir: Path, trained: Path, tmp_path: Path
) -> None:
    run = TrainingRun(data=data_dir, out=tmp_path)
    shutil.copytree(trained / "encoder", tmp_path / "encoder")
    words, slow = Words.load(trained / "lm"), schedule(1, CONTACTS, 1e-9)
    train_llm(run, words, FakeLessons(), {"joint": slow}, augmentation=CLEAN, language=trained)
    before, after = (load_tac3d_llm(folder).state_dict() for folder in (trained, tmp_path))
    changed = [name for name in before if not torch.allclose(before[name], after[name], atol=1e-5)]
    assert changed and all("projector" in name for name in changed)


def test_an_encoder_of_other_sizes_can_not_be_trained_on(
    data_dir: Path, trained: Path, tmp_path: Path
) -> None:
    run = TrainingRun(data=data_dir, out=tmp_path)
    shutil.copytree(trained / "clip", tmp_path / "clip")
    with pytest.raises(TouchError, match="--preset"):
        train_cltp(run, PRESETS["small"], schedule(1, 12), start=trained / "encoder")


def test_scores_without_training_exist_too(trained: Path, data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TEST)
    samples = random_batches(data, 6, NOISY)
    encoder, _ = load_encoder(trained / "encoder")
    encoded = encode_batches(frozen(encoder), samples)
    prompts = ClassPrompts(load_clip(trained / "clip"))
    assert score_classes(best_classes(prompts.cosines(encoded.feature)), encoded.classes).count == 6
    direct = score_classes(predict_geometrically(samples).classes, encoded.classes)
    assert direct.accuracy["depth"] >= 0.5
    assert direct.accuracy["shape"] == 0.0  # nothing computes a shape directly


def test_training_goes_on_where_it_was_stopped(data_dir: Path, tmp_path: Path) -> None:
    def stage(folder: Path) -> tuple[Stage, torch.nn.Linear]:
        torch.manual_seed(0)
        model = torch.nn.Linear(3, 1)
        return Stage("s", run_in(folder, 0), model, schedule(30, 1), {}), model

    def losses(model: torch.nn.Linear):  # type: ignore[no-untyped-def]
        def of(step: int) -> dict[str, torch.Tensor]:
            x = torch.randn(8, 3, generator=torch.Generator().manual_seed(step))
            return {"loss": ((model(x) - x.sum(1, keepdim=True)) ** 2).mean()}

        return of

    whole, model = stage(tmp_path / "whole")
    whole.train(losses(model))
    first, cut = stage(tmp_path / "cut")

    def stopped(step: int) -> dict[str, torch.Tensor]:
        if step == 13:
            first.save()
        if step == 17:
            raise KeyboardInterrupt
        return losses(cut)(step)

    with pytest.raises(KeyboardInterrupt):
        first.train(stopped)
    second, resumed = stage(tmp_path / "cut")
    assert second.step == 13
    second.train(losses(resumed))
    torch.testing.assert_close(resumed.weight, model.weight, rtol=0, atol=0)


def test_a_checkpoint_of_another_training_is_refused(tmp_path: Path) -> None:
    model = torch.nn.Linear(2, 1)
    Stage("s", run_in(tmp_path, 0), model, schedule(3, 1), {}).save()
    with pytest.raises(TouchError, match="another training: seed 0 instead of 1; delete it"):
        Stage("s", run_in(tmp_path, 1), model, schedule(3, 1), {})
    with pytest.raises(TouchError, match="another training: steps 3 instead of 5; delete it"):
        Stage("s", run_in(tmp_path, 0), model, schedule(5, 1), {})


def test_a_damaged_checkpoint_is_called_so_without_torchs_words(tmp_path: Path) -> None:
    model, path = torch.nn.Linear(2, 1), tmp_path / ".training" / "s.checkpoint"
    Stage("s", run_in(tmp_path, 0), model, schedule(3, 1), {}).save()
    whole = path.read_bytes()
    packed = io.BytesIO()
    torch.save({"step": 1}, packed)
    for content in (b"", b"half", whole[: len(whole) // 2], packed.getvalue()):
        path.write_bytes(content)
        with pytest.raises(TouchError) as caught:
            Stage("s", run_in(tmp_path, 0), model, schedule(3, 1), {})
        assert str(caught.value) == (
            f"checkpoint {path} is damaged; delete it, and the same command starts the stage s "
            "afresh"
        )


def test_a_loss_that_is_not_finite_stops_the_stage(tmp_path: Path) -> None:
    model = torch.nn.Linear(2, 1)
    stage = Stage("s", run_in(tmp_path), model, schedule(3, 1), {})
    with pytest.raises(TouchError, match="learning rate"):
        stage.train(lambda step: {"loss": model.weight.sum() * float("nan")})


def test_a_finished_training_is_not_repeated(trained: Path, data_dir: Path) -> None:
    before = (trained / "encoder" / "model.safetensors").stat().st_mtime_ns
    run = TrainingRun(data=data_dir, out=trained)
    train_cltp(run, TINY, schedule(FEW_STEPS["encoder"], CONTACTS), augmentation=CLEAN)
    assert (trained / "encoder" / "model.safetensors").stat().st_mtime_ns == before


def test_loaded_weights_say_the_same(trained: Path) -> None:
    points = torch.rand(1, 1024, 3)
    one, two = load_tac3d_llm(trained), load_tac3d_llm(trained)
    torch.testing.assert_close(one.touch(points), two.touch(points), rtol=0, atol=0)


@pytest.mark.parametrize(
    ("part", "file"),
    [("encoder", "model.safetensors"), ("projector", "config.json"), ("lm", "tokenizer.json")],
)
def test_missing_weights_are_named(trained: Path, tmp_path: Path, part: str, file: str) -> None:
    shutil.copytree(trained, tmp_path / "w", ignore=shutil.ignore_patterns(".training"))
    (tmp_path / "w" / part / file).unlink()
    with pytest.raises(TouchError, match=file):
        load_tac3d_llm(tmp_path / "w")


def test_truncated_and_mismatched_weights_are_refused(trained: Path, tmp_path: Path) -> None:
    folder = tmp_path / "w"
    shutil.copytree(trained, folder, ignore=shutil.ignore_patterns(".training"))
    save_encoder(folder / "encoder", TactileEncoder(EncoderConfig(dim=24, heads=2, depth=1)),
                 StateHeads(48))  # fmt: skip
    with pytest.raises(WeightsError, match="joins widths"):
        load_tac3d_llm(folder)
    weights = folder / "encoder" / "model.safetensors"
    weights.write_bytes(weights.read_bytes()[:500])
    with pytest.raises(WeightsError, match="damaged"):
        load_tac3d_llm(folder)


def test_a_tokenizer_of_another_training_is_refused(trained: Path, tmp_path: Path) -> None:
    shutil.copytree(trained, tmp_path / "w", ignore=shutil.ignore_patterns(".training"))
    Words.train(["other words for another model"] * 5, size=300).save(tmp_path / "w" / "lm")
    with pytest.raises(WeightsError, match="not the one"):
        load_tac3d_llm(tmp_path / "w")


def test_the_shipped_sizes_stay_within_twenty_megabytes(tmp_path: Path) -> None:
    from cltp.checkpoints.tac3d_llm import save_pretrained, save_tac3d_llm
    from cltp.encoder.clip_towers import small_clip
    from cltp.llm.causal_lm import Language, small_lm
    from cltp.llm.tac3d_llm import Projector, Tac3dLlm

    words = Words.train(["a few words"] * 3, size=1024)
    encoder = TactileEncoder(EncoderConfig())
    save_encoder(tmp_path / "encoder", encoder, StateHeads(2 * encoder.config.dim))
    save_pretrained(tmp_path / "clip", small_clip(words), words)
    language = Language(small_lm(words), words=words)
    save_tac3d_llm(
        tmp_path,
        Tac3dLlm(
            encoder,
            StateHeads(2 * encoder.config.dim),
            Projector(encoder.config.dim, 192),
            language,
        ),
    )
    assert size_bytes(tmp_path) < 20e6


def test_noise_is_drawn_anew_in_every_step(data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TRAIN)
    sampler = Sampler(data, Augmentation(mirror=False), seed=0)
    one, two = (sampler.batch(np.array([0]), step).points[0, :, 2] for step in (0, 1))
    assert np.abs(one - two).std() > 0.005
