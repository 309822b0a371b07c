"""One hold under the reflex: what counts as a slip, in a hold, in a rise and in a rock."""

import numpy as np
import pytest

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.reserve import Reserve
from policies.reflex import SURE_SLIP
from primitives.contract import Band, ForceTerms
from primitives.sense import Interval
from tacgrasp.runtime import reflex_hold
from tacgrasp.runtime.reflex_hold import DENIED, LEAST_RESERVE, QUIET_FRAMES, ReflexHold

TERMS = ForceTerms(force_n=Band(low=0.1, high=2.0), limit_n=3.0)
TAXELS = SENSORS["taxels"]
X, Y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(TAXELS, 12, 12)))
PERIOD_S = 0.01
CREEP_MM_S = 1.0


class Judge:
    """Tells the same of every frame.

    Args:
        slip: Log odds of a slip over the threshold.
    """

    def __init__(self, slip=-5.0):
        self.slip = slip

    def see(self, values):
        return self.slip


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
    hold = ReflexHold(TERMS, None, Judge())
    hold.hanging = True
    return hold


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
    hold.standing, hold.hanging = True, False
    assert max(see(hold, creep(1.0))) < 0
    hold.hang()
    assert max(see(hold, np.full(QUIET_FRAMES + 50, 1.0))) < 0
    assert max(see(hold, 1.0 + creep(1.0))) > 0


def test_what_hangs_is_measured_from_the_next_frame_on(hold, see):
    see(hold, np.zeros(QUIET_FRAMES))
    hold.hang()  # while another thread may be reading a frame
    assert hold.indented_mm is not None
    see(hold, np.zeros(1))
    assert hold.indented_mm is None
    see(hold, np.zeros(QUIET_FRAMES - 1))
    assert hold.indented_mm is not None


def test_what_noise_makes_of_the_place_of_a_light_contact_is_no_creep(hold, see):
    assert max(see(hold, np.zeros(1000), depth_mm=0.03, noise_mm=0.015)) < 0


def test_what_stands_does_not_creep(hold, see):
    see(hold, np.zeros(QUIET_FRAMES))
    hold.hanging = False
    assert max(see(hold, creep(1.0))) < 0


@pytest.mark.parametrize(("slip", "is_told"), [(0.5 * SURE_SLIP, False), (1.5 * SURE_SLIP, True)])
def test_in_a_rock_it_takes_a_sure_slip(slip, is_told, see):
    hold = ReflexHold(TERMS, None, Judge(slip))
    hold.hanging = hold.is_rocked = True
    assert (max(see(hold, np.zeros(50))) > 0) is is_told
    hold.is_rocked = False
    assert max(see(hold, np.zeros(5))) > 0


@pytest.mark.parametrize(
    ("slip", "reserve", "is_told"),
    [
        (0.5 * DENIED, LEAST_RESERVE - 0.1, True),
        (0.5 * DENIED, LEAST_RESERVE + 0.1, False),
        (1.5 * DENIED, LEAST_RESERVE - 0.1, False),
    ],
)
def test_too_little_reserve_counts_unless_the_frames_deny_a_slip(
    slip, reserve, is_told, see, monkeypatch
):
    class Model:
        def read(self, mean, noise_mm):
            return Reserve(low=reserve - 0.2, middle=reserve)

    monkeypatch.setattr(reflex_hold, "reserve_model", lambda name: Model())
    hold = ReflexHold(TERMS, None, Judge(slip))
    hold.standing = True
    assert (max(see(hold, np.zeros(60))) > 0) is is_told


def test_a_force_that_a_lift_off_has_found_is_known_in_the_next_hold():
    assert ReflexHold(TERMS, None, Judge(), floor_n=0.2).is_found
    assert not ReflexHold(TERMS, None, Judge()).is_found


FELT = Interval(value=0.5, low=0.4, high=0.6)


@pytest.mark.parametrize(("depth_mm", "grown"), [(0.08, 1.0), (0.16, 2.0), (0.04, 0.5)])
def test_a_force_that_changed_since_the_reading_is_felt_in_the_first_frame(rng, depth_mm, grown):
    hold = ReflexHold(TERMS, FELT, Judge(), rested=frame(rng, 0.0))
    newest_n = []
    for k in range(QUIET_FRAMES + 5):
        felt_n, _ = hold.felt_and_slip(frame(rng, 0.0, depth_mm=depth_mm), k * PERIOD_S, 0.3)
        newest_n.append(hold.newest_n)
    assert newest_n == pytest.approx([grown * FELT.value] * len(newest_n), rel=0.2)
    assert felt_n == pytest.approx(grown * FELT.value, rel=0.1)


def test_quiet_frames_begin_anew_when_the_force_changes_among_them(rng):
    hold = ReflexHold(TERMS, FELT, Judge(), rested=frame(rng, 0.0))
    for k in range(QUIET_FRAMES - 1):
        hold.felt_and_slip(frame(rng, 0.0), k * PERIOD_S, 0.3)
    told = [
        hold.felt_and_slip(frame(rng, 0.0, depth_mm=0.16), 1.0 + k * PERIOD_S, 0.3)[0]
        for k in range(QUIET_FRAMES)
    ]
    assert told[:-1] == [None] * (QUIET_FRAMES - 1)
    assert told[-1] == pytest.approx(2 * FELT.value, rel=0.1)


def test_of_a_light_contact_one_frame_tells_no_force(rng):
    light = Interval(value=0.1, low=0.08, high=0.12)
    hold = ReflexHold(TERMS, light, Judge(), rested=frame(rng, 0.0))
    hold.felt_and_slip(frame(rng, 0.0), 0.0, 0.3)
    assert hold.newest_n is None


def test_frames_of_a_lowered_command_rest_at_less(rng):
    hold = ReflexHold(TERMS, FELT, Judge(), rested=frame(rng, 0.0))
    hold.felt_and_slip(frame(rng, 0.0), 0.0, 0.3)
    for k in range(QUIET_FRAMES + 5):
        told, _ = hold.felt_and_slip(frame(rng, 0.0, depth_mm=0.04), k * PERIOD_S, 0.15)
    assert told == pytest.approx(0.5 * FELT.value, rel=0.1)
    assert hold.newest_n == pytest.approx(0.5 * FELT.value, rel=0.15)


def test_the_force_of_what_hangs_is_felt_again_in_a_lift_off(see):
    felt = Interval(value=0.6, low=0.5, high=0.8)
    hold = ReflexHold(TERMS, felt, Judge())
    see(hold, np.zeros(QUIET_FRAMES))
    hold.standing = True
    see(hold, np.zeros(5), depth_mm=0.16)  # pads that slide along it show anything
    assert hold.newest_n is None
    hold.hang()
    see(hold, np.zeros(QUIET_FRAMES))
    see(hold, np.zeros(1), depth_mm=0.16)  # a gripper that has changed
    assert hold.newest_n == pytest.approx(1.2, rel=0.2)
