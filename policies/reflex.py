"""The reflex: keeps the contract between two decisions, many times a second. It owns no goal.

A pure function: a reading, the contract's force terms and the reflex's own memory give one
correction of the gripper's force, with its reason, and the next memory.

* A slip raises the force by the least step; a slip that goes on, by ever larger ones, each after
  the gripper has had time to answer the one before.
* While the object is lifted off (``standing``), what slips falls nowhere, or hardly: steps up stay
  small, and each waits until the one before is felt, so that the grip ends just above what slips.
* Once that has found the force that holds (``is_found``), more than small steps need a sure slip.
* What the next motion needs more than the weight (``ahead_n``) is asked for before it begins.
* A felt force near the limit, in the newest frame alone too, lowers it at once, whatever a slip
  asks for: no command that is sent makes one.
* A felt force above the band lowers it, but not below what a slip has asked for.
* Nothing is ever asked for above the limit of the contract. Nobody can talk the reflex out of it:
  it reads no words.
* A reading that is stale, not finite or impossible for the force commanded is no reading. The force
  is then held; without a reading for ``MAX_BLIND_S`` the hold ends.

Sources: people raise their grip within tens of milliseconds of a slip (Johansson and Westling
1984, 'Roles of glabrous skin receptors and sensorimotor memory in automatic control of precision
grip'). Steps and times are our choice, as said beside each.

Not here: reading the sensor (``tacgrasp.runtime``), what a slip looks like
(``cltp.tactile.shear.slip``), keeping the limit where commands are written
(``primitives.force_guard``), goals and words.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum

from primitives.contract import ForceTerms

LEAST_FACTOR = 1.12
"""Factor of the first step up. Our choice: less than what a felt force varies between contacts."""

GROWTH = 2.0
"""Growth of a step from one to the next while a slip goes on. Our choice: the load that slides a
body may be twice what friction holds; four steps then reach it."""

MOST_FACTOR = 1.6
"""Largest factor of one step. Our choice: that of the teacher's ``increase_force``, nearly."""

SMALL_FACTOR, SMALL_EVERY_S = 1.1, 0.06
"""Factor of a small step up, and least time between two [s]. Our choice: the grip ends within a
step or two of what slips; command, gripper and two frames take the time."""

SURE_SLIP, SURE_FACTOR = 1.5, 1.2
"""Log odds over the unit's threshold from which a slip is sure, and the factor of a step up
against one where the force that holds is nearly known. Our choice: a body that slides has fallen by
millimetres in a tenth of a second and shows more, a jerk that only looks like a slip shows less."""

FRESH_S = 0.3
"""Time after a step within which a further slip is the same one [s]. Our choice."""

RESPONSE_S = 0.03
"""Time that a gripper takes to change its force [s]: that of the simulated one; a step is not
repeated before."""

LOWER_FACTOR = 0.9
"""Factor of a step down. Our choice."""

CLEARLY_ABOVE = 1.15
"""Factor above the band from which a force is lowered. Our choice: the felt force of one frame."""

LOWER_EVERY_S = 0.3
"""Least time between two steps down [s]. Our choice."""

NEAR_LIMIT, RELIEVED, LEAST_RELIEF = 0.85, 0.75, 0.55
"""Felt force over the limit from which a force counts as near the limit, what it is lowered to, and
the smallest factor of one such step. Our choice: a frame is off by a tenth, and feels too little of
a force that has doubled; a gripper's gain that becomes the largest that its rig states is undone in
one step; one frame that is wrong drops nothing that was held with a margin."""

IMPOSSIBLE = 3.0
"""Factor beyond the largest force that the command can make from which a reading is none. Our
choice: twice the error of a contact that the pad's edge cuts."""

NEWEST_POSSIBLE = 2.0
"""The same of the newest frame alone, which is then left out. Our choice: a gripper's gain may
double."""

PERIODS, MARGIN_S = 2.0, 0.02
"""A reading is stale after so many periods of the sensor and this margin [s], as in
``tacgrasp.rig.guard``."""

MAX_BLIND_S = 0.5
"""Longest hold without a reading [s]. Our choice: half of what a held move of the arm is given."""


_ROUNDING_S = 1e-6


class Act(StrEnum):
    """What the reflex asks for."""

    HOLD = "hold"
    RAISE = "raise"
    LOWER = "lower"
    END = "end"  # no reading for too long: the caller ends the hold as it ends on a lost sensor


