"""Draws of bodies: the laws that are fitted to them, and their histograms."""

import dataclasses

import numpy as np
import pytest

from policies.needs import NEEDS
from tacgrasp.benchmarks.loop.draws import QUANTITIES, DrawnBody, fitted_laws, histograms

BERRY = NEEDS["strawberry"]


def body(size_mm: float, young_mpa: float, factor: float = 1.0) -> DrawnBody:
    """A body that follows the laws, with ``factor`` on the force that bruises it."""
    least_n = float(BERRY.least_n.at(size_mm, young_mpa))
    bruise_n = factor * float(BERRY.most_n.at(size_mm, young_mpa))
    forces = (least_n, 2 * least_n)
    approaches = [float(BERRY.approach_mm.at(size_mm, young_mpa, force)) for force in forces]
    return DrawnBody(
        mass_g=20.0,
        size_mm=size_mm,
        young_mpa=young_mpa,
        friction=0.5,
        slip_minimum_n=0.6 * least_n,
        least_n=least_n,
        need_least_n=least_n,
        need_most_n=bruise_n,
        bruise_n=bruise_n,
        bruise_over_slip=bruise_n / least_n,
        bruise_kpa=25.0,
        forces_n=(*forces, forces[-1]),
        approaches_mm=(approaches[0], approaches[1], approaches[1]),
    )


BODIES = [body(size, young) for size in (22.0, 30.0, 41.0) for young in (0.1, 0.2, 0.31)]


def test_bodies_that_follow_the_laws_give_the_laws_back_without_a_residual():
    fits = fitted_laws("strawberry", BODIES)
    assert fits["most_n"]["young"] == pytest.approx(BERRY.most_n.young)
    assert fits["least_n"]["size"] == pytest.approx(BERRY.least_n.size)
    assert fits["approach_mm"]["force"] == pytest.approx(BERRY.approach_mm.force)
    for name in ("least_n", "most_n", "approach_mm"):
        assert fits[name]["bias"] == pytest.approx(0.0, abs=1e-9)
        assert fits[name]["spread"] == pytest.approx(0.0, abs=1e-9)


def test_a_bias_of_all_bodies_is_found():
    firm = [body(each.size_mm, each.young_mpa, 1.2) for each in BODIES]
    assert fitted_laws("strawberry", firm)["most_n"]["bias"] == pytest.approx(np.log(1.2))


def test_the_histograms_have_a_row_a_kind_and_a_column_a_quantity():
    alike = [dataclasses.replace(BODIES[0])] * 3
    figure = histograms({"strawberry": BODIES, "stone": alike})
    assert len(figure.axes) == 2 * len(QUANTITIES)
    drawn = sum(bar.get_height() for bar in figure.axes[0].patches)
    assert drawn == len(BODIES)
