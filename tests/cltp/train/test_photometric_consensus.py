"""The network that several agree on: exact for a cubic law, and steadier than each of them."""

import math

import numpy as np
import pytest
import torch

from cltp.train.photometric.consensus import (
    GelPixels,
    Pixels,
    consensus_steps,
    fit_law,
    law_features,
    train_consensus,
)
from cltp.train.photometric.network import Net, train_net

pytestmark = pytest.mark.usefixtures("one_thread")


def pixels(count: int, seed: int) -> torch.Tensor:
    rng = torch.Generator().manual_seed(seed)
    return 2 * torch.rand(count, 5, generator=rng) - 1


def brightness_of(places: torch.Tensor) -> torch.Tensor:
    """A gel that is three times as bright in the middle as in its corners."""
    return 1.5 - 0.5 * places.square().sum(1)


def slopes_of_a_law(inputs: torch.Tensor) -> torch.Tensor:
    """A lamp that falls off to the right, and a colour that saturates."""
    red, green, _, x, y = inputs.T
    return torch.stack([red * (1 - 0.4 * x * x) + 0.2 * red * green * y, green - 0.3 * green**2], 1)


def slopes_of_a_shaded_law(inputs: torch.Tensor) -> torch.Tensor:
    """The same in the shade of ``brightness_of``, with a colour that saturates to its cube."""
    colours = inputs[:, :3] / brightness_of(inputs[:, 3:])[:, None]
    slopes = slopes_of_a_law(torch.cat([colours, inputs[:, 3:]], dim=1))
    return slopes + 0.1 * colours[:, :2] ** 3


def test_a_cubic_law_of_colours_over_brightness_is_found() -> None:
    inputs = pixels(3000, seed=0)
    lit = brightness_of(inputs[:, 3:])
    assert law_features(inputs, lit).shape == (3000, 114)
    law = fit_law(inputs, lit, slopes_of_a_shaded_law(inputs))
    new = pixels(500, seed=1)
    found = law_features(new, brightness_of(new[:, 3:])) @ law
    torch.testing.assert_close(found, slopes_of_a_shaded_law(new), atol=2e-3, rtol=0)


def test_a_law_gives_no_slope_where_no_colour_changed() -> None:
    inputs = pixels(10, seed=2)
    inputs[:, :3] = 0
    assert not law_features(inputs, torch.ones(10)).any()


def test_columns_that_are_all_zero_do_not_spoil_a_fit() -> None:
    inputs = pixels(2000, seed=3)
    inputs[:, 2] = 0  # a lamp that is off
    lit = brightness_of(inputs[:, 3:])
    law = fit_law(inputs, lit, slopes_of_a_shaded_law(inputs))
    assert torch.isfinite(law).all()
    found = law_features(inputs, lit) @ law
    torch.testing.assert_close(found, slopes_of_a_shaded_law(inputs), atol=2e-3, rtol=0)


def test_the_consensus_errs_less_between_the_places_than_a_network_alone() -> None:
    """Eight presses, of which each pixel's slope carries the error of its press."""
    rng = np.random.default_rng(0)
    inputs = pixels(8 * 300, seed=4)
    places = np.repeat(rng.uniform(-1, 1, (8, 2)), 300, axis=0)
    inputs[:, 3:] = torch.from_numpy(places + rng.uniform(-0.1, 0.1, places.shape)).float()
    gains = np.repeat(rng.normal(1, 0.1, (8, 2)), 300, axis=0)
    targets = slopes_of_a_law(inputs) * torch.from_numpy(gains).float()
    new = pixels(2000, seed=5)
    steps, done = 150, []

    def error(model: Net) -> float:
        with torch.no_grad():
            return math.sqrt(float((model(new) - slopes_of_a_law(new)).square().mean()))

    alone = []
    for seed in range(3):
        generator = torch.Generator().manual_seed(seed)
        model = Net(generator)
        train_net(model, inputs, targets, steps, generator, lambda: None)
        alone.append(error(model))
    generator = torch.Generator().manual_seed(0)
    gel = GelPixels(places=inputs[:, 3:], brightness=torch.ones(len(inputs)))
    known = Pixels(
        colours=inputs[:, :3],
        smooth=inputs[:, :3],
        slopes=targets,
        index=torch.arange(len(inputs)),
    )
    together = train_consensus(known, gel, steps, generator, lambda: done.append(1))
    assert error(together) < min(alone)
    assert len(done) == consensus_steps(steps)
