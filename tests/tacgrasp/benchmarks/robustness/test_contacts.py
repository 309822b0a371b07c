"""Contacts of the robustness benchmark: some of them, in any layout of their points."""

import numpy as np
import pytest

from cltp.data.dataset import ContactDataset
from cltp.tactile.point_layout import EVEN, GRID
from tacgrasp.benchmarks.robustness.conditions import NOMINAL
from tacgrasp.benchmarks.robustness.contacts import part, sample
from tests.fakes.tiny_weights import make_data


@pytest.mark.parametrize("layout", [EVEN, GRID])
def test_some_of_the_contacts_keep_their_points_states_and_layout(tmp_path, layout):
    make_data(tmp_path, 5)
    data = ContactDataset(tmp_path)
    sampled = sample(data, list(range(len(data))), NOMINAL, layout=layout)
    some = part(sampled, slice(1, 3))
    assert some.layout is layout
    assert some.points.shape == (2, layout.num_points, 3)
    assert np.array_equal(some.points, sampled.batch.points[1:3])
    assert some.states == sampled.batch.states[1:3]
    assert some.cloud(0).sensor == sampled.batch.sensors[1]
