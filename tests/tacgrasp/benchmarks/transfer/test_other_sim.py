import csv
import json

import numpy as np
import pytest
import torch

from cltp.data.dataset import ContactDataset
from cltp.tactile.states import CLASSES
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.settings import OtherSimSettings
from tacgrasp.benchmarks.transfer import other_sim
from tacgrasp.benchmarks.transfer.foreign_contacts import from_folder, generated
from tacgrasp.benchmarks.transfer.other_sim import Labels, constant_answer, labels_of, scores
from tests.fakes.tiny_weights import MINI, bump, make_weights

SHAPE = list(CLASSES).index("shape")


def folder_with(tmp_path, rows, header=("file", "shape", "texture"), depth_mm=0.05):
    folder = tmp_path / "foreign"
    folder.mkdir()
    for number in range(len(rows)):
        np.save(folder / f"{number}.npy", bump(0, 0, depth_mm))
    with (folder / "labels.csv").open("w", newline="") as file:
        csv.writer(file).writerows([header, *rows])
    return folder


def test_scores_count_what_is_labelled_and_name_what_is_read_instead():
    classes = torch.full((4, 5), -1)
    classes[:3, SHAPE] = torch.tensor([0, 0, 1])
    answers = torch.zeros((4, 5), dtype=torch.long)
    labels = Labels(classes=classes, groups={"last two": np.array([False, False, True, True])})
    figures = scores(answers, labels)
    assert figures["shape"] == pytest.approx(200 / 3)
    assert figures["n"] == {"shape": 3, "texture": 0, "depth": 0, "position": 0, "area": 0}
    assert figures["texture"] is None
    low, high = figures["interval"]["shape"]
    assert 20 < low < figures["shape"] < high < 94
    assert figures["shape_by_group"] == {"last two": {"right": 0.0, "n": 1}}
    assert figures["shape_read_as"] == {"last two": {CLASSES["shape"][0]: 1}}
    assert constant_answer(classes)["shape"] == pytest.approx(200 / 3)


def test_the_benchmark_writes_figures_of_both_conditions_and_a_sheet(tmp_path, monkeypatch):
    monkeypatch.setattr(other_sim, "QUICK_CONTACTS", 6)
    figures_file, sheet = tmp_path / "figures.json", tmp_path / "sheet.png"
    settings = OtherSimSettings(
        weights=make_weights(tmp_path / "weights"),
        quick=True,
        json=figures_file,
        sheet=sheet,
        first_seed=19,
    )
    other_sim.run(settings)
    figures = json.loads(figures_file.read_text())
    assert figures["contacts"] == 6
    for condition in ("clean", "noisy"):
        for method in ("zero_shot", "heads"):
            assert all(0 <= figures[condition][method][name] <= 100 for name in CLASSES)
            assert figures[condition][method]["n"]["shape"] == 6
    assert figures["constant"]["shape"] == pytest.approx(100 / 6)
    assert sheet.read_bytes().startswith(b"\x89PNG")


def test_generated_contacts_are_the_same_bytes_again(tmp_path):
    sums = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        sums.append(generated(range(40, 43), "gelsight_mini", tmp_path / name).checksum())
    assert sums[0] == sums[1]


def test_a_table_of_shallow_heights_is_read_and_what_it_leaves_out_is_not_scored(tmp_path):
    folder = folder_with(tmp_path, [("0.npy", "sphere", "smooth"), ("1.npy", "dots", "")])
    data = from_folder(folder, MINI.name, tmp_path)
    labels = labels_of(data, np.arange(2))
    words = [CLASSES["shape"][code] for code in labels.classes[:, SHAPE].tolist()]
    assert words == ["sphere", "dots"]
    assert labels.classes[1, list(CLASSES).index("texture")] == -1
    assert (labels.classes[:, list(CLASSES).index("area")] == -1).all()
    assert labels.groups["below 0.15 mm"].all()


def test_stacked_heights_are_read_in_the_order_of_the_table(tmp_path):
    folder = folder_with(tmp_path, [("sphere",), ("dots",)], header=("shape",))
    heights = np.stack([bump(0, 0, 0.5), bump(0, 0, 0.9)])
    np.save(folder / "heights.npy", heights)
    data = from_folder(folder, MINI.name, tmp_path)
    assert data.column("shape").tolist() == ["sphere", "dots"]
    assert [data.height_mm(i).max() for i in range(2)] == pytest.approx([0.5, 0.9], abs=0.01)
    np.save(folder / "heights.npy", heights[:1])
    (tmp_path / "again").mkdir()
    with pytest.raises(UsageError, match=r"one map for each row of labels.csv, \(2, H, W\)"):
        from_folder(folder, MINI.name, tmp_path / "again")


def test_an_unknown_class_a_missing_file_and_an_empty_folder_are_one_line_each(tmp_path):
    folder = folder_with(tmp_path, [("0.npy", "blob", "smooth"), ("9.npy", "dots", "smooth")])
    with pytest.raises(UsageError, match="shape 'blob' is not one of sphere") as error:
        from_folder(folder, MINI.name, tmp_path)
    assert "9.npy" in str(error.value)
    assert "\n" not in str(error.value)
    empty = tmp_path / "empty"
    empty.mkdir()
    with pytest.raises(UsageError, match=r"neither dataset\.json .* nor labels\.csv"):
        from_folder(empty, MINI.name, tmp_path)


def test_the_test_split_of_a_data_set_is_taken(tmp_path):
    made = generated(range(19, 22), "gelsight_mini", tmp_path)
    read = from_folder(made.folder, MINI.name, tmp_path / "unused")
    assert isinstance(read, ContactDataset)
    assert len(read) == 3
