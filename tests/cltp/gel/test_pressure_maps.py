"""Pressure maps against a pressure that made the heights, and what they leave of noise."""

import torch

from cltp.gel.compliance import layer_kernel
from cltp.gel.pressure import NOMINAL_GEL, UNIT_MM
from cltp.gel.pressure_maps import PITCH_MM, UNIT_MPA, pressure_maps
from cltp.tactile.point_layout import GRID

ROWS, COLUMNS = GRID.rows, GRID.columns


def pressed() -> tuple[torch.Tensor, torch.Tensor]:
    """A pressure [MPa] of two discs 1 mm apart, and the scaled heights that it makes."""
    y, x = torch.meshgrid(torch.arange(ROWS), torch.arange(COLUMNS), indexing="ij")
    near = [(y - 37) ** 2 + (x - centre) ** 2 <= 6**2 for centre in (42, 59)]
    pressure = 0.05 * (near[0] | near[1]).double()
    kernel = layer_kernel(ROWS, COLUMNS, PITCH_MM, NOMINAL_GEL)
    height = torch.zeros(ROWS, COLUMNS, dtype=torch.float64)
    for row, column in pressure.nonzero().tolist():
        lags = (torch.arange(ROWS) - row).abs()[:, None], (torch.arange(COLUMNS) - column).abs()
        height += pressure[row, column] * kernel[lags]
    return pressure, height / UNIT_MM


def test_the_pressure_that_made_the_heights_is_found_and_its_outline_is_sharp() -> None:
    pressure, height = pressed()
    sharp, soft = pressure_maps(height[None].float())[0] * UNIT_MPA
    inside = pressure > 0
    assert abs(sharp[inside].mean() / 0.05 - 1) < 0.1
    assert abs(sharp[~inside]).max() < 0.025 < sharp[inside].min()  # half of it tells the outline
    between = (37, 50)
    assert height[between] > 0.35 * height.max()  # the heights hardly have a gap
    assert sharp[between] < 0.1 * sharp.max()
    assert soft[inside].std() > sharp[inside].std()  # rounded by what is not undone


def test_noise_grows_by_no_more_than_the_damping_allows() -> None:
    noise = torch.randn(1, ROWS, COLUMNS, generator=torch.Generator().manual_seed(0)) * 0.003
    sharp, soft = pressure_maps(noise)[0].std(dim=(-2, -1))
    assert soft < sharp < 1.0  # noise of a unit stays below a light pressure
    assert torch.equal(
        pressure_maps(torch.zeros(1, ROWS, COLUMNS)), torch.zeros(1, 2, ROWS, COLUMNS)
    )
