"""The reference encoder and its benchmark."""

import dataclasses
import itertools
import json
import time
from pathlib import Path

import pytest
import torch

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.errors import TouchError
from cltp.tactile.point_layout import GRID, PointLayout
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.learning import encoder as bench_encoder
from tacgrasp.benchmarks.learning.plain_pointbert import PlainPointBert
from tacgrasp.benchmarks.settings import EncoderSettings

TINY = dataclasses.replace(PRESETS["tiny"], tokenizer="fps", group_size=8)


@pytest.fixture(autouse=True)
def batches(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Sizes of the batches that are asked for; each has two clouds at most, and no warm-up."""
    sizes: list[int] = []
    clouds = bench_encoder.clouds

    def few_clouds(count: int, *layout: PointLayout) -> torch.Tensor:
        sizes.append(count)
        return clouds(min(count, 2), *layout)

    monkeypatch.setattr(bench_encoder, "WARM_UP", 0)
    monkeypatch.setattr(bench_encoder, "clouds", few_clouds)
    return sizes


def test_the_reference_has_the_size_of_ours() -> None:
    torch.manual_seed(0)
    plain, ours = PlainPointBert(PRESETS["pointbert"]), TactileEncoder(PRESETS["pointbert"])
    sizes = [sum(p.numel() for p in model.parameters()) for model in (plain, ours)]
    assert sizes[0] == pytest.approx(sizes[1], rel=0.02)
    assert PlainPointBert(TINY).eval()(torch.rand(2, 256, 3)).shape == (2, TINY.feature_dim)


def test_its_groups_are_the_nearest_points() -> None:
    points = torch.rand(1, 64, 3)
    groups, centres = PlainPointBert(dataclasses.replace(TINY, group_size=4)).groups(points)
    around = (groups + centres[:, :, None])[0, 5]
    nearest = (points[0] - centres[0, 5]).norm(dim=1).argsort()[:4]
    torch.testing.assert_close(around, points[0, nearest])
    assert len(torch.unique(centres[0], dim=0)) == 64  # farthest points never come twice


def test_figures_are_those_of_the_clock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, batches: list[int]
) -> None:
    ticks = itertools.count()
    path = tmp_path / "encoder.json"
    few = dataclasses.replace(TINY, group_size=4, num_groups=6, dim=8)
    monkeypatch.setitem(PRESETS, "tiny", few)
    bench_encoder.run(
        EncoderSettings(preset="tiny", repeats=1, json=path),
        scales=[(256, 64)],
        clock=lambda: float(next(ticks)),
    )
    found = json.loads(path.read_text())
    assert set(found["encoders"]) == {"ours, fps", "plain PointBERT"}
    for figures in found["encoders"].values():
        assert figures["batch_1_p50_ms"] == figures["batch_64_p99_ms"] == 1000.0
        assert figures["train_samples_per_s"] == 3 * 32  # one tick for all of the steps
        assert figures["train_bf16_samples_per_s"] == 3 * 32
    assert set(found["scaling"]) == {"256 points, 64 groups"}
    of_each = [1, 64, 32, 32]  # two latencies, two trainings
    assert batches == [*of_each, *of_each, 1]


@pytest.mark.parametrize(("tokenizer", "groups"), [("lattice", 64), ("grid", 63)])
def test_encoders_with_height_quantiles_are_timed(
    tokenizer: str, groups: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ticks, path = itertools.count(), tmp_path / "encoder.json"
    few = dataclasses.replace(
        PRESETS["tiny"],
        tokenizer=tokenizer,
        bearing=8,
        grades=4,
        num_groups=groups,
        pressure=int(tokenizer == "grid"),
        curves=20 * (tokenizer == "grid"),
        stem_dim=2,
        group_size=4,
        dim=8,
    )
    monkeypatch.setitem(PRESETS, "tiny", few)
    bench_encoder.run(
        EncoderSettings(preset="tiny", repeats=1, json=path),
        scales=[],
        clock=lambda: float(next(ticks)),
    )
    found = json.loads(path.read_text())["encoders"]
    assert set(found) == {f"ours, {tokenizer}", "ours, fps", "plain PointBERT"}
    assert found["ours, fps"]["batch_1_p50_ms"] == 1000.0


def test_points_to_time_lie_in_their_layout() -> None:
    assert bench_encoder.clouds(2).shape == (2, 1024, 3)
    assert bench_encoder.clouds(2, GRID).shape == (2, 7500, 3)
    with pytest.raises(TouchError, match="square number"):
        bench_encoder._scaling(TINY, 1000, 64, 1, time.perf_counter)


def test_wrong_use_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "encoder", "--preset", "giant"]) == 2
    assert "unknown preset 'giant'" in capsys.readouterr().err
    assert main(["bench", "encoder", "--preset", "small_image"]) == 2
    assert "takes images" in capsys.readouterr().err
    assert main(["bench", "encoder", "--repeats", "0"]) == 2
    assert "at least 1" in capsys.readouterr().err
