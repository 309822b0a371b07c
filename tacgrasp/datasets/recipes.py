"""The data sets that can be generated, each cut into shards that can be made in any order.

- ``full``: 259 objects drawn anew for every series, 120,000 contacts, four sensors
  (``sim.full.series``);
- ``paper``: 117 objects, 50,860 contacts and two further domains (``sim.tcl3d.series``).

Not here: workers and files (``tacgrasp.datasets.generate``).
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import torch

from cltp.data.contact import Contact
from cltp.data.dataset_writer import PackedShard, packed_shard
from sim.full.requests import LOADS
from sim.full.series import CONTACTS as FULL_CONTACTS
from sim.full.series import make_series as make_full_series
from sim.full.series import num_series
from sim.grasp.rig import BENCHMARK_SEED
from sim.objects.catalogue import CATALOGUE
from sim.objects.mesh_objects import meshes_in, object_from_mesh
from sim.tcl3d.series import ALL_CONTACTS, make_series, mesh_numbers, num_loads, series_numbers
from tacgrasp.base.errors import UsageError
from tacgrasp.base.torch_device import usable_device
from tacgrasp.datasets.requests import GenerateRequest

SETS = ("full", "paper")
FORMER_NAMES = {"tcl3d": "paper"}
"""Sets by the names that they had before."""

TCL3D_MAKER, FULL_MAKER = "tcl3d 1", "full 1"
"""Versions of the recipes; raised when the same seed gives other contacts."""

SHARD_SERIES = 50
FULL_SHARD_SERIES = 100


class DatasetRecipe(Protocol):
    """How a data set is made, shard by shard. Sent to worker processes."""

    def about(self) -> dict[str, str]:
        """The facts in ``dataset.json``, the same for every part of the set."""
        ...

    def card_command(self) -> str | None:
        """The command that makes the set again, for its card; None for a set without a card."""
        ...

    def shard_sizes(self) -> list[int]:
        """Number of contacts in each shard."""
        ...

    def make(self, shard: int) -> list[Contact]:
        """The contacts of one shard; they depend on the recipe and the number alone."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Tcl3dRecipe:
    """The set ``paper``. Its files say ``tcl3d``, as it was called: they stay the same."""

    contacts: int
    seed: int
    meshes: tuple[Path, ...] = ()
    device: str = "cpu"

    def about(self) -> dict[str, str]:
        return {  # the device belongs to them: it may change a height by 1 µm
            "made_by": "tacgrasp data generate",
            "set": "tcl3d",
            "maker": TCL3D_MAKER,
            "seed": str(self.seed),
            "contacts": str(sum(self.shard_sizes())),
            **({"meshes": _names(self.meshes)} if self.meshes else {}),
            "torch": torch.__version__.split("+")[0],
            "device": self.device.split(":")[0],
        }

    def card_command(self) -> str:
        count = "" if self.contacts == ALL_CONTACTS else f" --contacts {self.contacts}"
        device = "" if self.device == "cpu" else f" --device {self.device}"
        meshes = f" --meshes {self.meshes[0].parent}" if self.meshes else ""
        return f"tacgrasp data generate --set paper --seed {self.seed}{count}{meshes}{device}"

    def shard_sizes(self) -> list[int]:
        sizes = [sum(map(num_loads, shard)) for shard in self._shards()]
        sizes[-1] -= sum(sizes) - self.contacts
        per_mesh = [sum(map(num_loads, part)) for part in _parts(mesh_numbers(0))]
        return [*sizes, *per_mesh * len(self.meshes)]

    def make(self, shard: int) -> list[Contact]:
        own = self._shards()
        obj, part = None, shard - len(own)
        if part >= 0:
            mesh, part = divmod(part, len(_parts(mesh_numbers(0))))
            obj, numbers = object_from_mesh(self.meshes[mesh]), _parts(mesh_numbers(mesh))[part]
        else:
            numbers = own[shard]
        series = (make_series(self.seed, number, self.device, obj=obj) for number in numbers)
        contacts = [contact for each in series for contact in each]
        return contacts[: self.shard_sizes()[shard]]

    def _shards(self) -> list[Sequence[int]]:
        """Numbers of the catalogue's series by shard; those of meshes are not among them."""
        return _parts(series_numbers(self.contacts))


