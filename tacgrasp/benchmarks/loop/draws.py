"""``tacgrasp bench draws``: what the seeds draw, and how well size and stiffness tell it.

The table has the quantiles of every drawn quantity, of all kinds of bodies. For kinds whose needs
are felt (``policies.needs``), the laws there are fitted anew to these draws: each line has the
fitted exponents, and the residual of the law that is used.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial

import numpy as np
from matplotlib.figure import Figure
from rich.console import Console

from policies.needs import (
    MIDDLE_FRICTION,
    NEEDS,
    SIZE_MM,
    SURELY_UNBRUISED,
    YOUNG_MPA,
    Law,
)
from sim.grasp.bodies import OBJECTS, Body
from sim.grasp.fingers import FlatFingers
from sim.grasp.rig import build
from sim.grasp.ripeness import LEAST_FRICTION, BerrySize
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.plot_file import write_png
from tacgrasp.benchmarks.pool import each_result
from tacgrasp.benchmarks.settings import DrawsSettings
from tacgrasp.config.layers import load
from tacgrasp.console import make_table_console
from tacgrasp.runtime.verify import accelerations

QUANTITIES: Mapping[str, tuple[str, bool]] = {
    "mass_g": ("mass [g]", True),
    "size_mm": ("size [mm]", False),
    "young_mpa": ("Young's modulus [MPa]", True),
    "friction": ("friction", False),
    "slip_minimum_n": ("least force that holds [N]", True),
    "bruise_n": ("bruise force [N]", True),
    "bruise_over_slip": ("bruise over least force at µ 0.3", False),
    "bruise_kpa": ("bruise pressure [kPa]", True),
}
"""Words of each drawn quantity, and whether its axis is logarithmic."""

QUANTILES = (0, 5, 50, 95, 100)

APPROACHES_N = (0.5, 1.0, 2.0)
"""Forces whose approach is measured, over the force that holds at the least friction."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnBody:
    """One drawn body; units are in the names.

    Attributes:
        slip_minimum_n: Force that holds it at its own friction.
        least_n: Force that holds it at ``LEAST_FRICTION``.
        need_least_n, need_most_n: What the laws of its kind are fitted to (``policies.needs``).
        bruise_over_slip: ``bruise_n`` over ``least_n``.
        forces_n, approaches_mm: Forces, and the approach of either finger under them.
    """

    mass_g: float
    size_mm: float
    young_mpa: float
    friction: float
    slip_minimum_n: float
    least_n: float
    need_least_n: float
    need_most_n: float
    bruise_n: float
    bruise_over_slip: float
    bruise_kpa: float
    forces_n: tuple[float, ...]
    approaches_mm: tuple[float, ...]


def run(settings: DrawsSettings) -> None:
    """Draw, print the tables, and write figures and histograms.

    Raises:
        UsageError: A file can't be written.
    """
    console = make_table_console()
    bodies = {
        name: list(each_result(console, name, partial(drawn_body, name), settings.seeds))
        for name in OBJECTS
    }
    fits = {name: fitted_laws(name, bodies[name]) for name in NEEDS if name in bodies}
    _print(console, bodies, fits)
    if settings.plot is not None:
        write_png(settings.plot, histograms(bodies))
    drawn = {name: [asdict(body) for body in each] for name, each in bodies.items()}
    report = {"first_seed": settings.first_seed, "laws": fits, "bodies": drawn}
    write_figures(settings.json, report)


def drawn_body(name: str, seed: int) -> DrawnBody:
    """The body that a seed draws, with what holds it and what bruises it."""
    fingers = build(name, seed).grasp.fingers
    body, loads = fingers.body, accelerations(load(name)[0].verify)
    least_n = _with_friction(fingers, LEAST_FRICTION).slip_minimum_n(loads)
    need_least_n, need_most_n = least_n, body.bruise_n
    if OBJECTS[name].bruise_factor is not None:  # begun lightly: slip and the reflex tell the rest
        rough = _with_friction(fingers, MIDDLE_FRICTION)
        need_least_n, told = rough.slip_minimum_n([(0.0, 0.0)]), _told_bruise_n(body)
        need_most_n = SURELY_UNBRUISED * told
    forces = tuple(factor * least_n for factor in APPROACHES_N)
    patches = fingers.press_many([(0.0, 0.0)] * len(forces), list(forces))
    return DrawnBody(
        mass_g=1e3 * body.mass_kg,
        size_mm=body.thickness_mm,
        young_mpa=body.young_mpa,
        friction=body.friction,
        slip_minimum_n=fingers.slip_minimum_n(loads),
        least_n=least_n,
        need_least_n=need_least_n,
        need_most_n=need_most_n,
        bruise_n=body.bruise_n,
        bruise_over_slip=body.bruise_n / least_n,
        bruise_kpa=fingers.bruise_kpa,
        forces_n=forces,
        approaches_mm=tuple(patch.depth_mm for patch in patches),
    )


