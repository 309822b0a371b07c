import dataclasses
import json
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from cltp.data.contact import Gel, Split, pack_heights, unpack_heights
from cltp.data.dataset import SCHEMA, ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.errors import TouchError
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import NO_CONTACT_STATE
from tests.fakes.fake_contacts import fake_contact


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    with DatasetWriter(tmp_path / "data", shard_size=4, about={"seed": "0"}) as writer:
        for seed in range(10):
            writer.add(fake_contact(seed, split=Split.TEST if seed >= 7 else Split.TRAIN))
    return tmp_path / "data"


def test_what_is_written_is_read_again(folder: Path) -> None:
    dataset = ContactDataset(folder)
    assert len(dataset) == 10
    for seed in range(10):
        stored, made = dataset.contact(seed), fake_contact(seed)
        np.testing.assert_allclose(stored.height_mm, made.height_mm, atol=0.00051)
        assert stored.state.shape is made.state.shape
        assert stored.state.cut == made.state.cut
        assert stored.state.force_n == pytest.approx(made.state.force_n, rel=1e-6)
        assert (stored.object, stored.series) == (made.object, made.series)
        assert stored.gel is None


def test_a_split_holds_only_its_contacts(folder: Path) -> None:
    test = ContactDataset(folder, split=Split.TEST)
    assert list(test.column("seed")) == [7, 8, 9]
    np.testing.assert_allclose(test.height_mm(1), fake_contact(8).height_mm, atol=0.00051)
    with pytest.raises(TouchError, match="no contacts of the split"):
        ContactDataset(folder, split=Split.VALIDATION)


