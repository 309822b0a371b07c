"""The solution of one step satisfies Coulomb's friction, and is the least of its energy."""

import pytest
import torch

from cltp.gel.compliance import GelMaterial
from sim.gel.shear.friction import solve_friction
from sim.gel.shear.kernels import shear_kernel, shear_spectrum_from

GEL = GelMaterial(thickness_mm=3.4, young_mpa=0.423, poisson=0.47)
ROWS, COLUMNS, PITCH = 24, 30, 0.25


def spectrum(rows=ROWS, columns=COLUMNS, dtype=torch.float64):
    kernel = shear_kernel(GEL, rows, columns, PITCH)
    return shear_spectrum_from(kernel, dtype, torch.device("cpu"))


def problem(twist=0.05, dtype=torch.float64):
    """A round pressure that is shifted and turned: drive (1, 2, H, W), limit (1, H, W)."""
    y = ((ROWS - 1) / 2 - torch.arange(ROWS, dtype=dtype)[:, None]) * PITCH
    x = (torch.arange(COLUMNS, dtype=dtype) - (COLUMNS - 1) / 2) * PITCH
    limit = 0.03 * (1 - (x**2 + y**2) / 2.2**2).clamp(min=0).sqrt()
    turned = torch.stack([(-twist * y).expand_as(limit), (twist * x).expand_as(limit)])
    drive = turned + torch.tensor([0.06, -0.02], dtype=dtype)[:, None, None]
    return drive[None], limit[None]


def solved(drive, limit, *, tol=1e-7, max_iterations=500, start=None):
    return solve_friction(
        spectrum(dtype=drive.dtype),
        drive,
        limit,
        start_mpa=torch.zeros_like(drive) if start is None else start,
        tol=tol,
        max_iterations=max_iterations,
    )


def test_points_stick_below_the_limit_or_slip_along_the_traction_at_it():
    drive, limit = problem()
    solution = solved(drive, limit)
    assert solution.converged.all()
    size = solution.traction_mpa.norm(dim=1)
    slip, slipping = solution.slip_mm, solution.slipping
    sticking = (limit > 0) & ~slipping
    assert slipping.sum() > 30
    assert sticking.sum() > 30
    assert (size <= limit * (1 + 1e-12)).all()
    assert (size[limit == 0] == 0).all()
    assert torch.allclose(size[slipping], limit[slipping], rtol=1e-9)
    moved = slip.norm(dim=1)
    assert moved[sticking].max() < 1e-6
    along = (slip * solution.traction_mpa).sum(1) / size.clamp(min=1e-30)
    assert torch.allclose(along[slipping], moved[slipping], atol=1e-6)


def test_no_other_traction_within_the_limit_has_less_energy():
    drive, limit = problem()
    solution, compliance = solved(drive, limit), spectrum()

    def energy(traction):
        return (0.5 * (traction * compliance.apply(traction)) - traction * drive).sum().item()

    least = energy(solution.traction_mpa)
    draw = torch.Generator().manual_seed(1)
    for scale in (1e-3, 1e-2, 0.1, 1.0):
        noise = torch.randn(drive.shape, generator=draw, dtype=torch.float64)
        other = solution.traction_mpa + scale * limit[:, None] * noise
        size = other.norm(dim=1, keepdim=True).clamp(min=1e-30)
        other = other * (limit[:, None] / size).clamp(max=1)
        assert energy(other) > least


def test_one_element_is_a_spring_and_a_slider():
    compliance = spectrum(1, 1)
    give = shear_kernel(GEL, 1, 1, PITCH).xx.item()
    for drive_mm in (0.2 * give, 3.0 * give):
        drive = torch.tensor([[drive_mm * 0.6, drive_mm * 0.8]], dtype=torch.float64)[
            ..., None, None
        ]
        solution = solve_friction(
            compliance,
            drive,
            torch.ones(1, 1, 1, dtype=torch.float64),
            start_mpa=torch.zeros_like(drive),
            tol=1e-9,
            max_iterations=50,
        )
        size = min(1.0, drive_mm / give)
        assert solution.traction_mpa.flatten().tolist() == pytest.approx([0.6 * size, 0.8 * size])
        assert solution.slipping.item() == (drive_mm > give)
        assert solution.slip_mm.norm().item() == pytest.approx(drive_mm - give * size, abs=1e-8)


def test_where_the_search_starts_does_not_matter():
    drive, limit = problem()
    draw = torch.Generator().manual_seed(2)
    start = torch.randn(drive.shape, generator=draw, dtype=torch.float64)
    assert torch.allclose(
        solved(drive, limit).traction_mpa,
        solved(drive, limit, start=start).traction_mpa,
        atol=1e-5 * limit.max().item(),
    )


def test_a_contact_does_not_depend_on_its_company():
    drive, limit = problem()
    batch = solved(torch.cat([drive, 0.3 * drive]), torch.cat([limit, limit]), tol=1e-4)
    single = solved(0.3 * drive, limit, tol=1e-4)
    assert torch.equal(batch.traction_mpa[1:], single.traction_mpa)
    assert batch.iterations[1] == single.iterations[0]


def test_single_precision_converges_to_the_same():
    exact = solved(*problem()).traction_mpa
    rough = solved(*problem(dtype=torch.float32), tol=1e-4)
    assert rough.converged.all()
    assert rough.traction_mpa.double().sum((2, 3)).tolist()[0] == pytest.approx(
        exact.sum((2, 3)).tolist()[0], rel=2e-3
    )


def test_a_bounded_search_says_that_it_did_not_converge():
    solution = solved(*problem(), max_iterations=2)
    assert not solution.converged.any()
    assert solution.iterations.tolist() == [2]


@pytest.mark.parametrize(("driven", "rough"), [(0.0, 1.0), (1.0, 0.0)])
def test_there_is_no_traction_without_a_drive_or_without_friction(driven, rough):
    drive, limit = problem()
    solution = solved(driven * drive, rough * limit)
    assert solution.converged.all()
    assert not solution.slipping.any()
    assert solution.traction_mpa.abs().max().item() == 0.0
