"""Contracts and terms of tasks for tests that don't read words."""

from __future__ import annotations

from dataclasses import replace

from primitives.contract import Band, Contract, ForceTerms, TaskTerms

STRAWBERRY = ForceTerms(force_n=Band(low=0.95, high=1.9), limit_n=2.375)
"""Force band and limit for soft things, without what is felt of them."""

BERRY = ForceTerms(force_n=Band(low=0.15, high=2.5), limit_n=5.0, needs="strawberry")
"""Terms of the strawberry task."""

PEG = ForceTerms(force_n=Band(low=3.6, high=7.2), limit_n=9.0)
"""Terms of the peg task, force band and limit for hard things."""


def contract(
    low_n: float, high_n: float, limit_n: float, *, soft: ForceTerms | None = None
) -> Contract:
    """A contract that bounds the force and leaves place, depth and area open."""
    return Contract(
        text="Pick the strawberry gently, without bruising it.",
        summary="pick the strawberry",
        force_n=Band(low=low_n, high=high_n),
        limit_n=limit_n,
        slip_mm=1.0,
        x_mm=Band(low=-20.0, high=20.0),
        y_mm=Band(low=-20.0, high=20.0),
        depth_mm=Band(low=0.0, high=5.0),
        area_fraction=Band(low=0.0, high=1.0),
        soft=soft,
    )


def wide_contract() -> Contract:
    """A contract that hardly anything goes beyond."""
    return contract(0.1, 50.0, 100.0)


def refused_contract() -> Contract:
    """A contract that nothing may move for."""
    return replace(wide_contract(), force_n=None, limit_n=None, refused="it asks to let go: drop")


def terms() -> TaskTerms:
    """Terms of the strawberry task on a gripper of 0.1 to 30 N."""
    return TaskTerms(
        name="strawberry",
        object="strawberry",
        instruction="Pick the strawberry gently, without bruising it.",
        force=STRAWBERRY,
        slip_mm=1.5,
        x_mm=Band(low=-4.0, high=4.0),
        y_mm=Band(low=-3.0, high=3.0),
        depth_mm=Band(low=0.05, high=0.7),
        area_fraction=Band(low=0.02, high=0.8),
        least_n=0.2,
        most_n=30.0,
        soft=STRAWBERRY,
    )


def peg_terms() -> TaskTerms:
    """Terms of the peg task on the same gripper."""
    return replace(
        terms(),
        name="peg",
        object="peg",
        instruction="Grip the peg firmly, so that it does not turn when it is inserted.",
        force=PEG,
        depth_mm=Band(low=0.1, high=1.5),
        area_fraction=Band(low=0.03, high=0.95),
    )
