"""The fit finds the gel that made its measurements; the preset is the fit to the real ones."""

import pytest

from sim.gel.layer import GelMaterial, gel_of
from tacgrasp.benchmarks.sensing import gel_fit
from tacgrasp.benchmarks.sensing.gel_fit import MEASURED_N, fit, model_forces_n
from tacgrasp.benchmarks.sensing.radial_profiles import gel, match, read_profiles, tacto, taxim
from tests.paths import SHARED_DATA
from tests.tacgrasp.benchmarks.sensing.test_radial_profiles import profile_of


def test_a_fit_finds_the_gel_that_made_a_profile_and_forces(monkeypatch):
    monkeypatch.setattr(gel_fit, "THICKNESSES_MM", (3.0, 3.3, 3.6))
    monkeypatch.setattr(gel_fit, "POISSONS", (0.47, 0.49))
    truth = GelMaterial(thickness_mm=3.3, young_mpa=0.37, poisson=0.47)
    forces = dict(zip(MEASURED_N, model_forces_n(truth), strict=True))
    monkeypatch.setattr(gel_fit, "MEASURED_N", forces)
    found = fit(profile_of(gel(truth), 0.82))
    assert found.material == truth
    assert found.profile.rmse_mm < 1e-3
    assert found.force_error < 1e-3


def test_the_preset_s_forces_are_within_a_tenth_of_the_measured_ones():
    model = model_forces_n(gel_of("gelsight_mini"))
    assert model == pytest.approx(list(MEASURED_N.values()), rel=0.10)


PROFILES = SHARED_DATA / "gelsight_mini_balls"


@pytest.mark.slow
def test_the_preset_is_the_fit_to_the_real_presses_and_nearer_than_tacto_and_taxim():
    known = [one for one in read_profiles(PROFILES) if one.diameter_mm == 6.31]
    if not known:
        pytest.skip(f"no profile of the 6.31 mm ball in {PROFILES}")
    preset = gel_of("gelsight_mini")
    assert fit(known[0]).material == preset
    ours = match(gel(preset), known[0], 0.0634).rmse_mm
    assert ours <= 0.0075
    assert match(tacto, known[0], 0.0634).rmse_mm > 4 * ours
    assert match(taxim, known[0], 0.0634).rmse_mm > 3 * ours
