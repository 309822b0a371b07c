"""``tacgrasp bench gel``: errors of the gel against closed forms and real presses, and its cost.

Each error is measured when the benchmark runs. The tests hold the same figures to limits
(``tests/sim/gel/test_layer.py``); durations are only printed.
"""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path

import torch
from rich.console import Console
from rich.table import Table
from torch import Tensor

from cltp.processor import torch_threads
from sim.gel.layer import ElasticLayer, GelMaterial, gel_of
from tacgrasp.benchmarks.figures import Figure, median_ms, write_figures
from tacgrasp.benchmarks.sensing.gel_fit import (
    LARGEST_FORCE_ERROR,
    LARGEST_RMSE_MM,
    MEASURED_N,
    fit,
    model_forces_n,
)
from tacgrasp.benchmarks.sensing.radial_profiles import (
    FIT_DIAMETER_MM,
    Profile,
    Simulator,
    gel,
    match,
    read_profiles,
    tacto,
    taxim,
)
from tacgrasp.benchmarks.sensing.shear import mechanics
from tacgrasp.benchmarks.sensing.shear_pace import pace
from tacgrasp.benchmarks.settings import GelSettings

ROWS, COLUMNS, PITCH_MM = 76, 102, 0.2


def _radius_mm(rows: int, columns: int, pitch_mm: float) -> Tensor:
    y = (torch.arange(rows, dtype=torch.float64) - (rows - 1) / 2) * pitch_mm
    x = (torch.arange(columns, dtype=torch.float64) - (columns - 1) / 2) * pitch_mm
    return torch.hypot(y[:, None], x[None, :])


def _ball(radius_mm: float, rows: int, columns: int, pitch_mm: float) -> Tensor:
    """Gap of a ball, (1, rows, columns) [mm]."""
    r = _radius_mm(rows, columns, pitch_mm)
    gap = radius_mm - (radius_mm**2 - r**2).clamp(min=0).sqrt()
    return torch.where(r < radius_mm, gap, torch.inf)[None]


def _square(material: GelMaterial, size: int, pitch_mm: float) -> ElasticLayer:
    return ElasticLayer(material, rows=size, columns=size, pitch_mm=pitch_mm, dtype=torch.float64)


def hertz() -> list[Figure]:
    """Half-space under a paraboloid of R 10 mm at 0.1 mm: a = 1 mm, 20 elements."""
    material = GelMaterial(thickness_mm=math.inf, young_mpa=0.145, poisson=0.495)
    gap = (_radius_mm(61, 61, 0.05) ** 2 / 20.0)[None]
    press = _square(material, 61, 0.05).press_to_depth(gap, torch.tensor(0.1))
    force = 4 / 3 * material.plane_strain_mpa * math.sqrt(10) * 0.1**1.5
    force_error = 100 * (press.force_n.item() / force - 1)
    radius = math.sqrt((press.pressure_kpa > 0).sum().item() * 0.05**2 / math.pi)
    note = "Love half-space, 20 elements to the radius; limit 2 %"
    return [
        Figure("hertz_force_error_percent", "Force against Hertz", force_error, "%", note),
        Figure("hertz_radius_error_percent", "Radius against Hertz", 100 * (radius - 1), "%", note),
    ]


def dimitriadis() -> list[Figure]:
    """Bonded layer, nu = 0.4999, against the series for nu = 1/2."""
    h, r = 3.6, 20.0
    material = GelMaterial(thickness_mm=h, young_mpa=0.145, poisson=0.4999)
    figures = []
    for chi in (0.1, 0.2, 0.3):
        depth, pitch = (chi * h) ** 2 / r, chi * h / 30
        gap = (_radius_mm(81, 81, pitch) ** 2 / (2 * r))[None]
        press = _square(material, 81, pitch).press_to_depth(gap, torch.tensor(depth))
        force = 4 / 3 * material.plane_strain_mpa * math.sqrt(r) * depth**1.5
        series = 1 + 1.133 * chi + 1.283 * chi**2 + 0.769 * chi**3 + 0.0975 * chi**4
        figures.append(
            Figure(
                f"dimitriadis_chi_{chi:.1f}_error_percent",
                f"Force against Dimitriadis, chi {chi:.1f}",
                100 * (press.force_n.item() / (force * series) - 1),
                "%",
                "bonded, nu 0.4999; limit 3 %",
            )
        )
    return figures


