"""Manifests, layout and base of weights that were trained before; nothing here trains.

Not here: training them (``tacgrasp.training.train``).
"""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from cltp.checkpoints.base_lm import move_base
from cltp.checkpoints.card import PARTS
from cltp.checkpoints.layout import renew_layout
from cltp.checkpoints.manifest import check_manifest, check_partners, write_manifest
from cltp.checkpoints.tac3d_llm import size_bytes
from tacgrasp.base.errors import UsageError


def check_parts(weights: Path) -> None:
    """Refuse a folder of weights of which a part is damaged or of another set.

    Raises:
        WeightsError: As ``check_manifest`` and ``check_partners``.
    """
    for part in _parts(weights):
        check_manifest(part)
        check_partners(part)


def write_manifests(weights: Path) -> None:
    """Write the manifest of every part of a folder of weights, as its files are now.

    Raises:
        UsageError: It has no part, or a manifest can't be written.
    """
    parts = _parts(weights)
    if not parts:
        raise UsageError(f"--weights {weights} has none of {', '.join(PARTS)}")
    whole = all((weights / name).is_dir() for name in ("encoder", "lm"))
    try:
        for part in sorted(parts, key=lambda part: part.name == "projector"):  # it names others
            partners = ("encoder", "lm") if part.name == "projector" and whole else ()
            write_manifest(part, trained_with=partners)
    except OSError as error:
        raise UsageError(f"{weights} can't be written: {error.strerror or error}") from None


def _parts(weights: Path) -> list[Path]:
    return [weights / name for name in PARTS if (weights / name).is_dir()]


def name_base(weights: Path, folder: Path) -> None:
    """Name the folder of the language model that weights were trained behind, which was moved.

    Raises:
        UsageError: It can't be written.
        TouchError: As ``cltp.checkpoints.base_lm.move_base``.
    """
    try:
        base = move_base(weights, folder)
    except OSError as error:
        raise UsageError(f"{weights} can't be written: {error.strerror or error}") from None
    line = f"base: {weights} stands behind the {base.model_type} in {base.path}"
    Console(soft_wrap=True).print(line, markup=False, highlight=False)


def renew_weights(weights: Path) -> None:
    """Bring a folder of weights into today's layout, and print what was written.

    Raises:
        UsageError: It can't be written.
        TouchError: As ``cltp.checkpoints.layout.renew_layout``.
    """
    try:
        parts = renew_layout(weights)
    except OSError as error:
        raise UsageError(f"{weights} can't be written: {error.strerror or error}") from None
    size_mb = sum(size_bytes(weights / name) for name in parts) / 1e6
    line = f"layout: {weights} with {', '.join(parts)}, {size_mb:.1f} MB"
    Console(soft_wrap=True).print(line, markup=False, highlight=False)