def test_further_sets_come_after_the_first(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    with DatasetWriter(other, shard_size=2) as writer:
        for seed in range(20, 25):
            writer.add(fake_contact(seed, split=Split.TEST if seed == 21 else Split.TRAIN))
    both = ContactDataset(folder, split=Split.TRAIN, also=[other])
    assert list(both.column("seed")) == [0, 1, 2, 3, 4, 5, 6, 20, 22, 23, 24]
    np.testing.assert_allclose(both.height_mm(8), fake_contact(22).height_mm, atol=0.00051)
    assert both.state(10).shape is fake_contact(24).state.shape
    alone = ContactDataset(folder, split=Split.TRAIN)
    assert both.checksum() not in (alone.checksum(), ContactDataset(other).checksum())
    assert alone.checksum() == ContactDataset(folder).checksum()
    with pytest.raises(TouchError, match=r"nowhere is no data set"):
        ContactDataset(folder, also=[tmp_path / "nowhere"])


def test_a_contact_without_touch_and_with_a_gel_survives(tmp_path: Path) -> None:
    gel = Gel(thickness_mm=3.5, young_mpa=0.145, poisson=0.48)
    contact = dataclasses.replace(
        fake_contact(5), sensor=SENSORS["digit"], state=NO_CONTACT_STATE, gel=gel
    )
    with DatasetWriter(tmp_path) as writer:
        writer.add(contact)
    stored = ContactDataset(tmp_path).contact(0)
    assert stored.state == NO_CONTACT_STATE
    assert stored.gel is not None
    assert stored.gel.thickness_mm == pytest.approx(3.5)
    assert stored.sensor.name == "digit"


@given(npst.arrays(np.float32, (9, 11), elements=st.floats(-32.0, 32.0, width=32, allow_nan=False)))
def test_any_heights_come_back_within_half_a_step(heights: np.ndarray) -> None:
    back = unpack_heights(pack_heights(heights), 9, 11)
    np.testing.assert_allclose(back, heights, atol=0.00051)


def test_smooth_contacts_take_less_than_half_of_their_raw_size() -> None:
    heights = fake_contact(1).height_mm
    assert len(pack_heights(heights)) < heights.size  # raw int16 would be two bytes each


def test_an_interrupted_writer_leaves_whole_shards_and_is_continued(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), DatasetWriter(tmp_path, shard_size=4) as writer:
        for seed in range(6):
            writer.add(fake_contact(seed))
        raise KeyboardInterrupt
    assert writer.num_written == 4
    assert len(ContactDataset(tmp_path)) == 4
    (tmp_path / "shard-0-00001.heights").write_bytes(b"half")  # killed before its index was there
    with DatasetWriter(tmp_path, shard_size=4) as writer:
        writer.add(fake_contact(9))
    dataset = ContactDataset(tmp_path)
    np.testing.assert_allclose(dataset.height_mm(4), fake_contact(9).height_mm, atol=0.00051)


def test_two_parts_write_into_one_folder(tmp_path: Path) -> None:
    with DatasetWriter(tmp_path, part="a") as a, DatasetWriter(tmp_path, part="b") as b:
        a.add(fake_contact(1))
        b.add(fake_contact(2))
    assert sorted(ContactDataset(tmp_path).column("seed")) == [1, 2]


def test_the_checksum_names_the_data(folder: Path, tmp_path: Path) -> None:
    before = ContactDataset(folder).checksum()
    assert before == ContactDataset(folder).checksum()
    with DatasetWriter(folder) as writer:
        writer.add(fake_contact(99))
    assert ContactDataset(folder).checksum() != before


def test_damaged_heights_are_refused(folder: Path) -> None:
    path = folder / "shard-0-00000.heights"
    data = bytearray(path.read_bytes())
    data[len(data) // 8] ^= 0xFF
    path.write_bytes(data)
    dataset = ContactDataset(folder)
    with pytest.raises(TouchError, match="damaged"):
        for index in range(4):
            dataset.height_mm(index)


def test_truncated_heights_and_a_foreign_index_are_refused(folder: Path) -> None:
    path = folder / "shard-0-00000.heights"
    path.write_bytes(path.read_bytes()[:-10])
    with pytest.raises(TouchError, match="bytes where"):
        ContactDataset(folder)
    (folder / "shard-0-00000.parquet").write_bytes(b"nothing of ours")
    with pytest.raises(TouchError, match="damaged or incomplete"):
        ContactDataset(folder)


def test_other_folders_and_versions_are_refused(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(TouchError, match=r"dataset\.json is missing"):
        ContactDataset(tmp_path)
    (tmp_path / "empty.yaml").write_text("")
    with pytest.raises(TouchError, match=r"empty\.yaml is a file; expected the folder"):
        ContactDataset(tmp_path / "empty.yaml")
    header = json.loads((folder / "dataset.json").read_text())
    (folder / "dataset.json").write_text(json.dumps({**header, "version": 99}))
    with pytest.raises(TouchError, match="version 99"):
        ContactDataset(folder)
    with pytest.raises(TouchError, match="version 99"):
        DatasetWriter(folder)


@pytest.mark.parametrize("about", [3, {"contacts": "many"}, {"contacts": None}])
def test_a_header_that_makes_no_sense_is_damage(about: object, folder: Path) -> None:
    header = json.loads((folder / "dataset.json").read_text())
    (folder / "dataset.json").write_text(json.dumps({**header, "about": about}))
    with pytest.raises(TouchError, match=r"dataset\.json is damaged"):
        ContactDataset(folder)


@pytest.mark.parametrize(
    ("heights", "message"),
    [
        (np.full((10, 10), np.nan), "NaN"),
        (np.zeros((10,)), "shape"),
        (np.full((10, 10), 300.0), "µm"),
    ],
)
def test_heights_that_are_none_are_refused(heights: np.ndarray, message: str) -> None:
    with pytest.raises(TouchError, match=message):
        dataclasses.replace(fake_contact(0), height_mm=heights)


def test_what_was_measured_is_marked_and_shards_without_the_mark_keep_their_columns(
    tmp_path: Path,
) -> None:
    given, marked = fake_contact(1), fake_contact(2)
    marked = dataclasses.replace(marked, measured=frozenset({"depth", "depth_mm"}))
    with DatasetWriter(tmp_path, shard_size=1) as writer:
        writer.add(given)
        writer.add(marked)
        writer.add(dataclasses.replace(given, unsure=frozenset({"shape"})))
    data = ContactDataset(tmp_path)
    assert [data.contact(i).measured for i in range(3)] == [set(), {"depth", "depth_mm"}, set()]
    assert [data.contact(i).unsure for i in range(3)] == [None, None, {"shape"}]
    columns = [pq.read_schema(path).names for path in sorted(tmp_path.glob("*.parquet"))]
    assert columns[0] == SCHEMA.names
    assert columns[1] == [*SCHEMA.names, "measured"]
    assert columns[2] == [*SCHEMA.names, "unsure", "approach_mm", "peak_kpa", "force_factor"]


def test_a_force_is_read_as_that_of_the_nominal_gel(tmp_path: Path) -> None:
    contact = fake_contact(1)
    with DatasetWriter(tmp_path) as writer:
        writer.add(dataclasses.replace(contact, unsure=frozenset(), force_factor=0.6))
        writer.add(contact)
    data = ContactDataset(tmp_path)
    assert [data.contact(i).force_factor for i in range(2)] == [pytest.approx(0.6), None]
    forces = [data.nominal_state(i).force_n for i in range(2)]
    assert forces == pytest.approx([contact.state.force_n / 0.6, contact.state.force_n])


def test_a_force_factor_that_is_none_is_refused() -> None:
    with pytest.raises(TouchError, match="force_factor"):
        dataclasses.replace(fake_contact(0), force_factor=0.0)