def volume() -> list[Figure]:
    """Percentage of the sunk volume that does not rise again, nu = 0.4999."""
    material = GelMaterial(thickness_mm=2.0, young_mpa=0.145, poisson=0.4999)
    press = _square(material, 241, 0.4).press_to_force(_ball(4.0, 241, 241, 0.4), torch.tensor(1.0))
    lost = 100 * press.height_mm.sum().item() / press.height_mm.clamp(min=0).sum().item()
    note = "nu 0.4999, sensing area 48 thicknesses wide"
    return [Figure("volume_lost_percent", "Volume lost", lost, "%", note)]


def profiles(folder: Path | None) -> list[Figure]:
    """Real balls: the gel's fit on one of them; the preset, TACTO and Taxim on all.

    The protocol is in ``tacgrasp.benchmarks.sensing.radial_profiles``.
    """
    measured = [] if folder is None else read_profiles(folder)
    if not measured:
        note = "give --data DIR" if folder is None else f"no profile_*mm.csv in {folder}"
        return [Figure("profile_rmse_mm", "Real ball's profile", None, "mm", note)]
    preset = gel_of("gelsight_mini")
    figures = []
    for profile in measured:
        if profile.diameter_mm == FIT_DIAMETER_MM:
            figures += _fit(profile, preset)
        rows: list[tuple[str, Simulator, float]] = [
            ("gel preset", gel(preset), 0.2),
            ("gel preset", gel(preset), 0.127),
            ("gel preset", gel(preset), 0.0634),
            ("TACTO", tacto, 0.0634),
            ("Taxim", taxim, 0.0634),
        ]
        for name, simulator, pitch in rows:
            best = match(simulator, profile, pitch)
            figures.append(
                Figure(
                    f"{name.split()[0].lower()}_rmse_mm_{profile.diameter_mm:g}mm_at_{pitch}",
                    f"RMSE of {name}, ball {profile.diameter_mm:g} mm, {pitch} mm grid",
                    best.rmse_mm,
                    "mm",
                    f"at {best.depth_mm:.2f} mm depth"
                    + (
                        f"; limit {LARGEST_RMSE_MM}" if name == "gel preset" and pitch < 0.2 else ""
                    ),
                )
            )
    return [_profile_rmse(figures, FIT_DIAMETER_MM), *figures]


def _profile_rmse(figures: list[Figure], diameter_mm: float) -> Figure:
    """The preset's error at the sensor's own resolution, under a key of its own."""
    key = f"gel_rmse_mm_{diameter_mm:g}mm_at_0.0634"
    value = next((figure.value for figure in figures if figure.key == key), None)
    note = f"ball {diameter_mm:g} mm, 0.0634 mm grid; limit {LARGEST_RMSE_MM}"
    return Figure("profile_rmse_mm", "Real ball's profile", value, "mm", note)


def _fit(profile: Profile, preset: GelMaterial) -> list[Figure]:
    best = fit(profile)
    material = best.material
    note = f"the preset is {'the fit' if material == preset else 'NOT the fit'}"
    trade = f"forces within {100 * best.force_error:.1f} %, profile {best.profile.rmse_mm:.5f} mm"
    origin = f"to two forces and the {profile.diameter_mm:g} mm ball, 0.127 mm grid"
    return [
        Figure("fit_thickness_mm", "Fitted thickness", material.thickness_mm, "mm", note),
        Figure("fit_poisson", "Fitted Poisson's ratio", material.poisson, "", origin),
        Figure("fit_young_mpa", "Fitted Young's modulus", material.young_mpa, "MPa", trade),
    ]


def forces() -> list[Figure]:
    """Forces of a real ball against the preset's."""
    model = model_forces_n(gel_of("gelsight_mini"))
    return [
        Figure(
            f"force_at_{depth}_mm_n",
            f"Force of a ball R 7.5 mm at {depth} mm",
            model_n,
            "N",
            f"measured {measured_n} N: {100 * (model_n / measured_n - 1):+.1f} %; "
            f"limit {100 * LARGEST_FORCE_ERROR:.0f} %",
        )
        for (depth, measured_n), model_n in zip(MEASURED_N.items(), model, strict=True)
    ]


