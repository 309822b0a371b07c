"""Intervals of the heads' numbers."""

import math

import pytest
import torch

from cltp.encoder.encoder import PRESETS
from cltp.encoder.heads import IGNORED, StateHeads, Targets
from cltp.tactile.states import NUMBERS


def drawn(count: int, seed: int) -> tuple[torch.Tensor, Targets]:
    """Pooled tokens, and numbers that they tell up to an error of a size that they tell too."""
    torch.manual_seed(seed)
    pooled = torch.randn(count, 16)
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
    heads.calibrate(drawn(4000, 2))
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
    heads.calibrate(drawn(4000, 2))
    pooled, labels = drawn(4000, 3)
    certain = pooled[:, 0] < 0
    widths = heads(pooled).margins.sum(-1)
    assert widths[~certain].median() > 1.5 * widths[certain].median()
    for part in (certain, ~certain):
        held = inside(heads, pooled[part], Targets(*(each[part] for each in labels)))
        assert (held - 0.9).abs().max() < 0.06


def test_calibration_changes_nothing_but_one_factor_for_each_number():
    torch.manual_seed(0)
    heads = StateHeads(16)
    pooled, _ = drawn(100, 3)
    before, margins = heads.state_dict(), heads(pooled).margins
    before = {name: value.clone() for name, value in before.items()}
    heads.calibrate(drawn(4000, 2))
    for name, value in heads.state_dict().items():
        assert torch.equal(value, before[name]) is (name != "widening")
    torch.testing.assert_close(heads(pooled).margins, margins * heads.widening[:, None])


def test_intervals_hold_under_every_noise_that_they_are_set_by():
    torch.manual_seed(0)
    heads = StateHeads(16)
    pooled, labels = drawn(4000, 2)
    farther = labels._replace(numbers=1.5 * labels.numbers)
    heads.calibrate((pooled, labels), (pooled, farther))
    pooled, labels = drawn(4000, 3)
    farther = labels._replace(numbers=1.5 * labels.numbers)
    both = torch.stack([inside(heads, pooled, each) for each in (labels, farther)])
    assert (both.amin(dim=0) - 0.9).abs().max() < 0.02
    assert both.amin(dim=0).max() < both.amax(dim=0).min()


def test_heads_without_intervals_say_so():
    heads = StateHeads(16, intervals=False)
    heads.calibrate(drawn(100, 2))
    read = heads(torch.randn(2, 16))
    assert read.margins is None
    assert not heads.has_intervals


def test_a_few_contacts_calibrate_nothing():
    heads = StateHeads(16)
    before = {name: value.clone() for name, value in heads.state_dict().items()}
    for count in (1, 3, 18):
        heads.calibrate(drawn(count, 2))
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
