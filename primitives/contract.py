"""The contract of an episode: what words, configuration and task come to, as limits that hold.

It is made once an episode, before anything moves. The goal of the language model, the test of
success and the limits of the executor are all taken from it. It lives here because the executor
obeys it. Not here: reading words (``policies.contract``), task files (``tacgrasp.config``).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from primitives.errors import LimitError

LIMIT_OVER_BAND = 1.25
"""Hard limit over the top of the force band, where nobody named a limit. Our choice: a felt force
is off by up to a quarter."""

NEUTRAL_LEAN = 0.33
"""Lean of a target where nobody asks for another. Our choice: a little nearer to the least, since
most objects have more friction than the least of their kind."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """A closed interval; the unit is in the name of the bounded quantity.

    Raises:
        ValueError: A bound is not finite, or ``low`` is above ``high``.
    """

    low: float
    high: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low <= self.high):
            raise ValueError(f"a band needs finite low <= high, got {self.low} .. {self.high}")

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high

    def within(self, other: Band) -> bool:
        """Whether all of this band lies in another one."""
        return other.low <= self.low and self.high <= other.high

    @property
    def middle(self) -> float:
        """Arithmetic mean of the bounds."""
        return (self.low + self.high) / 2


DEFAULT_DEPTH_MM = Band(low=0.0, high=5.0)
DEFAULT_AREA = Band(low=0.0, high=1.0)
"""Bands of depth and area where nobody sets them: a force that is asked for decides them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceTerms:
    """A force band and the limit above it.

    Attributes:
        force_n: Felt normal force of a good grasp [N].
        limit_n: Felt force that is never exceeded [N].
        needs: Kind of object whose size and stiffness place the target of a step within the band
            (a name in ``policies.needs``); '' where the whole band is the target.

    Raises:
        LimitError: The band is not positive, or reaches above the limit.
    """

    force_n: Band
    limit_n: float
    needs: str = ""

    def __post_init__(self) -> None:
        if not (self.force_n.low > 0 and math.isfinite(self.limit_n)):
            raise LimitError(
                f"force terms need a band above 0 N and a finite limit, got "
                f"{self.force_n.low:g}-{self.force_n.high:g} N and {self.limit_n:g} N"
            )
        if self.force_n.high > self.limit_n:
            raise LimitError(
                f"the force band {self.force_n.low:g}-{self.force_n.high:g} N reaches above its "
                f"limit {self.limit_n:g} N"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskTerms:
    """What the task and the gripper say before any words are read.

    Attributes:
        name: Name of the task.
        object: The object between the fingers, in words.
        instruction: The task's own instruction; its manner is that of the task's band.
        force: Force band and limit of the task.
        slip_mm: Largest shift of the contact that still counts as held [mm].
        x_mm, y_mm: Place of the contact on the pad [mm].
        depth_mm: Indentation [mm].
        area_fraction: Fraction of the sensing area in contact, 0 to 1.
        least_n: Least force that the gripper can keep to for certain [N].
        most_n: Largest force of the gripper [N].
        soft: Terms of soft objects, which a soft contact is held to; None: none are known.
        others: Terms of other tasks by their own instruction, which stands for them.
        defaults: Names of the bands that the task leaves to their defaults.
    """

    name: str
    object: str
    instruction: str
    force: ForceTerms
    slip_mm: float
    x_mm: Band
    y_mm: Band
    depth_mm: Band
    area_fraction: Band
    least_n: float
    most_n: float
    soft: ForceTerms | None = None
    others: Mapping[str, ForceTerms] = field(default_factory=dict)
    defaults: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class Contract:
    """What an episode may do, or why it is refused.

    Attributes:
        text: The instruction that was read.
        summary: What was understood, in a few words ('hold the berry').
        force_n: Felt normal force of a good grasp [N]; None when refused.
        limit_n: Felt force that is never exceeded [N]; None when refused.
        slip_mm: Largest shift of the contact that still counts as held [mm].
        x_mm, y_mm: Place of the contact on the pad [mm].
        depth_mm: Indentation [mm].
        area_fraction: Fraction of the sensing area in contact, 0 to 1.
        origins: Origin of each band, by the name of its field ('your words: gently').
        assumed: What nobody said, and what was said and not used, one note each.
        insists: Whether the configuration names the force: what is felt may then not object.
        soft: Terms that a soft contact is held to; None: what is felt may not object.
        needs: As in ``ForceTerms``.
        lean: Where the target of a step stands between the least force that surely holds the
            object (0) and the most that surely leaves it unbruised (1), where ``needs`` places it.
        scale: Factor on that target that the words name ('half as hard').
        refused: Reason of a refusal; '' when the contract stands.

    Raises:
        LimitError: It is refused and has a band, or it stands without one.
    """

    text: str
    summary: str
    force_n: Band | None
    limit_n: float | None
    slip_mm: float
    x_mm: Band
    y_mm: Band
    depth_mm: Band
    area_fraction: Band
    origins: Mapping[str, str] = field(default_factory=dict)
    assumed: tuple[str, ...] = ()
    insists: bool = False
    soft: ForceTerms | None = None
    needs: str = ""
    lean: float = NEUTRAL_LEAN
    scale: float = 1.0
    refused: str = ""

    def __post_init__(self) -> None:
        bounded = self.force_n is not None and self.limit_n is not None
        if bounded == bool(self.refused):
            raise LimitError("a contract has a force band and a limit, or a reason of its refusal")
        if bounded:
            _ = self.terms  # checks the band against the limit

    @property
    def terms(self) -> ForceTerms:
        """Force band and limit.

        Raises:
            LimitError: The contract is refused; nothing may move.
        """
        if self.force_n is None or self.limit_n is None:
            raise LimitError(f"refused: {self.refused}; nothing was moved")
        return ForceTerms(force_n=self.force_n, limit_n=self.limit_n, needs=self.needs)


def default_limit_n(force_n: Band) -> float:
    """Hard limit of a force band without one of its own [N]."""
    return LIMIT_OVER_BAND * force_n.high
