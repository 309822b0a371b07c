"""Figures of the direct measurement: what is felt nearly untouched, and the fitted constant."""

from dataclasses import replace

import pytest

from cltp.tactile.measure import STIFFNESS_N_PER_MM3
from tacgrasp.benchmarks.sensing.touch import (
    FIRM_N,
    felt_untouched,
    fitted_stiffness,
    grasp_samples,
)


def test_next_to_nothing_is_felt_on_nearly_untouched_frames():
    felt = felt_untouched(20)["felt_untouched"]
    assert felt["n"] == 20
    assert felt["p50_n"] <= 0.05
    assert felt["within_0_2_n"] >= 0.9


def test_the_constant_of_the_force_is_fitted_to_the_true_forces():
    samples = [sample for sample in grasp_samples("egg", 3) if sample.force_n >= FIRM_N]
    doubled = [replace(sample, force_n=2 * sample.force_n) for sample in samples]
    fitted = fitted_stiffness(samples)
    assert fitted_stiffness(doubled) == pytest.approx(2 * fitted)
    assert fitted == pytest.approx(STIFFNESS_N_PER_MM3, rel=0.3)
