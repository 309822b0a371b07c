"""What objects of a kind need, by their size and stiffness, and which of it touch has told.

A berry's size tells about how heavy it is, its stiffness how ripe. Both are read from the gripper's
opening under two forces, and from the felt force; ``TouchedObject`` weighs them against each other.
Friction is not felt. A berry's least force is that at the least friction of its kind, so that it
surely holds. A fruit's is that at a middle friction, against weight alone: a grip that begins there
is light, and slip tells what is missing.

Not here: where between the two the target lies (``policies.contract_steps``).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from policies.observation import Observation

Numbers = NDArray[np.float64]

SIZE_MM, YOUNG_MPA = 30.0, 0.2
"""Size and stiffness at which a ``Law`` has its value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Law:
    """A power law.

    Attributes:
        value: Value at ``SIZE_MM``, ``YOUNG_MPA`` and 1 N.
        size, young, force: Exponents of size, Young's modulus and force.
    """

    value: float
    size: float
    young: float = 0.0
    force: float = 0.0

    def at(
        self,
        size_mm: Numbers | float,
        young_mpa: Numbers | float,
        force_n: Numbers | float = 1.0,
    ) -> Numbers:
        """Value at sizes [mm], moduli [MPa] and forces [N]; shapes broadcast."""
        value = self.value * (size_mm / SIZE_MM) ** self.size
        return np.asarray(value * (young_mpa / YOUNG_MPA) ** self.young * force_n**self.force)


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectNeeds:
    """What objects of one kind need.

    Attributes:
        least_n: Least force that a grip begins with [N]: what holds one through the lift at the
            least friction, or against its weight alone at a middle one.
        most_n: Largest such force [N]: what bruises one, or a part of it that surely does not.
        approach_mm: Approach of either gelled finger, flesh and gel together [mm].
        young_mpa: Young's modulus that goes with a size [MPa].
        young_spread: Standard deviation of ln E about it.
    """

    least_n: Law
    most_n: Law
    approach_mm: Law
    young_mpa: Law
    young_spread: float


MIDDLE_FRICTION = 0.55
"""Friction of the fruit that the least force holds against its weight: the middle of the range
drawn in ``sim.grasp``."""

SURELY_UNBRUISED = 0.6
"""Force that no fruit of a ripeness bruises at, over what ripeness tells. Source: the range of
``sim.grasp.fruit.BRUISE_FACTOR``."""

# Fitted to 120 drawn bodies of each kind (seeds from 500,000); ``tacgrasp bench draws`` fits them
# anew and prints the residuals. A fruit's most_n is the closed form of ripeness, no fit.
NEEDS: Mapping[str, ObjectNeeds] = {
    "strawberry": ObjectNeeds(
        least_n=Law(value=0.372, size=3.025),
        most_n=Law(value=1.074, size=1.544, young=1.147),
        approach_mm=Law(value=0.869, size=-0.19, young=-0.711, force=0.624),
        young_mpa=Law(value=0.157, size=1.297),
        young_spread=0.14,
    ),
    "fruit": ObjectNeeds(
        least_n=Law(value=0.157, size=2.669),
        most_n=Law(value=0.663, size=1.358, young=1.282),
        approach_mm=Law(value=0.833, size=-0.011, young=-0.761, force=0.641),
        young_mpa=Law(value=0.125, size=1.182),
        young_spread=0.151,
    ),
}
"""Needs by the name that a task gives in ``goal.needs``."""

GAIN_SPREAD, CUT_SPREAD = 0.14, 0.32
"""Standard deviations of ln of a felt force over the true one: on the pad, and cut by its edge.
Source: ``tacgrasp.rig.gel_sense``."""

FRAME_SPREAD = 0.05
"""The part of it that differs from grip to grip."""

WIDTH_SPREAD_MM = 0.08
"""Standard deviation of an opening [mm]: a servo of 9 ticks a millimetre, and the power law."""

_GAINS = np.linspace(-0.6, 0.6, 49)[:, None]
_YOUNGS = np.linspace(-3.0, 3.0, 31)[None, :]


