"""``tacgrasp data import``: a person's own touches become contacts, or nothing does."""

import shutil

import numpy as np
import pytest

from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.states import Area, Depth, Position, Shape, Texture
from tacgrasp.__main__ import main
from tests.fakes.contact_samples import MINI, X, Y, cap_contact
from tests.paths import SHARED_DATA

BALLS = SHARED_DATA / "gelsight_mini_balls"
FULL = "file,shape,texture,depth,position,area,force_n,object,split,series\n"


@pytest.fixture
def touches(tmp_path):
    """A height map, a cloud and an untouched gel."""
    folder = tmp_path / "touches"
    folder.mkdir()
    bump = 0.5 * np.exp(-((X - 2) ** 2 + (Y + 4) ** 2) / 6)
    np.save(folder / "map.npy", bump)
    np.savez(folder / "cloud.npz", points_mm=cloud_from_heights(bump, MINI).points_mm)
    np.save(folder / "turned.npy", -bump)
    np.save(folder / "low.npy", 0.2 * np.exp(-((X - 2) ** 2 + (Y + 4) ** 2) / 2))
    np.save(folder / "none.npy", np.full(X.shape, 0.01))
    return folder


def imported(folder, table, *flags):
    labels = folder / "labels.csv"
    labels.write_text(table, encoding="utf-8")
    out = folder.parent / "out"
    code = main(["data", "import", str(folder), "--labels", str(labels), "--out", str(out), *flags])
    return code, out


def test_given_labels_are_kept_and_what_is_empty_is_measured_and_marked(touches, capsys):
    code, out = imported(
        touches,
        FULL + "map.npy,sphere,smooth,Moderate,bottom-center,large,1.5,ball,test,7\n"
        "cloud.npz,,,,,,,,,\n"
        "none.npy,,,,,,,,,\n",
    )
    assert code == 0
    data = ContactDataset(out)
    full, cloud, none = (data.contact(index) for index in range(3))
    state = full.state
    assert (state.shape, state.texture) == (Shape.SPHERE, Texture.SMOOTH)
    assert (state.depth, state.position) == (Depth.MODERATE, Position.BOTTOM_CENTER)
    assert (state.area, state.force_n) == (Area.LARGE, 1.5)
    assert (full.object, full.series, full.split) == ("ball", 7, Split.TEST)
    assert full.measured == {"depth_mm", "x_mm", "y_mm", "area_share", "cut"}
    assert full.gel is None
    np.testing.assert_allclose(full.height_mm, np.load(touches / "map.npy"), atol=0.0006)
    assert (cloud.state.shape, cloud.state.texture) == (None, None)
    assert cloud.state.position is Position.BOTTOM_CENTER
    assert cloud.state.depth_mm == pytest.approx(0.45, abs=0.08)
    assert {"depth", "position", "area", "force_n"} <= cloud.measured
    np.testing.assert_allclose(cloud.height_mm.max(), 0.5, atol=0.05)
    assert (cloud.object, cloud.split) == ("unknown", Split.TRAIN)
    assert not none.state.in_contact
    said = capsys.readouterr().out
    assert "3 contacts" in said
    assert "untouched 1 with no contact" in said
    assert "shape     1 given, 0 measured, 1 unknown" in said
    assert "depth     1 given, 1 measured, 0 unknown" in said
    assert main(["data", "verify", str(out)]) == 0


