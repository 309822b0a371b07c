"""rerun shows runs and episodes: what is logged, on which network, in how much memory and time.

Needs the extra 'view'; `make test-all` runs it in an environment of its own.
"""

from __future__ import annotations

import re
import socket
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from primitives.execution import PadAxes
from tacgrasp.__main__ import main
from tacgrasp.episodes import EpisodeWriter
from tests.fakes.contracts import contract
from tests.fakes.episode_samples import end, header, press, step_record
from tests.paths import ROOT

pytest.importorskip("rerun", reason="needs rerun: pip install 'tacgrasp[view]'")

OLD = ROOT / "tests/tacgrasp/episodes/data/format1.mcap"


@pytest.fixture(scope="module")
def episode(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An episode with three steps, its contract and the pad's place."""
    path = tmp_path_factory.mktemp("episodes") / "e.mcap"
    pad = PadAxes(x_tcp=(1.0, 0.0, 0.0), y_tcp=(0.0, -1.0, 0.0))
    with EpisodeWriter(path, replace(header(), pad=pad, contract=contract(1, 2, 3))) as writer:
        for index in range(3):
            writer.write_step(replace(step_record(index), in_contact=True))
        writer.finish(end())
    return path


def rerun(*arguments: str) -> str:
    command = [sys.executable, "-m", "rerun", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def chunks(rrd: Path) -> dict[str, set[str]]:
    """Components by entity in a file of rerun."""
    found: dict[str, set[str]] = {}
    for line in rerun("rrd", "print", str(rrd)).splitlines():
        if match := re.search(r" - (/\S+) - data columns: \[(.*)\]", line):
            found.setdefault(match[1], set()).update(match[2].split())
    return found


def converted(mcap: Path, tmp_path: Path) -> dict[str, set[str]]:
    rerun("mcap", "convert", str(mcap), "-o", str(tmp_path / "x.rrd"))
    return chunks(tmp_path / "x.rrd")


def test_rerun_reads_points_transforms_images_text_and_numbers_from_an_episode(
    episode: Path, tmp_path: Path
) -> None:
    found = converted(episode, tmp_path)
    assert "Points3D:positions" in found["/touch/cloud"]
    assert {"Transform3D:translation", "Transform3D:child_frame"} <= found["/tf"]
    assert "EncodedImage:blob" in found["/touch/heights"]
    assert {"TextLog:text", "TextLog:level"} <= found["/text"]
    assert "tacgrasp.Numbers:message" in found["/numbers"]


def test_the_points_that_rerun_reads_are_in_metres(episode: Path, tmp_path: Path) -> None:
    rerun("mcap", "convert", str(episode), "-o", str(tmp_path / "x.rrd"))
    text = rerun("rrd", "print", "-vvv", str(tmp_path / "x.rrd"))
    cloud_chunks = [part for part in text.split("Chunk(") if "Points3D:positions" in part]
    assert len(cloud_chunks) == 3
    triples = re.findall(r"\[(-?[\d.e-]+), (-?[\d.e-]+), (-?[\d.e-]+)\]", cloud_chunks[0])
    shown = {tuple(round(float(axis), 7) for axis in triple) for triple in triples}
    points_m = (step_record(0).cloud.points_mm / 1000).round(7)
    assert len(shown & {tuple(map(float, point)) for point in points_m.astype(float).round(7)}) > 1


def test_the_numbers_that_rerun_reads_have_names(episode: Path, tmp_path: Path) -> None:
    rerun("mcap", "convert", str(episode), "-o", str(tmp_path / "x.rrd"))
    text = rerun("rrd", "print", "-vvv", str(tmp_path / "x.rrd"))
    for name in ("goal_low_n", "goal_high_n", "limit_n", "commanded_n", "depth_mm"):
        assert name in text


def test_rerun_opens_an_episode_of_the_format_before(tmp_path: Path) -> None:
    assert "Points3D:positions" in converted(OLD, tmp_path)["/touch/cloud"]


def test_an_export_has_the_gel_on_the_arm_the_forces_and_the_text(
    episode: Path, tmp_path: Path
) -> None:
    out = tmp_path / "e.rrd"
    assert main(["episodes", "export", str(episode), "--to", "rrd", "--out", str(out)]) == 0
    found = chunks(out)
    assert "Mesh3D:vertex_positions" in found["/base/tcp/gel/surface"]
    assert "Transform3D:translation" in found["/base/tcp/gel"]
    assert "Transform3D:translation" in found["/base/tcp"]
    assert "Image:buffer" in found["/touch/heights"]
    for name in ("felt", "goal_low", "limit", "commanded"):
        assert any(part.startswith("Series") for part in found[f"/force/{name}"])
    assert "Scalars:scalars" in found["/force/limit"]
    assert "TextLog:text" in found["/text"]
    assert not list(tmp_path.glob("*.part*"))


def test_the_surface_lies_in_metres_with_its_top_row_at_plus_y() -> None:
    from cltp.tactile.cells import pictured_heights
    from tacgrasp.viewer.scene import surface

    cloud = press(5.0, 4.0, 0.8)
    cells_mm = pictured_heights(cloud)
    vertices_m, triangles = surface(cells_mm, cloud)
    deepest = vertices_m[vertices_m[:, 2].argmax()]
    assert deepest[0] == pytest.approx(0.005, abs=0.001)
    assert deepest[1] == pytest.approx(0.004, abs=0.001)
    assert triangles.max() == len(vertices_m) - 1
    rows, columns = cells_mm.shape
    assert len(triangles) == 2 * (rows - 1) * (columns - 1)


def test_the_viewer_listens_on_this_computer_alone_with_bounded_memory(episode: Path) -> None:
    from tacgrasp.viewer.server import Viewer

    viewer = Viewer(web=True)
    try:
        port = int(viewer.url.rsplit(":", 1)[1].split("/")[0])
        addresses = {
            line.split()[1].split(":")[0]
            for line in Path("/proc/net/tcp").read_text().splitlines()[1:]
            if line.split()[1].endswith(f":{port:04X}") and line.split()[3] == "0A"
        }
        assert addresses == {"0100007F"}  # 127.0.0.1
        everywhere = Path("/proc/net/tcp6").read_text().splitlines()[1:]
        assert not any(f":{port:04X} " in line and line.split()[3] == "0A" for line in everywhere)
        command = Path(f"/proc/{viewer._process.pid}/cmdline").read_text()
        assert "--memory-limit\x001GB" in command
    finally:
        viewer.close()
    time.sleep(0.2)
    with socket.socket() as probe:
        assert probe.connect_ex(("127.0.0.1", port)) != 0


@pytest.mark.slow
def test_a_simulated_rig_and_its_sensor_are_shown_live(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for what in ("--rig", "--sensor"):
        assert main(["view", what, "sim", "--seconds", "1", "--web"]) == 0
        printed = capsys.readouterr().out
        assert "open http://127.0.0.1:" in printed
        assert int(re.findall(r"(\d+) readings shown", printed)[0]) >= 3


@pytest.mark.slow
def test_a_run_is_shown_while_it_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    argv = ["run", "--policy", "rules", "--seed", "1", "--view", "--record", str(tmp_path)]
    assert main(argv) == 0
    assert "open http://127.0.0.1:" in capsys.readouterr().out


def test_an_episode_that_does_not_exist_is_refused_before_the_viewer_starts(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tacgrasp.viewer.server.Viewer", None)
    assert main(["view", "no.mcap"]) == 2
    assert "no.mcap does not exist" in capsys.readouterr().err


def test_a_viewer_that_does_not_start_is_one_line_with_its_reason(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tacgrasp.viewer.server.sys.executable", "/bin/false")
    assert main(["view", str(OLD), "--web"]) == 2
    error = capsys.readouterr().err
    assert "rerun's viewer did not start: no message" in error
    assert "--to rrd" in error
