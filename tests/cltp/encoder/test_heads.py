"""Intervals of the heads' numbers."""

import math

import pytest
import torch

from cltp.encoder.encoder import PRESETS
from cltp.encoder.heads import IGNORED, StateHeads, Targets
from cltp.tactile.states import NUMBERS


def drawn(count: int, seed: int, width: int = 16) -> tuple[torch.Tensor, Targets]:
    """Pooled tokens, and numbers that they tell up to an error of a size that they tell too."""
    torch.manual_seed(seed)
    pooled = torch.randn(count, width)
    errors = torch.randn(count, 5) * pooled[:, :1].exp()
    labels = Targets(
        classes=torch.full((count, 5), IGNORED),
        numbers=pooled[:, :5] + errors,
        touching=(torch.rand(count) < 0.9).float(),
        cut=torch.zeros(count, 4),
    )
    return pooled, labels


def inside(heads: StateHeads, pooled: torch.Tensor, labels: Targets) -> torch.Tensor:
    read = heads(pooled)
    error, margins = labels.numbers - read.numbers, read.margins
    held = (error >= -margins[..., 0]) & (error <= margins[..., 1])
    return held[labels.touching > 0].float().mean(dim=0)


@pytest.mark.parametrize("in_cells", [False, True])
def test_calibrated_intervals_hold_their_part_of_new_contacts(in_cells: bool):
    torch.manual_seed(0)
    heads = StateHeads(16, in_cells=in_cells)
    before = inside(heads, *drawn(4000, 1))
    heads.calibrate(drawn(4000, 2), series=torch.arange(4000))
    after = inside(heads, *drawn(4000, 3))
    assert (before - 0.9).abs().max() > 0.05
    assert (after - 0.9).abs().max() < 0.02


def test_learned_intervals_grow_where_errors_do():
    torch.manual_seed(0)
    heads = StateHeads(16)
    optimiser = torch.optim.Adam(heads.parameters(), lr=3e-3)
    for step in range(300):
        pooled, labels = drawn(256, 100 + step)
        optimiser.zero_grad()
        terms = heads.losses(pooled, labels)
        (terms["numbers"] + terms["margins"]).backward()
        optimiser.step()
    heads.calibrate(drawn(4000, 2), series=torch.arange(4000))
    pooled, labels = drawn(4000, 3)
    certain = pooled[:, 0] < 0
    widths = heads(pooled).margins.sum(-1)
    assert widths[~certain].median() > 1.5 * widths[certain].median()
    for part in (certain, ~certain):
        held = inside(heads, pooled[part], Targets(*(each[part] for each in labels)))
        assert (held - 0.9).abs().max() < 0.06


def test_calibration_fits_intervals_that_were_never_learned():
    torch.manual_seed(0)
    heads = StateHeads(16)
    before = {name: value.clone() for name, value in heads.named_parameters()}
    heads.calibrate(drawn(4000, 2), series=torch.arange(4000))
    pooled, labels = drawn(4000, 3)
    certain = pooled[:, 0] < 0
    widths = heads(pooled).margins.sum(-1)
    assert widths[~certain].median() > 1.5 * widths[certain].median()
    assert (inside(heads, pooled, labels) - 0.9).abs().max() < 0.03
    torch.testing.assert_close(heads.hidden.weight, before["hidden.weight"], rtol=0, atol=0)
    rows = len(heads.out.weight) - 10  # the last ten are the margins'
    torch.testing.assert_close(heads.out.weight[:rows], before["out.weight"][:rows])


def test_intervals_hold_under_every_noise_that_they_are_set_by():
    torch.manual_seed(0)
    heads = StateHeads(16)
    pooled, labels = drawn(4000, 2)
    farther = labels._replace(numbers=1.5 * labels.numbers)
    heads.calibrate((pooled, labels), (pooled, farther), series=torch.arange(4000))
    pooled, labels = drawn(4000, 3)
    farther = labels._replace(numbers=1.5 * labels.numbers)
    both = torch.stack([inside(heads, pooled, each) for each in (labels, farther)])
    assert (both.amin(dim=0) - 0.9).abs().max() < 0.02
    assert both.amin(dim=0).max() < both.amax(dim=0).min()


def test_presses_that_are_alike_do_not_narrow_the_intervals_of_others():
    torch.manual_seed(0)
    heads = StateHeads(256)
    pooled, labels = drawn(600, 2, width=256)
    often = torch.arange(600).repeat_interleave(4)  # four presses of a series, all alike
    alike = pooled[often], Targets(*(each[often] for each in labels))
    fresh = drawn(4000, 3, width=256)
    by_series, by_press = StateHeads(256), StateHeads(256)
    for each, series in ((by_series, often), (by_press, torch.arange(2400))):
        each.load_state_dict(heads.state_dict())
        each.calibrate(alike, series=series)
    assert (inside(by_series, *fresh) - 0.9).abs().max() < 0.04
    assert inside(by_press, *fresh).mean() < inside(by_series, *fresh).mean() - 0.05


def test_heads_without_intervals_say_so():
    heads = StateHeads(16, intervals=False)
    heads.calibrate(drawn(100, 2), series=torch.arange(100))
    read = heads(torch.randn(2, 16))
    assert read.margins is None
    assert not heads.has_intervals


def test_a_few_contacts_calibrate_nothing():
    heads = StateHeads(16)
    before = {name: value.clone() for name, value in heads.state_dict().items()}
    for count in (1, 3, 18):
        heads.calibrate(drawn(count, 2), series=torch.arange(count))
    assert all(torch.equal(value, before[name]) for name, value in heads.state_dict().items())


def test_places_are_read_in_cells_and_nothing_else_is():
    torch.manual_seed(0)
    heads = StateHeads.of(PRESETS["tiny_grid"])
    heads.hidden.weight.data[:, -1] = 0.0  # what the edge tells besides
    pooled = torch.randn(4, 96)
    pooled[:, -1] = 0.0
    larger = pooled.clone()
    larger[:, -1] = math.log(1.5)
    usual, scaled = heads(pooled), heads(larger)
    factors = torch.tensor([1.5 if name in ("x_mm", "y_mm") else 1.0 for name in NUMBERS])
    torch.testing.assert_close(scaled.numbers, usual.numbers * factors)
    torch.testing.assert_close(scaled.margins, usual.margins * factors[:, None])
    torch.testing.assert_close(scaled.logits, usual.logits)
    assert not StateHeads.of(PRESETS["small"]).in_cells
