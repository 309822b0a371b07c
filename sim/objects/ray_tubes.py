"""Casting many parallel rays against a solid on a CPU: first in tubes, then one by one.

A tube around a square of rays advances as long as the solid is further from its axis than its
radius. Until then none of its rays can have hit anything, so each ray starts there. Rays that hit
out of the gel's reach are dropped on the way. Results agree with sphere tracing from the origins
(``sim.objects.ray_casting.march``) within its tolerance.

Points are stored coordinate by coordinate, which a CPU reads faster.

Not here: origins of the rays and the surface over the pad (``sim.objects.ray_casting``).
"""

from __future__ import annotations

import torch
from torch import Tensor

from sim.objects.ray_casting import ALONGSIDE_MM, BEYOND_MM, NEAR_MM, STEPS
from sim.objects.solids import Solid

_FINER = 4  # rays along the side of a narrow tube, and narrow tubes along that of a wide one
_WIDE = _FINER * _FINER  # rays along the side of a wide tube
_TUBE_STEPS, _FEW_STEPS = 12, 6  # upper bounds
_FEW_RAYS, _TOGETHER = 300, 4  # so few rays are sorted out every fourth step only
_WORTHWHILE = 0.5  # of the radius: a tube with shorter steps ends


def march_over(solid: Solid, origins: Tensor, along: Tensor, far_mm: float) -> Tensor:
    """Trace rays whose origins form a grid of equal squares.

    Args:
        solid: The solid.
        origins: (H, W, 3), H and W at least 2 [mm].
        along: Unit vector (3,).
        far_mm: Largest length [mm].

    Returns:
        Length of each ray, (H, W) [mm]; inf where it hits nothing, or only more than ``BEYOND_MM``
        behind the foremost hit; NaN where it starts inside.
    """
    rays = origins.permute(2, 0, 1).contiguous()
    clear = rays.new_zeros(-(-rays.shape[1] // _WIDE), -(-rays.shape[2] // _WIDE))
    for square in (_WIDE, _FINER):
        middles, radius = _tubes(rays, square)
        if square != _WIDE:
            clear = _spread(clear, middles)
        free = _free(solid, middles.flatten(1), along, clear.flatten(), radius, far_mm)
        clear = free.view(middles.shape[1:])
    first = _spread(clear, rays)
    # A sparse set of rays bounds the length of the shortest.
    sparse, sparse_start = rays[:, ::_FINER, ::_FINER], first[::_FINER, ::_FINER]
    sparse_mm = _march(solid, sparse.flatten(1), along, sparse_start.flatten(), far_mm, _FEW_STEPS)
    far_mm = min(far_mm, float(sparse_mm.nan_to_num(nan=torch.inf).amin()) + BEYOND_MM)
    reached_mm = _march(solid, rays.flatten(1), along, first.flatten(), far_mm, STEPS)
    return reached_mm.view(first.shape)


def _tubes(rays: Tensor, square: int) -> tuple[Tensor, float]:
    """Centres (3, h, w) of squares of rays (3, H, W), and their radius [mm].

    The last squares may extend beyond the grid.
    """
    down, right = rays[:, 1, 0] - rays[:, 0, 0], rays[:, 0, 1] - rays[:, 0, 0]
    half = (square - 1) / 2
    middles = rays[:, ::square, ::square] + (half * (down + right))[:, None, None]
    radius = half * max(float((down + right).norm()), float((down - right).norm()))
    return middles, 1.001 * radius


def _spread(clear: Tensor, finer: Tensor) -> Tensor:
    """Values of tubes (h, w), repeated for the narrower tubes or rays (3, H, W) in them."""
    spread = clear.repeat_interleave(_FINER, 0).repeat_interleave(_FINER, 1)
    return spread[: finer.shape[1], : finer.shape[2]]


def _free(
    solid: Solid, middles: Tensor, along: Tensor, travelled: Tensor, radius: float, far_mm: float
) -> Tensor:
    """Free length of tubes about ``middles`` (3, N), (N,) [mm]."""
    free = travelled.clone()
    index = torch.arange(len(free))
    for _ in range(_TUBE_STEPS):
        distance = solid.distance((middles + along[:, None] * travelled).T)
        free_step = (distance / solid.max_slope - radius).clamp_(min=0)
        travelled = travelled + free_step
        free[index] = travelled
        active = torch.nonzero((free_step > _WORTHWHILE * radius) & (travelled < far_mm))[:, 0]
        if not len(active):
            break
        middles = middles.index_select(1, active)
        travelled, index = travelled[active], index[active]
    return free


def _march(
    solid: Solid, origins: Tensor, along: Tensor, first: Tensor, far_mm: float, steps: int
) -> Tensor:
    """Trace rays (3, N), each from its own free length ``first``, (N,) [mm]."""
    hit = torch.full_like(first, torch.inf)
    index = torch.nonzero(first < far_mm)[:, 0]
    origins, travelled = origins.index_select(1, index), first[index]
    for step in range(steps):
        distance = solid.distance((origins + along[:, None] * travelled).T)
        if step == 0:
            travelled = travelled.masked_fill((distance < -NEAR_MM) & (travelled == 0), torch.nan)
        arrived = distance < NEAR_MM
        onward = travelled + distance.masked_fill(arrived, 0) / solid.max_slope
        if len(index) < _FEW_RAYS and step % _TOGETHER and step < steps - 1:
            travelled = onward  # rays that have hit stay
            continue
        ended = torch.nonzero(arrived & ~(travelled >= far_mm))[:, 0]
        hit[index[ended]] = travelled[ended] + distance[ended]
        active = torch.nonzero(~arrived & (onward < far_mm))[:, 0]
        if not len(active):
            return hit
        origins = origins.index_select(1, active)
        travelled, index, distance = onward[active], index[active], distance[active]
    # The rest runs along a steep wall, as in ``sim.objects.ray_casting.march``.
    hit[index] = torch.where(distance < ALONGSIDE_MM, travelled, torch.inf)
    return hit
