"""Training of the slip models: what is learned from loads made by hand, and a load as seen."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.shear.contact_shear import NUM_VALUES
from tacgrasp.training.slip import QUIET, SeenLoad, fit, see_load


def load(seed, *, slips):
    """Ten frames; the first cue tells a slip."""
    rng = np.random.default_rng(seed)
    cues = rng.standard_normal((10, NUM_VALUES))
    sliding = np.arange(10) >= 6 if slips else np.zeros(10, bool)
    cues[:, 0] = np.where(sliding, 3.0, -3.0) + 0.3 * rng.standard_normal(10)
    return SeenLoad(
        sensor="taxels",
        seed=seed,
        cues=cues,
        stick=np.where(sliding, 0.0, 0.8),
        slipped_mm=np.where(sliding, 0.5, 0.0),
    )


def test_a_cue_that_tells_is_learned_and_the_threshold_parts_what_was_held_out():
    model = fit([load(seed, slips=seed % 2 == 0) for seed in range(60)], 0)
    for seed in (100, 101):
        seen = load(seed, slips=seed == 100)
        scores = np.array([model.score(cues) for cues in seen.cues])
        assert (scores[seen.slips] > model.threshold).all()
        assert (scores[~seen.slips] < model.threshold + 1.0).all()


@pytest.mark.parametrize("slips", [True, False])
def test_loads_of_one_kind_alone_teach_nothing(slips):
    loads = [load(seed, slips=False) for seed in range(8)]
    if slips:
        loads = [
            SeenLoad(
                sensor=each.sensor,
                seed=each.seed,
                cues=each.cues,
                stick=np.zeros(10),
                slipped_mm=np.ones(10),
            )
            for each in loads
        ]
    with pytest.raises(TouchError, match="loads that slip, loads that hold"):
        fit(loads, 0)


def test_a_load_is_seen_by_units_of_every_sensor():
    seen = see_load(2, 101)
    assert [each.sensor for each in seen] == [name for name in QUIET for _ in range(2)]
    for each in seen:
        assert each.cues.shape == (len(each.stick), NUM_VALUES)
        assert np.isfinite(each.cues).all()
        assert not each.slips.any()
    assert (seen[0].cues != seen[1].cues).any()
