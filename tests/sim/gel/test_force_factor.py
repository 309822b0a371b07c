"""The factor of a gel is that of its modulus, and falls with its thickness."""

from dataclasses import replace

import pytest

from sim.gel.force_factor import force_factor
from sim.gel.layer import gel_of

NOMINAL = gel_of("gelsight_mini")


def test_the_factor_of_the_nominal_gel_is_one():
    assert force_factor(NOMINAL, "gelsight_mini") == 1.0


@pytest.mark.parametrize("ratio", [0.6, 1.4])
def test_a_gel_stiffer_by_a_ratio_needs_forces_greater_by_it(ratio):
    gel = replace(NOMINAL, young_mpa=ratio * NOMINAL.young_mpa)
    assert force_factor(gel, "gelsight_mini") == pytest.approx(ratio, rel=2e-3)


def test_a_thicker_gel_needs_less_force():
    thick, thin = (replace(NOMINAL, thickness_mm=h) for h in (4.2, 3.0))
    assert force_factor(thick, "gelsight_mini") < 0.9
    assert force_factor(thin, "gelsight_mini") > 1.1