@dataclass(frozen=True, slots=True, kw_only=True)
class FeltNeed:
    """What an object needs, as felt in the present grip.

    Attributes:
        size_mm: Its size between the fingers, unpressed [mm].
        young_mpa: Its Young's modulus [MPa].
        least_n, most_n: Felt forces that hold it and that bruise it [N].
    """

    size_mm: float
    young_mpa: float
    least_n: float
    most_n: float

    @property
    def text(self) -> str:
        """Size and stiffness, for people."""
        return f"{self.size_mm:.0f} mm wide, {self.young_mpa:.2f} MPa"


class TouchedObject:
    """Size and stiffness of one object, out of the grips of an episode."""

    def __init__(self, needs: ObjectNeeds) -> None:
        self._needs = needs
        self._grips: list[tuple[float, float, float]] = []  # command [N], opening [mm], ln gain
        self._are_whole = False

    def feel(self, observation: Observation, *, is_whole: bool) -> FeltNeed | None:
        """Take a grip; what the object needs after it, None where it can't be told.

        Args:
            observation: The grip.
            is_whole: Whether the pad's edge leaves the contact whole; other grips count until one
                is.
        """
        felt, width_m = observation.felt_force_n, observation.width_m
        commanded_n = observation.commanded_force_n
        if felt is None or not width_m or not commanded_n or felt.value <= 0:
            return None
        if is_whole and not self._are_whole:
            self._grips, self._are_whole = [], True
        if is_whole or not self._are_whole:
            gain = math.log(felt.value / commanded_n)
            self._grips.append((commanded_n, 1e3 * width_m, gain))
        return self._need(felt.value / commanded_n)

    def _need(self, felt_per_command: float) -> FeltNeed:
        """Weigh gain and stiffness on a grid; sizes follow from the openings."""
        commands, widths, gains = (np.array(each) for each in zip(*self._grips, strict=True))
        gain = float(gains.mean())
        forces = np.exp(gain + _GAINS)[..., None] * commands
        youngs, sizes = self._youngs_and_sizes(forces, widths)
        size = sizes.mean(axis=-1)
        spread = GAIN_SPREAD if self._are_whole else CUT_SPREAD
        gain_spread = math.hypot(spread, FRAME_SPREAD / math.sqrt(len(commands)))
        improbable = (_GAINS / gain_spread) ** 2 + _YOUNGS**2
        improbable = improbable + (((sizes - size[..., None]) / WIDTH_SPREAD_MM) ** 2).sum(axis=-1)
        weight = np.exp(-0.5 * (improbable - improbable.min()))
        weight /= weight.sum()

        def mean(values: Numbers) -> float:
            return math.exp(float((weight * np.log(values)).sum()))

        true_gain = np.exp(gain + _GAINS) * np.ones_like(_YOUNGS)
        least = mean(self._needs.least_n.at(size, youngs) / true_gain)
        most = mean(self._needs.most_n.at(size, youngs) / true_gain)
        return FeltNeed(
            size_mm=mean(size),
            young_mpa=mean(youngs),
            least_n=least * felt_per_command,
            most_n=most * felt_per_command,
        )

    def _youngs_and_sizes(self, forces_n: Numbers, widths_mm: Numbers) -> tuple[Numbers, Numbers]:
        """Moduli (G, E) and the size that each grip tells (G, E, K), for forces (G, 1, K)."""
        needs = self._needs
        spread = np.exp(needs.young_spread * _YOUNGS) * np.ones_like(_GAINS)
        sizes = np.ones_like(forces_n) * widths_mm * np.ones_like(_YOUNGS)[..., None]
        youngs = spread
        for _ in range(3):
            size = sizes.mean(axis=-1)
            youngs = needs.young_mpa.at(size, YOUNG_MPA) * spread
            approach = needs.approach_mm.at(size[..., None], youngs[..., None], forces_n)
            sizes = widths_mm + 2 * approach
        return youngs, sizes
