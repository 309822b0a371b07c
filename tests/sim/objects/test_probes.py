"""Probes that a person names in a word."""

import numpy as np
import pytest

from cltp.tactile.states import Shape
from sim.objects.probes import ProbeShape


def test_a_ball_lies_behind_its_tip_as_a_sphere():
    ball = ProbeShape.named("ball:9.5")
    assert ball.shape is Shape.SPHERE
    x = np.array([0.0, 1e-4, 2.0, 4.749, 4.751])
    behind = ball.behind_mm(x, np.zeros(5))
    np.testing.assert_allclose(behind[:3], [0, 1e-8 / 9.5, 4.75 - np.sqrt(4.75**2 - 4)], rtol=1e-6)
    assert behind[3] == pytest.approx(4.75, abs=0.1)
    assert np.isinf(behind[4])


def test_a_cylinder_lies_along_x_and_a_flat_is_a_square():
    y, x = np.mgrid[-3:4, -3:4].astype(float)
    rod = ProbeShape.named("cylinder:6").behind_mm(x, y)
    assert (rod == rod[:, :1]).all()
    assert rod[3, 0] == 0
    flat = ProbeShape.named("flat:4").behind_mm(x, y)
    assert (flat == 0).sum() == 25
    assert np.isinf(flat[0, 0])


@pytest.mark.parametrize("name", ["ball", "ball:", "ball:big", "cone:3", "ball:0.1", "flat:-2"])
def test_what_is_no_probe_is_refused(name):
    with pytest.raises(ValueError, match=r"ball|cone|flat"):
        ProbeShape.named(name)
