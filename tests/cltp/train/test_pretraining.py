"""Pre-training: killed and resumed, cached features, curves, workers, and batches that are bad."""

import dataclasses
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from unittest import mock

import numpy as np
import pytest
import torch

from cltp.checkpoints.tac3d_llm import load_encoder, save_pretrained
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import NOISY, Sampler
from cltp.encoder.clip_towers import Towers, small_clip
from cltp.encoder.encoder import PRESETS
from cltp.encoder.heads import targets
from cltp.errors import TouchError
from cltp.tactile.point_layout import GRID
from cltp.texts.tokenizer import Words
from cltp.train import distributed
from cltp.train.alignment import train_cltp
from cltp.train.clip_feature_cache import FrozenFeatures, rendered
from cltp.train.curves import CurveFile, plot_curves, read_curves, smoothed
from cltp.train.distributed import Workers, joined_workers
from cltp.train.finite_check import check_batch
from cltp.train.recipes import CltpRecipe, Schedule
from cltp.train.stage import TrainingRun
from tests.cltp.train.killed_training import train_a_little
from tests.fakes.fake_contacts import write_contacts
from tests.fakes.same_training import assert_same_curves, assert_same_weights
from tests.paths import ROOT

HERE = Path(__file__).resolve().parent
TINY = PRESETS["tiny"]


pytestmark = pytest.mark.usefixtures("one_thread")


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    seeds = {Split.TRAIN: range(12), Split.TEST: range(100, 103)}
    return write_contacts(tmp_path_factory.mktemp("data"), seeds)


@pytest.fixture(scope="module")
def towers_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    torch.manual_seed(5)
    folder = tmp_path_factory.mktemp("towers") / "clip"
    words = Words.train(["Contact at top-left. a smooth sphere object, pressed deep"] * 5, 400)
    save_pretrained(folder, small_clip(words, dim=32, layers=1), words)
    return folder


def towers_of(folder: Path) -> Towers:
    from cltp.checkpoints.tac3d_llm import load_clip

    return load_clip(folder)


def training(data: Path, weights: Path, last_step: int, steps: int = 16) -> subprocess.Popen[bytes]:
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "PYTHONPATH": f"{ROOT}:{HERE}"}
    script = [sys.executable, str(HERE / "killed_training.py")]
    arguments = [str(data), str(weights), str(last_step), str(steps)]
    return subprocess.Popen([*script, *arguments], env=environment)


def killed(data: Path, weights: Path, last_step: int) -> int:
    return training(data, weights, last_step).wait(200)


def assert_same_training(whole: Path, cut: Path) -> None:
    assert_same_weights(whole / "encoder/model.safetensors", cut / "encoder/model.safetensors")
    assert_same_curves(whole / ".training/cltp.csv", cut / ".training/cltp.csv")


KILLS, STEPS = 20, 400
"""Kills of the long test; steps of its training, more than are done between two kills."""


def killed_after_a_checkpoint(data: Path, weights: Path, wait_s: float) -> int:
    """Kill a training some time after it wrote a checkpoint of its own; the step it had reached."""
    checkpoint = weights / ".training" / "cltp.checkpoint"
    before_ns = checkpoint.stat().st_mtime_ns if checkpoint.exists() else 0
    with training(data, weights, -1, STEPS) as process:
        try:
            while not checkpoint.exists() or checkpoint.stat().st_mtime_ns == before_ns:
                assert process.poll() is None, "it ended by itself"
                time.sleep(0.005)
            time.sleep(wait_s)
        finally:
            process.kill()
    assert process.returncode == -signal.SIGKILL
    return int(torch.load(checkpoint, weights_only=True)["step"])


@pytest.mark.slow
def test_a_training_killed_twenty_times_ends_with_the_same_curve_and_weights(
    data_dir: Path, towers_dir: Path, tmp_path: Path
) -> None:
    for name in ("whole", "cut"):
        shutil.copytree(towers_dir, tmp_path / name / "clip")
    draw = random.Random(0)
    reached = [
        killed_after_a_checkpoint(data_dir, tmp_path / "cut", draw.uniform(0, 0.1))
        for _ in range(KILLS)
    ]
    assert reached == sorted(reached)
    assert 0 < reached[0] < reached[-1] < STEPS  # every resumption was in the middle
    for name in ("whole", "cut"):
        train_a_little(data_dir, tmp_path / name, steps=STEPS)
    assert_same_training(tmp_path / "whole", tmp_path / "cut")


