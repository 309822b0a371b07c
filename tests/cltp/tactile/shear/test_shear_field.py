"""A shear field holds what a sensor can report, and nothing else."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear.field import ShearField

MINI = sensor_named("gelsight_mini")
POSITIONS = np.array([[0.0, 0.0], [1.0, -2.0], [-10.0, 7.5]])
MOVED = np.array([[0.1, 0.0, 0.5], [0.0, -0.1, 0.2], [0.0, 0.0, -0.01]])
FORCE = np.array([[0.2, 0.0, 1.0], [0.0, 0.1, 0.5], [0.0, 0.0, 0.0]])


def field(**changes):
    given = {"positions_mm": POSITIONS, "displacement_mm": MOVED, "force_n": FORCE, "sensor": MINI}
    return ShearField(**(given | changes))


def test_values_are_displacement_and_force_side_by_side():
    shear = field(stamp=Stamp(monotonic_s=1.0, wall_s=2.0))
    assert shear.values.shape == (3, 6)
    assert shear.values[0].tolist() == pytest.approx([0.1, 0.0, 0.5, 0.2, 0.0, 1.0])
    assert shear.total_force_n.tolist() == pytest.approx([0.2, 0.1, 1.5])
    assert shear.stamp.monotonic_s == 1.0


def test_nobody_can_change_a_field():
    moved = MOVED.copy()
    shear = field(displacement_mm=moved)
    moved[:] = 1.0
    assert shear.displacement_mm[0, 0] == pytest.approx(0.1)
    for values in (shear.positions_mm, shear.displacement_mm, shear.force_n):
        assert values.dtype == np.float32
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 0.0


def test_a_sensor_without_forces_says_so():
    shear = field(force_n=None)
    assert shear.force_n is None
    with pytest.raises(TouchError, match="use displacement_mm"):
        _ = shear.values
    with pytest.raises(TouchError, match="use displacement_mm"):
        _ = shear.total_force_n


def with_value(values, value):
    changed = values.copy()
    changed[1, 1] = value
    return changed


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"positions_mm": POSITIONS[:, :1]}, r"shape \(N, 2\)"),
        ({"positions_mm": np.zeros((0, 2))}, r"shape \(N, 2\)"),
        ({"positions_mm": with_value(POSITIONS, np.nan)}, "drop those points"),
        ({"positions_mm": with_value(POSITIONS, 9.0)}, "beyond the sensing area"),
        ({"displacement_mm": MOVED[:2]}, r"needs shape \(3, 3\)"),
        ({"displacement_mm": MOVED[:, :2]}, r"needs shape \(3, 3\)"),
        ({"displacement_mm": with_value(MOVED, np.inf)}, "1 NaN or infinite"),
        ({"displacement_mm": with_value(MOVED, 3.5)}, "3.4 mm gel"),
        ({"force_n": FORCE[:1]}, r"force_n needs shape \(3, 3\)"),
        ({"force_n": with_value(FORCE, np.nan)}, "force_n has 1"),
        ({"force_n": with_value(FORCE, 450.0)}, "in newtons"),
    ],
)
def test_what_no_sensor_reports_is_refused_by_name(changes, message):
    with pytest.raises(TouchError, match=message):
        field(**changes)
