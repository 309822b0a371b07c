"""One contact solved alone is the one that the plain solver finds, in few steps."""

import pytest
import torch

from cltp.gel.compliance import layer_kernel, love_kernel
from sim.gel.compliance import spectrum_from
from sim.gel.contact_solver import solve
from sim.gel.fine.single import box_compliance, convolution, solve_single
from sim.gel.layer import gel_of

MINI = gel_of("gelsight_mini")
PITCH = 0.1


def kernel(rows, columns):
    return layer_kernel(rows, columns, PITCH, MINI)


def ball(rows, columns, radius=3.0):
    y = (torch.arange(rows) - (rows - 1) / 2)[:, None] * PITCH
    x = (torch.arange(columns) - (columns - 1) / 2)[None] * PITCH
    gap = radius - (radius**2 - x**2 - y**2).clamp(min=0).sqrt()
    return (gap - gap.min()).double()


def springs(gap, depth):
    return 0.1 * (depth - gap).clamp(min=0)


@pytest.mark.parametrize("size", [(32, 48), (37, 41), (1, 5)])
def test_a_field_is_convolved_as_by_the_spectrum_of_batches(size):
    field = torch.rand(size, dtype=torch.float64)
    room = convolution(box_compliance(kernel(*size), torch.float64))
    expected = spectrum_from(kernel(*size), torch.float64, field.device).apply(field[None])[0]
    assert torch.allclose(room.apply(field), expected, rtol=1e-10)
    # Nothing of a field is left behind for the next.
    assert torch.allclose(room.apply(field), expected, rtol=1e-10)


def test_a_soft_body_yields_beside_the_gel():
    field = torch.rand(24, 32, dtype=torch.float64)
    gel, body = (
        box_compliance(k, torch.float64) for k in (kernel(24, 32), love_kernel(24, 32, PITCH))
    )
    separate = convolution(gel).apply(field) + convolution(body).apply(field) / 0.3
    assert torch.allclose(convolution(gel.in_series(body, 1 / 0.3)).apply(field), separate)


@pytest.mark.parametrize("size", [(64, 80), (75, 61)])
def test_a_contact_alone_is_that_of_the_plain_solver(size):
    gap, depth = ball(*size), 0.4
    single = solve_single(
        box_compliance(kernel(*size), torch.float64),
        gap,
        depth,
        start_mpa=springs(gap, depth),
        tol=1e-7,
        max_iterations=50,
    )
    plain = solve(
        spectrum_from(kernel(*size), torch.float64, gap.device),
        gap[None],
        torch.tensor([depth], dtype=torch.float64),
        by_force=False,
        start_mpa=springs(gap, depth)[None],
        stiffness=0.1,
        tol=1e-7,
        max_iterations=500,
    )
    assert single.converged
    assert plain.converged.all()
    peak_mpa = float(plain.pressure_mpa[0].max())
    assert torch.allclose(single.pressure_mpa, plain.pressure_mpa[0], atol=3e-6 * peak_mpa)
    assert (single.pressure_mpa >= 0).all()
    assert 2 * single.iterations < plain.iterations.item()


def test_a_finer_grid_needs_hardly_more_steps():
    steps = []
    for finer in (1, 4):
        rows = 40 * finer
        gap = ball(rows, rows, radius=3.0 * finer) / finer
        steps.append(
            solve_single(
                box_compliance(layer_kernel(rows, rows, PITCH / finer, MINI), torch.float64),
                gap,
                0.4,
                start_mpa=springs(gap, 0.4),
                tol=1e-3,
                max_iterations=50,
            ).iterations
        )
    assert steps[1] <= steps[0] + 3


def test_a_start_beside_the_body_is_not_used():
    gap = torch.where(ball(40, 40) < 0.3, ball(40, 40), 50.0)
    box = box_compliance(kernel(40, 40), torch.float64)
    options = {"tol": 1e-4, "max_iterations": 50}
    start = springs(ball(40, 40), 0.4)
    spilled = solve_single(box, gap, 0.4, start_mpa=start + 0.01, **options)
    clean = solve_single(box, gap, 0.4, start_mpa=(start + 0.01) * (gap < 1), **options)
    assert torch.equal(spilled.pressure_mpa, clean.pressure_mpa)
    assert (spilled.pressure_mpa[gap > 1] == 0).all()


def test_a_body_out_of_reach_makes_no_pressure():
    box = box_compliance(kernel(16, 16), torch.float64)
    start = torch.ones(16, 16, dtype=torch.float64)
    solved = solve_single(box, ball(16, 16), -0.1, start_mpa=start, tol=1e-3, max_iterations=9)
    assert solved.converged
    assert (solved.pressure_mpa == 0).all()


def test_steps_that_do_not_suffice_are_said():
    gap = ball(40, 40)
    box = box_compliance(kernel(40, 40), torch.float64)
    start = springs(gap, 0.4)
    solved = solve_single(box, gap, 0.4, start_mpa=start, tol=1e-9, max_iterations=2)
    assert not solved.converged
    assert solved.iterations == 2
