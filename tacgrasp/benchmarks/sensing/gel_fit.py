"""The fit of the GelSight Mini's gel: thickness, Poisson's ratio and Young's modulus together.

Two measurements decide: the radial profile of a pressed ball (``radial_profiles``), which no
modulus changes, and the forces of a larger ball at two depths. No layer meets both exactly: thicker
and more compressible ones meet the forces, thinner and less compressible ones the profile. The fit
takes the least sum of squares of the errors, each over the largest that is allowed.

The real gel is domed, 4.0 mm at the apex and about 3.3 at the edge; ours is flat, and its thickness
lies between.

Source of the forces: github.com/feats-ai/feats, material identification, as read in the project's
notes; one unit, a dotted gel.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace

import numpy as np
import torch

from sim.gel.layer import ElasticLayer, GelMaterial
from tacgrasp.benchmarks.sensing.radial_profiles import (
    FIT_PITCH_MM,
    Match,
    Profile,
    ball_gap_mm,
    gel,
    match,
    radius_mm,
)

BALL_DIAMETER_MM = 15.0
MEASURED_N = {0.5: 1.65, 1.5: 13.53}
"""Measured forces [N] by the depth of the press [mm]."""

LARGEST_FORCE_ERROR, LARGEST_RMSE_MM = 0.10, 0.0075
"""Errors that are allowed: of either force, as a fraction, and of the profile [mm]."""

THICKNESSES_MM = tuple(round(0.1 * k, 1) for k in range(30, 45))
POISSONS = (0.46, 0.465, 0.47, 0.475, 0.48, 0.485, 0.49, 0.495)
"""Values that a fit may choose. Silicone gels are nearly incompressible. Thicknesses 0.1 mm apart
differ by 0.0001 to 0.001 mm RMSE in the profile, Poisson's ratios 0.005 apart by 0.0002 mm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GelFit:
    """A gel and its errors.

    Attributes:
        material: The gel.
        profile: Its error against the profile.
        force_error: Larger error of the two forces, as a fraction.
    """

    material: GelMaterial
    profile: Match
    force_error: float

    @property
    def cost(self) -> float:
        """Sum of squares of both errors, each over the largest allowed."""
        return (self.force_error / LARGEST_FORCE_ERROR) ** 2 + (
            self.profile.rmse_mm / LARGEST_RMSE_MM
        ) ** 2


def model_forces_n(material: GelMaterial) -> list[float]:
    """Forces of the gel [N] at the depths of ``MEASURED_N``."""
    r = radius_mm(FIT_PITCH_MM)
    gap = torch.from_numpy(ball_gap_mm(r, BALL_DIAMETER_MM))[None].expand(len(MEASURED_N), -1, -1)
    layer = ElasticLayer(material, rows=r.shape[0], columns=r.shape[1], pitch_mm=FIT_PITCH_MM)
    return layer.press_to_depth(gap, torch.tensor(list(MEASURED_N)), tol=1e-3).force_n.tolist()


def fit(profile: Profile) -> GelFit:
    """Fit a gel to a profile and to the measured forces, on a 0.127 mm grid.

    Young's modulus scales forces alone: for each thickness and Poisson's ratio it is the one whose
    errors at the two depths are opposite and equal.
    """
    fits = []
    for thickness, poisson in itertools.product(THICKNESSES_MM, POISSONS):
        unit = GelMaterial(thickness_mm=thickness, young_mpa=1.0, poisson=poisson)
        ratios = np.array(model_forces_n(unit)) / np.array(list(MEASURED_N.values()))
        young = round(2.0 / float(ratios.min() + ratios.max()), 3)
        fits.append(
            GelFit(
                material=replace(unit, young_mpa=young),
                profile=match(gel(unit), profile, FIT_PITCH_MM),
                force_error=float(np.abs(young * ratios - 1).max()),
            )
        )
    return min(fits, key=lambda each: each.cost)
