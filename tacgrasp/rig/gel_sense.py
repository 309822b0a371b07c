"""Touch as the executor and the loop need it: contact by test, and the felt force.

Not here: how contact is tested (``cltp.tactile.contact.contact_test``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from itertools import count
from typing import TypeVar

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.contact.contact_test import NUM_FRAMES, UntouchedGel, prepare_tests
from cltp.tactile.contact.partial_pad import is_partial, partial_text
from cltp.tactile.contact.raised_pad import is_raised, raised_text
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec
from primitives.sense import ContactSense, Interval
from tacgrasp.rig.protocols import TactileSensor

T = TypeVar("T")


def frames_per_reading(sensor: SensorSpec) -> int:
    """Frames that a reading is the mean of."""
    return max(FRAMES_PER_READING, round(READING_S * sensor.frame_hz))


FELT_SPREAD, CUT_SPREAD = 0.30, 0.5
"""Half width of the interval of a felt force, in ln F: of a contact on the pad, and of one that the
pad's edge cuts or whose force is below ``CLEAR_N``. Source: 1.6 times the residual of
``cltp.tactile.measure.contact_state`` on simulated strawberries, tomatoes, eggs and pegs (40 of
each, 0.2 to 9 N): bias -0.16 to 0.14, standard deviation 0.11 to 0.16 on the pad; up to 0.32 of
all."""

KEPT_RATIO = 0.6
"""Least response of a contact that goes on, over that of one that begins. Our choice: above what is
followed as drift (``cltp.tactile.contact.contact_test.FOLLOWED_RATIO``)."""

FRAMES_PER_READING = 4
"""Least frames that a reading of the closed or open fingers is the mean of: the fingers stand still
meanwhile, 0.16 s at 25 Hz. Our choice: fine noise is halved, so that a berry is still felt at its
first touch where a unit's noise is three times what was measured. A faster sensor gives more frames
in the same time."""

READING_S = 0.16
"""That time [s]."""

CLEAR_N = 0.2
"""Felt force from which it is clear [nominal N: clear heights, whatever the gel's stiffness]."""

SPREADS = 1.6
"""Standard deviations of a unit's force scale in an interval, as in ``FELT_SPREAD``."""


def _raise(error: TouchError, attempt: int) -> None:
    raise error


def prepare(sensor: TactileSensor) -> None:
    """Compute what every reference of a sensor needs, before a device with a watchdog is connected.

    It takes this process for up to a second or two on a busy computer: the threads that feed a
    watchdog would have to wait.
    """
    with suppress(TouchError):  # who reads the sensor next is told
        prepare_tests(sensor.read())


class GelSense:
    """Contact and felt force of one sensor, against its gel with open fingers.

    The reference follows slow drift (``cltp.tactile.contact.contact_test.UntouchedGel``): in every
    frame that is clearly untouched, and around a light contact. What ``read`` gives is without it.

    Args:
        sensor: A connected sensor.

    Attributes:
        retry_or_raise: Called with each failure to read and its number, from 1; raises when it was
            one too many. By default every failure is.
    """

    def __init__(self, sensor: TactileSensor) -> None:
        self._sensor = sensor
        self.retry_or_raise: Callable[[TouchError, int], None] = _raise
        self._untouched: UntouchedGel | None = None
        self._cloud: TactileCloud | None = None  # the last one tested, with its result
        self._in_contact: bool | None = None

    def for_executor(self) -> ContactSense:
        """The functions that the executor is given."""
        return ContactSense(
            take_reference=self.take_reference,
            in_contact=self.read_contact,
            felt_force=lambda: None if self._cloud is None else self.felt_force(self._cloud),
        )

    def take_reference(self) -> None:
        """Take the gel with open fingers as untouched, and learn its noise.

        Raises:
            TouchError: The sensor gives no fresh cloud.
        """
        self._repeated(self._sensor.take_reference)
        averaged = frames_per_reading(self._sensor.spec)
        frames = [self._repeated(self._sensor.read) for _ in range(max(NUM_FRAMES, averaged))]
        self._untouched = UntouchedGel(frames, averaged=averaged)
        self._cloud, self._in_contact = None, False

    def read(self) -> TactileCloud:
        """Read the gel now: the mean of ``frames_per_reading`` new frames, tested for contact.

        From the first reference on it is less the drift since then.

        Raises:
            TouchError: The sensor gives no fresh cloud or measures only part of the pad, or the
                whole pad is raised over the reference.
        """
        cloud = self._sensor.read(frames_per_reading(self._sensor.spec))
        if is_partial(cloud):
            raise TouchError(f"{partial_text(cloud)}; look at the sensor, then grasp anew")
        if self._untouched is None:
            return cloud
        if is_raised(cloud):  # neither a contact that can be read nor none
            raise TouchError(f"{raised_text(cloud)}; look at the pad, then grasp anew")
        self._in_contact = self._tested(cloud, self._untouched)
        if self._in_contact:
            self._untouched.follow_around(cloud)
        else:
            self._untouched.follow(cloud)
        self._cloud = self._untouched.without_drift(cloud)
        return self._cloud

    def read_contact(self) -> bool:
        """Read the gel and test it while the fingers close.

        Raises:
            TouchError: The sensor gives no fresh cloud.
        """
        return bool(self.in_contact(self._repeated(self.read)))

    def _repeated(self, call: Callable[[], T]) -> T:
        for attempt in count(1):
            try:
                return call()
            except TouchError as error:
                self.retry_or_raise(error, attempt)
        raise AssertionError("unreachable")

    def in_contact(self, cloud: TactileCloud) -> bool | None:
        """Whether something touches the gel in a cloud; None before the first reference.

        A cloud that is not the last one read is tested as it is, and nothing is followed in it.
        """
        if cloud is not self._cloud and self._untouched is not None:
            self._in_contact = self._tested(cloud, self._untouched)
            self._cloud = cloud
        return None if self._untouched is None else self._in_contact

    def _tested(self, cloud: TactileCloud, gel: UntouchedGel) -> bool:
        """Whether a contact begins, or goes on, in a new cloud.

        A contact at the edge of what is felt would come and go with the noise.
        """
        evidence = gel.test(cloud)
        least = KEPT_RATIO if self._in_contact else 1.0
        return evidence.ratio >= least and not evidence.is_inverted

    def felt_force(self, cloud: TactileCloud) -> Interval | None:
        """Force that a cloud suggests [N], within its unit's spread too; None without contact."""
        state = contact_state(cloud, in_contact=self.in_contact(cloud))
        if not state.in_contact or state.force_n <= 0:
            return None
        scale = cloud.force_scale
        is_clear = not state.cut and state.force_n >= CLEAR_N * scale.factor
        read_spread = FELT_SPREAD if is_clear else CUT_SPREAD
        factor = math.exp(math.hypot(read_spread, SPREADS * scale.spread))
        return Interval(
            value=state.force_n, low=state.force_n / factor, high=state.force_n * factor
        )
