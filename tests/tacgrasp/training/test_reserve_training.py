"""Training what tells a contact's reserve."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.shear.contact_shear import NUM_OF_RESERVE
from cltp.tactile.shear.reserve import QUANTILES
from tacgrasp.training.reserve import FIRST_SEED, MOST, STANDS, SeenGrips, fit, write_grips
from tacgrasp.training.slip_loads import SENSORS


def lessons(count=2000, noise=0.2):
    """A reserve that two cues tell, with known errors."""
    rng = np.random.default_rng(0)
    cues = rng.standard_normal((count, NUM_OF_RESERVE))
    reserve = 0.5 * cues[:, 0] - 0.3 * cues[:, 1] + noise * rng.standard_normal(count)
    return SeenGrips(cues=cues, reserve=reserve, body=np.arange(count) % 50)


def test_quantiles_are_learned_and_the_errors_are_those_of_bodies_held_out():
    _, errors = fit(lessons(), seed=0)
    assert errors.grips == 400
    assert errors.middle == pytest.approx(0.2 * np.sqrt(2 / np.pi), rel=0.35)
    assert errors.below == pytest.approx(QUANTILES[0], abs=0.08)


def test_bodies_are_needed_to_learn_from_and_to_hold_out():
    one = lessons(20)
    with pytest.raises(TouchError, match="needs bodies"):
        fit(
            SeenGrips(cues=one.cues, reserve=one.reserve, body=np.zeros(20, dtype=np.int64)), seed=0
        )


def test_the_grips_of_a_body_are_kept_with_the_reserve_that_is_learned(tmp_path):
    write_grips(tmp_path, FIRST_SEED)
    with np.load(tmp_path / f"body_{FIRST_SEED}.npz") as held:
        reserve = held["reserve"]
        assert all(len(held[name]) == len(reserve) > 3 for name in SENSORS)
    assert reserve.min() >= STANDS - 1e-6 and reserve.max() <= MOST + 1e-6
    assert reserve[-1] > reserve[0]
    assert not list(tmp_path.glob("*.part"))
