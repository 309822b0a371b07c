"""One hold under the reflex: its terms, what its frames tell, and what is asked of it.

Not here: what is decided from a reading (``policies.reflex``), when it is made
(``tacgrasp.runtime.reflex_loop``).
"""

from __future__ import annotations

import math
from collections import deque

from cltp.tactile.shear.contact_shear import ShearCues, ShearWatch
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.held_indentation import HeldIndentation
from cltp.tactile.shear.reserve import (
    Reserve,
    mean_field,
    num_frames,
    place_mm,
    reserve_model,
)
from cltp.tactile.shear.slip import SlipJudge, noise_of
from policies.reflex import RESPONSE_S, ReflexMemory
from primitives.contract import ForceTerms
from primitives.sense import Interval

QUIET_FRAMES = 10
"""Frames of the hold at rest before anything moves, which tell the unit's noise. Our choice: a
tenth of a second with taxels."""

LEAST_RESERVE = 0.15
"""Reserve below which an object that is lifted off counts as held too lightly. Our choice: a
contact that slides seldom seems to have as much."""

CREPT_MM = 0.45
"""Way of the indentation along the pad that is a slip, whether or not any frame showed one [mm].
Our choice: it seems to be 0.38 mm at most in 174 lifts of a fruit that did not move."""

SURELY, MOST_SPREAD_MM = 4.0, 0.2
"""Standard deviations of its noise by which a way must exceed nothing, and the largest one of a
contact that is told to creep [mm]. Our choice: in none of 247 holds of a fruit that did not move
does one of less seem to move so far; what a noisy unit feels under 0.1 N seems to be anywhere."""


class ReflexHold:
    """One hold: its terms, what the frames tell of it, and the reflex's memory.

    Another thread may set ``standing`` and ``ahead_n``, and read ``still_s``, at any time.

    Args:
        terms: Force terms of the contract that is kept.
        felt: Force that was felt before it [N]; None where that is not known.
        judge: Tells slips.
        floor_n: Command that a hold before has asked for; it is not lowered below [N].

    Attributes:
        memory: What the reflex remembers.
        standing: Whether a support still catches the object.
        rising: Whether the fingers rise slowly, so that the reserve is to be kept too.
        ahead_n: Command that the next motion needs [N]; 0 for none.
        cues: Of the newest frame; None before there are any, and without contact.
        reserve: What a standing object could carry over its load; None until it is known.
        place_mm: Middle of the indentation of an object that is lifted off, (x, y), gel frame [mm];
            None until it is known.
        seen_s, slipped_s: Time of the newest reading, and of the newest one of a slip [s].
    """

    def __init__(
        self, terms: ForceTerms, felt: Interval | None, judge: SlipJudge, floor_n: float = 0.0
    ) -> None:
        self.terms, self.memory = terms, ReflexMemory(floor_n=floor_n)
        self.standing = self.rising = False
        self.ahead_n = 0.0
        self.reserve: Reserve | None = None
        self.cues: ShearCues | None = None
        self.place_mm: tuple[float, float] | None = None
        self._began_n = 0.0
        self._judge, self._felt_n = judge, None if felt is None else felt.value
        self._quiet: list[ShearField] = []
        self._watch: ShearWatch | None = None
        self._indentation: HeldIndentation | None = None
        self.slipped_s, self.seen_s = -math.inf, -math.inf
        self._noise_mm: tuple[float, float] | None = None
        self._frames: deque[ShearField] = deque()

    @property
    def still_s(self) -> float:
        """Time from the last reading of a slip to the newest reading [s]; infinite without one."""
        return self.seen_s - self.slipped_s

    def hang(self) -> None:
        """The fingers have risen until the object hangs; it is at rest until the next motion."""
        self.rising = False
        self._quiet, self._indentation = [], None

    def felt_and_slip(
        self, field: ShearField | None, now_s: float, commanded_n: float
    ) -> tuple[float | None, float | None]:
        """Force felt in a frame [N], and log odds of a slip over the unit's threshold.

        None where it can't be told: no frame, no contact, or the unit's noise is still measured.
        While pads may slide along a standing object, the indentation changes with the place; its
        force is then that at rest times the growth of the command.
        """
        self._began_n = self._began_n or commanded_n
        self.cues = None if field is None else self._see(field)
        if field is None or self.cues is None:
            return None, None
        slip, self.seen_s = self._judge.see(self.cues.values), now_s
        if self.standing:
            self._read_reserve(field, now_s)
            if self.rising and self.reserve is not None and self.reserve.middle < LEAST_RESERVE:
                slip = max(slip, LEAST_RESERVE - self.reserve.middle)
        held = self._indentation
        if held is not None and not self.rising:
            creep = _creep(held)
            slip = max(slip, creep) if creep > 0 else slip
        if slip > 0:
            self.slipped_s = now_s
        if self.standing:
            growth: float | None = commanded_n / self._began_n
        else:
            growth = None if held is None else held.growth
        felt_n = None if growth is None or self._felt_n is None else self._felt_n * growth
        return felt_n, slip

    def _read_reserve(self, field: ShearField, now_s: float) -> None:
        """Read the reserve in the last frames; the first ones after a correction don't count."""
        assert self._noise_mm is not None  # measured, since there are cues
        if now_s - self.memory.raised_s <= RESPONSE_S:
            return
        self._frames.append(field)
        if len(self._frames) == self._frames.maxlen:
            mean = mean_field(self._frames)
            self.reserve = reserve_model(field.sensor.name).read(mean, self._noise_mm)
            self.place_mm = place_mm(mean)

    def _see(self, field: ShearField) -> ShearCues | None:
        if self._indentation is None:
            self._quiet.append(field)
            if len(self._quiet) == QUIET_FRAMES:
                self._noise_mm = self._noise_mm or noise_of(self._quiet)
                self._indentation = HeldIndentation(self._quiet, self._noise_mm[1])
        else:
            self._indentation.see(field)
        if self._watch is not None:
            return self._watch.see(field)
        if self._noise_mm is None:
            return None
        self._frames = deque(maxlen=num_frames(field.sensor))
        self._watch = ShearWatch(field.sensor, *self._noise_mm)
        for each in self._quiet:
            cues = self._watch.see(each)
        return cues

    def renew(self) -> None:
        """A correction was commanded: the contact will change."""
        if self._watch is not None:
            self._watch.renew()
        if self._indentation is not None:
            self._indentation.renew()
        self._frames.clear()
        self.reserve = None


def _creep(held: HeldIndentation) -> float:
    """Way of an indentation over the one that is a slip, less 1; 0 where noise hides it."""
    if held.spread_mm > MOST_SPREAD_MM:
        return 0.0
    return held.way_mm / max(CREPT_MM, SURELY * held.spread_mm) - 1.0
