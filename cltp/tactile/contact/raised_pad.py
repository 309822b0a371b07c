"""Whether the whole pad is raised: pressed all over, or without its zero.

A contact is told by its edges and slopes (``contact_test``, beside this module). A body that covers
the pad has none, whatever its force: 63 N of a flat body raise a GelSight Mini by 0.5 mm. Such a
cloud is neither a contact that can be read nor an untouched gel. Sensors that lose the zero, as
photometric ones do, show nothing of it.

Loads no torch.
"""

from __future__ import annotations

from cltp.tactile.cells import cell_means, filled
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.contact_test import touches_alone
from cltp.tactile.quantiles import quantile
from cltp.tactile.sensor_noise import MINI_SPREAD, SPREADS

FRACTION, FRACTION_WITH_CONTACT = 0.9, 0.98
"""Fractions of the pad that lie above the height by which it is raised: where no contact shows, and
where one does. Our choice: what leaves a rim free can be read, and a few bad cells hide nothing."""

DRIFTS, LEAST_MM = 2.0, 0.08
"""Standard deviations of a sensor's drift, and the height [mm], from which a pad is raised: 0.08 mm
of a GelSight Mini and of taxels. Our choice: drift has either sign within millimetres, and with
0.04 mm one simulated grip in 500 with taxels, which was raised by 0.06, was called so."""


def raised_mm(cloud: TactileCloud) -> float:
    """Height that ``FRACTION`` of the pad lies above [mm]."""
    return _least_mm(cloud, FRACTION)


def is_raised(cloud: TactileCloud) -> bool:
    """Whether the whole pad is raised far beyond the drift of its sensor."""
    drifts_mm = max(DRIFTS * SPREADS.get(cloud.sensor.name, MINI_SPREAD).drift_mm, LEAST_MM)
    if raised_mm(cloud) <= drifts_mm:
        return False
    is_covered = _least_mm(cloud, FRACTION_WITH_CONTACT) > drifts_mm
    return is_covered or not touches_alone(cloud).in_contact


def _least_mm(cloud: TactileCloud, fraction: float) -> float:
    """Height that a fraction of the pad lies above [mm]."""
    return quantile(filled(cell_means(cloud)), 1 - fraction)


def raised_text(cloud: TactileCloud) -> str:
    """A raised pad in words, without a full stop."""
    return (
        f"the whole pad is raised by {raised_mm(cloud):.2f} mm, far more than its gel drifts: it "
        "is pressed all over, or its zero is lost"
    )
