"""One hold under the reflex: a creep that no frame shows is a slip, once the object hangs."""

import numpy as np
import pytest

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.field import ShearField
from primitives.contract import Band, ForceTerms
from tacgrasp.runtime.reflex_hold import QUIET_FRAMES, ReflexHold

TERMS = ForceTerms(force_n=Band(low=0.1, high=2.0), limit_n=3.0)
TAXELS = SENSORS["taxels"]
X, Y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(TAXELS, 12, 12)))
PERIOD_S = 0.01
CREEP_MM_S = 1.0


class Deaf:
    """Tells no slip in any frame."""

    def see(self, values):
        return -5.0


def frame(rng, x_mm, depth_mm=0.08, noise_mm=0.002):
    moved = noise_mm * rng.normal(size=(len(X), 3))
    moved[:, 2] += depth_mm * np.exp(-((X - x_mm) ** 2 + Y**2) / 8.0)
    positions = np.stack([X, Y], axis=1)
    return ShearField(positions_mm=positions, displacement_mm=moved, sensor=TAXELS, stamp=None)


@pytest.fixture
def rng():
    return np.random.default_rng(0)


@pytest.fixture
def see(rng):
    """Shows a hold the frames of a contact at some places; returns the slips that were told."""

    def see(hold, places_mm, **contact):
        told = [
            hold.felt_and_slip(frame(rng, x_mm, **contact), i * PERIOD_S, 0.3)[1]
            for i, x_mm in enumerate(places_mm)
        ]
        return [slip for slip in told if slip is not None]

    return see


@pytest.fixture
def hold():
    return ReflexHold(TERMS, None, Deaf())


def creep(seconds):
    return CREEP_MM_S * np.arange(0.0, seconds, PERIOD_S)


def test_what_rests_does_not_slip(hold, see):
    assert max(see(hold, np.zeros(300))) < 0


def test_a_creep_that_no_frame_shows_is_a_slip_in_the_end(hold, see):
    see(hold, np.zeros(QUIET_FRAMES))
    told = np.array(see(hold, creep(1.0)))
    crept_mm = CREEP_MM_S * PERIOD_S * np.argmax(told > 0)
    assert (told > 0).any()
    assert 0.3 < crept_mm < 0.7


def test_after_a_correction_the_way_counts_anew(hold, see):
    see(hold, np.zeros(QUIET_FRAMES))
    assert max(see(hold, creep(0.4))) < 0
    hold.renew()
    assert max(see(hold, 0.4 + creep(0.4))) < 0


def test_pads_that_rise_along_a_standing_object_do_not_creep(hold, see):
    see(hold, np.zeros(QUIET_FRAMES))
    hold.standing = hold.rising = True
    assert max(see(hold, creep(1.0))) < 0
    hold.hang()
    assert max(see(hold, np.full(QUIET_FRAMES + 50, 1.0))) < 0
    assert max(see(hold, 1.0 + creep(1.0))) > 0


def test_a_contact_that_noise_places_anywhere_does_not_creep(hold, see):
    assert max(see(hold, np.zeros(1000), depth_mm=0.02, noise_mm=0.02)) < 0
