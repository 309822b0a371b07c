"""Radial height profiles of real ball presses, and the errors of simulators against them.

The protocol: 28 bins of 0.2 mm, the median in each; the median of the whole frame subtracted on
both sides; the press depth free within 0.06 mm of the measured one (0.79-0.85 mm for the 6.31 mm
ball), everything else fixed. The gel is fitted on that ball and on forces
(``tacgrasp.benchmarks.sensing.gel_fit``).

TACTO's and Taxim's surfaces are our own code after their publications.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from cltp.errors import TouchError
from cltp.processor import torch_threads
from sim.gel.layer import ElasticLayer, GelMaterial, Press

FloatArray = NDArray[np.float64]

SENSING_AREA_MM = (15.2, 20.3)
BIN_MM, NUM_BINS = 0.2, 28
FIT_DIAMETER_MM = 6.31
FIT_PITCH_MM = 0.127

_FILE = re.compile(r"profile_(\d+(?:\.\d+)?)mm\.csv")


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """Measured radial profile of a pressed ball.

    Attributes:
        diameter_mm: Diameter of the ball [mm].
        height_mm: Shape (28,), median height in each bin [mm].
    """

    diameter_mm: float
    height_mm: FloatArray

    @property
    def depths_mm(self) -> FloatArray:
        """Seven possible depths of the press, from 0.04 mm below the peak to 0.02 mm above [mm]."""
        peak = round(float(self.height_mm[0]), 2)
        return np.linspace(peak - 0.04, peak + 0.02, 7)


@dataclass(frozen=True, slots=True, kw_only=True)
class Match:
    """Least root mean square error of a simulated profile, and the depth at which it has it."""

    rmse_mm: float
    depth_mm: float


def read_profiles(folder: Path) -> list[Profile]:
    """Read each ``profile_<diameter>mm.csv`` of a folder, smallest ball first.

    Raises:
        TouchError: A file does not hold 28 radii and heights.
    """
    profiles = []
    for path in folder.glob("profile_*mm.csv"):
        name = _FILE.fullmatch(path.name)
        if name is None:
            continue
        try:
            r_mm, height_mm = np.loadtxt(path, delimiter=",", comments=("#", "r_mm")).T
        except (OSError, ValueError) as error:
            raise TouchError(f"{path} can't be read as r_mm,height_mm: {error}") from None
        expected = (np.arange(NUM_BINS) + 0.5) * BIN_MM
        if r_mm.shape != expected.shape or not np.allclose(r_mm, expected, atol=1e-3):
            raise TouchError(f"{path}: expected {NUM_BINS} bins of {BIN_MM} mm from 0 on")
        profiles.append(Profile(diameter_mm=float(name[1]), height_mm=height_mm))
    return sorted(profiles, key=lambda profile: profile.diameter_mm)


def radius_mm(pitch_mm: float) -> FloatArray:
    """Distance of each element of the sensing area from its centre, (H, W) [mm]."""
    rows, columns = (round(extent / pitch_mm) for extent in SENSING_AREA_MM)
    y = (np.arange(rows) - (rows - 1) / 2) * pitch_mm
    x = (np.arange(columns) - (columns - 1) / 2) * pitch_mm
    return np.asarray(np.hypot(y[:, None], x[None, :]))


Surfaces = Iterator[NDArray[np.floating]]
Simulator = Callable[[float, FloatArray, float], Surfaces]
"""(diameter [mm], depths [mm], pitch [mm]) to a height map for each depth."""


def match(simulator: Simulator, profile: Profile, pitch_mm: float) -> Match:
    """Compare a simulator with a profile at the depth of least error."""
    r, depths = radius_mm(pitch_mm), profile.depths_mm
    bins = np.floor(r / BIN_MM).astype(int)
    rings = [bins == k for k in range(NUM_BINS)]
    errors = []
    for height in simulator(profile.diameter_mm, depths, pitch_mm):
        flat = height - np.median(height)
        medians = np.array([np.median(flat[ring]) for ring in rings])
        errors.append(float(np.sqrt(np.mean((medians - profile.height_mm) ** 2))))
    best = int(np.argmin(errors))
    return Match(rmse_mm=errors[best], depth_mm=float(depths[best]))


def gel(material: GelMaterial) -> Simulator:
    """Our elastic layer."""

    def surfaces(diameter_mm: float, depths_mm: FloatArray, pitch_mm: float) -> Surfaces:
        r, start = radius_mm(pitch_mm), None
        gap = torch.from_numpy(ball_gap_mm(r, diameter_mm))[None]
        layer = ElasticLayer(material, rows=r.shape[0], columns=r.shape[1], pitch_mm=pitch_mm)
        for depth in depths_mm:
            start = _press(layer, gap, float(depth), start)
            yield start.height_mm[0].numpy()

    return surfaces


@torch_threads()
def _press(layer: ElasticLayer, gap: torch.Tensor, depth: float, start: Press | None) -> Press:
    return layer.press_to_depth(gap, torch.tensor(depth), start=start, tol=1e-3)


def tacto(diameter_mm: float, depths_mm: FloatArray, pitch_mm: float) -> Surfaces:
    """TACTO: the sensor renders the part of the object's surface that is inside the gel.

    Source: Wang et al. (2022), TACTO, section III: the gel does not deform.
    """
    gap = ball_gap_mm(radius_mm(pitch_mm), diameter_mm)
    for depth in depths_mm:
        yield np.clip(depth - gap, 0, None)


TAXIM_PIXEL_MM = 0.0295
TAXIM_KERNELS = (201, 101, 51, 21, 11, 5)
TAXIM_LAST_KERNEL = 5
TAXIM_CONTACT = 0.4


def taxim(diameter_mm: float, depths_mm: FloatArray, pitch_mm: float) -> Surfaces:
    """Taxim: the penetrating shape, blurred by ever narrower Gaussians and restored where deep.

    Source: Si & Yuan (2022), Taxim, section III-B (a pyramid of Gaussian kernels around the
        contact); kernel sizes, fraction of the depth (0.4) and pixel as in their published
        parameters. The width of a kernel of k pixels is 0.3 ((k - 1) / 2 - 1) + 0.8, OpenCV's rule.
    """
    gap = ball_gap_mm(radius_mm(pitch_mm), diameter_mm)
    for depth in depths_mm:
        shape = np.clip(depth - gap, 0, None)
        touching = shape > TAXIM_CONTACT * depth
        height = shape
        for kernel in TAXIM_KERNELS:
            height = np.where(touching, shape, _blur(height, kernel, pitch_mm))
        yield _blur(height, TAXIM_LAST_KERNEL, pitch_mm)


def _blur(height: FloatArray, kernel: int, pitch_mm: float) -> FloatArray:
    sigma_px = 0.3 * ((kernel - 1) / 2 - 1) + 0.8
    sigma = sigma_px * TAXIM_PIXEL_MM / pitch_mm
    return np.asarray(gaussian_filter(height, sigma, truncate=(kernel - 1) / 2 / sigma_px))


def ball_gap_mm(r_mm: FloatArray, diameter_mm: float) -> FloatArray:
    """Gap of a ball [mm] at distances ``r_mm`` from its axis, +inf beside it."""
    radius = 0.5 * diameter_mm
    cap = radius - np.sqrt(np.clip(radius**2 - r_mm**2, 0, None))
    return np.where(r_mm < radius, cap, math.inf)
