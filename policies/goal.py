"""Numeric goal of a step, for the teacher and for the lessons of the language model.

In an episode it is a part of the contract (``policies.contract_steps.target_of``).
"""

from __future__ import annotations

from dataclasses import dataclass

from primitives.contract import Band


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """Bands of the contact state in a good grasp.

    Attributes:
        force_n: Normal force estimated from the indentation [N].
        depth_mm: Largest indentation of the gel [mm]; the upper end guards against bruises.
        area_fraction: Fraction of the sensing area in contact, 0 to 1.
        x_mm: Position of the contact along the pad's x [mm].
        y_mm: Position of the contact along the pad's y [mm].
    """

    force_n: Band
    depth_mm: Band
    area_fraction: Band
    x_mm: Band
    y_mm: Band