@dataclass(frozen=True, slots=True, kw_only=True)
class ReflexReading:
    """What is known at one moment.

    Attributes:
        t_s: Now, on a monotonic clock [s].
        captured_s: When the newest frame was captured, same clock [s]; None: there is none.
        felt_n: Force felt in it and some frames before [N]; None where that is not known.
        newest_n: Force felt in it alone [N]; None likewise.
        slip: Log odds of a slip over the unit's threshold: above 0 is a slip; None where the
            sensor can't tell (it measures no shear, or nothing is touched).
        commanded_n: Force that the gripper was last commanded [N].
        most_felt_n: Largest felt force that this command can make [N].
        standing: Whether a support still catches the object while it is lifted off slowly.
        is_found: Whether a lift-off has found about the force that holds it.
        ahead_n: Command that the next motion needs [N]; 0 for none.
    """

    t_s: float
    captured_s: float | None
    felt_n: float | None
    slip: float | None
    commanded_n: float
    most_felt_n: float
    newest_n: float | None = None
    standing: bool = False
    is_found: bool = False
    ahead_n: float = 0.0

    @property
    def may_feel_n(self) -> float:
        """The larger of the felt forces [N], without an impossible one of the newest frame alone.

        0 where none is known.
        """
        newest_n = self.newest_n or 0.0
        if not newest_n <= NEWEST_POSSIBLE * self.most_felt_n:
            newest_n = 0.0
        return max(self.felt_n or 0.0, newest_n)


@dataclass(frozen=True, slots=True, kw_only=True)
class ReflexMemory:
    """What the reflex remembers of one hold.

    Attributes:
        raised_s: Time of the last step up [s].
        factor: Its factor.
        floor_n: Command that the last slip asked for [N]; nothing goes below it.
        lowered_s: Time of the last step down [s].
        blind_s: Since when there is no reading [s]; None while there is.
    """

    raised_s: float = -math.inf
    factor: float = 1.0
    floor_n: float = 0.0
    lowered_s: float = -math.inf
    blind_s: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Correction:
    """One answer of the reflex.

    Attributes:
        act: What it asks for.
        reason: Why, for people.
        force_n: Command that it asks for [N]; that of the reading where it holds.
    """

    act: Act
    reason: str
    force_n: float


def correct(
    reading: ReflexReading, terms: ForceTerms, memory: ReflexMemory, period_s: float
) -> tuple[Correction, ReflexMemory]:
    """One correction, and the memory after it.

    Args:
        reading: What is known now.
        terms: Force band and limit of the contract.
        memory: What the call before returned; ``ReflexMemory()`` at the start of a hold.
        period_s: Time between two frames of the sensor [s].
    """
    problem = _problem(reading, period_s)
    if problem:
        return _blind(reading, problem, memory)
    memory = replace(memory, blind_s=None)
    if reading.may_feel_n > NEAR_LIMIT * terms.limit_n:
        return _relieve(reading, reading.may_feel_n, terms, memory)
    if reading.slip is not None and reading.slip > 0:
        return _raise(reading, terms, memory)
    if reading.ahead_n > reading.commanded_n:
        return _prepare(reading, terms, memory)
    return _lower(reading, terms, memory)


def _problem(reading: ReflexReading, period_s: float) -> str:
    """Why a reading is none; '' for one that is."""
    if reading.captured_s is None or not math.isfinite(reading.captured_s):
        return "no frame"
    age_s = reading.t_s - reading.captured_s
    if not age_s <= PERIODS * period_s + MARGIN_S:
        return f"the newest frame is {1000 * age_s:.0f} ms old"
    if age_s < -MARGIN_S:
        return f"the newest frame is stamped {-1000 * age_s:.0f} ms in the future"
    for name, number in (("felt force", reading.felt_n), ("slip", reading.slip)):
        if number is not None and not math.isfinite(number):
            return f"the {name} is {number}"
    if reading.felt_n is not None and reading.felt_n > IMPOSSIBLE * reading.most_felt_n:
        return (
            f"{reading.felt_n:.2f} N felt under {reading.commanded_n:.2f} N commanded, which makes "
            f"at most {reading.most_felt_n:.2f} N"
        )
    return ""


def _hold(reading: ReflexReading, reason: str) -> Correction:
    return Correction(act=Act.HOLD, reason=reason, force_n=reading.commanded_n)


