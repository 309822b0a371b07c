"""``tacgrasp data inspect|stats|verify|gallery|sheet`` on a small set of contacts."""

import dataclasses
import json
import re

import pyarrow.parquet as pq
import pytest
from PIL import Image

from cltp.data.contact import Gel, Split
from cltp.data.dataset import ContactDataset
from cltp.tactile.states import Depth
from tacgrasp.__main__ import main
from tacgrasp.datasets.contact_sheet import draw_contacts
from tests.fakes.contact_samples import cap_contact, write_samples

NUM = 20


@pytest.fixture(scope="module")
def untouched(tmp_path_factory):
    contacts = [cap_contact(number) for number in range(NUM)]
    return write_samples(tmp_path_factory.mktemp("set") / "data", contacts)


def written(tmp_path, *contacts):
    return write_samples(tmp_path / "data", [*map(cap_contact, range(4)), *contacts])


def replaced(number, **labels):
    contact = cap_contact(number)
    return dataclasses.replace(contact, state=dataclasses.replace(contact.state, **labels))


def test_a_contact_is_shown_with_its_numbers_texts_and_picture(untouched, tmp_path, capsys):
    out = tmp_path / "one.png"
    assert main(["data", "inspect", str(untouched), "--contact", "3", "--out", str(out)]) == 0
    said = capsys.readouterr().out
    state = ContactDataset(untouched).state(3)
    assert f"{state.depth_mm:.3f} mm deep" in said
    assert f"pressed {state.depth} in {state.position}" in said
    for expected in (
        "This is a",
        "Contact is",
        "Contact at",
        "±",
        "How",
        "heights   48 × 64",
        "object    thing-1",
    ):
        assert expected in said
    with Image.open(out) as image:
        assert image.size[0] > 500


@pytest.mark.parametrize("number", ["-1", str(NUM)])
def test_a_contact_that_isn_t_there_is_refused_with_the_range(number, untouched, capsys):
    assert main(["data", "inspect", str(untouched), f"--contact={number}"]) == 2
    assert f"0 to {NUM - 1}" in capsys.readouterr().err


def test_stats_count_every_class_and_name_the_smallest(untouched, tmp_path, capsys):
    path = tmp_path / "stats.json"
    assert main(["data", "stats", str(untouched), "--json", str(path)]) == 0
    found = json.loads(path.read_text())
    data = ContactDataset(untouched)
    assert found["contacts"] == NUM
    for slot, counts in found["classes"].items():
        assert sum(counts.values()) == NUM
        for name, count in counts.items():
            assert count == sum(data.column(slot) == name)
    assert found["splits"] == {"train": 16, "test": 4}
    assert found["checksum"] == data.checksum()
    assert found["quantiles"]["depth_mm"]["p100"] == pytest.approx(
        data.column("depth_mm").max(), abs=1e-5
    )
    assert found["ambiguous"] is None
    said = capsys.readouterr().out
    assert "smallest class: " in said
    assert "0.00%, below the 1% that a class needs" in said


def test_a_good_set_verifies(untouched, capsys):
    assert main(["data", "verify", str(untouched)]) == 0
    assert f"{NUM} contacts checked, nothing wrong" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("contact", "message"),
    [
        (replaced(4, depth=Depth.VERY_DEEP), "depth is very deep, its numbers give"),
        (replaced(4, depth_mm=0.05, depth=Depth.SLIGHT), "depth is 0.050 mm, the heights reach"),
        (replaced(4, position=None), "depth, position and area must be"),
        (cap_contact(1, split=Split.TEST), "press thing-0 0 is in test, but in train"),
        (cap_contact(6, split=Split.OBJECT), "object thing-0 is in object, but in what is learned"),
        (cap_contact(4, split=Split.PHYSICS), "gel 3.6.* 0.49.* is in physics, but in what is"),
    ],
)
def test_what_is_wrong_with_a_row_is_said_with_file_and_row(contact, message, tmp_path, capsys):
    assert main(["data", "verify", str(written(tmp_path, contact))]) == 1
    said = capsys.readouterr().out
    assert re.search(rf"shard-0-00000\.parquet row 4: {message}", said)
    assert "5 contacts checked, 1 problem\n" in said


def test_splits_that_keep_their_promise_verify(tmp_path, capsys):
    folder = written(
        tmp_path,
        cap_contact(4, split=Split.OBJECT),
        cap_contact(8, split=Split.PHYSICS, gel=Gel(thickness_mm=4, young_mpa=0.1, poisson=0.47)),
    )
    assert main(["data", "verify", str(folder)]) == 0


def test_words_of_real_contacts_need_not_agree_with_what_was_measured(tmp_path):
    real = dataclasses.replace(replaced(4, depth=Depth.VERY_DEEP), gel=None)
    assert main(["data", "verify", str(written(tmp_path, real))]) == 0


def test_damage_is_found_and_named(tmp_path, capsys):
    folder = written(tmp_path)
    (folder / "shard-9-00000.heights.12.part").touch()
    (folder / "shard-9-00001.heights").touch()
    heights = folder / "shard-0-00000.heights"
    damaged = bytearray(heights.read_bytes())
    damaged[10] ^= 0xFF
    heights.write_bytes(damaged)
    assert main(["data", "verify", str(folder)]) == 1
    said = capsys.readouterr().out
    assert "shard-9-00000.heights.12.part: left by a writer" in said
    assert "shard-9-00001.heights: heights without an index" in said
    assert "shard-0-00000.heights: SHA-256 is" in said
    assert "shard-0-00000.parquet row 0: contact 0 in" in said
    assert "4 problems" in said


