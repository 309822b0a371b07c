import math
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.checkpoints.manifest import WeightsError
from cltp.checkpoints.tac3d_llm import (
    load_encoder,
    load_touching_encoder,
    save_encoder,
)
from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter
from cltp.data.sampler import CLEAN, NOISY, Sampler, sampled
from cltp.encoder.class_token import height_quantiles
from cltp.encoder.encoder import VARIANTS, EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.encoder.tokenizers import adaptive_channels, cell_sizes
from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, grid_axes_mm
from cltp.tactile.encoder_input import lattice_points, scaled
from cltp.tactile.point_layout import CONTACT_ADAPTIVE, EVEN, FINE, Sampling
from cltp.tactile.sensors import SENSORS
from tests.fakes.fake_contacts import fake_contact

MINI = SENSORS["gelsight_mini"]
ROWS, COLUMNS = 152, 204
X, Y = grid_axes_mm(MINI, ROWS, COLUMNS)


def punch(x_mm: float, y_mm: float, radius_mm: float, depth_mm: float = 0.8) -> np.ndarray:
    """A dent with a flat floor and walls of a millimetre."""
    distance = np.hypot(X[None, :] - x_mm, Y[:, None] - y_mm)
    return (depth_mm * np.clip(radius_mm + 1 - distance, 0, 1)).astype(np.float32)


def points_mm(heights: np.ndarray, sampling: Sampling, seed: int = 0) -> np.ndarray:
    return sampled(heights, MINI, sampling, np.random.default_rng(seed))


def batch(heights: np.ndarray, sampling: Sampling) -> torch.Tensor:
    return torch.from_numpy(scaled(points_mm(heights, sampling), MINI))[None]


def inside(points: np.ndarray, x_mm: float, y_mm: float, radius_mm: float) -> int:
    return int((np.hypot(points[:, 0] - x_mm, points[:, 1] - y_mm) < radius_mm).sum())


def test_adaptive_points_are_denser_in_the_contact() -> None:
    heights = punch(4.0, -3.0, 2.0)
    even, adaptive = (points_mm(heights, layout) for layout in (EVEN, CONTACT_ADAPTIVE))
    assert adaptive.shape == even.shape == (1024, 3)
    assert inside(adaptive, 4, -3, 2) > 4 * inside(even, 4, -3, 2)
    assert np.abs(adaptive[:, 0]).max() <= MINI.width_mm / 2
    assert np.abs(adaptive[:, 1]).max() <= MINI.height_mm / 2
    # A few points remain in the far corner.
    assert inside(adaptive, -9, 6, 4) >= 3


def test_adaptive_points_stay_in_the_order_of_a_lattice() -> None:
    grid = points_mm(punch(-5.0, 2.0, 1.0), CONTACT_ADAPTIVE).reshape(32, 32, 3)
    assert (np.diff(grid[..., 0].max(axis=0)) > 0).all()
    assert (grid[:, 1:, 0] > grid[:, :-1, 0].min(axis=0)).all()
    assert (grid[:, :-1, 0].max(axis=0) <= grid[:, 1:, 0].min(axis=0) + 1e-4).all()
    assert (grid[1:, :, 1].max(axis=1) <= grid[:-1, :, 1].min(axis=1) + 1e-4).all()


@pytest.mark.parametrize("heights", [np.zeros((ROWS, COLUMNS), np.float32), punch(0, 0, 2, 0.05)])
def test_an_untouched_gel_is_sampled_evenly(heights: np.ndarray) -> None:
    np.testing.assert_array_equal(points_mm(heights, CONTACT_ADAPTIVE), points_mm(heights, EVEN))


def test_a_contact_over_the_whole_area_is_sampled_evenly() -> None:
    heights = np.full((ROWS, COLUMNS), 0.5, np.float32)
    np.testing.assert_allclose(
        points_mm(heights, CONTACT_ADAPTIVE), points_mm(heights, EVEN), atol=1e-3
    )


def test_fine_points_are_four_times_as_many() -> None:
    points = points_mm(punch(0.0, 0.0, 3.0), FINE)
    assert points.shape == (4096, 3)
    ratio = inside(points, 0, 0, 3) / inside(points_mm(punch(0.0, 0.0, 3.0), EVEN), 0, 0, 3)
    assert ratio == pytest.approx(4, rel=0.15)


def test_even_sampling_is_that_of_live_clouds() -> None:
    points = points_mm(punch(4.0, -3.0, 2.0), EVEN).astype(np.float32)
    cloud = TactileCloud(points_mm=points, sensor=MINI)
    np.testing.assert_array_equal(lattice_points(cloud), points)


