"""What a single cloud shows against being read: a wrong sign of z, or a zero that is lost.

A file and a question to a server bear no frames of the untouched gel, so that sign and zero are the
cloud's own. A pad that is raised all over has a module of its own (``raised_pad``, beside this
one). A run compares with its own untouched gel and needs none of this.

Loads no torch.
"""

from __future__ import annotations

from cltp.errors import TouchError
from cltp.tactile.cells import cell_means, filled
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.contact_test import drift_alone_mm, touches_alone
from cltp.tactile.contact.partial_pad import is_partial
from cltp.tactile.quantiles import quantile
from cltp.tactile.sensor_noise import MINI_SPREAD, SPREADS

LOW_PART = 0.1
"""Part of the pad that has to lie below where the untouched gel can lie. Our choice."""

DRIFTS = 4.0
"""Standard deviations of a sensor's drift that such a part lies below zero: 0.16 mm of a GelSight
Mini. Our choice: twice as many as raise a pad, since a gel that is lowered presses on nothing, and
what touches it is measured over its surroundings all the same."""

BULGE = 0.25
"""Depth below zero, over the height above it, that a gel may bulge to around a contact. Our choice:
the gel that a ball of 7.5 mm displaces at 2 mm, spread over a GelSight Mini, is 0.28 mm high."""


def is_touched(cloud: TactileCloud) -> bool:
    """Whether something touches the gel of a single cloud, by test.

    Raises:
        TouchError: The gel rises where a contact would press it in, as far as it is measured all
            over.
    """
    evidence = touches_alone(cloud)
    if evidence.is_inverted and not is_partial(cloud):
        raise TouchError(
            "the gel rises where a contact would press it in: z has the wrong sign; expected mm, "
            "positive into the gel, with the untouched gel at 0 (of a camera's frame, the "
            "background is touched, or is not its own)"
        )
    return evidence.in_contact


UNSEEN_MM, UNSEEN_DRIFTS = 0.05, 3.0
"""Depth [mm], and standard deviations of drift besides, within which a press may be taken for drift
in a single cloud. Source: noise-free balls of 4 to 60 mm, 0.01 to 0.2 mm deep."""


def unseen_mm(cloud: TactileCloud) -> float:
    """Depth up to which a press of a ball may be taken for drift in a single cloud [mm]."""
    return UNSEEN_MM + UNSEEN_DRIFTS * drift_alone_mm(cloud)


def lowered_mm(cloud: TactileCloud) -> float:
    """Depth below zero that ``LOW_PART`` of the pad lies under [mm]; negative where it does not."""
    return -quantile(filled(cell_means(cloud)), LOW_PART)


def is_lowered(cloud: TactileCloud) -> bool:
    """Whether part of the pad lies where no untouched gel can: the cloud's zero is lost."""
    drift_mm = SPREADS.get(cloud.sensor.name, MINI_SPREAD).drift_mm
    low_mm = lowered_mm(cloud)
    if low_mm <= DRIFTS * drift_mm:
        return False
    return low_mm > BULGE * float(filled(cell_means(cloud)).max())


def lowered_text(cloud: TactileCloud) -> str:
    """A lowered pad in words, without a full stop."""
    return (
        f"a tenth of the pad lies {lowered_mm(cloud):.2f} mm below zero or more, far more than its "
        "gel drifts: its zero is lost"
    )
