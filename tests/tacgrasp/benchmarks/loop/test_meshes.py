"""The bench of meshes: each is grasped and tried, or refused with a reason, and pictured."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from matplotlib.image import imread
from trimesh.creation import box, icosphere

from tacgrasp.__main__ import main


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    meshes = tmp_path / "meshes"
    meshes.mkdir()
    icosphere(subdivisions=3, radius=18.0).export(meshes / "ball.ply")
    box((150.0, 150.0, 30.0)).export(meshes / "tray.stl")
    sheet: trimesh.Trimesh = box((20.0, 20.0, 20.0))
    sheet.update_faces(np.arange(len(sheet.faces)) > 1)
    sheet.export(meshes / "open.ply")
    return meshes


def test_each_mesh_is_tried_or_refused_and_pictured(folder, tmp_path):
    figures, picture = tmp_path / "figures.json", tmp_path / "meshes.png"
    argv = ["--data", str(folder), "--episodes", "1", "--workers", "1"]
    files = ["--json", str(figures), "--plot", str(picture)]
    assert main(["bench", "meshes", *argv, *files]) == 0
    ball, sheet, tray = json.loads(figures.read_text())["meshes"]
    assert ball["task"] == "strawberry"  # 7 g
    assert ball["grasp"]["width_mm"] == pytest.approx(36.0, abs=0.2)
    assert ball["mass_g"] == pytest.approx(0.3e-3 * 4 / 3 * np.pi * 18**3, rel=0.02)
    (episode,) = ball["episodes"]
    assert episode["truth"]["young_mpa"] < 1  # a strawberry's
    assert ball["held"] == int(ball["ends"] == "held 1")
    assert sheet["refused"].startswith("the mesh is open")
    assert tray["refused"].startswith("the mesh (+z up) is too wide: 150 mm")
    assert np.ptp(imread(picture)) > 0.3


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--data", "nowhere"], "nowhere is no folder"),
        (["--data", "tests"], "has no mesh (.ply, .obj, .stl, .off)"),
        (["--data", "DATA", "--names", "ball,cup"], "has no mesh cup"),
        (["--data", "DATA", "--task", "banana"], "unknown task 'banana'"),
        (["--data", "DATA", "--episodes", "0"], "--episodes must be at least 1"),
        (["--data", "DATA", "--mass-g", "0"], "--mass-g must be 0.1 to 5000 g"),
    ],
)
def test_wrong_use_is_told_in_one_line(folder, argv, expected, capsys):
    assert main(["bench", "meshes", *(str(folder) if a == "DATA" else a for a in argv)]) == 2
    printed = capsys.readouterr()
    assert expected in printed.err
    assert printed.err.count("\n") == 1