def test_words_outside_the_vocabulary_are_found(tmp_path, capsys):
    folder = written(tmp_path)
    path = folder / "shard-0-00000.parquet"
    table = pq.read_table(path)
    for column, value in (("shape", "blob"), ("cut", "under")):
        place = table.column_names.index(column)
        values = table[column].to_pylist()
        values[2] = value
        table = table.set_column(place, table.schema.field(column), [values])
    pq.write_table(table, path)
    assert main(["data", "verify", str(folder)]) == 1
    said = capsys.readouterr().out
    assert "row 2: shape 'blob' is not one of sphere, " in said
    assert "row 2: cut 'under' names unknown sides: under" in said


def test_a_set_with_contacts_missing_or_a_shard_torn_is_not_taken_for_whole(tmp_path, capsys):
    folder = written(tmp_path, *map(cap_contact, range(4, 12)))
    (folder / "shard-0-00001.parquet").unlink()
    assert main(["data", "verify", str(folder)]) == 1
    assert "expected 12 contacts, found 8" in capsys.readouterr().out
    (folder / "shard-0-00000.parquet").write_bytes(b"torn")
    assert main(["data", "verify", str(folder)]) == 1
    assert "shard-0-00000.parquet is damaged or incomplete" in capsys.readouterr().out


@pytest.mark.parametrize("command", ["inspect", "stats", "verify", "gallery", "sheet"])
def test_a_folder_that_is_no_data_set_is_wrong_use(command, tmp_path, capsys):
    assert main(["data", command, str(tmp_path / "none")]) == 2
    assert "there is no such folder" in capsys.readouterr().err
    assert main(["data", command, str(tmp_path)]) == 2
    assert "dataset.json is missing" in capsys.readouterr().err


def test_the_gallery_is_one_page_that_loads_nothing(untouched, tmp_path, capsys):
    page = tmp_path / "gallery.html"
    command = ["data", "gallery", str(untouched), "--out", str(page), "--contacts", "6"]
    assert main([*command, "--seed", "5"]) == 0
    text = page.read_text(encoding="utf-8")
    data = ContactDataset(untouched)
    chosen = draw_contacts(NUM, 6, 5)
    assert re.findall(r"<h3>#(\d+) ", text) == [str(index) for index in chosen]
    assert text.count("data:image/webp;base64,") == 12 + 1  # and the colour scale
    outside = re.findall(r"""(?:src|href|url\()\s*=?\s*["']?(?!data:)(\w+:|//|\.|/)""", text)
    assert outside == []
    assert "default-src 'none'" in text
    for slot in ("shape", "texture", "depth", "position", "area"):
        for index in chosen:
            assert f'data-{slot}="{data.column(slot)[index]}"' in text
    assert text.count('class="bar') == 19 + 5 + 4 + 9 + 5
    assert not list(tmp_path.glob(".*"))
    first = page.read_bytes()
    assert main([*command, "--seed", "5"]) == 0
    assert page.read_bytes() == first


def test_names_are_escaped_and_doubt_is_marked(tmp_path):
    doubtful = cap_contact(4, object="<b>&", unsure=frozenset({"shape"}))
    folder = written(tmp_path / "in", doubtful)
    page = tmp_path / "gallery.html"
    assert main(["data", "gallery", str(folder), "--out", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert "<b>&" not in text
    assert "&lt;b&gt;&amp;" in text
    assert "ambiguous: shape" in text


def test_sheets_hold_every_drawn_contact(untouched, tmp_path, capsys):
    out = tmp_path / "sheets"
    assert main(["data", "sheet", str(untouched), "--out", str(out), "--contacts", "9"]) == 0
    assert [path.name for path in sorted(out.iterdir())] == ["sheet-01.png", "sheet-02.png"]
    with Image.open(out / "sheet-01.png") as first, Image.open(out / "sheet-02.png") as last:
        assert first.size[1] > 3 * last.size[1]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (["--contacts", "0"], "--contacts must be at least 1, got 0"),
        (["--seed=-1"], "--seed must be at least 0"),
    ],
)
def test_impossible_draws_are_refused(wrong, said, untouched, tmp_path, capsys):
    for command in ("gallery", "sheet"):
        assert main(["data", command, str(untouched), *wrong]) == 2
    assert capsys.readouterr().err.count(said) == 2


def test_a_place_that_can_t_be_written_is_named(untouched, tmp_path, capsys):
    missing = tmp_path / "none" / "gallery.html"
    assert main(["data", "gallery", str(untouched), "--out", str(missing), "--contacts", "1"]) == 2
    assert str(missing) in capsys.readouterr().err


def test_a_set_in_the_making_is_shown_and_called_incomplete(tmp_path, capsys):
    folder = written(tmp_path, *map(cap_contact, range(4, 12)))
    (folder / "shard-0-00001.parquet").unlink()
    page = tmp_path / "gallery.html"
    assert main(["data", "stats", str(folder)]) == 0
    assert "INCOMPLETE: 4 contacts are missing" in capsys.readouterr().out
    assert main(["data", "gallery", str(folder), "--out", str(page)]) == 0
    assert "INCOMPLETE, 4 contacts are missing" in page.read_text(encoding="utf-8")
