"""Pressing with a force, but no deeper than linear elasticity holds."""

from __future__ import annotations

import torch
from torch import Tensor

from sim.gel.contact_solver import chosen
from sim.gel.layer import ElasticLayer, Press

_TRIES = 4


def press_no_deeper(
    layer: ElasticLayer,
    gap_mm: Tensor,
    force_n: Tensor,
    *,
    deepest_mm: float,
    tol: float,
) -> Press:
    """Press bodies with given forces, with less where one would sink deeper.

    A narrow end that bears all of its force may have to be let go more than once; after some tries
    the last press stands.

    Args:
        layer: The gel.
        gap_mm: Shape (B, H, W), gaps of the bodies [mm].
        force_n: Shape (B,), normal forces [N].
        deepest_mm: Largest indentation [mm].
        tol: Tolerance of the solver.
    """
    press = layer.press_to_force(gap_mm, force_n, tol=tol)
    for _ in range(_TRIES):
        excess = press.height_mm.amax((1, 2)) / deepest_mm
        if not bool((excess > 1).any()):
            break
        force_n = torch.where(excess > 1, force_n * excess**-1.5, force_n)  # Hertz
        lighter = layer.press_to_force(gap_mm, force_n, start=press, tol=tol)
        press = chosen(excess > 1, lighter, press)
    return press
