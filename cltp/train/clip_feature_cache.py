"""CLIP features of captions and images, computed once each and stored: the towers don't change.

One file holds the features computed so far for one pair of towers and data. It is replaced as a
whole and carries its own checksum; a file that is damaged, or of other towers or data, is refused.
"""

from __future__ import annotations

import hashlib
import json
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save_file
from torch import Tensor

from cltp.atomic_write import replacing
from cltp.checkpoints.weight_files import digest
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Batch
from cltp.encoder.clip_towers import Towers
from cltp.encoder.render import render
from cltp.errors import TouchError

SAVE_S = 120.0

_BLOCK = 32


class FrozenFeatures:
    """Features of the four mirror images of a data set's contacts, and of texts.

    Args:
        towers: The frozen towers.
        data: The contacts.
        folder: Folder of the file; None keeps everything in memory alone.
        clock: Source of the time between two writes of the file [s].

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
        self.data = data
        self._towers, self._clock = towers, clock
        self._lock = threading.RLock()  # texts are asked for by two threads of a training
        self._texts: dict[str, Tensor] = {}
        # Rows 4 i to 4 i + 3: contact i as it is, mirrored along y, along x, along both.
        self._images = torch.zeros(4 * len(data), towers.feature_dim, dtype=torch.float16)
        self._computed = torch.zeros(4 * len(data), dtype=torch.bool)
        self._saved_s, self._changed = clock(), False
        self._path = None
        if folder is not None:
            self._identity = {
                "towers": fingerprint(towers),
                "data": data.checksum(),
                "contacts": str(len(data)),
            }
            name = hashlib.sha256(json.dumps(self._identity).encode()).hexdigest()[:16]
            self._path = Path(folder) / f"features-{name}.safetensors"
            if self._path.exists():
                self._read(self._path)

    def texts(self, texts: Sequence[str]) -> Tensor:
        """Features of texts, shape (B, F)."""
        with self._lock:
            for text in texts:
                if text not in self._texts:
                    # One by one: the other texts of a batch would change the last bits.
                    self._texts[text] = self._towers.texts([text])[0].cpu()
                    self._note_change()
            return torch.stack([self._texts[text] for text in texts])

    def images(self, batch: Batch) -> Tensor:
        """Features of the clean images of a batch, shape (B, F); moved contacts are not stored."""
        mirror = torch.from_numpy(batch.mirror).long()
        rows = 4 * torch.from_numpy(batch.index) + 2 * mirror[:, 0] + mirror[:, 1]
        moved = torch.from_numpy(batch.moved)
        new = ~self._computed[rows] & ~moved
        if new.any():
            features = self._image_features(batch, new).half()
            with self._lock:
                self._images[rows[new]], self._computed[rows[new]] = features, True
                self._note_change()
        features = self._images[rows].float()
        if moved.any():
            features[moved] = self._image_features(batch, moved)
        return features

    def _image_features(self, batch: Batch, mask: Tensor) -> Tensor:
        """Features of some contacts of a batch, computed in blocks of one size.

        The last bits of a feature depend on the size of its block, but not on the others in it.
        """
        pixels = rendered(batch, mask.nonzero()[:, 0].tolist())
        blocks = []
        for block in pixels.split(_BLOCK):
            padded = torch.zeros(_BLOCK, *block.shape[1:])
            padded[: len(block)] = block
            blocks.append(self._towers.images(padded).cpu().float()[: len(block)])
        return torch.cat(blocks)

    def save(self) -> None:
        """Write all features, where any are new."""
        with self._lock:
            self._save()

    def _save(self) -> None:
        if self._path is None or not self._changed:
            return
        texts = sorted(self._texts)
        features = [self._texts[text] for text in texts]
        content = {
            "images": self._images,
            "known": self._computed,
            "texts": torch.stack(features) if texts else torch.zeros(0, self._images.shape[1]),
        }
        metadata = {**self._identity, "texts": json.dumps(texts), "sha256": digest(content)}
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(self._path) as part:
            save_file(content, part, metadata=metadata)
        self._changed = False

    def _note_change(self) -> None:
        self._changed = True
        if self._clock() - self._saved_s > SAVE_S:
            self.save()
            self._saved_s = self._clock()

    def _read(self, path: Path) -> None:
        try:
            with safe_open(path, framework="pt") as file:
                metadata = file.metadata() or {}
                content = {name: file.get_tensor(name) for name in ("images", "known", "texts")}
            texts = json.loads(metadata.get("texts", "[]"))
        except (OSError, SafetensorError, ValueError) as error:
            raise TouchError(f"features in {path} are damaged; delete the file: {error}") from error
        expected = {**self._identity, "sha256": digest(content)}
        if {name: metadata.get(name) for name in expected} != expected:
            raise TouchError(
                f"features in {path} are damaged; delete the file, they are computed again"
            )
        self._images, self._computed = content["images"], content["known"]
        self._texts = dict(zip(texts, content["texts"], strict=True))


def fingerprint(towers: Towers) -> str:
    """SHA-256 of the towers' weights and of their tokenizer."""
    text = towers.words.fingerprint() + digest(towers.clip.state_dict())
    return hashlib.sha256(text.encode()).hexdigest()


def rendered(batch: Batch, rows: Sequence[int] | None = None) -> Tensor:
    """Images of the clean gel of some rows of a batch, or of all, shape (B, 3, 64, 64)."""
    chosen = range(len(batch.sensors)) if rows is None else rows
    return torch.stack([render(batch.height_mm[row], batch.sensors[row]) for row in chosen])