@pytest.mark.slow
def test_a_training_killed_hard_ends_with_the_same_curve_and_weights(
    data_dir: Path, towers_dir: Path, tmp_path: Path
) -> None:
    for name in ("whole", "cut"):
        shutil.copytree(towers_dir, tmp_path / name / "clip")
    assert killed(data_dir, tmp_path / "cut", 10) == -signal.SIGKILL
    for name in ("whole", "cut"):
        train_a_little(data_dir, tmp_path / name)
    assert_same_training(tmp_path / "whole", tmp_path / "cut")
    curves = read_curves(tmp_path / "cut/.training/cltp.csv")
    assert curves["step"].tolist() == list(range(1, 17))
    assert {"t2l", "t2i", "prompt_shape", "temperature"} <= set(curves)
    assert (tmp_path / "cut/.training/cltp.png").read_bytes()[:4] == b"\x89PNG"


def test_without_images_and_heads_language_alone_is_learned(
    data_dir: Path, towers_dir: Path, tmp_path: Path
) -> None:
    schedule = Schedule(steps=2, batch_size=4, learning_rate=1e-3)
    recipe = CltpRecipe(texts="caption", prompt_weight=0.0, head_weight=0.0)
    run = TrainingRun(data=data_dir, out=tmp_path)
    train_cltp(run, TINY, schedule, recipe, with_images=False, clip_dir=towers_dir)
    assert set(read_curves(tmp_path / ".training/cltp.csv")) == {
        "step",
        "learning_rate",
        "t2l",
        "temperature",
    }


def test_a_grid_is_learned_and_its_intervals_are_set_by_validation_contacts(
    towers_dir: Path, tmp_path: Path
) -> None:
    seeds = {Split.TRAIN: range(12), Split.VALIDATION: range(200, 230)}
    data = write_contacts(tmp_path / "data", seeds)
    run = TrainingRun(data=data, out=tmp_path / "out")
    schedule = Schedule(steps=4, batch_size=12, learning_rate=1e-3)
    folder = train_cltp(run, PRESETS["tiny_grid"], schedule, clip_dir=towers_dir)
    encoder, heads = load_encoder(folder)
    assert encoder.config.variant.layout == GRID
    assert heads.has_intervals
    assert heads.widening is not None and (heads.widening != 1).all()
    sampler = Sampler(ContactDataset(data, split=Split.VALIDATION), layout=GRID)
    batch = sampler.batch(np.arange(len(sampler.dataset)), 0)
    read = heads.eval()(encoder.eval()(torch.from_numpy(batch.points)).pooled)
    assert read.margins is not None
    error = targets(batch.states).numbers - read.numbers
    held = (error >= -read.margins[..., 0]) & (error <= read.margins[..., 1])
    assert held.float().mean() > 0.75  # by the noise of these few contacts, not of those


