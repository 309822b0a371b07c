"""Evaluation splits, features, probes, intervals, prompts and retrieval on known answers."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.frozen import frozen
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import CLEAN, NOISY, Sampler
from cltp.encoder.clip_towers import Towers, small_clip
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.errors import TouchError
from cltp.evaluation import probes
from cltp.evaluation.features import (
    EncodedContacts,
    encode_contacts,
    numbered_batches,
    selected_rows,
)
from cltp.evaluation.geometric_baseline import predict_geometrically
from cltp.evaluation.heights_alone import HeightsAlone
from cltp.evaluation.probes import ClassProbes, NumberProbe, ProbeTraining, score_intervals
from cltp.evaluation.retrieval import nearest_contacts, nearest_texts, score_retrieval
from cltp.evaluation.scores import best_classes, score_classes
from cltp.evaluation.splits import EVALUATION_SPLITS, evaluation_splits
from cltp.evaluation.zero_shot import ClassPrompts
from cltp.tactile.states import CLASSES, NUMBERS
from cltp.texts.captions import caption
from cltp.texts.paraphrases import prompts, unseen_prompts
from cltp.texts.tokenizer import Words
from cltp.train.recipes import Schedule
from cltp.train.text_targets import class_numbers
from tests.fakes.fake_contacts import fake_contact, write_contacts

QUICK = ProbeTraining(schedule=Schedule(steps=150, batch_size=64, learning_rate=3e-3))
SMALL = EncoderConfig(dim=24, depth=1, heads=2, stem_dim=8, feature_dim=32)


pytestmark = pytest.mark.usefixtures("one_thread")


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    seeds = {Split.TRAIN: range(10), Split.TEST: range(100, 107)}
    return write_contacts(tmp_path_factory.mktemp("data"), seeds)


def synthetic(size: int, seed: int, *, numbers_alone: bool = False) -> EncodedContacts:
    """Features that hold classes and numbers, the numbers with noise of a stated size."""
    rng = torch.Generator().manual_seed(seed)
    sizes = [len(names) for names in CLASSES.values()]
    classes = torch.stack([torch.randint(n, (size,), generator=rng) for n in sizes], dim=1)
    numbers = torch.rand(size, len(NUMBERS), generator=rng) * torch.tensor([1.0, 8, 6, 0.3, 2])
    noise = torch.where(torch.rand(size, 1, generator=rng) < 0.5, 0.02, 0.4)
    encoded = numbers * (1 + noise * torch.randn(size, len(NUMBERS), generator=rng))
    one_hot = [torch.nn.functional.one_hot(classes[:, n], c) for n, c in enumerate(sizes)]
    held = [encoded, noise] if numbers_alone else [*one_hot, encoded, noise]
    pooled = torch.cat(held, dim=1).float()
    return EncodedContacts(pooled, pooled, classes, numbers, torch.arange(size))


def test_a_data_set_has_the_evaluation_splits_of_its_contacts(data_dir: Path) -> None:
    assert [split.name for split in evaluation_splits(data_dir)] == ["contact", "contact_noisy"]
    assert {split.name for split in EVALUATION_SPLITS} >= {"contact", "object", "physics"}
    with pytest.raises(TouchError, match="it has contact, contact_noisy"):
        evaluation_splits(data_dir, ("object",))


def test_an_encoder_sees_a_contact_once(data_dir: Path, tmp_path: Path) -> None:
    torch.manual_seed(0)
    encoder = frozen(TactileEncoder(SMALL))
    data = ContactDataset(data_dir, split=Split.TEST)
    first = encode_contacts(encoder, data, NOISY, views=2, cache=tmp_path)
    assert len(first) == 14
    assert not torch.equal(first.pooled[:7], first.pooled[7:])
    stored = list(tmp_path.rglob("*.safetensors"))
    times = [path.stat().st_mtime_ns for path in stored]
    again = encode_contacts(encoder, data, NOISY, views=2, cache=tmp_path)
    torch.testing.assert_close(again.pooled, first.pooled, rtol=0, atol=0)
    assert [path.stat().st_mtime_ns for path in stored] == times
    encode_contacts(encoder, data, CLEAN, cache=tmp_path)
    assert len(list(tmp_path.rglob("*.safetensors"))) == len(stored) + 1
    stored[0].write_bytes(b"half")
    with pytest.raises(TouchError, match="delete the file"):
        encode_contacts(encoder, data, NOISY, views=2, cache=tmp_path)


def test_the_geometric_baseline_is_computed_from_the_same_contacts(data_dir: Path) -> None:
    data = ContactDataset(data_dir, split=Split.TEST)
    rows = selected_rows(len(data))
    batches = [batch for batch, _ in numbered_batches(Sampler(data, CLEAN), rows)]
    predicted = predict_geometrically(batches).classes
    encoded = encode_contacts(frozen(TactileEncoder(SMALL)), data, CLEAN)
    labels = class_numbers([state for batch in batches for state in batch.states])
    torch.testing.assert_close(labels, encoded.classes)
    assert (predicted[:, :2] == -1).all()
    assert score_classes(predicted, encoded.classes).accuracy["depth"] >= 0.5


def test_classes_are_scored_where_they_have_labels() -> None:
    truth = torch.tensor([[0, 1, 2, 3, 4], [0, -1, 2, 3, 4], [1, -1, 2, 3, 4]])
    predicted = torch.tensor([[0, 1, 2, 3, 0], [2, 1, 2, 0, 0], [1, -1, 2, 3, 0]])
    found = score_classes(predicted, truth)
    assert found.accuracy["shape"] == pytest.approx(2 / 3)
    assert found.accuracy["texture"] == 1.0
    assert found.accuracy["area"] == 0.0
    assert found.confusion["shape"][0].tolist()[:3] == [1, 0, 1]
    assert int(found.confusion["position"].sum()) == 3
    assert math.isnan(score_classes(predicted, torch.full((3, 5), -1)).accuracy["depth"])


def test_probes_read_what_is_there_and_nothing_from_noise() -> None:
    probes = ClassProbes(synthetic(800, 1), QUICK)
    other = synthetic(300, 2)
    assert (
        min(
            score_classes(
                best_classes(probes.probabilities(other)), other.classes
            ).accuracy.values()
        )
        > 0.95
    )
    blind = synthetic(800, 1)
    blind = EncodedContacts(
        torch.randn(800, 20), blind.feature, blind.classes, blind.numbers, blind.index
    )
    hidden = dataclasses.replace(other, pooled=torch.randn(300, 20))
    found = score_classes(
        best_classes(ClassProbes(blind, QUICK).probabilities(hidden)), hidden.classes
    ).accuracy
    assert found["depth"] < 0.4  # four classes: 25 % by chance


def test_features_that_are_not_finite_are_named() -> None:
    encoded = synthetic(20, 1)
    encoded.pooled[7, 3] = torch.nan
    with pytest.raises(TouchError, match=r"contacts \[7\] are not finite"):
        ClassProbes(encoded, QUICK)


def test_intervals_hold_nine_tenths_and_are_wide_where_noise_is() -> None:
    long = ProbeTraining(schedule=Schedule(steps=600, batch_size=128, learning_rate=3e-3))
    objects = torch.arange(5000) % 10
    probe = NumberProbe(synthetic(5000, 1, numbers_alone=True), objects, long)
    scale = probe.calibrate(synthetic(1000, 2, numbers_alone=True))
    other = synthetic(2000, 3, numbers_alone=True)
    intervals = probe.intervals(other, scale)
    scores = score_intervals(intervals, other)
    for name in ("depth", "position", "area", "force"):
        assert 86 < scores[f"coverage_{name}"] < 94
    depth, radius = intervals.high[:, 0] - intervals.low[:, 0], intervals.position_mm
    touching = other.classes[:, 2] >= 0
    assert scores["width_depth"] == pytest.approx(float(depth[touching].median()))
    assert scores["width_position"] == pytest.approx(2 * float(radius[touching].median()))
    assert scores["force_percent"] < 40  # always saying 1 N is about 50 % off
    width, noise = intervals.high[:, 0] - intervals.low[:, 0], other.pooled[:, -1]
    assert width[noise > 0.2].median() > 1.5 * width[noise < 0.2].median()
    other.pooled[:, :-1] *= 6  # far from all that was learned, noise as before
    strange = probe.intervals(other, scale)
    widths = [(i.high - i.low)[:, 3].median() for i in (strange, intervals)]
    assert widths[0] > 2 * widths[1]


def test_members_leave_out_objects_and_one_object_alone_is_learned() -> None:
    encoded = synthetic(200, 1, numbers_alone=True)
    alone = NumberProbe(encoded, torch.zeros(200), QUICK)
    several = NumberProbe(encoded, torch.arange(200) // 20, QUICK)
    for probe in (alone, several):
        intervals = probe.intervals(encoded, probe.calibrate(encoded))
        assert torch.isfinite(intervals.value).all()
        assert (intervals.low < intervals.high).all()


@pytest.mark.parametrize("count", [5, 7])
def test_every_object_is_left_out_by_one_member(
    count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    learned: list[set[int]] = []
    objects = torch.arange(40 * count) // 40
    encoded = synthetic(40 * count, 1, numbers_alone=True)
    whole = probes._train_member

    def noted(encoded: EncodedContacts, rows: torch.Tensor, *rest: object) -> object:
        learned.append(set(objects[rows].tolist()))
        return whole(encoded, rows, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(probes, "_train_member", noted)
    NumberProbe(encoded, 100 + 3 * objects, QUICK)
    assert len(learned) == probes.MEMBERS
    for one in range(count):
        assert sum(one in known for known in learned) == probes.MEMBERS - 1


@pytest.fixture(scope="module")
def towers() -> Towers:
    torch.manual_seed(2)
    every = [
        text for slot, names in CLASSES.items() for name in names for text in prompts(slot, name)
    ]
    words = Words.train(every * 2, 500)
    return Towers(small_clip(words, dim=32, layers=1), words)


def test_each_unseen_wording_is_scored_by_itself(towers: Towers) -> None:
    features = towers.texts([unseen_prompts("area", word)[2] for word in CLASSES["area"]])
    column = list(CLASSES).index("area")
    cosines = ClassPrompts(towers, "unseen").cosines(features)[column]
    assert cosines.shape == (3 * 5, 5)
    assert cosines[10:].argmax(1).tolist() == list(range(5))  # the third wording's own
    assert cosines[10:].diag().min() > 0.999 > cosines[:5].diag().max()


@pytest.mark.parametrize("prompting", ["single", "ensemble"])
def test_a_feature_that_is_a_prompt_is_its_class(towers: Towers, prompting: str) -> None:
    chosen = slice(0, 1) if prompting == "single" else slice(None)
    features = [
        torch.nn.functional.normalize(
            towers.texts(prompts("position", word)[chosen]).mean(0), dim=0
        )
        for word in CLASSES["position"]
    ]
    found = ClassPrompts(towers, prompting)
    column = list(CLASSES).index("position")
    assert best_classes(found.cosines(3 * torch.stack(features)))[:, column].tolist() == list(
        range(9)
    )
    assert found.cosines(torch.stack(features))[column].amax(1).min() > 0.999


def test_contacts_and_captions_find_each_other(towers: Towers) -> None:
    captions = [caption(fake_contact(seed).state) for seed in range(8)]
    captions.append(captions[0])
    feature = towers.texts(captions)
    nothing = torch.zeros(9, 5)
    encoded = EncodedContacts(feature, feature, nothing.long(), nothing, torch.arange(9))
    found = score_retrieval(towers, encoded, captions)
    assert found["captions"] == len(set(captions))
    assert found["contact_to_text_1"] == found["text_to_contact_1"] == 100.0
    turned = EncodedContacts(feature, feature.roll(1, 0), nothing.long(), nothing, torch.arange(9))
    assert score_retrieval(towers, turned, captions)["contact_to_text_1"] < 50
    assert nearest_contacts(towers, encoded, captions[3], 1)[0][0] == captions.index(captions[3])
    assert nearest_texts(towers, feature[5], sorted(set(captions)), 2)[0][0] == captions[5]
    assert np.isclose(nearest_texts(towers, feature[5], captions, 1)[0][1], 1.0, atol=1e-4)


def test_heights_alone_know_how_deep_and_not_where() -> None:
    points = torch.rand(2, 1024, 3)
    moved = points[:, torch.randperm(1024)] * torch.tensor([0.5, -1.0, 1.0])
    heights, _ = HeightsAlone().read(points)
    assert torch.equal(HeightsAlone().read(moved)[0], heights)
    assert torch.equal(heights[:, 0], points[..., 2].amax(1))
    assert torch.equal(heights[:, 63], points[..., 2].amin(1))
    # 60 grades of each of 16 heights add up to it, as far as it lies between 0 and 1.
    torch.testing.assert_close(heights[:, 64 : 64 + 60].sum(1) / 60, heights[:, 0])
    assert heights.shape == (2, 64 + 16 * 60)
