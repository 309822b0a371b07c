"""The card of a data set: a README.md beside its shards that describes the contents.

It is written from the stored contacts once all are there. Another run of the same command writes
the same card.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from cltp.atomic_write import write_atomically
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.tactile.states import CLASSES

CARD = "README.md"

_SPLITS = {
    Split.TRAIN: "to train on",
    Split.VALIDATION: "to choose by: other series of the same objects",
    Split.TEST: "other series of the same objects, same gels: the paper's split, `contact`",
    Split.OBJECT: "unseen objects",
    Split.PHYSICS: (
        "unseen gels; read it with drift, tilt and depth scale (`cltp.tactile.sensor_noise`)"
    ),
    Split.GELSTEREO: "like the paper's GelStereo contacts: probes, held and pressed by a machine",
    Split.GELSIGHT: "like the paper's GelSight contacts: everyday objects, pressed by hand",
}


def write_card(folder: Path, command: str) -> None:
    """Write the card of a complete data set.

    Args:
        folder: The data set.
        command: The command that makes it again.

    Raises:
        TouchError: The folder is not a complete data set.
        OSError: The card can't be written.
    """
    write_atomically(folder / CARD, card(ContactDataset(folder), command))


def card(data: ContactDataset, command: str) -> str:
    """The text of the card, Markdown."""
    objects, series = data.column("object"), data.column("series")
    title = "Full set" if data.about.get("set") == "full" else "TCL3D"
    lines = [
        f"# {title}: contact states of a simulated gel",
        "",
        f"{len(data):,} contacts in {len(np.unique(series)):,} series of rising force, "
        f"{len(np.unique(objects))} objects. Heights are clean, in steps of 1 µm; clouds, noise, "
        "texts and images are derived from them when they are read.",
        "",
        f"- Made by `{command}`",
        *(f"- {name}: {value}" for name, value in sorted(data.about.items()) if name != "made_by"),
        f"- SHA-256 of the whole: `{data.checksum()}`",
        "",
        "The checksum is exact for a version of torch and a kind of device; across kinds heights "
        "agree within 2 µm.",
        "",
        "## Splits",
        "",
        "| split | contacts | what it is |",
        "|---|---:|---|",
        *_splits(data),
        "",
        *_classes(data),
        *_ambiguity(data),
        "## Objects",
        "",
        "| object | contacts | split |",
        "|---|---:|---|",
        *_objects(data),
        "",
    ]
    return "\n".join(lines)


def _splits(data: ContactDataset) -> list[str]:
    stored = data.column("split").tolist()
    return [
        f"| {split.value} | {stored.count(split.value)} | {meaning} |"
        for split, meaning in _SPLITS.items()
        if split.value in stored
    ]


def _classes(data: ContactDataset) -> list[str]:
    lines = []
    for slot, classes in CLASSES.items():
        stored = data.column(slot).tolist()
        counts = {name: stored.count(name) for name in classes}
        lines += [f"## {slot.capitalize()}: {len(classes)} classes", ""]
        lines += ["| class | contacts | % |", "|---|---:|---:|"]
        lines += [
            f"| {name} | {count} | {100 * count / len(stored):.1f} |"
            for name, count in counts.items()
        ]
        lines.append("")
    return lines


def _ambiguity(data: ContactDataset) -> list[str]:
    unsure = [text for text in data.column("unsure").tolist() if text is not None]
    if not unsure:
        return []
    counts = {slot: sum(slot in text.split() for text in unsure) for slot in CLASSES}
    each = ", ".join(f"{slot} {100 * num / len(unsure):.1f} %" for slot, num in counts.items())
    num_marked = sum(bool(text) for text in unsure)
    return [
        "## Unsure labels",
        "",
        f"{num_marked} contacts ({100 * num_marked / len(unsure):.1f} %) are marked in `unsure`: "
        f"near another class in at least one way ({each}). They stay in every score.",
        "",
    ]


def _objects(data: ContactDataset) -> list[str]:
    names, splits = data.column("object"), data.column("split")
    lines = []
    for name in sorted(set(names.tolist())):
        own = names == name
        unseen = (splits[own] == Split.OBJECT.value).any()
        lines.append(f"| {name} | {int(own.sum())} | {'object' if unseen else ''} |")
    return lines
