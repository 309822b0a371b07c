"""The heads' force in newtons, before the language model is told."""

import torch

from cltp.encoder.heads import (
    IGNORED,
    StateHeads,
    Targets,
    restored,
    scaled_force,
    transformed,
)
from cltp.tactile.states import NUMBERS

FORCE = NUMBERS.index("force_n")
READ = torch.tensor([[0.47, -3.2, 1.9, 0.123, 1.58], [0.2, 0.0, 0.0, 0.05, 0.01]])


def test_only_the_force_is_scaled_and_by_the_factor():
    numbers = scaled_force(transformed(READ), 1.7)
    expected = READ.clone()
    expected[:, FORCE] *= 1.7
    torch.testing.assert_close(restored(numbers), expected, rtol=1e-5, atol=1e-6)


def test_each_of_a_batch_has_its_own_factor():
    numbers = scaled_force(transformed(READ), torch.tensor([0.6, 1.4]))
    expected = READ[:, FORCE] * torch.tensor([0.6, 1.4])
    torch.testing.assert_close(restored(numbers)[:, FORCE], expected, rtol=1e-5, atol=1e-6)


def test_a_factor_of_one_changes_no_bit():
    numbers = transformed(READ)
    assert torch.equal(scaled_force(numbers, 1.0), numbers)


def test_a_head_below_zero_stays_there_and_nothing_is_infinite():
    numbers = torch.tensor([[0.0, 0.0, 0.0, 0.0, -0.8], [0.0, 0.0, 0.0, 0.0, 50.0]])
    scaled = scaled_force(numbers, 10.0)
    assert scaled[0, FORCE] == numbers[0, FORCE]
    assert torch.isfinite(scaled).all()


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


def test_calibrated_intervals_hold_their_part_of_new_contacts():
    torch.manual_seed(0)
    heads = StateHeads(16)
    before = inside(heads, *drawn(4000, 1))
    heads.calibrate(*drawn(4000, 2))
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
    heads.calibrate(*drawn(4000, 2))
    pooled, labels = drawn(4000, 3)
    certain = pooled[:, 0] < 0
    widths = heads(pooled).margins.sum(-1)
    assert widths[~certain].median() > 1.5 * widths[certain].median()
    for part in (certain, ~certain):
        held = inside(heads, pooled[part], Targets(*(each[part] for each in labels)))
        assert (held - 0.9).abs().max() < 0.06


def test_what_lies_far_from_everything_learned_is_strange():
    heads = StateHeads(16)
    heads.calibrate(*drawn(4000, 2))
    usual, _ = drawn(4000, 3)
    assert (heads(usual).strangeness > 1).float().mean() < 0.005
    assert (heads(4 * usual).strangeness > 1).float().mean() > 0.9
    one_far = usual.clone()
    one_far[:, 3] = 12.0
    assert (heads(one_far).strangeness > 1).all()


def test_heads_without_intervals_say_so():
    heads = StateHeads(16, intervals=False)
    heads.calibrate(*drawn(100, 2))
    read = heads(torch.randn(2, 16))
    assert read.margins is None and read.strangeness is None
    assert not heads.has_intervals


def test_a_few_contacts_calibrate_nothing_and_nothing_is_strange_then():
    heads = StateHeads(16)
    before = {name: value.clone() for name, value in heads.state_dict().items()}
    for count in (1, 3, 18):
        heads.calibrate(*drawn(count, 2))
    assert all(torch.equal(value, before[name]) for name, value in heads.state_dict().items())
    read = heads(100 * torch.randn(8, 16))
    assert read.margins is not None and (read.strangeness == 0).all()
