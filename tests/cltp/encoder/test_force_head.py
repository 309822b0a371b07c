"""The force head: it begins with what the heads read, learns, and its intervals hold."""

import numpy as np
import pytest
import torch

from cltp.checkpoints.tac3d_llm import load_encoder, save_encoder
from cltp.encoder import force_head
from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.force_head import ForceHead, force_inputs
from cltp.encoder.heads import StateHeads
from cltp.gel.pressure import NUM_FEATURES
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.encoder_input import encoder_input
from cltp.tactile.point_layout import GRID
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import NUMBERS

MINI = SENSORS["gelsight_mini"]
FORCE = NUMBERS.index("force_n")
NUM_INPUTS = NUM_FEATURES + 3 * len(NUMBERS) + 5


def samples(count, seed):
    """Inputs whose force is that of the heads, changed by what pressure tells, with an error."""
    rng = torch.Generator().manual_seed(seed)
    inputs = torch.randn(count, NUM_INPUTS, generator=rng)
    error = 0.05 * torch.randn(count, generator=rng)
    truth = inputs[:, NUM_FEATURES + FORCE] + 0.3 * torch.tanh(inputs[:, 7]) + error
    return inputs, truth


@pytest.fixture
def caps():
    """Scaled points of two caps, (2, N, 3)."""
    y, x = np.mgrid[-30:30, -40:40] * 0.24
    heights = [np.clip(d - (x**2 + y**2) / 40, 0, None).astype(np.float32) for d in (0.2, 0.6)]
    return torch.from_numpy(
        np.stack([encoder_input(cloud_from_heights(h, MINI), GRID) for h in heights])
    )


def test_it_learns_and_nine_tenths_of_the_truth_lie_inside(monkeypatch):
    monkeypatch.setattr(force_head, "STEPS", 500)
    torch.manual_seed(0)
    head = ForceHead()
    head.fit(*samples(4000, 1))
    head.widen(*samples(1000, 2))
    inputs, truth = samples(2000, 3)
    with torch.no_grad():
        force = head(inputs)
    before = (truth - inputs[:, NUM_FEATURES + FORCE]).abs().median()
    errors = truth - force.value
    assert errors.abs().median() < before / 3
    inside = (-force.margins[:, 0] <= errors) & (errors <= force.margins[:, 1])
    assert 0.87 < inside.float().mean() < 0.93


def test_contacts_that_count_more_widen_the_intervals_to_them(monkeypatch):
    monkeypatch.setattr(force_head, "STEPS", 500)
    inputs, truth = samples(4000, 1)
    rare = torch.arange(4000) % 50 == 0  # one in fifty, which nothing in the inputs tells
    truth = torch.where(rare, truth - 0.5, truth)
    margins = []
    for weights in (None, torch.where(rare, 15.0, 0.7)):
        torch.manual_seed(0)
        head = ForceHead()
        head.fit(inputs, truth, weights)
        with torch.no_grad():
            margins.append(head(inputs).margins.median(0).values)
    alike, weighted = margins
    assert weighted[0] > 0.3 > 0.2 > alike[0]
    assert abs(weighted[1] - alike[1]) < 0.05


def test_it_changes_the_force_alone(caps):
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny_grid"]).eval()
    heads = StateHeads.of(encoder.config)
    with torch.no_grad():
        pooled = encoder(caps).pooled
        plain = heads.read(pooled, caps)
        torch.testing.assert_close(plain.numbers, heads(pooled).numbers)
        heads.force = ForceHead()
        read = heads.read(pooled, caps)
    changed = (read.numbers != plain.numbers).any(0)
    assert changed.tolist() == [name == "force_n" for name in NUMBERS]
    assert plain.margins is not None and read.margins is not None
    others = [n for n in range(len(NUMBERS)) if n != FORCE]
    torch.testing.assert_close(read.margins[:, others], plain.margins[:, others])
    assert (read.margins >= 0).all()


def test_its_inputs_are_of_the_pressure_and_of_the_readings(caps):
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny_grid"]).eval()
    heads = StateHeads.of(encoder.config)
    with torch.no_grad():
        output = heads(encoder(caps).pooled)
    inputs = force_inputs(caps, output)
    assert inputs.shape == (2, NUM_INPUTS)
    torch.testing.assert_close(inputs[:, 0], torch.tensor([0.2, 0.6]), atol=0.05, rtol=0)
    torch.testing.assert_close(inputs[:, NUM_FEATURES : NUM_FEATURES + 5], output.numbers)


def test_it_is_stored_with_its_encoder(caps, tmp_path, monkeypatch):
    monkeypatch.setattr(force_head, "STEPS", 100)
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny_grid"]).eval()
    heads = StateHeads.of(encoder.config)
    save_encoder(tmp_path / "plain", encoder, heads)
    assert load_encoder(tmp_path / "plain")[1].force is None
    heads.force = ForceHead()
    heads.force.fit(*samples(100, 4))
    save_encoder(tmp_path / "with", encoder, heads)
    again, heads_again = load_encoder(tmp_path / "with")
    assert heads_again.force is not None
    with torch.no_grad():
        read = heads.read(encoder(caps).pooled, caps).numbers[:, FORCE]
        stored = heads_again.read(again.eval()(caps).pooled, caps).numbers[:, FORCE]
    torch.testing.assert_close(stored, read, atol=0.05, rtol=0.02)