def test_features_are_computed_once_and_read_again(
    data_dir: Path, towers_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data, towers = ContactDataset(data_dir, split=Split.TRAIN), towers_of(towers_dir)
    computed: list[int] = []
    for name in ("texts", "images"):
        encode = getattr(towers, name)
        monkeypatch.setattr(
            towers, name, lambda rows, encode=encode: computed.append(len(rows)) or encode(rows)
        )
    batch = Sampler(data, seed=3).numbered(8, 0)
    first = FrozenFeatures(towers, data, tmp_path)
    images, texts = first.images(batch), first.texts(["Contact is deep."])
    assert computed == [32, 1]  # eight contacts in a block of one size, and a text
    first.save()
    computed.clear()
    again = FrozenFeatures(towers, data, tmp_path)
    torch.testing.assert_close(again.images(batch), images, rtol=0, atol=0)
    torch.testing.assert_close(again.texts(["Contact is deep."]), texts, rtol=0, atol=0)
    assert not computed
    pixels = rendered(batch)  # mirrored by the sampler, not by us
    torch.testing.assert_close(towers.images(pixels), images, rtol=0, atol=1e-3)
    other = Sampler(data, seed=4).batch(batch.index, 0)
    same = torch.from_numpy((other.mirror == batch.mirror).all(axis=1))
    assert 0 < same.sum() < 8
    mirrored = again.images(other)
    torch.testing.assert_close(mirrored[same], images[same], rtol=0, atol=0)
    assert not torch.equal(mirrored[~same], images[~same])
    alone = FrozenFeatures(towers, data).images(other)  # with others in its block
    torch.testing.assert_close(alone, mirrored, rtol=0, atol=0)


def test_images_of_moved_contacts_are_those_of_where_they_came_to(
    data_dir: Path, towers_dir: Path
) -> None:
    data, towers = ContactDataset(data_dir, split=Split.TRAIN), towers_of(towers_dir)
    stayed, moved = (Sampler(data, seed=3, moved=share).numbered(8, 0) for share in (0.0, 1.0))
    assert moved.moved.all() and not stayed.moved.any()
    np.testing.assert_array_equal(moved.index, stayed.index)
    apart = [
        (one.x_mm, one.y_mm) != (other.x_mm, other.y_mm)
        for one, other in zip(moved.states, stayed.states, strict=True)
    ]
    assert sum(apart) >= 4  # some can't be moved, and half of these stay
    assert [s.shape for s in moved.states] == [s.shape for s in stayed.states]
    features = FrozenFeatures(towers, data)
    images = features.images(moved)
    assert not features._computed.any()  # nothing of them is kept
    torch.testing.assert_close(images, towers.images(rendered(moved)), rtol=0, atol=1e-5)
    half = dataclasses.replace(moved, moved=np.arange(8) < 4)
    torch.testing.assert_close(features.images(half)[:4], images[:4], rtol=0, atol=1e-5)
    torch.testing.assert_close(features.images(half)[4:], features.images(stayed)[4:])


@pytest.mark.parametrize(
    ("recipe", "told"),
    [
        (CltpRecipe(moved=0.5), r"moved 0\.5 instead of 0\.0"),
        (CltpRecipe(clean=0.5), r"clean 0\.5 instead of 0\.0"),
    ],
)
def test_contacts_that_are_felt_otherwise_are_another_training(
    data_dir: Path, towers_dir: Path, tmp_path: Path, recipe: CltpRecipe, told: str
) -> None:
    schedule = Schedule(steps=2, batch_size=4, learning_rate=1e-3)
    run = TrainingRun(data=data_dir, out=tmp_path)
    train_cltp(run, TINY, schedule, recipe, augmentation=NOISY, clip_dir=towers_dir)
    with pytest.raises(TouchError, match=f"training: {told};"):
        train_cltp(run, TINY, schedule, CltpRecipe(), augmentation=NOISY, clip_dir=towers_dir)


def test_a_recipe_says_how_many_contacts_are_felt_without_noise(
    data_dir: Path, towers_dir: Path, tmp_path: Path
) -> None:
    schedule = Schedule(steps=2, batch_size=4, learning_rate=1e-3)
    noiseless = dataclasses.replace(NOISY, clean=1.0)
    for name, recipe, noise in (
        ("said", CltpRecipe(clean=1.0), NOISY),
        ("noiseless", CltpRecipe(), noiseless),
        ("noisy", CltpRecipe(), NOISY),
    ):
        run = TrainingRun(data=data_dir, out=tmp_path / name)
        train_cltp(run, TINY, schedule, recipe, augmentation=noise, clip_dir=towers_dir)
    said, alike, other = (
        tmp_path / name / "encoder" / "model.safetensors" for name in ("said", "noiseless", "noisy")
    )
    assert_same_weights(said, alike)
    with pytest.raises(AssertionError):
        assert_same_weights(said, other)


@pytest.mark.parametrize("name", ["moved", "coarse", "clean"])
def test_what_is_no_fraction_is_refused(name: str) -> None:
    with pytest.raises(TouchError, match=f"{name} must be a fraction from 0 to 1, got 1.5"):
        CltpRecipe(**{name: 1.5})


def test_damaged_features_are_refused(data_dir: Path, towers_dir: Path, tmp_path: Path) -> None:
    data, towers = ContactDataset(data_dir, split=Split.TRAIN), towers_of(towers_dir)
    features = FrozenFeatures(towers, data, tmp_path)
    features.images(Sampler(data, seed=3).numbered(8, 0))
    features.save()
    (path,) = tmp_path.glob("features-*.safetensors")
    content = bytearray(path.read_bytes())
    content[-5] ^= 1
    path.write_bytes(content)
    with pytest.raises(TouchError, match="delete the file"):
        FrozenFeatures(towers, data, tmp_path)
    path.write_bytes(content[:50])
    with pytest.raises(TouchError, match="delete the file"):
        FrozenFeatures(towers, data, tmp_path)


def test_other_towers_have_features_of_their_own(
    data_dir: Path, towers_dir: Path, tmp_path: Path
) -> None:
    data, towers = ContactDataset(data_dir, split=Split.TRAIN), towers_of(towers_dir)
    for _ in range(2):
        features = FrozenFeatures(towers, data, tmp_path)
        features.texts(["Contact is deep."])
        features.save()
        with torch.no_grad():
            towers.clip.text_projection.weight.add_(0.1)
    assert len(list(tmp_path.glob("features-*.safetensors"))) == 2


def test_a_batch_that_is_not_finite_names_step_and_contacts(data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TRAIN)
    batch = Sampler(data, NOISY).batch(np.array([3, 7, 9]), 0)
    labels = targets(batch.states)
    check_batch("cltp", 12, data, batch, labels)
    points = batch.points.copy()
    points[1, 5, 2] = np.nan
    bad = dataclasses.replace(batch, points=points)
    with pytest.raises(TouchError, match=r"step 12 has points .* contacts 7 in"):
        check_batch("cltp", 12, data, bad, labels)
    labels.numbers[2, 0] = torch.inf
    with pytest.raises(TouchError, match=r"labels .* contacts 9 in"):
        check_batch("cltp", 12, data, batch, labels)


def test_rows_after_the_checkpoint_are_dropped(tmp_path: Path) -> None:
    path = tmp_path / "c.csv"
    curve = CurveFile(path, 0)
    for step in range(1, 6):
        curve.add(step, 0.1, {"loss": float(step), "temperature": 0.07})
    curve.flush()
    with path.open("a") as file:
        file.write("6,0.1,\n2\n")  # rows that a full disk cut off, and what followed
    curve = CurveFile(path, 3)
    curve.add(4, 0.1, {"loss": 40.0, "temperature": 0.07})
    curve.flush()
    assert read_curves(path)["loss"].tolist() == [1.0, 2.0, 3.0, 40.0]
    plot_curves(path, tmp_path / "c.png")
    assert (tmp_path / "c.png").stat().st_size > 1000
    with pytest.raises(TouchError, match="no curves"):
        read_curves(tmp_path / "none.csv")


def test_smoothing_is_a_mean_over_the_last_values() -> None:
    np.testing.assert_allclose(smoothed(np.array([2.0, 4.0, 6.0, 8.0]), 2), [2.0, 3.0, 5.0, 7.0])


def test_workers_share_a_batch_evenly() -> None:
    second = Workers(index=1, count=2)
    assert second.per_process(8) == 4
    assert [second.part(step) for step in range(3)] == [1, 3, 5]
    assert not second.is_first
    with pytest.raises(TouchError, match="can't be shared by 2"):
        second.per_process(7)
    with pytest.raises(TouchError, match="known: no, bf16"):
        joined_workers("fp8")


@pytest.mark.parametrize(("slowdown", "is_told"), [(12.9, True), (0.6, False)])
def test_bf16_that_the_processor_lacks_is_told(slowdown, is_told, monkeypatch, caplog) -> None:
    monkeypatch.setattr(distributed, "bf16_slowdown", lambda: slowdown)
    alone = mock.Mock(device=torch.device("cpu"), process_index=0, num_processes=1)
    monkeypatch.setattr("accelerate.Accelerator", lambda **_: alone)  # a process has only one
    joined_workers("bf16")
    assert ("--precision no is faster" in caplog.text) is is_told
    caplog.clear()
    joined_workers("no")
    assert not caplog.text


def test_the_slowdown_of_bf16_is_a_ratio_of_times() -> None:
    assert 0.01 < distributed.bf16_slowdown() < 1000


@pytest.mark.slow
def test_two_accelerated_processes_train_together(
    data_dir: Path, towers_dir: Path, tmp_path: Path
) -> None:
    shutil.copytree(towers_dir, tmp_path / "clip")
    code = (
        "import sys; from pathlib import Path; from cltp.encoder.encoder import PRESETS\n"
        "from cltp.train.alignment import train_cltp; from cltp.train.recipes import Schedule\n"
        "from cltp.train.stage import TrainingRun\n"
        "from cltp.train.distributed import joined_workers\n"
        "s = Schedule(steps=3, batch_size=8, learning_rate=1e-3)\n"
        "run = TrainingRun(data=Path(sys.argv[1]), out=Path(sys.argv[2]),\n"
        "                  workers=joined_workers('bf16'))\n"
        "train_cltp(run, PRESETS['tiny'], s)\n"
    )
    script = tmp_path / "together.py"
    script.write_text(code)
    launch = [sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node=2"]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
    subprocess.run(
        [*launch, str(script), str(data_dir), str(tmp_path)],
        env=environment,
        timeout=300,
        check=True,
    )
    assert read_curves(tmp_path / ".training/cltp.csv")["step"].tolist() == [1, 2, 3]
    assert (tmp_path / "encoder/model.safetensors").exists()
