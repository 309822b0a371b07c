"""Errors and intervals of the heads' numbers, group by group."""

import numpy as np
import pytest
import torch

from cltp.encoder.heads import IGNORED
from cltp.encoder.readings import HeadReadings
from cltp.tactile.states import CLASSES
from tacgrasp.benchmarks.transfer.intervals import Group, _figures, _widths


def group(shift: float, margin: float, count: int = 400) -> Group:
    """Numbers that are off by up to ``shift`` of themselves, with intervals of half ``margin``."""
    rng = np.random.default_rng(0)
    truth = rng.uniform(0.5, 2.0, (count, 5))
    values = torch.tensor(truth * (1 + shift * rng.uniform(-1, 1, truth.shape)))
    return Group(
        name="drawn",
        readings=HeadReadings(
            words=tuple(torch.zeros(count, len(names)) for names in CLASSES.values()),
            touching=torch.ones(count),
            cut=torch.zeros(count, 4),
            values=values,
            low=values - margin * torch.tensor(truth),
            high=values + margin * torch.tensor(truth),
        ),
        truth=truth,
        classes=np.tile([0, 1, 2, IGNORED, 0], (count, 1)),
    )


def test_errors_and_the_part_inside_follow_from_what_was_drawn() -> None:
    one = group(shift=0.2, margin=0.1)
    found = _figures(one, _widths(one))
    assert found["force_percent"] == pytest.approx(10, abs=1.5)
    assert found["inside"]["depth_mm"] == pytest.approx(50, abs=6)
    assert found["width"]["area_fraction"] == pytest.approx(1.0)
    assert found["trivial"]["force_percent"] > 2 * found["force_percent"]


def test_wider_intervals_hold_more_and_say_so() -> None:
    narrow, wide = (group(shift=0.2, margin=m) for m in (0.1, 0.19))
    found = _figures(wide, _widths(narrow))
    assert found["inside"]["depth_mm"] > 90
    assert found["width"]["depth_mm"] == pytest.approx(1.9, rel=0.01)


def test_words_are_scored_with_how_sure_they_are() -> None:
    one = group(shift=0.2, margin=0.1)
    shape = one.readings.words[0]
    shape[:, 0], shape[::4, 0], shape[::4, 1] = 0.9, 0.2, 0.5
    found = _figures(one, _widths(one))["words"]
    assert found["shape"]["right"] == pytest.approx(75)
    assert found["shape"]["confidence"] == pytest.approx(100 * (0.75 * 0.9 + 0.25 * 0.5))
    assert found["position"] == {"right": None, "confidence": None}


def test_forces_of_another_gel_are_no_figure() -> None:
    one = group(shift=0.2, margin=0.1)
    one.truth[:, 4] = np.nan
    found = _figures(one, _widths(one))
    assert found["force_percent"] is None and found["inside"]["force_n"] is None
    assert found["inside"]["depth_mm"] is not None
