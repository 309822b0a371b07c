"""Features of captions and images, computed once each and kept on disk: the towers don't change.

One file holds what has been computed so far for one pair of towers and data; it is replaced as a
whole, carries its own checksum, and one that is damaged or of other towers or data is refused.
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save_file
from torch import Tensor

from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Batch
from cltp.encoder.clip_towers import Towers
from cltp.errors import TouchError
from cltp.tactile.render import render
from cltp.tactile.sensors import sensor_named

SAVE_S = 120.0


class FrozenFeatures:
    """What the towers say of a data set's contacts, in their four mirror images, and of texts.

    Args:
        towers: Frozen.
        data: Whose images they are.
        folder: Where the file lies; None keeps everything in memory alone.
        clock: For saving now and then [s].

    Raises:
        TouchError: The file is damaged.
    """

    def __init__(
        self,
        towers: Towers,
        data: ContactDataset,
        folder: Path | None = None,
        *,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._towers, self._data, self._clock = towers, data, clock
        self._texts: dict[str, Tensor] = {}
        # Rows 4 i to 4 i + 3: contact i as it is, mirrored along y, along x, along both.
        self._images = torch.zeros(4 * len(data), towers.feature_dim, dtype=torch.float16)
        self._known = torch.zeros(4 * len(data), dtype=torch.bool)
        self._saved_s, self._changed = clock(), False
        self.computed = 0
        self._path = None
        if folder is not None:
            self._of = {
                "towers": fingerprint(towers),
                "data": data.checksum(),
                "contacts": str(len(data)),
            }
            name = hashlib.sha256(json.dumps(self._of).encode()).hexdigest()[:16]
            self._path = Path(folder) / f"features-{name}.safetensors"
            if self._path.exists():
                self._read(self._path)

    def texts(self, texts: Sequence[str]) -> Tensor:
        """Features of texts, shape (B, F)."""
        for text in texts:
            if text not in self._texts:
                # One by one: what a batch held besides would show in the last bits.
                self._texts[text] = self._towers.texts([text])[0].cpu()
                self._note(1)
        return torch.stack([self._texts[text] for text in texts])

    def images(self, batch: Batch) -> Tensor:
        """Features of the clean images of a batch, shape (B, F); moved ones are not kept."""
        mirror = torch.from_numpy(batch.mirror).long()
        rows = 4 * torch.from_numpy(batch.index) + 2 * mirror[:, 0] + mirror[:, 1]
        for index in batch.index[~self._known[rows].numpy() & ~batch.moved]:
            self._see(int(index))
        found = self._images[rows].float()
        if batch.moved.any():
            moved = torch.from_numpy(batch.moved)
            found[moved] = self._towers.images(rendered(self._data, batch)[moved]).cpu().float()
        return found

    def _see(self, index: int) -> None:
        """Compute the four mirror images of one contact, always these together: see ``texts``."""
        own = slice(4 * index, 4 * index + 4)
        if self._known[own].all():
            return
        heights = self._data.height_mm(index)
        sensor = sensor_named(self._data.column("sensor")[index])
        every = [heights[:: 1 - 2 * y, :: 1 - 2 * x] for x in (0, 1) for y in (0, 1)]
        pixels = torch.stack([render(height_mm, sensor) for height_mm in every])
        self._images[own] = self._towers.images(pixels).cpu().half()
        self._known[own] = True
        self._note(4)

    def save(self) -> None:
        """Bring everything that is new to the disk."""
        if self._path is None or not self._changed:
            return
        texts = sorted(self._texts)
        width = self._images.shape[1]
        content = {
            "images": self._images,
            "known": self._known,
            "texts": torch.stack([self._texts[t] for t in texts])
            if texts
            else torch.zeros(0, width),
        }
        about = {**self._of, "texts": json.dumps(texts), "sha256": _digest(content)}
        self._path.parent.mkdir(parents=True, exist_ok=True)
        beside = self._path.with_name(f"{self._path.name}.part")
        save_file(content, beside, metadata=about)
        beside.replace(self._path)
        self._changed = False

    def _note(self, new: int) -> None:
        self.computed += new
        self._changed = True
        if self._clock() - self._saved_s > SAVE_S:
            self.save()
            self._saved_s = self._clock()

    def _read(self, path: Path) -> None:
        try:
            with safe_open(path, framework="pt") as file:
                about = file.metadata() or {}
                content = {name: file.get_tensor(name) for name in ("images", "known", "texts")}
            texts = json.loads(about.get("texts", "[]"))
        except (OSError, SafetensorError, ValueError) as error:
            raise TouchError(f"features in {path} are damaged; delete the file: {error}") from error
        of = {name: about.get(name) for name in self._of}
        if of != self._of or about.get("sha256") != _digest(content):
            raise TouchError(f"features in {path} are damaged; delete the file, they come again")
        self._images, self._known = content["images"], content["known"]
        self._texts = dict(zip(texts, content["texts"], strict=True))


def fingerprint(towers: Towers) -> str:
    """SHA-256 of the towers' weights and of their tokenizer."""
    total = hashlib.sha256(towers.words.fingerprint().encode())
    total.update(_digest(dict(towers.clip.state_dict())).encode())
    return total.hexdigest()


def _digest(content: dict[str, Tensor]) -> str:
    total = hashlib.sha256()
    for name in sorted(content):
        total.update(name.encode() + content[name].cpu().contiguous().numpy().tobytes())
    return total.hexdigest()


def rendered(data: ContactDataset, batch: Batch) -> Tensor:
    """Images of the clean gel of a batch, shape (B, 3, 64, 64)."""
    sensors = data.column("sensor")
    images = [
        render(heights, sensor_named(sensors[index]))
        for heights, index in zip(batch.height_mm, batch.index, strict=True)
    ]
    return torch.stack(images)