def _blind(
    reading: ReflexReading, problem: str, memory: ReflexMemory
) -> tuple[Correction, ReflexMemory]:
    since_s = reading.t_s if memory.blind_s is None else memory.blind_s
    memory = replace(memory, blind_s=since_s)
    if reading.t_s - since_s <= MAX_BLIND_S:
        return _hold(reading, problem), memory
    reason = f"{problem}; no reading for {reading.t_s - since_s:.1f} s"
    return Correction(act=Act.END, reason=reason, force_n=reading.commanded_n), memory


def _relieve(
    reading: ReflexReading, felt_n: float, terms: ForceTerms, memory: ReflexMemory
) -> tuple[Correction, ReflexMemory]:
    since_s = reading.t_s - max(memory.lowered_s, memory.raised_s)
    if since_s < RESPONSE_S - _ROUNDING_S:
        return _hold(reading, "near the limit, and the gripper is still answering"), memory
    force_n = reading.commanded_n * max(LEAST_RELIEF, RELIEVED * terms.limit_n / felt_n)
    memory = replace(memory, lowered_s=reading.t_s, floor_n=min(memory.floor_n, force_n))
    reason = f"{felt_n:.2f} N felt, near the limit of {terms.limit_n:.2f} N"
    return Correction(act=Act.LOWER, reason=reason, force_n=force_n), memory


def _raise(
    reading: ReflexReading, terms: ForceTerms, memory: ReflexMemory
) -> tuple[Correction, ReflexMemory]:
    since_s = reading.t_s - memory.raised_s
    is_sure = reading.slip is not None and reading.slip >= SURE_SLIP
    is_small = reading.standing or (reading.is_found and not is_sure)
    every_s = SMALL_EVERY_S if is_small else RESPONSE_S
    if since_s < every_s - _ROUNDING_S:
        return _hold(reading, "slip, and the gripper is still answering"), memory
    factor = SMALL_FACTOR if is_small else SURE_FACTOR if reading.is_found else LEAST_FACTOR
    if since_s < FRESH_S and not (reading.standing or reading.is_found):
        factor = min(MOST_FACTOR, 1 + GROWTH * (memory.factor - 1))
    force_n = _within_limit(reading, terms, reading.commanded_n * factor)
    if force_n <= reading.commanded_n:
        return _hold(reading, "slip, but the force is at its limit"), memory
    memory = replace(memory, raised_s=reading.t_s, factor=factor, floor_n=force_n)
    return Correction(act=Act.RAISE, reason="slip", force_n=force_n), memory


def _prepare(
    reading: ReflexReading, terms: ForceTerms, memory: ReflexMemory
) -> tuple[Correction, ReflexMemory]:
    force_n = _within_limit(reading, terms, reading.ahead_n)
    if force_n <= reading.commanded_n:
        return _hold(reading, "more is needed ahead, but the force is at its limit"), memory
    memory = replace(memory, floor_n=force_n)
    return Correction(act=Act.RAISE, reason="what is ahead", force_n=force_n), memory


def _within_limit(reading: ReflexReading, terms: ForceTerms, force_n: float) -> float:
    """A command that the felt force says to keep the limit [N]."""
    if reading.may_feel_n <= 0:
        return force_n
    most_n = RELIEVED * terms.limit_n
    return min(force_n, reading.commanded_n * most_n / reading.may_feel_n)


def _lower(
    reading: ReflexReading, terms: ForceTerms, memory: ReflexMemory
) -> tuple[Correction, ReflexMemory]:
    felt_n, top_n = reading.felt_n, terms.force_n.high
    if felt_n is None or felt_n <= CLEARLY_ABOVE * top_n:
        return _hold(reading, "kept"), memory
    if reading.t_s - max(memory.lowered_s, memory.raised_s) < LOWER_EVERY_S:
        return _hold(reading, "above the band, and the gripper is still answering"), memory
    force_n = max(reading.commanded_n * max(LOWER_FACTOR, top_n / felt_n), memory.floor_n)
    if force_n >= reading.commanded_n:
        return _hold(reading, "above the band, as a slip has asked for"), memory
    memory = replace(memory, lowered_s=reading.t_s)
    reason = f"{felt_n:.2f} N felt, above {top_n:.2f} N"
    return Correction(act=Act.LOWER, reason=reason, force_n=force_n), memory
