"""The manifest of a folder of weights: SHA-256 of every file, checked before one is loaded.

A single flipped byte gives weights that load, and answers that are wrong and sure. Every part
(``encoder``, ``clip``, ``projector``, ``lm``) has a ``manifest.json`` of its own, written last.
That of the projector also names the manifests of the encoder and the language model that it was
trained between, so that parts of two trainings are not mixed.

Not here: stock checkpoints of others, which come without a manifest.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError

MANIFEST = "manifest.json"
VERSION = 1
_MAX_BYTES = 1_000_000


class WeightsError(TouchError):
    """Weights are missing, damaged or don't fit together."""


def write_manifest(folder: Path, *, trained_with: Iterable[str] = ()) -> None:
    """Write the manifest of a part as its files are now.

    Args:
        folder: Folder of the part.
        trained_with: Names of the parts beside it that it is good for alone.

    Raises:
        WeightsError: One of those has no manifest.
        OSError: A file can't be read, or the manifest not be written.
    """
    partners = {}
    for name in trained_with:
        partner = folder.parent / name
        if not (partner / MANIFEST).is_file():
            raise _missing(partner)
        partners[name] = _sha256(partner / MANIFEST)
    files = {path.name: _sha256(path) for path in _files(folder)}
    content = {"version": VERSION, "files": files, "trained_with": partners}
    write_atomically(folder / MANIFEST, json.dumps(content, indent=2) + "\n")


def check_manifest(folder: Path, *, required: bool = True) -> None:
    """Refuse a part that is not, to the byte, what was written.

    Args:
        folder: Folder of the part.
        required: Whether there must be a manifest; False for folders that others may have made.

    Raises:
        WeightsError: No manifest; or a file that is missing, changed, or was not there before.
    """
    if not (folder / MANIFEST).is_file():
        if required:
            raise _missing(folder)
        return
    files = _read(folder, "files")
    names = {path.name for path in _files(folder)}
    for name, checksum in files.items():
        if name not in names:
            raise WeightsError(
                f"weights are missing: {folder / name} does not exist; copy the whole folder "
                "again, or train again"
            )
        if _sha256(folder / name) != checksum:
            raise WeightsError(
                f"{folder / name} is damaged or of another set: its SHA-256 is not the one in "
                f"{MANIFEST}; copy the whole folder again, or train again"
            )
    for name in sorted(names - files.keys()):
        raise WeightsError(
            f"{folder / name} is not in {MANIFEST}, and might be loaded in place of what is; "
            "move it elsewhere"
        )


def check_partners(folder: Path) -> None:
    """Refuse a part whose neighbours are not those that it was trained with.

    Raises:
        WeightsError: Another neighbour, or one without a manifest.
    """
    for name, checksum in _read(folder, "trained_with").items():
        partner = folder.parent / name
        if manifest_digest(partner) != checksum:
            raise WeightsError(
                f"{partner} is of another set: {folder} was trained with another {name}; take all "
                "parts from one training"
            )


def manifest_digest(folder: Path) -> str:
    """SHA-256 of a part's manifest, which tells its weights from all others.

    Raises:
        WeightsError: It has no manifest.
    """
    if not (folder / MANIFEST).is_file():
        raise _missing(folder)
    return _sha256(folder / MANIFEST)


def _missing(folder: Path) -> WeightsError:
    return WeightsError(
        f"{folder} has no {MANIFEST}, so that damage would go unnoticed; copy the whole folder "
        "again, or, if you trust it as it is, write one: tacgrasp train manifest --weights "
        f"{folder.parent}"
    )


def _read(folder: Path, section: str) -> dict[str, str]:
    """Checksums by name in a section of a manifest."""
    path = folder / MANIFEST
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise ValueError(f"it is larger than {_MAX_BYTES} bytes")
        content: Any = json.loads(path.read_text(encoding="utf-8"))
        if content["version"] != VERSION:
            raise ValueError(f"version {content['version']!r:.20}, expected {VERSION}")
        entries = content[section]
        if not all(isinstance(part, str) for pair in entries.items() for part in pair):
            raise ValueError(f"{section} must be checksums by name")
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise WeightsError(
            f"{path} is damaged ({error}); copy the whole folder again, or train again"
        ) from None
    return dict(entries)


def _files(folder: Path) -> list[Path]:
    """The files of a part in order, without its manifest and hidden files."""
    paths = sorted(folder.iterdir()) if folder.is_dir() else []
    return [p for p in paths if p.is_file() and p.name != MANIFEST and not p.name.startswith(".")]


def _sha256(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise WeightsError(f"{path} can't be read: {error.strerror or error}") from None
