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
from policies.reflex import RESPONSE_S, SURE_SLIP, ReflexMemory
from primitives.contract import ForceTerms
from primitives.sense import Interval
from tacgrasp.rig.gel_sense import CLEAR_N

QUIET_FRAMES = 10
"""Frames of the hold at rest before anything moves, which tell the unit's noise. Our choice: a
tenth of a second with taxels."""

LEAST_RESERVE, DENIED = 0.05, -10.0
"""Reserve below which an object that is lifted off counts as held too lightly, and log odds of a
slip over the unit's threshold below which it does not. Our choice: on what is held by 0.1 N the
reserve is hardly more than noise; what slides there stays behind as well."""

CREPT_MM = 0.45
"""Way of the indentation along the pad that is a slip, whether or not any frame showed one [mm].
Our choice: it seems to be 0.38 mm at most in 174 lifts of a fruit that did not move."""

CHANGED = 1.3
"""Factor by which two felt forces differ that count as different ones, if one of them is clear
(``CLEAR_N``); a lighter contact is not felt in one frame alone. Our choice: above what noise makes
of the force in one frame."""

SURELY = 4.0
"""Standard deviations of its noise by which a way must exceed nothing. Our choice: a hold has some
hundred frames, of which no ten are independent."""


class ReflexHold:
    """One hold: its terms, what the frames tell of it, and the reflex's memory.

    Another thread may set what is asked of it, call ``rest`` and ``hang``, and read all else at any
    time.

    Args:
        terms: Force terms of the contract that is kept.
        felt: Force that was felt before it [N]; None where that is not known.
        judge: Tells slips.
        floor_n: Command that a hold before has asked for; it is not lowered below [N].
        rested: Shear field of the reading behind ``felt``; None where the sensor gives none.

    Attributes:
        memory: What the reflex remembers.
        newest_n: Force felt in the newest frame alone, from the first frame of the hold on [N];
            None where that is not known, of a light contact and of an object that stands.
        standing: Whether the object is lifted off, and a support may still catch it.
        is_rocked: Whether the object is rocked, which looks like a slip in some frames; it then
            takes a sure one.
        is_found: Whether a lift-off before has found about the force that holds the object.
        hanging: Whether nothing but the grip carries the object, so that a creep is a slip.
        ahead_n: Command that the next motion needs [N]; 0 for none.
        cues: Of the newest frame; None before there are any, and without contact.
        reserve: What a standing object could carry over its load; None until it is known.
        place_mm: Middle of the indentation of an object that is lifted off, (x, y), gel frame [mm];
            None until it is known.
        seen_s, slipped_s: Time of the newest reading, and of the newest one of a slip [s].
        called_s: The same of the newest frame that looks like a slip, in a rock too [s].
    """

    def __init__(
        self,
        terms: ForceTerms,
        felt: Interval | None,
        judge: SlipJudge,
        floor_n: float = 0.0,
        rested: ShearField | None = None,
    ) -> None:
        self.terms, self.memory = terms, ReflexMemory(floor_n=floor_n)
        self.is_found, self.is_rocked, self._rests = floor_n > 0, False, False
        self._hangs = False
        self.standing = self.hanging = False
        self.ahead_n = 0.0
        self.reserve: Reserve | None = None
        self.cues: ShearCues | None = None
        self.place_mm: tuple[float, float] | None = None
        self._began_n = 0.0
        self._judge, self._felt_n = judge, None if felt is None else felt.value
        self._quiet: list[ShearField] = []
        self._watch: ShearWatch | None = None
        self._indentation: HeldIndentation | None = None
        self.newest_n: float | None = None
        self._quiet_n: list[float] = []  # felt in each of the quiet frames
        self._gauge: HeldIndentation | None = None  # at rest under ``_felt_n``
        if rested is not None and felt is not None and felt.value >= CLEAR_N:
            self._gauge = HeldIndentation([rested])
        self.slipped_s, self.seen_s, self.called_s = -math.inf, -math.inf, -math.inf
        self._noise_mm: tuple[float, float] | None = None
        self._frames: deque[ShearField] = deque()

    @property
    def still_s(self) -> float:
        """Time from the last reading of a slip to the newest reading [s]; infinite without one."""
        return self.seen_s - self.slipped_s

    @property
    def indented_mm(self) -> tuple[float, float] | None:
        """Middle of the indentation, (x, y), gel frame [mm]; None while it is not known."""
        return None if self._indentation is None else self._indentation.place_mm

    @property
    def spread_mm(self) -> float:
        """Standard deviation of the difference of two such places [mm]."""
        return 0.0 if self._indentation is None else self._indentation.spread_mm

    def hang(self) -> None:
        """The object hangs, at rest until the next motion: its place is measured from now on.

        The next frame begins it: this may be called while another thread reads one.
        """
        self._hangs = True

    def rest(self) -> None:
        """A motion has ended: what is measured from the next frame on is of where it rests."""
        self._rests = True

    def felt_and_slip(
        self, field: ShearField | None, now_s: float, commanded_n: float
    ) -> tuple[float | None, float | None]:
        """Force felt in a frame [N], and log odds of a slip over the unit's threshold.

        None where it can't be told: no frame, no contact, or the unit's noise is still measured.
        While pads may slide along a standing object, the indentation changes with the place; its
        force is then that at rest times the growth of the command, until it hangs and has been seen
        at rest.
        """
        self._began_n = self._began_n or commanded_n
        if self._rests:
            self._rests = False
            self.renew()
        if self._hangs:
            self._hangs, self.hanging = False, True
            self._quiet, self._quiet_n, self._indentation, self._gauge = [], [], None, None
        self.newest_n = None if field is None else self._feel_newest(field)
        self.cues = None if field is None else self._see(field, commanded_n)
        if field is None or self.cues is None:
            return None, None
        slip, self.seen_s = self._judge.see(self.cues.values), now_s
        if slip > 0:
            self.called_s = now_s
        if self.is_rocked:
            slip -= SURE_SLIP
        if self.standing and not self.hanging:
            self._read_reserve(field, now_s)
            lacks = 0.0 if self.reserve is None else LEAST_RESERVE - self.reserve.middle
            if lacks > 0 and slip > DENIED:
                slip = max(slip, lacks)
        held = self._indentation
        if held is not None and self.hanging:
            least_mm = max(CREPT_MM, SURELY * held.spread_mm)
            if held.way_mm > least_mm:
                slip = max(slip, held.way_mm / least_mm - 1.0)
        if slip > 0:
            self.slipped_s = now_s
        if self.standing and (held is None or not self.hanging):
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

    def _feel_newest(self, field: ShearField) -> float | None:
        """Force felt in a frame alone [N]; None where that can't be told.

        It is measured from the reading before the hold, until the hold's own frames at rest are
        known. While pads may slide along a standing object, the indentation does not tell.
        """
        if self._indentation is not None:
            self._indentation.see(field)
        if self._gauge is not None and self._gauge is not self._indentation:
            self._gauge.see(field)
        may_slide = self.standing and not self.hanging
        growth = None if self._gauge is None or may_slide else self._gauge.newest_growth
        return None if growth is None or self._felt_n is None else self._felt_n * growth

    def _see(self, field: ShearField, commanded_n: float) -> ShearCues | None:
        if self._indentation is None:
            self._see_quiet(field, commanded_n)
        if self._watch is not None:
            return self._watch.see(field)
        if self._noise_mm is None:
            return None
        self._frames = deque(maxlen=num_frames(field.sensor))
        self._watch = ShearWatch(field.sensor, *self._noise_mm)
        for each in self._quiet:
            cues = self._watch.see(each)
        return cues

    def _see_quiet(self, field: ShearField, commanded_n: float) -> None:
        """Take a frame of the hold at rest; while the force changes it is not at rest.

        Its force is that of the reading, unless it has clearly changed since.
        """
        if self.newest_n is not None:
            if self._quiet_n and _differ(self.newest_n, self._quiet_n[0]):
                self._quiet, self._quiet_n = [], []
            self._quiet_n.append(self.newest_n)
        self._quiet.append(field)
        if len(self._quiet) < QUIET_FRAMES:
            return
        self._noise_mm = self._noise_mm or noise_of(self._quiet)
        self._indentation = HeldIndentation(self._quiet, self._noise_mm[1])
        if self._felt_n is None:
            return
        rest_n = self._felt_n * commanded_n / self._began_n
        if self._quiet_n:
            quiet_n = sum(self._quiet_n) / len(self._quiet_n)
            if _differ(quiet_n, rest_n):
                rest_n = quiet_n
        self._felt_n, self._began_n = rest_n, commanded_n
        self._gauge = self._indentation if rest_n >= CLEAR_N else None

    def renew(self) -> None:
        """A correction was commanded: the contact will change."""
        if self._watch is not None:
            self._watch.renew()
        if self._indentation is not None:
            self._indentation.renew()
        self._frames.clear()
        self.reserve = None


def _differ(force_n: float, other_n: float) -> bool:
    """Whether two felt forces [N] are clearly different ones."""
    is_near = other_n / CHANGED <= force_n <= other_n * CHANGED
    return not is_near and max(force_n, other_n) >= CLEAR_N