@pytest.mark.parametrize("depth", ["0.72", "0.72 mm", "+.72"])
def test_a_depth_may_be_a_number_of_mm(depth, touches):
    code, out = imported(touches, f"file,depth\nmap.npy,{depth}\n")
    assert code == 0
    contact = ContactDataset(out).contact(0)
    assert contact.state.depth_mm == pytest.approx(0.72)
    assert contact.state.depth is Depth.DEEP
    assert not {"depth", "depth_mm"} & contact.measured


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("gone.npy,,,,,,,,,", "gone.npy does not exist"),
        ("map.npy,blob,,,,,,,,", "shape 'blob' is not one of sphere, "),
        ("map.npy,,,,left,,,,,", "position 'left' is not one of top-left, "),
        ("map.npy,,,0,,,,,,", "depth must be a number above 0, up to 10; got '0'"),
        ("map.npy,,,30,,,,,,", "depth 30 mm, but the heights reach 0.5 mm"),
        ("map.npy,,,0.0005,,,,,,", "the heights reach 0.5 mm; is it in metres? Multiply by 1000"),
        ("map.npy,,,450,,,,,,", "the heights reach 0.5 mm; is it in µm? Divide by 1000"),
        ("map.npy,,,0.05,,,,,,", "depth 0.05 mm, but the heights reach 0.5 mm"),
        ("low.npy,,,very deep,,,,,,", "very deep (0.9 mm and more), but the heights reach 0.2 mm"),
        ("low.npy,,,,,very large,,,,", "area very large (30 % and more), but 2."),
        ("map.npy,,,-0.3,,,,,,", "depth must be a number above 0, up to 10; got '-0.3'"),
        ("map.npy,,,nan,,,,,,", "depth must be a number above 0, up to 10; got 'nan'"),
        ("map.npy,,,flat,,,,,,", "depth 'flat' is not one of "),
        ("map.npy,,,,,,-2,,,", "force_n must be a number above 0"),
        ("map.npy,,,,,,nan,,,", "force_n must be a number above 0"),
        ("map.npy,,,,,,,,bench,", "split 'bench' is not one of train, "),
        ("map.npy,,,,,,,,,one", "series must be a number from 0"),
        (f"map.npy,,,,,,,,,{'9' * 5000}", "series must be a number from 0"),
        ("map.npy,,,,,,,,,,,", "more cells than the header"),
        (",sphere,,,,,,,,", "names no file"),
        ("none.npy,sphere,,,,,,,,", "labelled (shape), but nothing touches"),
        ("cloud.npz,,,,,,,,,", "the same file as line 2"),
        ("./cloud.npz,,,,,,,,,", "the same file as line 2"),
        ("turned.npy,,,,,,,,,", "is the sign turned"),
        ("labels.csv,,,,,,,,,", "expected a file ending in"),
        ("bad.npy,,,,,,,,,", "not a whole .npy array"),
    ],
)
def test_bad_rows_are_named_by_line_and_file_and_nothing_is_written(row, message, touches, capsys):
    (touches / "bad.npy").write_bytes(b"\x93NUMPY torn")
    code, out = imported(touches, f"{FULL}cloud.npz,,,,,,,,,\n{row}\n")
    assert code == 2
    said = capsys.readouterr().err
    name = row.split(",")[0] or "no file"
    assert "1 of 2 rows are bad and nothing was written" in said
    assert f"labels.csv line 3 ({name}): " in said
    assert message in said
    assert sorted(path.name for path in out.parent.iterdir()) == ["touches"]


@pytest.mark.parametrize(
    "labels", ["0.2,large", "1.5,tiny", "slight,medium", "deep,small", "very deep,medium"]
)
def test_what_a_person_may_have_estimated_is_no_bad_row(labels, touches):
    assert imported(touches, f"file,depth,area\nmap.npy,{labels}\n")[0] == 0


def test_a_file_that_can_not_be_read_is_a_bad_row(touches, capsys):
    name = "a" * 300 + ".npy"  # longer than a name may be
    code, out = imported(touches, f"file\n{name}\n")
    assert code == 2
    said = capsys.readouterr().err
    assert "1 of 1 rows are bad" in said
    assert "too long" in said
    assert "--out" not in said
    assert not out.exists()


def test_all_bad_rows_are_told_at_once(touches, capsys):
    code, _ = imported(touches, "file,shape\nmap.npy,blob\ncloud.npz,sphere\ngone.npy,\n")
    assert code == 2
    said = capsys.readouterr().err
    assert "2 of 3 rows" in said
    assert "line 2 (map.npy)" in said
    assert "line 4 (gone.npy)" in said


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("", "needs a header"),
        ("file;shape\nmap.npy;sphere\n", "got file;shape; put commas between the columns"),
        ("shape,texture\nsphere,smooth\n", "needs a header with the column file"),
        ("file,colour\nmap.npy,red\n", "got file, colour"),
        ("file,shape,shape\nmap.npy,a,b\n", "each once"),
        ("file,shape\n", "no rows"),
    ],
)
def test_a_table_that_is_none_is_refused(table, message, touches, capsys):
    code, out = imported(touches, table)
    assert code == 2
    assert message in capsys.readouterr().err
    assert not out.exists()


def test_an_existing_folder_is_never_added_to(touches, capsys):
    (touches.parent / "out").mkdir()
    code, out = imported(touches, "file\nmap.npy\n")
    assert code == 2
    assert "exists already" in capsys.readouterr().err
    assert not list(out.iterdir())


def test_missing_folders_and_tables_are_wrong_use(tmp_path, capsys):
    base = ["data", "import", str(tmp_path), "--labels", str(tmp_path / "l.csv"), "--out"]
    assert main([*base, str(tmp_path / "out")]) == 2
    assert "l.csv can't be read" in capsys.readouterr().err
    assert main([*base[:2], str(tmp_path / "no"), *base[3:], str(tmp_path / "out")]) == 2
    assert "is not a folder" in capsys.readouterr().err


