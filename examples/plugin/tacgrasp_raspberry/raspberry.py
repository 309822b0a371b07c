"""A raspberry for the simulator: a ball of drupelets. All numbers are assumptions."""

import math

import numpy as np

from sim.gel.gap import NO_BODY_MM
from sim.grasp.bodies import GRID_MM, BodyShape, ObjectKind, PropertyRanges, Range

DENSITY_G_CM3 = 0.8  # it is hollow


def shape(mass_g: float, rng: np.random.Generator) -> BodyShape:
    """Height field, centre of mass, radius of gyration and thickness [mm] of a mass [g]."""
    radius = 10 * (3 * mass_g / (4 * math.pi * DENSITY_G_CM3)) ** (1 / 3)
    x, y = np.meshgrid(GRID_MM, -GRID_MM)
    front = np.sqrt(np.clip(radius**2 - x**2 - y**2, 0, None))
    pitch, height = rng.uniform(2.5, 3.5), rng.uniform(0.1, 0.25)
    drupelets = height * np.abs(np.cos(np.pi * x / pitch) * np.cos(np.pi * y / pitch))
    front = np.where(front > 0, front + drupelets, 0.0)
    gap = np.where(front > 0, front.max() - front, NO_BODY_MM)
    return gap, (0.0, 0.0), radius * math.sqrt(0.4), 2 * radius


RASPBERRY = ObjectKind(
    ranges=PropertyRanges(
        mass_g=Range(4, 8),
        young_mpa=Range(0.08, 0.15, log=True),
        poisson=0.35,
        friction=Range(0.5, 0.9),
        bruise_n=Range(1.2, 1.8),
    ),
    shape=shape,
)