def _with_friction(fingers: FlatFingers, friction: float) -> FlatFingers:
    """Fingers around the same body with another friction."""
    body = replace(fingers.body, friction=friction)
    return FlatFingers(body, fingers.sensor, fingers.material, fingers.up)


def _told_bruise_n(body: Body) -> float:
    """Bruise force that ripeness tells, by size and stiffness [N]."""
    size = BerrySize(mass_g=1e3 * body.mass_kg, size_mm=body.thickness_mm, com_mm=body.com_mm)
    return size.bruise_n(body.young_mpa)


def fitted_laws(name: str, bodies: Sequence[DrawnBody]) -> dict[str, dict[str, float]]:
    """Each law of a kind's needs, fitted to bodies, with the residuals of the law in use."""
    needs = NEEDS[name]
    size, young, least, most = (
        np.array([getattr(body, quantity) for body in bodies])
        for quantity in ("size_mm", "young_mpa", "need_least_n", "need_most_n")
    )
    count = len(APPROACHES_N)
    force = np.array([body.forces_n for body in bodies]).ravel()
    approach = np.array([body.approaches_mm for body in bodies]).ravel()
    sizes, youngs = np.repeat(size, count), np.repeat(young, count)
    one = np.ones_like(size)
    return {
        "least_n": _fit(needs.least_n, least, size, young, one),
        "most_n": _fit(needs.most_n, most, size, young, one),
        "approach_mm": _fit(needs.approach_mm, approach, sizes, youngs, force),
        "young_mpa": _fit(needs.young_mpa, young, size, np.full_like(size, YOUNG_MPA), one),
    }


def _fit(
    law: Law, values: np.ndarray, size: np.ndarray, young: np.ndarray, force: np.ndarray
) -> dict[str, float]:
    """Least squares of ln value, in the exponents that the law has."""
    names = [name for name in ("size", "young", "force") if getattr(law, name)]
    variables = {"size": size / SIZE_MM, "young": young / YOUNG_MPA, "force": force}
    terms = [np.ones_like(size), *(np.log(variables[name]) for name in names)]
    fit, *_ = np.linalg.lstsq(np.stack(terms, axis=1), np.log(values), rcond=None)
    residual = np.log(values / law.at(size, young, force))
    fitted = {"value": math.exp(fit[0]), **dict(zip(names, map(float, fit[1:]), strict=True))}
    return fitted | {"bias": float(residual.mean()), "spread": float(residual.std())}


def histograms(bodies: Mapping[str, Sequence[DrawnBody]]) -> Figure:
    """A row for each kind of body, a column for each quantity."""
    figure = Figure(figsize=(2.6 * len(QUANTITIES), 2.2 * len(bodies)), layout="constrained")
    cells = figure.subplots(len(bodies), len(QUANTITIES), squeeze=False)
    for row, (name, each) in zip(cells, bodies.items(), strict=True):
        row[0].set_ylabel(name.replace("_", " "))
        for axes, (quantity, (words, is_log)) in zip(row, QUANTITIES.items(), strict=True):
            values = np.array([getattr(body, quantity) for body in each])
            spread = values.max() > 1.01 * values.min()
            edges = np.geomspace if is_log else np.linspace
            axes.hist(values, bins=edges(values.min(), values.max(), 21) if spread else 3)
            axes.set_title(words, fontsize=8)
            axes.tick_params(labelsize=7)
            if is_log and spread:
                axes.set_xscale("log")
                ticks = np.geomspace(values.min(), values.max(), 3)
                axes.set_xticks(ticks, [f"{tick:.3g}" for tick in ticks])
                axes.set_xticks([], minor=True)
    return figure


def _print(
    console: Console,
    bodies: Mapping[str, Sequence[DrawnBody]],
    fits: Mapping[str, Mapping[str, Mapping[str, float]]],
) -> None:
    columns = ["object", "", *(f"{quantile} %" for quantile in QUANTILES)]
    table = number_table("Quantiles of the draws", columns, ("object", ""))
    for name, each in bodies.items():
        for quantity, (words, _) in QUANTITIES.items():
            values = [getattr(body, quantity) for body in each]
            table.add_row(name, words, *(f"{q:.3g}" for q in np.percentile(values, QUANTILES)))
    console.print(table)
    for name, laws in fits.items():
        for quantity, fit in laws.items():
            words = ", ".join(f"{key} {value:.3f}" for key, value in fit.items())
            console.print(f"{name} {quantity}: {words}")
