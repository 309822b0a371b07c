"""Run by torch in several processes: loss and gradients of one model over rows spread over them."""

import sys
from pathlib import Path

import torch
import torch.distributed as dist

from cltp.encoder.all_gather import averaged_gradients
from cltp.encoder.losses import CltpLoss


def rows() -> tuple[torch.Tensor, torch.Tensor, torch.Tensor, torch.Tensor]:
    """Eight contacts, their texts and images, and what fits what."""
    rng = torch.Generator().manual_seed(3)
    points, texts, images = (torch.randn(8, width, generator=rng) for width in (12, 6, 6))
    fits = torch.eye(8, dtype=torch.bool)
    fits[0, 5] = fits[5, 0] = fits[2, 3] = True
    return points, texts, images, fits


def step(first: int, last: int, *, several: bool) -> dict[str, torch.Tensor]:
    """Loss and gradients from rows ``first`` to ``last``, those of the others gathered."""
    points, texts, images, fits = rows()
    torch.manual_seed(7)
    tower, loss = torch.nn.Linear(12, 6), CltpLoss()
    own = slice(first, last)
    terms = loss(tower(points[own]), texts[own], images[own], fits if several else None)
    total = torch.stack(list(terms.values())).sum()
    total.backward()
    parameters = [*tower.parameters(), *loss.parameters()]
    averaged_gradients(parameters)
    gradients = {str(n): p.grad for n, p in enumerate(parameters) if p.grad is not None}
    return {"loss": total.detach(), **gradients}


def main(rank: int, world: int, folder: Path) -> None:
    """One process: its share of the rows, and what came out into a file of its own."""
    place = (folder / "meet").as_uri()
    dist.init_process_group("gloo", init_method=place, rank=rank, world_size=world)
    share = 8 // world
    for several in (False, True):
        gradients = step(rank * share, (rank + 1) * share, several=several)
        torch.save(gradients, folder / f"{rank}-{several}.pt")
    dist.destroy_process_group()


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))
