"""What a sensor sees of a sheared gel."""

import pytest
import torch

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import ElasticLayer, gel_of
from sim.gel.shear.layer import ShearLayer
from sim.gel.shear.sensed import shear_field, surface_mm
from tests.sim.gel.shear.test_shear_layer import by


def contact(sensor_name="gelsight_mini", friction=0.5, middle=(2.0, -1.0), motion=None):
    sensor = sensor_named(sensor_name)
    rows, columns = (60, 80) if sensor.rows != sensor.columns else (60, 60)
    gel = ElasticLayer(
        gel_of(sensor_name), rows=rows, columns=columns, pitch_mm=sensor.width_mm / columns
    )
    y = ((rows - 1) / 2 - torch.arange(rows)[:, None]) * gel.pitch_mm - middle[1]
    x = (torch.arange(columns) - (columns - 1) / 2) * gel.pitch_mm - middle[0]
    press = gel.press_to_force(((x**2 + y**2) / 15)[None], 2.0)
    layer = ShearLayer(gel, friction=friction)
    shear = layer.step(None, press.pressure_kpa, by(0.1, -0.2) if motion is None else motion)
    return sensor, layer, shear, press.height_mm


def test_no_force_is_lost_among_the_taxels():
    sensor, layer, shear, height = contact()
    for grid in (None, (5, 7), (12, 12)):
        field = shear_field(layer, shear, height, sensor, grid=grid)
        expected = [*shear.force_n[0].tolist(), 2.0]
        assert field.total_force_n.tolist() == pytest.approx(expected, rel=1e-4)
    assert field.values.shape == (144, 6)


def test_forces_lie_under_the_contact_and_displacements_follow_the_body():
    sensor, layer, shear, height = contact(friction=20.0)
    field = shear_field(layer, shear, height, sensor, grid=(12, 12))
    x, y = field.positions_mm.T
    pressed_n = field.force_n[:, 2]
    assert (x * pressed_n).sum() / pressed_n.sum() == pytest.approx(2.0, abs=0.1)
    assert (y * pressed_n).sum() / pressed_n.sum() == pytest.approx(-1.0, abs=0.1)
    under = int(pressed_n.argmax())
    spread = layer.spread_mm(shear).abs().max().item()
    assert field.displacement_mm[under, 0] == pytest.approx(0.1, abs=spread + 1e-3)
    assert field.displacement_mm[under, 1] == pytest.approx(-0.2, abs=spread + 1e-3)
    assert field.displacement_mm[under, 2] > 0.2
    far = int((x - y).argmin())  # the corner at the top left
    assert abs(field.displacement_mm[far]).max() < 0.02


def test_pressure_alone_spreads_the_markers_around_an_incompressible_contact():
    sensor, layer, shear, height = contact("gelstereo", middle=(0.0, 0.0), motion=by())
    field = shear_field(layer, shear, height, sensor)
    assert len(field.positions_mm) == 23 * 23
    assert abs(field.force_n[:, :2]).max() == 0
    outwards = (field.positions_mm * field.displacement_mm[:, :2]).sum(axis=1)
    near = (field.positions_mm**2).sum(axis=1) < 5.0**2
    assert outwards[near].max() > 0.01
    assert outwards[near].mean() > 0


def test_the_surface_adds_pressure_s_and_traction_s_displacements():
    _, layer, shear, height = contact()
    surface = surface_mm(layer, shear, height)
    assert torch.allclose(surface[:, 2] - height, layer.sink_mm(shear), atol=1e-6)
    assert torch.allclose(surface[:, :2] - shear.displacement_mm, layer.spread_mm(shear), atol=1e-6)


def test_a_gel_that_does_not_cover_the_sensing_area_is_refused():
    sensor, layer, shear, height = contact()
    with pytest.raises(ValueError, match="solve on a grid over all of it"):
        shear_field(layer, shear, height, sensor_named("digit"))
    with pytest.raises(ValueError, match="a field is of one contact"):
        shear_field(layer, layer.at_rest(2), height, sensor)