def test_a_simulated_map_measures_near_its_truth(tmp_path):
    folder = tmp_path / "touches"
    folder.mkdir()
    truth = cap_contact(3)
    np.save(folder / "map.npy", truth.height_mm)
    code, out = imported(folder, "\ufefffile\nmap.npy\n\n")
    assert code == 0
    found = ContactDataset(out).state(0)
    assert found.depth_mm == pytest.approx(truth.state.depth_mm, abs=0.1)
    assert found.x_mm == pytest.approx(truth.state.x_mm, abs=0.5)
    assert found.y_mm == pytest.approx(truth.state.y_mm, abs=0.5)


@pytest.mark.skipif(not BALLS.is_dir(), reason=f"{BALLS} is absent")
def test_real_frames_become_contacts(tmp_path, capsys):
    frames = sorted(path for path in BALLS.glob("*.png") if path.name != "background.png")[:2]
    labels = tmp_path / "labels.csv"
    labels.write_text(
        "file,shape,texture,object\n"
        + "".join(f"{frame.name},sphere,smooth,steel ball\n" for frame in frames)
    )
    out = tmp_path / "out"
    command = ["data", "import", str(BALLS), "--labels", str(labels), "--out", str(out)]
    assert main(command) == 2
    assert "--background" in capsys.readouterr().err
    assert main([*command, "--background", str(BALLS / "background.png")]) == 0
    data = ContactDataset(out)
    assert data.height_mm(0).shape == (240, 320)
    assert all(0.1 < data.state(index).depth_mm < 2 for index in range(len(data)))


@pytest.mark.parametrize("inside", [False, True], ids=["by its name", "by a link"])
def test_a_file_outside_of_the_folder_is_refused(inside, touches, capsys):
    np.save(touches.parent / "private.npy", np.load(touches / "map.npy"))
    name = "../private.npy"
    if inside:
        (touches / "link.npy").symlink_to(touches.parent / "private.npy")
        name = "link.npy"
    code, out = imported(touches, f"file\n{name}\n")
    assert code == 2
    assert "lies outside of the folder" in capsys.readouterr().err
    assert not out.exists()


def test_a_fraction_of_the_series_is_held_out_whole(touches):
    for number in range(12):
        np.save(touches / f"{number}.npy", 0.5 * np.exp(-((X - number / 4) ** 2 + Y**2) / 6))
    rows = "".join(f"{number}.npy,{number // 2},\n" for number in range(12))
    rows += "map.npy,100,train\ncloud.npz,101,validation\n"
    code, out = imported(touches, f"file,series,split\n{rows}", "--held-out", "0.34")
    assert code == 0
    data = ContactDataset(out)
    series, split = data.column("series"), data.column("split")
    held = {one for one, part in zip(series, split, strict=True) if part == "test"}
    assert len(held) == 2
    assert all((split[series == one] == "test").all() for one in held)
    assert list(split[-2:]) == ["train", "validation"]  # as the table says


def test_a_series_is_never_divided(touches):
    rows = [("0.npy", "8", ""), ("1.npy", "08", ""), ("2.npy", "9", "validation")]
    rows += [("3.npy", "9", ""), ("4.npy", "", ""), ("5.npy", "0", "")]
    for name, _, _ in rows:
        np.save(touches / name, 0.5 * np.exp(-((X - int(name[0]) / 4) ** 2 + Y**2) / 6))
    table = "file,series,split\n" + "".join(f"{','.join(row)}\n" for row in rows)
    for seed in range(4):
        code, out = imported(touches, table, "--held-out", "0.4", "--seed", str(seed))
        assert code == 0
        data = ContactDataset(out)
        assert data.column("series").tolist() == [8, 8, 9, 9, 10, 0]
        split = data.column("split")
        assert split[0] == split[1]
        assert split[2] == split[3] == "validation"
        shutil.rmtree(out)
    code, _ = imported(touches, table + "map.npy,8,test\nlow.npy,8,train\n")
    assert code == 2


@pytest.mark.parametrize("fraction", ["1", "-0.1"])
def test_all_can_not_be_held_out(touches, fraction, capsys):
    assert imported(touches, "file\nmap.npy\n", "--held-out", fraction)[0] == 2
    assert "--held-out must be 0 to below 1" in capsys.readouterr().err


def test_a_tip_finer_than_a_cell_touches_where_a_person_says_so(touches):
    tip = np.zeros(X.shape)
    tip[24, 30:32] = 0.25
    np.save(touches / "tip.npy", tip)
    np.save(touches / "again.npy", tip)
    code, out = imported(touches, FULL + "tip.npy,peak,smooth,,,,,,,\nagain.npy,,,,,,,,,\n")
    assert code == 0
    told, untold = (ContactDataset(out).contact(index).state for index in range(2))
    assert told.in_contact
    assert told.shape is Shape.PEAK
    assert not untold.in_contact
