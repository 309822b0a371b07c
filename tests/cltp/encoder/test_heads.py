"""The heads' force in newtons, before the language model is told."""

import torch

from cltp.encoder.heads import restored, scaled_force, transformed
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
