"""Two trainings that should have ended alike: one without a stop, and one that was stopped."""

from pathlib import Path

import numpy as np
from safetensors.torch import load_file

from cltp.train.curves import read_curves


def assert_same_weights(one: Path, other: Path) -> None:
    """Compare two safetensors files to within rounding.

    A product of matrices may round differently where memory lies differently. Of weights stored in
    16 bits a few in ten thousand then differ in their last place.
    """
    ours, theirs = load_file(one), load_file(other)
    assert ours.keys() == theirs.keys()
    differences = [(ours[name].double() - theirs[name].double()).abs() for name in ours]
    total = sum(float(difference.sum()) for difference in differences)
    assert total / sum(difference.numel() for difference in differences) < 5e-7


def assert_same_curves(one: Path, other: Path) -> None:
    """Compare the losses of every step of two trainings to within rounding."""
    ours, theirs = read_curves(one), read_curves(other)
    assert ours.keys() == theirs.keys()
    for name in ours:
        np.testing.assert_allclose(ours[name], theirs[name], rtol=1e-4, atol=1e-6, err_msg=name)
