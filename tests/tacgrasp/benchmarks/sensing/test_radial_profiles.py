"""Radial profiles of real balls, and what simulators make of them."""

import numpy as np
import pytest

from cltp.errors import TouchError
from sim.gel.layer import gel_of
from tacgrasp.benchmarks.sensing import radial_profiles
from tacgrasp.benchmarks.sensing.radial_profiles import (
    Profile,
    gel,
    match,
    read_profiles,
    tacto,
    taxim,
)

R_MM = (np.arange(28) + 0.5) * 0.2


def profile_of(simulator, depth, diameter=6.31, pitch=0.127):
    """What a simulator says, as a measured profile."""
    (height,) = simulator(diameter, np.array([depth]), pitch)
    flat = height - np.median(height)
    rings = np.floor(radial_profiles.radius_mm(pitch) / 0.2).astype(int)
    return Profile(
        diameter_mm=diameter, height_mm=np.array([np.median(flat[rings == k]) for k in range(28)])
    )


def written(folder, name, r=R_MM, height=R_MM):
    lines = "".join(f"{a},{b}\n" for a, b in zip(r, height, strict=True))
    (folder / name).write_text(f"# made\nr_mm,height_mm\n{lines}")


def test_profiles_are_read_by_their_names_smallest_first(tmp_path):
    written(tmp_path, "profile_9.5mm.csv")
    written(tmp_path, "profile_6.31mm.csv")
    written(tmp_path, "profile_mm.csv")
    assert [one.diameter_mm for one in read_profiles(tmp_path)] == [6.31, 9.5]
    assert read_profiles(tmp_path / "none") == []


def test_a_profile_of_other_bins_or_no_numbers_is_refused(tmp_path):
    written(tmp_path, "profile_5mm.csv", r=R_MM * 2)
    with pytest.raises(TouchError, match="28 bins"):
        read_profiles(tmp_path)
    (tmp_path / "profile_5mm.csv").write_text("r_mm,height_mm\nwide,deep\n")
    with pytest.raises(TouchError, match="can't be read"):
        read_profiles(tmp_path)


def test_the_depths_tried_for_the_fitted_ball_are_the_protocol_s():
    profile = Profile(diameter_mm=6.31, height_mm=np.full(28, 0.8344))
    np.testing.assert_allclose(profile.depths_mm, np.linspace(0.79, 0.85, 7))


def test_a_simulator_matches_its_own_profile_and_no_other_s():
    layer = gel(gel_of("gelsight_mini"))
    own = profile_of(layer, 0.80)
    assert match(layer, own, 0.127).rmse_mm < 1e-3
    assert match(tacto, own, 0.127).rmse_mm > 0.02


def test_tacto_s_gel_does_not_move_beside_the_ball_and_taxim_s_only_sinks():
    r = radial_profiles.radius_mm(0.127)
    (rendered,) = tacto(6.31, np.array([0.8]), 0.127)
    assert (rendered[r > 2.2] == 0).all()
    assert rendered.max() == pytest.approx(0.8, abs=2e-3)
    (blurred,) = taxim(6.31, np.array([0.8]), 0.127)
    assert blurred.min() >= 0
    assert 0.02 < blurred[(r > 2.2) & (r < 2.4)].mean() < 0.3
    assert blurred.max() == pytest.approx(0.8, abs=0.02)