@pytest.mark.parametrize(
    "bad", [{"side": 1}, {"contact_fraction": 1.0}, {"contact_fraction": -0.1}]
)
def test_a_sampling_out_of_range_is_refused(bad: dict[str, float]) -> None:
    with pytest.raises(TouchError, match="side of 2 and a fraction"):
        Sampling(**bad)  # type: ignore[arg-type]


def test_cell_sizes_follow_from_adaptive_points() -> None:
    sensing_area = 4 * MINI.height_mm / MINI.width_mm  # scaled: x fills -1 to 1
    for sampling in (EVEN, CONTACT_ADAPTIVE):
        points = batch(punch(4.0, -3.0, 2.0), sampling)
        sizes = cell_sizes(points)
        assert sizes.sum().item() == pytest.approx(sensing_area, rel=0.1)
        # The floor of the dent is a disc of 2 mm; its walls are partly as deep.
        deep = points[0, :, 2] > 0.5 * 0.8 / MINI.max_depth_mm
        area_mm2 = sizes[0, deep].sum().item() * (MINI.width_mm / 2) ** 2
        assert area_mm2 == pytest.approx(math.pi * 2.5**2, rel=0.15)


def test_height_quantiles_of_adaptive_points_are_those_of_even_ones() -> None:
    heights = punch(4.0, -3.0, 2.0)
    even = height_quantiles(batch(heights, EVEN), 64)
    points = batch(heights, CONTACT_ADAPTIVE)
    weighted = height_quantiles(points, 64, cell_sizes(points))
    unweighted = height_quantiles(points, 64)
    assert (weighted - even)[:, 32:].abs().mean() < 0.2 * (unweighted - even)[:, 32:].abs().mean()


def test_adaptive_channels_hold_position_and_distance() -> None:
    channels = adaptive_channels(batch(np.zeros((ROWS, COLUMNS), np.float32), EVEN))
    assert channels.shape == (1, 8, 32, 32)
    assert channels[0, 4].mean(dim=0).diff().min() > 0  # x rises along columns
    assert channels[0, 5].mean(dim=1).diff().max() < 0  # y falls down the rows
    assert channels[0, 6:, 2:-2, 2:-2].std() < 0.2
    near = adaptive_channels(batch(punch(0.0, 0.0, 1.0), CONTACT_ADAPTIVE))
    assert near[0, 6, 16, 16] < -1 < channels[0, 6, 16, 16]  # more than e times denser
    assert near[0, 7, 16, 16] < -1


@pytest.mark.parametrize("tokenizer", [name for name, v in VARIANTS.items() if v.is_lattice])
@pytest.mark.parametrize("num_groups", [16, 64, 256])
def test_every_lattice_gives_a_token_for_each_group(tokenizer: str, num_groups: int) -> None:
    config = EncoderConfig(
        tokenizer=tokenizer, dim=24, depth=1, heads=2, stem_dim=8, num_groups=num_groups, bearing=16
    )
    out = TactileEncoder(config)(torch.rand(2, config.variant.sampling.side**2, 3))
    assert out.tokens.shape == (2, num_groups + 1, 24)


@pytest.fixture
def data(tmp_path: Path) -> ContactDataset:
    with DatasetWriter(tmp_path / "data") as writer:
        for number in range(8):
            writer.add(fake_contact(number))
    return ContactDataset(tmp_path / "data")


@pytest.mark.parametrize("noise", [CLEAN, NOISY])
@pytest.mark.parametrize("sampling", [EVEN, CONTACT_ADAPTIVE, FINE])
def test_batches_have_the_points_of_their_layout(
    data: ContactDataset, noise: object, sampling: Sampling
) -> None:
    sampler = Sampler(data, noise, sampling=sampling)  # type: ignore[arg-type]
    points = sampler.batch(np.arange(8), 0).points
    assert points.shape == (8, sampling.side**2, 3)
    assert np.isfinite(points).all()


def test_live_clouds_are_refused_by_encoders_of_other_points(tmp_path: Path) -> None:
    config = EncoderConfig(tokenizer="pressed", dim=24, depth=1, heads=2, stem_dim=8)
    save_encoder(tmp_path / "encoder", TactileEncoder(config), StateHeads(48))
    assert load_encoder(tmp_path / "encoder")[0].config == config
    with pytest.raises(WeightsError, match="as 'pressed' lays them out"):
        load_touching_encoder(tmp_path / "encoder")