@dataclass(frozen=True, slots=True, kw_only=True)
class FullRecipe:
    """The set ``full``."""

    contacts: int
    seed: int
    device: str = "cpu"
    shard_series: int = FULL_SHARD_SERIES

    def about(self) -> dict[str, str]:
        return {
            "made_by": "tacgrasp data generate",
            "set": "full",
            "maker": FULL_MAKER,
            "seed": str(self.seed),
            "contacts": str(self.contacts),
            "torch": torch.__version__.split("+")[0],
            "device": self.device.split(":")[0],
        }

    def card_command(self) -> str:
        count = "" if self.contacts == FULL_CONTACTS else f" --contacts {self.contacts}"
        device = "" if self.device == "cpu" else f" --device {self.device}"
        return f"tacgrasp data generate --set full --seed {self.seed}{count}{device}"

    def shard_sizes(self) -> list[int]:
        size = self.shard_series * LOADS
        return [min(size, self.contacts - first) for first in range(0, self.contacts, size)]

    def make(self, shard: int) -> list[Contact]:
        first = shard * self.shard_series
        last = min(first + self.shard_series, num_series(self.contacts))
        series = (make_full_series(self.seed, n, self.device) for n in range(first, last))
        return [contact for each in series for contact in each][: self.shard_sizes()[shard]]


def make_packed(plan: DatasetRecipe, shard: int, count: int) -> PackedShard:
    """Make the bytes of one shard, which has ``count`` contacts."""
    contacts = plan.make(shard)
    if len(contacts) != count:
        raise RuntimeError(f"shard {shard} has {len(contacts)} contacts instead of {count}")
    return packed_shard(contacts)


def recipe(request: GenerateRequest) -> DatasetRecipe:
    """Make the recipe that a request names.

    Raises:
        UsageError: An unknown set, a value that does not fit the set, or a device that
            can't be used here.
        TouchError: A mesh that can't be used.
    """
    contacts, seed, meshes = request.contacts, request.seed, request.meshes
    name = FORMER_NAMES.get(request.set, request.set)
    if name not in SETS:
        raise UsageError(f"--set expects {', '.join(SETS)}, got {request.set!r}; full teaches most")
    if (contacts is not None and contacts < 1) or not 0 <= seed < BENCHMARK_SEED:
        raise UsageError(
            f"expected at least 1 contact and a seed from 0 to {BENCHMARK_SEED - 1} "
            f"(larger ones are for benchmarks), got {contacts} contacts, seed {seed}"
        )
    if name != "paper" and meshes is not None:
        raise UsageError("--meshes belongs to --set paper")
    usable_device(request.device)
    if name == "full":
        return FullRecipe(
            contacts=contacts or FULL_CONTACTS,
            seed=seed,
            device=request.device,
            shard_series=FULL_SHARD_SERIES,
        )
    return _paper_recipe(contacts or ALL_CONTACTS, seed, meshes, request.device)


def _paper_recipe(contacts: int, seed: int, meshes: Path | None, device: str) -> Tcl3dRecipe:
    paths = () if meshes is None else tuple(meshes_in(meshes))
    for path in paths:  # every fault shows before the first contact is made
        object_from_mesh(path)
    names = [path.stem for path in paths] + [obj.name for obj in CATALOGUE]
    if len(set(names)) < len(names):
        raise UsageError(
            f"{meshes} has two meshes of one name, or one named like an object of paper; rename it"
        )
    return Tcl3dRecipe(contacts=contacts, seed=seed, meshes=paths, device=device)


def _parts(numbers: Sequence[int]) -> list[Sequence[int]]:
    return [numbers[i : i + SHARD_SERIES] for i in range(0, len(numbers), SHARD_SERIES)]


def _names(meshes: Sequence[Path]) -> str:
    """Names and checksums of meshes, since another mesh of the same name is other data."""
    return " ".join(f"{p.name}:{hashlib.sha256(p.read_bytes()).hexdigest()[:12]}" for p in meshes)
