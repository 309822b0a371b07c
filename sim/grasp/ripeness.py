"""What a strawberry, or another fruit, stands: bruise force and stiffness by size and ripeness.

A ripe berry bruises at little more than the force that holds it, and is soft; a firm one stands
more. So what a berry needs can be felt: its size tells how heavy it is, its stiffness how ripe.

Two closed forms stand for contact solves, so that a draw takes none: the force that holds a berry
at the least friction, and the pressure under a force. Both are fits to ``sim.grasp.fingers`` on 120
berries of 0.06 to 0.6 MPa, with a residual of 1.5 % (6 % at most) and 6 % (achenes). On 120 drawn
fruit of other kinds (``sim.grasp.fruit``), to which nothing was fitted, the first has 0.9 % (3.5 %
at most) and the second 7 %, and is 10 % low: they are rounder, so that a force presses them harder.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

HANDLING_M_S2 = math.hypot(9.81, 10.0)
"""Acceleration that a berry must be held against [m/s²]: weight, and the sideways shake of the
verification, which together are more than the lift's 9.81 + 2.5."""

LEAST_FRICTION = 0.3
"""Friction at which every berry can be held unbruised. Assumed, as the range of friction is."""

BRUISE_OVER_SLIP = (1.85, 2.53)
"""Bruise force over the force that holds the berry at ``LEAST_FRICTION``: overripe to firm. With
the residual of the closed form: 1.8 to 2.6.

Assumed, because no source gives both of one berry: pickers hold the ripest berry of every size
without bruising it, and not with twice the force. Larger berries thereby bruise at larger forces:
they are taken to be firmer in flesh, since a pressure of the same flesh would allow them less
than their weight asks for."""

BRUISE_KPA_PER_MPA = 130.0
"""Pressure that bruises over Young's modulus: flesh bruises at one strain. Assumed, because sources
give forces of cultivars, not strains; this value gives berries of 20 g the 0.20 MPa of
GelSight-lab/TactileEstimateModulus (citing a paper)."""

PRESSURE_SCATTER = 0.04
"""Half width of the scatter of the bruise pressure at a stiffness, as a fraction. Assumed: skin and
position differ, but a fruit's rupture force is correlated with its stiffness (kiwi: 0.80 over all
sizes)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flesh:
    """Stiffness and bruise force of one berry.

    Attributes:
        young_mpa: Young's modulus [MPa].
        bruise_n: Force of flat gelled fingers that just bruises it [N].
    """

    young_mpa: float
    bruise_n: float


@dataclass(frozen=True, slots=True, kw_only=True)
class BerrySize:
    """What ripeness does not change.

    Attributes:
        mass_g: Mass [g].
        size_mm: Diameter between the fingers [mm].
        com_mm: Centre of mass from the middle of the patch, (x, y) [mm].
    """

    mass_g: float
    size_mm: float
    com_mm: tuple[float, float]

    def slip_minimum_n(self, young_mpa: float) -> float:
        """Force that holds the centred berry at ``LEAST_FRICTION`` [N].

        Each patch carries half of the load, and its moment: limit surface of an elliptic shape,
        with the torsion that a patch of this force, size and stiffness resists.
        """
        load_n = self.mass_g / 1000 * HANDLING_M_S2 / (2 * LEAST_FRICTION)
        x_mm, y_mm = map(abs, self.com_mm)
        arm_mm = (10.0 * y_mm + 9.81 * x_mm) / HANDLING_M_S2
        stiff = (self.size_mm / 30) ** 0.455 * (young_mpa / 0.2) ** 0.242
        force_n = load_n
        for _ in range(_ROUNDS):
            moment = 0.365 * arm_mm**0.925 * stiff * force_n**-0.541
            force_n = load_n * math.hypot(1.0, moment)
        return force_n

    def young_mpa(self, bruise_n: float, scatter: float = 0.0) -> float:
        """Young's modulus at which a force bruises [MPa].

        Args:
            bruise_n: The force [N].
            scatter: Bruise pressure over the one that goes with the stiffness, less 1.
        """
        at_fifth_kpa = 24.96 * bruise_n**0.408 * (self.size_mm / 30) ** -0.554
        ratio = at_fifth_kpa / (BRUISE_KPA_PER_MPA * 0.2 * (1 + scatter))
        return float(0.2 * ratio ** (1 / (1 - 0.477)))

    def bruise_n(self, young_mpa: float) -> float:
        """Force that bruises at a stiffness, without scatter [N]: ``young_mpa`` turned round."""
        ratio = (young_mpa / 0.2) ** (1 - 0.477)
        at_fifth_kpa = ratio * BRUISE_KPA_PER_MPA * 0.2
        return float((at_fifth_kpa / 24.96 * (self.size_mm / 30) ** 0.554) ** (1 / 0.408))

    def flesh(self, bruise_over_slip: float, scatter: float = 0.0) -> Flesh:
        """Stiffness and bruise force of a ripeness within ``BRUISE_OVER_SLIP``."""
        young_mpa = 0.2
        for _ in range(_ROUNDS):
            bruise_n = bruise_over_slip * self.slip_minimum_n(young_mpa)
            young_mpa = self.young_mpa(bruise_n, scatter)
        return Flesh(young_mpa=young_mpa, bruise_n=bruise_n)

    def ripeness(self, flesh: Flesh) -> float:
        """Bruise force over slip minimum."""
        return flesh.bruise_n / self.slip_minimum_n(flesh.young_mpa)


_ROUNDS = 8
"""Rounds in which force and patch, and force and stiffness, agree to 0.1 %."""
