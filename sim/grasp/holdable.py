"""Draws a body until it is one that can be held at all: that bruises at enough more than it slips.

Of most kinds every body can; a fruit whose own bruise force is drawn may not. The body is the same
for all sensors, since their gels are the same.
"""

from __future__ import annotations

import numpy as np

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import OBJECTS, Body, draw_body
from sim.grasp.fingers import FlatFingers

PROGRAMME_M_S2 = ((0.0, 2.5), (10.0, 0.0), (-10.0, 0.0))
"""Accelerations that a body must be held through, (sideways, upwards) [m/s²]: those of the
verification, ``tacgrasp.config.schema.VerifyConfig``; setting down asks for no more than lifting.
"""

SENSOR = "gelsight_mini"
MOST_DRAWS = 1000


def draw_holdable(name: str, rng: np.random.Generator, tails: float = 0.0) -> tuple[Body, int]:
    """Draw a body of a known kind, anew while it bruises too soon.

    Args:
        name: A key of ``sim.grasp.bodies.OBJECTS``.
        rng: Random generator.
        tails: As for ``sim.grasp.bodies.draw_body``.

    Returns:
        The body, and how many were drawn before it.

    Raises:
        ValueError: Unknown kind, or none of many could be held.
    """
    for num_redrawn in range(MOST_DRAWS):
        body = draw_body(name, rng, tails)
        least = OBJECTS[name].bruise_over_own_slip
        if least <= 0 or body.bruise_n >= least * slip_minimum_n(body):
            return body, num_redrawn
    raise ValueError(f"none of {MOST_DRAWS} drawn bodies of kind {name!r} could be held")


def slip_minimum_n(body: Body) -> float:
    """Least true force that holds a centred body through the whole programme [N]."""
    fingers = FlatFingers(body, sensor_named(SENSOR), gel_of(SENSOR))
    return fingers.slip_minimum_n(PROGRAMME_M_S2)