def discretisation() -> list[Figure]:
    """Errors by grid, tolerance and precision, of a ball of R 5 mm and a soft one of R 15 mm."""
    forces: dict[float, float] = {}
    for pitch, size in ((0.4, 38), (0.2, 76), (0.1, 152)):
        gel = _square(gel_of("gelsight_mini"), size, pitch)
        press = gel.press_to_depth(_ball(5.0, size, size, pitch), torch.tensor(0.6))
        forces[pitch] = press.force_n.item()
    figures = [
        Figure(
            f"grid_{pitch}_mm_force_error_percent",
            f"Force at {pitch} mm grid",
            100 * (forces[pitch] / forces[0.1] - 1),
            "%",
            "ball R 5 mm at 0.6 mm, against 0.1 mm grid",
        )
        for pitch in (0.4, 0.2)
    ]
    gap, force = _ball(15.0, ROWS, COLUMNS, PITCH_MM), torch.tensor(1.0)
    exact = _mini(torch.float64).press_to_force(gap, force, tol=1e-8)
    for tol in (1e-3, 1e-4):
        press = _mini(torch.float32).press_to_force(gap, force, tol=tol)
        error = (press.height_mm.double() - exact.height_mm).abs().max().item()
        figures.append(
            Figure(
                f"tol_{tol:g}_height_error_um",
                f"Worst height, float32 at tol {tol:g}",
                1e3 * error,
                "µm",
                f"soft ball R 15 mm, 1 N; {press.iterations.item()} iterations; "
                "against float64 at 1e-8",
            )
        )
    return figures


def _mini(dtype: torch.dtype) -> ElasticLayer:
    return ElasticLayer(
        gel_of("gelsight_mini"),
        rows=ROWS,
        columns=COLUMNS,
        pitch_mm=PITCH_MM,
        body_modulus_mpa=0.23,
        dtype=dtype,
    )


@torch_threads()
def cost() -> list[Figure]:
    """Time per solve on one thread, alone and batched, and the time of its FFTs alone."""
    gel, gap = _mini(torch.float32), _ball(15.0, ROWS, COLUMNS, PITCH_MM).float()
    setting = f"{ROWS}×{COLUMNS} at {PITCH_MM} mm, soft ball R 15 mm, 1 N, one thread"
    force = torch.tensor(1.0)
    press = gel.press_to_force(gap, force)
    single = median_ms(lambda: gel.press_to_force(gap, force), 20)
    loose = median_ms(lambda: gel.press_to_force(gap, force, tol=1e-3), 20)
    warm = median_ms(lambda: gel.press_to_force(gap, 1.05 * force, start=press), 20)
    many = gap.expand(32, -1, -1)
    batched = median_ms(lambda: gel.press_to_force(many, force), 5) / 32
    # Two convolutions an iteration, one for the last residual, one for the surface.
    convolutions = 2 * int(press.iterations.item()) + 2
    padded = (2 * ROWS, 2 * COLUMNS)
    waves = torch.fft.rfft2(gap.clamp(max=1.0), s=padded)
    bare = median_ms(
        lambda: (torch.fft.rfft2(gap, s=padded), torch.fft.irfft2(waves, s=padded)), 20
    )
    fraction = bare * convolutions / single
    floor = f"{convolutions} plain convolutions, padded to double; above 1: ours are faster"
    return [
        Figure("ms_single", "One solve", single, "ms", setting),
        Figure("ms_loose", "One solve, tol 1e-3", loose, "ms", ""),
        Figure("ms_warm", "One solve, warm start", warm, "ms", "+5 % force"),
        Figure("ms_batched", "Per solve, batch of 32", batched, "ms", ""),
        Figure("fft_floor_share", "Bare FFTs / whole solve", fraction, "", floor),
    ]


def measure(data: Path | None) -> list[Figure]:
    """All figures, in the order of the table."""
    before = hertz() + dimitriadis() + volume() + forces()
    return before + profiles(data) + discretisation() + cost() + mechanics() + pace()


def run(settings: GelSettings) -> None:
    """Measure, print a table, and write the figures.

    Raises:
        OSError: The file cannot be written.
    """
    figures = measure(settings.data)
    table = Table("figure", "value", "unit", "note", title="Elastic-layer gel")
    for figure in figures:
        value = "not measured" if figure.value is None else f"{figure.value:.4g}"
        table.add_row(figure.what, value, figure.unit, figure.note)
    Console().print(table)
    by_key = {figure.key: figure.value for figure in figures}
    presses = [
        {"depth_mm": depth, "measured_n": n, "model_n": by_key.get(f"force_at_{depth}_mm_n")}
        for depth, n in MEASURED_N.items()
    ]
    report = {"figures": [asdict(figure) for figure in figures], "force": presses}
    write_figures(settings.json, report | by_key)
